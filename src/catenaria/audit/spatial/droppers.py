"""Droppers of a line in space: straight bars between two wires, in the vertical plane across the track."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from catenaria.audit.lengths import TOLERANCE, green_stretch
from catenaria.audit.spatial.bodies import FreeSpatialWire, positions
from catenaria.audit.spatial.stated import StatedLine
from catenaria.audit.verdict import Check
from catenaria.results.form import Droppers

FloatArray = NDArray[np.float64]


def place_checks(
    droppers: Droppers, stated: StatedLine, wires: tuple[FreeSpatialWire, ...]
) -> Iterator[Check]:
    """Yield whether clamps are where the line file puts them, on their wires, and as the table says."""
    kind, across = stated.droppers, stated.droppers.across
    names = dropper_names(droppers)
    foot = positions(wires, droppers.lower_wire, droppers.contact_coordinate)
    top = positions(wires, droppers.upper_wire, droppers.messenger_coordinate)
    off_plane = np.maximum(np.abs(across.off(foot)), np.abs(across.off(top)))
    for what, off in (
        ("place along the track", np.maximum(np.abs(droppers.x - kind.chainage), off_plane)),
        ("lower clamp on its wire", np.linalg.norm(droppers.position_bottom - foot, axis=1)),
        ("upper clamp on its wire", np.linalg.norm(droppers.position_top - top, axis=1)),
        ("height of the lower wire", np.abs(droppers.height - across.height(foot))),
        ("height of the upper wire", np.abs(droppers.messenger_height - across.height(top))),
        ("stagger of the lower wire", np.abs(droppers.stagger_bottom - across.lateral(foot))),
        ("stagger of the upper wire", np.abs(droppers.stagger_top - across.lateral(top))),
    ):
        yield _metres(what, off, names)


def length_checks(droppers: Droppers, stated: StatedLine) -> Iterator[Check]:
    """Yield all three lengths: between the wires, without force, and to be cut.

    Notes
    -----
    The pull is the same all along the bar, because half of its weight hangs on either clamp.
    """
    kind, names = stated.droppers, dropper_names(droppers)
    distance = np.linalg.norm(droppers.position_top - droppers.position_bottom, axis=1)
    ratio = np.mean(bar_tension(droppers, stated), axis=1) / kind.conductor.EA
    stretched = droppers.unstressed_length * (1.0 if kind.rigid else green_stretch(ratio))
    cut = droppers.unstressed_length - kind.clamp_heights
    yield _metres("length", np.abs(droppers.length - distance), names)
    yield _metres("unstressed length", np.abs(droppers.length - stretched), names)
    yield _metres("length to be cut", np.abs(droppers.cut_length - cut), names)


def balance_checks(droppers: Droppers, stated: StatedLine, tolerance: float) -> Iterator[Check]:
    """Yield the balance of every dropper with its weight, and the forces that the table states."""
    balance = tolerance + weight_margin(droppers, stated)
    names = dropper_names(droppers)
    below, above = bar_pulls(droppers, stated)
    unit = _directions(droppers)
    across = np.maximum(*(np.linalg.norm(pull - _along(pull, unit), axis=1) for pull in (below, above)))
    missing = below + above
    for what, off in (
        ("forces and weight (23)", np.linalg.norm(missing, axis=1)),
        ("stated force error", np.abs(droppers.force_error + missing[:, 2])),
    ):
        yield Check("equilibrium", f"droppers, {what}", "N", off, balance, names)
    for what, off in (
        ("force across the dropper", across),
        ("stated force at the bottom", np.abs(droppers.force_bottom - _component(droppers.on_contact, unit))),
        ("stated force at the top", np.abs(droppers.force_top - _component(droppers.on_messenger, -unit))),
    ):
        yield Check("equilibrium", f"droppers, {what}", "N", off, np.full(off.size, tolerance), names)


def bar_pulls(droppers: Droppers, stated: StatedLine) -> tuple[FloatArray, FloatArray]:
    """Return the forces of the bars without weights on lower and upper wires [N], shape (n, 3) each."""
    below, above = droppers.on_contact.copy(), droppers.on_messenger.copy()
    weights = end_weights(droppers, stated)
    below[:, 2] += weights[0]
    above[:, 2] += weights[1]
    return below, above


def bar_tension(droppers: Droppers, stated: StatedLine) -> FloatArray:
    """Return the pull of every bar as its lower and its upper end say [N], shape (n, 2)."""
    below, above = bar_pulls(droppers, stated)
    unit = _directions(droppers)
    return np.column_stack((_component(below, unit), -_component(above, unit)))


def end_weights(droppers: Droppers, stated: StatedLine) -> tuple[FloatArray, FloatArray]:
    """Return the weights that hang on lower and upper wires: half of a dropper, and its clamp [N]."""
    kind = stated.droppers
    half = 0.5 * kind.conductor.rhoA * droppers.unstressed_length
    return stated.gravity * (half + kind.mass_bottom), stated.gravity * (half + kind.mass_top)


def weight_margin(droppers: Droppers, stated: StatedLine) -> FloatArray:
    """Return by how much weights differ between stretched and unstressed lengths [N]; both are in use."""
    longer = np.abs(droppers.length - droppers.unstressed_length)
    return stated.gravity * stated.droppers.conductor.rhoA * longer


def dropper_names(droppers: Droppers) -> tuple[str, ...]:
    """Return the names of all droppers."""
    return tuple(f"dropper {i + 1}" for i in range(droppers.x.size))


def _directions(droppers: Droppers) -> FloatArray:
    """Return unit vectors from lower to upper clamps."""
    d = droppers.position_top - droppers.position_bottom
    return d / np.linalg.norm(d, axis=1)[:, None]


def _along(force: FloatArray, unit: FloatArray) -> FloatArray:
    return _component(force, unit)[:, None] * unit


def _component(force: FloatArray, unit: FloatArray) -> FloatArray:
    return np.einsum("ni,ni->n", force, unit)


def _metres(what: str, off: FloatArray, names: tuple[str, ...]) -> Check:
    return Check("lengths", f"droppers, {what}", "m", off, np.full(off.size, TOLERANCE), names)
