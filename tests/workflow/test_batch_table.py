"""The table of a batch: whole at any time, and nobody else's file."""

from __future__ import annotations

import csv
from pathlib import Path

import pytest

from catenaria.errors import InconsistentInputError
from catenaria.workflow.batch_table import BatchSummary, Row, require_table_replaceable, write_table

ROWS = (
    Row("a, stitched", "a.yaml", "done", "", True, 0.51234567, 5, 0.4, 20, 180, 1300.0, 41.5, 1e-9, "a"),
    Row("", "b.yaml", "failed", 'it says "no"'),
)


def read(table: Path) -> list[dict[str, str]]:
    with table.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def test_rows_come_back(tmp_path: Path) -> None:
    first, second = read(write_table(ROWS, tmp_path))
    assert (first["name"], first["reused"], first["residual"]) == ("a, stitched", "yes", "0.512346")
    assert (first["dropper_force_min_N"], first["folder"]) == ("41.5", "a")
    assert (second["status"], second["why"], second["iterations"]) == ("failed", 'it says "no"', "")
    assert [path.name for path in tmp_path.iterdir()] == ["batch.csv"]


def test_while_a_table_is_written_the_old_one_is_whole(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write_table(ROWS, tmp_path)
    old = (tmp_path / "batch.csv").read_bytes()

    def interrupted(self: Path, target: Path) -> Path:
        assert (tmp_path / "batch.csv").read_bytes() == old
        raise KeyboardInterrupt

    monkeypatch.setattr(Path, "replace", interrupted)
    with pytest.raises(KeyboardInterrupt):
        write_table(ROWS[:1], tmp_path)
    assert (tmp_path / "batch.csv").read_bytes() == old
    assert [path.name for path in tmp_path.iterdir()] == ["batch.csv"]


def test_a_table_of_its_own_is_replaced(tmp_path: Path) -> None:
    write_table(ROWS, tmp_path)
    assert require_table_replaceable(tmp_path) == tmp_path
    assert require_table_replaceable(tmp_path / "new" / "deep").is_dir()


@pytest.mark.parametrize("content", [b"my,own,table\n", b"\xff\xfe", b""])
def test_a_table_of_somebody_else_is_left_alone(tmp_path: Path, content: bytes) -> None:
    (tmp_path / "batch.csv").write_bytes(content)
    with pytest.raises(InconsistentInputError):
        require_table_replaceable(tmp_path)
    assert (tmp_path / "batch.csv").read_bytes() == content


def test_a_file_is_no_folder(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(InconsistentInputError, match="cannot be used as the folder of a batch"):
        require_table_replaceable(tmp_path / "file")


def test_a_summary_counts() -> None:
    summary = BatchSummary(ROWS, 1.0, Path("batch.csv"))
    assert (summary.count("done"), summary.count("failed"), summary.count("not run")) == (1, 1, 0)
    assert (summary.reused, summary.passed) == (1, False)
    assert BatchSummary(ROWS[:1], 1.0, Path("batch.csv")).passed
