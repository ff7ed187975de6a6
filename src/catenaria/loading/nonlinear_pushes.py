"""A line that is pushed point by point with all nonlinearities, each from what the linearised line does."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.spatial.loaded import loaded_system
from catenaria.errors import InfeasibleError, NotConvergedError
from catenaria.loading.built_line import BuiltLine
from catenaria.loading.case import at_rest
from catenaria.loading.reduced import SLACK, Pushes, ReducedLine
from catenaria.mechanics.state import State
from catenaria.solvers.linear import Factorisation, factorise

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]
Mask = NDArray[np.bool_]
Matrix = Any  # SciPy's csr_array

HELD: Final = 1e-9  # m/N: what gives way less is held


@dataclass(frozen=True)
class NonlinearPushes:
    """A line that is pushed with all nonlinearities, point by point, from what the linearised one does.

    Attributes
    ----------
    built, reduced
        The line, and its linearisation.
    forces : csr_array, shape (n_points, n_unknowns)
        Unit forces.
    lacking : FloatArray, shape (n_points,)
        What the mesh takes from elasticities [m/N]; see `between_nodes`.
    pushes : Pushes
        What the linearised line does.
    force : float
        Size of the force [N].
    """

    built: BuiltLine
    reduced: ReducedLine
    forces: Matrix
    lacking: FloatArray
    pushes: Pushes
    force: float

    def at(
        self, some: IntArray, progress: Callable[[int, int], None] | None = None
    ) -> tuple[FloatArray, Mask]:
        """Return elasticities [m/N] and slack droppers at some points; factors serve while slack stays.

        Raises
        ------
        NotConvergedError, InfeasibleError
            If the line does not come to rest.
        """
        elasticity = np.empty(some.size)
        slack = np.empty((some.size, self.reduced.pull.size), dtype=np.bool_)
        factors, known = self.reduced.factors, np.zeros(self.reduced.pull.size, dtype=np.bool_)
        for k, i in enumerate(some.tolist()):
            z = self.reduced.start(self.forces[[i]], self.force, self.pushes.gap[i])
            if not np.array_equal(known, self.pushes.slack[i]):
                factors, known = self._factors(z, self._load(i)), self.pushes.slack[i]
            elasticity[k], slack[k] = self._solve(i, z, factors)
            if progress is not None:
                progress(k + 1, some.size)
        return elasticity, slack

    def _load(self, i: int) -> FloatArray:
        load: FloatArray = self.force * self.forces[[i]].toarray()[0]
        return load

    def _factors(self, z: FloatArray, load: FloatArray) -> Factorisation | None:
        system = loaded_system(self.reduced.model, z, load, self.built.devices)
        try:
            return factorise(system.jacobian(State.at_rest(z)), permc_spec="NATURAL")
        except np.linalg.LinAlgError:
            return None

    def _solve(self, i: int, z: FloatArray, factors: Factorisation | None) -> tuple[float, Mask]:
        model, load = self.reduced.model, self._load(i)
        try:
            loaded = self.built.under(load, model, z, factors)
        except (NotConvergedError, InfeasibleError):
            loaded = at_rest(self.built, model, load)
        elasticity = float(load @ (loaded.z - model.unknowns.start)) / self.force**2
        lacking = float(self.lacking[i]) if elasticity > HELD else 0.0
        return elasticity + lacking, loaded.dropper_pull <= SLACK
