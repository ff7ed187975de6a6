"""Spans: the line from one support to the next, with its droppers."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated

from annotated_types import Ge, Le
from pydantic import Discriminator, Field, Strict, Tag, model_validator

from catenaria.line.base import LineModel, Path, Problem, refuse
from catenaria.line.dropper import Droppers
from catenaria.units import Length, PositiveLength


def _one_or_list(value: object) -> str:
    return "[list]" if isinstance(value, list | tuple) else "[one]"


def _none_one_or_list(value: object) -> str:
    return "[none]" if value is None else _one_or_list(value)


# An ordinary union would report every wrong height twice, once for each of its members.
One = Annotated[Length, Tag("[one]")]
Listed = Annotated[tuple[Length, ...], Tag("[list]")]
Heights = Annotated[One | Listed, Discriminator(_one_or_list)]
OptionalHeights = Annotated[One | Listed | Annotated[None, Tag("[none]")], Discriminator(_none_one_or_list)]


class AuxiliarySpan(LineModel):
    """Droppers between the messenger wire and the auxiliary messenger, and where they hold the latter."""

    droppers: Droppers = Field(description="Where the droppers hang.")
    height: Heights = Field(
        description="Wanted height of the auxiliary messenger at them: one, or a list with one for each."
    )

    @property
    def heights(self) -> tuple[float, ...]:
        """Wanted heights of the auxiliary messenger [m]; in a line there is one for each dropper."""
        return self.height if isinstance(self.height, tuple) else (self.height,) * len(self.droppers.x)


class Span(LineModel):
    """From one support to the next.

    Examples
    --------
    >>> span = Span(length=65, droppers=Droppers(positions=(4, 32.5, 61)), pre_sag_per_mille=1)
    >>> span.sag
    0.065
    """

    length: PositiveLength = Field(description="Distance between the two supports along the track.")
    droppers: Droppers = Field(
        default=Droppers(positions=()), description="Where the droppers hang; none if left out."
    )
    contact_wire_height: OptionalHeights = Field(
        default=None,
        description=(
            "Wanted height of the contact wire at the droppers: one, or a list with one for each. If left "
            "out, on the line between the nearest supports that hold the contact wire."
        ),
    )
    pre_sag: Length = Field(
        default=0.0,
        description=(
            "Depth of a parabola by which the contact wire is wanted lower, zero at the first and the last "
            "dropper."
        ),
    )
    pre_sag_per_mille: Annotated[float, Strict(), Ge(-10.0), Le(10.0)] | None = Field(
        default=None, description="The same depth in thousandths of the span's length: this or pre_sag."
    )
    auxiliary: AuxiliarySpan | None = Field(
        default=None,
        description="The droppers of the auxiliary messenger, in a line that has one.",
    )

    @property
    def sag(self) -> float:
        """Depth of the parabola [m]."""
        if self.pre_sag_per_mille is None:
            return self.pre_sag
        return self.pre_sag_per_mille * self.length / 1000.0

    @model_validator(mode="after")
    def _droppers_fit(self) -> Span:
        refuse("Span", self._problems())
        return self

    def _problems(self) -> Iterator[Problem]:
        yield from _misplaced(self.droppers, self.length, ("droppers",))
        if self.auxiliary is not None:
            yield from _misplaced(self.auxiliary.droppers, self.length, ("auxiliary", "droppers"))
        yield from self._sag_problems()

    def _sag_problems(self) -> Iterator[Problem]:
        field = "pre_sag" if self.pre_sag_per_mille is None else "pre_sag_per_mille"
        if self.pre_sag_per_mille is not None and self.pre_sag != 0.0:
            yield Problem((field,), self.pre_sag_per_mille, "this or pre_sag, not both")
        elif self.sag != 0.0 and isinstance(self.contact_wire_height, tuple):
            yield Problem((field,), self.sag, "0: a height for each dropper already says how the wire sags")
        elif self.sag != 0.0 and len(self.droppers.x) < 3:
            yield Problem((field,), self.sag, "0: with less than three droppers there is none that sags")


def _misplaced(droppers: Droppers, length: float, field: Path) -> Iterator[Problem]:
    """Find droppers that are outside their span, or not in order."""
    previous = 0.0  # of those inside the span: one position at fault says nothing about its neighbours
    for i, position in enumerate(droppers.x):
        place = (*field, *droppers.place(i))
        if position <= 0.0 or position >= length:
            inside = f"droppers inside the span, between 0 and {length:g} m"
            yield Problem(place, position, f"{inside}; number {i + 1} is at {position:g} m")
            if droppers.positions is None:
                break  # one field places them all
            continue
        if position <= previous:
            yield Problem(place, position, f"more than {previous:g} m: droppers stand in ascending order")
        previous = position
