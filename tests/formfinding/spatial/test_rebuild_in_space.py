"""What was found in space, built from its lengths, comes to rest where it was found; nothing else does."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from catenaria.formfinding.spatial.rebuild import rebuild_in_space
from catenaria.line import Line
from catenaria.results import FormResult

Change = dict[str, Any]
Find = Callable[[Line], FormResult]
Broken = Callable[[FormResult], FormResult]


@pytest.fixture(scope="module")
def found(everything: Line, find: Find) -> FormResult:
    return find(everything)


def check_comes_back(line: Line, result: FormResult) -> None:
    """Rounding: 1e-9 m of height, and a micronewton per newton of tension."""
    rebuilt = rebuild_in_space(line, result)
    assert np.abs(rebuilt.height.change).max() < 1e-9
    assert np.abs(rebuilt.messenger_height.change).max() < 1e-9
    assert np.abs(rebuilt.force.change).max() < 1e-6
    assert np.abs(rebuilt.tension.change).max() < 1e-6
    np.testing.assert_allclose(
        rebuilt.height_error, result.droppers.height - result.droppers.target_height, rtol=0.0, atol=1e-9
    )


def test_a_line_with_everything_comes_back(everything: Line, found: FormResult) -> None:
    roles = {wire.role for wire in found.wires}
    assert roles == {"contact wire", "messenger wire", "stitch wire", "mid-point anchor"}
    assert {"arm", "sliding", "spring", "clamped", "bracket"} == set(found.supports.kind)
    check_comes_back(everything, found)


def test_it_is_built_by_newtons_method_from_a_guess(everything: Line, found: FormResult) -> None:
    assert 2 <= rebuild_in_space(everything, found).iterations <= 12


def test_a_line_found_by_motion_comes_back(curved: Callable[..., Line], moved: FormResult) -> None:
    """Its heights are off by their bands; built from its lengths, it is where it was found nevertheless."""
    assert np.abs(moved.droppers.height_error).max() > 1e-8
    check_comes_back(curved(), moved)


def _shortened(result: FormResult) -> FormResult:
    length = result.droppers.unstressed_length.copy()
    length[7] -= 1e-6
    return replace(result, droppers=replace(result.droppers, unstressed_length=length))


def _shifted_clamp(result: FormResult) -> FormResult:
    coordinate = result.droppers.messenger_coordinate.copy()
    coordinate[7] += 1e-5
    return replace(result, droppers=replace(result.droppers, messenger_coordinate=coordinate))


def _moved_hinge(result: FormResult) -> FormResult:
    hinge = result.arms.hinge.copy()
    hinge[2] += [0.0, 1e-6, 0.0]
    return replace(result, arms=replace(result.arms, hinge=hinge))


def _shifted_tie(result: FormResult) -> FormResult:
    coordinate = result.ties.coordinate.copy()
    coordinate[0] += 1e-5
    return replace(result, ties=replace(result.ties, coordinate=coordinate))


def _longer_stitch_wire(result: FormResult) -> FormResult:
    wires = tuple(
        replace(wire, travel=wire.travel + 1e-6) if wire.role == "stitch wire" else wire
        for wire in result.wires
    )
    return replace(result, wires=wires)


def _pulled_further(result: FormResult) -> FormResult:
    first, *others = result.wires
    return replace(result, wires=(replace(first, travel=first.travel + 1e-6), *others))


@pytest.mark.parametrize(
    "broken",
    [_shortened, _shifted_clamp, _moved_hinge, _shifted_tie, _longer_stitch_wire, _pulled_further],
)
def test_what_is_built_otherwise_does_not_come_back(
    everything: Line, found: FormResult, broken: Broken
) -> None:
    with pytest.raises(AssertionError):
        check_comes_back(everything, broken(found))


BEAM: Change = {
    "length": 2.0,
    "side": "left",
    "youngs_modulus": 200e9,
    "area": 1e-3,
    "mass_per_length": 7.85,
    "bending_stiffness": 2e5,
}
KINDS: dict[str, Change] = {
    "rigid droppers": {"dropper.model": "rigid"},
    "strain measure": {
        "contact_wire.tension.measure": "strain",
        "messenger_wire.tension.measure": "strain",
    },
    "pulled at the start, measured at the end": {"contact_wire.tension.pulled": "start"},
    "no contact wire at a support": {"supports.1.contact_wire": None},
    "a span without droppers": {"spans.1": {"length": 60.0}},
    "two contact wires and an auxiliary messenger": {
        "second_contact_wire": {"droppers": "both", "spacing": 0.1},
        "auxiliary_messenger": {"conductor": "messenger", "tension": {"force": 9e3}, "tail": 3.0},
        "supports.*.auxiliary_messenger": {"height": 6.2},
        "supports.*.messenger_wire.height": 7.4,
        "spans.*.auxiliary": {"droppers": {"positions": [10.0, 24.0, 36.0, 50.0]}, "height": 6.15},
    },
    "cantilevers with friction": {
        "supports.*.messenger_wire": {
            "height": 6.7,
            "kind": "cantilever",
            "cantilever": BEAM,
            "friction": 0.1,
        },
    },
    "clamped everywhere": {"supports.*.messenger_wire.kind": "clamped"},
    "much friction": {"supports.*.messenger_wire.friction": 0.5},
    "soft springs": {
        "supports.*.messenger_wire": {
            "height": 6.7,
            "kind": "spring",
            "stiffness": 3e4,
            "lateral_stiffness": 3e4,
        },
    },
    "lifts": {"supports.*.contact_wire.arm.lift": 30.0},
    "no bending stiffness": {"conductors.messenger.bending_stiffness": 0.0},
    "short tails": {"contact_wire.tail": 0.1, "messenger_wire.tail": 0.1},
    "an even mesh": {"solver.mesh.even": 200},
    "high and low supports": {
        "supports.1.messenger_wire.height": 8.0,
        "supports.2.messenger_wire.height": 6.3,
    },
}
CURVE: Change = {
    "track": {
        "curves": [{"start": -50.0, "length": 600.0, "radius": -600.0, "transition": 70.0, "cant": 0.12}],
        "gradients": [{"start": -100.0, "slope": 0.01}],
    },
} | {f"supports.{i}.stagger": b for i, b in enumerate((0.2, -0.2, 0.25, -0.3))}


@pytest.mark.parametrize("kind", KINDS.values(), ids=KINDS)
def test_every_kind_of_line_is_found_and_comes_back(
    make: Callable[..., Line], find: Find, arm: Change, kind: Change
) -> None:
    """In a curve to the right on a gradient, within the dozen of iterations that are allowed."""
    held = {"supports.*.contact_wire": arm, "supports.*.contact_wire.arm.side": "right"}
    line = make(3, CURVE, held, kind)
    result = find(line)
    assert result.counters[0].steps <= 12
    check_comes_back(line, result)
