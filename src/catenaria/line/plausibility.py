"""What no overhead line is built of: values that are numbers of the right kind and still slips of the pen.

The bounds are far beyond every line that is built; what they catch are forgotten prefixes (``area: 120``) and
heights counted from another level.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Final

from catenaria.line.base import Path, Problem

if TYPE_CHECKING:
    from catenaria.line.conductor import Conductor
    from catenaria.line.line import Line

_ROOM: Final = 0.2  # m from a wanted height up to the line between the messenger's supports
_FARTHEST: Final = 0.5  # m from the line between the contact wire's supports to a wanted height
_ROUNDING: Final = 1e-9  # m
_STRAIN: Final = (1e-5, 0.02)  # T/EA; about 1e-3 in wires that are built


@dataclass(frozen=True)
class _Range:
    """Where a quantity of real lines lies, in SI, and usual units: the most easily forgotten one first."""

    low: float
    high: float
    unit: str
    usual: tuple[tuple[str, float], ...]

    def holds(self, value: float) -> bool:
        """Tell whether a value is plausible; one that is unknown (NaN) is."""
        return not (value < self.low or value > self.high)

    def allowed(self, value: float) -> str:
        """Say what is plausible, and which unit was probably meant."""
        unit, size = self.usual[0]
        text = f"a plausible value, {self.low / size:g} to {self.high / size:g} {unit}"
        meant = [f"{value:g} {unit}" for unit, size in self.usual if self.holds(value * size)]
        return f"{text}; this is {value:g} {self.unit}" + (f", did you mean {meant[0]}?" if meant else "")


_AREA: Final = _Range(1e-7, 1e-2, "m^2", (("mm^2", 1e-6), ("cm^2", 1e-4)))
_MODULUS: Final = _Range(1e8, 2e12, "Pa", (("GPa", 1e9), ("MPa", 1e6)))
_DENSITY: Final = _Range(100.0, 50e3, "kg/m^3", (("g/cm^3", 1e3),))
_MASS: Final = _Range(0.005, 50.0, "kg/m", (("kg/km", 1e-3),))


def implausible_conductors(line: Line) -> Iterator[Problem]:
    """Find conductors of a size, stiffness or weight that no wire has."""
    for name, conductor in line.conductors.items():
        for field, value, plausible in _quantities(conductor):
            if not plausible.holds(value):
                yield Problem(("conductors", name, field), value, plausible.allowed(value))


def implausible_tensions(line: Line) -> Iterator[Problem]:
    """Find tensions that would stretch a wire far more, or far less, than any wire is stretched."""
    for field, wire in (("contact_wire", line.contact_wire), ("messenger_wire", line.messenger_wire)):
        conductor = line.conductors.get(wire.conductor)
        if conductor is None or not all(r.holds(value) for _, value, r in _quantities(conductor)):
            continue  # the conductor is at fault
        low, high = (strain * conductor.EA for strain in _STRAIN)
        force = _Range(float(f"{low:.2g}"), float(f"{high:.2g}"), "N", (("kN", 1e3),))
        if not force.holds(wire.tension.force):
            why = f"{force.allowed(wire.tension.force)} (EA is {conductor.EA / 1e6:.4g} MN)"
            yield Problem((field, "tension", "force"), wire.tension.force, why)


def implausible_heights(line: Line) -> Iterator[Problem]:
    """Find wanted heights far from where the contact wire is held, or near the messenger's supports."""
    supports = list(enumerate(zip(line.support_x, line.supports, strict=False)))
    held = [(x, support.contact_wire.height) for _, (x, support) in supports if support.contact_wire]
    low = dict(_low_supports(line, [_between(held, x) for x in line.support_x]))
    for i, least in low.items():
        allowed = f"{least:g} m or more, {_ROOM:g} m above the wanted height of the contact wire beside it"
        path: Path = ("supports", i, "messenger_wire", "height")
        yield Problem(path, line.supports[i].messenger_height, allowed)
    hung = [(x, math.nan if i in low else support.messenger_height) for i, (x, support) in supports]
    for i, (start, span) in enumerate(zip(line.support_x, line.spans, strict=False)):
        listed = isinstance(span.contact_wire_height, tuple)
        found: dict[Path, Problem] = {}  # a height that is given once for all droppers is one problem
        for j, (x, height) in enumerate(zip(span.droppers.x, span.heights, strict=False)):
            allowed = _allowed_height(height, _between(held, start + x), _between(hung, start + x))
            path = ("spans", i, "contact_wire_height", *((j,) if listed else ()))
            if allowed:
                found.setdefault(path, Problem(path, height, allowed))
        yield from found.values()


def _allowed_height(height: float, level: float, ceiling: float) -> str:
    """Say which height is plausible between wires that are held at two heights; empty if this one is."""
    if abs(height - level) > _FARTHEST + _ROUNDING:
        return f"within {_FARTHEST:g} m of {level:g} m, the line between the supports of the contact wire"
    if height > ceiling - _ROOM + _ROUNDING:
        return f"{_ROOM:g} m or more below {ceiling:g} m, the line between the supports of the messenger wire"
    return ""


def _low_supports(line: Line, levels: Sequence[float]) -> Iterator[tuple[int, float]]:
    """Find messenger supports that are too low where the contact wire passes freely, and the least height.

    A wanted height that is itself far from the level of the contact wire says nothing about a support.
    """
    for i, (support, level) in enumerate(zip(line.supports, levels, strict=False)):
        left = line.spans[i - 1].heights[-1:] if 0 < i <= len(line.spans) else ()
        right = line.spans[i].heights[:1] if i < len(line.spans) else ()
        near = [height for height in left + right if not abs(height - level) > _FARTHEST + _ROUNDING]
        least = max(near, default=-math.inf) + _ROOM
        if support.contact_wire is None and support.messenger_height < least - _ROUNDING:
            yield i, least


def _between(points: Sequence[tuple[float, float]], x: float) -> float:
    """Interpolate; NaN, which compares with nothing, where a neighbour is missing or unknown."""
    for (x0, z0), (x1, z1) in pairwise(points):
        if x0 <= x <= x1:
            return z0 + (z1 - z0) * (x - x0) / (x1 - x0)
    return math.nan


def _quantities(conductor: Conductor) -> Iterator[tuple[str, float, _Range]]:
    yield "area", conductor.area, _AREA
    yield "youngs_modulus", conductor.youngs_modulus, _MODULUS
    if conductor.density is not None:
        yield "density", conductor.density, _DENSITY
    if conductor.mass_per_length is not None:
        yield "mass_per_length", conductor.mass_per_length, _MASS
