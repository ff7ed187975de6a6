"""Dropper lengths as they can be cut, and the heights that follow."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.spatial.loaded import with_dropper_lengths
from catenaria.errors import InconsistentInputError
from catenaria.line import Line
from catenaria.loading.built_line import BuiltLine
from catenaria.loading.contact import in_role
from catenaria.numerics.rounding import rounded_half_up
from catenaria.results.form import FormResult
from catenaria.results.rounding import RoundedLine, RoundingStudy

FloatArray = NDArray[np.float64]


def round_droppers(line: Line, result: FormResult, steps: Sequence[float]) -> RoundingStudy:
    """Return a found line at rest with its dropper lengths rounded.

    Parameters
    ----------
    line, result
        The line and where it was found.
    steps : sequence of float
        Steps [m].

    Raises
    ------
    InconsistentInputError
        If a step is not positive, or so large that nothing is left of a dropper.
    NotConvergedError, InfeasibleError
        If the line does not come to rest.
    """
    built = BuiltLine.of(line, result)
    layout, droppers = built.model.layout, built.model.layout.droppers
    return RoundingStudy(
        line.name,
        droppers.span,
        droppers.number,
        droppers.frame.chainage,
        in_role(layout, droppers.lower, "contact wire"),
        result.droppers.cut_length,
        droppers.height,
        dict(zip((support.name for support in line.supports), line.support_x, strict=True)),
        tuple(_rounded(built, step) for step in steps),
    )


def _rounded(built: BuiltLine, step: float) -> RoundedLine:
    found = built.result.droppers
    if not step > 0.0:
        raise InconsistentInputError(f"dropper lengths are rounded to a step above 0 m, not to {step:g} m")
    length = rounded_half_up(found.cut_length, step)
    change = length - found.cut_length
    if not np.all(length > 0.0):
        raise InconsistentInputError(
            f"rounded to {step:g} m, nothing is left of a dropper that is cut to {found.cut_length.min():g} m"
        )
    model = with_dropper_lengths(built.model, found.unstressed_length + change)
    rest = built.under(model=model, factors=built.factors)
    height = rest.height
    return RoundedLine(
        step,
        length,
        change,
        height,
        height - built.at_rest.height,
        height - built.model.layout.droppers.height,
        rest.dropper_pull,
    )
