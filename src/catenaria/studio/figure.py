"""A figure whose data change without the page around it being laid out anew."""

from __future__ import annotations

from nicegui import ui

from catenaria.studio.plots import Figure


class LiveFigure(ui.plotly):
    """A figure of Plotly.

    Every change of an element makes the browser go through the whole page, with hundreds of fields. A figure
    that is there is therefore handed new data by a message of its own, which comes first.
    """

    def __init__(self, figure: Figure) -> None:
        super().__init__(figure)  # pyright: ignore[reportUnknownMemberType]
        self.classes("figure").style(f"height: {figure['layout']['height']}px")
        self._there = False
        self.on("plotly_afterplot", self._note, args=[])

    def redraw(self, figure: Figure) -> bool:
        """Draw other data; return whether they go ahead of changes to the page."""
        self.figure = figure
        if not self._there:
            self.update()
            return False
        with self.props.suspend_updates():
            self.props["options"] = figure
        parts = [figure[part] for part in ("data", "layout", "config")]
        self.run_plot_method("react", *parts)  # pyright: ignore[reportUnknownMemberType]
        return True

    def _note(self) -> None:
        self._there = True
