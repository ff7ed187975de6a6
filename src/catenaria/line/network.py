"""A synthetic network: tension lengths as they are built, drawn by chance from a seed.

What differs between them is what differs along a railway: spans, tensions, system height, stitch wires,
curves. Nothing here is the record of a real line.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import accumulate
from typing import Final

import numpy as np

from catenaria.errors import InconsistentInputError

Document = dict[str, object]

_LENGTH: Final = (
    1200.0,
    1435.0,
)  # m: a tension length ends with the first span that reaches a length drawn from it
_SPANS: Final = (45.0, 65.0)  # m
_STEP: Final = 5.0  # m by which neighbouring spans differ at most
_BLOW: Final = 0.35  # m that the chord of a span may be off the track's arc
_STAGGER: Final = 0.2  # m
_CANTS: Final = {800.0: 0.1, 1200.0: 0.08, 2000.0: 0.05, 3000.0: 0.03}  # m, by the radius [m]
_RAIL_SPACING: Final = 1.5  # m


def network(count: int, seed: int) -> Iterator[Document]:
    """Yield the line files of a network of tension lengths of 1.2 to 1.5 km.

    Parameters
    ----------
    count : int
        Number of tension lengths.
    seed : int
        The same seed gives the same network, and a smaller one is the beginning of a larger one.

    Yields
    ------
    dict
        Fields of a line file, numbers in SI and conductors by their names in the library.

    Raises
    ------
    InconsistentInputError
        If the count is below one or the seed is negative.

    Examples
    --------
    >>> [document["name"] for document in network(3, seed=2)]
    ['line 1, simple', 'line 2, stitched', 'line 3, curved']
    """
    if count < 1 or seed < 0:
        raise InconsistentInputError("a network needs a count of one or more and a seed that is not negative")
    return _documents(count, seed)


def _documents(count: int, seed: int) -> Iterator[Document]:
    for number in range(1, count + 1):
        random = np.random.default_rng((seed, number))
        kind = str(random.choice(tuple(_KINDS)))
        yield {"format": 1, "name": f"line {number}, {kind}", **_KINDS[kind](random)}


def _simple(random: np.random.Generator) -> Document:
    """Return a line on straight track whose steady arms hold the contact wire in zigzag."""
    spans = _draw_spans(random, _SPANS[1])
    poles = [_pole(stagger) for stagger in _zigzag(len(spans) + 1, _STAGGER)]
    system = _System(random, encumbrance=float(random.choice((1.25, 1.4, 1.6))))
    return {
        **system.wires(random, ("AC-120 CuAg0.1", "AC-150 CuMg0.5"), (15e3, 20e3), ("BzII 95", "BzII 120")),
        "supports": [system.support(pole) for pole in _with_ends(poles)],
        "spans": _alike(_even_span, spans),
    }


def _stitched(random: np.random.Generator) -> Document:
    """Return a line with stitch wires at all inner supports."""
    spans = _draw_spans(random, _SPANS[1])
    poles = [_pole(stagger) for stagger in _zigzag(len(spans) + 1, 1.5 * _STAGGER)]
    system = _System(random, encumbrance=1.8)
    return {
        **system.wires(random, ("AC-120 CuMg0.5",), (15e3, 18e3), ("BzII 70", "BzII 95")),
        "stitch_wire": {
            "conductor": "BzII 35",
            "tension": 2.8e3,
            "length": float(random.choice((16.0, 18.0))),
        },
        "supports": [system.support(pole) for pole in _with_ends(poles)],
        "spans": _alike(_stitched_span, spans),
    }


def _curved(random: np.random.Generator) -> Document:
    """Return a line that begins and ends on straight track and has a curve between."""
    radius = float(random.choice(tuple(_CANTS)))
    spans = _draw_spans(random, min(_SPANS[1], math.sqrt(8.0 * radius * _BLOW)))
    chainage = list(accumulate(spans, initial=0.0))
    first, last = int(random.integers(3, 7)), len(spans) - int(random.integers(3, 7))
    curve = _Curve(
        start=chainage[first],
        length=chainage[last] - chainage[first],
        radius=radius * float(random.choice((-1.0, 1.0))),
        transition=float(random.choice((60.0, 80.0, 100.0))),
        cant=_CANTS[radius],
    )
    outside = -math.copysign(1.0, curve.radius)  # of a curve to the left the right
    system = _System(random, encumbrance=1.4)
    before, after = _zigzag(first, -outside * _STAGGER)[::-1], _zigzag(len(spans) - last, -outside * _STAGGER)
    poles = [_pole(stagger) for stagger in before]
    for x in chainage[first : last + 1]:
        lean = (
            curve.cant_at(x) / _RAIL_SPACING * system.encumbrance
        )  # what is plumb leans against canted track
        poles.append(_Pole(outside * (_STAGGER + 0.05), lean * outside, "pull-off"))
    poles += [_pole(stagger) for stagger in after]
    return {
        **system.wires(random, ("AC-100 CuAg0.1", "AC-120 CuAg0.1"), (10e3, 12e3), ("BzII 50", "BzII 70")),
        "track": {"curves": [vars(curve)], "rail_spacing": _RAIL_SPACING},
        "supports": [system.support(pole) for pole in _with_ends(poles)],
        "spans": _alike(_even_span, spans),
    }


_KINDS: Final[dict[str, Callable[[np.random.Generator], Document]]] = {
    "simple": _simple,
    "stitched": _stitched,
    "curved": _curved,
}


@dataclass(frozen=True)
class _Pole:
    """Where a support holds the contact wire, how far outside of it the messenger wire, and by which arm."""

    stagger: float
    lean: float
    registration: str | None


@dataclass(frozen=True)
class _Curve:
    """The fields of a curve in a line file."""

    start: float
    length: float
    radius: float
    transition: float
    cant: float

    def cant_at(self, x: float) -> float:
        """Return the cant at a chainage [m]."""
        inside = min(x - self.start, self.start + self.length - x)
        return self.cant * min(max(inside / self.transition, 0.0), 1.0)


class _System:
    """What is alike at all supports of a line."""

    def __init__(self, random: np.random.Generator, encumbrance: float) -> None:
        self.height = float(random.choice((5.3, 5.5)))
        self.encumbrance = encumbrance
        self._supports: dict[_Pole, Document] = {}

    def wires(
        self,
        random: np.random.Generator,
        contact: tuple[str, ...],
        force: tuple[float, float],
        messenger: tuple[str, ...],
    ) -> Document:
        """Return contact wire, messenger wire and droppers; tensions in steps of 500 N."""
        pull, carry = (500.0 * round(float(random.uniform(*force)) / 500.0) for _ in range(2))
        return {
            "contact_wire": _wire(str(random.choice(contact)), pull),
            "messenger_wire": _wire(str(random.choice(messenger)), carry),
            "dropper": {"conductor": "BzII 10", "clamp_mass_top": 0.17, "clamp_mass_bottom": 0.14},
        }

    def support(self, pole: _Pole) -> Document:
        """Return a support; equal ones are one object, which YAML writes once and repeats by an alias."""
        return self._supports.setdefault(pole, self._support(pole))

    def _support(self, pole: _Pole) -> Document:
        contact: Document = {"height": self.height}
        if pole.registration is not None:
            arm = {"length": 1.1, "mass": 1.2, "clamp_mass": 0.3, "registration": pole.registration}
            contact |= {"kind": "steady arm", "arm": arm}
        return {
            "stagger": round(pole.stagger, 4),
            "messenger_stagger": round(pole.stagger + pole.lean, 4),
            "contact_wire": contact,
            "messenger_wire": {"encumbrance": self.encumbrance},
        }


def _wire(conductor: str, force: float) -> Document:
    return {"conductor": conductor, "tension": {"force": force}, "tail": 1.0}


def _draw_spans(random: np.random.Generator, longest: float) -> list[float]:
    """Draw spans in whole metres, neighbours nearly alike, until they are a tension length."""
    wanted = float(random.uniform(*_LENGTH))
    spans = [float(math.floor(random.uniform(_SPANS[0], longest)))]
    while sum(spans) < wanted:
        step = float(random.integers(-int(_STEP), int(_STEP) + 1))
        spans.append(min(max(spans[-1] + step, _SPANS[0]), float(math.floor(longest))))
    return spans


def _zigzag(number: int, first: float) -> list[float]:
    return [first * (-1.0) ** i for i in range(number)]


def _pole(stagger: float) -> _Pole:
    """Return a support on straight track whose mast is on the left."""
    return _Pole(stagger, 0.0, "pull-off" if stagger > 0.0 else "push-off")


def _with_ends(poles: list[_Pole]) -> list[_Pole]:
    """Return the supports without arms at the first and last one, where the model ends."""
    first, *inner, last = poles
    return [_Pole(first.stagger, 0.0, None), *inner, _Pole(last.stagger, 0.0, None)]


def _alike(make: Callable[[float], Document], lengths: list[float]) -> list[Document]:
    """Return spans; equal ones are one object."""
    made = {length: make(length) for length in lengths}
    return [made[length] for length in lengths]


def _even_span(length: float) -> Document:
    """Return a span whose contact wire sags by a thousandth of its length."""
    first = 4.5
    count = round((length - 2.0 * first) / 6.0) + 1
    spacing = (length - 2.0 * first) / (count - 1)
    return {
        "length": length,
        "droppers": {"first": first, "spacing": round(spacing, 4), "count": count},
        "pre_sag_per_mille": 1.0,
    }


def _stitched_span(length: float) -> Document:
    """Return a span whose first and last dropper hang from stitch wires."""
    near, far = 2.5, 12.0
    inner = np.linspace(far, length - far, round((length - 2.0 * far) / 8.2) + 1)
    positions = [near, *(round(float(x), 3) for x in inner), length - near]
    return {"length": length, "droppers": {"positions": positions}, "pre_sag_per_mille": 0.5}
