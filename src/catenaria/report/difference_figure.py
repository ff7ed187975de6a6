"""The figure of methods side by side on one line."""

from __future__ import annotations

from collections.abc import Mapping

from matplotlib.figure import Figure

from catenaria.report import style
from catenaria.report.differences import Differences

_DASHES = ("-", (0, (5, 2)), (0, (1, 1.5)), (0, (6, 2, 1, 2)))


def differences_figure(name: str, reference: str, found: Mapping[str, Differences]) -> Figure:
    """Draw how far methods are from one of them along a line.

    Parameters
    ----------
    name, reference : str
        Names of the line and of the method with which others are compared.
    found : mapping of str to Differences
        By name of the method.
    """
    title = f"{name}: differences from the {reference} method"
    figure, panels = style.new_figure(
        title,
        "Methods that agree lie one on the other.",
        [2.6] * 3,
    )
    axes = [row[0] for row in panels]
    for i, (method, each) in enumerate(found.items()):
        colour, dashes = style.CYCLE[i % 6], _DASHES[i // 6 % 4]
        for panel, values in ((axes[0], 1e3 * each.length), (axes[2], each.force)):
            style.line(panel, each.dropper_x, values, colour, width=0.8, style=dashes)
            style.points(panel, each.dropper_x, values, colour, method)
        style.line(axes[1], each.x, 1e3 * each.messenger_height, colour, method, width=1.2, style=dashes)
    titles = ("Length of droppers", "Height of the messenger wire", "Force of droppers on the contact wire")
    for panel, text, unit in zip(axes, titles, ("mm", "mm", "N"), strict=True):
        style.describe(panel, text, "x [m]", f"difference [{unit}]")
    if found:
        style.legend(axes[0], 4)
    return figure
