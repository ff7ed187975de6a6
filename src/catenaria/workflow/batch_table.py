"""The summary of a batch: one row for each line, kept whole on disk."""

from __future__ import annotations

import csv
import io
import os
import secrets
from collections import Counter
from collections.abc import Iterable
from dataclasses import astuple, dataclass, fields
from pathlib import Path
from typing import Literal

from catenaria.errors import InconsistentInputError

Status = Literal["done", "failed", "bad input", "not run"]

TABLE_NAME = "batch.csv"


@dataclass(frozen=True)
class Row:
    """What became of one line.

    Attributes
    ----------
    name, file : str
        Name of the line, and of its file below what all files have in common.
    status : {"done", "failed", "bad input", "not run"}
        done: solved, audited, rebuilt if that was wanted, and on disk. not run: the batch ended before it
        heard of the line.
    why : str
        Why it is not done.
    reused : bool
        Whether it had been done by an earlier run.
    residual : float or None
        Largest deviation that the audit found, in units of what is allowed there.
    iterations : int or None
        Of Newton's method, or time steps, of all steps of the method.
    wall_time_s : float or None
        Of the run that did it, files included.
    spans, droppers : int or None
        How many there are.
    length_m : float or None
        From the first to the last support.
    dropper_force_min_N : float or None
        Smallest pull of a dropper on the wire that it holds; a dropper that goes slack has none.
    height_error_max_m : float or None
        Largest height error at a dropper.
    folder : str
        Folder of the results below that of the batch; empty if there are none.
    """

    name: str
    file: str
    status: Status
    why: str = ""
    reused: bool = False
    residual: float | None = None
    iterations: int | None = None
    wall_time_s: float | None = None
    spans: int | None = None
    droppers: int | None = None
    length_m: float | None = None
    dropper_force_min_N: float | None = None
    height_error_max_m: float | None = None
    folder: str = ""


@dataclass(frozen=True)
class BatchSummary:
    """What became of all lines of a batch.

    Attributes
    ----------
    rows : tuple of Row
        In order of the files.
    wall_time : float
        Of the whole batch [s].
    table : Path
        The file with the same rows.
    """

    rows: tuple[Row, ...]
    wall_time: float
    table: Path

    def count(self, status: Status) -> int:
        """Return how many lines have a status."""
        return Counter(row.status for row in self.rows)[status]

    @property
    def reused(self) -> int:
        """How many lines had been done by an earlier run."""
        return sum(row.reused for row in self.rows)

    @property
    def passed(self) -> bool:
        """Whether all lines are done."""
        return self.count("done") == len(self.rows)


_COLUMNS = tuple(field.name for field in fields(Row))


def write_table(rows: Iterable[Row], folder: Path) -> Path:
    """Write the table at once: whoever reads it finds all of the new rows or all of the old ones.

    Parameters
    ----------
    rows : iterable of Row
        The rows, in order.
    folder : Path
        Folder of the batch.

    Returns
    -------
    Path
        The file.
    """
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(_COLUMNS)
    writer.writerows([_cell(value) for value in astuple(row)] for row in rows)
    table, new = folder / TABLE_NAME, folder / f".{TABLE_NAME}.{secrets.token_hex(4)}.new"
    try:
        new.write_text(text.getvalue(), encoding="utf-8")
        new.replace(table)
    finally:
        new.unlink(missing_ok=True)
    return table


def require_table_replaceable(folder: str | os.PathLike[str]) -> Path:
    """Refuse a folder that is none, or whose table was written by somebody else.

    Returns
    -------
    Path
        The folder, absolute; it is made.

    Raises
    ------
    InconsistentInputError
        If the table cannot be written there.
    """
    target = Path(folder).resolve()
    try:
        target.mkdir(parents=True, exist_ok=True)
        with (target / TABLE_NAME).open(encoding="utf-8") as file:
            first = file.readline()
    except FileNotFoundError:
        first = ",".join(_COLUMNS)
    except (OSError, UnicodeDecodeError) as error:
        raise InconsistentInputError(f"{folder} cannot be used as the folder of a batch: {error}") from error
    if not first.startswith(",".join(_COLUMNS[:3])):
        raise InconsistentInputError(f"{target / TABLE_NAME} is no table of a batch. Move it away")
    if not os.access(target, os.W_OK | os.X_OK):
        raise InconsistentInputError(f"{folder} cannot be written")
    return target


def _cell(value: object) -> str:
    match value:
        case None:
            return ""
        case bool():
            return "yes" if value else "no"
        case float():
            return f"{value:.6g}"
        case _:
            return str(value)
