"""`catenaria adjust`: from measured heights to corrected dropper lengths."""

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
    from catenaria.loading.adjustment_limits import AdjustmentLimits
    from catenaria.results.adjustment import Adjustment


def adjust(
    result: Annotated[Path, typer.Argument(metavar="RESULT", help="Folder that `catenaria solve` wrote.")],
    measured: Annotated[Path, typer.Option(metavar="FILE", help="CSV file with measured heights.")],
    tolerance: Annotated[str, typer.Option(help="How near heights at droppers shall be.")] = "5 mm",
    at_most: Annotated[
        int | None, typer.Option(help="How many droppers may be adjusted.", show_default="any number")
    ] = None,
    step: Annotated[str, typer.Option(help="Lengths change by multiples of it.")] = "5 mm",
    noise: Annotated[str, typer.Option(help="Standard deviation of the measurement.")] = "0 mm",
    least_force: Annotated[str, typer.Option(help="What every dropper shall bear afterwards.")] = "0 N",
    largest_change: Annotated[str, typer.Option(help="No dropper is changed by more.")] = "100 mm",
    out: Annotated[
        Path | None,
        typer.Option(
            help="Folder for the results.", show_default="that of RESULT with -adjust behind its name"
        ),
    ] = None,
    no_figures: Annotated[bool, typer.Option("--no-figures", help="Write no figure.")] = False,
) -> None:
    """Say which droppers of a built line to adjust, by measured heights of its contact wire.

    FILE has the columns span, dropper and height_m (or chainage_m and height_m); droppers that are left out
    were not measured. First the lengths are found that explain the measurement, then the fewest changes, in
    whole steps, that bring all heights at droppers within the tolerance of those of RESULT.

    Example:

    \b
      catenaria solve examples/yang2017_three_span.yaml --out results/three_spans
      catenaria adjust results/three_spans --measured examples/measured_heights.csv --noise 0.5mm
      catenaria adjust results/three_spans --measured examples/measured_heights.csv --at-most 2

    The folder then holds adjust.csv (a row for each dropper to adjust), heights.csv (all droppers before and
    after), measured.csv, adjust.png, and result.json with result.npz.

    Exit codes: 0 done, also if there is nothing to do; 1 no lengths explain the measurement; 2 bad input, or
    the tolerance cannot be reached like that: the message says what would do; 130 interrupted. Nothing is
    written unless it is 0.
    """  # noqa: D301 (\b keeps the lines of the example apart)
    console = Console(markup=False, highlight=False, emoji=False)
    with failures_reported():
        from catenaria import results, workflow

        limits = _limits(tolerance, at_most, step, noise, least_force, largest_change)
        folder = beside(result, "adjust") if out is None else out
        results.require_replaceable(folder)
        try:
            with console.status("Reading the result") as status:
                study = workflow.adjust(result, measured, limits, status.update)
                status.update("Writing the results")
                files = workflow.write_adjustment(study, folder, figures=not no_figures)
        except KeyboardInterrupt:
            complain("Interrupted. Nothing was written.")
            raise typer.Exit(INTERRUPTED) from None
        except OSError as error:
            complain(f"{folder} cannot be written: {error.strerror}")
            raise typer.Exit(BAD_INPUT) from error
    show_adjustment(study, console)
    console.print(f"\nWritten to {folder}: {len(files)} files.", soft_wrap=True)


def _limits(
    tolerance: str, at_most: int | None, step: str, noise: str, least_force: str, largest_change: str
) -> AdjustmentLimits:
    from catenaria.errors import InconsistentInputError
    from catenaria.loading.adjustment_limits import AdjustmentLimits
    from catenaria.units import FORCE, LENGTH, to_si

    def quantity(option: str, text: str, force: bool = False) -> float:
        try:
            return to_si(text, FORCE if force else LENGTH)
        except ValueError as error:
            raise InconsistentInputError(f"{option}: found {text!r}; allowed: {error}") from None

    return AdjustmentLimits(
        tolerance=positive_length("--tolerance", tolerance),
        step=positive_length("--step", step),
        at_most=at_most,
        noise=quantity("--noise", noise),
        least_force=quantity("--least-force", least_force, force=True),
        largest_change=positive_length("--largest-change", largest_change),
    )


def show_adjustment(study: Adjustment, console: Console) -> None:
    """Show a row for each dropper to adjust, and what is reached."""
    droppers = study.droppers
    before, after = (
        1e3 * study.largest_deviation(h) for h in (droppers.height_before, droppers.height_after)
    )
    unexplained = 1e3 * float(abs(study.points.height - study.points.explained).max(initial=0.0))
    if study.count == 0:
        console.print(
            f"Nothing to do: heights are within {before:.1f} mm of the wanted ones.", soft_wrap=True
        )
    else:
        console.print(adjustment_table(study))
        sure = "" if study.fewest == study.count else f" (fewer than {study.fewest} would not do)"
        console.print(
            f"{study.count} droppers{sure}. Largest deviation {before:.1f} mm before, {after:.1f} mm after.",
            soft_wrap=True,
        )
    if droppers.slack_before.any():
        console.print(
            f"{int(droppers.slack_before.sum())} droppers hang slack and may be longer than is said here: "
            "make them taut first.",
            soft_wrap=True,
        )
    if unexplained > 1.0:
        console.print(
            f"Up to {unexplained:.1f} mm of the measured heights are not explained by dropper lengths; see "
            "measured.csv.",
            soft_wrap=True,
        )


def adjustment_table(study: Adjustment) -> Table:
    """Return the table of the droppers to adjust."""
    from catenaria.report.adjustment_tables import adjust_columns

    columns = adjust_columns(study)
    table = Table(
        title="Droppers to adjust; how far heights are off in mm",
        title_justify="left",
        title_style="bold",
        box=box.SIMPLE_HEAD,
    )
    for title in ("span", "no.", "at [m]", "by [mm]", "cut to [m]", "off before", "after", "force [N]"):
        table.add_column(title, justify="right")
    for i in range(study.count):
        wanted = columns["wanted_height_m"][i]
        table.add_row(
            str(columns["span"][i]),
            str(columns["dropper"][i]),
            f"{columns['chainage_m'][i]:.2f}",
            f"{columns['change_mm'][i]:+g}",
            f"{columns['new_cut_length_m'][i]:.4f}",
            f"{1e3 * (columns['height_before_m'][i] - wanted):+.1f}",
            f"{1e3 * (columns['height_after_m'][i] - wanted):+.1f}",
            f"{columns['force_after_N'][i]:.1f}",
        )
    return table
