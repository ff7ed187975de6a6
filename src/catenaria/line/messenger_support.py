"""How supports hold the messenger wire."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Final, Literal

from annotated_types import Ge, Le
from pydantic import ConfigDict, Field, Strict, model_validator

from catenaria.line.base import LineModel, Problem, exactly_one, refuse
from catenaria.line.conductor import Conductor
from catenaria.line.steady_arm import Side
from catenaria.units import Length, PositiveLength, PositiveStiffness

_RUNNING: Final = ("sliding", "spring", "cantilever")  # where the wire runs over the support


class Cantilever(Conductor):
    """A flexible beam across the track, fixed at its root, whose free tip carries the messenger wire."""

    length: PositiveLength = Field(description="From the root to the wire, as long as it is free of load.")
    side: Side = Field(description="On which side of the wire the root is.")
    elements: Annotated[int, Strict(), Ge(1), Le(100)] = Field(
        default=4, description="ANCF elements of the beam."
    )

    @model_validator(mode="after")
    def _stiff(self) -> Cantilever:
        if self.bending_stiffness == 0.0:
            place = Problem(("bending_stiffness",), 0.0, "greater than zero: it carries by bending")
            refuse("Cantilever", [place])
        return self


class MessengerSupport(LineModel):
    """How a support holds the messenger wire."""

    model_config = ConfigDict(json_schema_extra=exactly_one("height", "encumbrance"))

    height: Length | None = Field(
        default=None, description="Height at which the messenger wire is held. Give this or encumbrance."
    )
    encumbrance: PositiveLength | None = Field(
        default=None, description="Height above the contact wire of the same support. Give this or height."
    )
    kind: Literal["sliding", "clamped", "spring", "bracket", "cantilever"] = Field(
        default="sliding",
        description=(
            "sliding: the wire runs over a fixed point. clamped: as sliding while the line is tensioned, "
            "then clamped. spring: sliding, on springs. bracket: a swinging bracket goes along with the wire "
            "and takes no force along the track. cantilever: sliding, on the tip of a flexible beam."
        ),
    )
    stiffness: PositiveStiffness | None = Field(
        default=None, description="Vertical stiffness of a spring; height is that of the spring without load."
    )
    lateral_stiffness: PositiveStiffness | None = Field(
        default=None, description="Stiffness of a spring across the track; rigid if left out."
    )
    friction: Annotated[float, Strict(), Ge(0.0), Le(0.5)] = Field(
        default=0.0,
        description=(
            "By how much the tension of the wire falls over the support, per force on it: 0 to 0.5, for "
            "supports over which it runs."
        ),
    )
    cantilever: Cantilever | None = Field(default=None, description="The beam, where kind is cantilever.")

    @model_validator(mode="after")
    def _consistent(self) -> MessengerSupport:
        refuse("MessengerSupport", [*self._height_problems(), *self._kind_problems()])
        return self

    def _height_problems(self) -> Iterator[Problem]:
        if self.height is None and self.encumbrance is None:
            yield Problem(("height",), None, "a value: one of height and encumbrance is needed", "missing")
        if self.height is not None and self.encumbrance is not None:
            yield Problem(("encumbrance",), self.encumbrance, "this or height, not both")

    def _kind_problems(self) -> Iterator[Problem]:
        for field, kind in (("stiffness", "spring"), ("cantilever", "cantilever")):
            value: object = getattr(self, field)
            if value is None and self.kind == kind:
                yield Problem((field,), None, f"a value, for kind is {kind}", "missing")
        for field, kind in (
            ("stiffness", "spring"),
            ("lateral_stiffness", "spring"),
            ("cantilever", "cantilever"),
        ):
            value = getattr(self, field)
            if value is not None and self.kind != kind:
                yield Problem((field,), value, f"a {field} only where kind is {kind}")
        if self.friction > 0.0 and self.kind not in _RUNNING:
            yield Problem(("friction",), self.friction, f"0: over a {self.kind} support no wire runs")


class AuxiliarySupport(LineModel):
    """How a support holds the auxiliary messenger: the wire runs through a fixed point, frictionless."""

    height: Length = Field(description="Height at which the auxiliary messenger is held.")
