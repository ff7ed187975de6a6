"""Where cables are joined, to each other or to the ground, and what the joints leave free."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import BeforeValidator, Field
from pydantic_core import PydanticCustomError

from catenaria.line.base import LineModel
from catenaria.units import LENGTH, NonNegativeLength, NonNegativeMass, QuantityType

_COORDINATE = QuantityType(LENGTH, "non-negative")


def _place(value: object) -> object:
    if value in ("start", "end"):
        return value
    try:
        return _COORDINATE.read(value)
    except PydanticCustomError:
        allowed = 'start, end or a length from the start, for example "2 m"'
        raise PydanticCustomError("value", "{allowed}", {"allowed": allowed}) from None


Place = Annotated[Literal["start", "end"] | NonNegativeLength, BeforeValidator(_place)]


class Attachment(LineModel):
    """A point of a cable.

    Examples
    --------
    >>> Attachment(cable="rod", point="2 m").coordinate(10.0)
    2.0
    """

    cable: str = Field(description="Name of the cable.")
    point: Place = Field(description="start, end, or the material (unstressed) coordinate from the start.")

    def coordinate(self, length: float) -> float:
        """Return the material coordinate on a cable of the given length [m]."""
        match self.point:
            case "start":
                return 0.0
            case "end":
                return length
            case coordinate:
                return float(coordinate)


class Joint(LineModel):
    """A joint of a cable with another one, or with the ground where it is at the start.

    Notes
    -----
    ``fixed`` (16) keeps position and direction, ``spherical`` the position only: a hinge, or to the ground a
    held point. Through a ``sliding`` joint (15) the cable `on` runs without friction. A ``guided`` one keeps
    its place along x, with a force on the cable `on` normal to x.
    """

    type: Literal["fixed", "spherical", "sliding", "guided"] = Field(description="What it leaves free.")
    on: Attachment = Field(description="The cable; the one that slides, for sliding and guided joints.")
    to: Attachment | None = Field(
        default=None, description="The cable that it is joined to; the ground if left out."
    )

    @property
    def is_held_point(self) -> bool:
        """Whether it holds one point of a cable, which a control may move."""
        return self.type == "spherical" and self.to is None

    @property
    def slides(self) -> bool:
        """Whether the cable `on` runs through it."""
        return self.type in ("sliding", "guided")


class PointMass(LineModel):
    """A mass at a point of a cable."""

    on: Attachment = Field(description="Where it sits.")
    mass: NonNegativeMass = Field(description="How much it is.")
