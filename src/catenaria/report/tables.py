"""The tables of a result: as data frames, and as CSV files with the unit in every column name.

Data frames hold full precision; CSV files round lengths to 0.01 mm and forces to 1 mN, errors and control
parameters finer. The files are written without pandas, whose import alone takes longer than all of them.
"""

from __future__ import annotations

import csv
import os
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from catenaria.report import attached_columns, columns
from catenaria.report.columns import Columns
from catenaria.results import FormResult

if TYPE_CHECKING:
    from pandas import DataFrame  # pyright: ignore[reportMissingTypeStubs]  # pandas-stubs are optional

TableName = Literal[
    "droppers",
    "wires",
    "supports",
    "arms",
    "ties",
    "masses",
    "cantilevers",
    "controls",
    "counters",
    "configuration",
    "history",
]

TABLES: dict[TableName, Callable[[FormResult], Columns]] = {
    "droppers": columns.dropper_columns,
    "wires": columns.wire_columns,
    "supports": columns.support_columns,
    "arms": attached_columns.arm_columns,
    "ties": attached_columns.tie_columns,
    "masses": attached_columns.mass_columns,
    "cantilevers": attached_columns.cantilever_columns,
    "controls": columns.control_columns,
    "counters": columns.counter_columns,
    "configuration": columns.configuration_columns,
    "history": columns.history_columns,
}

# The first suffix that fits decides; what fits none gets nine significant digits.
_FORMATS = {
    "error_m": "%.7f",
    "parameter_m": "%.7f",
    "_m": "%.5f",
    "_mm": "%.4f",
    "mm_per_N": "%.6f",
    "_deg": "%.4f",
    "_N": "%.3f",
    "_Nm": "%.4f",
}


def table(result: FormResult, name: TableName) -> DataFrame:
    """Return one table of a result as a data frame, in full precision.

    Parameters
    ----------
    result : FormResult
        The result.
    name : str
        One of the names in `TABLES`.

    Returns
    -------
    pandas.DataFrame
        Column names carry the unit as suffix: ``length_m``, ``tension_N``.
    """
    import pandas  # pyright: ignore[reportMissingTypeStubs]  # pandas-stubs are optional

    return pandas.DataFrame(TABLES[name](result))


def write_tables(result: FormResult, folder: str | os.PathLike[str]) -> tuple[Path, ...]:
    """Write every table of a result that has rows as a CSV file.

    Parameters
    ----------
    result : FormResult
        The result.
    folder : path
        An existing folder.

    Returns
    -------
    tuple of Path
        The files, ``droppers.csv`` first. A method without dynamic steps has no counters and no history, a
        plane line no arms, ties, masses and cantilevers.
    """
    contents = {name: build(result) for name, build in TABLES.items()}
    return tuple(
        write_csv(Path(folder) / f"{name}.csv", content)
        for name, content in contents.items()
        if len(next(iter(content.values())))
    )


def write_csv(file: Path, content: Columns) -> Path:
    """Write columns into a CSV file, each formatted by the suffix of its name."""
    texts = [_texts(name, values) for name, values in content.items()]
    with file.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(content)
        writer.writerows(zip(*texts, strict=True))
    return file


def _texts(name: str, values: Sequence[Any] | NDArray[Any]) -> list[str]:
    """Format one column; a missing value is an empty cell."""
    items: list[Any] = np.asarray(values).tolist()
    form = next((form for suffix, form in _FORMATS.items() if name.endswith(suffix)), "%.9g")
    if items and all(isinstance(item, float) for item in items):
        texts = ("\n".join([form] * len(items)) % tuple(items)).split("\n")  # at once: there are many
    else:
        texts = [form % item if isinstance(item, float) else str(item) for item in items]
    zero = form % -0.0
    special = {zero: zero[1:], "nan": ""}
    return [special.get(text, text) for text in texts]
