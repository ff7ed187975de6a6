"""The parts in which a long line is drawn: from support to support, all about equally long."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from catenaria.results import FormResult

Mask = NDArray[np.bool_]

MOST = 450.0  # m of line beside each other in one figure
_MOST_WINDOWS = 12


@dataclass(frozen=True)
class Window:
    """A part of a line.

    Attributes
    ----------
    start, end : float
        Chainages [m].
    label : str
        Its first and its last support with their chainages.
    """

    start: float
    end: float
    label: str

    @property
    def extent(self) -> tuple[float, float]:
        """First and last chainage [m]."""
        return self.start, self.end

    def mask(self, x: NDArray[np.float64]) -> Mask:
        """Return which chainages are in it."""
        return (self.start <= x) & (x <= self.end)


def support_places(result: FormResult) -> dict[str, float]:
    """Return the chainages of all supports by name [m]."""
    return dict(zip(result.supports.support, result.supports.chainage.tolist(), strict=True))


def extent(result: FormResult) -> tuple[float, float]:
    """Return the first and the last chainage of any wire [m]."""
    chainages = [wire.profile.chainage for wire in result.wires]
    return min(float(x.min()) for x in chainages), max(float(x.max()) for x in chainages)


def windows(result: FormResult, most: float = MOST) -> list[Window]:
    """Return the parts of a line; inner ones begin and end at supports.

    Parameters
    ----------
    result : FormResult
        The line.
    most : float
        How long a part may be, but for what it takes to reach a support [m].
    """
    start, end = extent(result)
    count = min(max(math.ceil((end - start) / most), 1), _MOST_WINDOWS)
    places = support_places(result)
    at = np.array(sorted(set(places.values())))
    wanted: list[float] = np.linspace(start, end, count + 1)[1:-1].tolist()
    edges = sorted({float(at[np.argmin(np.abs(at - x))]) for x in wanted} - {start, end})
    return [Window(a, b, _label(places, a, b)) for a, b in pairwise([start, *edges, end])]


def _label(places: dict[str, float], start: float, end: float) -> str:
    here = sorted((x, name) for name, x in places.items() if start <= x <= end)
    if len(here) < 2:
        return f"{start:.0f} m to {end:.0f} m"
    (x0, first), (x1, last) = here[0], here[-1]
    return f"{first} to {last}, {x0:.0f} m to {x1:.0f} m"
