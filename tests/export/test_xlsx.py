"""The workbook, read back with another library."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import openpyxl
import pytest

from catenaria.errors import UnsupportedError
from catenaria.export import libraries, xlsx
from catenaria.report.names import dropper_names
from catenaria.results import FormResult

HEADINGS = 4  # the row that has them


def written(result: FormResult, file: Path, step: float = 1e-3, *, formulas: bool = False) -> Any:
    xlsx.write_xlsx(result, file, step)
    return openpyxl.load_workbook(file, data_only=not formulas)


def table(sheet: Any) -> dict[str, list[Any]]:
    """Return the columns of a sheet by their headings, without the row of sums."""
    rows = list(sheet.iter_rows(min_row=HEADINGS, values_only=True))
    body = [row for row in rows[1:] if row[0] != "sum"]
    return {str(name): [row[j] for row in body] for j, name in enumerate(rows[0])}


def facts(sheet: Any) -> dict[str, str]:
    """Return what the summary says of the line, by label."""
    rows = sheet.iter_rows(min_row=HEADINGS, max_row=HEADINGS + 7, values_only=True)
    return {row[0]: row[3] for row in rows}


def test_every_dropper_is_on_the_sheet_of_its_span(every: FormResult, tmp_path: Path) -> None:
    book = written(every, tmp_path / "schedule.xlsx")
    droppers = every.droppers
    found: list[float] = []
    for number in np.unique(droppers.span):
        columns = table(book[f"Span {number}"])
        assert columns["span"] == [number] * len(columns["span"])
        found += columns["cut length [m]"]
        forces = droppers.force_bottom[droppers.span == number]
        np.testing.assert_allclose(columns["force bottom [N]"], forces, rtol=1e-12)
    np.testing.assert_allclose(found, droppers.cut_length, rtol=1e-12)
    names = set(book.sheetnames)
    assert {"Summary", "Wires", "Supports", "Clamps"} <= names
    assert ("Arms" in names) == bool(every.arms.support)


def test_rounded_lengths_and_their_sum(space: FormResult, tmp_path: Path) -> None:
    sheet = written(space, tmp_path / "schedule.xlsx", 5e-3)["Span 2"]
    columns = table(sheet)
    rounded = np.array(columns["cut length rounded [m]"])
    np.testing.assert_allclose(rounded / 5e-3, np.round(rounded / 5e-3), rtol=0.0, atol=1e-9)
    at = list(columns).index("cut length rounded [m]") + 1
    last = HEADINGS + rounded.size + 1
    assert sheet.cell(last, 1).value == "sum"
    assert sheet.cell(last, at).value == pytest.approx(rounded.sum())
    assert sheet.cell(last - 1, at).number_format == "0.000"


def test_sums_follow_a_length_that_somebody_changes(space: FormResult, tmp_path: Path) -> None:
    sheet = written(space, tmp_path / "schedule.xlsx", formulas=True)["Span 2"]
    rows = HEADINGS + int((space.droppers.span == 2).sum())
    for name in ("cut length rounded [m]", "cut length [m]"):
        cell = next(cell for cell in sheet[HEADINGS] if cell.value == name)
        assert sheet.cell(rows + 1, cell.column).value == (
            f"=SUM({cell.column_letter}{HEADINGS + 1}:{cell.column_letter}{rows})"
        )


def test_the_temperature_of_the_lengths_is_stated(space: FormResult, tmp_path: Path) -> None:
    colder = replace(space, inputs={**space.inputs, "reference_temperature": -7.5})
    for result, temperature in ((space, "15 °C"), (colder, "-7.5 °C")):
        book = written(result, tmp_path / "schedule.xlsx")
        assert facts(book["Summary"])["lengths hold at"] == temperature
        for name in ("Span 1", "Wires", "Clamps"):
            assert f" at {temperature}." in book[name].cell(2, 1).value


def test_droppers_have_the_names_of_the_report(compound: FormResult, tmp_path: Path) -> None:
    book = written(compound, tmp_path / "schedule.xlsx")
    found = [name for number in range(1, 17) for name in table(book[f"Span {number}"])["name"]]
    assert found == dropper_names(compound)
    assert len(set(found)) == len(found)
    marks = set(table(book["Clamps"])["mark"])
    assert set(found) <= marks


def minus_nothing(book: Any) -> list[float]:
    """Return the numbers that are shown as -0.0."""
    numbers = [cell.value for sheet in book for row in sheet.iter_rows() for cell in row]
    return [value for value in numbers if isinstance(value, float) and -1e-9 < value < 0.0]


def test_nothing_is_not_negative(space: FormResult, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert minus_nothing(written(space, tmp_path / "schedule.xlsx")) == []
    monkeypatch.setattr(xlsx, "_NOTHING", -1.0)
    assert minus_nothing(written(space, tmp_path / "schedule.xlsx")) != []


def test_no_fact_of_the_summary_is_cut_off(every: FormResult, tmp_path: Path) -> None:
    sheet = written(every, tmp_path / "schedule.xlsx")["Summary"]
    width = sum(sheet.column_dimensions["A"].width for _ in range(3))
    assert max(len(name) for name in facts(sheet)) < width
    assert sheet.print_title_rows is not None


def test_it_prints_on_a4(space: FormResult, tmp_path: Path) -> None:
    for sheet in written(space, tmp_path / "schedule.xlsx"):
        assert sheet.page_setup.paperSize == 9
        assert sheet.page_setup.orientation == "landscape"
        assert sheet.sheet_properties.pageSetUpPr.fitToPage
        assert (sheet.page_setup.fitToWidth or 1, sheet.page_setup.fitToHeight) == (1, 0)
        assert sheet.oddFooter.right.text == "Page &P of &N"
        if sheet.title != "Summary":
            assert sheet.print_title_rows == f"${HEADINGS}:${HEADINGS}"
            assert sheet.freeze_panes == f"C{HEADINGS + 1}"


def test_names_are_text_and_never_formulas(plane: FormResult, tmp_path: Path) -> None:
    evil = '=HYPERLINK("http://example.org")'
    supports = replace(plane.supports, support=(evil,) * len(plane.supports.support))
    book = written(replace(plane, name=evil, supports=supports), tmp_path / "schedule.xlsx")
    cell = book["Supports"].cell(HEADINGS + 1, 1)
    assert (cell.value, cell.data_type) == (evil, "s")
    assert evil in book["Summary"].cell(1, 1).value


def test_equal_results_give_equal_files(plane: FormResult, tmp_path: Path) -> None:
    for name in ("one", "other"):
        xlsx.write_xlsx(plane, tmp_path / name, 1e-3)
    assert (tmp_path / "one").read_bytes() == (tmp_path / "other").read_bytes()


def test_what_was_not_done_is_not_said_to_have_passed(plane: FormResult, tmp_path: Path) -> None:
    sheet = written(plane, tmp_path / "schedule.xlsx")["Summary"]
    told = facts(sheet)
    assert told["audit"] == "passed"
    assert told["rebuilt from the lengths"] == "not done"
    assert told["droppers"] == "21"


def test_a_missing_library_is_named_with_its_extra(
    plane: FormResult, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def absent(name: str) -> Any:
        raise ModuleNotFoundError(name)

    monkeypatch.setattr(libraries, "import_module", absent)
    with pytest.raises(UnsupportedError, match=r"XLSX needs XlsxWriter.*catenaria\[export\]"):
        xlsx.write_xlsx(plane, tmp_path / "schedule.xlsx", 1e-3)
