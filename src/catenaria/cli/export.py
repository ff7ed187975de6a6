"""`catenaria export`: a result for fitters, CAD, ParaView and dynamics codes."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.console import Console

from catenaria.cli.failures import BAD_INPUT, INTERRUPTED, complain, failures_reported
from catenaria.cli.lengths import positive_length

if TYPE_CHECKING:
    from catenaria.workflow.export import ExportFormat


class Format(StrEnum):
    """What can be written."""

    XLSX = "xlsx"
    CSV = "csv"
    DXF = "dxf"
    VTK = "vtk"
    JSON = "json"
    DYNAMICS = "dynamics"
    EXUDYN = "exudyn"
    ALL = "all"


def export(
    result: Annotated[Path, typer.Argument(metavar="RESULT", help="Folder that `catenaria solve` wrote.")],
    formats: Annotated[list[Format], typer.Option("--format", help="What to write; several times.")],
    out: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE|DIR",
            help="A folder, or for one of xlsx, csv, vtk and json the file.",
            show_default="a folder beside RESULT, with the format or -export behind its name",
        ),
    ] = None,
    step: Annotated[str, typer.Option(help="Step to which cut lengths of droppers are rounded.")] = "1mm",
    modes: Annotated[int, typer.Option(min=1, help="How many natural modes dynamics codes get.")] = 20,
) -> None:
    """Write a result for fitters, CAD, ParaView and dynamics codes.

    Example:

    \b
      catenaria solve examples/simple_60m.yaml --out results/simple_60m
      catenaria export results/simple_60m --format xlsx --step 5mm --out droppers.xlsx
      catenaria export results/simple_60m --format dxf --format vtk --out drawings
      catenaria export results/simple_60m --format all

    \b
    xlsx      schedule.xlsx: dropper schedule to be printed, a sheet for each span, and other tables
    csv       schedule.csv: the same schedule, exact and rounded cut lengths
    dxf       profile.dxf (heights ten times exaggerated) and plan.dxf (true coordinates), in metres
    vtk       line.vtu: wires and droppers in space with tension and curvature, for ParaView
    json      tables.json: all tables in SI units; `catenaria schema --result` explains them
    dynamics  dynamics/: nodes, elements, joints, matrices and modes, in a documented neutral format
    exudyn    exudyn/: the same with a script that builds the line in Exudyn
    all       all of them that the result has; methods without nodes have no matrices

    A folder is replaced if catenaria wrote it and nobody changed it, else the command is refused; a file that
    --out names is replaced. Nothing is left half written.

    Exit codes: 0 written, 1 the line does not come to rest, 2 bad input or a missing library, 130
    interrupted.
    """  # noqa: D301 (\b keeps the rows of the table apart)
    console = Console(markup=False, highlight=False, emoji=False)
    with failures_reported():
        from catenaria import results, workflow

        options = workflow.ExportOptions(positive_length("--step", step), modes)
        found = results.load_result(result)
        everything = Format.ALL in formats
        named: list[ExportFormat] = [name for name in workflow.FORMATS if Format(name) in formats]
        chosen = workflow.formats_of(found) if everything else named
        place = _beside(result, formats) if out is None else out
        try:
            with console.status(f"Writing {', '.join(chosen)}"):
                files = workflow.export(found, chosen, place, options)
        except KeyboardInterrupt:
            complain("Interrupted. Nothing was written.")
            raise typer.Exit(INTERRUPTED) from None
        except OSError as error:
            complain(f"{place} cannot be written: {error.strerror}")
            raise typer.Exit(BAD_INPUT) from error
    left_out = [name for name in workflow.FORMATS if everything and name not in chosen]
    if left_out:
        console.print(f"Left out: {', '.join(left_out)}, for the method {found.method} has no nodes.")
    console.print("Written: " + (str(files[0]) if len(files) == 1 else f"{place}, {len(files)} files."))


def _beside(result: Path, formats: list[Format]) -> Path:
    folder = (result if result.is_dir() else result.parent).resolve()
    one = len(set(formats)) == 1 and formats[0] != Format.ALL
    return folder.with_name(f"{folder.name}-{formats[0] if one else 'export'}")
