"""Which files a batch solves, and where their results go: nothing twice, nothing into the same folder."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

import pytest

from catenaria.errors import InconsistentInputError
from catenaria.results import replace_folder
from catenaria.workflow.batch_files import find_files

Find = Callable[..., dict[str, str]]


@pytest.fixture
def find(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Find:
    """Make files, and return names and places of those that are found."""
    monkeypatch.chdir(tmp_path)

    def found(made: Sequence[str], *patterns: str, out: str = "results") -> dict[str, str]:
        for name in made:
            (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
            (tmp_path / name).touch()
        files = find_files(patterns, out)
        assert all(file.file.is_file() and file.file.is_absolute() for file in files)
        assert all(file.folder == tmp_path / out / file.place for file in files)
        return {file.name: file.place for file in files}

    return found


def test_a_folder_is_mirrored(find: Find) -> None:
    made = ("net/b/same.yaml", "net/a/same.json", "net/top.yml", "net/readme.md", "net/.hidden/x.yaml")
    assert find(made, "net") == {"a/same.json": "a/same", "b/same.yaml": "b/same", "top.yml": "top"}


def test_globs_take_what_they_match(find: Find) -> None:
    made = ("net/a/one.yaml", "net/b/two.yaml", "net/b/deep/three.yaml", "net/b/four.txt")
    assert find(made, "net/*/*.yaml") == {"a/one.yaml": "a/one", "b/two.yaml": "b/two"}
    assert set(find(made, "net/**/*.yaml")) == {"a/one.yaml", "b/two.yaml", "b/deep/three.yaml"}
    assert find(made, "net/b/four.txt") == {"four.txt": "four"}


def test_several_arguments_are_mirrored_from_what_they_have_in_common(find: Find) -> None:
    made = ("lines/north/a.yaml", "lines/south/a.yaml")
    expected = {"north/a.yaml": "north/a", "south/a.yaml": "south/a"}
    assert find(made, "lines/north", "lines/south/*.yaml") == expected
    assert find(made, "lines/south/../north", "lines/south") == expected


def test_a_file_that_is_named_twice_is_solved_once(find: Find) -> None:
    assert find(("net/a.yaml",), "net", "net/a.yaml", "net/../net/*.yaml") == {"a.yaml": "a"}


@pytest.mark.parametrize(
    ("made", "places"),
    [
        (("net/a.yaml", "net/a.json", "net/b.yaml"), {"a.json", "a.yaml", "b"}),
        (("net/a.yaml", "net/a/b.yaml"), {"a.yaml", "a/b"}),
    ],
)
def test_no_two_files_share_a_folder_and_no_folder_is_in_another(
    find: Find, made: tuple[str, ...], places: set[str]
) -> None:
    found = find(made, "net").values()
    assert set(found) == places
    assert not any(Path(a) in Path(b).parents for a in found for b in found)


def test_results_are_not_taken_for_lines(find: Find, tmp_path: Path) -> None:
    with replace_folder(tmp_path / "net" / "solved") as new:
        (new / "result.json").touch()
    with replace_folder(tmp_path / "net" / "written") as new:
        (new / "line.yaml").touch()
    made = ("net/a.yaml", "net/out/b.yaml", "net/out/b/result.json")
    expected = {"a.yaml": "a", "written/line.yaml": "written/line"}
    assert find(made, "net", out="net/out") == expected
    assert find(made, "net/*.yaml", "net/*/*.yaml", out="net/out") == expected


@pytest.mark.parametrize("pattern", ["missing", "missing.yaml", "net/*.yml", "missing/**/*.yaml"])
def test_what_matches_nothing_is_refused(find: Find, pattern: str) -> None:
    with pytest.raises(InconsistentInputError, match="there is no such line file"):
        find(("net/a.yaml",), "net", pattern)


def test_lines_in_the_folder_of_results_are_not_said_to_be_missing(find: Find) -> None:
    with pytest.raises(InconsistentInputError, match=r"net lies in the folder of results .*Name another"):
        find(("net/a.yaml",), "net", out="net")
