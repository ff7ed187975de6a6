"""`catenaria elasticity`: how far the contact wire rises where it is pushed."""

from __future__ import annotations

import time
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich import box
from rich.console import Console
from rich.table import Table

from catenaria.cli.failures import BAD_INPUT, INTERRUPTED, NOT_CONVERGED, complain, failures_reported
from catenaria.cli.lengths import positive_length
from catenaria.cli.points_shown import points_shown
from catenaria.cli.tolerance import beside

if TYPE_CHECKING:
    from catenaria.loading.elasticity import Wanted
    from catenaria.results.elasticity import ElasticityStudy
    from catenaria.units import Dimension

_MOST_SPANS = 30  # in the table on the screen


def elasticity(
    source: Annotated[
        Path, typer.Argument(metavar="RESULT|LINE", help="Folder that `solve` wrote, or a line file.")
    ],
    force: Annotated[
        str, typer.Option(help="Force on all contact wires together; 0 N for the limit of a small one.")
    ] = "100 N",
    spacing: Annotated[str, typer.Option(help="Distance of the points.")] = "0.5 m",
    nonlinear: Annotated[
        bool, typer.Option("--nonlinear", help="Solve every point with all nonlinearities; slower.")
    ] = False,
    start: Annotated[
        str | None,
        typer.Option("--from", metavar="CHAINAGE", help="First point.", show_default="first support"),
    ] = None,
    end: Annotated[
        str | None, typer.Option("--to", metavar="CHAINAGE", help="Last point.", show_default="last support")
    ] = None,
    most: Annotated[
        str | None,
        typer.Option("--max-elasticity", metavar="LIMIT", help='As "0.5 mm/N"; exit code 1 beyond.'),
    ] = None,
    uneven: Annotated[
        float | None,
        typer.Option("--max-nonuniformity", metavar="PERCENT", help="As 25; exit code 1 beyond.", min=0.0),
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option(help="Folder for the results.", show_default="RESULT with -elasticity behind it"),
    ] = None,
    no_figures: Annotated[bool, typer.Option("--no-figures", help="Write no figure.")] = False,
) -> None:
    """Find how far the contact wire rises where a static force pushes it, along the line.

    The line is built with all lengths that were found. Geometry is linearised about it at rest, and droppers
    go slack; at some points the nonlinear line is solved beside it, or with --nonlinear at all of them.

    Example:

      catenaria elasticity examples/yang2017_three_span.yaml --force 200N
      catenaria elasticity results/simple_60m --from 120m --to 240m --nonlinear
      catenaria elasticity results/simple_60m --max-elasticity "0.5 mm/N"

    The folder then holds elasticity.csv (a row for each point), spans.csv (extremes and non-uniformity of
    each span, and the hand formula), comparison.csv (linearised beside nonlinear), elasticity.png, and
    result.json with result.npz. For the line, the first and the last span do not count, nor do spans in which
    the contact wire is out of use: lifted on its way to an anchor, or without droppers beyond all others.

    Exit codes: 0 done, 1 the line does not come to rest, or a limit is not kept (all is written then),
    2 bad input, 130 interrupted.
    """
    console = Console(markup=False, highlight=False, emoji=False)
    began = time.perf_counter()
    with failures_reported():
        wanted = _read(force, spacing, start, end, most, uneven, nonlinear)
        folder = beside(source, "elasticity") if out is None else out
        study, count = _study(source, wanted, folder, console, figures=not no_figures)
    show_study(study, console)
    console.print(
        f"\nWritten to {folder}: {count} files, done after {time.perf_counter() - began:.1f} s.",
        soft_wrap=True,
    )
    for text in study.broken_limits():
        complain(f"Limit not kept: {text}")
    if study.broken_limits():
        raise typer.Exit(NOT_CONVERGED)


def _read(
    force: str,
    spacing: str,
    start: str | None,
    end: str | None,
    most: str | None,
    uneven: float | None,
    nonlinear: bool,
) -> Wanted:
    from catenaria.loading.elasticity import Wanted
    from catenaria.units import FORCE, LENGTH, Dimension

    flexibility = Dimension("an elasticity", "m/N", "0.5 mm/N")
    return Wanted(
        quantity("--force", force, FORCE),
        positive_length("--spacing", spacing),
        nonlinear,
        None if start is None else quantity("--from", start, LENGTH),
        None if end is None else quantity("--to", end, LENGTH),
        () if most is None else (_with_unit("--max-elasticity", most, flexibility),),
        () if uneven is None else (0.01 * uneven,),
    )


def _study(
    source: Path, wanted: Wanted, folder: Path, console: Console, *, figures: bool
) -> tuple[ElasticityStudy, int]:
    """Return the study and the number of files that were written."""
    from catenaria import results, workflow
    from catenaria.results.elasticity import ElasticityStudy

    results.require_replaceable(folder, ElasticityStudy)
    try:
        with points_shown(console) as tell:
            study = workflow.elasticity_as(source, wanted, tell)
        return study, len(workflow.write_elasticity(study, folder, figures=figures))
    except KeyboardInterrupt:
        complain("Interrupted. Nothing was written.")
        raise typer.Exit(INTERRUPTED) from None
    except OSError as error:
        complain(f"{folder} cannot be written: {error.strerror}")
        raise typer.Exit(BAD_INPUT) from error


def _with_unit(option: str, text: str, dimension: Dimension) -> float:
    """Return in SI what an option gives with a unit; a bare number would be one that nobody means."""
    from catenaria.errors import InconsistentInputError

    value = quantity(option, text, dimension)
    if not any(letter.isalpha() for letter in text.lower().replace("e", "")):
        raise InconsistentInputError(f"{option}: found {text!r}; allowed: with a unit, {dimension.example!r}")
    return value


def quantity(option: str, text: str, dimension: Dimension) -> float:
    """Return what an option gives in SI.

    Raises
    ------
    InconsistentInputError
        If it cannot be read.
    """
    from catenaria.errors import InconsistentInputError
    from catenaria.units import to_si

    try:
        return to_si(text, dimension)
    except ValueError as error:
        raise InconsistentInputError(f"{option}: found {text!r}; allowed: {error}") from None


def show_study(study: ElasticityStudy, console: Console) -> None:
    """Show spans, the line, and how good the linearised line is."""
    if study.spans.span.size:
        console.print(_span_table(study))
    inner = "inner spans" if study.spans.inner.any() else "all points"
    console.print(
        f"Elasticity in {inner}: {1e3 * study.smallest:.3f} to {1e3 * study.largest:.3f} mm/N, "
        f"non-uniformity {100.0 * study.nonuniformity:.1f} %, {_force(study)}, "
        f"{study.points.chainage.size} points.",
        soft_wrap=True,
    )
    if study.in_use:
        console.print(f"Spans count {study.in_use}.", soft_wrap=True)
    if study.held:
        many = "supports" if len(study.held) > 1 else "support"
        console.print(
            f"The contact wire is held in height at {many} {', '.join(study.held)}: elasticity 0.",
            soft_wrap=True,
        )
    if study.nonlinear:
        console.print("Every point was solved with all nonlinearities.")
    elif study.compared.why:
        compared = study.compared
        worst, agree = abs(compared.error).max(), int(compared.same_slack.sum())
        console.print(
            f"Geometry is linearised; at {len(compared.why)} points the nonlinear line differs by "
            f"{100.0 * worst:.1f} % at most, and at {agree} of them the same droppers are slack.",
            soft_wrap=True,
        )


def _force(study: ElasticityStudy) -> str:
    return f"{study.force:g} N" if study.force > 0.0 else "limit of a small force"


def _span_table(study: ElasticityStudy) -> Table:
    from catenaria.report.elasticity_tables import HAND_FACTORS

    low, high = (1e3 * study.spans.textbook(k) for k in reversed(HAND_FACTORS))
    spans = study.spans
    table = Table(
        title=f"Elasticity in mm/N, {_force(study)}",
        title_justify="left",
        title_style="bold",
        box=box.SIMPLE_HEAD,
    )
    for title in ("span", "smallest", "at", "largest", "at", "mid span", "by hand", "u [%]"):
        table.add_column(title, justify="right")
    for i in range(min(spans.span.size, _MOST_SPANS)):
        table.add_row(
            str(spans.span[i]),
            f"{1e3 * spans.smallest[i]:.3f}",
            f"{spans.smallest_chainage[i]:.1f} m",
            f"{1e3 * spans.largest[i]:.3f}",
            f"{spans.largest_chainage[i]:.1f} m",
            f"{1e3 * spans.at_middle[i]:.3f}",
            f"{low[i]:.2f}-{high[i]:.2f}",
            f"{100.0 * spans.nonuniformity[i]:.1f}",
        )
    if spans.span.size > _MOST_SPANS:
        table.caption = f"and {spans.span.size - _MOST_SPANS} more in spans.csv"
    return table
