"""Rules: limits, where they are from, and the file that they stand in."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import Annotated, Final, Generic, Literal, TypeVar

from annotated_types import Ge, Le
from pydantic import Field, Strict, model_validator

from catenaria.line.base import LineModel, Problem, refuse
from catenaria.line.load import load_model
from catenaria.line.load_units import Force, TrainSpeed
from catenaria.units import NonNegativeLength, Slope

STANDARD: Final = Path(__file__).with_name("rules.yaml")

Share = Annotated[float, Strict(), Ge(0.0), Le(10.0)]
Quantity = TypeVar("Quantity", bound=float)


class Step(LineModel, Generic[Quantity]):
    """The limit for speeds up to one."""

    up_to: TrainSpeed | None = Field(
        default=None, description="Highest speed that it holds for; any speed if left out."
    )
    limit: Quantity = Field(description="The limit for these speeds.")


class Rule(LineModel, Generic[Quantity]):
    """A limit and where it is from."""

    id: str = Field(description="What the rule is called in reports.")
    source: str = Field(default="", description="Where the limit is from.")
    status: Literal["read", "recalled", "derived"] = Field(
        default="read",
        description="Whether the source was read, or recalled from memory, or follows from a formula.",
    )
    limit: Quantity | None = Field(default=None, description="The limit, whatever the speed.")
    by_speed: tuple[Step[Quantity], ...] = Field(
        default=(), description="Limits by speed in ascending order, instead of limit."
    )

    @model_validator(mode="after")
    def _possible(self) -> Rule[Quantity]:
        refuse("Rule", self._problems())
        return self

    def _problems(self) -> Iterator[Problem]:
        if self.limit is not None and self.by_speed:
            yield Problem(("limit",), self.limit, "this or by_speed, not both")
        for i, (before, after) in enumerate(pairwise(self.by_speed), start=1):
            if before.up_to is None:
                yield Problem(("by_speed", i), after.up_to, "nothing after an entry without up_to")
            elif after.up_to is not None and after.up_to <= before.up_to:
                allowed = f"more than {3.6 * before.up_to:g} km/h, the speed of the entry before it"
                yield Problem(("by_speed", i, "up_to"), after.up_to, allowed)

    def at(self, speed: float | None) -> Quantity | str:
        """Return the limit at a speed [m/s], or why there is none.

        Examples
        --------
        >>> rules = load_rules()
        >>> rules.gradient.at(200 / 3.6)
        0.002
        >>> rules.gradient.at(None)
        'the limit depends on the speed: give speed in the line file, or --speed'
        """
        if self.limit is not None:
            return self.limit
        if not self.by_speed:
            return "these rules name no limit"
        if speed is None:
            return "the limit depends on the speed: give speed in the line file, or --speed"
        for step in self.by_speed:
            # 200 km/h are not a whole number of m/s: what was read as equal shall be equal
            if step.up_to is None or speed <= step.up_to * (1.0 + 1e-12):
                return step.limit
        return f"these rules name no limit for {3.6 * speed:g} km/h"


class Rules(LineModel):
    """A set of rules; what is left out is not judged."""

    format: Literal[1] = Field(description="Version of this file format: 1.")
    name: str = Field(default="", description="What the set is called in reports.")
    gradient: Rule[Slope] | None = Field(
        default=None, description="Largest gradient of the contact wire between supports."
    )
    gradient_change: Rule[Slope] | None = Field(
        default=None, description="Largest change of that gradient at a support."
    )
    gradient_at_droppers: Rule[Slope] | None = Field(
        default=None, description="Largest gradient between neighbouring droppers, pre-sag included."
    )
    gradient_change_at_droppers: Rule[Slope] | None = Field(
        default=None, description="Largest change of that gradient at a dropper."
    )
    height_at_droppers: Rule[NonNegativeLength] | None = Field(
        default=None, description="Largest deviation from the wanted height at a dropper."
    )
    dropper_length: Rule[NonNegativeLength] | None = Field(
        default=None, description="Least length of a dropper, from wire axis to wire axis."
    )
    hanger_length: Rule[NonNegativeLength] | None = Field(
        default=None, description="Least length of a hanger between auxiliary messenger and contact wire."
    )
    dropper_spacing: Rule[NonNegativeLength] | None = Field(
        default=None, description="Largest distance of neighbouring droppers in a span."
    )
    dropper_force: Rule[Force] | None = Field(
        default=None, description="What the force of every dropper on the contact wire must exceed."
    )
    wave_speed: Rule[Share] | None = Field(
        default=None, description="Largest speed as a share of the contact wire's wave speed."
    )
    radial_pull: Rule[Force] | None = Field(
        default=None, description="Least force across the track with which a wire holds a steady arm."
    )
    lateral_position: Rule[NonNegativeLength] | None = Field(
        default=None,
        description="Largest distance of the contact wire from the middle of the track, with wind too.",
    )
    tension_variation: Rule[Share] | None = Field(
        default=None, description="Largest departure from the wanted tension along a wire, as a share."
    )
    nonuniformity: Rule[Share] | None = Field(
        default=None, description="Largest non-uniformity of elasticity, as a share."
    )


def load_rules(file: str | Path | None = None) -> Rules:
    """Read a file of rules.

    Parameters
    ----------
    file : path, optional
        By default the rules that are part of catenaria.

    Raises
    ------
    LineFileError
        With one fault for each thing that is wrong.
    """
    return _standard() if file is None else load_model(file, Rules)


@cache
def _standard() -> Rules:
    """Return the rules of catenaria, which do not change: reading them takes as long as judging by them."""
    return load_model(STANDARD, Rules)
