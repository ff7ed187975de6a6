"""Sessions: undo, redo, pinned variants, and that two of them share nothing."""

from __future__ import annotations

from catenaria.studio.documents import Document, replaced
from catenaria.studio.solve import Outcome
from catenaria.studio.state import Session

ONE, OTHER = Document("one", {"name": "one"}), Document("other", {"name": "other"})


def test_edits_are_undone_and_repeated() -> None:
    session = Session(ONE)
    for name in ("a", "b", "c"):
        assert session.edit(replaced(session.document.tree, ("name",), name))
    assert not session.can_redo
    session.undo()
    session.undo()
    assert session.document.tree == {"name": "a"}
    session.redo()
    assert session.document.tree == {"name": "b"}
    assert session.edit({"name": "d"})
    assert not session.can_redo
    for _ in range(9):
        session.undo()
    assert session.document is ONE
    assert not session.can_undo


def test_what_changes_nothing_is_no_edit() -> None:
    session = Session(ONE)
    assert not session.edit({"name": "one"})
    assert not session.can_undo


def test_a_text_is_one_step() -> None:
    session = Session(ONE.rewritten("name: one  # first\n"))
    assert session.rewrite(session.document.rewritten("name: one  # second\n"))
    assert session.edit({"name": "edited"})
    assert session.document.text == "name: edited  # second\n"
    session.undo()
    session.undo()
    assert session.document.text == "name: one  # first\n"
    assert not session.can_undo
    assert not session.rewrite(session.document.rewritten(session.document.text))
    assert not session.can_undo


def test_two_sessions_share_nothing() -> None:
    first, second = Session(ONE), Session(ONE)
    first.edit({"name": "changed"})
    assert second.document.tree == {"name": "one"}
    assert not second.can_undo
    assert ONE.tree == {"name": "one"}


def test_a_fault_keeps_the_latest_form(outcome: Outcome) -> None:
    session = Session(outcome.document)
    session.take(outcome)
    assert session.form is outcome.result
    session.take(Outcome(OTHER, message="no"))
    assert session.form is outcome.result
    assert session.checks == outcome.checks
    assert session.before is None
    session.take(outcome)
    assert session.before is outcome.result
    session.take(outcome)
    assert session.before is outcome.result


def test_another_line_has_nothing_of_the_one_before(outcome: Outcome) -> None:
    session = Session(outcome.document)
    session.take(outcome)
    session.edit({"name": "changed"})
    session.pin()
    assert session.pinned is outcome.result
    session.open(OTHER)
    assert (session.form, session.pinned, session.before, session.outcome) == (None, None, None, None)


def test_undo_leads_back_from_a_line_that_was_opened(outcome: Outcome) -> None:
    session = Session(outcome.document)
    session.edit({"name": "work of a day"})
    session.open(OTHER)
    session.take(outcome)
    session.undo()
    assert session.document.tree == {"name": "work of a day"}
    assert session.form is None  # the other line's form is no form of this one
    session.take(outcome)
    session.undo()
    assert session.document is outcome.document
    assert session.form is outcome.result
    session.redo()
    session.redo()
    assert session.document is OTHER
    assert session.form is None
