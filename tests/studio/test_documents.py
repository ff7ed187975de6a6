"""Documents: what may be uploaded, that nothing is executed or left behind, that edits copy, and texts."""

from __future__ import annotations

import copy
import tempfile
from pathlib import Path

import pytest

from catenaria.errors import Fault, InconsistentInputError, LineFileError
from catenaria.line import Line
from catenaria.line.load import load_line, model_from
from catenaria.studio.documents import (
    EXAMPLES,
    MOST_BYTES,
    Document,
    as_yaml,
    example,
    open_document,
    placed,
    replaced,
    uploaded,
)


@pytest.mark.parametrize("name", EXAMPLES)
def test_every_example_comes_back_as_it_was_written(name: str) -> None:
    document = example(name)
    text = as_yaml(document)
    assert "&" not in text
    again = uploaded(f"{name}.yaml", text.encode())
    assert again.tree == document.tree
    assert again.name == name
    assert model_from(again.tree, Line) == model_from(document.tree, Line)


@pytest.mark.parametrize("name", EXAMPLES)
def test_a_text_is_kept(name: str, tmp_path: Path) -> None:
    data = example(name).text.encode()
    file = tmp_path / f"{name}.yml"
    file.write_bytes(data)
    for document in (uploaded(file.name, data), open_document(file)):
        assert document.text.encode() == data
        assert document.file == file.name
        edited = document.edited(replaced(document.tree, ("name",), "mine"))
        assert uploaded(edited.file, edited.text.encode()).tree == edited.tree
        assert edited.edited(document.tree).text.encode() == data


def test_the_mark_of_utf_8_is_no_part_of_a_text() -> None:
    assert uploaded("line.yaml", b"\xef\xbb\xbfformat: 1").text == "format: 1"


@pytest.mark.parametrize(
    ("sent", "kept"),
    [
        ("mine.yaml", "mine.yaml"),
        ("my line.YML", "my_line.yml"),
        ("a.b.json", "a_b.json"),
        ("x.txt", "x.yaml"),
    ],
)
def test_a_file_keeps_its_name(sent: str, kept: str) -> None:
    assert uploaded(sent, b'{"format": 1}').file == kept


def test_a_text_becomes_the_document(paper: Document) -> None:
    text = "# mine\nformat: 1\nwrong: 2\n"
    document = paper.rewritten(text)
    assert (document.text, document.tree, document.file) == (text, {"format": 1, "wrong": 2}, paper.file)
    for unreadable in ("- 1", "a: [", "", "a: !!python/name:os.system x", "\ud800"):
        with pytest.raises(LineFileError) as found:
            paper.rewritten(unreadable)
        assert found.value.faults[0].file == paper.file


def test_faults_are_placed_in_the_text(paper: Document, tmp_path: Path) -> None:
    tree = replaced(paper.tree, ("spans", 1, "length"), "65 kg")
    tree = replaced(tree, ("messenger_wire", "conductor"), None) | {"speed": "fast"}
    document = paper.edited(tree)
    file = tmp_path / "line.yaml"
    file.write_text(document.text, encoding="utf-8")
    with pytest.raises(LineFileError) as by_file:
        load_line(file)
    with pytest.raises(LineFileError) as by_tree:
        model_from(tree, Line)
    assert {fault.line for fault in by_tree.value.faults} == {0}
    found = placed(document, by_tree.value.faults)
    assert {(fault.line, fault.column, fault.field) for fault in found} == {
        (fault.line, fault.column, fault.field) for fault in by_file.value.faults
    }
    assert len(found) == 3
    (nowhere,) = placed(document, [Fault("", 0, 0, "what].ever[1]", "nothing", "something")])
    assert document.text.splitlines()[nowhere.line - 1].startswith("format")


def test_json_is_read_by_its_suffix() -> None:
    assert uploaded("a.JSON", b'{"format":\t1}').tree == {"format": 1}
    with pytest.raises(LineFileError):
        uploaded("a.json", b"format: 1")


@pytest.mark.parametrize("text", ["- 1", "just words", "", "a: [", "\x00"])
def test_what_is_no_mapping_is_refused(text: str) -> None:
    with pytest.raises(LineFileError):
        uploaded("line.yaml", text.encode())


def test_tags_are_not_executed(tmp_path: Path) -> None:
    file = tmp_path / "made"
    with pytest.raises(LineFileError, match="plain YAML without tags"):
        uploaded("line.yaml", f"name: !!python/object/apply:os.mkdir ['{file}']".encode())
    assert not file.exists()


@pytest.mark.slow
def test_aliases_of_aliases_do_not_fill_the_memory() -> None:
    rows = ["a0: &a0 [1, 1]"]
    rows += [f"a{i}: &a{i} [{', '.join([f'*a{i - 1}'] * 10)}]" for i in range(1, 12)]
    with pytest.raises(LineFileError, match="fits into memory"):
        uploaded("line.yaml", "\n".join(rows).encode())


def test_the_size_is_limited() -> None:
    fits = b"# " + b"x" * (MOST_BYTES - 20) + b"\nformat: 1\n"
    assert uploaded("line.yaml", fits).tree == {"format": 1}
    with pytest.raises(InconsistentInputError, match="1 MB at most"):
        uploaded("line.yaml", fits + b"#" * 20)


@pytest.mark.parametrize("name", ["../../evil.yaml", "/etc/passwd", "c:\\x.yaml", "~.yaml", ""])
def test_the_name_of_a_file_leads_nowhere(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    document = uploaded(name, b"format: 1")
    assert document.name
    assert not set(document.name) & set("./\\:~ ")
    assert list(tmp_path.iterdir()) == []


def test_an_edit_leaves_the_line_before_as_it_was(paper: Document) -> None:
    before = copy.deepcopy(paper.tree)
    after = replaced(paper.tree, ("spans", 1, "droppers", "positions", 0), 5)
    assert paper.tree == before
    assert after["spans"][1]["droppers"]["positions"][0] == 5
    assert after["spans"][2]["droppers"]["positions"][0] == 4


def test_a_field_that_is_missing_is_made() -> None:
    assert replaced({}, ("contact_wire", "tension", "force"), "15 kN") == {
        "contact_wire": {"tension": {"force": "15 kN"}}
    }
