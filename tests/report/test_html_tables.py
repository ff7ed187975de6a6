"""Tables of the page: the numbers of the result, and no minus before a zero."""

from __future__ import annotations

import numpy as np
import pytest

from catenaria.report.html import tables
from catenaria.report.html.study_tables import audit_table, number
from catenaria.report.html.table import Column, Table, column
from catenaria.results import FormResult


def cells(table: Table, name: str) -> tuple[str, ...]:
    found: list[Column] = [one for one in table.columns if one.name == name]
    assert len(found) == 1
    return found[0].cells


def test_a_table_for_each_span(curve: FormResult) -> None:
    schedule = tables.dropper_tables(curve)
    assert len(schedule) == 19
    assert not any(table.open for table in schedule)
    cut = [cell for table in schedule for cell in cells(table, "cut to")]
    assert cut == [f"{length:.4f}" for length in curve.droppers.cut_length]


def test_few_spans_are_unfolded(paper: FormResult) -> None:
    assert all(table.open for table in tables.dropper_tables(paper))


def test_wires_are_named_where_there_are_several(in_space: FormResult) -> None:
    assert "holds" not in [one.name for one in tables.dropper_tables(in_space)[0].columns]


def test_clamps_ascend_along_the_wire(curve: FormResult) -> None:
    contact = tables.clamp_tables(curve)[0]
    along = np.array([float(cell) for cell in contact.columns[2].cells])
    assert (np.diff(along) >= 0.0).all()
    droppers = sum(cell.startswith("dropper") for cell in cells(contact, "clamp of"))
    assert droppers == curve.droppers.x.size


def test_tables_of_a_line_in_space(in_space: FormResult) -> None:
    assert cells(tables.arm_table(in_space), "radial")[1] == "-30.0"
    assert cells(tables.cantilever_table(in_space), "force z") == ("-700.0",)
    assert cells(tables.support_table(in_space), "stagger")[:2] == ("200", "-200")


def test_the_audit_is_whole(paper: FormResult) -> None:
    assert len(audit_table(paper).rows) == len(paper.audit.name) > 20


@pytest.mark.parametrize(
    ("value", "text"), [(-1e-9, "0.0"), (-0.06, "-0.1"), (float("nan"), ""), (12.34, "12.3")]
)
def test_cells(value: float, text: str) -> None:
    assert column("", "", [value], ".1f").cells == (text,)


def test_texts_are_not_numbers() -> None:
    assert not column("", "", ["1", "2"]).numeric
    assert column("", "", [1, 2]).numeric
    assert not column("", "", [True]).numeric
    assert number(12345.678, "N") == "12346 N"
