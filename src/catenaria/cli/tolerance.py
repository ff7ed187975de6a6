"""`catenaria tolerance`: how a line scatters under errors of its installation."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Generator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich import box
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn
from rich.table import Table

from catenaria.cli.failures import BAD_INPUT, INTERRUPTED, complain, failures_reported
from catenaria.cli.lengths import positive_length

if TYPE_CHECKING:
    from catenaria.results.tolerance import ToleranceStudy

_PLAIN_INTERVAL = 10.0  # seconds of wall time between two lines when there is no terminal
_SHOWN_ERRORS = 5


def tolerance(
    source: Annotated[
        Path, typer.Argument(metavar="RESULT|LINE", help="Folder that `solve` wrote, or a line file.")
    ],
    samples: Annotated[int, typer.Option(help="Number of lines with random errors.", min=2)] = 10_000,
    errors: Annotated[
        Path | None,
        typer.Option(
            help="File with errors of installation.",
            show_default="those of LINE, or usual ones",
        ),
    ] = None,
    seed: Annotated[
        int | None, typer.Option(help="Seed of the random numbers.", min=0, show_default="that of the errors")
    ] = None,
    workers: Annotated[
        int | None, typer.Option(help="Number of processes.", min=1, show_default="all processors")
    ] = None,
    limit: Annotated[
        str, typer.Option("--tolerance", help="By how much contact-wire heights may be off.")
    ] = "5 mm",
    linear: Annotated[
        bool, typer.Option("--linear", help="Samples of the linearised line only: done at once.")
    ] = False,
    out: Annotated[
        Path | None,
        typer.Option(help="Folder for the results.", show_default="RESULT with -tolerance behind it"),
    ] = None,
    no_figures: Annotated[bool, typer.Option("--no-figures", help="Write no figures.")] = False,
) -> None:
    """Study how heights, tensions and forces scatter under errors of installation.

    Dropper lengths and positions, heights and staggers of supports, and tensions are a little wrong in every
    line that is built. Many such lines are brought to rest; known errors and distributions of others come
    from a file, from the line file, or are the tolerances of practice.

    Example:

      catenaria tolerance examples/yang2017_three_span.yaml
      catenaria tolerance results/simple_60m --errors examples/installation_errors.yaml --samples 2000
      catenaria tolerance results/simple_60m --linear --tolerance "10 mm"

    The folder then holds heights.csv (percentiles and the probability of leaving the tolerance, at each
    dropper), forces.csv, tensions.csv, elasticity.csv (linearised, at mid spans), groups.csv and errors.csv
    (which errors matter), events.csv (leaving the tolerance, slack droppers, no rest, with 95 % limits),
    figures/, and result.json with result.npz. The same seed gives the same numbers, whatever the number of
    processes.

    Exit codes: 0 done, 1 the line itself does not come to rest, 2 bad input, 130 interrupted. Nothing is
    written unless it is 0. Samples that do not come to rest are counted, and count as beyond the tolerance.
    """
    console = Console(markup=False, highlight=False, emoji=False)
    began = time.perf_counter()
    with failures_reported():
        from catenaria import results, workflow
        from catenaria.loading.tolerance import Options
        from catenaria.results.tolerance import ToleranceStudy

        folder = beside(source, "tolerance") if out is None else out
        options = Options(
            samples=samples,
            model="linear" if linear else "nonlinear",
            workers=workers or os.cpu_count() or 1,
            tolerance=positive_length("--tolerance", limit),
        )
        results.require_replaceable(folder, ToleranceStudy)
        try:
            with samples_shown(console) as tell:
                study = workflow.tolerances(source, errors, options, seed, tell)
            files = workflow.write_tolerances(study, folder, figures=not no_figures)
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


def beside(source: Path, what: str) -> Path:
    """Return a folder beside that of a result, or the one that the result of a line would have."""
    if source.is_file() and source.name != "result.json":
        return Path("results") / f"{source.stem}-{what}"
    folder = (source if source.is_dir() else source.parent).resolve()
    return folder.with_name(f"{folder.name}-{what}")


@contextmanager
def samples_shown(console: Console) -> Generator[Callable[[int, int], None], None, None]:
    """Show how many samples are done, as a bar in a terminal and as lines elsewhere."""
    if not console.is_terminal:
        yield _Lines(console)
        return
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    with Progress(*columns, console=console, transient=True) as bar:
        task = bar.add_task("Preparing", total=None)
        yield lambda done, of: bar.update(task, description="Samples", completed=done, total=of)


class _Lines:
    """Prints a line now and then."""

    def __init__(self, console: Console) -> None:
        self._console = console
        self._printed_at = time.perf_counter()

    def __call__(self, done: int, of: int) -> None:
        if time.perf_counter() - self._printed_at >= _PLAIN_INTERVAL:
            self._console.print(f"{done} of {of} samples", soft_wrap=True)
            self._printed_at = time.perf_counter()


def show_study(study: ToleranceStudy, console: Console) -> None:
    """Show how probable it is to leave the tolerance, and which errors matter."""
    share, low, high = (100.0 * value for value in study.event("leaving"))
    console.print(
        f"{study.samples} samples, {study.model}, seed {study.seed}: the contact wire leaves "
        f"±{1e3 * study.tolerance:g} mm in {share:.2f} % (95 % limits {low:.2f} % to {high:.2f} %).",
        soft_wrap=True,
    )
    if study.model != "linear":
        share, rms, most = study.event("leaving, linear")[0], study.difference, study.largest_difference
        console.print(
            f"The linearised line leaves it in {100.0 * share:.2f} %; heights differ by {1e3 * rms:.3f} mm "
            f"(rms), {1e3 * most:.3f} mm at most.",
            soft_wrap=True,
        )
    if study.count_of("no rest"):
        console.print(f"No rest was found in {study.count_of('no rest')} samples.", soft_wrap=True)
    if study.count_of("slack"):
        console.print(f"Droppers hang slack in {study.count_of('slack')} samples.", soft_wrap=True)
    console.print(_group_table(study))
    errors = study.errors
    order = sorted(range(len(errors.name)), key=lambda k: -float(errors.share[k]))[:_SHOWN_ERRORS]
    if order:
        most = "; ".join(f"{errors.group[k]} {errors.name[k]} {100.0 * errors.share[k]:.1f} %" for k in order)
        console.print(f"Single errors that matter most: {most}.", soft_wrap=True)


def _group_table(study: ToleranceStudy) -> Table:
    of = study.importance
    table = Table(
        title="Shares of the variance of contact-wire heights in %",
        title_justify="left",
        title_style="bold",
        box=box.SIMPLE_HEAD,
    )
    table.add_column("errors of", no_wrap=True)
    for title in ("number", "linear", "sampled", "leaving without"):
        table.add_column(title, justify="right")
    for i, group in enumerate(of.group):
        shares = (of.share[i], of.sampled_share[i], of.leaving_without[i])
        table.add_row(group, str(of.count[i]), *(f"{100.0 * share:.2f}" for share in shares))
    return table
