"""Graded meshes: where nodes must stand, how long elements may be, and what neighbours do to each other."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from catenaria.discretise.mesh import Grading, graded_knots
from catenaria.errors import InconsistentInputError

FloatArray = NDArray[np.float64]

GRADING = Grading(fine=(0.1, 0.3), largest=2.4)
CENTRES = (4.0, 13.5, 23.0)


def has(knots: FloatArray, wanted: float) -> bool:
    return bool(np.abs(knots - wanted).min() < 1e-12)


def check_mesh(knots: FloatArray, length: float, centres: tuple[float, ...], largest: float) -> None:
    """Check what every mesh must be, whatever the distances."""
    assert knots[0] == 0.0
    assert knots[-1] == length
    assert np.diff(knots).min() > 0.0
    assert np.diff(knots).max() <= largest * (1.0 + 1e-9)
    assert all(has(knots, centre) for centre in centres)


def test_every_centre_and_both_ends_are_nodes() -> None:
    check_mesh(graded_knots(27.0, CENTRES, GRADING), 27.0, CENTRES, 2.4)


@pytest.mark.parametrize(
    "spoil",
    [
        lambda knots: knots[knots != 13.5],
        lambda knots: knots[:-1],
        lambda knots: knots[::2],
        lambda knots: np.repeat(knots, 2),
    ],
    ids=["no node at a centre", "too short", "too coarse", "two nodes at one place"],
)
def test_another_mesh_is_noticed(spoil: Callable[[FloatArray], FloatArray]) -> None:
    with pytest.raises(AssertionError):
        check_mesh(spoil(graded_knots(27.0, CENTRES, GRADING)), 27.0, CENTRES, 2.4)


def test_nodes_stand_at_the_fine_distances_on_both_sides() -> None:
    knots = graded_knots(27.0, CENTRES, GRADING)
    places = [centre + side * d for centre in CENTRES for side in (-1, 1) for d in GRADING.fine]
    assert all(has(knots, place) for place in places)
    assert not all(has(graded_knots(27.0, CENTRES, replace(GRADING, fine=())), place) for place in places)


def test_the_ends_of_a_wire_are_not_refined() -> None:
    knots = graded_knots(27.0, CENTRES, GRADING)
    assert not has(knots, 0.1)
    assert not has(knots, 26.9)
    assert has(graded_knots(27.0, (0.0, *CENTRES), GRADING), 0.1)


def test_long_stretches_are_divided_evenly() -> None:
    """From 4.3 to 13.2 m four elements of 2.225 m are needed, three would be 2.97 m."""
    knots = graded_knots(27.0, CENTRES, GRADING)
    between = knots[(knots > 4.3 - 1e-9) & (knots < 13.2 + 1e-9)]
    np.testing.assert_allclose(np.diff(between), 8.9 / 4.0, rtol=1e-12)


def test_an_element_of_just_the_largest_size_is_not_divided() -> None:
    """4.8/2.4 is 2 to within rounding: no third element appears."""
    assert graded_knots(0.3 * 16, [], Grading((), 0.3)).size == 17
    assert graded_knots(4.8, [], Grading((), 2.4)).size == 3
    assert graded_knots(4.8001, [], Grading((), 2.4)).size == 4


def test_refining_keeps_the_nodes_and_halves_the_elements() -> None:
    coarse = graded_knots(27.0, CENTRES, GRADING)
    fine = graded_knots(27.0, CENTRES, replace(GRADING, refine=2))
    assert fine.size == 2 * coarse.size - 1
    np.testing.assert_allclose(fine[::2], coarse, atol=1e-12)
    np.testing.assert_allclose(fine[1::2], 0.5 * (coarse[1:] + coarse[:-1]), atol=1e-12)


@pytest.mark.parametrize(("gap", "nodes"), [(0.05, 0), (0.2, 0), (0.25, 2), (0.6, 2), (0.7, 4)])
def test_neighbours_closer_than_the_fine_distances_share_the_room(gap: float, nodes: int) -> None:
    """Distances that would reach beyond the middle, or into it, are left out."""
    knots = graded_knots(20.0, (10.0, 10.0 + gap), GRADING)
    inside = knots[(knots > 10.0 + 1e-9) & (knots < 10.0 + gap - 1e-9)]
    assert inside.size == nodes
    np.testing.assert_allclose(np.sort(20.0 + gap - inside), inside, atol=1e-12)  # symmetric


def test_distances_may_come_in_any_order_and_centres_twice() -> None:
    knots = graded_knots(27.0, CENTRES, GRADING)
    np.testing.assert_array_equal(graded_knots(27.0, CENTRES, replace(GRADING, fine=(0.3, 0.1))), knots)
    np.testing.assert_array_equal(graded_knots(27.0, (*CENTRES[::-1], 13.5), GRADING), knots)


@pytest.mark.parametrize("centre", [-0.01, 27.01, np.nan])
def test_a_centre_off_the_wire_is_refused(centre: float) -> None:
    with pytest.raises(InconsistentInputError, match="beyond the end"):
        graded_knots(27.0, (4.0, centre), GRADING)


def test_a_centre_at_an_end_is_not_refused() -> None:
    check_mesh(graded_knots(27.0, (0.0, 27.0), GRADING), 27.0, (0.0, 27.0), 2.4)


@given(
    st.lists(st.integers(1, 9_999), min_size=0, max_size=12, unique=True),
    st.lists(st.sampled_from([0.01, 0.05, 0.1, 0.3, 1.0, 3.0]), max_size=3, unique=True),
    st.floats(0.2, 20.0),
    st.integers(1, 3),
)
def test_every_mesh_is_a_mesh(places: list[int], fine: list[float], largest: float, refine: int) -> None:
    centres = tuple(0.01 * place for place in places)
    knots = graded_knots(100.0, centres, Grading(tuple(fine), largest, refine))
    check_mesh(knots, 100.0, centres, largest / refine)


@given(st.lists(st.integers(1, 999), min_size=1, max_size=8, unique=True))
def test_the_mirrored_wire_has_the_mirrored_mesh(places: list[int]) -> None:
    centres = 0.1 * np.array(places)
    knots = graded_knots(100.0, centres, GRADING)
    np.testing.assert_allclose(100.0 - graded_knots(100.0, 100.0 - centres, GRADING)[::-1], knots, atol=1e-9)
