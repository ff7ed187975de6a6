"""Elements that take other contents without the page around them being rendered anew."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any, Final, TypeAlias

from nicegui import ui

from catenaria.studio.plots import Figure
from catenaria.studio.tables import Shown

# All in one task of the browser, which paints once when it is over.
_SHOW: Final = """for (const [id, content] of {contents}) {{
  const there = getElement(id);
  if (there?.Plotly) there.Plotly.react(there.$el, content.data, content.layout, content.config);
  else there?.show?.(content);
}}"""


@dataclass(frozen=True)
class Said:
    """A text in lines, with the classes of its looks."""

    text: str
    classes: str = ""


Content: TypeAlias = Figure | Shown | Said


class LiveFigure(ui.plotly):
    """A figure of Plotly, and whether a browser has drawn it."""

    kind = "figure"

    def __init__(self, figure: Figure) -> None:
        super().__init__(figure)  # pyright: ignore[reportUnknownMemberType]
        self.classes("figure").style(f"height: {figure['layout']['height']}px")
        self.drawn = False
        self.on("plotly_afterplot", self._note, args=[])

    def keep(self, figure: Figure) -> object:
        """Keep a figure for whenever the element is made anew; return what is sent until then."""
        self.figure = figure
        return figure

    def _note(self) -> None:
        self.drawn = True


class _Own(ui.element):
    """An element with a component of ours, which has the contents and a method to show others."""

    def __init__(self, content: object) -> None:
        self._content = content
        super().__init__()
        self.drawn = False
        self.on("drawn", self._note, args=[])
        self.update()

    def update(self) -> None:
        """Send the element with what it shows now."""
        with self.props.suspend_updates():
            self.props["content"] = self._content
        super().update()

    def _kept(self, content: object) -> object:
        self._content = content
        return content

    def _note(self) -> None:
        self.drawn = True


class LiveTable(_Own, component="live_table.js"):
    """A table whose cells are texts."""

    kind = "table"

    def __init__(self, table: Shown) -> None:
        super().__init__(asdict(table))
        self._table = table
        self.classes("listing")

    def keep(self, table: Shown) -> object:
        """Keep a table for whenever the element is made anew; return what is sent until then."""
        self._table = table
        return self._kept(asdict(table))

    @property
    def rows(self) -> list[dict[str, str]]:
        """The rows that are shown, from names of columns to texts."""
        return self._table.rows


class LiveText(_Own, component="live_text.js"):
    """A text in lines."""

    kind = "text"

    def __init__(self, said: Said) -> None:
        super().__init__(said.text)
        self._said = said
        self.classes(f"words {said.classes}")

    def keep(self, said: Said) -> object:
        """Keep a text for whenever the element is made anew; return what is sent until then."""
        self._said = said
        return self._kept(said.text)

    @property
    def text(self) -> str:
        """What is shown."""
        return self._said.text


Live: TypeAlias = LiveFigure | LiveTable | LiveText


def live(content: Content) -> Live:
    """Make the element that shows a content, in the place that is open."""
    if isinstance(content, Shown):
        return LiveTable(content)
    return LiveText(content) if isinstance(content, Said) else LiveFigure(content)


def takes(element: object, content: Content) -> bool:
    """Return whether an element is one that can show a content."""
    if isinstance(content, Shown):
        return isinstance(element, LiveTable)
    return isinstance(element, LiveText if isinstance(content, Said) else LiveFigure)


def show(elements: Sequence[Live], contents: Sequence[Any]) -> None:
    """Show other contents in elements that are there.

    Every change of an element makes the browser go through the whole page, with hundreds of fields. Those
    that it has drawn are therefore handed their contents by a message of their own.
    """
    sent: list[tuple[int, object]] = []
    for element, content in zip(elements, contents, strict=True):
        data = element.keep(content)
        if element.drawn:
            sent.append((element.id, data))
        else:
            element.update()
    if sent:
        elements[0].client.run_javascript(_SHOW.format(contents=json.dumps(sent)))
