"""The page of one person: head, editor, panels, and what connects them."""

from __future__ import annotations

import asyncio
import threading
from collections.abc import Callable
from functools import partial
from typing import Any, Final

from nicegui import events, run, ui

from catenaria.errors import CatenariaError
from catenaria.results import FormResult
from catenaria.studio import downloads
from catenaria.studio.documents import EXAMPLES, MOST_BYTES, Document, example, uploaded
from catenaria.studio.downloads import EXPORTS, Download
from catenaria.studio.editor import Editor
from catenaria.studio.file_tab import FileTab
from catenaria.studio.live import LiveText, Said, show
from catenaria.studio.panels import Panels
from catenaria.studio.replay import Replay
from catenaria.studio.solve import LatestWins, Outcome, outcomes
from catenaria.studio.state import Session

_SENT: Final = 0.005  # s that a form needs to be sent
_DRAWN: Final = 1.0  # s, after which the audit no longer waits for that

_REFUSED: Final = f"Refused: a line file is YAML or JSON, {MOST_BYTES / 1e6:g} MB at most"

_FILES: Final = (
    ("save-droppers", "Droppers, CSV", downloads.droppers_csv),
    ("save-report", "Report, HTML", downloads.report_page),
    ("save-pdf", "Report, PDF", downloads.report_pdf),
    ("save-result", "Result folder, ZIP", downloads.result_folder),
)


class Page:
    """Everything that one tab of a browser shows."""

    def __init__(self, session: Session) -> None:
        self._session = session
        self._client = ui.context.client
        self._loop = asyncio.get_running_loop()
        self._worker = LatestWins(outcomes, self._deliver)
        self._dark = ui.dark_mode(False)
        with ui.header().classes("top"):
            self._header()
        with ui.element("div").classes("halves"):
            with ui.element("div").classes("half"):
                self._editor = Editor(session, self._solve)
            with ui.element("div").classes("half"):
                self._panels = Panels(session)
                with self._panels.place("replay"):
                    self._replay = Replay(session)
                with self._panels.place("file"):
                    self._file = FileTab(session, partial(self._panels.is_open, "file"), self._rewrite)
                self._panels.when_opened(self._file.refresh)
                self._panels.when_opened(self._replay.refresh)
        self._show_state()
        self._solve()

    def _header(self) -> None:
        ui.label("catenaria studio").classes("title")
        self._chooser = ui.select(dict(EXAMPLES), label="example", on_change=self._choose)
        self._chooser.props("dense options-dense").classes("chooser").mark("example")
        self._opener()
        self._undo = _button("undo", "undo", lambda: self._back(self._session.undo))
        self._redo = _button("redo", "redo", lambda: self._back(self._session.redo))
        self._pin = _button("push_pin", "pin this variant", self._toggle_pin)
        with ui.button("Download", icon="download").props("flat dense no-caps").mark("download"), ui.menu():
            self._items()
        _button("dark_mode", "light or dark", self._toggle_dark)
        self._status = LiveText(Said("", "status"))
        self._status.props('role="status"').mark("status")

    def _opener(self) -> None:
        """A button in the place of the large element that takes files."""
        taker = ui.upload(
            auto_upload=True,
            max_file_size=MOST_BYTES,
            on_upload=self._take,
            on_rejected=lambda: ui.notify(_REFUSED, type="negative"),
        )
        taker.props('accept=".yaml,.yml,.json"').classes("taker").mark("upload")
        button = ui.button("Open", icon="folder_open").props("flat dense no-caps").mark("open")
        button.on("click", js_handler=f"() => getElement({taker.id}).$refs.qRef.pickFiles()")

    def _items(self) -> None:
        ui.menu_item("Line file", on_click=self._save_line).mark("save-line")
        for mark, label, make in _FILES:
            _item(label, mark, partial(self._save, make))
        ui.separator()
        for name, label in EXPORTS.items():
            _item(label, f"save-{name}", partial(self._save, partial(downloads.exported, name)))

    def _choose(self, event: events.ValueChangeEventArguments[Any]) -> None:
        if event.value:
            self._open(example(event.value))
            self._chooser.value = None  # an example is a beginning: it can be chosen again to begin anew

    async def _take(self, event: events.UploadEventArguments) -> None:
        try:
            document = await run.io_bound(uploaded, event.file.name, await event.file.read())
        except CatenariaError as error:
            ui.notify(str(error), type="negative", multi_line=True, timeout=0, close_button=True)
            return
        if document is not None:
            self._open(document)

    def _open(self, document: Document) -> None:
        self._session.open(document)
        self._panels.clear()
        self._editor.rebuild()
        self._solve()

    def _rewrite(self, document: Document) -> None:
        if self._session.rewrite(document):
            self._editor.refresh()
            self._solve()

    def _back(self, step: Callable[[], None]) -> None:
        step()
        if self._session.form is None:  # another line
            self._panels.clear()
        self._editor.refresh()
        self._solve()

    def _solve(self) -> None:
        self._show_state()
        self._replay.reset()
        self._worker.submit(self._session.document)
        self._file.refresh()

    def _deliver(self, outcome: Outcome) -> None:
        """Show an outcome, and let the thread that found it wait: its audit would slow that down."""
        if self._loop.is_closed():  # as it is when the server has ended meanwhile
            return
        shown = threading.Event()
        self._loop.call_soon_threadsafe(self._show, outcome, shown)
        shown.wait(_DRAWN)

    def _show(self, outcome: Outcome, shown: threading.Event) -> None:
        if not self._is_over(outcome):
            self._session.take(outcome)
            with self._client:
                if outcome.audited:
                    self._panels.complete()
                else:
                    self._panels.refresh()
                self._show_state()
                self._editor.mark(outcome.faults, outcome.message)
                self._file.mark(outcome.faults, outcome.message)
        self._loop.call_later(_SENT, shown.set)

    def _is_over(self, outcome: Outcome) -> bool:
        return outcome.document is not self._session.document or self._client.is_deleted

    def _show_state(self) -> None:
        session = self._session
        self._undo.set_enabled(session.can_undo)
        self._redo.set_enabled(session.can_redo)
        self._pin.props(f"color={'accent' if session.pinned is not None else 'primary'}")
        show([self._status], [Said(_said(session))])

    def _toggle_pin(self) -> None:
        if self._session.pinned is None:
            self._session.pin()
        else:
            self._session.unpin()
        self._show_state()
        self._panels.refresh()

    def _toggle_dark(self) -> None:
        self._dark.toggle()
        self._panels.dark = self._replay.dark = bool(self._dark.value)
        self._file.set_dark(bool(self._dark.value))
        self._replay.redraw()
        self._panels.refresh()

    def _save_line(self) -> None:
        file = downloads.line_file(self._session.document)
        ui.download(file.content, file.name)

    async def _save(self, make: Callable[[FormResult], Download]) -> None:
        outcome = self._session.outcome
        form = outcome.result if outcome is not None and outcome.audited else None
        if outcome is None or form is None or outcome.document is not self._session.document:
            ui.notify("There is no form of this line to download.", type="warning")
            return
        waiting = ui.notification("The file is being made …", spinner=True, timeout=None)
        try:
            file = await run.io_bound(make, form)
        except CatenariaError as error:
            ui.notify(str(error), type="negative", multi_line=True, timeout=0, close_button=True)
            return
        finally:
            waiting.dismiss()
        if file is not None:  # None: the server is being shut down
            ui.download(file.content, file.name)


def _said(session: Session) -> str:
    outcome = session.outcome
    if outcome is None or outcome.document is not session.document:
        return "solving …"
    if outcome.result is None:
        return "not solved: shown is the last form" if session.form is not None else "not solved"
    if not outcome.audited:
        return f"found in {1e3 * outcome.seconds:.0f} ms, audit …"
    ruled = [check.verdict for check in outcome.checks if check.rule]
    audit = "audit passed" if outcome.result.audit.passed else "AUDIT FAILED"
    fails = ruled.count("fails")
    return f"{audit} · {fails} of {len(ruled)} checks fail · {1e3 * outcome.seconds:.0f} ms"


def _button(icon: str, says: str, act: Callable[[], Any]) -> Any:
    button = ui.button(icon=icon, on_click=act).props(f'flat dense aria-label="{says}"').mark(says)
    with button:
        ui.tooltip(says)
    return button


def _item(label: str, mark: str, act: Callable[[], Any]) -> None:
    ui.menu_item(label, on_click=act).mark(mark)
