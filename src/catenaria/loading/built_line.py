"""A found line after it was built: unstressed lengths are kept, and tensioning devices follow the loads."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.spatial.demands import heights
from catenaria.discretise.spatial.found import found_model
from catenaria.discretise.spatial.loaded import Devices, loaded_system
from catenaria.discretise.spatial.model import SpatialModel
from catenaria.discretise.spatial.numbering import NONE
from catenaria.formfinding.static_problem import static_problem
from catenaria.line import Line
from catenaria.mechanics.state import State
from catenaria.results.form import FormResult
from catenaria.solvers.linear import Factorisation, factorise
from catenaria.solvers.newton import NewtonOptions, solve_newton

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

_NEWTON = NewtonOptions(max_iterations=40, permc_spec="NATURAL")


@dataclass(frozen=True)
class LoadedLine:
    """A built line at rest under a load.

    Attributes
    ----------
    model : SpatialModel
        The line, as the load case has it: with its temperature, its droppers and its supports.
    z : FloatArray, shape (n,)
        Unknowns at rest.
    iterations : int
        Newton iterations.
    """

    model: SpatialModel
    z: FloatArray
    iterations: int

    @property
    def height(self) -> FloatArray:
        """Heights of lower wires at droppers above the canted track [m], shape (n_droppers,)."""
        return heights(self.model, self.z).value(0.0, self.z)

    @property
    def dropper_pull(self) -> FloatArray:
        """Forces in droppers [N], shape (n_droppers,); 0 of slack ones."""
        model, z = self.model, self.z
        below = model.lower_carrier.evaluate(z, z[model.lower_s]).r
        above = model.upper_carrier.evaluate(z, z[model.upper_s]).r
        size = np.sqrt(np.einsum("ni,ni->n", above - below, above - below))
        return z[model.density] * size

    @property
    def end_force(self) -> FloatArray:
        """Forces of all wires' starts and ends on what holds them [N], shape (n_wires, 2, 3)."""
        model, ties = self.model, self.model.layout.ties
        at = model.end_force.copy()
        at[ties.wire, ties.end] = model.tie_force
        return self.z[at]

    @property
    def travel(self) -> FloatArray:
        """How far devices have pulled the ends of each wire outwards [m]; 0 where there is none."""
        pull = self.model.pull
        return np.where(pull != NONE, self.z[pull], 0.0)

    def points(self, wire: int, s: FloatArray) -> FloatArray:
        """Return where material points of a wire are [m], shape (n, 3)."""
        return self.model.wires[wire].evaluate(self.z, s).r


@dataclass(frozen=True)
class BuiltLine:
    """A line that was built as it was found.

    Attributes
    ----------
    line : Line
        What the engineer describes.
    result : FormResult
        What was found.
    model : SpatialModel
        The line; its unknowns start where it was found.
    devices : Devices
        What holds the ends of its wires.
    expansion : FloatArray, shape (n_wires,)
        Coefficients of thermal expansion of the wires [1/K].
    dropper_expansion : float
        The same of the droppers.
    """

    line: Line
    result: FormResult
    model: SpatialModel
    devices: Devices
    expansion: FloatArray
    dropper_expansion: float

    @classmethod
    def of(cls, line: Line, result: FormResult) -> BuiltLine:
        """Return the line that a result describes.

        Raises
        ------
        UnsupportedError
            If the result has no nodes to start from.
        """
        model = found_model(line, result)
        conductors = [line.conductor(wire_conductor(line, wire.role)) for wire in model.layout.wires]
        return cls(
            line,
            result,
            model,
            _devices(line, model),
            np.array([conductor.thermal_expansion for conductor in conductors]),
            line.conductor(line.dropper.conductor).thermal_expansion,
        )

    @cached_property
    def factors(self) -> Factorisation:
        """LU of the Jacobian at rest without loads: it serves for many loads that change little."""
        z = self.model.unknowns.start
        system = loaded_system(self.model, z, np.zeros(z.size), self.devices)
        return factorise(system.jacobian(State.at_rest(z)), permc_spec="NATURAL")

    @cached_property
    def at_rest(self) -> LoadedLine:
        """The line without loads."""
        return self.under()

    def under(
        self,
        load: FloatArray | None = None,
        model: SpatialModel | None = None,
        z: FloatArray | None = None,
        factors: Factorisation | None = None,
    ) -> LoadedLine:
        """Return the line at rest under a load.

        Parameters
        ----------
        load : FloatArray, shape (n,), optional
            Dead forces on the unknowns [N]; see `discretise.spatial.loaded`.
        model : SpatialModel, optional
            What the load case makes of the line: warmer, without a dropper, on moved supports.
        z : FloatArray, shape (n,), optional
            Where to start, with the lengths and clamps of the model.
        factors : Factorisation, optional
            Of a Jacobian nearby, with which the iteration begins.

        Raises
        ------
        NotConvergedError, InfeasibleError
            If no rest is found.
        """
        model = model or self.model
        z = model.unknowns.start if z is None else z
        load = np.zeros(z.size) if load is None else load
        problem = static_problem(loaded_system(model, z, load, self.devices))
        root = solve_newton(problem, z, _NEWTON, factors=factors)
        return LoadedLine(model, root.y, root.iterations)

    def with_model(self, model: SpatialModel) -> BuiltLine:
        """Return the same line with a changed model as its reference."""
        return replace(self, model=model)


def wire_conductor(line: Line, role: str) -> str:
    """Return the name of the conductor of wires in a role."""
    if role == "stitch wire" and line.stitch_wire is not None:
        return line.stitch_wire.conductor
    if role == "mid-point anchor" and line.mid_point is not None:
        return line.mid_point.conductor
    if role == "auxiliary messenger" and line.auxiliary_messenger is not None:
        return line.auxiliary_messenger.conductor
    return line.messenger_wire.conductor if role == "messenger wire" else line.contact_wire.conductor


def _devices(line: Line, model: SpatialModel) -> Devices:
    moves: list[bool] = []
    stiffness: list[float] = []
    for laid in model.layout.wires:
        wire = {
            "contact wire": line.contact_wire,
            "auxiliary messenger": line.auxiliary_messenger,
            "messenger wire": line.messenger_wire,
        }.get(laid.role)
        device = None if wire is None else wire.tension.device
        moves.append(device is not None and device.kind != "fixed")
        stiffness.append(0.0 if device is None or device.stiffness is None else device.stiffness)
    return Devices(tuple(moves), np.array(stiffness))
