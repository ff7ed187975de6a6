"""How supports hold the contact wire."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal

from pydantic import Field, model_validator

from catenaria.line.base import LineModel, Problem, refuse
from catenaria.line.steady_arm import SteadyArm
from catenaria.units import Length


class ContactSupport(LineModel):
    """How a support holds the contact wire."""

    height: Length = Field(description="Height at which the contact wire is held.")
    kind: Literal["sliding", "steady arm"] = Field(
        default="sliding",
        description=(
            "sliding: the wire runs through a fixed point, frictionless. steady arm: an arm holds it across "
            "the track and swings along with it."
        ),
    )
    arm: SteadyArm | None = Field(default=None, description="The steady arm, if that is what holds the wire.")

    @model_validator(mode="after")
    def _arm_where_there_is_one(self) -> ContactSupport:
        refuse("ContactSupport", self._problems())
        return self

    def _problems(self) -> Iterator[Problem]:
        if self.kind == "sliding" and self.arm is not None:
            yield Problem(("arm",), self.arm, "an arm only where kind is steady arm")
        if self.kind == "steady arm" and self.arm is None:
            yield Problem(("arm",), None, "a value with its length, for kind is steady arm", "missing")
