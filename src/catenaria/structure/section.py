"""Cross-sections, given by material and area or by their stiffnesses."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated

from pydantic import Discriminator, Field, Tag

from catenaria.line.base import LineModel
from catenaria.line.conductor import Conductor
from catenaria.units import BendingStiffness, PositiveForce, PositiveMassPerLength


class Stiffnesses(LineModel):
    """A cross-section by its stiffnesses and mass.

    Examples
    --------
    >>> Stiffnesses(EA="15.6 MN", EJ="400 N*m^2", rhoA="0.9252 kg/m").EA
    15600000.0
    """

    EA: PositiveForce = Field(description="Axial stiffness.")
    EJ: BendingStiffness = Field(description="Bending stiffness; 0 for a perfectly flexible cable.")
    rhoA: PositiveMassPerLength = Field(description="Mass per unstressed length.")


def _kind(value: object) -> str:
    stiffnesses = Stiffnesses.model_fields.keys()
    is_stiffnesses = isinstance(value, Stiffnesses) or (
        isinstance(value, Mapping) and not stiffnesses.isdisjoint(value)  # pyright: ignore[reportUnknownArgumentType]
    )
    return "[stiffnesses]" if is_stiffnesses else "[material]"


Section = Annotated[
    Annotated[Conductor, Tag("[material]")] | Annotated[Stiffnesses, Tag("[stiffnesses]")],
    Discriminator(_kind),
]
