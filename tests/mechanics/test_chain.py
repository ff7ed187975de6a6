"""Points on a chain: where they are, that r and r' are continuous, and when a point changes its element."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from catenaria.errors import InconsistentInputError, InfeasibleError
from catenaria.mechanics.chain import Chain, Section

KNOTS = np.array([2.0, 2.1, 3.0, 5.4, 5.5])
CHAIN = Chain(np.random.default_rng(1).permutation(30).reshape(5, 6), KNOTS, Section(1.0, 1.0, 1.0))
Z = np.random.default_rng(2).normal(size=30)
OVERLAP = 1e-6


def hermite(s: float, element: int) -> np.ndarray:
    """Return r, r', r'' of one element from its cubic in monomials, shape (3, 3)."""
    (r_i, m_i), (r_j, m_j) = Z[CHAIN.nodes[element : element + 2]].reshape(2, 2, 3)
    L, arc = KNOTS[element + 1] - KNOTS[element], s - KNOTS[element]
    c2 = (3.0 * (r_j - r_i) / L - 2.0 * m_i - m_j) / L
    c3 = (m_i + m_j - 2.0 * (r_j - r_i) / L) / L**2
    value = r_i + m_i * arc + c2 * arc**2 + c3 * arc**3
    return np.array([value, m_i + 2.0 * c2 * arc + 3.0 * c3 * arc**2, 2.0 * c2 + 6.0 * c3 * arc])


def check_evaluation(chain: Chain, s: np.ndarray, element: np.ndarray) -> None:
    points = chain.evaluate(Z, s, element)
    expected = np.array([hermite(at, inside) for at, inside in zip(s, element, strict=True)])
    for k, found in enumerate((points.r, points.r1, points.r2)):
        np.testing.assert_allclose(
            found, expected[:, k], rtol=1e-10, atol=1e-9 * np.abs(expected[:, k]).max()
        )
    np.testing.assert_allclose(np.einsum("nk,nki->ni", points.N, Z[points.dofs]), points.r, rtol=1e-12)
    np.testing.assert_allclose(np.einsum("nk,nki->ni", points.N1, Z[points.dofs]), points.r1, rtol=1e-12)


def test_evaluation() -> None:
    """Within the elements and continued beyond them."""
    s = np.array([2.03, 2.7, 4.0, 5.41, 2.15, 1.9, 5.8])
    element = np.array([0, 1, 2, 3, 0, 0, 3])
    check_evaluation(CHAIN, s, element)
    with pytest.raises(AssertionError):
        check_evaluation(replace(CHAIN, knots=KNOTS + 0.001), s, element)
    with pytest.raises(AssertionError):
        check_evaluation(replace(CHAIN, knots=2.0 + 1.001 * (KNOTS - 2.0)), s, element)


def test_default_element_is_the_one_that_holds_the_point() -> None:
    s = np.array([2.03, 2.7, 4.0, 5.41])
    np.testing.assert_array_equal(CHAIN.evaluate(Z, s).r, CHAIN.evaluate(Z, s, np.arange(4)).r)


def check_continuous(nodes: np.ndarray) -> None:
    """From both sides of every knot r and r' agree; r'' need not (C1, not C2 as the paper's text says)."""
    chain, inner = replace(CHAIN, nodes=nodes), np.arange(1, 4)
    left, right = (chain.evaluate(Z, KNOTS[inner], inner - side) for side in (1, 0))
    np.testing.assert_allclose(left.r, right.r, atol=1e-12)
    np.testing.assert_allclose(left.r1, right.r1, atol=1e-12)
    assert np.abs(left.r2 - right.r2).max() > 0.1


def test_continuous_across_elements() -> None:
    check_continuous(CHAIN.nodes)
    swapped = CHAIN.nodes.copy()
    swapped[2, 3:] = swapped[2, 5:2:-1]
    check_continuous(swapped)  # any numbering
    points = CHAIN.evaluate(Z, np.array([3.0 - 1e-9, 3.0 + 1e-9]))
    np.testing.assert_allclose(points.r[0], points.r[1], atol=1e-7)
    np.testing.assert_allclose(points.r1[0], points.r1[1], atol=1e-6)


def test_control_positions_and_slopes_mixed_up_are_not_continuous() -> None:
    """With the halves of the nodes exchanged, the wrong functions interpolate positions."""
    exchanged = CHAIN.nodes[:, [3, 4, 5, 0, 1, 2]]
    s, element = np.array([2.5]), np.array([1])
    with pytest.raises(AssertionError):
        check_evaluation(replace(CHAIN, nodes=exchanged), s, element)


def test_dofs_and_lengths() -> None:
    np.testing.assert_allclose(CHAIN.L, [0.1, 0.9, 2.4, 0.1])
    assert CHAIN.dofs.shape == (4, 12)
    np.testing.assert_array_equal(CHAIN.dofs[1], np.concatenate((CHAIN.nodes[1], CHAIN.nodes[2])))


def test_locate() -> None:
    s = np.array([-9.0, 2.0, 2.05, 2.1, 2.5, 3.0, 5.4, 5.5, 99.0])
    np.testing.assert_array_equal(CHAIN.locate(s), [0, 0, 0, 1, 1, 2, 3, 3, 3])


def check_hysteresis(chain: Chain) -> None:
    """A point within the overlap stays where it is; beyond it, it changes over and stays there."""
    for knot in (1, 2, 3):
        for element, side in ((knot - 1, 1.0), (knot, -1.0)):
            here = np.array([element])
            overlap = OVERLAP * chain.L[element]
            for part in (0.0, 0.5, -3.0):
                s = chain.knots[knot] + side * part * overlap
                np.testing.assert_array_equal(chain.relocate(np.array([s]), here), here)
            beyond = np.array([chain.knots[knot] + side * 1.5 * overlap])
            other = chain.relocate(beyond, here)
            np.testing.assert_array_equal(other, here + int(side))
            np.testing.assert_array_equal(chain.relocate(beyond, other), other)


def test_relocate_has_hysteresis() -> None:
    check_hysteresis(CHAIN)


def test_control_without_hysteresis_fails() -> None:
    class Jumpy(Chain):
        def relocate(self, s: np.ndarray, element: np.ndarray) -> np.ndarray:
            return self.locate(s)

    with pytest.raises(AssertionError):
        check_hysteresis(Jumpy(CHAIN.nodes, CHAIN.knots, CHAIN.section))


def test_relocate_over_many_elements() -> None:
    element = np.array([0, 3, 0])
    s = np.array([5.45, 2.01, 2.05])
    np.testing.assert_array_equal(CHAIN.relocate(s, element), [3, 0, 0])
    np.testing.assert_array_equal(element, [0, 3, 0])


@pytest.mark.parametrize("s", [9.0, 1.0, np.nan])
def test_a_point_that_slid_off_the_end_is_refused(s: float) -> None:
    with pytest.raises(InfeasibleError, match="slid out"):
        CHAIN.relocate(np.array([2.05, s]), np.array([0, 0]))


@pytest.mark.parametrize("knots", [[0.0, 1.0, 1.0], [0.0, 2.0, 1.0], [0.0, np.nan, 1.0], [0.0, 1.0]])
def test_knots_that_do_not_ascend_are_refused(knots: list[float]) -> None:
    with pytest.raises(InconsistentInputError, match="ascending"):
        Chain(np.arange(18).reshape(3, 6), np.array(knots), CHAIN.section)
