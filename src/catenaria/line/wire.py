"""Wires that run along the line and how they are tensioned."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, cast

from pydantic import Field, field_validator
from pydantic_core import PydanticCustomError

from catenaria.line.base import LineModel
from catenaria.units import Length, PositiveForce, PositiveLength


class Tension(LineModel):
    """The prescribed tension of a wire and where it is measured."""

    force: PositiveForce = Field(description="The wanted tension.")
    measure: Literal["reaction", "strain"] = Field(
        default="reaction",
        description=(
            "reaction: the force with which the tensioning device at the wire's end reacts; right on any "
            "mesh. strain: the axial force (11) of Yang et al. 2017 at the end support; depends on the mesh."
        ),
    )
    at: Literal["start", "end"] = Field(
        default="end", description="The end of the wire at which it is measured."
    )
    pulled: Literal["both", "start", "end"] = Field(
        default="both",
        description="Which ends are pulled; the other is fixed. Only both is solved yet.",
    )


def _excess(tensions: Sequence[object]) -> str:
    """Say how many tensions there are beyond the one that the length of the wire can fulfil."""
    more = len(tensions) - 1
    return f"; {more} more than lengths to release" if more > 0 else ""


class Wire(LineModel):
    """A wire along the whole line."""

    conductor: str = Field(description="Name of one of the conductors.")
    tension: Tension = Field(description="The one tension that is prescribed for this wire.")
    tail: PositiveLength = Field(
        default=0.5, description="How far the wire runs on beyond its first and its last support."
    )

    @field_validator("tension", mode="before")
    @classmethod
    def _one_tension(cls, value: object) -> object:
        """A wire slides over its supports: a second tension finds no length to release."""
        if isinstance(value, list | tuple):
            allowed = f"one tension for a wire, with its force{_excess(cast('Sequence[object]', value))}"
            raise PydanticCustomError("value", "{allowed}", {"allowed": allowed})
        return value


class OtherWire(LineModel):
    """A wire besides contact and messenger wire. It can be described; it is not solved yet."""

    name: str = Field(description="What the wire is called in the results.")
    kind: Literal["stitch", "auxiliary messenger", "contact", "messenger", "Z"] = Field(
        description="What the wire is for."
    )
    conductor: str = Field(description="Name of one of the conductors.")
    start: Length = Field(description="Chainage at which the wire begins.")
    end: Length = Field(description="Chainage at which the wire ends.")
    tension: Tension | None = Field(default=None, description="The prescribed tension; a Z wire has none.")
