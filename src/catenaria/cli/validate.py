"""`catenaria validate`: numbers of the literature beside those that are computed."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich import box
from rich.console import Console
from rich.table import Table

from catenaria.cli.failures import BAD_INPUT, INTERRUPTED, NOT_CONVERGED, complain, failures_reported

if TYPE_CHECKING:
    from catenaria.validation import CaseOutcome, Comparison
    from catenaria.workflow import CaseProgress, ValidatedCase

_STYLES = {"agrees": "green", "explained": "yellow", "differs": "bold red"}
_PLAIN_INTERVAL = 2.0  # seconds of wall time between two lines when there is no terminal


def validate(
    case: Annotated[
        str | None, typer.Argument(metavar="[CASE]", help="Name of a case.", show_default="all cases")
    ] = None,
    out: Annotated[
        Path | None, typer.Option(help="Folder for the pages with their figures.", show_default="none")
    ] = None,
) -> None:
    """Compute cases of the literature and compare every number with its reference.

    Example:

      catenaria validate three_spans --out validation

    A number agrees within its tolerance. Beyond it the difference is explained, if its reason and size are
    known, or it differs. With --out, pages with all numbers, explanations and figures are written: index.md
    and a page for each case.

    Exit codes: 0 all agree or are explained, 1 a number differs or a computation failed, 2 no such case, or a
    folder that cannot be written to, 130 interrupted.
    """
    console = Console(markup=False, highlight=False, emoji=False)
    with failures_reported():
        cases = _compute(case, out, console)
        for each in cases:
            show_case(each.outcome, console)
        if out is not None:
            _write(cases, out, console)
    _conclude([each.outcome for each in cases], console)


def _compute(case: str | None, out: Path | None, console: Console) -> list[ValidatedCase]:
    try:
        with console.status("Starting") as status:
            # Imported late: numerical libraries take longer to load than --help may.
            from catenaria import results, validation, workflow

            if out is not None:
                results.require_replaceable(out)
            names = validation.case_names() if case is None else (case,)
            tell = _teller(status.update if console.is_terminal else None, console)
            return [workflow.validate(name, tell) for name in names]
    except KeyboardInterrupt as error:
        complain("Interrupted. Nothing was written.")
        raise typer.Exit(INTERRUPTED) from error


def _teller(update: Callable[[str], None] | None, console: Console) -> Callable[[CaseProgress], None]:
    """Return what says which run begins: always in a terminal, now and then elsewhere."""
    printed_at = time.perf_counter()

    def tell(progress: CaseProgress) -> None:
        nonlocal printed_at
        text = f"{progress.case}, run {progress.number} of {progress.count}: {progress.run}"
        if update is not None:
            update(text)
        elif time.perf_counter() >= printed_at + _PLAIN_INTERVAL:
            printed_at = time.perf_counter()
            console.print(text, soft_wrap=True)

    return tell


def show_case(outcome: CaseOutcome, console: Console) -> None:
    """Print all numbers of a case with their references and verdicts."""
    console.print(f"\n{outcome.case.title} ({outcome.name})", style="bold", soft_wrap=True)
    console.print(outcome.case.source, soft_wrap=True)
    for comparison in outcome.comparisons:
        console.print(_table(comparison))
        if comparison.explanation:
            console.print(comparison.explanation, style="yellow", soft_wrap=True)


def _table(comparison: Comparison) -> Table:
    from catenaria.validation.page import cells, headings

    check = comparison.check
    title = f"\n{check.title} ({check.source})"
    table = Table(
        title=title, title_justify="left", title_style="bold", box=box.SIMPLE_HEAD, padding=(0, 1, 0, 0)
    )
    for i, heading in enumerate(headings(check)):
        table.add_column(heading, justify="right" if 0 < i <= 2 * len(check.columns) + 2 else "left")
    for row in cells(comparison):
        table.add_row(*row, style=_STYLES[row[-1]] if row[-1] != "agrees" else None)
    return table


def _write(cases: list[ValidatedCase], folder: Path, console: Console) -> None:
    from catenaria import workflow

    try:
        with console.status("Drawing figures"):
            files = workflow.write_validation(cases, folder)
    except KeyboardInterrupt as error:
        complain(f"Interrupted while writing. {folder} holds all of the new pages or what it held before.")
        raise typer.Exit(INTERRUPTED) from error
    except OSError as error:
        complain(f"{folder} cannot be written: {error.strerror}")  # its path is that of a temporary folder
        raise typer.Exit(BAD_INPUT) from error
    console.print(f"\nWritten to {folder}: {len(files)} files.", soft_wrap=True)


def _conclude(outcomes: list[CaseOutcome], console: Console) -> None:
    """Print how many numbers have which verdict, and fail if one differs."""
    agree, explained, differ = (
        sum(counts) for counts in zip(*(each.counts for each in outcomes), strict=True)
    )
    console.print(
        f"\n{agree + explained + differ} numbers: {agree} agree, {explained} differ and are explained, "
        f"{differ} differ.",
        soft_wrap=True,
    )
    for outcome in outcomes:
        for comparison in outcome.comparisons:
            if comparison.counts[2]:
                complain(f"{outcome.name}: {comparison.check.title} ({comparison.check.source}) differ.")
    if differ:
        raise typer.Exit(NOT_CONVERGED)
