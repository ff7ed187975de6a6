"""The right half of the page: figures, tables and checks of the latest form."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from nicegui import ui

from catenaria.results import FormResult
from catenaria.studio import tables
from catenaria.studio.compare import differences
from catenaria.studio.plots import Figure, difference_plots, plan_plot, profile_plot, tension_plots
from catenaria.studio.state import Session
from catenaria.studio.tables import Shown

TABS = ("form", "tension", "droppers", "supports", "checks", "compare", "replay")
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
        self._tabs.on_value_change(lambda: self._draw())

    def place(self, name: str) -> Any:
        """Return where a tab's contents go."""
        return self._places[name]

    def clear(self) -> None:
        """Show nothing of the line before."""
        self._drawn.clear()
        for name, place in self._places.items():
            if name != "replay":
                place.clear()

    def refresh(self) -> None:
        """Draw the open tab anew, and the others when they are opened."""
        self._drawn.clear()
        self._draw()

    def complete(self) -> None:
        """Draw what follows the form: its audit and checks."""
        self._drawn.difference_update(_LATE)
        self._draw()

    def _draw(self) -> None:
        name, form = str(self._tabs.value or "form"), self._session.form
        late = name in _LATE and not self._session.audited
        if name in self._drawn or name == "replay" or form is None or late:
            return
        self._drawn.add(name)
        draw: dict[str, Callable[[FormResult], None]] = {
            "form": self._form,
            "tension": self._tension,
            "droppers": self._droppers,
            "supports": self._supports,
            "checks": self._checks,
            "compare": self._compare,
        }
        draw[name](form)

    def _form(self, form: FormResult) -> None:
        pinned = self._session.pinned
        self._figures("form", [profile_plot(form, pinned, self.dark), plan_plot(form, pinned, self.dark)])

    def _tension(self, form: FormResult) -> None:
        self._figures("tension", [*tension_plots(form, self.dark)])

    def _droppers(self, form: FormResult) -> None:
        self._tables("droppers", [("", tables.schedule(form, self._session.pinned))])

    def _supports(self, form: FormResult) -> None:
        shown = [("Wires", tables.wires(form)), ("Supports", tables.supports(form))]
        self._tables("supports", [*shown, ("Steady arms", tables.arms(form))])

    def _checks(self, form: FormResult) -> None:
        self._tables("checks", [("Rules of standards and practice", tables.checks(self._session.checks))])
        with self._places["checks"]:
            for line in (*form.audit.lines(), *form.audit.findings):
                ui.label(line).classes("audit")
            ui.label("No rebuild while editing: the result folder has it.").classes("quiet")

    def _compare(self, form: FormResult) -> None:
        variant = self._session.pinned or self._session.before
        place = self._places["compare"]
        place.clear()
        if variant is None:
            with place:
                ui.label("Nothing to compare with yet: edit something, or pin this variant.")
            return
        found = differences(form, variant)
        most = max((abs(value) for value in found.cut_length.tolist()), default=0.0)
        self._figures("compare", [*difference_plots(form, variant, self.dark)])
        against = "the pinned variant" if self._session.pinned is not None else "the form before"
        with place:
            said = ui.label(f"Against {against}: droppers differ by up to {most:.2f} mm.")
        said.classes("quiet").mark("compared")

    def _figures(self, name: str, figures: list[Figure | None]) -> None:
        """Put new data into the figures that are there, or make new ones."""
        place, wanted = self._places[name], [figure for figure in figures if figure is not None]
        there = [child for child in place.default_slot.children if isinstance(child, ui.plotly)]
        if len(there) == len(wanted) and len(place.default_slot.children) == len(there):
            for element, figure in zip(there, wanted, strict=True):
                element.figure = figure
                element.update()
            return
        place.clear()
        with place:
            for figure in wanted:
                ui.plotly(figure).classes("figure").style(f"height: {figure['layout']['height']}px")

    def _tables(self, name: str, shown: list[tuple[str, Shown]]) -> None:
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
