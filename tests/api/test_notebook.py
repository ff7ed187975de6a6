"""What terminals and notebooks show of a result."""

from __future__ import annotations

import re
from dataclasses import replace
from xml.etree import ElementTree

import pytest

import catenaria
from catenaria.line.summary import summarise
from catenaria.results import NOT_AUDITED


def parsed(result: catenaria.Result) -> ElementTree.Element:
    """Return the HTML of a result, which is also XML."""
    return ElementTree.fromstring(result._repr_html_())


def texts(root: ElementTree.Element) -> str:
    return " ".join("".join(root.itertext()).split())


def test_a_terminal_shows_a_few_lines(paper: catenaria.Result, stitched: catenaria.Result) -> None:
    for result in (paper, stitched):
        lines = repr(result).splitlines()
        assert len(lines) == 8
        assert max(map(len, lines)) < 110
        assert lines[0] == f"Result: {result.name}"
    assert "17 stitch wires" in repr(stitched)
    assert "21 droppers" in repr(paper)


@pytest.mark.parametrize("name", ["paper", "stitched"])
def test_a_notebook_shows_sketch_wires_and_verdicts(name: str, request: pytest.FixtureRequest) -> None:
    result: catenaria.Result = request.getfixturevalue(name)
    root = parsed(result)
    assert len(result._repr_html_()) < 60_000
    (sketch,) = root.findall(".//svg")
    lines = sketch.findall("polyline")
    assert len(lines) == len(result.form.wires)
    (bars,) = sketch.findall("path")
    assert bars.attrib["d"].count("M") == len(result.droppers)
    numbers = [float(n) for line in lines for n in re.split("[ ,]", line.attrib["points"])]
    assert min(numbers) >= 6.0 - 0.05
    assert max(numbers[1::2]) <= 104.05
    assert max(numbers[::2]) <= 714.05
    shown = texts(root)
    assert "passed" in shown
    assert all(wire in shown for wire in ("contact wire", "messenger wire", "15000.0"))


def test_a_name_cannot_smuggle_in_a_script(paper: catenaria.Result) -> None:
    evil = catenaria.Result(replace(paper.form, name="<script>alert(1)</script>", method="<b>"))
    html = evil._repr_html_()
    assert "<script" not in html
    assert "&lt;script&gt;" in html
    assert ElementTree.fromstring(html).findall(".//script") == []


def test_what_failed_is_said(paper: catenaria.Result) -> None:
    form = paper.form
    wrong = replace(form, audit=replace(form.audit, findings=("nodes do not balance", "other")))
    height = form.rebuilt.height
    back = replace(form.rebuilt, height=replace(height, change=height.change + 1.0))
    for shown in (repr, lambda result: texts(parsed(result))):
        assert "FAILED" not in shown(paper)
        assert "FAILED: nodes do not balance (and 1 more)" in shown(catenaria.Result(wrong))
        assert "FAILED: rebuilt line: height off" in shown(catenaria.Result(replace(form, rebuilt=back)))
        assert re.search("audit *none", shown(catenaria.Result(replace(form, audit=NOT_AUDITED))))


def test_slack_droppers_are_said(paper: catenaria.Result) -> None:
    droppers = paper.form.droppers
    force = droppers.force_bottom.copy()
    force[:2] = -1.0
    slack = catenaria.Result(replace(paper.form, droppers=replace(droppers, force_bottom=force)))
    assert "2 SLACK" in repr(slack)
    assert "none slack" in repr(paper)


@pytest.mark.parametrize("name", ["paper", "stitched"])
def test_a_line_says_in_a_few_lines_what_it_is(name: str, request: pytest.FixtureRequest) -> None:
    line: catenaria.Line = request.getfixturevalue(name).line
    said = repr(line)
    assert said == str(line)
    assert len(said.splitlines()) < 60
    assert len(said) < 3000 < len(line.model_dump_json())
    for title, rows in summarise(line):
        assert f"\n{title}\n" in f"\n{said}"
        assert all(text in said for _, text in rows)


def test_studies_say_in_one_line_what_they_are(paper: catenaria.Result) -> None:
    study = paper.under({"summer": {"temperature": {"change": "40 K"}}})
    assert repr(study) == "LoadStudy: Yang et al. 2017, three spans, method direct; cases: summer"
    assert repr(study.cases[0]).startswith("CaseResult: summer, ")
    elasticity = paper.elasticity(100.0, 5.0)
    assert re.fullmatch(
        r"ElasticityStudy: Yang et al. 2017, three spans, pushed with 100 N at \d+ points; "
        r"[\d.]+ to [\d.]+ mm/N, non-uniformity [\d.]+ %",
        repr(elasticity),
    )
    tolerance = paper.tolerance(samples=20, model="linear", seed=1)
    assert re.fullmatch(
        r"ToleranceStudy: Yang et al. 2017, three spans, 20 samples, linear; "
        r"contact wire off by more than 5 mm in [\d.]+ % of them",
        repr(tolerance),
    )
