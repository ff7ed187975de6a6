"""The replay of the dynamic method: computed in the background, then moved by a slider or by itself."""

from __future__ import annotations

import logging
from dataclasses import dataclass
from time import perf_counter
from typing import Final

from nicegui import run, ui

from catenaria import workflow
from catenaria.errors import CatenariaError
from catenaria.line import Line
from catenaria.report.html.figures import support_places
from catenaria.results import FormResult
from catenaria.results.film import Film
from catenaria.studio.documents import Document
from catenaria.studio.limits import AT_ONCE, MOVING
from catenaria.studio.live import LiveFigure, show
from catenaria.studio.plots import Figure
from catenaria.studio.replay_plots import error_figure, frame_count, frame_figures, told
from catenaria.studio.state import Session
from catenaria.workflow import Progress

_logger: Final = logging.getLogger(__name__)

_TICK: Final = 0.1  # s between two states while it plays
_READY: Final = (
    "The dynamic method of Yang et al. 2017 moves the line to its equilibrium. In one plane it begins with "
    "straight wires without strain: first the contact wire moves on the lower cables of its droppers, then "
    "the messenger wire with the upper ones. In space all wires move at once, from where they rest without "
    "weight; that takes up to a minute."
)
_BUSY: Final = f"Other tabs have {AT_ONCE} motions computed at present. Try again when one of them has ended."


class _StoppedError(Exception):
    """Nobody waits for the film any more."""


@dataclass
class _Work:
    """A film that is being computed, as the page sees it.

    Attributes
    ----------
    document : Document
        Whose line moves.
    began : float
        When, by the clock of `perf_counter` [s].
    latest : Progress, optional
        What the method said last.
    wanted : bool
        Whether somebody waits for it.
    """

    document: Document
    began: float
    latest: Progress | None = None
    wanted: bool = True

    def told(self) -> str:
        """Say how far it is."""
        said, now = f"{perf_counter() - self.began:.0f} s of computing", self.latest
        if now is None or not now.step:
            return f"{said}: the start"
        off = now.worst_error_in_bands
        return (
            f"{said}: {now.stage}, {now.time:.1f} s of simulated time after {now.step} steps; "
            f"farthest off is {now.worst_control}, by {off:.{2 if off < 10.0 else 0}f} dead bands"
        )


def _icon(plays: bool) -> str:
    return "pause" if plays else "play_arrow"


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
        self._live: list[LiveFigure] = []
        self._supports: dict[str, float] = {}
        self._filmed: Document | None = None
        self._work: _Work | None = None
        self._client = ui.context.client
        with ui.row().classes("bar"):
            self._start = ui.button("Move it", icon="play_circle", on_click=self._make)
            self._start.props("flat no-caps").mark("move")
            self._stop = ui.button("Stop", icon="stop_circle", on_click=self._end)
            self._stop.props("flat no-caps").mark("stop")
            self._play = ui.button(icon="play_arrow", on_click=self._toggle)
            self._play.props('flat dense aria-label="play"').mark("play")
            self._slider = ui.slider(min=0, max=1, value=0, on_change=self.redraw).classes("slider")
            self._slider.props('aria-label="state of the motion"').mark("frame")
        self._said = ui.label(_READY).classes("quiet").mark("replayed")
        self._place = ui.column().classes("panel")
        self._player = ui.timer(_TICK, self._next, active=False)
        self._play.bind_icon_from(self._player, "active", _icon)
        self._watcher = ui.timer(0.3, self._tell, active=False)
        self._enable()

    def reset(self) -> None:
        """Forget the film if the line is another one now; a computation that is under way ends by itself."""
        filmed = self._filmed if self._work is None else self._work.document
        if filmed is self._session.document:
            return
        over = "" if filmed is None else "The line is another one: its motion is not computed yet. "
        self._leave()
        self._films, self._filmed = (), None
        self._player.deactivate()
        if self._live:  # nothing that is there already makes the browser go through the page
            self._place.clear()
            self._live = []
        self._said.text = over + _READY
        self._enable()

    def refresh(self) -> None:
        """Draw in a tab that was not seen, where the browser makes all figures anew."""
        for figure in self._live:
            figure.update()

    def redraw(self) -> None:
        """Draw the state at which the slider is."""
        if not self._films:
            return
        frame = self._frame
        figures = frame_figures(self._films, frame, self._supports, self.dark)
        figures.append(error_figure(self._films, frame, self.dark))
        if self._work is None:
            self._said.text = told(self._films, frame)
        self._draw(figures)

    @property
    def _frame(self) -> int:
        return int(self._slider.value or 0)

    def _draw(self, figures: list[Figure]) -> None:
        if self._live:
            show(self._live, figures)
            return
        with self._place:
            self._live = [LiveFigure(figure) for figure in figures]

    async def _make(self) -> None:
        outcome, document = self._session.outcome, self._session.document
        if outcome is None or outcome.result is None or outcome.document is not document:
            self._said.text = "There is no form of this line yet."
            return
        form, work = outcome.result, _Work(document, perf_counter())
        self._work = work
        self._player.deactivate()
        self._watcher.activate()
        self._enable()
        made = await run.io_bound(self._film, form, work)
        if self._work is not work:  # somebody stopped it, or the line is another one
            return
        self._leave()
        if isinstance(made, str):
            self._said.text = made
        elif made:  # nothing: the server is being shut down
            self._show(made, support_places(form), document)

    def _film(self, form: FormResult, work: _Work) -> tuple[Film, ...] | str:
        """Return the films, or why there are none; the page reads meanwhile how far it is."""

        def listen(progress: Progress) -> None:
            if not work.wanted or self._client.is_deleted:
                raise _StoppedError
            work.latest = progress

        if not MOVING.acquire(blocking=False):
            return _BUSY
        try:
            return workflow.replay(Line.model_validate(form.inputs), listen)[1]
        except _StoppedError:
            return ()
        except CatenariaError as error:
            return str(error)
        except Exception as error:
            _logger.exception("a replay made the studio fail")
            return f"This is a mistake of catenaria, please report it: {error!r}"
        finally:
            MOVING.release()

    def _show(self, films: tuple[Film, ...], supports: dict[str, float], document: Document) -> None:
        self._films, self._supports, self._filmed = films, supports, document
        self._slider.props["max"] = frame_count(films) - 1
        self._slider.value = 0
        self._enable()
        self.redraw()
        self._player.activate()

    def _end(self) -> None:
        """Stop the computation."""
        if self._work is not None:
            self._said.text = f"Stopped after {self._work.told()}."
            self._leave()

    def _leave(self) -> None:
        """Wait for no film any more; the computation ends at its next time step, if it has not yet."""
        if self._work is not None:
            self._work.wanted = False
        self._work = None
        self._watcher.deactivate()
        self._enable()

    def _tell(self) -> None:
        if self._work is not None:
            self._said.text = self._work.told()

    def _toggle(self) -> None:
        if self._player.active:
            self._player.deactivate()
            return
        if self._frame >= frame_count(self._films) - 1:
            self._slider.value = 0
        self._player.activate()

    def _next(self) -> None:
        last = frame_count(self._films) - 1
        if self._frame >= last:
            self._player.deactivate()
            return
        self._slider.value = self._frame + 1

    def _enable(self) -> None:
        self._start.set_enabled(self._work is None)
        self._stop.set_visibility(self._work is not None)
        self._play.set_enabled(bool(self._films))
        self._slider.set_enabled(bool(self._films))
