"""`catenaria rounding`: dropper lengths as they can be cut."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich import box
from rich.console import Console
from rich.table import Table

from catenaria.cli.failures import BAD_INPUT, INTERRUPTED, complain, failures_reported
from catenaria.cli.lengths import positive_length
from catenaria.cli.tolerance import beside

if TYPE_CHECKING:
    from catenaria.results.rounding import RoundingStudy

_STEPS = ("1 mm", "5 mm", "10 mm")


def rounding(
    source: Annotated[
        Path, typer.Argument(metavar="RESULT|LINE", help="Folder that `solve` wrote, or a line file.")
    ],
    step: Annotated[
        list[str] | None,
        typer.Option(help="Step of the cut lengths; several times.", show_default="1 mm, 5 mm and 10 mm"),
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option(
            help="Folder for the results.", show_default="beside RESULT, with -rounding behind its name"
        ),
    ] = None,
    no_figures: Annotated[bool, typer.Option("--no-figures", help="Write no figure.")] = False,
) -> None:
    """Round the lengths to which droppers are cut, and say what heights follow.

    Cut lengths are rounded to whole steps, halves upwards, and the line is brought to rest with them.

    Example:

      catenaria rounding examples/yang2017_three_span.yaml --step 5mm

    The folder then holds rounding.csv (a row for each dropper and step), steps.csv (a row for each step),
    rounding.png, and result.json with result.npz.

    Exit codes: 0 done, 1 the line does not come to rest, 2 bad input, 130 interrupted. Nothing is written
    unless it is 0.
    """
    console = Console(markup=False, highlight=False, emoji=False)
    with failures_reported():
        from catenaria import results, workflow
        from catenaria.results.rounding import RoundingStudy

        steps = [positive_length("--step", text) for text in step or _STEPS]
        folder = beside(source, "rounding") if out is None else out
        results.require_replaceable(folder, RoundingStudy)
        try:
            with console.status("Bringing the line to rest"):
                study = workflow.rounding(source, steps)
                files = workflow.write_rounding(study, folder, figures=not no_figures)
        except KeyboardInterrupt:
            complain("Interrupted. Nothing was written.")
            raise typer.Exit(INTERRUPTED) from None
        except OSError as error:
            complain(f"{folder} cannot be written: {error.strerror}")
            raise typer.Exit(BAD_INPUT) from error
    console.print(step_table(study))
    console.print(f"\nWritten to {folder}: {len(files)} files.", soft_wrap=True)


def step_table(study: RoundingStudy) -> Table:
    """Return the table of all steps."""
    from catenaria.report.tolerance_tables import step_columns

    table = Table(
        title="Contact wire with rounded dropper lengths, in mm; forces in N",
        title_justify="left",
        title_style="bold",
        box=box.SIMPLE_HEAD,
    )
    for title in ("step", "largest change", "largest height error", "rms height error", "least force"):
        table.add_column(title, justify="right")
    columns = step_columns(study)
    names = ("step_m", "largest_change_error_m", "largest_height_error_m", "rms_height_error_m")
    for i in range(len(study.rounded)):
        lengths = (f"{1e3 * columns[name][i]:.3g}" for name in names)
        table.add_row(*lengths, f"{columns['least_force_N'][i]:.1f}")
    return table
