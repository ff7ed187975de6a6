"""`catenaria batch`: find the forms of many lines in parallel."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, cast

import typer
from rich.console import Console

from catenaria.cli.batch_progress import batch_display_on
from catenaria.cli.failures import INTERRUPTED, NOT_CONVERGED, complain, failures_reported

if TYPE_CHECKING:
    from catenaria.workflow import BatchSummary, Rebuild

_MOST_FAILURES = 20  # told at the end; the table has all of them


def batch(
    lines: Annotated[
        list[str], typer.Argument(metavar="FOLDER|GLOB|LINE...", help="Line files, folders of them, globs.")
    ],
    out: Annotated[Path, typer.Option(metavar="DIR", help="Folder for all results.")],
    method: Annotated[str, typer.Option(help="Form-finding method, as of `solve`.")] = "direct",
    rebuild: Annotated[
        str, typer.Option(help="Build lines from the found lengths: static, relaxation or none.")
    ] = "static",
    workers: Annotated[
        int | None,
        typer.Option(min=1, help="Worker processes on this computer.", show_default="one for each processor"),
    ] = None,
    scheduler: Annotated[
        str | None,
        typer.Option(metavar="tcp://HOST:PORT", help="Use the workers of a running Dask scheduler instead."),
    ] = None,
    fresh: Annotated[bool, typer.Option("--fresh", help="Solve lines again that are done.")] = False,
    figures: Annotated[bool, typer.Option("--figures/--no-figures", help="Draw figures.")] = False,
) -> None:
    """Find the forms of many lines in parallel, each in a folder of its own.

    Example:

      catenaria network --count 100 --out network
      catenaria batch network --out results/network

    DIR mirrors the folders of the line files, and DIR/batch.csv has a row for each line: status (done,
    failed, bad input, not run), reason, residual of the audit, iterations, time and more. A line that
    fails does not stop the others.

    The same command again goes on where it was interrupted or killed: lines that are done with the same
    file, options and version are not solved again, unless --fresh is given.

    Exit codes: 0 all done and confirmed, 1 some are not, 2 bad input: no such file, no such scheduler, 130
    interrupted.
    """
    console = Console(markup=False, highlight=False, emoji=False)
    display = batch_display_on(console)
    with failures_reported():
        try:
            with display.shown():
                # Imported late: numerical libraries take longer to load than --help may.
                from catenaria import workflow

                summary = workflow.solve_many(
                    lines,
                    out,
                    method=method,
                    rebuild=cast("Rebuild", rebuild),  # any other text is refused
                    workers=workers,
                    scheduler=scheduler,
                    fresh=fresh,
                    figures=figures,
                    progress=display.update,
                )
        except KeyboardInterrupt as error:
            complain(f"Interrupted. Results so far are in {out}; the same command goes on from there.")
            raise typer.Exit(INTERRUPTED) from error
    _conclude(summary, console)


def _conclude(summary: BatchSummary, console: Console) -> None:
    """Print how many lines have which status, and fail if one is not done."""
    bad = [row for row in summary.rows if row.status != "done"]
    for row in bad[:_MOST_FAILURES]:
        complain(f"{row.file}: {row.status}: {row.why}")
    if len(bad) > _MOST_FAILURES:
        complain(f"... and {len(bad) - _MOST_FAILURES} more in {summary.table}")
    solved = len(summary.rows) - summary.reused
    console.print(
        f"{summary.count('done')} of {len(summary.rows)} lines done, {summary.count('failed')} failed, "
        f"{summary.count('bad input')} with bad input; {summary.reused} had been done before and were not "
        f"solved again.\n{solved} lines in {summary.wall_time:.1f} s. Table: {summary.table}",
        soft_wrap=True,
    )
    if not summary.passed:
        raise typer.Exit(NOT_CONVERGED)
