"""Tables of the studio: those of the report, checks and the audit, as rows of texts."""

from __future__ import annotations

from dataclasses import dataclass

from catenaria.report.checks import Check
from catenaria.report.html.study_tables import limit, value
from catenaria.report.html.table import Table
from catenaria.report.html.tables import arm_table, dropper_tables, support_table, wire_table
from catenaria.results import FormResult
from catenaria.studio.compare import differences

Row = dict[str, str]


@dataclass(frozen=True)
class Shown:
    """A table as the browser's element takes it: columns with name, label and alignment, rows of texts."""

    title: str
    columns: list[Row]
    rows: list[Row]

    def __len__(self) -> int:
        return len(self.rows)


def schedule(result: FormResult, variant: FormResult | None) -> Shown:
    """Return the dropper schedule, all spans below each other, with differences from a variant."""
    tables = dropper_tables(result)
    if not tables:
        return Shown("", [], [])
    shown = _shown("", tables[0])
    rows = [
        {"span": str(number), **row}
        for table, number in zip(tables, sorted(set(result.droppers.span.tolist())), strict=True)
        for row in _shown("", table).rows
    ]
    columns = [_column("span", "span", True), *shown.columns]
    if variant is not None:
        found = differences(result, variant)
        longer = dict(zip(found.dropper, found.cut_length.tolist(), strict=True))
        for row in rows:
            by = longer.get(f"{row['span']}.{row['dropper']}")
            row["longer"] = "new" if by is None else f"{by:+.2f}"
        columns.append(_column("longer", "longer than pinned [mm]", True))
    return Shown("", columns, rows)


def wires(result: FormResult) -> Shown:
    """Return lengths and tensions of all wires."""
    return _shown("Wires", wire_table(result))


def supports(result: FormResult) -> Shown:
    """Return forces at supports."""
    return _shown("Supports", support_table(result))


def arms(result: FormResult) -> Shown:
    """Return forces and hinges of steady arms."""
    return _shown("Steady arms", arm_table(result))


def checks(found: tuple[Check, ...]) -> Shown:
    """Return the checks with value, limit and verdict."""
    rows = [
        {
            "verdict": check.verdict if check.rule else "stated",
            "check": check.name,
            "value": value(check),
            "limit": limit(check),
            "where": check.place,
            "rule": check.source,
            "note": check.why,
        }
        for check in found
    ]
    names = ("verdict", "check", "value", "limit", "where", "rule", "note")
    columns = [_column(name, name, name in ("value", "limit")) for name in names]
    return Shown("Rules of standards and practice", columns, rows)


def _shown(title: str, table: Table) -> Shown:
    columns = [
        _column(one.name, f"{one.name} [{one.unit}]" if one.unit else one.name, one.numeric)
        for one in table.columns
    ]
    names = [one.name for one in table.columns]
    return Shown(title, columns, [dict(zip(names, row, strict=True)) for row in table.rows])


def _column(name: str, label: str, numeric: bool) -> Row:
    return {"name": name, "label": label, "align": "right" if numeric else "left"}
