"""From a document to its form, in the background: the latest edit wins."""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from time import perf_counter
from typing import Final, Generic, TypeVar

from catenaria import workflow
from catenaria.errors import CatenariaError, Fault, LineFileError
from catenaria.line import Line
from catenaria.line.load import model_from
from catenaria.report.checks import Check
from catenaria.results import FormResult
from catenaria.studio.documents import Document, placed
from catenaria.studio.limits import SOLVING, refuse_long_waits

_logger: Final = logging.getLogger(__name__)

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
        Its form, without a rebuild.
    audited : bool
        Whether the form has its audit and checks, which follow it.
    checks : tuple of Check
        By rules of standards and practice.
    faults : tuple of Fault
        What is wrong with the document.
    message : str
        Why there is no form, if nothing is wrong with any one field.
    seconds : float
        Time it took so far.
    """

    document: Document
    result: FormResult | None = None
    audited: bool = False
    checks: tuple[Check, ...] = ()
    faults: tuple[Fault, ...] = ()
    message: str = ""
    seconds: float = 0.0


def outcomes(document: Document) -> Iterator[Outcome]:
    """Solve a document by the direct method: yield its form, then the form with audit and checks.

    There is one outcome only, with what is wrong, of a document that cannot be solved.
    """
    begin = perf_counter()
    try:
        line = model_from(document.tree, Line, document.name)
        refuse_long_waits(line)
        form = workflow.find(line)
        taken = perf_counter() - begin
        yield Outcome(document, form, seconds=taken)
        begin = perf_counter() - taken  # meanwhile the form was drawn
        result = workflow.audited(form)
        checks = workflow.check_result(result)
        yield Outcome(document, result, True, checks, seconds=perf_counter() - begin)
    except LineFileError as error:
        yield Outcome(document, faults=placed(document, error.faults), seconds=perf_counter() - begin)
    except CatenariaError as error:
        yield Outcome(document, message=str(error), seconds=perf_counter() - begin)
    except MemoryError:
        yield Outcome(document, message="There is not enough memory for this. Try: fewer elements")
    except Exception as error:
        _logger.exception("an edit of a line made the studio fail")
        yield Outcome(document, message=f"This is a mistake of catenaria, please report it: {error!r}")


def solved(document: Document) -> Outcome:
    """Return the last of the outcomes of a document."""
    *_, last = outcomes(document)
    return last


class LatestWins(Generic[Item, Answer]):
    """Works on what was handed in last; whatever is overtaken, before its turn or during it, is dropped.

    Parameters
    ----------
    work : callable
        Called in a thread of its own, for one item at a time; yields one answer after the other.
    deliver : callable
        Called in that thread with each answer to the latest item.
    """

    def __init__(self, work: Callable[[Item], Iterator[Answer]], deliver: Callable[[Answer], None]) -> None:
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
            while not finished:
                with SOLVING:  # before an item is taken, which may be overtaken meanwhile
                    finished = not self._work_on_next()
        finally:
            if not finished:  # an error that nobody foresaw ends this thread: the next item gets another
                with self._lock:
                    self._busy = False

    def _work_on_next(self) -> bool:
        item = self._next()
        if item is None:
            return False
        for answer in self._work(item):
            with self._lock:
                overtaken = bool(self._waiting)
            if overtaken:
                break
            self._deliver(answer)
        return True

    def _next(self) -> Item | None:
        with self._lock:
            if self._waiting:
                return self._waiting.pop()
            self._busy = False
            return None
