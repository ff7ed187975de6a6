"""The tab in which a line file is edited as text: every field of it, also those that no form shows."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from typing import Final

from nicegui import run, ui

from catenaria.errors import Fault, LineFileError
from catenaria.studio.documents import MOST_BYTES, Document
from catenaria.studio.state import Draft, Session

_MOST_TOLD: Final = 30  # faults
_SAID: Final = {
    "as it is": "The file as it is downloaded. Ctrl-Enter applies what is changed here.",
    "changed": "Changed, not applied yet.",
    "overtaken": "Changed, not applied yet. The line was edited elsewhere meanwhile: Apply would undo that.",
}
_GO: Final = """
const view = getElement({id}).editor, text = view.state.doc;
const line = text.line(Math.min({line}, text.lines));
const at = Math.min(line.from + {column} - 1, line.to);
view.dispatch({{selection: {{anchor: at}}, scrollIntoView: true}});
view.focus();
"""


class FileTab:
    """The text of one session's document.

    What is typed stays until it is applied, or given up for the document's text; the session keeps it.

    Parameters
    ----------
    session : Session
        What is edited.
    is_open : callable
        Whether somebody sees the tab: the text is made only then.
    rewrite : callable
        Called with the document that a text describes when it is applied.
    """

    def __init__(
        self, session: Session, is_open: Callable[[], bool], rewrite: Callable[[Document], None]
    ) -> None:
        self._session = session
        self._is_open = is_open
        self._rewrite = rewrite
        with ui.row().classes("bar"):
            self._apply = ui.button("Apply", icon="check", on_click=self.apply)
            self._apply.props("flat no-caps").mark("apply")
            self._take = ui.button("Take the document's text", icon="restore", on_click=self._give_up)
            self._take.props("flat no-caps").mark("take-text")
            self._said = ui.label().classes("quiet").mark("file-said")
        self._told = ui.column().classes("faults")
        draft = session.draft
        self._editor = ui.codemirror(
            draft.text if draft else "",
            on_change=self._typed,
            language="YAML",
            theme="basicLight",
            indent="  ",
            line_wrapping=True,
        )
        self._editor.classes("source").mark("file-text")
        for key in ("ctrl", "meta"):  # before the editor, which would begin a line
            self._editor.on(f"keydown.{key}.enter.capture.prevent.stop", self.apply, args=[])
        self.refresh()

    def set_dark(self, dark: bool) -> None:
        """Show it light on dark, or dark on light."""
        self._editor.theme = "oneDark" if dark else "basicLight"

    def refresh(self) -> None:
        """Show the text of the document, unless something else was typed."""
        if not self._is_open():
            return
        draft, text = self._session.draft, self._text
        self._editor.language = "JSON" if self._session.document.suffix == ".json" else "YAML"
        if draft is None or draft.text in (draft.base, text):
            self._session.draft = Draft(text, text)
            if self._editor.value != text:
                self._editor.value = text
        self._show_state()

    def mark(self, faults: Sequence[Fault], message: str) -> None:
        """List what is wrong with the document; whoever clicks on it gets there."""
        if self._told.default_slot.children:
            self._told.clear()
        shown = _once(faults)
        with self._told:
            if message:
                ui.label(message)
            for fault in shown[:_MOST_TOLD]:
                what = f"{fault.field}: found {fault.found}; allowed: {fault.allowed}"
                button = ui.button(f"{fault.line}:{fault.column} {what}")
                button.on_click(lambda _, fault=fault: self._go(fault))
                button.props("flat dense no-caps align=left color=inherit").classes("fault")
            if len(shown) > _MOST_TOLD:
                ui.label(f"and {len(shown) - _MOST_TOLD} more")

    async def apply(self) -> None:
        """Make a line of the text, right or wrong, if it can be read at all."""
        typed, document = str(self._editor.value or ""), self._session.document
        text = typed.replace("\n", "\r\n") if "\r\n" in document.text else typed
        if len(text.encode(errors="surrogatepass")) > MOST_BYTES:
            self.mark((), f"Not applied: a line file has {MOST_BYTES / 1e6:g} MB at most.")
            return
        try:
            new = await run.io_bound(document.rewritten, text)
        except LineFileError as error:
            self.mark(error.faults, "Not applied: this cannot be read.")
            return
        if new is not None:  # None: the server is being shut down
            self._session.draft = Draft(str(self._editor.value or ""), typed)
            self._rewrite(new)
            self._show_state()

    def _typed(self) -> None:
        draft = self._session.draft or Draft("", "")
        self._session.draft = Draft(str(self._editor.value or ""), draft.base)
        self._show_state()

    def _give_up(self) -> None:
        self._session.draft = None
        self.refresh()

    def _show_state(self) -> None:
        draft, text = self._session.draft, self._text
        state = "as it is"
        if draft is not None and draft.text != text:
            state = "changed" if draft.base == text else "overtaken"
        self._said.text = _SAID[state]
        self._apply.set_enabled(state != "as it is")
        self._take.set_visibility(state != "as it is")

    @property
    def _text(self) -> str:
        """The text of the document with line breaks as the editor makes them."""
        return re.sub("\r\n?", "\n", self._session.document.text)

    def _go(self, fault: Fault) -> None:
        line, column = max(fault.line, 1), max(fault.column, 1)
        ui.run_javascript(_GO.format(id=self._editor.id, line=line, column=column))


def _once(faults: Sequence[Fault]) -> list[Fault]:
    """Return the faults without those that aliases repeat."""
    found: dict[object, Fault] = {}
    for fault in faults:
        field = fault.field.rpartition(".")[2]
        found.setdefault((fault.line, fault.column, field, fault.found, fault.allowed), fault)
    return list(found.values())
