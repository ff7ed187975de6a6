"""`catenaria report`: one HTML page of a result, and the same as PDF."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from catenaria.cli.failures import BAD_INPUT, INTERRUPTED, complain, failures_reported
from catenaria.cli.points_shown import elasticity_told
from catenaria.cli.speeds import train_speed
from catenaria.cli.tolerance import beside


def report(
    result: Annotated[Path, typer.Argument(metavar="RESULT", help="Folder that `catenaria solve` wrote.")],
    out: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE.html", help="Where to write.", show_default="RESULT with -report.html behind it"
        ),
    ] = None,
    pdf: Annotated[
        bool, typer.Option("--pdf", help="Print it to PDF too, by an installed Chromium or Chrome.")
    ] = False,
    speed: Annotated[
        str | None,
        typer.Option(metavar="SPEED", help='As "200 km/h".', show_default="that of the line file, if any"),
    ] = None,
    rules: Annotated[
        Path | None, typer.Option(help="File of rules.", show_default="EN 50119:2001 and practice")
    ] = None,
    date: Annotated[
        str, typer.Option(metavar="TEXT", help="Date, as it shall stand in the report.", show_default="none")
    ] = "",
    no_elasticity: Annotated[
        bool, typer.Option("--no-elasticity", help="Leave elasticity out, which takes the longest.")
    ] = False,
) -> None:
    """Write a report of a result: one HTML page that opens without a network and prints on A4.

    Sketch, profile with tolerances, plan, dropper schedule, wires, supports, clamps, tensions, elasticity,
    audit, checks of standards, input and versions. Studies that `catenaria load`, `rounding` and `tolerance`
    wrote beside the result become part of it, and so does one that `catenaria elasticity` wrote; without one,
    elasticity is found under 100 N. Figures say chainage, height and force where one points.

    Example:

      catenaria report results/simple_60m --speed 200km/h --date "22 November 2026"
      catenaria report results/simple_60m --out simple_60m.html --pdf

    Without --date the report bears none, and equal results give equal files.

    Exit codes: 0 done, 1 the browser does not print, 2 bad input, or libraries or a browser are missing,
    130 interrupted. Nothing is written unless it is 0.
    """
    console = Console(markup=False, highlight=False, emoji=False)
    with failures_reported():
        from catenaria import workflow
        from catenaria.workflow.pdf import browser

        file = beside(result, "report.html") if out is None else _html(out)
        try:
            if pdf:
                browser()
            with console.status("Writing the report") as status:
                text = workflow.report(
                    result,
                    train_speed("--speed", speed),
                    rules,
                    date,
                    elasticity=not no_elasticity,
                    progress=elasticity_told(status, "Writing the report"),
                )
                if pdf:
                    status.update("Printing the report")
                files = workflow.write_report(text, file, pdf)
        except KeyboardInterrupt:
            complain("Interrupted. Nothing was written.")
            raise typer.Exit(INTERRUPTED) from None
        except OSError as error:
            complain(f"{file} cannot be written: {error.strerror}")
            raise typer.Exit(BAD_INPUT) from error
    for written in files:
        console.print(f"Written: {written} ({written.stat().st_size / 1e6:.1f} MB)", soft_wrap=True)


def _html(file: Path) -> Path:
    from catenaria.errors import InconsistentInputError

    if file.suffix.lower() not in (".html", ".htm"):
        raise InconsistentInputError(f"--out: found {str(file)!r}; allowed: a file that ends in .html")
    return file
