"""The figure of methods side by side on one line."""

from __future__ import annotations

import textwrap
from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.figure import Figure

from catenaria.report import draw, style
from catenaria.report.differences import Differences

AGREE = 0.05e-3  # m: methods whose lengths differ by less are drawn as one

_UPPER = "messenger wire"
_LETTERS = 110  # in a line of the subtitle


def differences_figure(name: str, reference: str, found: Mapping[str, Differences]) -> Figure:
    """Draw how far methods are from one of them along a line.

    Parameters
    ----------
    name, reference : str
        Names of the line and of the method with which others are compared.
    found : mapping of str to Differences
        By name of the method.
    """
    groups = agreeing(found)
    title = f"{name}: differences from the {reference} method"
    figure, panels = style.new_figure(title, _subtitle(groups), [2.6] * 3)
    axes = [row[0] for row in panels]
    for i, group in enumerate(groups):
        each, colour = found[group[0]], style.CYCLE[i % len(style.CYCLE)]
        label = group[0] if len(group) == 1 else f"{group[0]} and {len(group) - 1} more"
        for panel, values in ((axes[0], 1e3 * each.length), (axes[2], each.force)):
            draw.line(panel, each.dropper_x, values, colour, width=0.8)
            draw.points(panel, each.dropper_x, values, colour, label)
        upper = each.height[each.wire.index(_UPPER)]
        draw.line(axes[1], each.x, 1e3 * upper, colour, label, width=1.2)
    titles = ("Length of droppers", f"Height of the {_UPPER}", "Force of droppers on the lower wire")
    for panel, text, unit in zip(axes, titles, ("mm", "mm", "N"), strict=True):
        style.describe(panel, text, "x [m]", f"difference [{unit}]")
    for panel in axes:  # so that droppers of all panels stand above each other
        panel.set_xlim(axes[1].get_xlim())
    if found:
        style.legend(axes[0], 3)
    return figure


def agreeing(found: Mapping[str, Differences]) -> list[list[str]]:
    """Return the names of methods in groups whose dropper lengths agree with those of the group's first.

    Examples
    --------
    >>> x = np.arange(3.0)
    >>> y = np.zeros((1, 3))
    >>> a, b, c = (Differences(x, l + 0.0 * x, x, x, ("messenger wire",), y, y) for l in (0.0, 0.04e-3, 5e-3))
    >>> agreeing({"a": a, "b": b, "c": c})
    [['a', 'b'], ['c']]
    """
    groups: list[list[str]] = []
    for name, each in found.items():
        for group in groups:
            if np.max(np.abs(each.length - found[group[0]].length), initial=0.0) <= AGREE:
                group.append(name)
                break
        else:
            groups.append([name])
    return groups


def _subtitle(groups: Sequence[Sequence[str]]) -> str:
    """Say which methods are drawn as one."""
    several = "; ".join(", ".join(group) for group in groups if len(group) > 1)
    if not several:
        return "Dropper lengths, heights of the messenger, dropper forces."
    text = f"Drawn as one, because their lengths agree to {1e3 * AGREE:g} mm: {several}."
    return textwrap.fill(text, _LETTERS)
