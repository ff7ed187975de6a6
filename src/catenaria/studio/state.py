"""What one person works on: the document with its history, its latest form, and a pinned variant."""

from __future__ import annotations

from dataclasses import dataclass, field

from catenaria.report.checks import Check
from catenaria.results import FormResult
from catenaria.studio.documents import Document, Tree
from catenaria.studio.solve import Outcome

_MOST_UNDONE = 200


@dataclass(frozen=True)
class Draft:
    """What stands in the editor of the file.

    Attributes
    ----------
    text : str
        What was typed.
    base : str
        The document's text that it began with.
    """

    text: str
    base: str


@dataclass
class Session:
    """The state of one tab of a browser; nothing of it is shared with another.

    Attributes
    ----------
    document : Document
        What is edited now.
    outcome : Outcome, optional
        Of the document, or of an earlier one while that is solved.
    form : FormResult, optional
        The latest form that was found: it stays while the document is faulty.
    audited : bool
        Whether that form has its audit and its checks.
    checks : tuple of Check
        Of that form.
    pinned : FormResult, optional
        The variant to compare with.
    before : FormResult, optional
        The form before the latest one.
    draft : Draft, optional
        Text that may not have been applied yet.
    """

    document: Document
    outcome: Outcome | None = None
    form: FormResult | None = None
    audited: bool = False
    checks: tuple[Check, ...] = ()
    before: FormResult | None = None
    pinned: FormResult | None = None
    draft: Draft | None = None
    _done: list[Document] = field(default_factory=list[Document])
    _undone: list[Document] = field(default_factory=list[Document])

    def open(self, document: Document) -> None:
        """Go on with another line; undo leads back to the one before, what was found for it is forgotten."""
        self._change(document)
        self._forget()

    def edit(self, tree: Tree) -> bool:
        """Replace the contents of the document; return whether that changes anything."""
        if tree == self.document.tree:
            return False
        self._change(self.document.edited(tree))
        return True

    def rewrite(self, document: Document) -> bool:
        """Replace the text of the document; return whether that changes anything, if only a comment."""
        if document.text == self.document.text:
            return False
        self._change(document)
        return True

    def _forget(self) -> None:
        self.outcome = self.form = self.before = self.pinned = None
        self.checks, self.audited = (), False

    def _return(self, document: Document) -> None:
        if document.name != self.document.name:  # another line was opened between the two
            self._forget()
        self.document = document

    def _change(self, document: Document) -> None:
        self._done = [*self._done, self.document][-_MOST_UNDONE:]
        self._undone = []
        self.document = document

    @property
    def can_undo(self) -> bool:
        """Whether there is an edit to take back."""
        return bool(self._done)

    @property
    def can_redo(self) -> bool:
        """Whether there is an edit to repeat."""
        return bool(self._undone)

    def undo(self) -> None:
        """Take the latest edit back, if there is one."""
        if self._done:
            self._undone.append(self.document)
            self._return(self._done.pop())

    def redo(self) -> None:
        """Repeat the edit that was taken back last, if there is one."""
        if self._undone:
            self._done.append(self.document)
            self._return(self._undone.pop())

    def take(self, outcome: Outcome) -> None:
        """Note what became of the document."""
        again = self.outcome is not None and self.outcome.document is outcome.document
        self.outcome = outcome
        if outcome.result is not None:
            self.before = self.before if again else self.form  # the same once more is no variant
            self.form, self.checks, self.audited = outcome.result, outcome.checks, outcome.audited

    def pin(self) -> None:
        """Keep the latest form to compare others with."""
        self.pinned = self.form

    def unpin(self) -> None:
        """Compare with the form before the latest one again."""
        self.pinned = None
