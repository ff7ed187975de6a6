"""Differences between results, and their figure."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from catenaria.report.difference_figure import differences_figure
from catenaria.report.differences import Differences, _height
from catenaria.results.form import Profile


def profile(x: np.ndarray, z: np.ndarray) -> Profile:
    none = np.zeros_like(x)
    return Profile(x, x, none, z, none, none, none, none)


def test_a_curve_with_kinks_is_met_between_its_points() -> None:
    """Parabolas with a kink: exact, where straight pieces and parabolas across the kink are not."""

    def curve(x: np.ndarray) -> np.ndarray:
        return 1e-3 * x**2 + 0.02 * np.abs(x - 10.0)

    points, x = np.linspace(0.0, 20.0, 17), np.linspace(0.0, 20.0, 1000)
    shape = profile(points, curve(points))
    np.testing.assert_allclose(_height(shape, x), curve(x), atol=1e-12)
    assert np.abs(np.interp(x, points, curve(points)) - curve(x)).max() > 1e-4


def test_many_methods_fit_into_the_figure() -> None:
    x = np.linspace(0.0, 60.0, 7)
    each = Differences(x, 1e-3 * np.sin(x), 0.1 * np.cos(x), x, 0.0 * x, 1e-3 * x)
    assert each.largest_height == 0.06
    figure = differences_figure("a line", "direct", {f"method {i}": each for i in range(15)})
    assert isinstance(figure, Figure)
    assert [len(axes.get_lines()) for axes in figure.axes] == [30, 15, 30]
    assert len(differences_figure("a line", "direct", {}).axes) == 3
