"""`catenaria solve`: find the form of a line and write it to a folder."""

from __future__ import annotations

import time
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, NamedTuple, NoReturn, cast

import typer
from rich.console import Console

from catenaria.cli.failures import BAD_INPUT, INTERRUPTED, NOT_CONVERGED, complain, failures_reported
from catenaria.cli.points_shown import elasticity_told
from catenaria.cli.progress import display_on
from catenaria.cli.summary import show_result

if TYPE_CHECKING:
    from catenaria.results import FormResult
    from catenaria.workflow import Progress, Rebuild


def solve(
    line: Annotated[Path, typer.Argument(metavar="LINE", help="Line file, YAML or JSON.")],
    method: Annotated[
        str, typer.Option(help="Form-finding method: direct, dynamic, or one that `compare` shows.")
    ] = "direct",
    out: Annotated[
        Path | None,
        typer.Option(help="Folder for the results.", show_default="results/ and the name of LINE"),
    ] = None,
    start: Annotated[
        Path | None,
        typer.Option(help="Begin from an earlier result (folder or result.json) of the same line."),
    ] = None,
    rebuild: Annotated[
        str, typer.Option(help="Build the line from the found lengths: static, relaxation or none.")
    ] = "static",
    mesh: Annotated[
        list[str] | None,
        typer.Option(metavar="KEY=VALUE", help="A field of solver.mesh of LINE; may be given several times."),
    ] = None,
    no_figures: Annotated[bool, typer.Option("--no-figures", help="Write no figures.")] = False,
    report: Annotated[
        bool, typer.Option("--report", help="Write report.html too, with elasticity; see `catenaria report`.")
    ] = False,
) -> None:
    """Find the form of a line and write it to a folder.

    That is: the equilibrium, the lengths of droppers and wires, and all forces.

    Example:

      catenaria solve examples/yang2017_three_span.yaml --method dynamic
      catenaria solve examples/yang2017_three_span.yaml --mesh refine=2 --mesh largest_element=1.2m

    The folder then holds droppers.csv (the dropper schedule), wires.csv, supports.csv, controls.csv,
    counters.csv, configuration.csv, history.csv, figures/, and result.json with result.npz, which --start and
    Python read. The results of an earlier run are replaced as a whole; a folder with files of yours in it is
    refused.

    Before that an audit checks all numbers, and a line that is built from the found lengths must come to
    rest where it was found: statically, or, with --rebuild relaxation, from a disturbed start and without
    any matrix, which takes seconds. Only forms by the direct and the dynamic method are rebuilt.

    Exit codes: 0 done and confirmed, 1 not converged or not confirmed by audit and rebuild, 2 bad
    input, 130 interrupted. Nothing is written unless it is 0.
    """
    folder = Path("results") / line.stem if out is None else out
    console = Console(markup=False, highlight=False, emoji=False)
    began = time.perf_counter()
    with failures_reported():
        if report:
            from catenaria.report.html.page import require_report_libraries

            require_report_libraries()
        result = _find_form(line, _Request(method, start, rebuild, tuple(mesh or ())), folder, console)
        _require_trusted(result)
        files = _write(result, folder, console, figures=not no_figures, report=report)
    show_result(result, console)
    console.print(
        f"\nWritten to {folder}: {len(files)} files, done after {time.perf_counter() - began:.1f} s.",
        soft_wrap=True,
    )


class _Request(NamedTuple):
    """How a line shall be solved, as options say."""

    method: str
    start: Path | None
    rebuild: str
    mesh: tuple[str, ...]


def _find_form(line: Path, request: _Request, folder: Path, console: Console) -> FormResult:
    display = display_on(console)
    try:
        with display.shown():
            # Imported late: numerical libraries take longer to load than --help may.
            from catenaria import results, workflow
            from catenaria.line import read_mesh

            results.require_replaceable(folder)
            return workflow.solve(
                line,
                method=request.method,
                start=None if request.start is None else results.load_result(request.start),
                progress=display.update,
                rebuild=cast("Rebuild", request.rebuild),  # any other text is refused
                mesh=read_mesh(request.mesh) if request.mesh else None,
            )
    except KeyboardInterrupt:
        _end_interrupted(_whereabouts(display.latest, request.method))


def _whereabouts(latest: Progress | None, method: str) -> str:
    if latest is None:
        return "before the first step. Nothing was written"
    simulated = f" at {latest.time:.1f} s of simulated time" if method == "dynamic" else ""
    return f"in the stage '{latest.stage}'{simulated}. Nothing was written"


def _require_trusted(result: FormResult) -> None:
    """End the command if the audit of the result failed, or the rebuilt line comes to rest elsewhere."""
    checks = (
        (result.audit.lines(), result.audit.findings, "The audit failed"),
        (result.rebuilt.lines(), result.rebuilt.findings(), "The rebuilt line does not come back"),
    )
    for lines, findings, what in checks:
        if findings:
            for text in (*lines, *findings):
                complain(text)
            complain(f"{what}, so nothing was written.")
            raise typer.Exit(NOT_CONVERGED)


def _write(
    result: FormResult, folder: Path, console: Console, *, figures: bool, report: bool
) -> tuple[Path, ...]:
    from catenaria import workflow

    try:
        doing = "Writing the results"
        with console.status(doing) as status:
            tell = elasticity_told(status, doing)
            return workflow.write(result, folder, figures=figures, report=report, progress=tell)
    except KeyboardInterrupt:
        _end_interrupted(f"while writing. {folder} holds all of the new results or what it held before")
    except OSError as error:
        complain(f"{folder} cannot be written: {error.strerror}")  # its path is that of a temporary folder
        raise typer.Exit(BAD_INPUT) from error


def _end_interrupted(where: str) -> NoReturn:
    complain(f"Interrupted {where}.")
    raise typer.Exit(INTERRUPTED)
