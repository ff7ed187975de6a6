"""What is prescribed, and what moves to meet it: one target and one parameter each.

The parameter p of a control is a displacement of held points: each joint named in `move` goes by p along its
direction. It is to be counted so that more of it makes the measured quantity larger.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import hypot
from typing import Annotated, Literal

from annotated_types import Len
from pydantic import Field, model_validator

from catenaria.line.base import LineModel, Problem, refuse
from catenaria.line.control import DropperForceControl, HeightControl, TensionControl
from catenaria.structure.vector import Direction
from catenaria.units import Length, PositiveForce


class Control(LineModel):
    """What all controls share: the held points that move."""

    move: dict[str, Direction] = Field(
        description=(
            "Held points by the name of their joint, and the direction x, y, z in which each moves; two ends "
            "of a cable move oppositely if their directions are opposite."
        ),
    )

    @model_validator(mode="after")
    def _movable(self) -> Control:
        refuse("Control", self._problems())
        return self

    def _problems(self) -> Iterator[Problem]:
        if not self.move:
            yield Problem(("move",), self.move, "at least one held point that is released to meet the target")
        for name, direction in self.move.items():
            if hypot(*direction) == 0.0:
                yield Problem(("move", name), direction, "a direction that is not zero")


class TensionTarget(Control):
    """A wanted tension, eqs. (19)-(20)."""

    joint: str = Field(description="Where it is measured: see measure.")
    force: PositiveForce = Field(description="The wanted tension.")
    measure: Literal["reaction", "pull", "strain"] = Field(
        default="reaction",
        description=(
            "reaction: the force on a held end of a cable; pull: its component in the direction in which the "
            "end moves; strain: N = EA eps of eq. (11) where a cable is in a sliding or guided joint."
        ),
    )
    law: TensionControl = Field(
        default=TensionControl(velocity=0.2e-3, dead_band=5.0, saturation=100.0),
        description="How fast the points move in the dynamic method.",
    )


class HeightTarget(Control):
    """A wanted height of a joint, eqs. (21)-(22)."""

    joint: str = Field(description="The joint whose height is measured.")
    height: Length = Field(description="The wanted height.")
    law: HeightControl = Field(
        default=HeightControl(), description="How fast the points move in the dynamic method."
    )


class BalanceTarget(Control):
    """Two cables as the halves of one whose length is looked for, eq. (23).

    Each half is joined to one other cable and held at its other end. The forces that the two joints exert on
    the halves must carry the weight of one cable from joint to joint.
    """

    halves: Annotated[tuple[str, str], Len(2, 2)] = Field(
        description="Names of the upper and the lower cable."
    )
    law: DropperForceControl = Field(
        default=DropperForceControl(), description="How fast the points move in the dynamic method."
    )
