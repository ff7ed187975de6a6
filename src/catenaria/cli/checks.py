"""`catenaria checks`: a result judged by rules of standards and practice."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich import box
from rich.console import Console
from rich.table import Table

from catenaria.cli.failures import BAD_INPUT, NOT_CONVERGED, complain, failures_reported
from catenaria.cli.speeds import train_speed
from catenaria.cli.tolerance import beside

if TYPE_CHECKING:
    from catenaria.report.checks import Check

_STYLES = {"passes": "green", "fails": "bold red", "not judged": "dim"}


def checks(
    result: Annotated[Path, typer.Argument(metavar="RESULT", help="Folder that `catenaria solve` wrote.")],
    speed: Annotated[
        str | None,
        typer.Option(metavar="SPEED", help='As "200 km/h".', show_default="that of the line file, if any"),
    ] = None,
    rules: Annotated[
        Path | None, typer.Option(help="File of rules.", show_default="EN 50119:2001 and practice")
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE.csv", help="Where to write.", show_default="RESULT with -checks.csv behind it"
        ),
    ] = None,
) -> None:
    """Check a result by rules: gradients, droppers, wave speed, radial pull, lateral position, elasticity.

    Every check shows its value, the limit, where it is closest to it, and a verdict: passes, fails, or why it
    is not judged. Values are read from the result, and from studies that `catenaria elasticity` and
    `catenaria load` wrote beside it; none is made.

    Example:

      catenaria checks results/simple_60m --speed 200km/h
      catenaria checks results/simple_60m --speed 200km/h --rules my_rules.yaml

    The file that is written, checks.csv, has a row for each check, with the rule and its source.

    Exit codes: 0 no check fails, 1 a check fails (all is written then), 2 bad input.
    """
    console = Console(markup=False, highlight=False, emoji=False)
    with failures_reported():
        from catenaria import workflow
        from catenaria.report.checks import write_checks

        file = beside(result, "checks.csv") if out is None else out
        found = workflow.check_result(result, train_speed("--speed", speed), rules)
        try:
            write_checks(found, file)
        except OSError as error:
            complain(f"{file} cannot be written: {error.strerror}")
            raise typer.Exit(BAD_INPUT) from error
    show_checks(found, console)
    failed = sum(check.verdict == "fails" for check in found)
    said = {0: "No check fails", 1: "1 check fails"}.get(failed, f"{failed} checks fail")
    console.print(f"\nWritten to {file}. {said}.", soft_wrap=True)
    if failed:
        raise typer.Exit(NOT_CONVERGED)


def show_checks(found: tuple[Check, ...], console: Console) -> None:
    """Show a row for each check, and below why some were not judged."""
    from catenaria.report.html.study_tables import limit, value

    table = Table(
        title="Checks", title_justify="left", title_style="bold", box=box.SIMPLE_HEAD, padding=(0, 1, 0, 0)
    )
    for title, side in (
        ("", "left"),
        ("value", "right"),
        ("limit", "right"),
        ("place", "left"),
        ("verdict", "left"),
    ):
        table.add_column(title, justify="right" if side == "right" else "left", overflow="fold")
    judged = [check for check in found if check.rule]
    for check in judged:
        table.add_row(
            check.name,
            value(check),
            limit(check),
            check.place,
            f"{check.verdict}",
            style=_STYLES[check.verdict],
        )
    console.print(table)
    for check in judged:
        if check.why:
            console.print(f"{check.name}: {check.why}.", soft_wrap=True)
    for check in found:
        if not check.rule:
            console.print(f"{check.name}, {check.place}: {value(check)}.", soft_wrap=True)
