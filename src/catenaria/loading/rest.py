"""Where a loaded line comes to rest: by Newton's method, by steps of the load, and of the temperature."""

from __future__ import annotations

import math
from typing import Final

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.spatial.loaded import loaded_system, warmed
from catenaria.discretise.spatial.model import SpatialModel
from catenaria.discretise.spatial.natural import Natural
from catenaria.errors import InfeasibleError, NotConvergedError
from catenaria.formfinding.static_problem import static_problem
from catenaria.loading.built_line import BuiltLine, LoadedLine
from catenaria.solvers.load_stepping import SteppingOptions, solve_by_steps
from catenaria.solvers.newton import NewtonOptions

FloatArray = NDArray[np.float64]

_STEPS: Final = SteppingOptions(newton=NewtonOptions(max_iterations=15, permc_spec="NATURAL"))
_WARMING: Final = 20.0  # K: it takes a third of the strain of a usual contact wire, which stays taut


def at_rest(
    built: BuiltLine, model: SpatialModel, load: FloatArray, z: FloatArray | None = None
) -> LoadedLine:
    """Return the line at rest, by Newton's method or, where that alone fails, by steps of the load.

    Raises
    ------
    NotConvergedError, InfeasibleError
        If neither finds it.
    """
    try:
        return built.under(load, model, z)
    except (NotConvergedError, InfeasibleError):
        z = model.unknowns.start if z is None else z
        problem = static_problem(loaded_system(model, z, load, built.devices))
        released = solve_by_steps(problem, z, _STEPS)
        return LoadedLine(model, released.root.y, released.iterations)


def rest_when_warmed(built: BuiltLine, warming: float) -> FloatArray:
    """Return the unknowns of a line at rest that is warmer and nothing else, reached by small steps.

    Parameters
    ----------
    built : BuiltLine
        The line.
    warming : float
        Change of temperature [K].

    Notes
    -----
    At once, a warming of 60 K would take all strain from a wire, and a wire without tension has no stiffness
    across itself.
    """
    z, was, steps = (
        built.model.unknowns.start,
        np.ones(len(built.model.wires)),
        math.ceil(abs(warming) / _WARMING),
    )
    for part in range(1, steps + 1):
        warm = warming * part / steps
        model = warmed(built.model, warm, built.expansion.tolist(), built.dropper_expansion)
        now = 1.0 + warm * built.expansion
        z = at_rest(built, model, np.zeros(z.size), _carried(model, z, now / was)).z
        was = now
    return z


def _carried(model: SpatialModel, z: FloatArray, longer: FloatArray) -> FloatArray:
    """Return unknowns on wires that are longer without stress, shape (n_wires,), in the same places."""
    z = z.copy()
    for chain, factor in zip(model.wires, longer, strict=True):
        z[chain.nodes[:, 3:]] /= factor
    for at, on, _ in Natural(model, z).attached():
        z[at] *= longer[on]
    z[model.length] = model.unknowns.start[model.length]
    return z
