"""The left half of the page: forms and tables in which a line is edited."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any, Final

from nicegui import events, ui

from catenaria.errors import Fault, InconsistentInputError
from catenaria.studio.documents import Tree
from catenaria.studio.fields import Field, entered, filled, message, shown, unplaced
from catenaria.studio.forms import all_fields, line_fields, span_fields, support_fields, wire_fields
from catenaria.studio.limits import MOST_TYPED
from catenaria.studio.spans import span_count, with_span_after, without_span
from catenaria.studio.state import Session

_MOST_TOLD: Final = 12  # faults in words above the forms


class Editor:
    """Forms of one session.

    Parameters
    ----------
    session : Session
        What is edited.
    changed : callable
        Called after every edit.
    """

    def __init__(self, session: Session, changed: Callable[[], None]) -> None:
        self._session = session
        self._changed = changed
        self._inputs: list[tuple[Field, Any]] = []
        self._told = ui.column().classes("faults").props('role="alert"')
        self._place = ui.column().classes("editor")
        self.rebuild()

    def rebuild(self, focus: str = "") -> None:
        """Build all forms anew, for a line of another make; the field of a name gets the cursor."""
        tree = self._session.document.tree
        self._inputs = []
        self._place.clear()
        with self._place:
            for row in line_fields(tree):
                self._form(row)
            _heading("Wires")
            for row in wire_fields(tree):
                self._form(row)
            _heading("Spans")
            self._rows(span_fields(tree), self._span_buttons)
            _heading("Supports")
            self._rows(support_fields(tree), None)
        for field, element in self._inputs:
            if field.name == focus:
                element.props("autofocus")

    def refresh(self) -> None:
        """Show the values of the document, as after an undo."""
        tree = self._session.document.tree
        if all_fields(tree) != self._fields:
            self.rebuild()
            return
        for field, element in self._inputs:
            element.value = shown(field, tree)

    def mark(self, faults: tuple[Fault, ...], text: str) -> None:
        """Mark faulty fields with what is wrong; what no field shows is told above the forms."""
        for field, element in self._inputs:
            wrong = message(field, faults)
            if element.error != (wrong or None):
                element.error = wrong or None
        if self._told.default_slot.children:  # without a fault, the page is not rendered anew
            self._told.clear()
        others = unplaced(self._fields, faults)
        marked = len(faults) - len(others)
        with self._told:
            if marked:
                ui.label(f"{marked} wrong in the fields below" if marked > 1 else "1 field is wrong")
            for fault in others[:_MOST_TOLD]:
                ui.label(f"{fault.field}: found {fault.found}; allowed: {fault.allowed}")
            if text:
                ui.label(text)

    @property
    def _fields(self) -> list[Field]:
        return [field for field, _ in self._inputs]

    def _form(self, fields: list[Field]) -> None:
        with ui.row().classes("form"):
            for field in fields:
                self._input(field, _named(field)).classes("field")

    def _rows(self, rows: list[list[Field]], buttons: Callable[[int], None] | None) -> None:
        """Show a table: headings, then a numbered row for each list of fields."""
        if not rows:
            ui.label("none")
            return
        widths = " ".join(_width(field) for field in rows[0])
        extra = " 4.6rem" if buttons else ""
        with ui.element("div").classes("grid").style(f"grid-template-columns: 1.6rem {widths}{extra}"):
            ui.label("")
            for column in zip(*rows, strict=True):
                self._head(column)
            if buttons:
                ui.label("")
            for number, row in enumerate(rows):
                ui.label(str(number + 1)).classes("number")
                for field in row:
                    self._input(field, "")
                if buttons:
                    buttons(number)

    def _head(self, column: Sequence[Field]) -> None:
        first = column[0]
        with ui.element("div").classes("head"):
            ui.label(_named(first).split(", ")[0])
            if first.alike and len(column) > 1:
                says = f"{_named(first)}: the same in all rows below"
                button = ui.button(icon="south", on_click=lambda: self._fill(column))
                button.props(f'flat dense size=xs aria-label="{says}"').tooltip(says)
                button.mark(f"all-{first.name}")

    def _fill(self, column: Sequence[Field]) -> None:
        if self._session.edit(filled(column, self._session.document.tree)):
            self.refresh()
            self._changed()

    def _input(self, field: Field, label: str) -> Any:
        choices = list(field.choices) if field.choices else None
        element = ui.input(label, value=shown(field, self._session.document.tree), autocomplete=choices)
        element.props(f'dense hide-bottom-space data-field="{field.name}" aria-label="{_named(field)}"')
        if field.hint:
            element.props(f'placeholder="{field.hint}"')
        element.mark(field.name)
        element.on("change", partial(self._enter, field, element))
        self._inputs.append((field, element))
        return element

    def _enter(self, field: Field, element: Any, event: events.GenericEventArguments) -> None:
        tree = self._session.document.tree
        # What was typed comes with the event: the element may not have been told yet.
        text = event.args if isinstance(event.args, str) else str(element.value or "")
        if len(text) > MOST_TYPED:
            ui.notify(f"{_named(field)}: {MOST_TYPED} characters at most", type="negative")
        else:
            tree = entered(field, tree, text)
        if self._session.edit(tree):
            self.refresh()
            self._changed()
        else:
            element.value = shown(field, tree)

    def _span_buttons(self, index: int) -> None:
        with ui.row().classes("buttons"):
            add = ui.button(icon="add", on_click=lambda: self._restructure(with_span_after, index))
            add.props(f'flat dense size=sm aria-label="add a span after {index + 1}"').mark(f"add-{index}")
            take = ui.button(icon="remove", on_click=lambda: self._restructure(without_span, index))
            take.props(f'flat dense size=sm aria-label="take away span {index + 1}"').mark(f"take-{index}")

    def _restructure(self, change: Callable[[Tree, int], Tree], index: int) -> None:
        try:
            tree = change(self._session.document.tree, index)
        except InconsistentInputError as error:
            ui.notify(str(error), type="warning")
            return
        self._session.edit(tree)
        behind = index + 1 if change is with_span_after else index
        self.rebuild(f"spans[{min(behind, span_count(tree) - 1)}].length")
        self._changed()


def _named(field: Field) -> str:
    """Return the label with the unit, which tells the two fields of a pre-sag apart."""
    what, comma, where = field.label.partition(", ")
    unit = f" [{field.unit}]" if field.unit else ""
    return f"{what}{unit}{comma}{where}"


def _heading(text: str) -> None:
    ui.label(text).classes("heading")


def _width(field: Field) -> str:
    if field.kind == "positions":
        return "minmax(6rem, 3fr)"
    return "minmax(3.4rem, 1fr)"
