"""Lines that cannot be built are refused, with both methods, and the droppers are named."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from catenaria.errors import InfeasibleError
from catenaria.line import Line
from catenaria.workflow import solve

Change = dict[str, Any]
Vary = Callable[[Change], Line]


def spans(heights: tuple[float, ...]) -> Change:
    span = {
        "length": 65.0,
        "droppers": {"positions": (4.0, 13.5, 23.0, 32.5, 42.0, 51.5, 61.0)},
        "contact_wire_height": heights,
    }
    support = {"contact_wire": {"height": 0.0}, "messenger_wire": {"height": 1.5}}
    return {"spans": (span,), "supports": (support, support)}


LEVEL = (0.0,) * 7
DEEP = (0.0, 0.0, 0.0, -0.06, 0.0, 0.0, 0.0)
LOW = {"length": 20.0, "droppers": {"positions": (6.0, 14.0)}, "contact_wire_height": -0.2}
SHORT = spans(LEVEL) | {"spans": (LOW,), "solver.dynamic.integrator.max_steps": 2000}
CASES: dict[str, tuple[Change, str]] = {
    "pushed": (spans(DEEP), r"compression: 4 \(-10\d(\.\d+)? N\)\. .*pre-sag"),
    "pushed hard": (SHORT, r"compression: 1 \(-451.* N\), 2 \(-451.* N\)\."),
    "slack": (
        spans(LEVEL) | {"messenger_wire.tension.force": 4000.0},
        r"upside down: 3 \(.*\), 4 \(.*\), 5 \([^,]*\)\. .*tension",
    ),
    "long clamps": (
        spans(LEVEL) | {"dropper.clamp_height_top": 0.5, "dropper.clamp_height_bottom": 0.48},
        r"cut to nothing: 4 \(-0\.01.* m\)\. .*clamp heights",
    ),
}
THREE = spans(LEVEL)["spans"] + spans(DEEP)["spans"] * 2
ENDS = ({"contact_wire": {"height": 0.0}, "messenger_wire": {"height": 1.5}},) * 4
FEASIBLE: dict[str, Change] = {
    "pulled": spans((0.0, 0.0, 0.0, -0.02, 0.0, 0.0, 0.0)),
    "taut enough": spans(LEVEL) | {"messenger_wire.tension.force": 6000.0},
    "short clamps": spans(LEVEL) | {"dropper.clamp_height_top": 0.5, "dropper.clamp_height_bottom": 0.45},
}


@pytest.mark.parametrize("method", ["direct", "dynamic"])
@pytest.mark.parametrize(("change", "message"), CASES.values(), ids=CASES)
def test_what_cannot_be_built_is_refused(vary: Vary, change: Change, message: str, method: str) -> None:
    with pytest.raises(InfeasibleError, match=message):
        solve(vary(change), method=method)


@pytest.mark.parametrize("change", [spans(DEEP), SHORT], ids=["pushed", "pushed hard"])
def test_frictionless_droppers_in_compression_are_named_too(vary: Vary, change: Change) -> None:
    """Such a wire is not found, because a dropper that pushes topples; a taut wire says why."""
    with pytest.raises(InfeasibleError, match="compression"):
        solve(vary(change | {"dropper.joint": "frictionless"}))


def near(*x: float) -> Change:
    """Return a line whose droppers hold the contact wire level at the given places."""
    line = spans(LEVEL)
    return line | {"spans": (line["spans"][0] | {"droppers": {"positions": x}, "contact_wire_height": 0.0},)}


@pytest.mark.parametrize(
    ("change", "said"),
    [(near(10.0, 10.01, 30.0, 50.0), "too stiff"), (spans(DEEP), "a smaller pre-sag")],
    ids=["a centimetre apart", "pre-sag"],
)
def test_stiffness_is_told_from_pre_sag(vary: Vary, change: Change, said: str) -> None:
    """Level droppers are pushed by the stiffness of the wire, against which no lower tension helps."""
    with pytest.raises(InfeasibleError, match=f"compression: .*{said}"):
        solve(vary(change))


def test_droppers_farther_apart_are_not_pushed(vary: Vary) -> None:
    assert solve(vary(near(10.0, 11.0, 30.0, 50.0))).droppers.force_bottom.min() > 0.0


@pytest.mark.parametrize("change", FEASIBLE.values(), ids=FEASIBLE)
def test_what_can_just_be_built_is_not_refused(vary: Vary, change: Change) -> None:
    droppers = solve(vary(change)).droppers
    assert droppers.cut_length.min() > 0.0
    assert droppers.force_bottom.min() > 0.0
    assert min(droppers.cut_length.min(), droppers.force_bottom.min() / 200.0) < 0.3  # near the limit


def test_spans_are_named_and_the_error_carries_what_was_found(vary: Vary) -> None:
    """The tension of the advice would do: 10 % below it the line is found, 10 % above it is refused."""
    line = {"spans": THREE, "supports": ENDS}
    wanted = r"compression: 4 \(-10.* N\) in span 2; 4 \(-10.* N\) in span 3\. .* about ([\d.]+) kN"
    with pytest.raises(InfeasibleError, match=wanted) as caught:
        solve(vary(line))
    partial = caught.value.partial
    assert isinstance(partial, tuple)
    assert partial[0].setup.name == "contact wire"
    assert np.isfinite(partial[0].z).all()
    found = re.search(wanted, str(caught.value))
    assert found is not None
    limit = 1e3 * float(found[1])
    assert solve(vary(line | {"contact_wire.tension.force": 0.9 * limit})).droppers.force_bottom.min() > 0.0
    with pytest.raises(InfeasibleError):
        solve(vary(line | {"contact_wire.tension.force": 1.1 * limit}))
