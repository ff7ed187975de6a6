"""What happens at one place: a push, a missing dropper, a support that has moved."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from catenaria.discretise.spatial.loaded import material_at, point_load

Make = Callable[..., Any]

T, L = 15e3, 60.0


@pytest.mark.parametrize("a", [10.0, 30.0, 45.0])
def test_a_pushed_string(make: Make, a: float) -> None:
    """Alone, a taut wire rises by F a (L - a) / (T L), less what bending rounds off, F/(2 T) sqrt(EJ/T)."""
    force = 50.0
    pushed = make((L,), ()).under(push=[{"chainage": a, "force": force}]).pushed
    string = force * a * (L - a) / (T * L)
    rounded = force / (2.0 * T) * np.sqrt(2.0 / T)
    assert pushed.uplift[0] == pytest.approx(string - rounded, rel=2e-3)
    assert pushed.uplift[0] != pytest.approx(1.01 * string, rel=2e-3)


def test_without_nodes_at_the_push_the_wire_would_be_too_stiff(make: Make) -> None:
    """An element of some metres cannot bend as sharply: the uplift is too small by about F h/(16 T)."""
    line, string = make((L,), ()), 50.0 * 30.0 * 30.0 / (T * L)
    model = line.built.model
    s = material_at(model, 0, line.line.alignment, np.array([30.0]))
    load = point_load(model, 0, s, np.array([[0.0, 0.0, 50.0]]))[0]
    coarse = line.built.under(load).points(0, s)[0, 2] - line.built.at_rest.points(0, s)[0, 2]
    fine = line.under(push=[{"chainage": 30.0, "force": 50.0}]).pushed.uplift[0]
    h = float(model.wires[0].L[model.wires[0].locate(s)][0])
    assert 0.5 < (string - coarse) / (50.0 * h / (16.0 * T)) < 1.5
    assert string - fine < 0.1 * (string - coarse)


def test_a_push_on_the_messenger(make: Make) -> None:
    case = make((L,), ()).under(push=[{"chainage": 30.0, "force": 50.0, "wire": "messenger wire"}])
    assert case.pushed.wire == ("messenger wire",)
    assert case.pushed.uplift[0] == pytest.approx(50.0 * 30.0 * 30.0 / (12e3 * L), rel=3e-3)


def test_an_uplift_is_counted_from_the_case_without_push(make: Make) -> None:
    """Where the weather has moved the wire does not count."""
    line, push = make(), [{"chainage": 90.0, "force": 100.0}]
    alone, warm = line.under(push=push), line.under(push=push, ice={"messenger_wire": 3.0})
    lowered = line.under(ice={"messenger_wire": 3.0}).state.droppers.height - line.before.droppers.height
    assert warm.pushed.uplift[0] == pytest.approx(alone.pushed.uplift[0], rel=0.2)
    assert lowered.min() < -0.03


def test_droppers_near_a_strong_push_go_slack(make: Make) -> None:
    line = make()
    weak, strong = (line.under(push=[{"chainage": 90.0, "force": f}]).state.droppers for f in (20.0, 300.0))
    assert not weak.slack.any()
    assert strong.slack.any()
    assert np.all(strong.force[strong.slack] == 0.0)
    assert set(strong.span[strong.slack].tolist()) == {2}


def check_taken_over(line: Any, case: Any, span: int, number: int) -> None:
    """Its neighbours take over what a missing dropper has carried, others next to nothing."""
    before, after = line.before.droppers, case.state.droppers
    i = int(np.flatnonzero((before.span == span) & (before.number == number))[0])
    more = after.force - before.force
    assert after.force[i] == 0.0
    near = more[i - 1] + more[i + 1]
    assert more[i - 1] > 0.0
    assert more[i + 1] > 0.0
    assert near == pytest.approx(before.force[i], rel=0.35)
    others = np.delete(more, [i - 1, i, i + 1])
    assert np.abs(others).max() < 0.2 * before.force[i]


def test_neighbours_of_a_missing_dropper(make: Make) -> None:
    line = make()
    case = line.under(broken_droppers=[{"span": 2, "number": 3}])
    check_taken_over(line, case, 2, 3)
    assert case.state.droppers.broken.sum() == 1
    assert not case.state.droppers.slack.any()
    with pytest.raises(AssertionError):
        check_taken_over(line, line.under(), 2, 3)
    with pytest.raises(AssertionError):
        check_taken_over(line, line.under(broken_droppers=[{"span": 2, "number": 2}]), 2, 3)


def test_weight_is_kept_when_a_dropper_breaks(make: Make) -> None:
    """Supports bear less by the weight of that dropper: what hangs on a wire's ends hardly changes."""
    line = make()
    case = line.under(broken_droppers=[{"span": 2, "number": 3}])
    i = int(np.flatnonzero((line.before.droppers.span == 2) & (line.before.droppers.number == 3))[0])
    weight = 0.089 * 9.80665 * line.result.droppers.length[i]
    less = float(np.sum(case.state.supports.force_z - line.before.supports.force_z))
    assert less == pytest.approx(weight, abs=0.02)
    assert weight > 0.5


@pytest.mark.parametrize(("way", "axis"), [("vertical", "height"), ("lateral", "stagger")])
def test_a_moved_support_takes_its_wire_along(make: Make, way: str, axis: str) -> None:
    """Alone, a taut wire is displaced linearly to the next supports."""
    line = make((60.0, 60.0), ())
    moved = [{"support": "S3", "wire": "contact wire", way: 0.02}]
    case = line.under(moved_supports=moved)
    by = getattr(case.state.supports, axis) - getattr(line.before.supports, axis)
    held = np.array([name == "contact wire" for name in line.before.supports.wire])
    np.testing.assert_allclose(by[held], [0.0, 0.0, 0.02, 0.0], atol=1e-6)
    np.testing.assert_allclose(by[~held], 0.0, atol=1e-6)
    name = "height" if axis == "height" else "lateral"
    was, now = (getattr(state.wires[0], name) for state in (line.before, case.state))
    middle = [float(np.interp(30.0, line.before.wires[0].chainage, values)) for values in (was, now)]
    assert middle[1] - middle[0] == pytest.approx(0.01, rel=5e-3)


def test_both_wires_of_a_support_move_unless_one_is_named(make: Make) -> None:
    line = make((60.0, 60.0), ())
    case = line.under(moved_supports=[{"support": "S3", "vertical": 0.02}])
    by = case.state.supports.height - line.before.supports.height
    at = np.array([name == "S3" for name in line.before.supports.support])
    np.testing.assert_allclose(by[at], 0.02, atol=1e-6)
    np.testing.assert_allclose(by[~at], 0.0, atol=1e-6)


TUBE = {"length": 3.0, "side": "left", "youngs_modulus": 210e9, "area": 2138e-6}
TUBE |= {"mass_per_length": 16.8, "bending_stiffness": 657e3}
KINDS = [
    {"kind": "sliding"},
    {"kind": "clamped"},
    {"kind": "bracket"},
    {"kind": "spring", "stiffness": 500e3},
    {"kind": "cantilever", "cantilever": TUBE},
]


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind["kind"])
def test_every_kind_of_support_moves(make: Make, kind: dict[str, Any]) -> None:
    """Springs and cantilevers give way a little to what the moved wire weighs more or less."""
    supports = make().line.model_dump(exclude_none=True)["supports"]
    for support in supports:
        support["messenger_wire"] = {"height": 6.7, **kind}
    line = make(supports=supports)
    case = line.under(moved_supports=[{"support": "S2", "vertical": -0.01}])
    by = case.state.supports.height - line.before.supports.height
    names = zip(line.before.supports.support, line.before.supports.wire, strict=True)
    at = np.array([name == ("S2", "messenger wire") for name in names])
    assert by[at][0] == pytest.approx(-0.01, rel=0.05)
    drop = case.state.droppers.height - line.before.droppers.height
    assert drop.min() < -0.006
