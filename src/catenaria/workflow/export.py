"""From a result to files for others: every format, written whole or not at all."""

from __future__ import annotations

import os
import secrets
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final, Literal

from catenaria.errors import InconsistentInputError
from catenaria.export.dxf import write_plan_dxf, write_profile_dxf
from catenaria.export.dynamics import MODES, write_dynamics
from catenaria.export.exudyn import write_exudyn
from catenaria.export.schedule import write_schedule
from catenaria.export.tables_json import write_tables_json
from catenaria.export.tables_schema import tables_schema
from catenaria.export.vtk import write_vtu
from catenaria.export.xlsx import write_xlsx
from catenaria.results import FormResult, files_of, load_result, replace_folder

__all__ = ["FORMATS", "ExportFormat", "ExportOptions", "export", "formats_of", "tables_schema"]

ExportFormat = Literal["xlsx", "csv", "dxf", "vtk", "json", "dynamics", "exudyn"]


@dataclass(frozen=True)
class ExportOptions:
    """What formats leave open.

    Attributes
    ----------
    step : float
        Cut lengths of droppers are also given rounded to whole steps [m].
    modes : int
        How many natural modes dynamics codes get.
    """

    step: float = 1e-3
    modes: int = MODES


def _dxf(result: FormResult, folder: Path, options: ExportOptions) -> None:
    write_profile_dxf(result, folder / "profile.dxf", options.step)
    write_plan_dxf(result, folder / "plan.dxf")


def _dynamics(result: FormResult, folder: Path, options: ExportOptions) -> None:
    (folder / "dynamics").mkdir()
    write_dynamics(result, folder / "dynamics", options.modes)


def _exudyn(result: FormResult, folder: Path, options: ExportOptions) -> None:
    (folder / "exudyn").mkdir()
    write_exudyn(result, folder / "exudyn", options.modes)


Writer = Callable[[FormResult, Path, ExportOptions], None]

_SINGLE: Final[dict[str, tuple[str, Writer]]] = {
    "xlsx": ("schedule.xlsx", lambda result, file, options: write_xlsx(result, file, options.step)),
    "csv": ("schedule.csv", lambda result, file, options: write_schedule(result, file, options.step)),
    "vtk": ("line.vtu", lambda result, file, _: write_vtu(result, file)),
    "json": ("tables.json", lambda result, file, _: write_tables_json(result, file)),
}
_SEVERAL: Final[dict[str, Writer]] = {"dxf": _dxf, "dynamics": _dynamics, "exudyn": _exudyn}
_NEED_NODES: Final = ("dynamics", "exudyn")

FORMATS: Final[tuple[ExportFormat, ...]] = ("xlsx", "csv", "dxf", "vtk", "json", "dynamics", "exudyn")


def formats_of(result: FormResult) -> tuple[ExportFormat, ...]:
    """Return all formats to which a result can be exported: methods without nodes have no matrices."""
    return tuple(name for name in FORMATS if result.physics == "bending" or name not in _NEED_NODES)


def export(
    result: FormResult | str | os.PathLike[str],
    formats: Sequence[ExportFormat],
    out: str | os.PathLike[str],
    options: ExportOptions | None = None,
) -> tuple[Path, ...]:
    """Write a result for others, all of it or nothing.

    Parameters
    ----------
    result : FormResult or path
        What was found, or the folder in which it was written.
    formats : sequence of str
        Of `FORMATS`.
    out : path
        A folder; an earlier export in it is replaced, anything else is not touched. For one format that is a
        single file also that file, by its suffix: it is replaced.
    options : ExportOptions, optional
        What formats leave open.

    Returns
    -------
    tuple of Path
        The files.

    Raises
    ------
    InconsistentInputError
        If there is no such format, the result cannot be read, or `out` holds what catenaria did not write.
    UnsupportedError
        If a library is missing, or the result has no nodes and dynamics codes want them.
    """
    unknown = [name for name in formats if name not in FORMATS]
    if unknown or not formats:
        raise InconsistentInputError(
            f"there is no format {', '.join(map(repr, unknown)) or 'named'}; there is {', '.join(FORMATS)}"
        )
    if not isinstance(result, FormResult):
        result = load_result(result)
    options, out = options or ExportOptions(), Path(out)
    if _is_file(formats, out):
        _write_file(result, _SINGLE[formats[0]][1], out, options)
        return (out,)
    with replace_folder(out) as new:
        for name in dict.fromkeys(formats):
            if name in _SINGLE:
                file, write = _SINGLE[name]
                write(result, new / file, options)
            else:
                _SEVERAL[name](result, new, options)
    return files_of(out)


def _is_file(formats: Sequence[ExportFormat], out: Path) -> bool:
    """Return whether `out` is the name of the one file that is to be written.

    Raises
    ------
    InconsistentInputError
        If it is named like a file of something else.
    """
    suffixes = {name: Path(file).suffix for name, (file, _) in _SINGLE.items()}
    if len(set(formats)) == 1 and out.suffix.lower() == suffixes.get(formats[0]) and not out.is_dir():
        return True
    if out.suffix.lower() in (*suffixes.values(), ".dxf") and not out.is_dir():
        raise InconsistentInputError(
            f"{out} is named like one file, and {' and '.join(formats)} "
            f"{'are' if len(formats) > 1 else 'is'} written as others. Name a folder"
        )
    return False


def _write_file(result: FormResult, write: Writer, file: Path, options: ExportOptions) -> None:
    """Write a file beside its place and move it there when it is complete."""
    file.parent.mkdir(parents=True, exist_ok=True)
    new = file.with_name(f".{file.stem}.{secrets.token_hex(4)}{file.suffix}")
    try:
        write(result, new, options)
        new.replace(file)
    finally:
        new.unlink(missing_ok=True)
