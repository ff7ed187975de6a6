"""The lines among the examples: what they have between them, and that they solve as they stand."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from catenaria.cli.new import Kind
from catenaria.discretise.spatial.lay_out import lay_out
from catenaria.line import Line, load_line
from catenaria.workflow import solve

EXAMPLES = Path(__file__).parents[2] / "examples"


def example(kind: Kind) -> Line:
    return load_line(EXAMPLES / f"{kind}.yaml")


@pytest.fixture(scope="module")
def lines() -> tuple[Line, ...]:
    return tuple(example(kind) for kind in Kind)


def test_they_are_as_long_as_real_ones(lines: tuple[Line, ...]) -> None:
    assert all(10 <= len(line.spans) <= 25 and not line.plane for line in lines)


def test_every_kind_of_wire_and_support_appears(lines: tuple[Line, ...]) -> None:
    layouts = [lay_out(line) for line in lines]
    assert {wire.role for layout in layouts for wire in layout.wires} == {
        "contact wire",
        "auxiliary messenger",
        "messenger wire",
        "stitch wire",
        "mid-point anchor",
    }
    assert {kind for layout in layouts for kind in layout.holds.kind} == {
        "sliding",
        "clamped",
        "spring",
        "cantilever",
        "bracket",
        "arm",
    }
    assert any(layout.holds.hinged.any() for layout in layouts)
    assert any(np.isfinite(layout.holds.lift).any() for layout in layouts)
    assert any(layout.holds.friction.any() for layout in layouts)


def test_every_other_feature_appears(lines: tuple[Line, ...]) -> None:
    arms = [
        support.contact_wire.arm.registration
        for line in lines
        for support in line.supports
        if support.contact_wire and support.contact_wire.arm
    ]
    assert set(arms) == {"pull-off", "push-off"}
    assert {line.dropper.model for line in lines} == {"cables", "bar", "rigid"}
    assert {line.contact_wire.tension.pulled for line in lines} == {"both", "start"}
    devices = [line.contact_wire.tension.device for line in lines]
    assert {device.kind for device in devices} == {"weight", "spring", "hydraulic"}
    assert any(device.efficiency < 1.0 for device in devices)
    assert any(line.contact_wire.wear > 0.0 for line in lines)
    assert any(line.contact_wire.anchor_end for line in lines)
    assert any(line.track.curves for line in lines)
    assert any(line.track.gradients for line in lines)
    assert any(span.pre_sag > 0.0 for line in lines for span in line.spans)
    assert any(span.pre_sag_per_mille for line in lines for span in line.spans)
    assert any(not span.droppers.x for line in lines for span in line.spans)
    assert {"section insulator", "insulator"} <= {mass.name for line in lines for mass in line.point_masses}


@pytest.mark.parametrize("kind", Kind)
def test_it_solves_as_it_stands(kind: Kind) -> None:
    result = solve(example(kind), "direct")
    assert result.audit is not None
    assert result.audit.passed
    assert result.rebuilt is not None
    assert result.rebuilt.findings() == ()
    assert sum(counter.steps for counter in result.counters) <= 12
    assert result.droppers.force_top.min() > 0.0
    assert result.droppers.length.min() > 0.25
    assert np.all(result.arms.radial > result.arms.minimum_radial)
    assert np.all(result.arms.minimum_radial > 0.0)
