"""By how much a form differs from a variant of it: subtraction, nothing else."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from catenaria.results import Droppers, FormResult

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class Differences:
    """A form minus a variant.

    Attributes
    ----------
    dropper : tuple of str
        Span and number of the droppers that both have, in spans with as many of them in both.
    x : FloatArray
        Their chainages [m].
    cut_length, dropper_height : FloatArray
        How much longer they are, and how much higher they hold their lower wire [mm].
    chainage, height : FloatArray
        Along the contact wire where both have it: chainage [m], and how much higher it is [mm].
    """

    dropper: tuple[str, ...]
    x: FloatArray
    cut_length: FloatArray
    dropper_height: FloatArray
    chainage: FloatArray
    height: FloatArray


def differences(result: FormResult, variant: FormResult) -> Differences:
    """Compare two forms; droppers are the same if wires, span, number and how many the span has are.

    Examples
    --------
    >>> from catenaria import workflow
    >>> form = workflow.solve("examples/yang2017_three_span.yaml", rebuild="none")
    >>> float(differences(form, form).cut_length.max())
    0.0
    """
    own, theirs = _keys(result.droppers), _keys(variant.droppers)
    found = {key: i for i, key in enumerate(theirs)}
    pairs = [(i, found[key]) for i, key in enumerate(own) if key in found]
    here = np.array([i for i, _ in pairs], dtype=np.intp)
    there = np.array([j for _, j in pairs], dtype=np.intp)
    a, b = result.droppers, variant.droppers
    chainage, height = _heights(result, variant)
    return Differences(
        tuple(f"{own[i][2]}.{own[i][3]}" for i in here),
        a.x[here],
        1e3 * (a.cut_length[here] - b.cut_length[there]),
        1e3 * (a.height[here] - b.height[there]),
        chainage,
        1e3 * height,
    )


def _keys(droppers: Droppers) -> list[tuple[str, str, int, int, int]]:
    spans, numbers = droppers.span.tolist(), droppers.number.tolist()
    sets = list(zip(droppers.lower_wire, droppers.upper_wire, spans, strict=True))
    many = Counter(sets)
    return [(*of, number, many[of]) for of, number in zip(sets, numbers, strict=True)]


def _heights(result: FormResult, variant: FormResult) -> tuple[FloatArray, FloatArray]:
    own, theirs = result.wires[0].profile, variant.wires[0].profile
    inside = (own.chainage >= theirs.chainage.min()) & (own.chainage <= theirs.chainage.max())
    chainage = own.chainage[inside]
    order = np.argsort(theirs.chainage, kind="stable")
    return chainage, own.height[inside] - np.interp(chainage, theirs.chainage[order], theirs.height[order])
