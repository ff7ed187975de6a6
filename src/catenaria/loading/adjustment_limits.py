"""What an adjustment of dropper lengths shall reach, and what it may do."""

from __future__ import annotations

import math
from dataclasses import dataclass

from catenaria.errors import InconsistentInputError


@dataclass(frozen=True)
class AdjustmentLimits:
    """What an adjustment shall reach, and what it may do.

    Attributes
    ----------
    tolerance : float
        Largest deviation of a contact wire from its wanted height at droppers [m].
    step : float
        Changes of lengths are multiples of it [m].
    at_most : int, optional
        How many droppers may be adjusted; any number if left out.
    noise : float
        Standard deviation of the measurement [m].
    least_force : float
        What every dropper shall bear afterwards [N].
    largest_change : float
        No dropper is changed by more [m].
    """

    tolerance: float = 0.005
    step: float = 0.005
    at_most: int | None = None
    noise: float = 0.0
    least_force: float = 0.0
    largest_change: float = 0.1

    def __post_init__(self) -> None:
        positive = {"tolerance": self.tolerance, "step": self.step, "largest change": self.largest_change}
        for name, value in positive.items():
            if not 0.0 < value < math.inf:
                raise InconsistentInputError(f"the {name} of an adjustment must be positive, not {value:g} m")
        for name, value in {"noise": self.noise, "least force": self.least_force}.items():
            if not 0.0 <= value < math.inf:
                raise InconsistentInputError(f"the {name} of an adjustment must not be negative ({value:g})")
        if self.at_most is not None and self.at_most < 0:
            raise InconsistentInputError(f"at most {self.at_most} droppers cannot be adjusted; 0 or more can")
        if self.largest_change < self.step:
            raise InconsistentInputError("the largest change of a dropper must not be less than the step")
