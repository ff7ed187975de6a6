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
from catenaria.line.profile import between, held_heights, wanted_heights

if TYPE_CHECKING:
    from catenaria.line.conductor import Conductor
    from catenaria.line.line import Line
    from catenaria.line.span import Span
    from catenaria.line.tied_wire import MidPoint, StitchWire
    from catenaria.line.wire import Wire

_ROOM: Final = 0.2  # m from a wanted height up to the line between the messenger's supports
_FARTHEST: Final = 0.5  # m from the line between the contact wire's supports to a wanted height
_LIFTED: Final = 1.5  # m between the heights of the contact wire at neighbouring supports that hold it
_TALLEST: Final = 20.0  # m from the rails to a contact wire
_DEEPEST: Final = 200.0  # m from a contact wire to the support of its messenger wire
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
    """Find conductors and cantilevers of a size, stiffness or weight that nothing of the kind has."""
    found: list[tuple[Path, Conductor]] = [(("conductors", n), c) for n, c in line.conductors.items()]
    for i, support in enumerate(line.supports):
        if support.messenger_wire.cantilever is not None:
            path = ("supports", i, "messenger_wire", "cantilever")
            found.append((path, support.messenger_wire.cantilever))
    for path, conductor in found:
        for field, value, plausible in _quantities(conductor):
            if not plausible.holds(value):
                yield Problem((*path, field), value, plausible.allowed(value))


def implausible_tensions(line: Line) -> Iterator[Problem]:
    """Find tensions that would stretch a wire far more, or far less, than any wire is stretched."""
    for path, name, tension in _tensions(line):
        conductor = line.conductors.get(name)
        if conductor is None or not all(r.holds(value) for _, value, r in _quantities(conductor)):
            continue  # the conductor is at fault
        low, high = (strain * conductor.EA for strain in _STRAIN)
        force = _Range(float(f"{low:.2g}"), float(f"{high:.2g}"), "N", (("kN", 1e3),))
        if not force.holds(tension):
            why = f"{force.allowed(tension)} (EA is {conductor.EA / 1e6:.4g} MN)"
            yield Problem(path, tension, why)


def _tensions(line: Line) -> Iterator[tuple[Path, str, float]]:
    """Yield where the tension of every wire stands, the name of its conductor, and the tension."""
    for field in ("contact_wire", "messenger_wire", "auxiliary_messenger"):
        wire: Wire | None = getattr(line, field)
        if wire is not None:
            yield (field, "tension", "force"), wire.conductor, wire.tension.force
    for field in ("stitch_wire", "mid_point"):
        tied: StitchWire | MidPoint | None = getattr(line, field)
        if tied is not None:
            yield (field, "tension"), tied.conductor, tied.tension


def implausible_heights(line: Line) -> Iterator[Problem]:
    """Find wanted heights far from where the contact wire is held, or near the messenger's supports."""
    held, wanted = held_heights(line), wanted_heights(line)
    yield from _far_up(line)
    yield from _lifted(line, held)
    low = dict(_low_supports(line, wanted))
    for i, least in low.items():
        allowed = f"{least:g} m or more, {_ROOM:g} m above the wanted height of the contact wire beside it"
        path: Path = ("supports", i, "messenger_wire", "height")
        yield Problem(path, line.supports[i].messenger_height, allowed)
    places = enumerate(zip(line.support_x, line.supports, strict=False))
    hung = [(x, math.nan if i in low else support.messenger_height) for i, (x, support) in places]
    for i, (start, span) in enumerate(zip(line.support_x, line.spans, strict=False)):
        found: dict[Path, Problem] = {}  # a height that is given once for all droppers is one problem
        for j, (x, height) in enumerate(zip(span.droppers.x, wanted[i], strict=False)):
            allowed = _allowed_height(height, between(held, start + x), between(hung, start + x))
            path = ("spans", i, *_field(span, j))
            if allowed:
                found.setdefault(path, Problem(path, height, allowed))
        yield from found.values()


def _field(span: Span, dropper: int) -> Path:
    """Return the field that says how high the contact wire is wanted at a dropper."""
    if isinstance(span.contact_wire_height, tuple):
        return ("contact_wire_height", dropper)
    if span.contact_wire_height is None and span.sag != 0.0:
        return ("pre_sag",) if span.pre_sag_per_mille is None else ("pre_sag_per_mille",)
    return ("contact_wire_height",)


def implausible_sags(line: Line) -> Iterator[Problem]:
    """Find pre-sags that are deeper than the contact wire hangs by itself, so that droppers would push it.

    Notes
    -----
    Between droppers a part of the wire's weight w per length is carried by its tension T: 8 D T/L^2 under a
    parabola of depth D over the length L. The droppers carry the rest.
    """
    conductor = line.conductors.get(line.contact_wire.conductor)
    if conductor is None:
        return
    weight = line.gravity * conductor.rhoA * (1.0 - line.contact_wire.wear)
    for i, span in enumerate(line.spans):
        if span.sag > 0.0 and len(span.droppers.x) > 1:
            length = span.droppers.x[-1] - span.droppers.x[0]
            most = weight * length**2 / (8.0 * line.contact_wire.tension.on_wire)
            if span.sag > most:
                field, depth = "pre_sag", f"{most * 1e3:.3g} mm"
                if span.pre_sag_per_mille is not None:
                    field, depth = "pre_sag_per_mille", f"{most / span.length * 1e3:.3g} per mille"
                allowed = f"a pre-sag of at most {depth}: a deeper one needs droppers that push"
                yield Problem(("spans", i, field), span.sag, allowed)


def _far_up(line: Line) -> Iterator[Problem]:
    """Find contact wires far from the rails, and messenger wires far above them: millimetres as metres."""
    for i, (support, level) in enumerate(zip(line.supports, line.contact_heights, strict=False)):
        if support.contact_wire is not None and abs(support.contact_wire.height) > _TALLEST:
            path: Path = ("supports", i, "contact_wire", "height")
            yield Problem(path, support.contact_wire.height, f"within {_TALLEST:g} m of the rails, as 5.3 m")
        elif support.messenger_height - level > _DEEPEST + _ROUNDING:
            field = "height" if support.messenger_wire.encumbrance is None else "encumbrance"
            allowed = f"at most {_DEEPEST:g} m above the contact wire, which is at {level:g} m there"
            found = getattr(support.messenger_wire, field)
            yield Problem(("supports", i, "messenger_wire", field), found, allowed)


def _lifted(line: Line, held: Sequence[tuple[float, float]]) -> Iterator[Problem]:
    """Find supports that hold the contact wire much higher or lower than the one before."""
    indices = line.contact_support_indices
    for i, ((_, before), (_, height)) in zip(indices[1:], pairwise(held), strict=False):
        if abs(height - before) > _LIFTED + _ROUNDING:
            allowed = f"within {_LIFTED:g} m of {before:g} m, the height where it is held before"
            yield Problem(("supports", i, "contact_wire", "height"), height, allowed)


def _allowed_height(height: float, level: float, ceiling: float) -> str:
    """Say which height is plausible between wires that are held at two heights; empty if this one is."""
    if abs(height - level) > _FARTHEST + _ROUNDING:
        return f"within {_FARTHEST:g} m of {level:g} m, the line between the supports of the contact wire"
    if height > ceiling - _ROOM + _ROUNDING:
        return f"{_ROOM:g} m or more below {ceiling:g} m, the line between the supports of the messenger wire"
    return ""


def _low_supports(line: Line, wanted: Sequence[tuple[float, ...]]) -> Iterator[tuple[int, float]]:
    """Find messenger supports that are too low where the contact wire passes freely, and the least height.

    A wanted height that is itself far from the level of the contact wire says nothing about a support.
    """
    for i, (support, level) in enumerate(zip(line.supports, line.contact_heights, strict=False)):
        left = wanted[i - 1][-1:] if 0 < i <= len(wanted) else ()
        right = wanted[i][:1] if i < len(wanted) else ()
        near = [height for height in left + right if not abs(height - level) > _FARTHEST + _ROUNDING]
        least = max(near, default=-math.inf) + _ROOM
        if support.contact_wire is None and support.messenger_height < least - _ROUNDING:
            yield i, least


def _quantities(conductor: Conductor) -> Iterator[tuple[str, float, _Range]]:
    yield "area", conductor.area, _AREA
    yield "youngs_modulus", conductor.youngs_modulus, _MODULUS
    if conductor.density is not None:
        yield "density", conductor.density, _DENSITY
    if conductor.mass_per_length is not None:
        yield "mass_per_length", conductor.mass_per_length, _MASS
