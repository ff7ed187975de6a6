"""Layout and mesh of cables at the start."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from catenaria.structure import Cable, Structure
from catenaria.structure.layout import lay_out
from catenaria.structure.mesh import knots


def cable(points: list[list[float]], length: float | None = None) -> Cable:
    return Cable.model_validate(
        {"section": "wire", "points": points, "unstressed_length": length, "elements": 4}
    )


def check_slope(laid: Cable, s: np.ndarray, tangent: Cable | None = None) -> None:
    """Compare r' with central differences of r."""
    h = 1e-5 * laid.length
    ahead, behind = (lay_out(laid, s + side * h)[0] for side in (1.0, -1.0))
    np.testing.assert_allclose((ahead - behind) / (2.0 * h), lay_out(tangent or laid, s)[1], atol=1e-8)


INSIDE = np.array([0.7, 2.0, 4.9])


@pytest.mark.parametrize("length", [None, 5.4, 7.0])
def test_slope_is_the_derivative_of_position(length: float | None) -> None:
    laid = cable([[1, 2, 3], [4, 6, 5.5]], length)
    check_slope(laid, INSIDE)
    with pytest.raises(AssertionError):
        check_slope(laid, INSIDE, cable([[1, 2, 3], [4, 6, 5.501]], length))


def test_a_straight_cable_is_free_of_strain() -> None:
    laid = cable([[1, 2, 3], [4, 6, 3]])
    position, slope = lay_out(laid, np.array([0.0, 2.5, 5.0]))
    np.testing.assert_allclose(position, [[1, 2, 3], [2.5, 4, 3], [4, 6, 3]], atol=1e-14)
    np.testing.assert_allclose(np.linalg.norm(slope, axis=1), 1.0, rtol=1e-14)


def test_a_short_cable_is_stretched() -> None:
    _, slope = lay_out(cable([[0, 0, 0], [5, 0, 0]], 4.0), INSIDE)
    np.testing.assert_allclose(slope, np.tile([1.25, 0.0, 0.0], (3, 1)), rtol=1e-14)


def test_a_slack_cable_hangs() -> None:
    laid = cable([[1, 2, 3], [4, 6, 3]], 7.0)
    position, slope = lay_out(laid, np.array([0.0, 3.5, 7.0]))
    np.testing.assert_allclose(position[[0, 2]], laid.points, atol=1e-12)
    np.testing.assert_allclose(position[1, :2], [2.5, 4.0], atol=1e-12)
    assert position[1, 2] < 1.0
    np.testing.assert_allclose(np.linalg.norm(slope, axis=1), 1.0, rtol=1e-12)


def test_bends_are_nodes_with_the_mean_direction() -> None:
    laid = cable([[0, 0, 0], [3, 0, 0], [3, 4, 0]], 6.3)
    position, slope = lay_out(laid, np.array([3.0, 6.3]) * [6.3 / 7.0, 1.0])
    np.testing.assert_allclose(position, [[3, 0, 0], [3, 4, 0]], atol=1e-12)
    np.testing.assert_allclose(slope[0], [7.0 / 12.6, 7.0 / 12.6, 0.0], rtol=1e-12)
    check_slope(laid, np.array([1.0, 3.0 * 6.3 / 7.0, 5.0]))


def test_joints_masses_and_bends_add_nodes(taut: dict[str, Any]) -> None:
    taut["masses"] = {"m": {"on": {"cable": "main", "point": 3.3}, "mass": 1.0}}
    taut["joints"]["hinge"] = {
        "type": "spherical",
        "on": {"cable": "main", "point": 2.2},
        "to": {"cable": "main", "point": 2.2},
    }
    s = knots(Structure.model_validate(taut), "main")
    np.testing.assert_allclose(s, np.sort(np.append(np.linspace(0.0, 10.5, 22), [2.2, 3.3])), atol=1e-12)
    assert np.all(np.diff(s) > 1e-6)


def test_own_nodes(taut: dict[str, Any]) -> None:
    taut["cables"]["main"] |= {"elements": None, "nodes": [1.0, 4.0, 9.0]}
    s = knots(Structure.model_validate(taut), "main")
    np.testing.assert_array_equal(s, [0.0, 1.0, 4.0, 9.0, 10.5])
