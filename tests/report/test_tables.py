"""Tables: columns with units, full precision in data frames, sensible digits in CSV files."""

from __future__ import annotations

import csv
import subprocess
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from catenaria.report.tables import TABLES, TableName, table, write_tables
from catenaria.results import FormResult

UNITS = ("_m", "_N", "_Nm", "_s", "_J", "_m_per_s", "_deg", "_degC", "_kg")
WITHOUT_UNIT = {
    "span", "dropper", "wire", "support", "step", "order", "tension_measure", "control", "unit", "target",
    "value", "error", "dead_band", "steps", "rejected", "newton_failures", "residuals", "jacobians",
    "factorisations", "unknowns", "upper_wire", "lower_wire", "slack", "role", "kind", "registration",
    "enough", "end", "host", "mass",
}  # fmt: skip
SPACE_ONLY = {"arms", "ties", "masses", "cantilevers"}


def read(folder: Path, name: str) -> list[dict[str, str]]:
    with (folder / f"{name}.csv").open(encoding="utf-8", newline="") as stream:
        return list(csv.DictReader(stream))


def test_every_column_states_its_unit(in_space: FormResult) -> None:
    for build in TABLES.values():
        unclear = [name for name in build(in_space) if not name.endswith(UNITS)]
        assert set(unclear) <= WITHOUT_UNIT


def test_all_columns_of_a_table_have_one_length(result: FormResult, in_space: FormResult) -> None:
    for build in TABLES.values():
        for one in (result, in_space):
            assert len({len(values) for values in build(one).values()}) == 1


def test_dropper_schedule(result: FormResult, tmp_path: Path) -> None:
    assert write_tables(result, tmp_path)[0] == tmp_path / "droppers.csv"
    rows = read(tmp_path, "droppers")
    assert len(rows) == 21
    assert list(rows[0]) == [
        "span", "dropper", "x_m", "length_m", "cut_length_m", "unstressed_length_m", "force_top_N",
        "force_bottom_N", "height_m", "target_height_m", "height_error_m", "messenger_height_m",
        "force_error_N", "chainage_m", "upper_wire", "lower_wire", "stagger_top_m", "stagger_bottom_m",
        "inclination_deg", "slack", "reference_temperature_degC",
    ]  # fmt: skip
    assert {float(row["reference_temperature_degC"]) for row in rows} == {15.0}
    assert (rows[0]["upper_wire"], rows[0]["slack"]) == ("messenger wire", "False")
    assert (rows[0]["inclination_deg"], rows[0]["chainage_m"]) == ("0.0000", rows[0]["x_m"])
    assert (rows[8]["span"], rows[8]["dropper"], rows[8]["x_m"]) == ("2", "2", "78.50000")
    for row, length, force in zip(rows, result.droppers.length, result.droppers.force_bottom, strict=True):
        assert float(row["length_m"]) == pytest.approx(length, abs=5.1e-6)
        assert float(row["force_bottom_N"]) == pytest.approx(force, abs=5.1e-4)
        assert row["height_error_m"] == "-0.0000100"


def test_wires_and_supports(result: FormResult, tmp_path: Path) -> None:
    write_tables(result, tmp_path)
    wires, supports = read(tmp_path, "wires"), read(tmp_path, "supports")
    assert [row["wire"] for row in wires] == ["contact wire", "messenger wire"]
    assert (wires[0]["tension_target_N"], wires[0]["tension_error_N"]) == ("15000.000", "-5.300")
    assert (wires[0]["travel_m"], wires[0]["sag_m"]) == ("0.09420", "0.00641")
    assert [(row["support"], row["wire"]) for row in supports[:3]] == [
        ("S1", "contact wire"),
        ("S4", "contact wire"),
        ("S1", "messenger wire"),
    ]


def test_a_line_in_space_has_tables_of_arms_ties_masses_and_cantilevers(
    in_space: FormResult, tmp_path: Path
) -> None:
    files = {file.stem for file in write_tables(in_space, tmp_path)}
    assert files == set(TABLES)
    arms, ties = read(tmp_path, "arms"), read(tmp_path, "ties")
    assert [row["enough"] for row in arms] == ["True", "False", "True", "True"]
    assert (arms[1]["support"], arms[1]["radial_N"], arms[1]["angle_deg"]) == ("S2", "-30.000", "-14.3239")
    assert (arms[0]["hinge_stagger_m"], arms[0]["hinge_y_m"]) == ("1.40000", "1.40000")
    assert [(row["end"], row["force_x_N"]) for row in ties] == [("start", "2000.000"), ("end", "-2000.000")]
    assert read(tmp_path, "masses")[0]["mass_kg"] == "12.5"
    assert read(tmp_path, "cantilevers")[0]["force_z_N"] == "-700.000"
    droppers, supports = read(tmp_path, "droppers"), read(tmp_path, "supports")
    assert [row["slack"] for row in droppers[:4]] == ["False", "False", "True", "False"]
    assert float(droppers[0]["stagger_bottom_m"]) == pytest.approx(0.2 * (1 - 8.0 / 65.0), abs=5e-6)
    assert (supports[1]["kind"], supports[1]["force_lateral_N"]) == ("arm", "218.000")


def test_history_holds_both_steps_below_each_other(result: FormResult, tmp_path: Path) -> None:
    write_tables(result, tmp_path)
    rows = read(tmp_path, "history")
    first, second = result.histories
    assert len(rows) == len(first.time) + len(second.time)
    row, k = rows[100], 100
    assert row["step"] == "contact wire"
    assert float(row["time_s"]) == pytest.approx(first.time[k], rel=1e-8)
    assert float(row["height of dropper 3 velocity_m_per_s"]) == pytest.approx(first.velocity[k, 3], rel=1e-8)
    assert float(row["height of dropper 3 error_m"]) == pytest.approx(first.error[k, 3], abs=5.1e-8)
    assert row["force of dropper 3 error_N"] == ""
    assert row["tension at S2_N"] == ""
    other = rows[len(first.time) + k]
    assert (other["step"], other["height of dropper 3 error_m"]) == ("messenger wire", "")
    assert float(other["force of dropper 3 error_N"]) == pytest.approx(second.error[k, 3], abs=5.1e-4)


def test_configuration_has_all_points_of_both_wires(result: FormResult, tmp_path: Path) -> None:
    write_tables(result, tmp_path)
    rows = read(tmp_path, "configuration")
    assert len(rows) == sum(len(wire.profile.s) for wire in result.wires)
    last = result.wires[1].profile
    assert rows[-1]["wire"] == "messenger wire"
    assert float(rows[-1]["z_m"]) == pytest.approx(last.z[-1], abs=5.1e-6)


def test_a_zero_never_has_a_sign(result: FormResult, tmp_path: Path) -> None:
    tiny = np.full_like(result.droppers.x, -1e-9)
    write_tables(replace(result, droppers=replace(result.droppers, height_error=tiny)), tmp_path)
    assert {row["height_error_m"] for row in read(tmp_path, "droppers")} == {"0.0000000"}


def test_a_method_without_dynamic_steps_has_no_history(result: FormResult, tmp_path: Path) -> None:
    files = write_tables(replace(result, histories=(), counters=(), stages=()), tmp_path)
    assert {file.stem for file in files} == set(TABLES) - {"history", "counters"} - SPACE_ONLY
    assert {file.stem for file in write_tables(result, tmp_path)} == set(TABLES) - SPACE_ONLY


def test_equal_results_give_equal_files(make_result: Callable[[int], FormResult], tmp_path: Path) -> None:
    contents: list[dict[str, bytes]] = []
    for name in ("a", "b"):
        (tmp_path / name).mkdir()
        files = write_tables(make_result(1), tmp_path / name)
        contents.append({file.name: file.read_bytes() for file in files})
    assert contents[0] == contents[1]


@pytest.mark.parametrize("name", list(TABLES))
def test_data_frames_hold_full_precision(in_space: FormResult, name: TableName) -> None:
    frame = table(in_space, name)
    for column, values in TABLES[name](in_space).items():
        np.testing.assert_array_equal(frame[column].to_numpy(), np.asarray(values))


def test_writing_does_not_need_pandas() -> None:
    code = "import catenaria.report.tables, sys; print(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    modules = set(done.stdout.split())
    assert "pandas" not in modules
    assert "csv" in modules
