"""`catenaria load`: what becomes of a found line under loads."""

from __future__ import annotations

import time
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.console import Console
from rich.table import Table

from catenaria.cli.failures import BAD_INPUT, INTERRUPTED, complain, failures_reported
from catenaria.cli.tolerance import beside

if TYPE_CHECKING:
    from catenaria.results.case import CaseResult, LoadStudy


def load(
    source: Annotated[
        Path, typer.Argument(metavar="RESULT|LINE", help="Folder that `solve` wrote, or a line file.")
    ],
    case: Annotated[
        list[str] | None,
        typer.Option(metavar="FILE[:NAME]", help="File of load cases, or one of them; several times."),
    ] = None,
    temperature: Annotated[
        list[str] | None,
        typer.Option(metavar="CHANGE", help='"40 K" warmer, or "55 degC"; several times.'),
    ] = None,
    wind: Annotated[
        str | None,
        typer.Option(metavar="SPEED[@DIRECTION]", help='"26 m/s", "26 m/s@270 deg" from the left.'),
    ] = None,
    push: Annotated[
        list[str] | None,
        typer.Option(metavar="FORCE@CHAINAGE", help="Push the contact wire up: 200N@1234m; several times."),
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option(
            help="Folder for the results.", show_default="beside RESULT, with -loads behind its name"
        ),
    ] = None,
    no_figures: Annotated[bool, typer.Option("--no-figures", help="Write no figures.")] = False,
) -> None:
    """Solve load cases: temperature, wind, ice, missing droppers, moved supports, a push.

    The line is built with all lengths that were found; clamps stay where they are on their wires, and
    tensioning devices follow by their own laws.

    Example:

      catenaria solve examples/simple_60m.yaml --out results/simple_60m
      catenaria load results/simple_60m --case examples/load_cases.yaml
      catenaria load results/simple_60m --case examples/load_cases.yaml:storm
      catenaria load results/simple_60m --temperature "40 K" --wind "26 m/s"
      catenaria load results/simple_60m --push 200N@330m

    Options of one command act together in one case, at every temperature that is given; wind comes from the
    right unless another direction is given (0 from ahead, 90 from the right, clockwise).

    The folder then holds cases.csv with a row for each case, result.json with result.npz, stroke.png if
    there are several temperatures, and for each case a folder of its name: droppers.csv, wires.csv,
    supports.csv, arms.csv, spans.csv (lowest and most deviated points, limits of 400 and 550 mm),
    blow_off.csv (the textbook's lateral position beside the solved one), pushes.csv, configuration.csv and
    figures.

    Exit codes: 0 done, 1 a case does not come to rest, 2 bad input, 130 interrupted. Nothing is written
    unless it is 0. Limits are stated, not judged: a wire beyond 400 mm does not change the exit code.
    """
    console = Console(markup=False, highlight=False, emoji=False)
    began = time.perf_counter()
    with failures_reported():
        from catenaria import results, workflow
        from catenaria.line.load_options import read_cases
        from catenaria.results.case import LoadStudy

        cases = read_cases(case or (), temperature or (), wind, push or ())
        folder = beside(source, "loads") if out is None else out
        results.require_replaceable(folder, LoadStudy)
        try:
            with console.status("Reading the result") as status:

                def show(name: str, number: int, count: int) -> None:
                    status.update(f"Case {number} of {count}: {name}")

                study = workflow.under_loads(source, cases, show)
                status.update("Writing the results")
                files = workflow.write_loads(study, folder, figures=not no_figures)
        except KeyboardInterrupt:
            complain("Interrupted. Nothing was written.")
            raise typer.Exit(INTERRUPTED) from None
        except OSError as error:
            complain(f"{folder} cannot be written: {error.strerror}")
            raise typer.Exit(BAD_INPUT) from error
    show_study(study, console)
    console.print(
        f"\nWritten to {folder}: {len(files)} files, done after {time.perf_counter() - began:.1f} s.",
        soft_wrap=True,
    )


def show_study(study: LoadStudy, console: Console) -> None:
    """Show a row for each case, and caution where there is reason to."""
    from catenaria.report.case_columns import case_columns

    columns = case_columns(study)
    table = Table(title=f"Load cases: {study.line}" if study.line else "Load cases", title_justify="left")
    shown = {
        "lowest_contact_wire_m": "lowest [m]",
        "largest_lateral_m": "side [m]",
        "support_uplift_m": "uplift [m]",
        "push_uplift_m": "push [m]",
        "contact_wire_stroke_m": "stroke [m]",
        "slack_droppers": "slack",
    }
    table.add_column("case", overflow="fold")
    for title in shown.values():
        table.add_column(title, justify="right")
    for i, name in enumerate(columns["case"]):
        table.add_row(name, *(_cell(columns[column][i]) for column in shown))
    console.print(table)
    for case in study.cases:
        for text in _remarks(case):
            console.print(f"{case.name}: {text}", soft_wrap=True)


def _cell(value: object) -> str:
    if not isinstance(value, float):
        return str(value)
    return "" if value != value else f"{value:.3f}"


def _remarks(case: CaseResult) -> list[str]:
    import numpy as np

    remarks: list[str] = []
    if case.blow_off.wire:
        i = int(np.argmax(np.abs(case.blow_off.solved)))
        blown = case.blow_off
        alone, combined = 1e3 * blown.alone[i], 1e3 * blown.combined[i]
        remarks.append(
            f"blow-off {1e3 * blown.solved[i]:.0f} mm in span {blown.span[i]}; by the textbook "
            f"{alone:.0f} mm (contact wire alone), {combined:.0f} mm (all as one)."
        )
    if case.state.droppers.slack.any():
        remarks.append(f"{int(case.state.droppers.slack.sum())} droppers are slack.")
    return remarks
