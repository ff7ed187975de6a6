"""Figures of validation cases: differences from references, and what the measure of tension does."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from catenaria.report import draw, scales, style
from catenaria.results import FormResult

FloatArray = NDArray[np.float64]


def difference_figure(
    title: str, quantity: str, differences: Mapping[str, FloatArray], tolerance: float
) -> Figure:
    """Draw how far several computations are from a reference, number by number.

    Parameters
    ----------
    title : str
        What is compared with what.
    quantity : str
        Label of the vertical axis, with unit.
    differences : mapping of str to FloatArray
        Computed minus reference, by name of the computation.
    tolerance : float
        Half width of the band in which numbers agree.
    """
    figure, [[axes]] = style.new_figure(title, "Computed number minus the reference.", [3.4])
    draw.band(axes, 0.0, tolerance, f"tolerance: ±{tolerance:g}")
    for colour, (name, difference) in zip(style.CYCLE, differences.items(), strict=False):
        number = np.arange(1.0, difference.size + 1.0)
        draw.line(axes, number, difference, colour, width=0.8)
        draw.points(axes, number, difference, colour, name)
    scales.count_along(axes, np.arange(1.0, max(map(len, differences.values())) + 1.0))
    style.describe(axes, "", "number of the dropper", quantity)
    style.legend_above(axes)
    return figure


def tension_measure_figure(results: Sequence[FormResult], marks: Mapping[str, float]) -> Figure:
    """Draw which mean messenger tension is held on meshes of equal elements by either measure of tension.

    Parameters
    ----------
    results : sequence of FormResult
        Found on meshes of equal elements.
    marks : mapping of str to float
        Tensions to be marked, by name [N].
    """
    text = (
        "The device's reaction, or the axial force (11) at the end support, is held at the wanted tension.\n"
        "Several points at one number of elements differ in nothing but the length of the wire's tail."
    )
    figure, [[axes]] = style.new_figure("Mean messenger tension that is held on equal elements", text, [3.6])
    number = np.array([float(result.inputs["solver"]["mesh"]["even"]) for result in results])
    tension = 1e-3 * np.array([result.wires[1].tension_mean for result in results])
    for colour, measure, name in ((style.RED, "strain", "N of (11)"), (style.BLUE, "reaction", "reaction")):
        chosen = np.array([result.wires[1].measure == measure for result in results])
        draw.points(axes, number[chosen], tension[chosen], colour, name)
    ends = np.array([number.min(), number.max()])
    for colour, (name, level) in zip((style.DARK, *style.CYCLE[2:]), marks.items(), strict=False):
        label = f"{name}: {1e-3 * level:.2f} kN"
        draw.line(axes, ends, np.full(2, 1e-3 * level), colour, label, style=(0, (4, 3)))
    scales.count_along(axes, number, logarithmic=True)
    style.describe(axes, "", "number of elements of the messenger wire", "mean tension [kN]")
    style.legend_above(axes)
    return figure
