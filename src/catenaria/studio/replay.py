"""The replay of the dynamic method: computed in the background, then moved by a slider or by itself."""

from __future__ import annotations

from typing import Any, Final

from nicegui import run, ui

from catenaria import workflow
from catenaria.errors import CatenariaError
from catenaria.line import Line
from catenaria.results import FormResult
from catenaria.results.film import Film
from catenaria.studio.documents import Document
from catenaria.studio.replay_plots import error_figure, frame_count, frame_figure, told
from catenaria.studio.state import Session
from catenaria.workflow import Progress

_TICK: Final = 0.1  # s between two states while it plays
_SPACE: Final = "The replay is of lines in one plane with two wires: this one lies in space."
_READY: Final = (
    "The dynamic method of Yang et al. 2017 moves the line from straight wires to its equilibrium: first the "
    "contact wire on the lower cables of its droppers, then the messenger wire with the upper ones."
)


class _StoppedError(Exception):
    """Nobody waits for the film any more."""


class Replay:
    """What the tab of the replay shows.

    Parameters
    ----------
    session : Session
        Whose line is moved.
    """

    def __init__(self, session: Session) -> None:
        self.dark = False
        self._session = session
        self._films: tuple[Film, ...] = ()
        self._filmed: Document | None = None
        self._latest: Progress | None = None
        self._client = ui.context.client
        with ui.row().classes("bar"):
            self._start = ui.button("Move it", icon="play_circle", on_click=self._make)
            self._start.props("flat no-caps").mark("move")
            self._play = ui.button(icon="play_arrow", on_click=self._toggle)
            self._play.props('flat dense aria-label="play"').mark("play")
            self._slider = ui.slider(min=0, max=1, value=0, on_change=self.redraw).classes("slider")
            self._slider.mark("frame")
        self._said = ui.label(_READY).classes("quiet").mark("replayed")
        self._place = ui.column().classes("panel")
        self._player = ui.timer(_TICK, self._next, active=False)
        self._watcher = ui.timer(0.3, self._tell, active=False)
        self.reset()

    def reset(self) -> None:
        """Forget the film if the line is another one now; a computation that is under way ends by itself."""
        if self._filmed is self._session.document:
            return
        self._films, self._filmed, self._latest = (), None, None
        self._player.deactivate()
        self._watcher.deactivate()
        self._place.clear()
        self._said.text = _READY
        self._enable()

    def redraw(self) -> None:
        """Draw the state at which the slider is."""
        if not self._films:
            return
        frame = int(self._slider.value or 0)
        figures = [frame_figure(self._films, frame, self.dark), error_figure(self._films, frame, self.dark)]
        self._said.text = told(self._films, frame)
        elements = list(self._place.default_slot.children)
        if elements:
            for element, figure in zip(elements, figures, strict=True):
                shown: Any = element
                shown.figure = figure
                shown.update()
            return
        with self._place:
            for figure in figures:
                ui.plotly(figure).classes("figure").style(f"height: {figure['layout']['height']}px")

    async def _make(self) -> None:
        form, outcome = self._session.form, self._session.outcome
        if form is None or outcome is None or outcome.result is None:
            self._said.text = "There is no form of this line yet."
            return
        if form.spatial:
            self._said.text = _SPACE
            return
        self._filmed = outcome.document
        self._start.disable()
        self._watcher.activate()
        try:
            films = await run.io_bound(self._film, form, outcome.document)
        except _StoppedError:
            return
        except CatenariaError as error:
            self._watcher.deactivate()
            self._said.text = str(error)
            self._filmed = None
            self._enable()
            return
        if self._filmed is outcome.document and films:
            self._show(films)

    def _show(self, films: tuple[Film, ...]) -> None:
        self._watcher.deactivate()
        self._films = films
        self._slider.props["max"] = frame_count(films) - 1
        self._slider.value = 0
        self._enable()
        self.redraw()
        self._player.activate()

    def _film(self, form: FormResult, document: Document) -> tuple[Film, ...]:
        """Compute in a thread of its own; the page reads how far it is."""

        def listen(progress: Progress) -> None:
            if self._filmed is not document or self._client.is_deleted:
                raise _StoppedError
            self._latest = progress

        return workflow.replay(Line.model_validate(form.inputs), listen)[1]

    def _tell(self) -> None:
        now = self._latest
        if now is not None:
            self._said.text = (
                f"{now.stage}, {now.time:.1f} s of simulated time after {now.step} steps: "
                f"{now.worst_control} is {now.worst_error_in_bands:.3g} dead bands off"
            )

    def _toggle(self) -> None:
        if self._player.active:
            self._player.deactivate()
            return
        if self._slider.value >= frame_count(self._films) - 1:
            self._slider.value = 0
        self._player.activate()

    def _next(self) -> None:
        last = frame_count(self._films) - 1
        if self._slider.value >= last:
            self._player.deactivate()
            return
        self._slider.value = min(int(self._slider.value) + 1, last)

    def _enable(self) -> None:
        self._start.set_enabled(True)
        self._play.set_enabled(bool(self._films))
        self._slider.set_enabled(bool(self._films))
