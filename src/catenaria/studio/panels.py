"""The right half of the page: figures, tables and checks of the latest form."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from nicegui import ui

from catenaria.results import FormResult
from catenaria.studio import tables
from catenaria.studio.compare import differences
from catenaria.studio.figure import LiveFigure, redraw
from catenaria.studio.plots import Figure, difference_plots, plan_plot, profile_plot, tension_plots
from catenaria.studio.state import Session
from catenaria.studio.tables import Shown

TABS = ("form", "tension", "droppers", "supports", "checks", "compare", "replay", "file")
_APART = ("replay", "file")  # they draw themselves
_LATE = ("checks",)  # they show what follows the form

_VERDICT = """<q-td :props="props">
  <q-badge :label="props.value" :color="{passes: 'positive', fails: 'negative'}[props.value] || 'grey-7'" />
</q-td>"""


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

    def refresh(self) -> bool:
        """Draw the open tab anew, and the others when they are opened; return whether that goes ahead."""
        self._drawn.clear()
        return self._draw()

    def complete(self) -> bool:
        """Draw what follows the form: its audit and checks."""
        self._drawn.difference_update(_LATE)
        return self._draw()

    def _open(self) -> None:
        """Draw a tab that was not seen, whose figures the browser makes anew from what they were made of."""
        self._draw()
        for figure in self._live(self._name):
            figure.update()

    @property
    def _name(self) -> str:
        return str(self._tabs.value or "form")

    def _draw(self) -> bool:
        name, form = self._name, self._session.form
        late = name in _LATE and not self._session.audited
        if name in self._drawn or name in _APART or form is None or late:
            return False
        self._drawn.add(name)
        draw: dict[str, Callable[[FormResult], bool]] = {
            "form": self._form,
            "tension": self._tension,
            "droppers": self._droppers,
            "supports": self._supports,
            "checks": self._checks,
            "compare": self._compare,
        }
        return draw[name](form)

    def _form(self, form: FormResult) -> bool:
        pinned = self._session.pinned
        return self._figures(
            "form", [profile_plot(form, pinned, self.dark), plan_plot(form, pinned, self.dark)]
        )

    def _tension(self, form: FormResult) -> bool:
        return self._figures("tension", [*tension_plots(form, self.dark)])

    def _droppers(self, form: FormResult) -> bool:
        return self._tables("droppers", [("", tables.schedule(form, self._session.pinned))])

    def _supports(self, form: FormResult) -> bool:
        shown = [("Wires", tables.wires(form)), ("Supports", tables.supports(form))]
        return self._tables("supports", [*shown, ("Steady arms", tables.arms(form))])

    def _checks(self, form: FormResult) -> bool:
        self._tables("checks", [("Rules of standards and practice", tables.checks(self._session.checks))])
        with self._places["checks"]:
            for line in (*form.audit.lines(), *form.audit.findings):
                ui.label(line).classes("audit")
            ui.label("No rebuild while editing: the result folder has it.").classes("quiet")
        return False

    def _compare(self, form: FormResult) -> bool:
        variant = self._session.pinned or self._session.before
        place = self._places["compare"]
        place.clear()
        if variant is None:
            with place:
                ui.label("Nothing to compare with yet: edit something, or pin this variant.")
            return False
        found = differences(form, variant)
        most = max((abs(value) for value in found.cut_length.tolist()), default=0.0)
        self._figures("compare", [*difference_plots(form, variant, self.dark)])
        against = "the pinned variant" if self._session.pinned is not None else "the form before"
        by = f"droppers differ by up to {most:.2f} mm" if found.dropper else "no span has as many droppers"
        with place:
            said = ui.label(f"Against {against}: {by}.")
        said.classes("quiet").mark("compared")
        return False

    def _live(self, name: str) -> list[LiveFigure]:
        children = self._places[name].default_slot.children
        return [child for child in children if isinstance(child, LiveFigure)]

    def _figures(self, name: str, figures: list[Figure | None]) -> bool:
        """Put new data into the figures that are there, or make new ones."""
        place, wanted = self._places[name], [figure for figure in figures if figure is not None]
        there = self._live(name)
        if len(there) == len(wanted) == len(place.default_slot.children):
            return redraw(there, wanted)
        place.clear()
        with place:
            for figure in wanted:
                LiveFigure(figure)
        return False

    def _tables(self, name: str, shown: list[tuple[str, Shown]]) -> bool:
        place = self._places[name]
        place.clear()
        with place:
            for title, table in shown:
                if table.rows:
                    if title:
                        ui.label(title).classes("heading")
                    listing = ui.table(columns=table.columns, rows=table.rows, row_key="id").props(
                        "dense flat wrap-cells :pagination='{rowsPerPage: 0}' hide-pagination"
                    )
                    listing.add_slot("body-cell-verdict", _VERDICT)
                    listing.classes("listing").mark(f"table-{name}")
        return False
