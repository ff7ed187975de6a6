"""Steady (registration) arms, which hold the contact wire sideways."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Annotated, Final, Literal

from pydantic import Field, model_validator

from catenaria.line.base import LineModel, Problem, refuse
from catenaria.units import FORCE, Length, NonNegativeMass, PositiveForce, PositiveLength, QuantityType

Side = Literal["left", "right"]

SIGN: Final[dict[Side, float]] = {"left": 1.0, "right": -1.0}


_MOST_LIFT: Final = 2e3  # N
_OFF: Final = 0.2  # of an arm's length: how far a hinge may be from where the wire's first guess puts it


class Hinge(LineModel):
    """Where the hinge of a steady arm is fixed, in the frame of the track."""

    stagger: Length = Field(description="Sideways offset of the hinge, positive to the left.")
    height: Length = Field(description="Height of the hinge above the rails.")


class SteadyArm(LineModel):
    """A steady arm: a straight bar, hinged at one end, whose other end holds the contact wire sideways.

    The arm is found: it points along the force of the wire and half of its own weight. If the hinge is given,
    the place of the wire is found instead.
    """

    length: PositiveLength = Field(description="From the hinge to the contact-wire clamp.")
    mass: NonNegativeMass = Field(
        default=0.0, description="Mass of the arm without its clamp; half of it hangs on the wire."
    )
    clamp_mass: NonNegativeMass = Field(default=0.0, description="Mass of the clamp on the contact wire.")
    registration: Literal["pull-off", "push-off"] = Field(
        default="pull-off",
        description=(
            "pull-off: the arm is hinged on the side of the mast. push-off: it is hinged on a drop bracket "
            "that reaches across the wire."
        ),
    )
    side: Side | None = Field(
        default=None,
        description=(
            "On which side of the wire the hinge is. If left out, that of the stagger, where the arm of a "
            "straight track is in tension; needed where the stagger is 0."
        ),
    )
    hinge: Hinge | None = Field(
        default=None,
        description=(
            "Where the hinge is. If left out it is found, and the wire is where stagger and height say; if "
            "given, these are a first guess."
        ),
    )
    lift: Annotated[float, QuantityType(FORCE)] | None = Field(
        default=None,
        description=(
            "Vertical force of the arm on the wire, upwards, its weight included. If given, the height of "
            "the wire is found and the given one is a first guess."
        ),
    )
    minimum_pull: PositiveForce | None = Field(
        default=None, description="Horizontal pull of the wire on the arm that is wanted at least."
    )

    @model_validator(mode="after")
    def _one_unknown(self) -> SteadyArm:
        refuse("SteadyArm", self._problems())
        return self

    def _problems(self) -> Iterator[Problem]:
        if self.hinge is not None and self.lift is not None:
            yield Problem(("lift",), self.lift, "this or a hinge, not both: a hinge determines the force")
        if self.lift is not None and abs(self.lift) > _MOST_LIFT:
            yield Problem(("lift",), self.lift, f"within {_MOST_LIFT / 1e3:g} kN, as 80 N")

    def hinge_side(self, stagger: float) -> float:
        """Side of the wire on which the hinge is: 1 left, -1 right, 0 if nothing says.

        Parameters
        ----------
        stagger : float
            Of the wire [m].

        Examples
        --------
        >>> [SteadyArm(length=1.2).hinge_side(stagger) for stagger in (0.2, -0.2, 0.0)]
        [1.0, -1.0, 0.0]
        """
        if self.side is not None:
            return SIGN[self.side]
        away = self.hinge.stagger - stagger if self.hinge is not None else stagger
        return float(away > 0.0) - float(away < 0.0)


def arm_problems(arm: SteadyArm, stagger: float, height: float) -> Iterator[Problem]:
    """Find what contradicts the place where an arm holds the wire.

    Parameters
    ----------
    arm : SteadyArm
        The arm.
    stagger, height : float
        Of the wire [m].

    Yields
    ------
    Problem
        At its place within the arm.
    """
    if arm.hinge is None:
        if arm.side is None and stagger == 0.0:
            yield Problem(("side",), None, "left or right: the stagger is 0 and does not say it", "missing")
        return
    if arm.hinge.stagger == stagger:
        allowed = f"left or right of the wire, which is at {stagger:g} m"
        yield Problem(("hinge", "stagger"), arm.hinge.stagger, allowed)
    elif arm.side is not None and SIGN[arm.side] * (arm.hinge.stagger - stagger) < 0.0:
        other = "right" if arm.side == "left" else "left"
        yield Problem(("side",), arm.side, f"{other}, where the hinge is, or nothing")
    distance = math.hypot(arm.hinge.stagger - stagger, arm.hinge.height - height)
    if abs(distance - arm.length) > _OFF * arm.length:
        allowed = (
            f"a place {arm.length:g} m from the wire, as long as the arm is; this is {distance:.3g} m away"
        )
        yield Problem(("hinge",), arm.hinge, allowed)
