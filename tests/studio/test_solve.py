"""The solver in the background: what it says of lines, and that the latest edit wins."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from catenaria import workflow
from catenaria.studio.documents import Document, example, replaced
from catenaria.studio.solve import LatestWins, Outcome, outcomes, solved
from catenaria.validation import example_file

LONG = 20.0  # s


def test_it_is_what_the_command_finds(outcome: Outcome) -> None:
    found = workflow.solve(example_file("yang2017_three_span.yaml"), rebuild="none")
    assert outcome.result is not None
    np.testing.assert_array_equal(outcome.result.droppers.cut_length, found.droppers.cut_length)
    assert outcome.result.audit.passed
    assert outcome.checks == workflow.check_result(found)
    assert outcome.seconds > 0.0


def test_the_form_comes_before_its_audit(paper: Document) -> None:
    first, second = outcomes(paper)
    assert not first.audited
    assert first.checks == ()
    assert second.audited
    assert first.result is not None
    assert second.result is not None
    assert not first.result.audit.name
    assert second.result.audit.name
    assert second.result.droppers is first.result.droppers
    assert second.seconds > first.seconds > 0.0


def test_a_mistake_of_the_program_is_said_and_logged(
    paper: Document, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    def mistaken(line: object) -> None:
        raise ZeroDivisionError("nobody foresaw this")

    monkeypatch.setattr(workflow, "find", mistaken)
    (outcome,) = outcomes(paper)
    assert "nobody foresaw this" in outcome.message
    assert "report it" in outcome.message
    assert caplog.records[-1].exc_info is not None


def test_faults_are_those_of_the_line_file(paper: Document) -> None:
    outcome = solved(Document("bad", replaced(paper.tree, ("spans", 0, "length"), "65 kg")))
    assert outcome.result is None
    assert [fault.field for fault in outcome.faults] == ["spans[0].length"]


def test_what_cannot_be_met_is_said_in_words(paper: Document) -> None:
    tree = replaced(paper.tree, ("messenger_wire", "tension", "force"), "1 kN")
    outcome = solved(Document("loose", tree))
    assert outcome.result is None
    assert outcome.message or outcome.faults


def test_threads_do_not_disturb_each_other() -> None:
    names = ("yang2017_three_span", "simple_60m", "curve_800m")
    alone = {name: solved(example(name)).result for name in names}
    with ThreadPoolExecutor(3) as pool:
        together = list(pool.map(lambda name: (name, solved(example(name)).result), names * 3))
    for name, form in together:
        before = alone[name]
        assert form is not None
        assert before is not None
        np.testing.assert_array_equal(form.droppers.cut_length, before.droppers.cut_length)


class Slow:
    """Work that waits until it may go on."""

    def __init__(self) -> None:
        self.begun: list[int] = []
        self.answers: list[int] = []
        self.may_go_on = threading.Semaphore(0)
        self.changed = threading.Condition()

    def work(self, item: int) -> Iterator[int]:
        with self.changed:
            self.begun.append(item)
            self.changed.notify_all()
        assert self.may_go_on.acquire(timeout=LONG)
        yield item

    def deliver(self, answer: int) -> None:
        with self.changed:
            self.answers.append(answer)
            self.changed.notify_all()

    def wait(self, begun: int, answers: int) -> None:
        with self.changed:
            assert self.changed.wait_for(
                lambda: (len(self.begun), len(self.answers)) == (begun, answers), timeout=LONG
            )


def test_the_latest_edit_wins() -> None:
    slow = Slow()
    worker = LatestWins(slow.work, slow.deliver)
    worker.submit(1)
    slow.wait(begun=1, answers=0)
    for item in (2, 3, 4):
        worker.submit(item)
    slow.may_go_on.release(2)
    slow.wait(begun=2, answers=1)
    assert (slow.begun, slow.answers) == ([1, 4], [4])
    worker.submit(5)
    slow.may_go_on.release()
    slow.wait(begun=3, answers=2)
    assert slow.answers == [4, 5]


def test_what_is_overtaken_between_two_answers_ends_there() -> None:
    slow = Slow()

    def work(item: int) -> Iterator[int]:
        yield from slow.work(item)
        yield from slow.work(-item)

    worker = LatestWins(work, slow.deliver)
    worker.submit(1)
    slow.may_go_on.release()
    slow.wait(begun=2, answers=1)
    worker.submit(2)
    slow.may_go_on.release(3)
    slow.wait(begun=4, answers=3)
    assert (slow.begun, slow.answers) == ([1, -1, 2, -2], [1, 2, -2])


@pytest.mark.filterwarnings("ignore::pytest.PytestUnhandledThreadExceptionWarning")
def test_an_error_that_nobody_foresaw_does_not_end_the_work() -> None:
    slow = Slow()

    def work(item: int) -> Iterator[int]:
        if item < 0:
            raise ZeroDivisionError
        return slow.work(item)

    worker = LatestWins(work, slow.deliver)
    worker.submit(-1)
    for thread in threading.enumerate():
        if thread is not threading.current_thread() and thread.daemon:
            thread.join(timeout=1.0)
    worker.submit(1)
    slow.may_go_on.release()
    slow.wait(begun=1, answers=1)
    assert slow.answers == [1]
