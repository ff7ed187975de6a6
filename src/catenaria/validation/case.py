"""What a validation case says: inputs, numbers with source and tolerance, and the figures beside them."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from typing import Any, Literal

from pydantic import Field, model_validator

from catenaria.line.base import LineModel, Path, Problem, refuse

Unit = Literal["", "m", "mm", "N", "kN", "s", "GPa", "mm^2", "kg/m^3", "N m^2"]

SI: dict[Unit, float] = {
    "": 1.0,
    "m": 1.0,
    "mm": 1e-3,
    "N": 1.0,
    "kN": 1e3,
    "s": 1.0,
    "GPa": 1e9,
    "mm^2": 1e-6,
    "kg/m^3": 1.0,
    "N m^2": 1.0,
}


class Run(LineModel):
    """One computation of a case."""

    file: str = Field(description="Line or structure file among the examples.")
    kind: Literal["line", "structure"] = Field(default="line", description="What the file describes.")
    method: Literal["direct", "dynamic"] = Field(
        default="direct", description="Method by which it is solved."
    )
    rebuilds: str | None = Field(
        default=None,
        description="Earlier run of the same structure: what it found is built, without controls.",
    )
    change: dict[str, Any] = Field(
        default={},
        description="Values that replace those of the file, by dotted path: `messenger_wire.tension.force`.",
    )


class Known(LineModel):
    """A difference from the reference that is understood."""

    between: tuple[float, float] = Field(
        description="Smallest and largest difference, observed minus reference, that the reason explains."
    )
    why: str = Field(description="The reason, and the experiment that shows it.")

    @model_validator(mode="after")
    def _has_size(self) -> Known:
        if not self.between[0] < self.between[1]:
            raise ValueError("the range of an explained difference ascends: between: [smallest, largest]")
        return self


class Column(LineModel):
    """Where the observed numbers of a check come from.

    A quantity of several numbers has one run; for a study over several runs each of them gives one number.
    """

    title: str = Field(description="Heading, for example the method.")
    runs: tuple[str, ...] = Field(min_length=1, description="Names of the runs.")


class Check(LineModel):
    """Numbers with their reference."""

    title: str = Field(description="What is compared.")
    source: str = Field(description="Where the reference is from.")
    quantity: str = Field(description="Name of the observed quantity.")
    of: tuple[str, ...] = Field(default=(), description="Whose quantity, if the quantity must be told.")
    minus: str | None = Field(default=None, description="Run whose quantity is subtracted.")
    unit: Unit = Field(description="Unit of reference, tolerance and tables.")
    decimals: int = Field(ge=0, le=6, description="Decimals of observed numbers in tables.")
    rows: tuple[str, ...] = Field(description="What each number belongs to.")
    reference: tuple[float, ...] = Field(description="The numbers.")
    tolerance: float | tuple[float, ...] = Field(
        description="Allowed difference, one or one for each number."
    )
    reason: str = Field(description="Why this tolerance.")
    known: Known | None = Field(default=None, description="Why the reference is not reached, if it is not.")
    columns: tuple[Column, ...] = Field(min_length=1, description="What is compared with the reference.")

    @property
    def tolerances(self) -> tuple[float, ...]:
        """The allowed difference of each number."""
        given = self.tolerance
        return given if isinstance(given, tuple) else (given,) * len(self.reference)

    @model_validator(mode="after")
    def _complete(self) -> Check:
        refuse("Check", self._problems())
        return self

    def _problems(self) -> Iterator[Problem]:
        count = len(self.rows)
        for field, size in (("reference", len(self.reference)), ("tolerance", len(self.tolerances))):
            if size != count:
                yield Problem((field,), size, f"{count} numbers, one for each row")


class Drawing(LineModel):
    """A figure of the page."""

    name: str = Field(description="Name of its file, without suffix.")
    drawn: str = Field(description="What is drawn.")
    runs: tuple[str, ...] = Field(min_length=1, description="Names of the runs it is drawn from.")
    of: tuple[str, ...] = Field(
        default=(), description="Titles of checks whose differences are drawn; joints or controls."
    )
    marks: dict[str, float] = Field(default={}, description="Levels to be marked, by name [SI].")
    paper: str = Field(description="The figure of the paper to lay beside it, or empty.")
    text: str = Field(description="What it shows.")


class Case(LineModel):
    """Runs, the numbers that they must reproduce, and figures."""

    title: str = Field(description="Heading.")
    source: str = Field(description="Reference to the literature.")
    text: str = Field(description="What the case is, and what it shows (Markdown).")
    runs: dict[str, Run] = Field(description="Computations by name.")
    checks: tuple[Check, ...] = Field(min_length=1, description="Numbers.")
    figures: tuple[Drawing, ...] = Field(default=(), description="Figures.")
    discussion: str = Field(default="", description="What remains to be said (Markdown).")

    @model_validator(mode="after")
    def _known_runs(self) -> Case:
        refuse("Case", self._problems())
        return self

    def _problems(self) -> Iterator[Problem]:
        titles = [check.title for check in self.checks]
        earlier: list[str] = []
        for name, run in self.runs.items():
            yield from self._not_among({run.rebuilds} - {None}, earlier, ("runs", name, "rebuilds"))
            earlier.append(name)
        for i, check in enumerate(self.checks):
            if titles.index(check.title) != i:
                yield Problem(("checks", i, "title"), check.title, "a title of its own")
            named = {run for column in check.columns for run in column.runs} | {check.minus} - {None}
            yield from self._not_among(named, self.runs, ("checks", i))
        for i, drawing in enumerate(self.figures):
            yield from self._not_among(drawing.runs, self.runs, ("figures", i, "runs"))
            if drawing.drawn == "differences":
                yield from self._not_among(drawing.of, titles, ("figures", i, "of"))

    @staticmethod
    def _not_among(named: Iterable[Any], known: Collection[str], place: Path) -> Iterator[Problem]:
        for name in named:
            if name not in known:
                yield Problem(place, name, f"one of {', '.join(known)}")
