"""Temperature: strokes of devices, tensions between fixed ends, springs; against closed forms."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from scipy.optimize import brentq

from catenaria.discretise.spatial.loaded import warmed
from catenaria.loading.rest import rest_when_warmed

Make = Callable[..., Any]

ALPHA, G = 17e-6, 9.80665
FIXED = {"force": 15e3, "device": {"kind": "fixed"}}
PIECES = (3.0, 3.0, 3.0, 60.0, 3.0)  # tail, short span with a dropper, span, tail


def fixed_line(make: Make) -> Any:
    wire = {"conductor": "contact", "tension": FIXED, "tail": 3.0}
    return make((60.0,), (), contact_wire=wire)


def state_change(H1: float, warming: float, EA: float, w: float, alpha: float = ALPHA) -> float:
    """Return the tension of taut strings between fixed ends after a change of temperature.

    The state-change equation: what the wire grows by heat and by less force is what its sag takes up.
    """
    slack = w**2 * sum(a**3 for a in PIECES) / 24.0 / sum(PIECES)

    def gap(H2: float) -> float:
        return H2 - H1 + EA * alpha * warming - EA * slack * (1.0 / H2**2 - 1.0 / H1**2)

    return float(brentq(gap, 1e3, 5e4))


@pytest.mark.parametrize("warming", [30.0, -20.0])
def test_tension_between_fixed_ends(make: Make, warming: float) -> None:
    line = fixed_line(make)
    state = line.under(temperature={"change": warming}).state
    expected = state_change(15e3, warming, 14.4e6, 1.07 * G)
    change = state.wires[0].force_end - line.before.wires[0].force_end
    assert change == pytest.approx(expected - 15e3, rel=6e-3)
    assert abs(change) > 4e3
    for wrong in (
        state_change(15e3, warming, 14.4e6, 0.0),  # without sag it is EA alpha dT alone
        state_change(15e3, warming, 14.4e6, 1.07 * G, alpha=1.2e-5),
    ):
        assert change != pytest.approx(wrong - 15e3, rel=6e-3)


def test_without_sag_it_is_the_heat_alone() -> None:
    assert state_change(15e3, 10.0, 14.4e6, 0.0) == pytest.approx(15e3 - 14.4e6 * ALPHA * 10.0)


def check_stroke(line: Any, wire: int, warming: float, alpha: float = ALPHA) -> None:
    """A weighted wire keeps its force and gives what it grows to its devices, half to either."""
    case = line.under(temperature={"change": warming})
    was, now = line.before.wires[wire], case.state.wires[wire]
    length = line.result.wires[wire].profile.s[-1]
    assert now.force_end == pytest.approx(was.force_end, rel=1e-9)
    assert 2.0 * (now.travel - was.travel) == pytest.approx(alpha * warming * length, rel=3e-3)


@pytest.mark.parametrize("wire", [0, 1])
def test_weights_follow_what_a_wire_grows(make: Make, wire: int) -> None:
    line = make()
    check_stroke(line, wire, 40.0)
    check_stroke(line, wire, -40.0)
    with pytest.raises(AssertionError):
        check_stroke(line, wire, 40.0, alpha=1.2e-5)


def test_one_device_takes_all_of_it(make: Make) -> None:
    wire = {"conductor": "contact", "tension": {"force": 15e3, "pulled": "end"}, "tail": 3.0}
    line = make((60.0,), (), contact_wire=wire)
    case = line.under(temperature={"change": 40.0})
    stroke = case.state.wires[0].travel - line.before.wires[0].travel
    strained = line.result.wires[0].profile.s[-1] * (1.0 + 15e3 / 14.4e6)
    assert stroke == pytest.approx(ALPHA * 40.0 * strained, rel=3e-4)


def test_a_spring_gives_way(make: Make) -> None:
    spring = {"kind": "spring", "stiffness": 50e3}
    wire = {
        "conductor": "contact",
        "tension": {"force": 15e3, "pulled": "end", "device": spring},
        "tail": 3.0,
    }
    line = make((60.0,), (), contact_wire=wire)
    was, now = line.before.wires[0], line.under(temperature={"change": 40.0}).state.wires[0]
    stroke = now.travel - was.travel
    assert was.force_end - now.force_end == pytest.approx(50e3 * stroke, rel=1e-6)
    assert 0.01 < stroke < ALPHA * 40.0 * 72.0


def test_temperature_is_counted_from_the_reference(make: Make) -> None:
    line = make(reference_temperature=10.0)
    actual = line.under(temperature={"actual": 35.0})
    assert actual.warming == 25.0
    change = line.under(temperature={"change": 25.0})
    np.testing.assert_array_equal(actual.state.droppers.height, change.state.droppers.height)
    assert np.abs(change.state.droppers.height - line.before.droppers.height).max() > 1e-5


def test_droppers_grow_too(make: Make) -> None:
    """Between wires whose forces do not change, a longer dropper lets the contact wire down."""
    line = make()
    cold = make(conductors=line.line.model_dump()["conductors"] | {"dropper": _without_expansion(line)})
    drop = line.under(temperature={"change": 40.0}).state.droppers.height - line.before.droppers.height
    other = cold.under(temperature={"change": 40.0}).state.droppers.height - cold.before.droppers.height
    grown = ALPHA * 40.0 * line.result.droppers.length
    share = (other - drop) / grown
    assert np.all(share > 0.0)
    assert np.all(share < 1.2)


def _without_expansion(line: Any) -> dict[str, Any]:
    conductor = line.line.conductor("dropper").model_dump(exclude_none=True)
    return conductor | {"thermal_expansion": 0.0}


def test_steps_of_temperature_lead_where_one_step_leads(make: Make) -> None:
    line, warming = make(), 35.0
    stepped = rest_when_warmed(line.built, warming)
    built = line.built
    model = warmed(built.model, warming, built.expansion.tolist(), built.dropper_expansion)
    at_once = built.under(model=model).z
    place = model.wires[0].nodes[:, :3]
    np.testing.assert_allclose(stepped[place], at_once[place], atol=1e-8)
    other = rest_when_warmed(built, 34.9)
    assert np.abs(other[place] - at_once[place]).max() > 1e-5


@pytest.mark.parametrize("warming", [80.0, -80.0])
def test_more_than_takes_all_strain_from_a_wire(make: Make, warming: float) -> None:
    """Between devices a wire gives way; 80 K are more than the strain of either wire."""
    line = make(stagger=(0.2, -0.2, 0.2, -0.2))
    case = line.under(temperature={"change": warming})
    assert 17e-6 * 80.0 > 15e3 / 14.4e6
    np.testing.assert_allclose(case.state.wires[0].force_end, 15e3, rtol=1e-9)
    stroke = case.state.wires[0].travel - line.before.wires[0].travel
    assert 2.0 * stroke == pytest.approx(ALPHA * warming * line.result.wires[0].profile.s[-1], rel=4e-3)
