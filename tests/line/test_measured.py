"""Files of measured heights: what is read, and what is said of what cannot be."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from catenaria.errors import LineFileError
from catenaria.line.measured import load_measured


def write(folder: Path, text: str) -> Path:
    file = folder / "heights.csv"
    file.write_text(text, encoding="utf-8")
    return file


def test_droppers_and_chainages_are_read(tmp_path: Path) -> None:
    text = "span,dropper,chainage_m,height_m,lower_wire\n1,2,,5.503,\n,,17.5,5.498,second contact wire\n"
    first, second = load_measured(write(tmp_path, text)).rows
    assert (first.span, first.number, first.height, first.wire) == (1, 2, 5.503, "")
    assert first.at_dropper
    assert math.isnan(first.chainage)
    assert (second.span, second.chainage, second.wire) == (0, 17.5, "second contact wire")
    assert not second.at_dropper


def test_rows_without_height_and_other_columns_are_passed_over(tmp_path: Path) -> None:
    text = "span,dropper,length_m,height_m\n1,1,0.9,5.5\n1,2,0.8,\n\n2.0,1,0.7, 5.499 \n"
    rows = load_measured(write(tmp_path, text)).rows
    assert [(row.span, row.number, row.height) for row in rows] == [(1, 1, 5.5), (2, 1, 5.499)]


def test_a_file_with_byte_order_mark_is_read(tmp_path: Path) -> None:
    file = tmp_path / "heights.csv"
    file.write_bytes(b"\xef\xbb\xbfspan,dropper,height_m\r\n1,1,5.5\r\n")
    assert load_measured(file).rows[0].height == 5.5


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("span,dropper,height_m\n1,1,5.5\n1,2,5.5x\n", ':3:5: height_m: found "5.5x"; allowed: metres'),
        ("span,dropper,height_m\n1,1,5.5\n1,2,nan\n", ':3:5: height_m: found "nan"'),
        ("span,dropper,height_m\n1,1,5.5\n0,2,5.5\n", ':3:1: span: found "0"; allowed: a whole number'),
        ("span,dropper,height_m\n1,,5.5\n", ":2:3: dropper: found nothing"),
        (
            "span,dropper,height_m\n,,5.5\n",
            ":2:1: span: found nothing; allowed: span and dropper, or chainage",
        ),
        ("chainage_m,height_m\nx,5.5\n", ':2:1: chainage_m: found "x"'),
        ("span,dropper,heigth_m\n1,1,5.5\n", "also the column height_m (did you mean height_m?)"),
        ("height_m\n5.5\n", "also the column span and dropper, or chainage_m"),
        ("span;dropper;height_m\n1;1;5\n", "also the column height_m"),
        ("span;dropper;height_m\n1;1;5,5\n", "allowed: a CSV file with commas"),
        ("span,dropper,height_m\n1,1,\n", "height_m: found no height at all"),
        ("span,dropper,height_m\n1,1,5.5,7,8\n", "line 2"),
        ("", "the file: found"),
    ],
)
def test_what_is_wrong_is_said_with_row_and_column(text: str, expected: str, tmp_path: Path) -> None:
    with pytest.raises(LineFileError) as caught:
        load_measured(write(tmp_path, text))
    assert expected in str(caught.value)
    assert "heights.csv" in str(caught.value)


def test_every_fault_is_listed(tmp_path: Path) -> None:
    with pytest.raises(LineFileError) as caught:
        load_measured(write(tmp_path, "span,dropper,height_m\n1,x,5.5\n1,2,y\n"))
    assert [(fault.line, fault.field) for fault in caught.value.faults] == [(2, "dropper"), (3, "height_m")]


def test_a_missing_file_is_one_fault(tmp_path: Path) -> None:
    with pytest.raises(LineFileError, match=r"no\.csv: the file: found no such file"):
        load_measured(tmp_path / "no.csv")


def test_what_is_no_text_is_one_fault(tmp_path: Path) -> None:
    file = tmp_path / "heights.csv"
    file.write_bytes(b"span,dropper,height_m\n\xff\xfe\x00")
    with pytest.raises(LineFileError, match=r"heights\.csv: the file: found"):
        load_measured(file)
