"""From a document to its form, in the background: the latest edit wins."""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import dataclass
from time import perf_counter
from typing import Generic, TypeVar

from catenaria import workflow
from catenaria.errors import CatenariaError, Fault, LineFileError
from catenaria.line import Line
from catenaria.line.load import model_from
from catenaria.report.checks import Check
from catenaria.results import FormResult
from catenaria.studio.documents import Document

Item = TypeVar("Item")
Answer = TypeVar("Answer")


@dataclass(frozen=True)
class Outcome:
    """What became of a document.

    Attributes
    ----------
    document : Document
        What was solved.
    result : FormResult, optional
        Its form, with an audit and without a rebuild.
    checks : tuple of Check
        By rules of standards and practice.
    faults : tuple of Fault
        What is wrong with the document.
    message : str
        Why there is no form, if nothing is wrong with any one field.
    seconds : float
        Time it took.
    """

    document: Document
    result: FormResult | None = None
    checks: tuple[Check, ...] = ()
    faults: tuple[Fault, ...] = ()
    message: str = ""
    seconds: float = 0.0


def solved(document: Document) -> Outcome:
    """Solve a document by the direct method, and say what is wrong if it cannot be solved."""
    begin = perf_counter()
    try:
        line = model_from(document.tree, Line, document.name)
        result = workflow.solve(line, rebuild="none")
        checks = workflow.check_result(result)
    except LineFileError as error:
        return Outcome(document, faults=error.faults, seconds=perf_counter() - begin)
    except CatenariaError as error:
        return Outcome(document, message=str(error), seconds=perf_counter() - begin)
    except MemoryError:
        return Outcome(document, message="There is not enough memory for this. Try: fewer elements")
    return Outcome(document, result, checks, seconds=perf_counter() - begin)


class LatestWins(Generic[Item, Answer]):
    """Works on what was handed in last; whatever is overtaken, before its turn or during it, is dropped.

    Parameters
    ----------
    work : callable
        Called in a thread of its own, for one item at a time.
    deliver : callable
        Called in that thread with the answer to the latest item.
    """

    def __init__(self, work: Callable[[Item], Answer], deliver: Callable[[Answer], None]) -> None:
        self._work = work
        self._deliver = deliver
        self._lock = threading.Lock()
        self._waiting: list[Item] = []
        self._busy = False

    def submit(self, item: Item) -> None:
        """Hand in an item."""
        with self._lock:
            self._waiting = [item]
            if self._busy:
                return
            self._busy = True
        threading.Thread(target=self._run, daemon=True).start()

    def _run(self) -> None:
        finished = False
        try:
            while (item := self._next()) is not None:
                answer = self._work(item)
                with self._lock:
                    overtaken = bool(self._waiting)
                if not overtaken:
                    self._deliver(answer)
            finished = True
        finally:
            if not finished:  # an error that nobody foresaw ends this thread: the next item gets another
                with self._lock:
                    self._busy = False

    def _next(self) -> Item | None:
        with self._lock:
            if self._waiting:
                return self._waiting.pop()
            self._busy = False
            return None
