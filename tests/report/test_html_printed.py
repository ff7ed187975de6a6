"""The page on paper, printed by an installed browser."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from catenaria.errors import NotConvergedError
from catenaria.report.checks import load_rules
from catenaria.report.html.page import Contents, page
from catenaria.results import FormResult
from catenaria.workflow import pdf, write_report

A4 = (595.0, 842.0)  # points


@pytest.fixture(scope="module")
def printed(paper: FormResult, tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    """Return the page and the PDF file of the paper's line."""
    file = tmp_path_factory.mktemp("printed") / "line.html"
    html, paged = write_report(page(Contents(paper, load_rules())), file, pdf=True)
    return html, paged


def test_pages_are_a4(printed: tuple[Path, Path]) -> None:
    content = printed[1].read_bytes()
    assert content.startswith(b"%PDF-")
    boxes = [box.split() for box in re.findall(rb"/MediaBox\s*\[([^\]]*)\]", content)]
    assert len(boxes) >= 5
    for _, _, width, height in boxes:
        assert (float(width), float(height)) == pytest.approx(A4, abs=1.0)


def test_both_files_have_one_name(printed: tuple[Path, Path]) -> None:
    assert [path.name for path in sorted(printed[0].parent.iterdir())] == ["line.html", "line.pdf"]


def test_the_moment_of_printing_is_not_in_it(printed: tuple[Path, Path]) -> None:
    dates = re.findall(rb"D:(\d{8})", printed[1].read_bytes())
    assert dates
    assert set(dates) == {b"19800101"}


def test_readers_show_an_outline(printed: tuple[Path, Path]) -> None:
    assert b"/Outlines" in printed[1].read_bytes()


def test_equal_pages_give_equal_prints(printed: tuple[Path, Path], tmp_path: Path) -> None:
    _, again = write_report(printed[0].read_text(encoding="utf-8"), tmp_path / "line.html", pdf=True)
    assert again.read_bytes() == printed[1].read_bytes()


def test_a_browser_that_fails_leaves_nothing(
    paper: FormResult, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(pdf, "BROWSERS", ("false",))
    with pytest.raises(NotConvergedError, match="printed nothing"):
        write_report("<p>", tmp_path / "line.html", pdf=True)
    assert list(tmp_path.iterdir()) == []
