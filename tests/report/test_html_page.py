"""The page: everything in it, nothing from outside, no text that becomes code, the same again."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from dataclasses import replace
from html.parser import HTMLParser
from typing import Any

import pytest

from catenaria.errors import UnsupportedError
from catenaria.report.checks import load_rules
from catenaria.report.html import page as module
from catenaria.report.html.page import Contents, page
from catenaria.results import FormResult

EXAMPLES = (
    "bridge",
    "compound",
    "curve_800m",
    "overlap",
    "simple_55m",
    "simple_60m",
    "stitched_re250",
    "two_contact_wires_3kv",
)
EVIL = '<script>alert(1)</script> & "S1" </script><b>'
VOID = {"meta", "link", "br", "img", "line", "path", "circle"}


class Reader(HTMLParser):
    """Collects elements, and complains of those that are not closed in order."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.ids: list[str] = []
        self.links: list[str] = []
        self.outside: list[str] = []
        self.scripts = 0
        self.text: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        given = dict(attrs)
        self.ids += [str(given["id"])] if "id" in given else []
        self.links += [str(given["href"])[1:]] if str(given.get("href", "")).startswith("#") else []
        for name in ("src", "href", "srcset", "action"):
            value = str(given.get(name) or "")
            if value and not value.startswith(("#", "data:")):
                self.outside.append(value)
        self.scripts += tag == "script"
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Take no notice of what closes itself."""

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        if self.open and self.open[-1] not in ("script", "style"):
            self.text.append(data)


def read(text: str) -> Reader:
    reader = Reader()
    reader.feed(text)
    reader.close()
    assert reader.open == []
    return reader


def drawings(text: str) -> list[dict[str, Any]]:
    found = re.search(r'<script type="application/json" id="drawings">(.*?)</script>', text, re.DOTALL)
    assert found is not None
    return json.loads(found[1])


@pytest.fixture(scope="module")
def light(paper: FormResult) -> Callable[..., str]:
    """Return pages of the paper's line."""

    def make(result: FormResult = paper, **more: Any) -> str:
        return page(Contents(result, load_rules(), **more))

    return make


@pytest.mark.parametrize("name", EXAMPLES)
def test_every_example_line(solved: Callable[[str], FormResult], name: str) -> None:
    result = solved(name)
    text = page(Contents(result, load_rules()))
    reader = read(text)
    assert len(set(reader.ids)) == len(reader.ids)
    assert set(reader.links) <= set(reader.ids)
    assert {drawing["id"] for drawing in drawings(text)} <= set(reader.ids)
    words = " ".join(reader.text)
    for wire in result.wires:
        assert wire.name in words
    assert f"{result.droppers.cut_length[-1]:.4f}" in words
    assert "✗ fails" not in words
    assert f"{3.6 * result.inputs['speed']:g} km/h by" in words  # the wave speed is judged
    assert "NaN" not in words
    assert "nan" not in {word.strip(".,") for word in words.split()}


@pytest.mark.parametrize("method", ["catenary equations", "force density", "adjusted lengths"])
def test_other_methods(solved: Callable[[str, str], FormResult], method: str) -> None:
    reader = read(page(Contents(solved("yang2017_three_span", method), load_rules())))
    assert method in " ".join(reader.text)


def test_nothing_comes_from_outside(curve_page: str) -> None:
    reader = read(curve_page)
    assert reader.outside == []
    assert reader.scripts == 3  # the figures' numbers, Plotly, the page's own
    assert "default-src 'none'" in curve_page
    style = curve_page[curve_page.index("<style>") : curve_page.index("</style>")]
    assert "url(" not in style
    assert "@import" not in style


def test_plotly_is_in_it_once(curve_page: str) -> None:
    assert curve_page.count("plotly.js v") == 1


def test_texts_of_the_line_do_not_become_code(light: Callable[..., str], paper: FormResult) -> None:
    supports = [support | {"name": f"{EVIL}{i}"} for i, support in enumerate(paper.inputs["supports"])]
    named = replace(
        paper,
        name=EVIL,
        inputs=paper.inputs | {"name": EVIL, "description": EVIL, "supports": supports},
        supports=replace(paper.supports, support=tuple(EVIL for _ in paper.supports.support)),
    )
    text = light(named, date=EVIL, notes=(EVIL,))
    reader = read(text)
    assert reader.scripts == 3
    assert "<script>alert" not in text
    assert text.count("</style>") == 1  # it is at the foot of every page, too
    annotations = drawings(text)[0]["layout"]["annotations"]
    assert "&lt;script&gt;" in annotations[0]["text"]  # Plotly reads tags in texts, too


def test_equal_results_give_equal_pages(light: Callable[..., str]) -> None:
    assert light() == light()
    assert light(date="22 November 2026") != light()


def test_lengths_have_a_temperature(light: Callable[..., str], paper: FormResult) -> None:
    assert "<dd>15 °C</dd>" in light()
    cold = replace(paper, inputs=paper.inputs | {"reference_temperature": -5.0})
    assert "what the clamps bridge, at -5 °C" in light(cold)


def test_every_page_on_paper_says_whose_it_is(light: Callable[..., str]) -> None:
    assert 'content: "Yang et al. 2017, three spans, 22 November 2026, catenaria' in light(
        date="22 November 2026"
    )


def test_a_date_only_if_given(light: Callable[..., str]) -> None:
    assert "<dt>Date</dt>" not in light()
    assert "<dd>22 November 2026</dd>" in light(date="22 November 2026")


def test_verdicts_are_written_in_words(light: Callable[..., str]) -> None:
    fast = " ".join(read(light(speed=100.0)).text)
    assert "✗ fails" in fast
    slow = " ".join(read(light(speed=50.0)).text)
    assert "✗ fails" not in slow
    assert "✓ passes" in slow


def test_what_is_wrong_stands_at_the_top(light: Callable[..., str], paper: FormResult) -> None:
    failed = replace(paper, audit=replace(paper.audit, findings=("the weight is missing",)))
    words = " ".join(read(light(failed)).text)
    assert "FAILED" in words
    assert "the weight is missing" in words
    assert "FAILED" not in " ".join(read(light()).text)


def test_a_missing_library_is_named(monkeypatch: pytest.MonkeyPatch, light: Callable[..., str]) -> None:
    monkeypatch.setattr(module, "_NEEDED", ("jinja2", "plotly_that_is_not_there"))
    with pytest.raises(UnsupportedError, match=r"catenaria\[report\]"):
        light()


def test_the_input_is_echoed(light: Callable[..., str], paper: FormResult) -> None:
    words = " ".join(read(light()).text)
    assert "force: 15000.0" in words
    assert not re.search(r"\d\.\d{14}", words)  # digits that units leave behind
    assert paper.versions["numpy"] in words


@pytest.mark.parametrize("count", [0, 1])
def test_hardly_any_droppers(light: Callable[..., str], paper: FormResult, count: int) -> None:
    droppers = paper.droppers
    few = {name: getattr(droppers, name)[:count] for name in droppers.__dataclass_fields__}
    reader = read(light(replace(paper, droppers=replace(droppers, **few)), speed=50.0))
    words = " ".join(reader.text)
    assert ("there are no droppers" in words) is (count == 0)
    assert "no span has two droppers" in words
