"""Downloads: each is the file that the command line writes."""

from __future__ import annotations

import io
import tempfile
import zipfile
from dataclasses import replace
from pathlib import Path

import pytest

from catenaria import workflow
from catenaria.errors import InconsistentInputError
from catenaria.report.tables import write_tables
from catenaria.results import FormResult, load_result
from catenaria.studio import downloads
from catenaria.studio.documents import Document, uploaded
from catenaria.validation import example_file


def test_droppers_are_those_of_the_command(form: FormResult, tmp_path: Path) -> None:
    write_tables(form, tmp_path)
    file = downloads.droppers_csv(form)
    assert file.name == "Yang_et_al_2017_three_spans-droppers.csv"
    assert file.content == (tmp_path / "droppers.csv").read_bytes()


def test_the_line_file_is_the_line(paper: Document) -> None:
    file = downloads.line_file(paper)
    assert file.name == "yang2017_three_span.yaml"
    assert file.content == example_file(file.name).read_bytes()
    faulty = downloads.line_file(paper.edited(paper.tree | {"speed": "fast"}))
    assert faulty.content == file.content + b"speed: fast\n"
    assert uploaded(faulty.name, faulty.content).tree["speed"] == "fast"


def test_the_folder_holds_the_result(form: FormResult, tmp_path: Path) -> None:
    file = downloads.result_folder(form)
    assert file.name.endswith("-result.zip")
    with zipfile.ZipFile(io.BytesIO(file.content)) as archive:
        assert archive.testzip() is None
        archive.extractall(tmp_path)
    for name in ("droppers.csv", "report.html", "figures"):
        assert (tmp_path / name).exists()
    found = load_result(tmp_path)
    assert found.rebuilt.passed
    assert found.droppers.cut_length == pytest.approx(form.droppers.cut_length)

    assert '<section id="elasticity">' in (tmp_path / "report.html").read_text(encoding="utf-8")


def test_the_report_is_that_of_the_command(form: FormResult) -> None:
    file = downloads.report_page(form)
    assert file.content.decode() == workflow.report(form)
    assert b'<section id="elasticity">' in file.content


def test_a_form_that_is_not_confirmed_has_no_folder(
    form: FormResult, monkeypatch: pytest.MonkeyPatch
) -> None:
    wrong = replace(form, audit=replace(form.audit, findings=("too long",)))
    monkeypatch.setattr(workflow, "solve", lambda line: wrong)
    with pytest.raises(InconsistentInputError, match=r"not confirmed.*too long"):
        downloads.result_folder(form)


def test_every_export_is_offered(form: FormResult) -> None:
    assert tuple(downloads.EXPORTS) == workflow.FORMATS
    assert downloads.exported("csv", form).name.endswith("-schedule.csv")
    assert zipfile.is_zipfile(io.BytesIO(downloads.exported("dxf", form).content))


def test_nothing_is_left_behind(form: FormResult, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    downloads.droppers_csv(form)
    downloads.exported("json", form)
    assert list(tmp_path.iterdir()) == []
