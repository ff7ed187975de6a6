"""What can be wrong with a line that is built: every error by itself, with what is known of its size."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Final, Literal

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.spatial.layout import Layout
from catenaria.discretise.spatial.numbering import NONE
from catenaria.line.installation import Installation, Spread, TensionSpread
from catenaria.loading.built_line import BuiltLine
from catenaria.loading.contact import in_role
from catenaria.loading.distributions import Distributions

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

Group = Literal[
    "dropper length",
    "dropper position",
    "contact height",
    "messenger height",
    "contact stagger",
    "messenger stagger",
    "tension",
]

GROUPS: Final[tuple[Group, ...]] = (
    "dropper length",
    "dropper position",
    "contact height",
    "messenger height",
    "contact stagger",
    "messenger stagger",
    "tension",
)

_Row = tuple[Group, Spread | None, tuple[str, ...], FloatArray, NDArray[np.bool_] | None]


@dataclass(frozen=True)
class ErrorSources:
    """All errors of installation that are not zero for certain.

    Attributes
    ----------
    group : tuple of str, length m
        What each of them is; one of `GROUPS`.
    name : tuple of str
        Of what.
    part : IntArray, shape (m,)
        Index of the dropper, of the place at which a support holds a wire, or of the wire.
    distribution : Distributions
        How they scatter; a known error is the mean of its distribution.
    """

    group: tuple[Group, ...]
    name: tuple[str, ...]
    part: IntArray
    distribution: Distributions

    @property
    def count(self) -> int:
        """How many errors there are, m."""
        return len(self.group)

    def of(self, *groups: str) -> NDArray[np.bool_]:
        """Return the mask of the errors of some groups."""
        return np.array([group in groups for group in self.group], dtype=np.bool_)

    @property
    def groups(self) -> tuple[Group, ...]:
        """The groups of which there are errors, in their usual order."""
        return tuple(group for group in GROUPS if group in self.group)

    @property
    def unit(self) -> tuple[str, ...]:
        """The unit of each error, N or m."""
        return tuple("N" if group == "tension" else "m" for group in self.group)


def error_sources(built: BuiltLine, installation: Installation) -> ErrorSources:
    """Return the errors with which a line is installed.

    Parameters
    ----------
    built : BuiltLine
        The line as it was found.
    installation : Installation
        What is known of them; it fits the line.
    """
    parts = [part for part in _parts(built, installation) if part.count]
    return ErrorSources(
        tuple(group for part in parts for group in part.group),
        tuple(name for part in parts for name in part.name),
        np.concatenate([np.empty(0, np.int64), *(part.part for part in parts)]),
        Distributions.concatenate([part.distribution for part in parts]),
    )


def _parts(built: BuiltLine, installation: Installation) -> Iterator[ErrorSources]:
    layout = built.model.layout
    droppers, holds = _dropper_names(layout), _hold_names(built)
    length, position = _known_of_droppers(layout, installation)
    height, stagger = _known_of_supports(built, installation)
    contact = in_role(layout, layout.holds.wire, "contact wire")
    groups: tuple[_Row, ...] = (
        ("dropper length", installation.dropper_length, droppers, length, None),
        ("dropper position", installation.dropper_position, droppers, position, None),
        ("contact height", installation.contact_height, holds, height, contact),
        ("messenger height", installation.messenger_height, holds, height, ~contact),
        ("contact stagger", installation.contact_stagger, holds, stagger, contact),
        ("messenger stagger", installation.messenger_stagger, holds, stagger, ~contact),
    )
    for group, spread, names, known, own in groups:
        there = np.ones(len(names), dtype=np.bool_) if own is None else own
        scale = np.full(len(names), 0.0 if spread is None else spread.scale)
        yield _sources(group, names, known, scale, spread, there)
    yield _tensions(built, installation)


def _sources(
    group: Group,
    names: Sequence[str],
    known: FloatArray,
    scale: FloatArray,
    spread: Spread | TensionSpread | None,
    there: NDArray[np.bool_],
) -> ErrorSources:
    """Return the errors of a group that are there and not zero for certain."""
    mean = known + (spread.mean if isinstance(spread, Spread) else 0.0)
    part = np.flatnonzero(there & ((scale > 0.0) | (mean != 0.0)))
    clip = np.inf if spread is None or spread.clip is None else spread.clip
    kind = "uniform" if spread is None else spread.distribution
    return ErrorSources(
        (group,) * part.size,
        tuple(names[k] for k in part.tolist()),
        part,
        Distributions((kind,) * part.size, mean[part], scale[part], np.full(part.size, clip)),
    )


def _tensions(built: BuiltLine, installation: Installation) -> ErrorSources:
    """Return the errors of tensions; a termination that is fixed keeps the wire's length, not its tension."""
    wires, spread = built.model.layout.wires, installation.tension
    there = np.array(built.devices.moves) & (built.model.pull != NONE)
    wanted = np.array([wire.tension.force for wire in wires])
    known = np.zeros(len(wires))
    for error in installation.known.wires:
        known[[wire.name == error.wire for wire in wires]] = error.tension
    scale = np.zeros(len(wires))
    if spread is not None:
        scale += spread.scale if spread.scale is not None else (spread.fraction or 0.0) * np.abs(wanted)
    return _sources("tension", [wire.name for wire in wires], known, scale, spread, there)


def _known_of_droppers(layout: Layout, installation: Installation) -> tuple[FloatArray, FloatArray]:
    droppers = layout.droppers
    upper = in_role(layout, droppers.lower, "auxiliary messenger")
    length, position = np.zeros(upper.size), np.zeros(upper.size)
    for error in installation.known.droppers:
        of = (droppers.span == error.span) & (droppers.number == error.dropper)
        own = of & (upper == (error.carries == "auxiliary messenger"))
        length[own], position[own] = error.length, error.position
    return length, position


def _known_of_supports(built: BuiltLine, installation: Installation) -> tuple[FloatArray, FloatArray]:
    names = _hold_names(built)
    height, stagger = np.zeros(len(names)), np.zeros(len(names))
    for error in installation.known.supports:
        i = names.index(f"{error.wire} at {error.support}")
        height[i], stagger[i] = error.height, error.stagger
    return height, stagger


def _dropper_names(layout: Layout) -> tuple[str, ...]:
    droppers = layout.droppers
    upper = in_role(layout, droppers.lower, "auxiliary messenger")
    rows = zip(droppers.span.tolist(), droppers.number.tolist(), upper.tolist(), strict=True)
    return tuple(f"{span}/{number}" + (" upper" if above else "") for span, number, above in rows)


def _hold_names(built: BuiltLine) -> tuple[str, ...]:
    holds = built.model.layout.holds
    wires, supports = built.model.layout.wires, built.line.supports
    return tuple(
        f"{wires[int(k)].name} at {supports[int(i)].name}"
        for k, i in zip(holds.wire, holds.support, strict=True)
    )
