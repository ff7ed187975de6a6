"""The replay: films of the dynamic method, from straight wires to the form."""

from __future__ import annotations

import json
from base64 import b64decode
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from catenaria import workflow
from catenaria.line import Line
from catenaria.line.load import model_from
from catenaria.report.html.figures import support_places
from catenaria.results import FormResult
from catenaria.results.film import Film, Polylines
from catenaria.studio.documents import Document, example
from catenaria.studio.replay_plots import (
    error_figure,
    frame_count,
    frame_figures,
    places,
    running,
    told,
)

FRAMES = 20
NOWHERE: dict[str, float] = {}

Moved = tuple[FormResult, tuple[Film, ...]]


@pytest.fixture(scope="module")
def moved(paper: Document) -> Moved:
    return workflow.replay(model_from(paper.tree, Line), frames=FRAMES)


@pytest.fixture(scope="module")
def stitched() -> Moved:
    """Move three spans of a line in space."""
    tree = example("stitched_re250").tree
    tree |= {"spans": tree["spans"][:3], "supports": tree["supports"][:4]}
    return workflow.replay(model_from(tree, Line), frames=FRAMES)


def test_films_begin_straight_and_end_in_the_form(moved: Moved) -> None:
    result, films = moved
    assert [film.step for film in films] == ["contact wire", "messenger wire"]
    for film, stage, history in zip(films, result.stages, result.histories, strict=True):
        own = film.wires.nodes(0)
        assert film.time.size == FRAMES
        assert np.ptp(film.wires.height[0]) < 1e-12
        for lines, nodes in ((film.wires, stage.position[own]), (film.droppers, stage.position[own.stop :])):
            np.testing.assert_array_equal(lines.chainage[-1], nodes[:, 0])
            np.testing.assert_array_equal(lines.lateral[-1], nodes[:, 1])
            np.testing.assert_array_equal(lines.height[-1], nodes[:, 2])
        counts = np.concatenate((film.wires.node_count, film.droppers.node_count))
        np.testing.assert_array_equal(counts, stage.node_count)
        np.testing.assert_allclose(film.error[-1], history.error[-1])
        assert (film.time[0], film.time[-1]) == (history.time[0], history.time[-1])
        assert (film.gravity[0], film.gravity[-1]) == (0.0, 1.0)
    assert np.ptp(films[1].wires.height[-1]) > 0.4


def test_filming_changes_nothing(moved: Moved, paper: Document) -> None:
    alone = workflow.solve(model_from(paper.tree, Line), method="dynamic", rebuild="none")
    np.testing.assert_array_equal(alone.droppers.cut_length, moved[0].droppers.cut_length)


def test_one_film_follows_the_other(moved: Moved) -> None:
    films = moved[1]
    assert frame_count(films) == 2 * FRAMES
    assert [running(films, k) for k in (0, FRAMES - 1, FRAMES, 2 * FRAMES - 1)] == [
        (0, 0),
        (0, FRAMES - 1),
        (1, 0),
        (1, FRAMES - 1),
    ]
    first, second = films
    assert places(films, 3) == [(first, 3), (second, 0)]
    assert places(films, FRAMES + 3) == [(first, FRAMES - 1), (second, 3)]


def test_of_several_films_of_the_same_wires_one_is_shown(stitched: Moved) -> None:
    (film,) = stitched[1]
    later = replace(film, step="line with 2 slack droppers")
    assert places((film, later), 3) == [(film, 3)]
    assert places((film, later), FRAMES + 3) == [(later, 3)]
    assert told((film, later), FRAMES).startswith("2 of 2: line with 2 slack droppers, 0.0 s")


def numbers(packed: dict[str, str]) -> NDArray[np.floating]:
    """Return the numbers of a trace as Plotly reads them."""
    return np.frombuffer(b64decode(packed["bdata"]), packed["dtype"])


def heights(films: tuple[Film, ...], frame: int, name: str) -> list[float]:
    """Return the heights of a wire in the drawing of a frame."""
    side = frame_figures(films, frame, NOWHERE, False)[0]
    y = numbers(next(trace for trace in side["data"] if trace["name"] == name)["y"])
    return y[~np.isnan(y)].tolist()


def test_every_state_can_be_drawn(moved: Moved) -> None:
    films = moved[1]
    drawn = [frame_figures(films, frame, support_places(moved[0]), False) for frame in range(2 * FRAMES)]
    json.dumps(drawn, allow_nan=False)
    json.dumps(error_figure(films, FRAMES, True), allow_nan=False)
    wires = [heights(films, frame, "messenger wire") for frame in (0, FRAMES - 1, -1 + 2 * FRAMES)]
    assert wires[0] == wires[1]  # it waits for the contact wire
    assert min(wires[2]) < min(wires[0]) - 0.4
    assert (
        len({tuple(figure["layout"]["yaxis"]["range"]) for (figure,) in drawn}) == 1
    )  # and there is no plan


def test_a_line_in_space_is_drawn_from_the_side_and_from_above(stitched: Moved) -> None:
    result, films = stitched
    last = FRAMES - 1
    side, plan = frame_figures(films, last, support_places(result), True)
    json.dumps([side, plan, error_figure(films, last, True)], allow_nan=False)
    names = ["contact wire", "messenger wire", "stitch wire"]
    assert [trace["name"] for trace in side["data"]] == ["dropper", *names]
    assert [trace["name"] for trace in plan["data"]] == ["track", *names]
    stitches = next(trace for trace in side["data"] if trace["name"] == "stitch wire")
    assert np.isnan(numbers(stitches["y"])).sum() == 1  # two wires in one trace
    droppers = side["data"][0]
    assert np.isnan(numbers(droppers["y"])).sum() == result.droppers.x.size - 1
    assert numbers(droppers["y"])[:2] == pytest.approx(
        [result.droppers.height[0], result.droppers.messenger_height[0]], abs=1e-4
    )
    lowest = min(result.wire("messenger wire").profile.height)
    assert min(heights(films, last, "messenger wire")) == pytest.approx(lowest, abs=1e-3)
    assert min(heights(films, 0, "messenger wire")) > lowest + 0.3
    assert "var(" not in json.dumps(side)


def longer(film: Film, times: int) -> Film:
    """Return one state of a film as if the line were so many times as long."""

    def repeated(lines: Polylines) -> Polylines:
        far = np.arange(times)[:, None] * (lines.chainage[:1].max() + 1.0)
        each = [lines.nodes(k) for k in range(lines.node_count.size)]
        return Polylines(
            lines.node_count * times,
            np.concatenate([(lines.chainage[:1, own] + far).ravel() for own in each])[None],
            np.concatenate([np.tile(lines.lateral[0, own], times) for own in each])[None],
            np.concatenate([np.tile(lines.height[0, own], times) for own in each])[None],
        )

    rest = {"time": film.time[:1], "gravity": film.gravity[:1], "error": film.error[:1]}
    return replace(film, wires=repeated(film.wires), droppers=repeated(film.droppers), **rest)


def test_a_frame_of_a_long_line_is_small(stitched: Moved) -> None:
    long = longer(stitched[1][0], 10)
    assert long.wires.node_count[:2].min() > 2000
    figures = [*frame_figures((long,), 0, NOWHERE, False), error_figure((long,), 0, False)]
    assert len(json.dumps(figures, separators=(",", ":"))) < 100e3
    whole = [long.wires.chainage, long.wires.height, long.wires.chainage, long.wires.lateral]
    assert len(json.dumps([np.round(values, 3).tolist() for values in whole])) > 100e3


def test_errors_fall_and_are_told(moved: Moved) -> None:
    films = moved[1]
    for film in films:
        tension = np.abs(film.error[:, [of == "tension" for of in film.control_quantity]]).max(axis=1)
        assert tension[-1] < 0.01 * tension.max()
    first, last = told(films, 0), told(films, 2 * FRAMES - 1)
    assert first.startswith("1 of 2: contact wire, 0.0 s · without gravity · tension error 15000.0 N")
    assert "height error 0.000 mm" in first
    assert "% of gravity" in told(films, 1)
    assert "dropper force error 0.0" in last
    assert last.endswith("at rest")


@pytest.mark.parametrize("frame", [0, 7, FRAMES - 1])
def test_the_cursor_is_at_the_state_and_errors_are_those_of_the_film(stitched: Moved, frame: int) -> None:
    (film,) = stitched[1]
    figure = error_figure((film,), frame, False)
    assert (figure["layout"]["shapes"][-1]["x0"], figure["layout"]["yaxis"]["type"]) == (frame, "log")
    tension, height = figure["data"]
    assert (tension["name"], height["name"]) == ("tension [N]", "height at droppers [mm]")
    is_height = np.array(film.control_quantity) == "height"
    assert numbers(tension["y"])[-1] == pytest.approx(np.abs(film.error[-1, ~is_height]).max())
    assert numbers(height["y"])[-1] == pytest.approx(1e3 * np.abs(film.error[-1, is_height]).max())
