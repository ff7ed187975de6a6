"""How the line is meshed and solved; every value has a default that suits ordinary lines."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import Annotated

from annotated_types import Ge, Le
from pydantic import Field, Strict, model_validator

from catenaria.line.base import LineModel, Problem, refuse
from catenaria.line.control import (
    ContactTensionControl,
    DropperForceControl,
    HeightControl,
    MessengerTensionControl,
)
from catenaria.units import (
    NonNegativeFrequency,
    NonNegativeTime,
    PositiveLength,
    PositiveTime,
    PositiveVelocity,
)

Count = Annotated[int, Strict(), Ge(1)]


class Mesh(LineModel):
    """Where the nodes of the wires stand.

    Notes
    -----
    A wire bends over a support or clamp within about sqrt(EJ/T), 0.14 to 0.37 m for usual wires. Elements
    must be shorter than that there and may be long in between.
    """

    fine: tuple[PositiveLength, ...] = Field(
        default=(0.1, 0.3),
        description="Distances from every support and clamp at which nodes stand, ascending.",
    )
    largest_element: PositiveLength = Field(default=2.4, description="Length that no element exceeds.")
    even: Count | None = Field(
        default=None,
        description=(
            "Divide each wire into so many equal elements instead, wherever supports and clamps come to lie, "
            "to compare with computations on such meshes."
        ),
    )
    gauss_points: Annotated[int, Strict(), Ge(4), Le(20)] = Field(
        default=5,
        description=(
            "Gauss points for the energy of an element. With 3 the nodes of a bent wire are out of balance "
            "by newtons, which the audit finds; with 2 there are spurious modes."
        ),
    )
    refine: Count = Field(
        default=1, description="Every element is divided into so many, to see what the mesh does."
    )

    @model_validator(mode="after")
    def _ascending(self) -> Mesh:
        refuse("Mesh", self._problems())
        return self

    def _problems(self) -> Iterator[Problem]:
        for i, (before, after) in enumerate(pairwise(self.fine), start=1):
            if after <= before:
                yield Problem(("fine", i), after, f"more than {before:g} m: distances ascend")


class Rayleigh(LineModel):
    """Damping matrix: mass times M plus stiffness times K. None by default: the paper mentions no damping."""

    mass: NonNegativeFrequency = Field(default=0.0, description="Factor of the mass matrix.")
    stiffness: NonNegativeTime = Field(default=0.0, description="Factor of the stiffness matrix.")


class Integrator(LineModel):
    """Time integration by backward differentiation formulas (BDF)."""

    max_order: Annotated[int, Strict(), Ge(1), Le(5)] = Field(
        default=2, description="Highest order; above 2 BDF is not A-stable and undamped wires may ring."
    )
    position_tolerance: PositiveLength = Field(
        default=1e-4, description="Allowed local error of positions in one step."
    )
    max_time: PositiveTime = Field(default=1e6, description="Simulated time after which the run is given up.")
    max_steps: Count = Field(default=20_000, description="Number of steps after which the run is given up.")


class Settle(LineModel):
    """When the run is over: all is at rest, and every control is in its band or has hardly any way to go."""

    velocity: PositiveVelocity = Field(default=1e-3, description="Largest speed of any node at the end.")
    dead_bands: Annotated[float, Strict(), Ge(1.0)] = Field(
        default=1.1,
        description=(
            "Every control error must be within so many dead bands; with exactly 1 a run would not end, "
            "because the control law approaches its band like 1/t."
        ),
    )
    remaining_travel: PositiveLength = Field(
        default=1e-5,
        description=(
            "The run also ends when the travel that every control has left, estimated from linearised "
            "statics, is below this."
        ),
    )


class DynamicOptions(LineModel):
    """The dynamic equilibrium method of Yang et al. 2017."""

    ramp_time: PositiveTime = Field(
        default=5.0,
        description="t1 of eq. (31): gravity and control velocities grow smoothly from zero in this time.",
    )
    contact_tension: ContactTensionControl = Field(
        default=ContactTensionControl(),
        description="Tension control of the contact wire, eqs. (19) and (20).",
    )
    messenger_tension: MessengerTensionControl = Field(
        default=MessengerTensionControl(),
        description="Tension control of the messenger wire, eqs. (19) and (20).",
    )
    height: HeightControl = Field(default=HeightControl(), description="Height control, eqs. (21) and (22).")
    dropper_force: DropperForceControl = Field(
        default=DropperForceControl(), description="Control of the force balance of a dropper, eq. (23)."
    )
    damping: Rayleigh = Field(default=Rayleigh(), description="Physical damping, none by default.")
    integrator: Integrator = Field(default=Integrator(), description="Time integration.")
    settle: Settle = Field(default=Settle(), description="When the run is over.")


class Solver(LineModel):
    """How the line is meshed and solved."""

    mesh: Mesh = Field(default=Mesh(), description="Where the nodes of the wires stand.")
    dynamic: DynamicOptions = Field(
        default=DynamicOptions(), description="Options of the dynamic equilibrium method."
    )
