"""Spans: the line from one support to the next, with its droppers."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated

from pydantic import Discriminator, Field, Tag, model_validator

from catenaria.line.base import LineModel, Problem, refuse
from catenaria.line.dropper import Droppers
from catenaria.units import Length, PositiveLength


def _one_or_list(value: object) -> str:
    return "[list]" if isinstance(value, list | tuple) else "[one]"


# An ordinary union would report every wrong height twice, once for each of its members.
Heights = Annotated[
    Annotated[Length, Tag("[one]")] | Annotated[tuple[Length, ...], Tag("[list]")],
    Discriminator(_one_or_list),
]


class Span(LineModel):
    """From one support to the next.

    Examples
    --------
    >>> span = Span(length=65, droppers=Droppers(positions=(4, 32.5, 61)), contact_wire_height=0)
    >>> span.heights
    (0.0, 0.0, 0.0)
    """

    length: PositiveLength = Field(description="Distance between the two supports along the track.")
    droppers: Droppers = Field(description="Where the droppers hang.")
    contact_wire_height: Heights = Field(
        description="Wanted height of the contact wire at the droppers: one, or a list with one for each."
    )
    pre_sag: Length = Field(
        default=0.0,
        description=(
            "Depth of a parabola that the wanted heights follow between the first and the last dropper. "
            "Only 0 is solved yet; a list of heights says the same."
        ),
    )

    @property
    def heights(self) -> tuple[float, ...]:
        """Wanted heights of the contact wire [m]; in a line there is one for each dropper."""
        height = self.contact_wire_height
        return height if isinstance(height, tuple) else (height,) * len(self.droppers.x)

    @model_validator(mode="after")
    def _droppers_fit(self) -> Span:
        refuse("Span", self._problems())
        return self

    def _problems(self) -> Iterator[Problem]:
        previous = 0.0  # of those inside the span: one position at fault says nothing about its neighbours
        for i, position in enumerate(self.droppers.x):
            place = ("droppers", *self.droppers.place(i))
            if position <= 0.0 or position >= self.length:
                inside = f"droppers inside the span, between 0 and {self.length:g} m"
                yield Problem(place, position, f"{inside}; number {i + 1} is at {position:g} m")
                if self.droppers.positions is None:
                    break  # one field places them all
                continue
            if position <= previous:
                yield Problem(place, position, f"more than {previous:g} m: droppers stand in ascending order")
            previous = position
