"""Figures of the page: Plotly accepts them, they show the numbers of the result, and keep every peak."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import plotly.graph_objects as go
import pytest

from catenaria.line import Line
from catenaria.report.html import figures
from catenaria.report.html.drawing import Drawing, layout
from catenaria.report.html.sketch import sketch
from catenaria.report.html.thinning import simplified
from catenaria.report.html.windows import windows
from catenaria.results import FormResult

COLOURS = ("contact", "messenger", "dropper", "ink", "quiet", "line", "grid", "card", "band", "band-edge")


def all_figures(result: FormResult) -> list[Drawing]:
    return [
        *figures.profile_figures(result),
        *figures.height_figures(result, 5e-3),
        *figures.plan_figures(result),
        *figures.tension_figures(result),
    ]


def painted(value: Any) -> Any:
    """Put a colour in the place of names of the style sheet."""
    if isinstance(value, dict):
        return {key: painted(item) for key, item in value.items()}
    if isinstance(value, list):
        return [painted(item) for item in value]
    return "#123456" if isinstance(value, str) and value.startswith("var(") else value


@pytest.mark.parametrize("name", ["paper", "curve", "in_space"])
def test_plotly_accepts_every_figure(name: str, request: pytest.FixtureRequest) -> None:
    for one in all_figures(request.getfixturevalue(name)):
        figure = go.Figure(data=painted(one.data), layout=painted(one.layout))
        assert len(figure.to_dict()["data"]) == len(one.data)


def test_plotly_refuses_a_wrong_figure(paper: FormResult) -> None:
    one = all_figures(paper)[0]
    with pytest.raises(ValueError, match="colour"):
        go.Figure(data=painted([one.data[0] | {"colour": "red"}]))


def test_long_lines_are_drawn_in_parts(curve: FormResult, paper: FormResult) -> None:
    parts = figures.profile_figures(curve)
    assert len(parts) == 3  # of 904 m, at most 450 m each
    assert len({tuple(part.layout["yaxis"]["range"]) for part in parts}) == 1
    assert len(figures.profile_figures(paper)) == 1


def test_parts_begin_and_end_at_supports(curve: FormResult) -> None:
    parts = windows(curve)
    supports = set(curve.supports.chainage.tolist())
    assert [part.end for part in parts[:-1]] == [part.start for part in parts[1:]]
    assert {part.end for part in parts[:-1]} <= supports
    assert (parts[0].start, parts[-1].end) == figures.extent(curve)
    assert parts[0].label == "S1 to S7, 0 m to 288 m"
    assert len(windows(curve, math.inf)) == 1


def test_nothing_at_the_edge_is_cut_off(curve: FormResult) -> None:
    for part, one in zip(windows(curve), figures.profile_figures(curve), strict=True):
        low, high = one.layout["xaxis"]["range"]
        assert low < part.start
        assert high > part.end


def test_a_very_long_line_has_few_figures(make_result: Callable[[int], FormResult]) -> None:
    assert len(figures.profile_figures(make_result(120))) == 12


def test_every_dropper_says_its_lengths_at_both_ends(paper: FormResult) -> None:
    droppers = paper.droppers
    (bars,) = [trace for trace in figures.profile_figures(paper)[0].data if "text" in trace]
    assert bars["mode"] == "lines+markers"
    assert "cut to %{customdata[1]:.4f} m" in bars["hovertemplate"]
    names = [f"dropper {droppers.span[i]}.{droppers.number[i]}" for i in range(droppers.x.size)]
    said = np.array(bars["customdata"]).reshape(-1, 3, 6)
    height = np.array(bars["y"], dtype=np.float64).reshape(-1, 3)
    for end, wire in enumerate((droppers.height, droppers.messenger_height)):
        assert bars["text"][end::3] == names
        np.testing.assert_allclose(said[:, end, 1], droppers.cut_length, atol=5e-5)
        np.testing.assert_allclose(said[:, end, 2], droppers.force_bottom, atol=5e-5)
        np.testing.assert_allclose(height[:, end], wire, atol=5e-6)


def test_marks_do_not_touch_each_other(curve: FormResult) -> None:
    (whole,) = figures.profile_figures(curve, math.inf)
    assert [trace["mode"] for trace in whole.data if trace["name"] == "dropper"] == ["lines"]
    part = figures.profile_figures(curve)[0]
    assert [trace["mode"] for trace in part.data if trace["name"] == "dropper"] == ["lines+markers"]


def test_the_tension_keeps_its_extremes(curve: FormResult) -> None:
    for one, wire in zip(figures.tension_figures(curve), curve.wires, strict=True):
        drawn = np.array(one.data[1]["y"])
        assert drawn.max() == pytest.approx(wire.profile.tension.max(), abs=0.05)
        assert drawn.min() == pytest.approx(wire.profile.tension.min(), abs=0.05)


def test_hovering_says_chainage_height_and_force(paper: FormResult) -> None:
    trace = figures.profile_figures(paper)[0].data[0]
    for word in ("chainage", "height", "tension"):
        assert word in trace["hovertemplate"]
    i = len(trace["x"]) // 2
    profile = paper.wires[0].profile
    assert trace["customdata"][i][0] == pytest.approx(
        np.interp(trace["x"][i], profile.x, profile.z), abs=1e-4
    )


def test_heights_are_counted_from_wanted_ones(paper: FormResult) -> None:
    one = figures.height_figures(paper, 5e-3)[0]
    wire = next(trace for trace in one.data if trace["name"] == "contact wire")
    assert min(wire["y"]) == pytest.approx(-1e3 * paper.wires[0].sag, abs=0.02)
    assert {trace["name"] for trace in one.data} >= {"tolerance at droppers: ±5 mm", "at droppers"}
    without = figures.height_figures(paper, None)[0]
    assert not any("tolerance" in trace["name"] for trace in without.data)


def test_a_line_in_a_plane_has_no_plan(paper: FormResult, curve: FormResult) -> None:
    assert figures.plan_figures(paper) == []
    names = {trace["name"] for part in figures.plan_figures(curve) for trace in part.data}
    assert {"contact wire", "messenger wire", "steady arm", "track"} <= names


def test_the_contact_wire_is_drawn_on_what_is_above_it(curve: FormResult) -> None:
    traces = figures.plan_figures(curve)[0].data
    wires = {trace["name"]: (i, trace["line"]["width"]) for i, trace in enumerate(traces) if "line" in trace}
    assert wires["contact wire"][0] > wires["messenger wire"][0]
    assert wires["contact wire"][1] < wires["messenger wire"][1]


def test_point_masses_are_marked_at_their_wires(
    solved: Callable[[str], FormResult], curve: FormResult
) -> None:
    line = solved("simple_60m")
    traces = [trace for part in figures.profile_figures(line) for trace in part.data]
    marks = [trace for trace in traces if trace["name"] == "point mass"]
    texts = [text for trace in marks for text in trace["text"]]
    assert len(texts) == 2  # two insulators, but none of the clamps of the eleven arms
    assert any("section insulator" in text and "mass 9 kg" in text for text in texts)
    contact = line.wires[0].profile
    at = float(np.interp(126.5, contact.chainage, contact.height))
    assert min(marks[0]["y"]) == pytest.approx(at, abs=1e-4)
    assert all(
        trace["name"] != "point mass" for part in figures.profile_figures(curve) for trace in part.data
    )


@pytest.mark.parametrize(("supports", "named"), [(5, 5), (12, 12), (13, 7), (101, 12)])
def test_of_many_supports_some_are_named(supports: int, named: int) -> None:
    places = {f"S{i}": 50.0 * i for i in range(supports)}
    shown = layout((0.0, 50.0 * supports), "height [m]", dict(reversed(places.items())))
    names = [name["text"] for name in shown["annotations"]]
    assert len(names) == named
    assert names[0] == "S0"
    assert [places[name] for name in names] == sorted(places[name] for name in names)
    assert len(shown["shapes"]) == supports


def test_slack_droppers_are_marked(in_space: FormResult, paper: FormResult) -> None:
    def named(result: FormResult) -> set[str]:
        return {trace["name"] for part in figures.profile_figures(result) for trace in part.data}

    assert "slack dropper" in named(in_space)
    assert "slack dropper" not in named(paper)


def test_sketch_of_every_span(solved: Callable[[str], FormResult]) -> None:
    for name, auxiliary in (("compound", True), ("bridge", False)):
        result = solved(name)
        line = Line.model_validate(result.inputs)
        drawn = sketch(result, line)
        assert sum(len(row.bays) for row in drawn.rows) == len(line.spans)
        assert drawn.auxiliary is auxiliary
        assert drawn.rows[0].bays[0].count == ("5 + 10 droppers" if auxiliary else "9 droppers")
        count = sum(len(bay.droppers) + len(bay.upper_droppers) for row in drawn.rows for bay in row.bays)
        assert count == result.droppers.x.size
        assert all(0.0 <= mast.x <= drawn.width for row in drawn.rows for mast in row.masts)
        assert all(
            row.masts[0].name == before.masts[-1].name
            for before, row in zip(drawn.rows, drawn.rows[1:], strict=False)
        )


@pytest.mark.parametrize("tolerance", [1e-2, 1e-3, 1e-4])
def test_lines_of_fewer_points_are_off_by_the_tolerance_at_most(curve: FormResult, tolerance: float) -> None:
    profile = curve.wires[1].profile
    x, y = profile.chainage, profile.height
    kept = simplified(x, y, tolerance, least=10)
    off = np.abs(np.interp(x, x[kept], y[kept]) - y).max()
    assert off <= tolerance
    assert kept[0] == 0
    assert kept[-1] == x.size - 1
    coarse = simplified(x, y, 100.0 * tolerance, least=10)
    assert coarse.size < kept.size
    assert np.abs(np.interp(x, x[coarse], y[coarse]) - y).max() > tolerance


def test_level_lines_have_points_to_point_at() -> None:
    x = np.linspace(0.0, 1.0, 5000)
    assert simplified(x, np.zeros(5000), 1e-3, least=30).size == 30
    assert simplified(x[:2], x[:2], 1e-3).tolist() == [0, 1]
