"""Wind: its force on wires, and where it blows them, against parabolas and the textbook."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from catenaria.loading.wind import drag

Make = Callable[..., Any]

AIR = {"speed": 20.0, "air_density": 1.2, "drag": 1.0, "gust_factor": 1.5}
PRESSURE = 0.5 * 1.2 * 20.0**2 * 1.5
DIAMETER = 1.15 * math.sqrt(4.0 * 120e-6 / math.pi)


def worst(blown: Any, way: str) -> float:
    """Return by what part the textbook misses the solved position in the worst of the long spans."""
    long = blown.length > 10.0
    return float(np.max(np.abs(getattr(blown, way) / blown.solved - 1.0)[long]))


def test_force_on_a_wire(make: Make) -> None:
    line = make((60.0,), ())
    case = line.under(wind=AIR)
    length = line.result.wires[0].stretched_length + 6.0
    assert case.load[0, 1] == pytest.approx(PRESSURE * DIAMETER * length, rel=1e-3)
    assert case.load[0, 0] == pytest.approx(0.0, abs=1e-6)
    assert case.blow_off.load[-1] == pytest.approx(PRESSURE * DIAMETER, rel=2e-3)  # 1 + strain


def test_a_given_diameter_counts(make: Make) -> None:
    contact = make().line.conductor("contact").model_dump(exclude_none=True) | {"diameter": 0.0132}
    conductors = make().line.model_dump(exclude_none=True)["conductors"] | {"contact": contact}
    blown = make((60.0,), (), conductors=conductors).under(wind=AIR).blow_off
    assert blown.load[-1] == pytest.approx(PRESSURE * 0.0132, rel=2e-3)
    assert blown.load[-1] != pytest.approx(PRESSURE * DIAMETER, rel=2e-3)


def test_only_what_is_normal_to_a_piece_acts() -> None:
    """At an angle b to the wire, sin(b) of the speed acts, and across the wire only."""
    b = math.radians(30.0)
    force = drag(np.array([[math.cos(b), math.sin(b), 0.0]]), np.array([[5.0, 0.0, 0.0]]))
    np.testing.assert_allclose(force, [[0.0, 5.0 * math.sin(b) ** 2, 0.0]], atol=1e-15)
    assert drag(np.array([[1.0, 0.0, 0.0]]), np.array([[5.0, 0.0, 0.0]]))[0] == pytest.approx([0.0, 0.0, 0.0])


@pytest.mark.parametrize(
    ("direction", "left"), [(90.0, 1.0), (270.0, -1.0), (30.0, 0.25), (150.0, 0.25), (0.0, 0.0), (180.0, 0.0)]
)
def test_directions(make: Make, direction: float, left: float) -> None:
    """90 degrees is from the right, which blows to the left: the force goes with the square of the sine."""
    case = make((60.0,), ()).under(wind=AIR | {"direction": direction})
    full = make((60.0,), ()).under(wind=AIR).load[0, 1]
    assert case.load[0, 1] == pytest.approx(left * full, abs=2e-3 * full)


def test_head_wind_pushes_droppers_backwards(make: Make) -> None:
    force = make().under(wind=AIR | {"direction": 0.0}).dropper_load
    assert force[0] < -1.0
    assert abs(force[1]) < 1e-9
    none = make().under(wind=AIR | {"direction": 0.0, "on": ["wires"]})
    assert not none.dropper_load.any()


def test_a_single_span_is_a_parabola(make: Make) -> None:
    line = make((60.0,), ())
    case = line.under(wind=AIR)
    blown, wire = case.blow_off, case.state.wires[0]
    inside = (wire.chainage > 0.0) & (wire.chainage < 60.0)
    x, y = wire.chainage[inside], wire.lateral[inside]
    expected = PRESSURE * DIAMETER * x * (60.0 - x) / (2.0 * 15e3)
    np.testing.assert_allclose(y, expected, atol=0.005 * expected.max())
    assert worst(blown, "alone") < 0.005
    double = case.blow_off.__class__(**{**vars(blown), "alone": 2.0 * blown.alone})
    assert worst(double, "alone") > 0.9


@pytest.mark.parametrize("radius", [None, 1000.0, -1000.0])
def test_the_textbook_holds_where_wires_do_not_touch(make: Make, radius: float | None) -> None:
    """In straights and curves, with staggers: contact wires without droppers are what it describes."""
    curve = {"start": -500.0, "length": 1500.0, "radius": radius}
    track = {} if radius is None else {"track": {"curves": [curve]}}
    line = make((60.0, 50.0, 60.0), (), stagger=(0.2, -0.1, 0.2, 0.2), **track)
    blown = line.under(wind=AIR).blow_off
    assert worst(blown, "alone") < 0.01
    assert worst(replace(blown, alone=1.02 * blown.alone), "alone") > 0.01
    if radius is not None:
        straight = make((60.0, 50.0, 60.0), (), stagger=(0.2, -0.1, 0.2, 0.2)).under(wind=AIR).blow_off
        assert worst(replace(blown, alone=straight.alone), "alone") > 0.05


def test_the_textbook_of_all_wires_holds_where_they_swing_alike(make: Make) -> None:
    """With the same wind by tension on both wires and light droppers they stay above each other."""
    ratio = 15.0 / 12.0
    line = make()
    conductors = line.line.model_dump(exclude_none=True)["conductors"]
    conductors["contact"]["diameter"], conductors["messenger"]["diameter"] = 0.012, 0.012 / ratio
    conductors["dropper"]["diameter"] = 1e-6
    blown = make(conductors=conductors).under(wind=AIR).blow_off
    assert worst(blown, "combined") < 0.01
    conductors["messenger"]["diameter"] = 0.02
    assert worst(make(conductors=conductors).under(wind=AIR).blow_off, "alone") > 0.05


def test_droppers_hand_on_half_of_their_wind(make: Make) -> None:
    case = make().under(wind=AIR)
    dropper = make().line.conductor("dropper").outer_diameter
    length = make().result.droppers.length.sum()
    assert case.dropper_load[1] == pytest.approx(PRESSURE * dropper * length, rel=1e-3)


def test_wind_that_is_the_same_in_space_turns_in_a_curve(make: Make) -> None:
    curve = {"track": {"curves": [{"start": -500.0, "length": 1500.0, "radius": 300.0}]}}
    line = make(**curve)
    fixed, turned = (line.under(wind=AIR | {"follows": way}) for way in ("space", "track"))
    ratio = fixed.blow_off.load / turned.blow_off.load
    middle = np.array([30.0, 90.0, 150.0]) / 300.0
    np.testing.assert_allclose(ratio, np.cos(middle) ** 2, atol=0.01)
    assert np.ptp(turned.blow_off.load) < 1e-3 * turned.blow_off.load.max()
