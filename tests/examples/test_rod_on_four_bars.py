"""Example 1 of the paper against rigid statics, a beam on springs and a beam on rigid supports."""

from __future__ import annotations

from collections.abc import Callable
from types import ModuleType

import numpy as np
import pandas as pd
import pytest

A_ROD, A_BAR = np.pi * 0.03**2 / 4.0, np.pi * 0.02**2 / 4.0
WEIGHT = 7800.0 * A_ROD * 9.8  # N/m
SPRING = 1e11 * A_BAR / 0.5  # N/m


@pytest.fixture(scope="module")
def example(load_example: Callable[[str], ModuleType]) -> ModuleType:
    return load_example("rod_on_four_bars")


@pytest.fixture(scope="module")
def table(example: ModuleType) -> pd.DataFrame:
    return example.table()


def check(forces: pd.Series, expected: np.ndarray, tolerance: float) -> None:
    np.testing.assert_allclose(forces.to_numpy(), expected, atol=tolerance)


def beam_on_springs(EJ: float) -> np.ndarray:
    """Return the forces of springs at 2, 4, 6, 8 m under a beam of Euler and Bernoulli, hinged at 0."""
    h, nodes = 0.5, 21
    K, f = np.zeros((2 * nodes, 2 * nodes)), np.zeros(2 * nodes)
    k = (
        EJ
        / h**3
        * np.array(
            [
                [12, 6 * h, -12, 6 * h],
                [6 * h, 4 * h * h, -6 * h, 2 * h * h],
                [-12, -6 * h, 12, -6 * h],
                [6 * h, 2 * h * h, -6 * h, 4 * h * h],
            ]
        )
    )
    for i in range(0, 2 * nodes - 2, 2):
        K[i : i + 4, i : i + 4] += k
        f[i : i + 4] += WEIGHT * h * np.array([0.5, h / 12, 0.5, -h / 12])
    bars = 2 * np.array([4, 8, 12, 16])
    K[bars, bars] += SPRING
    deflection = np.zeros(2 * nodes)
    deflection[1:] = np.linalg.solve(K[1:, 1:], f[1:])
    return SPRING * deflection[bars]


def continuous_beam() -> np.ndarray:
    """Return the reactions at 2, 4, 6, 8 m of a beam on five rigid supports with an overhang of 2 m.

    Clapeyron's theorem of three moments: M_{i-1} + 4 M_i + M_{i+1} = -w L^2/2 for equal spans.
    """
    L, overhang = 2.0, -WEIGHT * 2.0**2 / 2.0
    matrix = np.array([[4.0, 1.0, 0.0], [1.0, 4.0, 1.0], [0.0, 1.0, 4.0]])
    right = np.full(3, -WEIGHT * L**2 / 2.0)
    right[2] -= overhang
    M = np.concatenate(([0.0], np.linalg.solve(matrix, right), [overhang]))
    shear = np.diff(M) / L  # M is that of a sagging beam
    reactions = WEIGHT * L + np.diff(shear)
    return np.append(reactions, WEIGHT * L / 2.0 - shear[-1] + WEIGHT * 2.0)


def test_a_rigid_rod_gives_the_analytical_forces(table: pd.DataFrame) -> None:
    """Eq. (30): 45.03, 90.05, 135.08, 180.11 N."""
    analytical = 10.0 * WEIGHT / np.array([12.0, 6.0, 4.0, 3.0])
    check(table["rigid"], analytical, 1e-3)
    check(table["(30)"], analytical, 6e-3)
    with pytest.raises(AssertionError):
        check(table["fixed tops"], analytical, 1e-2)


@pytest.mark.parametrize("column", ["fixed tops", "dynamic"])
def test_the_paper_s_own_numbers(table: pd.DataFrame, column: str) -> None:
    """Table 1 to 0.01 N, with the polar moment of area, by statics and by the paper's method."""
    check(table[column], table["paper"].to_numpy(), 1.01e-2)
    check(table[column], beam_on_springs(1e18 * np.pi * 0.03**4 / 32.0), 2e-3)
    with pytest.raises(AssertionError):
        check(table["pi d^4/64"], table["paper"].to_numpy(), 0.05)


def test_the_true_moment_of_area(table: pd.DataFrame) -> None:
    check(table["pi d^4/64"], beam_on_springs(1e18 * np.pi * 0.03**4 / 64.0), 2e-3)


def test_weight_of_the_bars(table: pd.DataFrame) -> None:
    """Half of its weight stretches a bar besides the force at its foot; the rod sinks by 1 : 2 : 3 : 4."""
    stretching = table["heavy bars"].to_numpy() + 0.25 * 7800.0 * A_BAR * 9.8
    np.testing.assert_allclose(stretching / stretching[0], [1.0, 2.0, 3.0, 4.0], rtol=1e-2)
    balance = table["heavy bars"].to_numpy() @ [2.0, 4.0, 6.0, 8.0]
    np.testing.assert_allclose(balance, 50.0 * WEIGHT, rtol=1e-6)


def test_exact_heights_make_a_continuous_beam(table: pd.DataFrame) -> None:
    check(table["exact heights"], continuous_beam(), 1e-3)
    check(table["exact heights"], np.array([117.7, 123.5, 36.7, 219.0]), 0.05)
    with pytest.raises(AssertionError):
        check(table["fixed tops"], continuous_beam(), 1.0)


def test_the_course_is_drawn(example: ModuleType) -> None:
    form = example.solve_structure(example.FILE, "dynamic")
    (history,) = form.histories
    assert history.time.size > 20
    assert np.all(np.abs(history.parameter) < 1e-12)
    figure = example.course(history)
    assert [len(axes.lines) for axes in figure.axes] == [4, 4, 4]
