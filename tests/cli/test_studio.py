"""`catenaria studio`: what it refuses and says before it serves."""

from __future__ import annotations

from pathlib import Path

import pytest
from typer.testing import CliRunner

from catenaria.cli.main import app
from catenaria.studio import app as server
from catenaria.studio.app import Address
from catenaria.studio.documents import Document

RUN = CliRunner()
Served = list[tuple[Document, Address, bool]]


@pytest.fixture
def served(monkeypatch: pytest.MonkeyPatch) -> Served:
    calls: Served = []
    monkeypatch.setattr(server, "require_studio_libraries", lambda: None)
    monkeypatch.setattr(server, "serve", lambda *arguments: calls.append(arguments))
    return calls


def test_it_listens_on_loopback_only(served: Served) -> None:
    outcome = RUN.invoke(app, ["studio", "--no-browser"])
    assert outcome.exit_code == 0, outcome.output
    ((document, where, browser),) = served
    assert (document.name, where.host, browser) == ("yang2017_three_span", "127.0.0.1", False)
    assert f"Studio: {where.url}" in outcome.stdout
    assert outcome.stderr == ""


def test_others_are_let_in_by_an_explicit_flag_that_says_so(served: Served) -> None:
    refused = RUN.invoke(app, ["studio", "--host", "0.0.0.0"])
    assert refused.exit_code == 2
    assert "--expose" in refused.stderr
    assert served == []
    exposed = RUN.invoke(app, ["studio", "--host", "0.0.0.0", "--expose"])
    assert exposed.exit_code == 0
    assert "Everybody who reaches" in exposed.stderr
    assert "no passwords" in exposed.stderr


def test_a_faulty_line_is_opened_and_what_is_no_line_is_not(served: Served, tmp_path: Path) -> None:
    faulty, broken = tmp_path / "faulty.yaml", tmp_path / "broken.yaml"
    faulty.write_text("format: 1\nname: 7\n", encoding="utf-8")
    broken.write_text("a: [", encoding="utf-8")
    assert RUN.invoke(app, ["studio", str(faulty)]).exit_code == 0
    assert served[0][0].tree == {"format": 1, "name": 7}
    outcome = RUN.invoke(app, ["studio", str(broken)])
    assert outcome.exit_code == 2
    assert "broken.yaml:1" in outcome.stderr


def test_a_missing_library_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "nicegui", None)
    outcome = RUN.invoke(app, ["studio"])
    assert outcome.exit_code == 2
    assert 'pip install "catenaria[studio]"' in outcome.stderr
