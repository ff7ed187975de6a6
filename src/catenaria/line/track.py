"""The track that the line follows."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import Final

from pydantic import Field, model_validator

from catenaria.line.base import LineModel, Problem, refuse
from catenaria.units import Length, NonNegativeLength, PositiveLength, Slope

_LEAST_RADIUS: Final = 100.0  # m
_MOST_CANT: Final = 0.2  # m
_STEEPEST: Final = 0.1
_SPACING: Final = (0.5, 2.0)  # m


class Curve(LineModel):
    """A curve of constant radius between two transitions, in which curvature and cant grow evenly."""

    start: Length = Field(description="Chainage at which the first transition begins.")
    length: PositiveLength = Field(description="Length along the track, transitions included.")
    radius: Length = Field(
        description="Radius of the track axis, at least 100 m; positive for a curve to the left."
    )
    transition: NonNegativeLength = Field(default=0.0, description="Length of each of the two transitions.")
    cant: Length = Field(
        default=0.0,
        description="Height of the outer rail above the inner one, -200 to 200 mm, beyond the transitions.",
    )

    @model_validator(mode="after")
    def _possible(self) -> Curve:
        refuse("Curve", self._problems())
        return self

    def _problems(self) -> Iterator[Problem]:
        if abs(self.radius) < _LEAST_RADIUS:
            allowed = f"at least {_LEAST_RADIUS:g} m, negative for a curve to the right"
            yield Problem(("radius",), self.radius, allowed)
        if 2.0 * self.transition > self.length:
            allowed = f"at most {self.length / 2.0:g} m, half of the curve's length, which includes both"
            yield Problem(("transition",), self.transition, allowed)
        if abs(self.cant) > _MOST_CANT:
            yield Problem(("cant",), self.cant, f"within {_MOST_CANT * 1e3:g} mm")


class Gradient(LineModel):
    """A change of slope."""

    start: Length = Field(description="Chainage from which the slope holds.")
    slope: Slope = Field(
        description="Rise of the track per length in plan, positive upwards with growing chainage."
    )
    rounding: NonNegativeLength = Field(
        default=0.0,
        description=(
            "Length of the parabola, half of it before `start`, over which the slope before becomes this "
            "one. Droppers near a sharp change of slope would have to push the contact wire down."
        ),
    )

    @model_validator(mode="after")
    def _possible(self) -> Gradient:
        if abs(self.slope) > _STEEPEST:
            place = Problem(("slope",), self.slope, f"within {_STEEPEST:g}, as 5 mm/m or 0.005")
            refuse("Gradient", [place])
        return self


class Track(LineModel):
    """Course of the track; straight and level where nothing is said."""

    curves: tuple[Curve, ...] = Field(default=(), description="Curves in order of chainage.")
    gradients: tuple[Gradient, ...] = Field(
        default=(), description="Changes of slope in order of chainage; level before the first one."
    )
    rail_spacing: PositiveLength = Field(
        default=1.5,
        description="Distance between the middles of the rail heads, which turns a cant into an angle.",
    )

    @model_validator(mode="after")
    def _in_order(self) -> Track:
        refuse("Track", self._problems())
        return self

    def _problems(self) -> Iterator[Problem]:
        for i, (before, after) in enumerate(pairwise(self.curves), start=1):
            end = before.start + before.length
            if after.start < end:
                yield Problem(
                    ("curves", i, "start"), after.start, f"{end:g} m or more, where the curve before it ends"
                )
        for i, (first, second) in enumerate(pairwise(self.gradients), start=1):
            if second.start <= first.start:
                yield Problem(
                    ("gradients", i, "start"), second.start, f"more than {first.start:g} m: they ascend"
                )
        low, high = _SPACING
        if self.rail_spacing < low or self.rail_spacing > high:
            yield Problem(("rail_spacing",), self.rail_spacing, f"{low:g} to {high:g} m")
