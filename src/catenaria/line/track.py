"""The track that the line follows. Only a straight and level one is solved yet."""

from __future__ import annotations

from pydantic import Field

from catenaria.line.base import LineModel
from catenaria.units import Length, NonNegativeLength, PositiveLength, Slope


class Curve(LineModel):
    """A curve of constant radius between two transitions."""

    start: Length = Field(description="Chainage at which the first transition begins.")
    length: PositiveLength = Field(description="Length along the track, transitions included.")
    radius: Length = Field(description="Radius of the track axis, positive for a curve to the left.")
    transition: NonNegativeLength = Field(default=0.0, description="Length of each of the two transitions.")
    cant: Length = Field(default=0.0, description="Height of the outer rail above the inner one.")


class Gradient(LineModel):
    """A change of slope."""

    start: Length = Field(description="Chainage from which the slope holds.")
    slope: Slope = Field(description="Rise of the track per length, positive upwards with growing chainage.")


class Track(LineModel):
    """Course of the track; straight and level where nothing is said."""

    curves: tuple[Curve, ...] = Field(default=(), description="Curves in order of chainage. Not solved yet.")
    gradients: tuple[Gradient, ...] = Field(
        default=(), description="Changes of slope in order of chainage. Not solved yet."
    )
