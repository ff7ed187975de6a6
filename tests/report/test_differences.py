"""Differences between results, and their figure."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from matplotlib.figure import Figure

from catenaria.report.difference_figure import agreeing, differences_figure
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


def test_methods_that_agree_are_drawn_as_one() -> None:
    x = np.linspace(0.0, 60.0, 7)
    each = Differences(x, 1e-3 * np.sin(x), 0.1 * np.cos(x), x, 0.0 * x, 1e-3 * x)
    other = replace(each, length=each.length + 0.06e-3)
    assert each.largest_height == 0.06
    found = {f"method {i}": other if i % 3 else each for i in range(15)}
    assert [len(group) for group in agreeing(found)] == [5, 10]
    figure = differences_figure("a line", "direct", found)
    assert isinstance(figure, Figure)
    assert [len(axes.get_lines()) for axes in figure.axes] == [4, 2, 4]
    told = "".join(text.get_text() for text in figure.texts).replace("\n", " ")
    assert all(f"{name}" in told for name in found)
    assert len(differences_figure("a line", "direct", {}).axes) == 3


def test_droppers_stand_where_the_wire_has_them_in_all_panels() -> None:
    droppers, x = np.linspace(4.0, 61.0, 7), np.linspace(0.0, 65.0, 50)
    each = Differences(droppers, 0.0 * droppers, 0.0 * droppers, x, 0.0 * x, 0.0 * x)
    figure = differences_figure("a line", "direct", {"separated": each})
    assert {axes.get_xlim() for axes in figure.axes} == {figure.axes[1].get_xlim()}
