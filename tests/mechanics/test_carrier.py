"""Points on several chains at once, against each chain alone."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from catenaria.errors import InfeasibleError
from catenaria.mechanics.carrier import Carrier, Strands
from catenaria.mechanics.chain import Chain, Section

NUMBERS = np.random.default_rng(5).permutation(66)
Z = np.random.default_rng(6).normal(size=66)
SECTION = Section(1.0, 1.0, 1.0)
FIRST = Chain(NUMBERS[:24].reshape(4, 6), np.array([0.0, 1.0, 1.5, 4.0]), SECTION)
SECOND = Chain(NUMBERS[24:36].reshape(2, 6), np.array([0.0, 9.0]), SECTION)
THIRD = Chain(NUMBERS[36:].reshape(5, 6), np.array([0.5, 1.0, 2.0, 2.5, 3.0]), SECTION)
CHAINS = (FIRST, SECOND, THIRD)
OF = np.array([2, 0, 1, 0, 2, 2])  # not in the order of the chains
PLACES = np.array([0.7, 3.1, 3.1, 0.2, 2.9, 2.2])
OFFSET = np.array([0, 4, 6])  # number of each chain's first node


def check_like_each_chain(strands: Strands, of: np.ndarray) -> None:
    """Every point has the values of its own chain."""
    found = strands.evaluate(Z, PLACES)
    for i, k in enumerate(of):
        alone = CHAINS[k].evaluate(Z, PLACES[i : i + 1])
        for name in ("dofs", "N", "N1", "r", "r1", "r2"):
            np.testing.assert_array_equal(getattr(found, name)[i], getattr(alone, name)[0])


def test_points_are_those_of_their_own_chains() -> None:
    strands = Strands.on(CHAINS, OF)
    check_like_each_chain(strands, OF)
    with pytest.raises(AssertionError):
        check_like_each_chain(Strands.on(CHAINS, OF[::-1]), OF)
    with pytest.raises(AssertionError):
        check_like_each_chain(replace(strands, first=np.zeros_like(OF)), OF)


def check_elements(strands: Strands, element: np.ndarray) -> None:
    """Each element joins two neighbouring nodes of the point's own chain, with the point between them."""
    for i, k in enumerate(OF):
        nodes, knots = CHAINS[k].nodes.tolist(), CHAINS[k].knots
        first, second = (nodes.index(strands.nodes[element[i] + end].tolist()) for end in (0, 1))
        assert second == first + 1
        assert knots[first] <= PLACES[i] <= knots[second]


def test_locate() -> None:
    strands = Strands.on(CHAINS, OF)
    element = strands.locate(PLACES)
    check_elements(strands, element)
    alone = [CHAINS[k].locate(PLACES[i : i + 1])[0] + OFFSET[k] for i, k in enumerate(OF)]
    np.testing.assert_array_equal(element, alone)
    with pytest.raises((AssertionError, ValueError)):
        check_elements(strands, element + 1)


def test_points_beyond_the_ends_belong_to_the_end_elements_of_their_chain() -> None:
    strands = Strands.on(CHAINS, OF)
    last = np.array([3, 1, 4]) - 1
    np.testing.assert_array_equal(strands.locate(np.full(6, -1.0)), OFFSET[OF])
    np.testing.assert_array_equal(strands.locate(np.full(6, 99.0)), (OFFSET + last)[OF])


def test_relocate() -> None:
    strands = Strands.on(CHAINS, OF)
    start = OFFSET[OF]
    found = strands.relocate(PLACES, start)
    np.testing.assert_array_equal(found, strands.locate(PLACES))
    np.testing.assert_array_equal(start, OFFSET[OF])
    np.testing.assert_array_equal(strands.relocate(PLACES, found), found)


def test_relocate_keeps_the_hysteresis_of_chains() -> None:
    """Just beyond a knot a point stays in either element; its chain alone would do the same."""
    strands = Strands.on(CHAINS, np.array([0, 2]))
    s = np.array([1.0 + 0.5e-6, 2.0 - 0.2e-6])
    for element in (np.array([0, 7]), np.array([1, 8])):
        np.testing.assert_array_equal(strands.relocate(s, element), element)
    np.testing.assert_array_equal(strands.relocate(s + 1e-3, np.array([0, 7])), [1, 8])


@pytest.mark.parametrize("s", [4.5, -0.1, np.nan])
def test_a_point_that_slid_off_its_own_chain_is_refused(s: float) -> None:
    """4.5 m is within the second chain, but not within the first."""
    places = np.array([0.7, s, 3.1, 0.2, 2.9, 2.2])
    with pytest.raises(InfeasibleError, match="slid out"):
        Strands.on(CHAINS, OF).relocate(places, OFFSET[OF])


def test_a_place_that_another_chain_does_not_have_is_none_of_its_business() -> None:
    places = PLACES.copy()
    places[2] = 8.9  # on the chain of 9 m
    np.testing.assert_array_equal(Strands.on(CHAINS, OF).relocate(places, OFFSET[OF])[2], 4)


def test_no_points_and_chains_without_points() -> None:
    nobody = Strands.on(CHAINS, np.empty(0, dtype=np.int64))
    none, nowhere = np.empty(0, dtype=np.int64), np.empty(0)
    assert nobody.locate(nowhere).shape == (0,)
    assert nobody.relocate(nowhere, none).shape == (0,)
    assert nobody.evaluate(Z, nowhere, none).r.shape == (0, 3)
    one = Strands.on(CHAINS, np.array([1]))
    np.testing.assert_array_equal(one.relocate(np.array([3.0]), np.array([4])), [4])


def test_one_chain_is_a_carrier_as_it_is() -> None:
    """A chain and strands of it alone are interchangeable."""
    s = np.array([0.3, 1.2, 3.9])
    carriers: tuple[Carrier, ...] = (FIRST, Strands.on((FIRST,), np.zeros(3, dtype=np.int64)))
    plain, strands = (carrier.evaluate(Z, s, carrier.locate(s)) for carrier in carriers)
    np.testing.assert_array_equal(plain.r, strands.r)
    np.testing.assert_array_equal(plain.dofs, strands.dofs)
