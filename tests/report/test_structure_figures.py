"""Figures of free structures over time: what they show."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from matplotlib.figure import Figure

from catenaria.errors import InconsistentInputError
from catenaria.report.structure_figures import joint_force_figure, joint_height_figure, velocity_figure


def drawn(figure: Figure) -> dict[str, Any]:
    return {str(line.get_label()): line for line in figure.axes[0].get_lines()}


def form(duration: float, size: float = 1.0) -> Any:
    time = np.linspace(0.0, duration, 5)
    position = size * np.arange(30.0).reshape(5, 2, 3)
    history = SimpleNamespace(
        time=time,
        joint_name=("A", "B"),
        joint_position=position,
        joint_force=np.tile([[3.0, 0.0, 4.0], [0.0, 0.0, -1.0]], (5, 1, 1)),
        control_name=("h",),
        velocity=np.array([[0.0], [1e-18], [1e-4], [-1e-18], [0.0]]),
    )
    return SimpleNamespace(name="a structure", method="dynamic", histories=(history,))


def test_heights_of_joints_are_drawn_with_their_mark() -> None:
    figure = joint_height_figure(form(10.0), ["B"], {"wanted": 7.0})
    lines = drawn(figure)
    np.testing.assert_allclose(lines["B"].get_ydata(), [5.0, 11.0, 17.0, 23.0, 29.0])
    assert "wanted: 7 m" in lines
    assert figure.axes[0].get_ylabel() == "height [m]"


def test_tiny_heights_are_drawn_in_micrometres() -> None:
    figure = joint_height_figure(form(10.0, 1e-6), ["B"], {})
    np.testing.assert_allclose(drawn(figure)["B"].get_ydata(), [5.0, 11.0, 17.0, 23.0, 29.0])
    assert figure.axes[0].get_ylabel() == "height [µm]"


def test_forces_are_sizes() -> None:
    lines = drawn(joint_force_figure(form(10.0), ["A", "B"], {}))
    np.testing.assert_allclose(lines["A"].get_ydata(), 5.0)
    np.testing.assert_allclose(lines["B"].get_ydata(), 1.0)


def test_rounding_is_no_velocity() -> None:
    velocity = drawn(velocity_figure(form(10.0), ["h"], {}))["h"].get_ydata()
    np.testing.assert_allclose(velocity, [0.0, 0.0, 100.0, 0.0, 0.0])


@pytest.mark.parametrize(("duration", "scale"), [(10.0, "linear"), (1000.0, "log")])
def test_long_motions_have_logarithmic_time(duration: float, scale: str) -> None:
    assert joint_height_figure(form(duration), ["A"], {}).axes[0].get_xscale() == scale


def test_a_static_form_has_no_course() -> None:
    static = SimpleNamespace(name="a structure", method="direct", histories=())
    with pytest.raises(InconsistentInputError, match="no course to be drawn"):
        joint_height_figure(static, ["A"], {})  # pyright: ignore[reportArgumentType]  # a stand-in
