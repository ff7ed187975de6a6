"""Wires that are too slack for Newton's method: slackened to their tension, or to where they cannot be."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from catenaria.discretise import guess, wire_alone
from catenaria.discretise.from_line import contact_wire_setup, messenger_wire_setup
from catenaria.discretise.guess import guess_equilibrium
from catenaria.discretise.hung_wire import HungWire
from catenaria.discretise.wire_model import WireModel, build_wire_model
from catenaria.errors import InconsistentInputError, InfeasibleError, NotConvergedError, SingularError
from catenaria.formfinding import static_problem
from catenaria.formfinding.slacken import Slackened, slacken
from catenaria.formfinding.static_problem import find_rest, statics
from catenaria.line import Line
from catenaria.mechanics.loads.gravity import Ramp
from catenaria.workflow import solve

Variant = Callable[[Any], Line]

POSITIONS = (4.0, 13.5, 23.0, 32.5, 42.0, 51.5, 61.0)


def high(tension: float, tail: float = 5.0, height: float = 20.0) -> dict[str, Any]:
    """Return what makes the messenger of the example slack, high enough to sag."""
    span = {"length": 65.0, "droppers": {"positions": POSITIONS}, "contact_wire_height": 0.0}
    messenger = {"messenger_wire": {"height": height}}
    both = messenger | {"contact_wire": {"height": 0.0}}
    return {
        "spans": (span,) * 3,
        "supports": (both, messenger, messenger, both),
        "messenger_wire.tension.force": tension,
        "messenger_wire.tail": tail,
    }


def messenger(line: Line) -> WireModel:
    """Return the messenger under 86 N from each dropper."""
    heights = contact_wire_setup(line).droppers.target
    setup = messenger_wire_setup(line, np.full(heights.size, 86.0), heights)
    return build_wire_model(replace(setup, gravity_ramp=Ramp(0.0)))


def slackened(model: WireModel) -> Slackened:
    return slacken(model, model.system, guess_equilibrium)


def test_it_finds_what_newtons_method_finds(line: Line) -> None:
    model = messenger(line)
    z = guess_equilibrium(model)
    plain = find_rest(statics(model.system, z), z).y
    found = slackened(model)
    assert found.tension == model.setup.tension.force
    np.testing.assert_allclose(found.z[model.wire.nodes], plain[model.wire.nodes], atol=1e-8)
    assert not np.allclose(found.start.y, plain, atol=1e-3)  # it began elsewhere


def check_half_span(model: WireModel, z: np.ndarray, tension: float) -> None:
    """Check the moments of the left half of the middle span about its support, where the wire is level."""
    x, height = z[model.wire.nodes[:, 0]], z[model.wire.nodes[:, 2]]
    half = (x > 65.0) & (x < 97.5 + 1e-6)
    arc = np.hypot(np.diff(x[half]), np.diff(height[half]))
    arm = 0.5 * (x[half][1:] + x[half][:-1]) - 65.0
    weight = model.setup.section.rhoA * model.setup.g * float(arc @ arm)
    force = np.abs(z[model.droppers.clamp_force[7:11, 2]])
    carried = float(force[:3] @ np.array(POSITIONS[:3])) + 0.5 * float(force[3]) * 32.5
    s = np.linspace(z[model.clamp_s[10]], z[model.clamp_s[11]], 202)[
        1:-1
    ]  # between the middle dropper and the next
    r1 = model.wire.evaluate(z, s).r1
    H = float(np.mean(0.5 * model.wire.section.EA * (np.sum(r1**2, axis=1) - 1.0) * r1[:, 0]))
    kinks = float(np.abs(z[model.support_force[1, 2]])) + float(force[3])
    bending = 0.5 * kinks * np.sqrt(model.setup.section.EJ / H)  # F l/2 of a taut beam, over its kinks
    sag = 20.0 - height[half].min()
    assert pytest.approx((weight + carried - bending) / sag, rel=0.005) == H
    assert np.linalg.norm(z[model.end_force[1]]) == pytest.approx(tension, abs=1e-4)


@pytest.mark.parametrize("tension", [3000.0, 2200.0, 1600.0])
def test_a_very_slack_wire_is_found(variant: Variant, tension: float) -> None:
    """Sags of 3 m to 6 m in spans of 65 m."""
    model = messenger(variant(high(tension)))
    found = slackened(model)
    assert found.released.part == 1.0
    check_half_span(model, found.z, tension)
    lower = found.z.copy()
    lower[model.wire.nodes[:, 2]] -= 0.1
    with pytest.raises(AssertionError):
        check_half_span(model, lower, tension)


def test_the_result_says_how_it_was_found(variant: Variant) -> None:
    """At 100 m the droppers' weight doubles the load: the messenger sags by 11 m."""
    result = solve(variant(high(1400.0, tail=30.0, height=100.0)), method="direct")
    assert "the messenger wire slackened in" in result.stop_reason
    assert result.audit is not None
    assert np.abs(result.controls.error).max() < 0.01
    taut = solve(variant(high(15e3, height=100.0)), method="direct")
    assert "slackened" not in taut.stop_reason


def test_the_tension_that_is_reached_is_named(variant: Variant) -> None:
    """A hanging wire cannot have less than about 0.75 of the weight of a span, whatever its sag."""
    model = messenger(variant(high(800.0, tail=30.0, height=100.0)))
    with pytest.raises(NotConvergedError, match="800 N is the target that is not met") as caught:
        slackened(model)
    reached = caught.value.partial
    assert isinstance(reached, Slackened)
    z = reached.z
    droppers = float(np.abs(z[model.droppers.clamp_force[:7, 2]]).sum())
    span = 65.0 * model.setup.section.rhoA * model.setup.g + droppers
    assert 0.75 * span < reached.tension < span
    assert np.linalg.norm(z[model.end_force[1]]) == pytest.approx(reached.tension, rel=1e-6)
    assert "more tension" in caught.value.advice


def test_a_tail_that_is_too_short_is_named(variant: Variant) -> None:
    wanted = r"the messenger wire: .* of its tail of 0.5 m .* longer tail"
    with pytest.raises(InfeasibleError, match=wanted) as caught:
        solve(variant(high(3500.0, tail=0.5)), method="direct")
    assert isinstance(caught.value.partial, Slackened)
    longer = solve(variant(high(3500.0, tail=1.5)), method="direct")
    assert longer.wires[1].tension == pytest.approx(3500.0)


def test_a_tail_that_is_far_too_short_is_named_before_anything_is_solved(variant: Variant) -> None:
    with pytest.raises(InconsistentInputError, match=r"the messenger wire: .* tail longer than 0.5 m"):
        solve(variant(high(2000.0, tail=0.5)), method="direct")


def test_nothing_to_begin_with_is_a_failure_by_name(line: Line) -> None:
    model = messenger(line)

    def nowhere(hung: WireModel) -> np.ndarray:
        z = guess_equilibrium(hung)
        z[hung.wire.nodes[:, 2]] = 1e3 * np.sin(np.arange(hung.wire.knots.size))
        return z

    with pytest.raises(NotConvergedError, match="not even under 16 times the tension"):
        slacken(model, model.system, nowhere)


def test_the_dropper_that_is_farthest_from_its_target_is_named(
    line: Line, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Whatever fails: a crumpled guess from which no wire is found, whether tighter or not."""
    right = guess.guess_wire

    def off(hung: HungWire, z: np.ndarray) -> None:
        right(hung, z)
        z[hung.wire.nodes[:, 0]] *= 1.02  # 2 % of strain are 300 kN
        z[hung.wire.nodes[:, 2]] += 0.5 * np.sin(np.arange(hung.wire.knots.size))

    monkeypatch.setattr(wire_alone, "guess_wire", off)
    with pytest.raises(
        NotConvergedError, match=r"was the height of dropper \d in span \d, by .* m"
    ) as caught:
        solve(line, method="direct")
    assert caught.value.partial is not None
    assert "supports and wanted heights" in caught.value.advice


class Strict:
    """A check that refuses some of the systems that it is shown."""

    def __init__(self, refused: set[int]) -> None:
        self.refused, self.shown = refused, 0

    def __call__(self, *_: object) -> Callable[..., None]:
        self.shown += 1
        number = self.shown

        def check(*_: object) -> None:
            if number in self.refused:
                raise SingularError("something is free", "nothing")

        return check


def test_a_wire_that_is_refused_at_the_guess_only_is_found(
    line: Line, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Where a guess is poor its matrix may be singular although that at rest is not."""
    plain = solve(line, method="direct")
    monkeypatch.setattr(static_problem, "ParameterCheck", Strict({1}))
    again = solve(line, method="direct")
    assert "the contact wire slackened" in again.stop_reason
    np.testing.assert_allclose(again.droppers.length, plain.droppers.length, atol=1e-7)
    monkeypatch.setattr(static_problem, "ParameterCheck", Strict({1, 2}))
    with pytest.raises(SingularError, match="something is free"):
        solve(line, method="direct")
