"""Inverse use of a form that was found: from measured heights to corrected lengths of a few droppers."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.spatial.loaded import with_dropper_lengths
from catenaria.errors import InfeasibleError, NotConvergedError, UnsupportedError
from catenaria.line.measured import MeasuredHeights
from catenaria.loading.adjusted import adjusted_droppers, adjustment, measured_points
from catenaria.loading.adjustment_limits import AdjustmentLimits
from catenaria.loading.built_line import BuiltLine, LoadedLine
from catenaria.loading.by_lengths import Response, respond
from catenaria.loading.choose import Adjustable, Choice
from catenaria.loading.gauged import GaugedPoints, gauged_points
from catenaria.loading.identify import identify
from catenaria.results.adjustment import Adjustment

FloatArray = NDArray[np.float64]

Listener = Callable[[str], None]

_PASSES = 12
_AGREES = 5e-5  # m: predicted heights that are as near to those at rest as this are the same
_ROUNDING = 1e-8  # m: by which heights may leave the tolerance
_SLACK = 1e-6  # N


def adjust(
    built: BuiltLine, measured: MeasuredHeights, limits: AdjustmentLimits, progress: Listener | None = None
) -> Adjustment:
    """Return which droppers of a built line to adjust, and by how much.

    Parameters
    ----------
    built : BuiltLine
        The line as it was to be built.
    measured : MeasuredHeights
        Heights of its contact wires as they are.
    limits : AdjustmentLimits
        What is to be reached.
    progress : callable, optional
        Is told what is being done.

    Raises
    ------
    LineFileError
        If a measured height is of nothing that the line has.
    InfeasibleError
        If more droppers would be needed, or heights cannot come within the tolerance.
    NotConvergedError
        If no lengths explain what was measured, or heights at rest do not agree with predicted ones.
    UnsupportedError
        If droppers are slack by the schedule.

    Notes
    -----
    First, lengths are found that explain the measurement (`identify`). About these, heights and forces are
    linear functions of changes of lengths, and fewest changes are chosen (`Adjustable.fewest`). The line with
    these comes to rest elsewhere by some hundredths of a millimetre; there it is linearised anew, until it is
    where it was predicted.
    """
    tell = progress or _tell_nobody
    if (built.at_rest.dropper_pull <= _SLACK).any():
        raise UnsupportedError("droppers are slack by the schedule, so that lengths cannot be adjusted")
    gauged = gauged_points(built.line, built.model, measured)
    tell("Finding the lengths that explain the measurement")
    height = np.array([row.height for row in measured.rows])
    present = identify(built, gauged, height, limits.noise)
    search = _Search(built, gauged, present, limits)
    step = _Step(np.zeros(present.length.size), present, present.height, built.at_rest)
    for number in range(1, _PASSES + 1):
        tell(f"Choosing droppers, pass {number}")
        choice = search.choose(step)
        step = search.follow(step, choice)
        if search.reached(step):
            points = measured_points(built, gauged, measured, present)
            droppers = adjusted_droppers(built, search.checked, present, step.predicted, step.rest)
            return adjustment(built, limits, points, droppers, choice.fewest, number)
    raise NotConvergedError(
        f"after {_PASSES} linearisations heights at rest come within "
        f"{1e3 * search.largest(step.rest):.3f} mm of the wanted ones, not within "
        f"{1e3 * limits.tolerance:g} mm as predicted",
        "a tolerance that is 0.1 mm wider",
    )


def _tell_nobody(text: str) -> None:
    """Be the listener where there is none."""


@dataclass(frozen=True)
class _Step:
    """A change of lengths, the line with it, and its heights as predicted and at rest."""

    change: FloatArray
    about: Response
    predicted: FloatArray
    rest: LoadedLine


@dataclass(frozen=True)
class _Search:
    built: BuiltLine
    gauged: GaugedPoints
    present: Response
    limits: AdjustmentLimits

    @property
    def checked(self) -> NDArray[np.bool_]:
        """Mask of the droppers that hold contact wires."""
        wires = self.built.model.layout.wires
        contact = np.array([wire.role == "contact wire" for wire in wires], dtype=np.bool_)
        return contact[self.built.model.layout.droppers.lower]

    def choose(self, step: _Step) -> Choice:
        """Return the fewest changes in the line as it is linear about a step."""
        limits, about, only = self.limits, step.about, self.checked
        deviation = (about.height - self.built.at_rest.height)[only]
        least = np.full(about.pull.size, limits.least_force)
        slopes = about.height_slope[only], about.pull_slope
        zero = Adjustable(
            deviation, slopes[0], about.pull, slopes[1], least, limits.step, limits.largest_change
        )
        options = zero.about(deviation, about.pull, step.change)
        choice = options.fewest(limits.tolerance)
        if choice is None or (limits.at_most is not None and choice.count > limits.at_most):
            raise InfeasibleError(_refusal(options, limits, choice))
        return choice

    def follow(self, step: _Step, choice: Choice) -> _Step:
        """Return the line with changed lengths."""
        further = choice.change - step.change
        about = respond(self.built, self.gauged, self.present.length + choice.change, step.about)
        model = with_dropper_lengths(self.built.model, about.length)
        rest = self.built.under(model=model, z=about.z, factors=about.factors)
        return _Step(choice.change, about, step.about.height + step.about.height_slope @ further, rest)

    def reached(self, step: _Step) -> bool:
        """Return whether the line is where it was predicted, and that within the tolerance."""
        agrees = float(np.abs(step.predicted - step.rest.height).max()) <= _AGREES
        return agrees and self.largest(step.rest) <= self.limits.tolerance + _ROUNDING

    def largest(self, rest: LoadedLine) -> float:
        """Return the largest deviation from the wanted heights [m]."""
        return float(np.abs(rest.height - self.built.at_rest.height)[self.checked].max(initial=0.0))


def _refusal(options: Adjustable, limits: AdjustmentLimits, choice: Choice | None) -> str:
    """Say what would do: more droppers, or which tolerance."""
    wish = f"within {1e3 * limits.tolerance:g} mm"
    force = f" and leave {limits.least_force:g} N in every dropper" if limits.least_force > 0.0 else ""
    change = f"by up to {1e3 * limits.largest_change:g} mm in steps of {1e3 * limits.step:g} mm"
    at_most = options.count if limits.at_most is None else limits.at_most
    best = options.best_tolerance(at_most)
    reach = (
        ""
        if best is None
        else f"; the best that was found for {at_most} is {math.ceil(1e4 * best) / 10:.1f} mm"
    )
    if choice is None:
        return f"no changes of dropper lengths {change} bring all heights {wish}{force}{reach}"
    sure = "" if choice.fewest == choice.count else f" (fewer than {choice.fewest} would not)"
    return (
        f"at most {at_most} changes of dropper lengths {change} do not bring all heights {wish}{force}: "
        f"{choice.count} droppers would do{sure}{reach}"
    )
