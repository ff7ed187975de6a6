"""An output folder is replaced whole or not at all, and never with files of somebody else in it."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from catenaria.errors import InconsistentInputError
from catenaria.results import replace_folder, require_replaceable
from catenaria.results.case import LoadStudy


def write(folder: Path, text: str) -> None:
    with replace_folder(folder) as new:
        (new / "droppers.csv").write_text(text, encoding="utf-8")
        (new / "figures").mkdir()
        (new / "figures" / "tensions.png").write_bytes(text.encode())


def contents(folder: Path) -> dict[str, str]:
    files = (path for path in folder.rglob("*") if path.is_file())
    return {p.relative_to(folder).as_posix(): p.read_text() for p in files if p.name != "manifest.json"}


OLD = {"droppers.csv": "old", "figures/tensions.png": "old"}
NEW = {"droppers.csv": "new", "figures/tensions.png": "new"}


@pytest.fixture
def run(tmp_path: Path) -> Path:
    write(tmp_path / "results" / "run", "old")
    return tmp_path / "results" / "run"


def test_a_new_folder_is_written_with_its_parents(run: Path) -> None:
    assert contents(run) == OLD
    assert [path.name for path in run.parent.iterdir()] == ["run"]
    manifest = json.loads((run / "manifest.json").read_text(encoding="utf-8"))
    assert list(manifest["files"]) == ["droppers.csv", "figures/tensions.png"]


def test_an_earlier_folder_is_replaced_whole(run: Path) -> None:
    with replace_folder(run) as new:
        (new / "wires.csv").write_text("new", encoding="utf-8")
        assert contents(run) == OLD
    assert contents(run) == {"wires.csv": "new"}
    assert [path.name for path in run.parent.iterdir()] == ["run"]


def test_an_empty_folder_is_replaced(tmp_path: Path) -> None:
    (tmp_path / "empty").mkdir()
    write(tmp_path / "empty", "new")
    assert contents(tmp_path / "empty") == NEW


def test_a_link_to_an_earlier_folder_stays_a_link(run: Path, tmp_path: Path) -> None:
    link = tmp_path / "link"
    link.symlink_to(run)
    write(link, "new")
    assert link.is_symlink()
    assert contents(run) == NEW


@pytest.mark.parametrize("failure", [RuntimeError, KeyboardInterrupt, SystemExit])
def test_a_crash_while_writing_leaves_the_old_folder(run: Path, failure: type[BaseException]) -> None:
    def crash(new: Path) -> None:
        (new / "droppers.csv").write_text("half", encoding="utf-8")
        raise failure

    with pytest.raises(failure), replace_folder(run) as new:
        crash(new)
    assert contents(run) == OLD
    assert [path.name for path in run.parent.iterdir()] == ["run"]


def test_a_crash_while_writing_leaves_no_folder_where_none_was(tmp_path: Path) -> None:
    with pytest.raises(RuntimeError), replace_folder(tmp_path / "run"):
        raise RuntimeError
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("failing", [1, 2])
def test_an_interruption_of_the_exchange_leaves_the_old_folder(
    run: Path, failing: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    calls: list[Path] = []
    rename = Path.rename

    def interrupted(self: Path, target: Path) -> Path:
        calls.append(self)
        if len(calls) == failing:
            raise KeyboardInterrupt
        return rename(self, target)

    monkeypatch.setattr(Path, "rename", interrupted)
    with pytest.raises(KeyboardInterrupt):
        write(run, "new")
    assert contents(run) == OLD
    assert [path.name for path in run.parent.iterdir()] == ["run"]


def test_an_interruption_after_the_exchange_leaves_the_new_folder(
    run: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    rename = Path.rename

    def interrupted(self: Path, target: Path) -> Path:
        moved = rename(self, target)
        if target == run:
            raise KeyboardInterrupt
        return moved

    monkeypatch.setattr(Path, "rename", interrupted)
    with pytest.raises(KeyboardInterrupt):
        write(run, "new")
    assert contents(run) == NEW
    assert [path.name for path in run.parent.iterdir()] == ["run"]


def test_a_file_of_somebody_else_is_never_deleted(run: Path) -> None:
    (run / "figures" / "site photo.jpg").write_bytes(b"precious")
    with pytest.raises(InconsistentInputError, match=r"figures/site photo\.jpg in it was not written"):
        write(run, "new")
    assert contents(run) == OLD | {"figures/site photo.jpg": "precious"}


def test_an_edited_file_is_never_overwritten(run: Path) -> None:
    (run / "droppers.csv").write_text("old, with my remarks", encoding="utf-8")
    with pytest.raises(InconsistentInputError, match=r"droppers\.csv in it .* was changed since"):
        write(run, "new")
    assert contents(run)["droppers.csv"] == "old, with my remarks"


def test_a_file_that_appears_while_writing_is_kept(run: Path) -> None:
    with pytest.raises(InconsistentInputError, match=r"notes\.txt"), replace_folder(run):
        (run / "notes.txt").write_text("precious", encoding="utf-8")
    assert contents(run) == OLD | {"notes.txt": "precious"}


def test_a_link_in_the_folder_is_not_ours(run: Path, tmp_path: Path) -> None:
    (tmp_path / "target.csv").write_text("old", encoding="utf-8")
    (run / "droppers.csv").unlink()
    (run / "droppers.csv").symlink_to(tmp_path / "target.csv")
    with pytest.raises(InconsistentInputError, match=r"droppers\.csv"):
        require_replaceable(run)


@pytest.mark.parametrize("manifest", [None, "", "[]", '{"format": "other", "files": {}}', '{"files": []}'])
def test_a_folder_without_our_manifest_is_refused(tmp_path: Path, manifest: str | None) -> None:
    (tmp_path / "letter.txt").write_text("precious", encoding="utf-8")
    if manifest is not None:
        (tmp_path / "manifest.json").write_text(manifest, encoding="utf-8")
    with pytest.raises(InconsistentInputError, match="left as it is"):
        require_replaceable(tmp_path)
    assert (tmp_path / "letter.txt").read_text(encoding="utf-8") == "precious"


def test_a_file_and_the_working_folder_are_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "file").write_text("", encoding="utf-8")
    with pytest.raises(InconsistentInputError, match="is a file"):
        require_replaceable(tmp_path / "file")
    (tmp_path / "here" / "below").mkdir(parents=True)
    monkeypatch.chdir(tmp_path / "here" / "below")
    for folder in (".", ".."):
        with pytest.raises(InconsistentInputError, match="current working folder"):
            require_replaceable(folder)


def test_files_that_the_user_removed_do_not_matter(run: Path) -> None:
    (run / "figures" / "tensions.png").unlink()
    assert require_replaceable(run) == run.resolve()


def test_a_place_below_a_file_is_refused(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("", encoding="utf-8")
    with pytest.raises(InconsistentInputError, match="is not a folder to write into"):
        require_replaceable(tmp_path / "file" / "deep" / "run")
    assert require_replaceable(tmp_path / "new" / "deep" / "run") == tmp_path / "new" / "deep" / "run"


def test_a_place_without_permission_is_refused(run: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    require_replaceable(run)
    monkeypatch.setattr("os.access", lambda place, mode: place != run.parent)
    for folder in (run, run.parent / "another"):
        with pytest.raises(InconsistentInputError, match="cannot be written"):
            require_replaceable(folder)


def result_in(folder: Path, kind: str) -> None:
    with replace_folder(folder) as new:
        (new / "result.json").write_text(json.dumps({"format": kind, "result": {}}, indent=1))


def test_a_result_of_another_kind_is_not_replaced(tmp_path: Path) -> None:
    result_in(tmp_path / "run", "catenaria form-finding result")
    with pytest.raises(InconsistentInputError, match="it holds a catenaria form-finding result"):
        result_in(tmp_path / "run", "catenaria load cases")
    with pytest.raises(InconsistentInputError, match="it holds a catenaria form-finding result"):
        write(tmp_path / "run", "tables without a result")
    with pytest.raises(InconsistentInputError, match="it holds a catenaria form-finding result"):
        require_replaceable(tmp_path / "run", LoadStudy)
    assert "form-finding" in (tmp_path / "run" / "result.json").read_text()


def test_a_result_of_the_same_kind_and_tables_are_replaced(run: Path, tmp_path: Path) -> None:
    require_replaceable(run, LoadStudy)
    result_in(run, "catenaria load cases")
    require_replaceable(run, LoadStudy)
    result_in(run, "catenaria load cases")
    assert [path.name for path in tmp_path.iterdir() if path.name.startswith(".")] == []
