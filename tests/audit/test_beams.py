"""The audit of wires of beams: their own energy, what it notices, and which physics it is not."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from catenaria.audit import audit_result
from catenaria.audit.beams import beam_force
from catenaria.audit.curve import Curve
from catenaria.audit.energy import elastic_force
from catenaria.audit.stated import Conductor
from catenaria.formfinding.finite_elements.registry import ELEMENT_METHODS
from catenaria.line import load_line
from catenaria.results import FormResult

EXAMPLE = Path(__file__).parents[2] / "examples" / "yang2017_three_span.yaml"
WIRE = Conductor("wire", 1.25e7, 311.0, 0.615)


@pytest.fixture(scope="module")
def beams() -> FormResult:
    return ELEMENT_METHODS["adjusted lengths"](None).find_form(load_line(EXAMPLE))


@pytest.fixture
def bent() -> Curve:
    """Three elements of a wire that turns by some degrees and is stretched unevenly."""
    s = np.array([0.0, 0.4, 1.0, 1.7])
    angle = np.array([0.0, 0.05, 0.02, -0.04])
    direction = np.column_stack((np.cos(angle), np.zeros(4), np.sin(angle)))
    r = np.vstack((np.zeros(3), np.cumsum(np.diff(s)[:, None] * direction[1:], axis=0))) * 1.001
    return Curve(s, r, 1.001 * direction)


def test_results_of_beams_pass(beams: FormResult) -> None:
    audit = audit_result(beams)
    assert audit.findings == ()
    equilibrium = audit.name.index("residual of nodes")
    assert audit.deviation[equilibrium] < 0.1 * audit.allowed[equilibrium]


@pytest.mark.parametrize("physics", ["bending", "string"])
def test_it_is_not_another_physics(beams: FormResult, physics: str) -> None:
    assert not audit_result(replace(beams, physics=physics)).passed


def move(beams: FormResult, change: Callable[[np.ndarray, np.ndarray], None]) -> FormResult:
    """Change positions and slopes of the messenger's nodes."""
    contact, messenger = beams.stages
    position, slope = messenger.position.copy(), messenger.slope.copy()
    change(position, slope)
    return replace(beams, stages=(contact, replace(messenger, position=position, slope=slope)))


def _raised(position: np.ndarray, slope: np.ndarray) -> None:
    position[80, 2] += 1e-6


def _shifted(position: np.ndarray, slope: np.ndarray) -> None:
    position[80, 0] += 1e-8


def _turned(position: np.ndarray, slope: np.ndarray) -> None:
    slope[80, 2] += 1e-5


@pytest.mark.parametrize("change", [_raised, _shifted, _turned])
def test_a_moved_node_is_noticed(beams: FormResult, change: Callable[[np.ndarray, np.ndarray], None]) -> None:
    findings = audit_result(move(beams, change)).findings
    assert any(finding.startswith("residual of nodes") for finding in findings)


def test_a_wrong_tension_in_the_profile_is_noticed(beams: FormResult) -> None:
    contact, messenger = beams.wires
    profile = replace(messenger.profile, tension=1.0001 * messenger.profile.tension)
    wrong = replace(beams, wires=(contact, replace(messenger, profile=profile)))
    assert any(finding.startswith("profile, tension") for finding in audit_result(wrong).findings)


def test_a_straight_beam_is_a_straight_wire() -> None:
    """Strain is the same everywhere in both, and both have no curvature; slopes are the node's own anyway."""
    direction = np.array([0.8, 0.0, 0.6])
    s = np.array([0.0, 0.7, 1.5])
    curve = Curve(s, 1.002 * np.outer(s, direction), 1.002 * np.tile(direction, (3, 1)))
    size = WIRE.EA * 0.002
    beam, wire = beam_force(curve, WIRE, 0.0), elastic_force(curve, WIRE)
    assert beam[:, [1, 3]] == pytest.approx(0.0, abs=1e-9 * size)
    wire[:, [0, 2]] += (
        np.stack((-wire[:, 1] - wire[:, 3], wire[:, 1] + wire[:, 3]), 1) / curve.L[:, None, None]
    )
    wire[:, [1, 3]] = 0.0
    np.testing.assert_allclose(beam, wire, rtol=0, atol=1e-9 * size)


def test_nodes_that_only_turn_are_in_balance_as_before(bent: Curve) -> None:
    """Inner forces have no resultant force or moment, and do not act on the sizes of slopes."""
    force = beam_force(bent, WIRE, 0.0)
    total = force[:, 0] + force[:, 2]
    arms = np.cross(bent.r[:-1], force[:, 0]) + np.cross(bent.r[1:], force[:, 2])
    moment = arms + np.cross(bent.r1[:-1], force[:, 1]) + np.cross(bent.r1[1:], force[:, 3])
    np.testing.assert_allclose(total, 0.0, atol=1e-7)
    np.testing.assert_allclose(moment, 0.0, atol=1e-7)
    along = np.einsum("ni,ni->n", force[:, 1], bent.r1[:-1])
    np.testing.assert_allclose(along, 0.0, atol=1e-9)
