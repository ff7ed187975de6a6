"""The dropper schedule as a workbook to be printed on A4: a sheet for each span, and the other tables."""

from __future__ import annotations

import datetime
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np

from catenaria import __version__
from catenaria.export.clamps import clamp_columns
from catenaria.export.libraries import library
from catenaria.export.schedule import reference_temperature, schedule_columns
from catenaria.line import Line
from catenaria.report.attached_columns import arm_columns
from catenaria.report.columns import Columns, support_columns, wire_columns
from catenaria.report.names import dropper_names
from catenaria.results import FormResult

_UNITS: Final = {
    "_mm": ("mm", "0.0"),
    "_m": ("m", "0.0000"),
    "_N": ("N", "0.0"),
    "_deg": ("°", "0.00"),
}
_ROUNDED: Final = "cut_length_rounded_m"
_NOTHING: Final = 1e-9  # what is nearer to zero is zero: shown with few digits it would be -0.0
_NO_DATE: Final = datetime.datetime(1980, 1, 1)  # equal results give equal files
_A4: Final = 9  # paper size in Excel's numbering
_WIDEST: Final = 26  # characters
_FIRST: Final = 3  # row of the headings, counted from 0: above are a title and a line about it


def heading(column: str) -> str:
    """Return a column's name as a heading with its unit.

    Examples
    --------
    >>> heading("cut_length_m"), heading("upper_wire")
    ('cut length [m]', 'upper wire')
    """
    for suffix, (unit, _) in _UNITS.items():
        if column.endswith(suffix):
            return f"{column.removesuffix(suffix).replace('_', ' ')} [{unit}]"
    return column.replace("_", " ")


def write_xlsx(result: FormResult, file: Path, step: float) -> None:
    """Write a workbook: summary, a sheet for each span with droppers, wires, supports, arms, clamps.

    Parameters
    ----------
    result : FormResult
        What was found.
    file : path
        With suffix ``.xlsx``.
    step : float
        Cut lengths are also given rounded to whole steps [m].

    Raises
    ------
    UnsupportedError
        If XlsxWriter is not installed.
    InconsistentInputError
        If nothing is left of a dropper that is rounded.
    """
    xlsxwriter = library("xlsxwriter", "XlsxWriter", "XLSX")
    schedule = {"name": dropper_names(result), **schedule_columns(result, step)}
    schedule.pop("reference_temperature_degC")  # is said once for all
    with xlsxwriter.Workbook(str(file), {"strings_to_formulas": False, "strings_to_urls": False}) as workbook:
        workbook.set_properties(
            {"title": f"Dropper schedule: {result.name}", "created": _NO_DATE, "comments": _origin(result)}
        )
        book = _Book(workbook, result.name, _formats(workbook, step))
        _summary(book, result, schedule, step)
        warmth = f"{reference_temperature(result):g} °C"
        for number, name in _spans(result):
            own = np.asarray(schedule["span"]) == number
            rows: Columns = {column: np.asarray(values)[own] for column, values in schedule.items()}
            text = f"{own.sum()} droppers. Cut lengths are rounded to {1e3 * step:g} mm and hold at {warmth}."
            book.sheet(f"Span {number}", f"Span {number}: {name}", text, rows, totals=True)
        for title, build, text in _TABLES:
            columns = build(result)
            if len(next(iter(columns.values()))):
                book.sheet(title, title, text.format(warmth), columns)


_TABLES: Final[tuple[tuple[str, Callable[[FormResult], Columns], str], ...]] = (
    ("Wires", wire_columns, "Unstressed lengths are those between the first and the last support, at {}."),
    ("Supports", support_columns, "Forces are those of the wires on their supports; z is upwards."),
    ("Arms", arm_columns, "Radial forces are positive where the wire pulls at the arm."),
    ("Clamps", clamp_columns, "Distances along the unstressed wires, as they lie on the ground at {}."),
)


def _origin(result: FormResult) -> str:
    return f"catenaria {__version__}, method {result.method}"


def _formats(workbook: Any, step: float) -> Callable[[str], Any]:
    """Return a function from the name of a format to the format."""
    digits = next(n for n in range(7) if n == 6 or abs(round(step, n) - step) < 1e-9)
    rounded = "0." + "0" * max(digits, 3)
    sums = {_ROUNDED: rounded, "cut_length_m": _UNITS["_m"][1]}
    base: dict[str, dict[str, Any]] = {
        "title": {"bold": True, "font_size": 14},
        "text": {"italic": True, "font_color": "#555555"},
        "heading": {"bold": True, "text_wrap": True, "valign": "top", "bottom": 1, "bg_color": "#E8EEF4"},
        "total": {"bold": True, "top": 1},
        **{f"total {name}": {"bold": True, "top": 1, "num_format": form} for name, form in sums.items()},
        "": {},
        **{suffix: {"num_format": form} for suffix, (_, form) in _UNITS.items()},
        _ROUNDED: {"num_format": rounded, "bold": True, "bg_color": "#FFF6D6"},
    }
    made = {name: workbook.add_format(properties) for name, properties in base.items()}
    return made.__getitem__


def _form(column: str) -> str:
    if column == _ROUNDED:
        return column
    return next((suffix for suffix in _UNITS if column.endswith(suffix)), "")


@dataclass(frozen=True)
class _Book:
    """A workbook with the formats of its cells."""

    workbook: Any
    line: str
    form: Callable[[str], Any]

    def sheet(self, name: str, title: str, text: str, columns: Columns, *, totals: bool = False) -> None:
        """Add a sheet with one table."""
        sheet = self.page(name, title, text)
        self.table(sheet, _FIRST, columns)
        rows = len(next(iter(columns.values())))
        sheet.freeze_panes(_FIRST + 1, 2)
        sheet.repeat_rows(_FIRST)
        sheet.autofilter(_FIRST, 0, _FIRST + rows, len(columns) - 1)
        if totals:
            self._totals(sheet, _FIRST + 1 + rows, columns)

    def page(self, name: str, title: str, text: str) -> Any:
        """Add an empty sheet, to be printed on A4 across."""
        sheet = self.workbook.add_worksheet(name)
        sheet.write_string(0, 0, title, self.form("title"))
        sheet.write_string(1, 0, text, self.form("text"))
        sheet.set_landscape()
        sheet.set_paper(_A4)
        sheet.set_margins(left=0.5, right=0.5, top=0.75, bottom=0.75)
        sheet.fit_to_pages(1, 0)
        sheet.hide_gridlines(2)
        line = self.line.replace("&", "&&")
        sheet.set_header(f"&L{line}&R&A")
        sheet.set_footer("&Ccatenaria&RPage &P of &N")
        return sheet

    def table(self, sheet: Any, row: int, columns: Columns) -> None:
        """Write headings and rows; widths follow what is written."""
        for j, (column, values) in enumerate(columns.items()):
            sheet.write_string(row, j, heading(column), self.form("heading"))
            items: list[Any] = np.asarray(values).tolist()
            for i, value in enumerate(items):
                _write(sheet, row + 1 + i, j, value, self.form(_form(column)))
            longest = max((len(item) for item in items if isinstance(item, str)), default=0)
            words = max(len(word) for word in heading(column).split())
            sheet.set_column(j, j, min(max(longest, words, 8) + 2, _WIDEST))

    def _totals(self, sheet: Any, row: int, columns: Columns) -> None:
        """Write sums as formulas, so that they follow a length that somebody changes."""
        for j, (column, values) in enumerate(columns.items()):
            sheet.write_blank(row, j, None, self.form("total"))
            if column in (_ROUNDED, "cut_length_m"):
                letter = chr(ord("A") + j)
                formula = f"=SUM({letter}{_FIRST + 2}:{letter}{row})"
                total = float(np.sum(np.asarray(values)))
                sheet.write_formula(row, j, formula, self.form(f"total {column}"), total)
        sheet.write_string(row, 0, "sum", self.form("total"))


def _write(sheet: Any, row: int, column: int, value: Any, form: Any) -> None:
    """Write one cell; text stays text, and a missing value leaves the cell empty."""
    if isinstance(value, bool):
        sheet.write_string(row, column, "yes" if value else "no", form)
    elif isinstance(value, str):
        sheet.write_string(row, column, value, form)
    elif np.isfinite(value):
        sheet.write_number(row, column, value if abs(value) > _NOTHING else 0, form)


def _spans(result: FormResult) -> Iterator[tuple[int, str]]:
    """Yield number and name of every span with droppers."""
    names = _support_names(result)
    for number in np.unique(result.droppers.span).tolist():
        yield number, f"{names[number - 1]} to {names[number]}"


def _support_names(result: FormResult) -> Sequence[str]:
    line = Line.model_validate(result.inputs)
    return [support.name for support in line.supports]


def _summary(book: _Book, result: FormResult, schedule: Columns, step: float) -> None:
    """Add the sheet that says what this is, with a row for each span."""
    sheet = book.page("Summary", f"Dropper schedule: {result.name}", _origin(result))
    rows = {name: np.asarray(values) for name, values in schedule.items()}
    facts: Mapping[str, str] = {
        "droppers": str(rows["span"].size),
        "sum of rounded cut lengths": f"{rows[_ROUNDED].sum():.3f} m",
        "rounding step": f"{1e3 * step:g} mm",
        "cut length": "unstressed length less what the clamps bridge; halves are rounded upwards",
        "lengths hold at": f"{reference_temperature(result):g} °C",
        "audit": _verdict(bool(result.audit.name), result.audit.passed),
        "rebuilt from the lengths": _verdict(bool(result.rebuilt.way), result.rebuilt.passed),
        "stopped because": result.stop_reason,
    }
    for i, (name, value) in enumerate(facts.items(), start=_FIRST):
        sheet.write_string(i, 0, name)
        sheet.write_string(i, 3, value)
    headings = _FIRST + len(facts) + 1
    book.table(sheet, headings, _span_columns(result, rows))
    sheet.repeat_rows(headings)


def _verdict(there: bool, passed: bool) -> str:
    return ("passed" if passed else "FAILED") if there else "not done"


def _span_columns(result: FormResult, rows: Mapping[str, Any]) -> Columns:
    """Return a row for each span with droppers."""
    line = Line.model_validate(result.inputs)
    spans = list(_spans(result))
    groups = [rows["span"] == number for number, _ in spans]
    return {
        "span": [number for number, _ in spans],
        "supports": [name for _, name in spans],
        "span_length_m": [line.spans[number - 1].length for number, _ in spans],
        "droppers": [int(own.sum()) for own in groups],
        "sum_of_rounded_cut_lengths_m": [float(rows[_ROUNDED][own].sum()) for own in groups],
        "shortest_rounded_m": [float(rows[_ROUNDED][own].min()) for own in groups],
        "longest_rounded_m": [float(rows[_ROUNDED][own].max()) for own in groups],
        "least_force_N": [float(rows["force_bottom_N"][own].min()) for own in groups],
        "largest_force_N": [float(rows["force_bottom_N"][own].max()) for own in groups],
    }
