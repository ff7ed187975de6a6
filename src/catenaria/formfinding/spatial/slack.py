"""Which droppers hang slack, where they may: decided between one rest and the next, whatever finds them."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.spatial.demands import heights
from catenaria.discretise.spatial.model import SpatialModel
from catenaria.errors import InfeasibleError, NotConvergedError

FloatArray = NDArray[np.float64]
Mask = NDArray[np.bool_]
R = TypeVar("R")

_NOTHING = 1e-6  # N/m by which a dropper may push


def with_slack(
    model: SpatialModel,
    find: Callable[[Mask, R | None], R],
    unknowns: Callable[[R], FloatArray],
    level: float,
) -> list[R]:
    """Return all rests on the way to one in which no dropper pushes, the last one last.

    Parameters
    ----------
    model : SpatialModel
        The line. If none of its droppers may be slack, there is one rest.
    find : callable
        Returns the rest in which the droppers of a mask, shape (n_droppers,), carry nothing, from the rest
        before, if there is one.
    unknowns : callable
        Returns the unknowns of a rest.
    level : float
        How far below its wanted height the wire of a slack dropper may be [m].

    Raises
    ------
    NotConvergedError
        If one set of slack droppers leads to another, and back; `partial` is the last rest.
    InfeasibleError
        If all of them would be slack.
    """
    slack = np.zeros(model.length.size, dtype=np.bool_)
    found, seen = [find(slack, None)], {slack.tobytes()}
    while model.layout.droppers.may_be_slack:
        before, slack = slack, _slack(model, unknowns(found[-1]), slack, level)
        if np.array_equal(slack, before):
            break
        if slack.all():
            raise InfeasibleError(
                "every dropper would hang slack: a smaller pre-sag or less tension would help"
            )
        if slack.tobytes() in seen:
            raise NotConvergedError(
                "it is not decided which droppers hang slack: one set of them leads to another, and back",
                "wanted heights that every dropper can pull up to",
                found[-1],
            )
        seen.add(slack.tobytes())
        found.append(find(slack, found[-1]))
    return found


def _slack(model: SpatialModel, z: FloatArray, slack: Mask, level: float) -> Mask:
    """Return which droppers would push, and which of the slack ones have a wire that is high enough."""
    high = heights(model, z).value(0.0, z) > model.layout.droppers.height - level
    return np.where(slack, high, z[model.density] < -_NOTHING)
