"""Differences between results, and their figure."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from matplotlib.figure import Figure

from catenaria.report.difference_figure import agreeing, differences_figure
from catenaria.report.differences import Differences, _along, differences
from catenaria.results import FormResult
from catenaria.results.form import Profile


def profile(x: np.ndarray, z: np.ndarray) -> Profile:
    none = np.zeros_like(x)
    return Profile(x, x, none, z, none, none, none, none, x, none, z)


def both(x: np.ndarray, length: np.ndarray, height: np.ndarray) -> Differences:
    """Differences of two wires, of which the upper one differs in height."""
    wires = ("contact wire", "messenger wire")
    heights = np.array([0.0 * height, height])
    return Differences(
        x, length, 0.1 * np.cos(x), np.linspace(0.0, 65.0, height.size), wires, heights, heights
    )


def test_a_curve_with_kinks_is_met_between_its_points() -> None:
    """Parabolas with a kink: exact, where straight pieces and parabolas across the kink are not."""

    def curve(x: np.ndarray) -> np.ndarray:
        return 1e-3 * x**2 + 0.02 * np.abs(x - 10.0)

    points, x = np.linspace(0.0, 20.0, 17), np.linspace(0.0, 20.0, 1000)
    shape = profile(points, curve(points))
    np.testing.assert_allclose(_along(shape.chainage, shape.height, x), curve(x), atol=1e-12)
    assert np.abs(np.interp(x, points, curve(points)) - curve(x)).max() > 1e-4


def test_methods_that_agree_are_drawn_as_one() -> None:
    x = np.linspace(0.0, 60.0, 7)
    each = both(x, 1e-3 * np.sin(x), 1e-3 * x)
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
    droppers = np.linspace(4.0, 61.0, 7)
    each = both(droppers, 0.0 * droppers, np.zeros(50))
    figure = differences_figure("a line", "direct", {"separated": each})
    assert {axes.get_xlim() for axes in figure.axes} == {figure.axes[1].get_xlim()}


def moved(result: FormResult, wire: int, **by: float) -> FormResult:
    """Return the result with a wire's fields increased."""
    wires = list(result.wires)
    shape = wires[wire].profile
    changed = {name: getattr(shape, name) + value for name, value in by.items()}
    wires[wire] = replace(wires[wire], profile=replace(shape, **changed))
    return replace(result, wires=tuple(wires))


def test_every_wire_is_compared_in_height_and_sideways(result: FormResult) -> None:
    same = differences(result, result)
    assert (same.largest_length, same.largest_height, same.largest_lateral, same.largest_force) == (
        0,
        0,
        0,
        0,
    )
    assert same.wire == ("contact wire", "messenger wire")
    for wire in (0, 1):
        found = differences(moved(result, wire, height=2e-3, lateral=-3e-3), result)
        np.testing.assert_allclose(found.height[wire], 2e-3, atol=1e-12)
        assert np.all(found.height[1 - wire] == 0.0)
        assert (found.largest_height, found.largest_lateral) == pytest.approx((2e-3, 3e-3))


def test_a_wire_is_compared_only_where_it_is(result: FormResult) -> None:
    """A stitch wire, for example: beyond its ends there is nothing to compare."""
    shape = result.wires[1].profile
    inside = (shape.chainage > 60.0) & (shape.chainage < 70.0)
    short = replace(
        shape, chainage=shape.chainage[inside], height=shape.height[inside], lateral=shape.lateral[inside]
    )
    piece = replace(result, wires=(result.wires[0], replace(result.wires[1], profile=short)))
    found = differences(moved(piece, 1, height=2e-3), piece)
    np.testing.assert_allclose(found.height[1, (found.x > 60.5) & (found.x < 69.5)], 2e-3)
    assert np.all(found.height[1, (found.x < 60.0) | (found.x > 70.0)] == 0.0)
    assert np.any(differences(moved(result, 1, height=2e-3), result).height[1, found.x < 60.0] != 0.0)
