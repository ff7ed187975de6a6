"""What a track may be."""

from __future__ import annotations

from typing import Any

import pytest
from pydantic import ValidationError

from catenaria.line import Curve, Gradient, Line, Track

CURVE: dict[str, Any] = {"start": 0.0, "length": 200.0, "radius": -800.0, "transition": 50.0, "cant": 0.1}


def errors(model: type[Any], data: object) -> list[tuple[tuple[str | int, ...], str]]:
    with pytest.raises(ValidationError) as caught:
        model.model_validate(data)
    return [(error["loc"], error["msg"]) for error in caught.value.errors()]


@pytest.mark.parametrize(
    ("change", "field", "told"),
    [
        ({"radius": 0.0}, "radius", "at least 100 m"),
        ({"radius": "-99 m"}, "radius", "at least 100 m"),
        ({"transition": "101 m"}, "transition", "at most 100 m"),
        ({"cant": "201 mm"}, "cant", "within 200 mm"),
        ({"cant": -1.5}, "cant", "within 200 mm"),
    ],
)
def test_impossible_curves(change: dict[str, Any], field: str, told: str) -> None:
    ((place, message),) = errors(Curve, CURVE | change)
    assert place == (field,)
    assert told in message


@pytest.mark.parametrize(
    "change", [{"radius": 100.0}, {"transition": 100.0}, {"cant": 0.2}, {"cant": -0.2}, {"transition": 0.0}]
)
def test_curves_that_are_just_possible(change: dict[str, Any]) -> None:
    """Negative control."""
    assert Curve.model_validate(CURVE | change).length == 200.0


@pytest.mark.parametrize(("start", "fits"), [(200.0, True), (199.9, False), (-300.0, False)])
def test_curves_do_not_overlap(start: float, fits: bool) -> None:
    track = {"curves": [CURVE, CURVE | {"start": start}]}
    if fits:
        assert len(Track.model_validate(track).curves) == 2
    else:
        ((place, message),) = errors(Track, track)
        assert place == ("curves", 1, "start")
        assert "200 m or more, where the curve before it ends" in message


def test_gradients_ascend_and_are_gentle() -> None:
    ((place, message),) = errors(
        Track, {"gradients": [{"start": 10, "slope": 0.01}, {"start": 10, "slope": 0}]}
    )
    assert place == ("gradients", 1, "start")
    assert "more than 10 m" in message
    ((place, message),) = errors(Gradient, {"start": 0, "slope": 5})
    assert place == ("slope",)
    assert "5 mm/m" in message
    assert Gradient.model_validate({"start": 0, "slope": "-40 mm/m"}).slope == -0.04


@pytest.mark.parametrize(("spacing", "fits"), [(1.5, True), ("1060 mm", True), (1500, False), (0.3, False)])
def test_rails_are_as_far_apart_as_rails_are(spacing: object, fits: bool) -> None:
    if fits:
        assert Track.model_validate({"rail_spacing": spacing}).rail_spacing > 1.0
    else:
        assert errors(Track, {"rail_spacing": spacing})[0][0] == ("rail_spacing",)


def test_the_alignment_follows_the_track(tree: dict[str, Any]) -> None:
    """Once it is known it is not made again, and another track has another one."""
    line = Line.model_validate(tree)
    assert line.alignment is line.alignment
    assert line.alignment.frames(100.0).origin[0].tolist() == [100.0, 0.0, 0.0]
    tree["track"] = {"gradients": [{"start": 0, "slope": 0.01}]}
    sloping = line.model_copy(update={"track": Line.model_validate(tree).track})
    assert sloping.alignment.frames(100.0).origin[0].tolist() == [100.0, 0.0, 1.0]
