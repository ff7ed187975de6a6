"""Droppers: what they are made of and where they hang."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Literal

from annotated_types import Ge, Le
from pydantic import Field, Strict, model_validator

from catenaria.errors import InconsistentInputError
from catenaria.line.base import LineModel, Problem, refuse
from catenaria.units import Length, NonNegativeLength, NonNegativeMass, PositiveLength


class DropperKind(LineModel):
    """What every dropper of the line is made of, and how it is modelled."""

    conductor: str = Field(description="Name of one of the conductors, or of one of the library.")
    model: Literal["cables", "bar", "rigid"] = Field(
        default="cables",
        description=(
            "cables: two cables that meet, as in Yang et al. 2017; in a line beyond the plane they are taken "
            "as the straight bar that they make. bar: one elastic bar. rigid: a bar that does not stretch."
        ),
    )
    slack: Literal["refused", "allowed"] = Field(
        default="refused",
        description=(
            "What becomes of a dropper that would have to push the contact wire down to its wanted height. "
            "refused: the line is refused, with advice. allowed: it is slack, and the wire is higher there."
        ),
    )
    guessed_length: PositiveLength = Field(
        default=1.5,
        description=(
            "Length of each of the two cables that model a dropper until its length is found: one below the "
            "messenger wire, one above the contact wire. The result does not depend on it."
        ),
    )
    joint: Literal["guided", "frictionless"] = Field(
        default="guided",
        description=(
            "guided: the clamp is held along the track and the force is vertical, as built. "
            "frictionless: the clamp slides along the wire, literally eq. (15) of Yang et al. 2017."
        ),
    )
    elements: Annotated[int, Strict(), Ge(1)] = Field(
        default=2, description="ANCF elements of each of the two cables."
    )
    clamp_mass_top: NonNegativeMass = Field(
        default=0.0, description="Mass of the clamp at the messenger wire."
    )
    clamp_mass_bottom: NonNegativeMass = Field(
        default=0.0, description="Mass of the clamp at the contact wire."
    )
    clamp_height_top: NonNegativeLength = Field(
        default=0.0, description="What the upper clamp bridges: subtracted from the length to be cut."
    )
    clamp_height_bottom: NonNegativeLength = Field(
        default=0.0, description="What the lower clamp bridges: subtracted from the length to be cut."
    )


class Droppers(LineModel):
    """Where the droppers of a span hang: a list of positions, or the first one, the spacing and how many.

    Examples
    --------
    >>> Droppers(first=4.0, spacing=9.5, count=3).x
    (4.0, 13.5, 23.0)
    """

    positions: tuple[Length, ...] | None = Field(
        default=None, description="Distances from the span's first support, in ascending order."
    )
    first: Length | None = Field(
        default=None, description="Distance of the first dropper from the first support."
    )
    spacing: PositiveLength | None = Field(
        default=None, description="Distance between neighbouring droppers."
    )
    count: Annotated[int, Strict(), Ge(1), Le(1000)] | None = Field(
        default=None, description="Number of droppers, 1 to 1000."
    )

    @property
    def x(self) -> tuple[float, ...]:
        """Distances of the droppers from the span's first support [m]."""
        if self.positions is not None:
            return self.positions
        if self.first is None or self.spacing is None or self.count is None:
            raise InconsistentInputError("droppers need positions, or first, spacing and count together")
        return tuple(self.first + i * self.spacing for i in range(self.count))

    def place(self, number: int) -> tuple[str | int, ...]:
        """Field that says where the dropper with this index hangs."""
        if self.positions is not None:
            return ("positions", number)
        return ("first",) if number == 0 else ("spacing",)

    @model_validator(mode="after")
    def _one_way(self) -> Droppers:
        refuse("Droppers", self._problems())
        return self

    def _problems(self) -> Iterator[Problem]:
        pattern = {"first": self.first, "spacing": self.spacing, "count": self.count}
        if self.positions is None:
            missing = [name for name, value in pattern.items() if value is None]
            for name in ["positions"] if len(missing) == len(pattern) else missing:
                yield Problem((name,), None, "positions, or first, spacing and count together", "missing")
            return
        for name, value in pattern.items():
            if value is not None:
                yield Problem((name,), value, "either positions, or first, spacing and count")
