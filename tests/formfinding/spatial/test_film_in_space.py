"""The film of a motion in space: from straight wires without weight to the form that was found."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise

import numpy as np
import pytest

from catenaria.formfinding.progress import Progress
from catenaria.formfinding.spatial.dynamic import find_by_motion
from catenaria.line import Line
from catenaria.results import FormResult
from catenaria.results.film import Film

Filmed = tuple[FormResult, list[Film]]
SAMPLES = 8  # of a profile in every element
TRACK = ("chainage", "lateral", "height")


def check_is_form(film: Film, state: int, result: FormResult) -> None:
    """Nodes are where the profiles have them, and clamps where the schedule has them."""
    for k, wire in enumerate(result.wires):
        own = film.wires.nodes(k)
        assert (film.wire[k], film.role[k]) == (wire.name, wire.role)
        for name in TRACK:
            there, found = getattr(film.wires, name)[state, own], getattr(wire.profile, name)[::SAMPLES]
            np.testing.assert_allclose(there, found, rtol=0.0, atol=1e-9)
    droppers = result.droppers
    for there, bottom, top in (
        (film.droppers.chainage, droppers.x, droppers.x),
        (film.droppers.lateral, droppers.stagger_bottom, droppers.stagger_top),
        (film.droppers.height, droppers.height, droppers.messenger_height),
    ):
        np.testing.assert_allclose(there[state, 0::2], bottom, rtol=0.0, atol=1e-9)
        np.testing.assert_allclose(there[state, 1::2], top, rtol=0.0, atol=1e-9)


def test_the_last_state_is_the_form(filmed: Filmed) -> None:
    result, (film,) = filmed
    check_is_form(film, -1, result)
    with pytest.raises(AssertionError):
        check_is_form(film, -2, result)


def bend(film: Film, state: int, line: Line, result: FormResult) -> float:
    """Return how far the contact wire is from straight lines between supports, 2 m away from them."""
    own = film.wires.nodes(0)
    x, lateral, height = (getattr(film.wires, name)[state, own] for name in TRACK)
    r = line.alignment.frames(x).point(lateral, height)
    farthest = 0.0
    held: list[float] = np.unique(result.supports.chainage).tolist()
    for start, end in pairwise(held):
        inner = r[(x > start + 2.0) & (x < end - 2.0)]
        chord = (inner[-1] - inner[0]) / np.linalg.norm(inner[-1] - inner[0])
        farthest = max(farthest, float(np.linalg.norm(np.cross(inner - inner[0], chord), axis=1).max()))
    return farthest


def test_the_first_state_is_straight_between_supports(filmed: Filmed, curved: Callable[..., Line]) -> None:
    result, (film,) = filmed
    assert bend(film, 0, curved(), result) < 1e-4
    assert bend(film, -1, curved(), result) > 0.01


def apart(film: Film, state: int, of: int) -> float:
    """Return how far lower clamps in one state are above or below the contact wire in another one."""
    own = film.wires.nodes(0)
    wire = np.interp(
        film.droppers.chainage[of, 0::2], film.wires.chainage[state, own], film.wires.height[state, own]
    )
    return float(np.abs(film.droppers.height[of, 0::2] - wire).max())


def test_droppers_are_clamped_to_the_wire_in_every_state(filmed: Filmed) -> None:
    _, (film,) = filmed
    for state in range(film.time.size):
        assert apart(film, state, state) < 5e-4  # the wire between two nodes is drawn straight
    assert apart(film, 0, film.time.size - 1) > 0.01


def test_errors_are_those_of_the_course(filmed: Filmed) -> None:
    result, (film,) = filmed
    course = result.histories[0]
    kept = np.searchsorted(course.time, film.time)
    np.testing.assert_array_equal(course.time[kept], film.time)
    np.testing.assert_array_equal(course.error[kept], film.error)
    assert film.control_name == course.control_name
    assert set(zip(film.control_quantity, film.control_unit, strict=True)) == {
        ("tension", "N"),
        ("height", "m"),
    }
    assert (kept[0], kept[-1], film.time.size) == (0, course.time.size - 1, 9)
    assert film.gravity[0] == 0.0
    assert film.gravity[-1] == 1.0
    assert np.all(np.diff(film.gravity) >= 0.0)


def test_filming_changes_nothing_and_time_is_told(make: Callable[..., Line]) -> None:
    line, said, films = make(1), list[Progress](), list[Film]()
    plain = find_by_motion(line, None)
    result = find_by_motion(line, said.append, None, films.append, 10_000)
    np.testing.assert_array_equal(result.droppers.cut_length, plain.droppers.cut_length)
    np.testing.assert_array_equal(films[0].time, result.histories[0].time)  # no more than there are
    elapsed = [progress.elapsed for progress in said]
    assert elapsed == sorted(elapsed)
    assert 0.0 <= elapsed[0] < elapsed[-1]
