"""Figures of validation cases: what they show."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from catenaria.report.validation_figures import difference_figure, tension_measure_figure


def drawn(figure: Figure) -> dict[str, Any]:
    return {str(line.get_label()): line for line in figure.axes[0].get_lines()}


def test_differences_are_drawn_by_name_with_the_tolerance() -> None:
    differences = {"direct": np.array([0.1, -0.2, 0.3]), "dynamic": np.array([0.2, 0.0, 0.1])}
    figure = difference_figure("Lengths: Table 5", "difference [m]", differences, 0.15)
    lines = drawn(figure)
    np.testing.assert_array_equal(lines["direct"].get_ydata(), differences["direct"])
    np.testing.assert_array_equal(lines["dynamic"].get_xdata(), [1, 2, 3])
    assert figure.axes[0].get_legend_handles_labels()[1][0] == "tolerance: ±0.15"
    assert figure.axes[0].get_xticks().tolist() == [1, 2, 3]


def result_on(elements: int, measure: str, tension: float) -> Any:
    wire = SimpleNamespace(measure=measure, tension_mean=tension)
    return SimpleNamespace(inputs={"solver": {"mesh": {"even": elements}}}, wires=(None, wire))


def test_tensions_are_drawn_over_the_number_of_elements() -> None:
    results = [
        result_on(100, "strain", 15.9e3),
        result_on(60, "reaction", 15.0e3),
        result_on(200, "strain", 15.1e3),
    ]
    lines = drawn(tension_measure_figure(results, {"wanted": 15e3}))
    np.testing.assert_allclose(lines["N of (11)"].get_xdata(), [100, 200])
    np.testing.assert_allclose(lines["N of (11)"].get_ydata(), [15.9, 15.1])
    np.testing.assert_allclose(lines["reaction"].get_ydata(), [15.0])
    np.testing.assert_allclose(lines["wanted: 15.00 kN"].get_ydata(), [15.0, 15.0])
