"""The whole structure: what a researcher describes and a method solves."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from annotated_types import Ge, Le
from pydantic import Field, PrivateAttr, Strict, field_validator, model_validator
from pydantic_core import PydanticCustomError

from catenaria.line.base import LineModel, refuse
from catenaria.line.solver import Integrator, Rayleigh, Settle
from catenaria.line.source import Source
from catenaria.structure.cable import Cable
from catenaria.structure.checks import structure_problems
from catenaria.structure.control import BalanceTarget, Control, HeightTarget, TensionTarget
from catenaria.structure.joint import Joint, PointMass
from catenaria.structure.section import Section
from catenaria.units import NonNegativeTime, PositiveAcceleration


class Solver(LineModel):
    """How the structure is computed; every value has a default."""

    gauss_points: Annotated[int, Strict(), Ge(3), Le(20)] = Field(
        default=5, description="Gauss points for the energy of an element."
    )
    ramp_time: NonNegativeTime = Field(
        default=5.0, description="t1 of eq. (31): gravity and control velocities grow smoothly in this time."
    )
    damping: Rayleigh = Field(default=Rayleigh(), description="Physical damping, none by default.")
    integrator: Integrator = Field(default=Integrator(), description="Time integration.")
    settle: Settle = Field(default=Settle(), description="When a dynamic run is over.")


class Structure(LineModel):
    """Cables and rods, their joints, and what is prescribed; all quantities are floats in SI, z points up."""

    format: Literal[1] = Field(description="Version of this file format: 1.")
    name: str = Field(default="", description="A short name, for tables and figures.")
    description: str = Field(default="", description="Whatever a reader should know.")
    gravity: PositiveAcceleration = Field(default=9.80665, description="Acceleration of gravity.")
    sections: dict[str, Section] = Field(description="Cross-sections by name; cables refer to the names.")
    cables: dict[str, Cable] = Field(description="Cables and rods by name.")
    joints: dict[str, Joint] = Field(description="Joints by name.")
    masses: dict[str, PointMass] = Field(default={}, description="Point masses by name.")
    tensions: dict[str, TensionTarget] = Field(default={}, description="Wanted tensions by name.")
    heights: dict[str, HeightTarget] = Field(default={}, description="Wanted heights by name.")
    balances: dict[str, BalanceTarget] = Field(
        default={}, description="Cables of unknown length, modelled as two halves, by name."
    )
    solver: Solver = Field(default=Solver(), description="Options of the methods.")

    _source: Source = PrivateAttr(default_factory=Source)

    def model_post_init(self, context: Any, /) -> None:
        """Keep the places in the file, which the reader hands over as context of the validation."""
        if isinstance(context, Source):
            self._source = context

    @field_validator("format", mode="before")
    @classmethod
    def _whole_number(cls, value: object) -> object:
        """In Python, and therefore in pydantic's eyes, 1 is the same as true and as 1.0."""
        if type(value) is not int:
            raise PydanticCustomError("value", "{allowed}", {"allowed": "1"})
        return value

    @model_validator(mode="after")
    def _consistent(self) -> Structure:
        refuse("Structure", structure_problems(self))
        return self

    @property
    def source(self) -> Source:
        """Where in its file the parts of the structure stand."""
        return self._source

    @property
    def controls(self) -> dict[str, Control]:
        """All controls by name: tensions, heights, balances."""
        return {**self.tensions, **self.heights, **self.balances}

    def without_controls(self) -> Structure:
        """Return the same structure with all held points where they are at the start."""
        return self.model_copy(update={"tensions": {}, "heights": {}, "balances": {}})
