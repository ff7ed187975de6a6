"""The right half of the page: figures, tables and checks of the latest form."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from nicegui import ui

from catenaria.results import FormResult
from catenaria.studio import tables
from catenaria.studio.compare import differences
from catenaria.studio.live import Content, Said, live, show, takes
from catenaria.studio.plots import difference_plots, plan_plot, profile_plot, tension_plots
from catenaria.studio.state import Session

TABS = ("form", "tension", "droppers", "supports", "checks", "compare", "replay", "file")
_APART = ("replay", "file")  # they draw themselves
_LATE = ("checks",)  # they show what follows the form


class Panels:
    """What is shown of one session; only the open tab is drawn."""

    def __init__(self, session: Session) -> None:
        self._session = session
        self._drawn: set[str] = set()
        self.dark = False
        self._places: dict[str, Any] = {}
        with ui.tabs().classes("tabs").props("dense no-caps align=left") as self._tabs:
            self._tabs.mark("tabs")
            for name in TABS:
                ui.tab(name, label=name.capitalize()).mark(f"tab-{name}")
        with ui.tab_panels(self._tabs, value="form", animated=False).classes("panels"):
            for name in TABS:
                with ui.tab_panel(name):
                    self._places[name] = ui.column().classes("panel")
        self._tabs.on_value_change(self._open)

    def place(self, name: str) -> Any:
        """Return where a tab's contents go."""
        return self._places[name]

    def is_open(self, name: str) -> bool:
        """Return whether a tab is the one that is seen."""
        return self._tabs.value == name

    def when_opened(self, act: Callable[[], None]) -> None:
        """Call something whenever another tab is opened."""
        self._tabs.on_value_change(lambda: act())

    def clear(self) -> None:
        """Show nothing of the line before."""
        self._drawn.clear()
        for name, place in self._places.items():
            if name not in _APART:
                place.clear()

    def refresh(self) -> None:
        """Draw the open tab anew, and the others when they are opened."""
        self._drawn.clear()
        self._draw()

    def complete(self) -> None:
        """Draw what follows the form: its audit and checks."""
        self._drawn.difference_update(_LATE)
        self._draw()

    def _open(self) -> None:
        """Draw a tab that was not seen, which the browser makes anew from what it was made of."""
        self._draw()
        if self._name not in _APART:
            for element in self._there(self._name):
                element.update()

    @property
    def _name(self) -> str:
        return str(self._tabs.value or "form")

    def _there(self, name: str) -> list[Any]:
        return list(self._places[name].default_slot.children)

    def _draw(self) -> None:
        name, form = self._name, self._session.form
        late = name in _LATE and not self._session.audited
        if name in self._drawn or name in _APART or form is None or late:
            return
        self._drawn.add(name)
        contents: dict[str, Callable[[FormResult], Sequence[Content | None]]] = {
            "form": self._form,
            "tension": lambda form: tension_plots(form, self.dark),
            "droppers": lambda form: [tables.schedule(form, self._session.pinned)],
            "supports": lambda form: [tables.wires(form), tables.supports(form), tables.arms(form)],
            "checks": self._checks,
            "compare": self._compare,
        }
        self._put(name, [content for content in contents[name](form) if content])

    def _form(self, form: FormResult) -> Sequence[Content | None]:
        pinned = self._session.pinned
        return profile_plot(form, pinned, self.dark), plan_plot(form, pinned, self.dark)

    def _checks(self, form: FormResult) -> Sequence[Content]:
        said = "\n".join((*form.audit.lines(), *form.audit.findings))
        return (
            tables.checks(self._session.checks),
            Said(said, "audit"),
            Said("No rebuild while editing: the result folder has it.", "quiet"),
        )

    def _compare(self, form: FormResult) -> Sequence[Content | None]:
        variant = self._session.pinned or self._session.before
        if variant is None:
            return [Said("Nothing to compare with yet: edit something, or pin this variant.")]
        found = differences(form, variant)
        most = max((abs(value) for value in found.cut_length.tolist()), default=0.0)
        against = "the pinned variant" if self._session.pinned is not None else "the form before"
        by = f"droppers differ by up to {most:.2f} mm" if found.dropper else "no span has as many droppers"
        return [*difference_plots(form, variant, self.dark), Said(f"Against {against}: {by}.", "quiet")]

    def _put(self, name: str, contents: list[Content]) -> None:
        """Show contents in the elements that are there, or make others that can show them."""
        there = self._there(name)
        if len(there) == len(contents) and all(map(takes, there, contents)):
            show(there, contents)
            return
        self._places[name].clear()
        with self._places[name]:
            for content in contents:
                element = live(content)
                element.mark(f"{element.kind}-{name}")
