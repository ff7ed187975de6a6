"""Wires that run along the whole line."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated, Literal, cast

from annotated_types import Ge, Le
from pydantic import Field, Strict, field_validator
from pydantic_core import PydanticCustomError

from catenaria.line.base import LineModel
from catenaria.line.tension import Tension
from catenaria.units import Length, PositiveLength


class Anchor(LineModel):
    """Where the end of a wire is anchored or tensioned, beyond the first or last support."""

    distance: PositiveLength | None = Field(
        default=None,
        description="Distance from the first or last support, straight on; the wire's tail if left out.",
    )
    height: Length | None = Field(
        default=None, description="Height of the wire's end; as at the first or last support if left out."
    )
    stagger: Length | None = Field(
        default=None,
        description=(
            "Sideways offset of the wire's end, positive to the left; as at the first or last support if "
            "left out."
        ),
    )


def _excess(tensions: Sequence[object]) -> str:
    """Say how many tensions there are beyond the one that the length of the wire can fulfil."""
    more = len(tensions) - 1
    return f"; {more} more than lengths to release" if more > 0 else ""


class Wire(LineModel):
    """A wire along the whole line."""

    conductor: str = Field(description="Name of one of the conductors, or of one of the library.")
    tension: Tension = Field(description="The one tension that is prescribed for this wire.")
    tail: PositiveLength = Field(
        default=0.5, description="How far the wire runs on beyond its first and its last support."
    )
    anchor_start: Anchor | None = Field(
        default=None, description="Where the wire begins, if not level and straight beyond its first support."
    )
    anchor_end: Anchor | None = Field(
        default=None, description="Where the wire ends, if not level and straight beyond its last support."
    )
    wear: Annotated[float, Strict(), Ge(0.0), Le(0.5)] = Field(
        default=0.0,
        description=(
            "Share of the section that is worn off, 0 to 0.5. Area and mass fall with what is left, the "
            "bending stiffness with its square."
        ),
    )

    @field_validator("tension", mode="before")
    @classmethod
    def _one_tension(cls, value: object) -> object:
        """A wire slides over its supports: a second tension finds no length to release."""
        if isinstance(value, list | tuple):
            allowed = f"one tension for a wire, with its force{_excess(cast('Sequence[object]', value))}"
            raise PydanticCustomError("value", "{allowed}", {"allowed": allowed})
        return value


class SecondContactWire(LineModel):
    """A second contact wire beside the first: same conductor, tension, wear and anchors."""

    spacing: PositiveLength = Field(
        default=0.04,
        description=(
            "Distance of the two wires, below 0.5 m. The stagger is that of the middle between them; the "
            "first wire is the left one."
        ),
    )
    droppers: Literal["alternate", "both"] = Field(
        default="alternate",
        description=(
            "alternate: in every span, odd droppers hold the first wire and even ones the second. both: two "
            "droppers at every place, one for each wire."
        ),
    )
