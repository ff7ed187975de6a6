"""Folders that are whole, and what killed runs leave beside them."""

from __future__ import annotations

from pathlib import Path

import pytest

from catenaria.results import clear_interrupted, has_manifest, is_intact, replace_folder


@pytest.fixture
def run(tmp_path: Path) -> Path:
    with replace_folder(tmp_path / "run") as new:
        (new / "droppers.csv").write_text("whole", encoding="utf-8")
        (new / "wires.csv").write_text("whole", encoding="utf-8")
    return tmp_path / "run"


def names(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.iterdir())


def test_a_folder_is_intact_with_files_of_others_in_it(run: Path) -> None:
    (run / "notes.txt").write_text("mine", encoding="utf-8")
    assert has_manifest(run)
    assert is_intact(run)


def test_a_folder_that_is_damaged_is_not_intact(run: Path) -> None:
    (run / "droppers.csv").write_text("who", encoding="utf-8")
    assert has_manifest(run)
    assert not is_intact(run)


def test_a_folder_that_lacks_a_file_is_not_intact(run: Path) -> None:
    (run / "wires.csv").unlink()
    assert not is_intact(run)


def test_other_folders_are_not_intact(tmp_path: Path) -> None:
    assert not has_manifest(tmp_path)
    assert not is_intact(tmp_path)
    assert not is_intact(tmp_path / "missing")


def test_half_written_folders_are_removed(run: Path) -> None:
    half = run.with_name(".run.0123abcd.new")
    half.mkdir()
    (half / "droppers.csv").write_text("ha", encoding="utf-8")
    clear_interrupted(run.parent)
    assert names(run.parent) == ["run"]
    assert is_intact(run)


def test_an_earlier_folder_that_was_replaced_is_removed(run: Path) -> None:
    run.with_name(".run.0123abcd.old").mkdir()
    clear_interrupted(run.parent)
    assert names(run.parent) == ["run"]
    assert is_intact(run)


def test_between_two_renamings_the_earlier_folder_is_put_back(run: Path) -> None:
    run.rename(run.with_name(".run.0123abcd.old"))
    run.with_name(".run.0123abcd.new").mkdir()
    clear_interrupted(run.parent)
    assert names(run.parent) == ["run"]
    assert is_intact(run)


def test_hidden_folders_of_others_stay(tmp_path: Path) -> None:
    for name in (".git", ".run.new", ".run.0123abcd.newer"):
        (tmp_path / name).mkdir()
    clear_interrupted(tmp_path)
    clear_interrupted(tmp_path / "missing")
    assert names(tmp_path) == [".git", ".run.0123abcd.newer", ".run.new"]
