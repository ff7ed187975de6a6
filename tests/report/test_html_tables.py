"""Tables of the page: the numbers of the result, and no minus before a zero."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from catenaria.line import Line
from catenaria.report.checks import Check
from catenaria.report.html import tables
from catenaria.report.html.clamps import clamp_tables
from catenaria.report.html.contact_tables import contact_tables
from catenaria.report.html.study_tables import audit_table, limit, number, value
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
    contact = clamp_tables(curve)[0]
    along = np.array([float(cell) for cell in contact.columns[2].cells])
    assert (np.diff(along) > 0.0).all()  # no place twice: arms are clamped at supports
    clamps = cells(contact, "clamp of")
    assert sum(clamp.startswith("dropper") for clamp in clamps) == curve.droppers.x.size
    assert sum(clamp.startswith("support") for clamp in clamps) == 20


def test_insulators_are_clamped_too(solved: Callable[[str], FormResult]) -> None:
    contact, messenger = clamp_tables(solved("simple_60m"))
    assert cells(contact, "clamp of").count("section insulator") == 1
    assert cells(messenger, "clamp of").count("insulator") == 1


def test_hangers_and_droppers_have_different_names(solved: Callable[[str], FormResult]) -> None:
    contact, auxiliary, messenger = clamp_tables(solved("compound"))
    names = [cells(table, "clamp of") for table in (contact, auxiliary, messenger)]
    assert all(len(set(name)) == len(name) for name in names)
    assert "hanger 7.1" in names[0]
    assert {"hanger 7.1", "dropper 7.1"} <= set(names[1])
    assert "dropper 7.1" in names[2]
    assert not any(name.startswith("hanger") for name in names[2])


def test_stitch_wires_share_a_table(solved: Callable[[str], FormResult]) -> None:
    result = solved("stitched_re250")
    titles = [table.title for table in clamp_tables(result)]
    assert titles == ["Contact wire: 163 places", "Messenger wire: 163 places", "Stitch wires: 34 places"]
    stitches = clamp_tables(result)[2]
    assert len(set(cells(stitches, "wire"))) == 17


def test_forces_are_those_along_and_across_the_track(curve: FormResult) -> None:
    table = tables.support_table(curve)
    along, left = (
        np.array([float(cell) for cell in cells(table, name)]) for name in ("force along", "to the left")
    )
    held = curve.supports
    assert np.hypot(along, left) == pytest.approx(np.hypot(held.force_x, held.force_y), abs=0.1)
    assert np.abs(held.force_x).max() > 200.0  # of the axes of the line, which the curve leaves
    assert np.abs(along).max() < 10.0  # arms and brackets hold nothing along the track
    assert left == pytest.approx(held.force_lateral, abs=0.06)


def test_contact_wire_by_span(curve: FormResult, solved: Callable[[str], FormResult]) -> None:
    for result in (curve, solved("bridge")):
        line = Line.model_validate(result.inputs)
        (table,) = contact_tables(result, line)
        profile = result.wires[0].profile
        inside = (profile.chainage >= line.support_x[3]) & (profile.chainage <= line.support_x[4])
        assert float(cells(table, "lowest")[3]) == pytest.approx(profile.height[inside].min(), abs=6e-5)
        assert max(float(cell) for cell in cells(table, "sag between droppers")) == pytest.approx(
            1e3 * result.wires[0].sag, abs=0.06
        )
    held = [i for i, wire in enumerate(result.supports.wire) if wire == "contact wire"]
    heights, x = result.supports.height[held], result.supports.chainage[held]
    by_hand = 1e3 * (heights[4] - heights[3]) / (x[4] - x[3])  # from S4 down to S5
    assert by_hand < -3.5
    assert float(cells(table, "gradient")[3]) == pytest.approx(by_hand, abs=6e-3)
    assert len(table.rows) == 14


def test_two_contact_wires_have_a_table_each(solved: Callable[[str], FormResult]) -> None:
    result = solved("two_contact_wires_3kv")
    found = contact_tables(result, Line.model_validate(result.inputs))
    assert [table.title for table in found] == ["Contact wire by span", "Second contact wire by span"]
    assert float(cells(found[0], "furthest aside")[1]) == pytest.approx(220.0, abs=1.0)
    assert float(cells(found[1], "furthest aside")[1]) == pytest.approx(-220.0, abs=1.0)


def test_wires_are_stretched_by_their_tension(paper: FormResult) -> None:
    # 15 kN / 15.6 MN of 194.81 m: 187.3 mm
    assert float(cells(tables.wire_table(paper), "elongation")[0]) == pytest.approx(187.0, abs=0.5)
    horizontal = [float(cell) for cell in cells(tables.wire_table(paper), "horizontal at start")]
    assert horizontal == pytest.approx([wire.horizontal_start for wire in paper.wires], abs=0.06)


def test_tables_of_a_line_in_space(in_space: FormResult) -> None:
    assert cells(tables.arm_table(in_space), "radial")[1] == "-30.0"
    assert cells(tables.cantilever_table(in_space), "upwards") == ("-700.0",)
    assert cells(tables.cantilever_table(in_space), "to the left") == ("30.0",)
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
    assert column("", "", ["1 N", "2 N"], flush=True).numeric
    assert number(12345.678, "N") == "12345.7 N"


def test_what_fails_does_not_read_like_its_limit() -> None:
    check = Check("", "rule", "", "", 79.996, "N", "at least", 80.0, "", "fails", "")
    assert (value(check), limit(check)) == ("79.996 N", "≥ 80 N")
    assert value(replace(check, verdict="passes")) == "80.0 N"
    assert value(replace(check, value=70.0)) == "70.0 N"
