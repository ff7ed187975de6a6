"""`catenaria solve`: find the form of a line and write it to a folder."""

from __future__ import annotations

import time
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, NoReturn

import typer
from rich.console import Console

from catenaria.cli.failures import BAD_INPUT, INTERRUPTED, NOT_CONVERGED, complain, failures_reported
from catenaria.cli.progress import display_on
from catenaria.cli.summary import show_result

if TYPE_CHECKING:
    from catenaria.results import FormResult
    from catenaria.workflow import Progress


def solve(
    line: Annotated[Path, typer.Argument(metavar="LINE", help="Line file, YAML or JSON.")],
    method: Annotated[str, typer.Option(help="Form-finding method: direct or dynamic.")] = "direct",
    out: Annotated[
        Path | None,
        typer.Option(help="Folder for the results.", show_default="results/ and the name of LINE"),
    ] = None,
    start: Annotated[
        Path | None,
        typer.Option(help="Begin from an earlier result (folder or result.json) of the same line."),
    ] = None,
    no_figures: Annotated[bool, typer.Option("--no-figures", help="Write no figures.")] = False,
) -> None:
    """Find the form of a line and write it to a folder.

    That is: the equilibrium, the lengths of droppers and wires, and all forces.

    Example:

      catenaria solve examples/yang2017_three_span.yaml --method dynamic

    The folder then holds droppers.csv (the dropper schedule), wires.csv, supports.csv, controls.csv,
    counters.csv, configuration.csv, history.csv, figures/, and result.json with result.npz, which --start and
    Python read. The results of an earlier run are replaced as a whole; a folder with files of yours in it is
    refused.

    Exit codes: 0 done and audited, 1 not converged or audit failed, 2 bad input, 130 interrupted. Nothing is
    written unless it is 0.
    """
    folder = Path("results") / line.stem if out is None else out
    console = Console(markup=False, highlight=False, emoji=False)
    began = time.perf_counter()
    with failures_reported():
        result = _find_form(line, method, start, folder, console)
        _require_audited(result)
        files = _write(result, folder, console, figures=not no_figures)
    show_result(result, console)
    console.print(
        f"\nWritten to {folder}: {len(files)} files, done after {time.perf_counter() - began:.1f} s.",
        soft_wrap=True,
    )


def _find_form(line: Path, method: str, start: Path | None, folder: Path, console: Console) -> FormResult:
    display = display_on(console)
    try:
        with display.shown():
            # Imported late: numerical libraries take longer to load than --help may.
            from catenaria import results, workflow

            results.require_replaceable(folder)
            earlier = None if start is None else results.load_result(start)
            return workflow.solve(line, method=method, start=earlier, progress=display.update)
    except KeyboardInterrupt:
        _end_interrupted(_whereabouts(display.latest, method))


def _whereabouts(latest: Progress | None, method: str) -> str:
    if latest is None:
        return "before the first step. Nothing was written"
    simulated = f" at {latest.time:.1f} s of simulated time" if method == "dynamic" else ""
    return f"in the stage '{latest.stage}'{simulated}. Nothing was written"


def _require_audited(result: FormResult) -> None:
    """End the command if the audit of the result failed."""
    if not result.audit.passed:
        for text in (*result.audit.lines(), *result.audit.findings):
            complain(text)
        complain("The audit failed, so nothing was written.")
        raise typer.Exit(NOT_CONVERGED)


def _write(result: FormResult, folder: Path, console: Console, *, figures: bool) -> tuple[Path, ...]:
    from catenaria import workflow

    try:
        with console.status("Writing the results"):
            return workflow.write(result, folder, figures=figures)
    except KeyboardInterrupt:
        _end_interrupted(f"while writing. {folder} holds all of the new results or what it held before")
    except OSError as error:
        complain(f"{folder} cannot be written: {error.strerror}")  # its path is that of a temporary folder
        raise typer.Exit(BAD_INPUT) from error


def _end_interrupted(where: str) -> NoReturn:
    complain(f"Interrupted {where}.")
    raise typer.Exit(INTERRUPTED)
