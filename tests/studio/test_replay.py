"""The replay: films of the dynamic method, from straight wires to the form."""

from __future__ import annotations

import json

import numpy as np
import pytest

from catenaria import workflow
from catenaria.errors import UnsupportedError
from catenaria.line import Line
from catenaria.line.load import model_from
from catenaria.results import FormResult
from catenaria.results.film import Film
from catenaria.studio.documents import Document, example
from catenaria.studio.replay_plots import (
    error_figure,
    frame_count,
    frame_figure,
    largest,
    places,
    running,
    told,
)

FRAMES = 20


@pytest.fixture(scope="module")
def moved(paper: Document) -> tuple[FormResult, tuple[Film, ...]]:
    return workflow.replay(model_from(paper.tree, Line), frames=FRAMES)


def test_films_begin_straight_and_end_in_the_form(moved: tuple[FormResult, tuple[Film, ...]]) -> None:
    result, films = moved
    assert [film.step for film in films] == ["contact wire", "messenger wire"]
    for film, stage, history in zip(films, result.stages, result.histories, strict=True):
        own = slice(0, int(film.node_count[0]))
        assert film.time.size == FRAMES
        assert np.ptp(film.position[0, own, 2]) < 1e-12
        np.testing.assert_array_equal(film.position[-1], stage.position)
        np.testing.assert_array_equal(film.node_count, stage.node_count)
        np.testing.assert_allclose(film.error[-1], history.error[-1])
        assert (film.time[0], film.time[-1]) == (history.time[0], history.time[-1])
    assert np.ptp(films[1].position[-1, : int(films[1].node_count[0]), 2]) > 0.4


def test_filming_changes_nothing(moved: tuple[FormResult, tuple[Film, ...]], paper: Document) -> None:
    alone = workflow.solve(model_from(paper.tree, Line), method="dynamic", rebuild="none")
    np.testing.assert_array_equal(alone.droppers.cut_length, moved[0].droppers.cut_length)


def test_one_film_follows_the_other(moved: tuple[FormResult, tuple[Film, ...]]) -> None:
    films = moved[1]
    assert frame_count(films) == 2 * FRAMES
    assert places(films, 0) == [0, 0]
    assert places(films, FRAMES + 3) == [FRAMES - 1, 3]
    assert places(films, 2 * FRAMES - 1) == [FRAMES - 1, FRAMES - 1]
    assert [running(films, k) for k in (0, FRAMES - 1, FRAMES, 2 * FRAMES - 1)] == [0, 0, 1, 1]


def test_every_state_can_be_drawn(moved: tuple[FormResult, tuple[Film, ...]]) -> None:
    films = moved[1]
    drawn = [frame_figure(films, frame, False) for frame in range(2 * FRAMES)]
    json.dumps(drawn, allow_nan=False)
    json.dumps(error_figure(films, FRAMES, True), allow_nan=False)
    wires = [next(t for t in figure["data"] if t["name"] == "messenger wire") for figure in drawn]
    assert wires[0]["y"] == wires[FRAMES - 1]["y"]  # it waits for the contact wire
    assert min(wires[-1]["y"]) < min(wires[0]["y"]) - 0.4
    assert len({tuple(figure["layout"]["yaxis"]["range"]) for figure in drawn}) == 1


def test_errors_fall_and_are_told(moved: tuple[FormResult, tuple[Film, ...]]) -> None:
    films = moved[1]
    for film in films:
        assert largest(film, tensions=True)[-1] < 0.01 * largest(film, tensions=True).max()
    assert "mm" in told(films, 0)
    assert "dropper force" in told(films, 2 * FRAMES - 1)


def test_lines_in_space_are_refused_by_name() -> None:
    with pytest.raises(UnsupportedError, match="lies in space"):
        workflow.replay(model_from(example("curve_800m").tree, Line))
