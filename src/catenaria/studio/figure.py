"""Figures whose data change without the page around them being laid out anew."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Final

from nicegui import ui

from catenaria.studio.plots import Figure

# All figures in one task of the browser, which paints once when it is over.
_REDRAW: Final = """for (const [id, figure] of {figures}) {{
  const shown = getElement(id);
  if (shown?.Plotly) shown.Plotly.react(shown.$el, figure.data, figure.layout, figure.config);
}}"""


class LiveFigure(ui.plotly):
    """A figure of Plotly, and whether a browser has drawn it."""

    def __init__(self, figure: Figure) -> None:
        super().__init__(figure)  # pyright: ignore[reportUnknownMemberType]
        self.classes("figure").style(f"height: {figure['layout']['height']}px")
        self.drawn = False
        self.on("plotly_afterplot", self._note, args=[])

    def _note(self) -> None:
        self.drawn = True


def redraw(shown: Sequence[LiveFigure], figures: Sequence[Figure]) -> bool:
    """Draw other data in figures that are there; return whether that goes ahead of changes to the page.

    Every change of an element makes the browser go through the whole page, with hundreds of fields. Figures
    that it has drawn are therefore handed new data by a message of their own, which comes first.
    """
    ahead = all(element.drawn for element in shown)
    for element, figure in zip(shown, figures, strict=True):
        element.figure = figure
        if ahead:
            with element.props.suspend_updates():
                element.props["options"] = figure
        else:
            element.update()
    if ahead and shown:
        data = [[element.id, figure] for element, figure in zip(shown, figures, strict=True)]
        shown[0].client.run_javascript(_REDRAW.format(figures=json.dumps(data)))
    return ahead
