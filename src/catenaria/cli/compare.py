"""`catenaria compare`: methods side by side on one line."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich import box
from rich.console import Console
from rich.table import Table

from catenaria.cli.failures import BAD_INPUT, INTERRUPTED, NOT_CONVERGED, complain, failures_reported

if TYPE_CHECKING:
    from catenaria.workflow.compare import Compared


def compare(
    line: Annotated[Path, typer.Argument(metavar="LINE", help="Line file, YAML or JSON.")],
    methods: Annotated[
        str | None,
        typer.Option(help="Names of methods with commas between.", show_default="all that solve the line"),
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option(help="Folder for table and figure.", show_default="results/ and the name of LINE"),
    ] = None,
    no_figures: Annotated[bool, typer.Option("--no-figures", help="Draw no figure.")] = False,
) -> None:
    """Find the form of a line by several methods and compare them with the direct one.

    Example:

      catenaria compare examples/yang2017_three_span.yaml --methods "separated,force density"

    The table tells for every method the largest differences from the direct method in dropper lengths, in
    heights of both wires along the line and in dropper forces, iterations, time (warm, without audit),
    whether the audit of its result passes, and what it neglects. The folder then holds differences.csv and
    differences.png.

    Exit codes: 0 done, 1 a method did not converge or its audit failed, 2 bad input, 130 interrupted. A
    method that refuses the line is told in the table, and is no failure.
    """
    folder = Path("results") / f"{line.stem}-methods" if out is None else out
    names = None if methods is None else tuple(name.strip() for name in methods.split(","))
    console = Console(markup=False, highlight=False, emoji=False)
    with failures_reported():
        compared, files = _compare(line, names, folder, console, figures=not no_figures)
    console.print(comparison_table(compared))
    for each in compared:
        console.print(f"{each.method} neglects {each.neglects}.", soft_wrap=True)
    console.print(f"\nWritten to {folder}: {len(files)} files.", soft_wrap=True)
    _conclude(compared)


def _compare(
    line: Path, names: Sequence[str] | None, folder: Path, console: Console, *, figures: bool
) -> tuple[tuple[Compared, ...], tuple[Path, ...]]:
    try:
        with console.status("Starting") as status:
            # Imported late: numerical libraries take longer to load than --help may.
            from catenaria import results, workflow

            results.require_replaceable(folder)
            compared = workflow.compare(line, names, status.update)
            status.update("Writing the comparison")
            return compared, workflow.write_comparison(compared, folder, figures)
    except KeyboardInterrupt as error:
        complain("Interrupted. Nothing was written.")
        raise typer.Exit(INTERRUPTED) from error
    except OSError as error:
        complain(f"{folder} cannot be written: {error.strerror}")  # its path is that of a temporary folder
        raise typer.Exit(BAD_INPUT) from error


def comparison_table(compared: Sequence[Compared]) -> Table:
    """Return the table of all methods."""
    table = Table(
        title="Largest differences from the direct method in mm and N; time in ms",
        title_justify="left",
        title_style="bold",
        box=box.SIMPLE_HEAD,
        padding=(0, 1, 0, 0),
    )
    table.add_column("method", no_wrap=True)
    for column in ("length", "height", "force", "iter.", "time"):
        table.add_column(column, justify="right", no_wrap=True)
    table.add_column("audit", no_wrap=True)
    for each in compared:
        table.add_row(each.method, *_cells(each))
    return table


def _cells(each: Compared) -> tuple[str, ...]:
    if each.result is None or each.differences is None:
        return ("", "", "", "", "", "refused" if each.refused else "none found")
    found = each.differences
    return (
        f"{1e3 * found.largest_length:.4f}",
        f"{1e3 * found.largest_height:.4f}",
        f"{found.largest_force:.4f}",
        str(each.iterations),
        f"{1e3 * each.time:.1f}",
        "passed" if each.result.audit.passed else "FAILED",
    )


def _conclude(compared: Sequence[Compared]) -> None:
    """Say why there is no result, or what an audit found, and fail unless methods only refused the line."""
    failed = False
    for each in compared:
        if each.result is None:
            complain(f"{each.method}: {each.failure}")
            failed = failed or not each.refused
        elif not each.result.audit.passed:
            failed = True
            for finding in each.result.audit.findings:
                complain(f"{each.method}: {finding}")
    if failed:
        raise typer.Exit(NOT_CONVERGED)
