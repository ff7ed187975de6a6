"""The tables of a result as JSON in SI units, for programs in any language."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any, Final

import numpy as np

from catenaria.report.columns import Columns
from catenaria.report.tables import TABLES, TableName
from catenaria.results import FormResult

FORMAT: Final = "catenaria result tables"
VERSION: Final = 1
EXPORTED: Final[tuple[TableName, ...]] = (
    "droppers",
    "wires",
    "supports",
    "arms",
    "ties",
    "masses",
    "cantilevers",
    "controls",
    "configuration",
)


def tables_document(result: FormResult) -> dict[str, Any]:
    """Return what ``tables.json`` holds; see `catenaria.export.tables_schema`.

    Parameters
    ----------
    result : FormResult
        What was found.
    """
    audit, rebuilt = result.audit, result.rebuilt
    return {
        "format": FORMAT,
        "version": VERSION,
        "line": result.name,
        "method": result.method,
        "stop_reason": result.stop_reason,
        "versions": dict(result.versions),
        "audit": {
            "done": bool(audit.name),
            "passed": bool(audit.name) and audit.passed,
            "findings": list(audit.findings),
        },
        "rebuilt": {
            "done": bool(rebuilt.way),
            "passed": bool(rebuilt.way) and rebuilt.passed,
            "findings": list(rebuilt.findings()) if rebuilt.way else [],
        },
        "tables": {name: _listed(TABLES[name](result)) for name in EXPORTED},
    }


def write_tables_json(result: FormResult, file: Path) -> None:
    """Write the tables of a result, column by column; a value that is not there is null."""
    text = json.dumps(tables_document(result), ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    file.write_text(text + "\n", encoding="utf-8")


def _listed(columns: Columns) -> dict[str, list[Any]]:
    return {name: [_plain(item) for item in np.asarray(values).tolist()] for name, values in columns.items()}


def _plain(item: Any) -> Any:
    return None if isinstance(item, float) and not math.isfinite(item) else item
