"""Lines that are plane, mirrored, reversed or elsewhere: what must not depend on how a line is described."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from catenaria.formfinding.direct import Direct
from catenaria.line import Line
from catenaria.results import FormResult

Change = dict[str, Any]
Make = Callable[..., Line]
Find = Callable[[Line], FormResult]

PLANE: Change = {"dropper.model": "cables", "spans.*.pre_sag": 0.03, "solver.mesh.refine": 2}
STAGGERS = (0.2, -0.25, 0.3)
BENT: Change = {
    "spans.1.length": 50.0,
    "spans.1.droppers.positions": [4.0, 13.0, 31.0, 45.0],
    "spans.*.pre_sag": 0.02,
    "supports.1.messenger_wire.height": 6.6,
}


def _differ(a: FormResult, b: FormResult) -> tuple[float, float]:
    length = np.abs(a.droppers.length - b.droppers.length).max()
    return float(length), float(np.abs(a.droppers.force_bottom - b.droppers.force_bottom).max())


def _tails(contact: float, messenger: float) -> Change:
    return {"contact_wire.tail": contact, "messenger_wire.tail": messenger}


def _plane(line: Line) -> FormResult:
    """Find the form wire by wire, as for lines in a plane."""
    assert line.plane
    found = Direct().find_form(line)
    assert not found.spatial
    return found


@pytest.fixture(scope="module")
def in_space(make: Make, find: Find) -> FormResult:
    return find(make(2, PLANE, _tails(3.0, 3.0)))


def check_plane(result: FormResult, plane: FormResult) -> None:
    """What is left is the mesh: its nodes stand up to a millimetre beside clamps."""
    length, force = _differ(result, plane)
    assert length < 0.6e-6
    assert force < 1e-4


def test_a_plane_line_is_found_as_wire_by_wire(make: Make, in_space: FormResult) -> None:
    """Wire by wire, devices pull the ends outwards from their anchors; in space anchors are where they end.

    Given the tails that the plane line has in the end, both are the same.
    """
    contact, messenger = (wire.travel for wire in _plane(make(2, PLANE, _tails(3.0, 3.0))).wires)
    assert 0.05 < contact < messenger < 0.1
    check_plane(in_space, _plane(make(2, PLANE, _tails(3.0 - contact, 3.0 - messenger))))


def test_tails_that_are_longer_by_the_pull_are_noticed(make: Make, in_space: FormResult) -> None:
    """65 mm of tail turn the wire at its last support by 0.34 N/T, which its layer l makes 1 um of height."""
    plane = _plane(make(2, PLANE, _tails(3.0, 3.0)))
    assert _differ(in_space, plane)[0] < 5e-6
    with pytest.raises(AssertionError):
        check_plane(in_space, plane)


def _staggered(staggers: tuple[float, ...], sense: float) -> Change:
    curve = {"start": -200.0, "length": 500.0, "radius": sense * 600.0, "transition": 50.0, "cant": 0.1}
    sides = {f"supports.{i}.stagger": sense * b for i, b in enumerate(staggers)}
    return {**BENT, **sides, "track": {"curves": [curve]}}


def check_mirrored(left: FormResult, right: FormResult) -> None:
    mirror = np.array([1.0, -1.0, 1.0])
    assert max(_differ(left, right)) < 1e-8
    d, e = left.droppers, right.droppers
    np.testing.assert_allclose(d.position_bottom, e.position_bottom * mirror, rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(d.position_top, e.position_top * mirror, rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(left.supports.force_lateral, -right.supports.force_lateral, atol=1e-6)


def test_a_mirrored_line_has_the_mirrored_form(make: Make, find: Find) -> None:
    left, right = (find(make(2, _staggered(STAGGERS, sense))) for sense in (1.0, -1.0))
    assert np.abs(left.supports.force_lateral).min() > 50.0
    check_mirrored(left, right)


def test_a_stagger_that_is_not_mirrored_is_noticed(make: Make, find: Find) -> None:
    left = find(make(2, _staggered(STAGGERS, 1.0)))
    right = find(make(2, _staggered((0.2, -0.25, 0.301), -1.0)))
    with pytest.raises(AssertionError):
        check_mirrored(left, right)


def _reversed(change: Change) -> Change:
    """Return the changes that make the line of `BENT` run the other way, seen from behind."""
    there = {
        "spans.0.length": 50.0,
        "spans.0.droppers.positions": [5.0, 19.0, 37.0, 46.0],
        "spans.*.pre_sag": 0.02,
        "supports.1.messenger_wire.height": 6.6,
        "contact_wire.tension.at": "start",
        "messenger_wire.tension.at": "start",
    }
    return there | {f"supports.{2 - i}.stagger": -b for i, b in enumerate(STAGGERS)} | change


def check_reversed(there: FormResult, back: FormResult) -> None:
    """Nodes stand elsewhere in the two, by fractions of a millimetre."""
    np.testing.assert_allclose(back.droppers.length[::-1], there.droppers.length, atol=1e-6)
    np.testing.assert_allclose(back.droppers.force_bottom[::-1], there.droppers.force_bottom, atol=1e-3)
    np.testing.assert_allclose(back.droppers.stagger_top[::-1], -there.droppers.stagger_top, atol=1e-6)


def test_a_reversed_line_has_the_same_form(make: Make, find: Find) -> None:
    finer = {"solver.mesh.refine": 2}
    there = find(make(2, BENT, finer, {f"supports.{i}.stagger": b for i, b in enumerate(STAGGERS)}))
    check_reversed(there, find(make(2, _reversed(finer))))
    with pytest.raises(AssertionError):
        check_reversed(there, find(make(2, _reversed(finer | {"messenger_wire.tension.at": "end"}))))


def check_elsewhere(here: FormResult, there: FormResult, shift: float) -> None:
    """1e5 m leave 1.5e-11 m of a coordinate, and EA times that over an element is newtons per micrometre."""
    length, force = _differ(here, there)
    assert length < 1e-7
    assert force < 1e-4
    np.testing.assert_allclose(there.droppers.x - here.droppers.x, shift, rtol=0.0, atol=1e-9)


def test_a_line_far_away_has_the_same_form(make: Make, find: Find) -> None:
    here = find(make(2, BENT))
    far = find(make(2, BENT, {"start_chainage": 1e5}))
    check_elsewhere(here, far, 1e5)
    with pytest.raises(AssertionError):
        check_elsewhere(here, far, 1e5 + 1e-6)


def test_a_curve_elsewhere_does_nothing(make: Make, find: Find) -> None:
    curve = {"start": 300.0, "length": 100.0, "radius": 600.0}
    here = find(make(2, BENT))
    check_elsewhere(here, find(make(2, BENT, {"track": {"curves": [curve]}})), 0.0)
    with pytest.raises(AssertionError):
        check_elsewhere(here, find(make(2, BENT, {"track": {"curves": [curve | {"start": 60.0}]}})), 0.0)
