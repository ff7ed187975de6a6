"""What a person takes away: files made in a temporary folder, as bytes."""

from __future__ import annotations

import io
import zipfile
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Final

from catenaria import workflow
from catenaria.errors import InconsistentInputError
from catenaria.line import Line
from catenaria.report.tables import TABLES, write_csv
from catenaria.results import FormResult
from catenaria.studio.documents import Document, plain_name


@dataclass(frozen=True)
class Download:
    """A file by name and contents."""

    name: str
    content: bytes


def line_file(document: Document) -> Download:
    """Return the line file, right or wrong, as it was written where it was not edited."""
    return Download(document.file, document.text.encode())


def droppers_csv(result: FormResult) -> Download:
    """Return the dropper schedule as `catenaria solve` writes it."""
    with TemporaryDirectory(prefix="catenaria-studio-") as folder:
        file = write_csv(Path(folder) / "droppers.csv", TABLES["droppers"](result))
        return Download(f"{plain_name(result.name)}-{file.name}", file.read_bytes())


def report_page(result: FormResult) -> Download:
    """Return the report."""
    return Download(f"{plain_name(result.name)}-report.html", workflow.report(result).encode())


def report_pdf(result: FormResult) -> Download:
    """Return the report as it is printed.

    Raises
    ------
    UnsupportedError
        If this computer has no browser that prints.
    NotConvergedError
        If the browser fails.
    """
    with TemporaryDirectory(prefix="catenaria-studio-") as folder:
        files = workflow.write_report(workflow.report(result), Path(folder) / "report.html", pdf=True)
        return Download(f"{plain_name(result.name)}-{files[1].name}", files[1].read_bytes())


def result_folder(result: FormResult) -> Download:
    """Return everything that `catenaria solve --report` writes, after the rebuild that it does.

    Raises
    ------
    InconsistentInputError
        If audit or rebuild do not confirm the form.
    """
    built = workflow.solve(Line.model_validate(result.inputs))
    findings = (*built.audit.findings, *built.rebuilt.findings())
    if findings:
        raise InconsistentInputError(f"the form is not confirmed, so there is no folder: {findings[0]}")
    return _zipped("result", result.name, lambda out: workflow.write(built, out, report=True))


def exported(name: workflow.ExportFormat, result: FormResult) -> Download:
    """Return an export, zipped if it is several files."""
    return _zipped(name, result.name, lambda out: workflow.export(result, [name], out))


def _zipped(what: str, line: str, write: Callable[[Path], tuple[Path, ...]]) -> Download:
    with TemporaryDirectory(prefix="catenaria-studio-") as temporary:
        folder = Path(temporary) / what
        files = write(folder)
        if len(files) == 1:
            return Download(f"{plain_name(line)}-{files[0].name}", files[0].read_bytes())
        stream = io.BytesIO()
        with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
            for file in files:
                archive.write(file, file.relative_to(folder))
    return Download(f"{plain_name(line)}-{what}.zip", stream.getvalue())


EXPORTS: Final[Mapping[workflow.ExportFormat, str]] = {
    "xlsx": "Schedule, XLSX",
    "csv": "Schedule, CSV",
    "dxf": "Drawings, DXF",
    "vtk": "ParaView, VTU",
    "json": "Tables, JSON",
    "dynamics": "State for dynamics codes",
    "exudyn": "Exudyn model",
}
