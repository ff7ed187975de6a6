"""Ice: weights by rule and geometry, sags by weight."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from catenaria.line.load_case import Ice
from catenaria.loading.ice import ice_by_altitude, ice_on

Make = Callable[..., Any]

G = 9.80665
ROLES = ("contact wire", "contact wire", "auxiliary messenger", "messenger wire", "stitch wire")
DIAMETER = np.array([0.012, 0.012, 0.01, 0.0105, 0.006])


def depth(line: Any, case: Any, wire: int = 0) -> float:
    """Return by how much a wire hangs lower in the middle of the only span than at its supports [m]."""
    state = line.before if case is None else case.state
    shape = state.wires[wire]
    return float(np.interp(0.0, shape.chainage, shape.height) - np.interp(30.0, shape.chainage, shape.height))


def test_sag_grows_with_weight(make: Make) -> None:
    line = make((60.0,), ())
    case = line.under(ice={"messenger_wire": 7.0, "contact_wire": 3.5})
    for wire, weight, ice in ((0, 1.07 * G, 3.5), (1, 0.596 * G, 7.0)):
        ratio = depth(line, case, wire) / depth(line, None, wire)
        assert ratio == pytest.approx((weight + ice) / weight, rel=2e-3)
        assert ratio != pytest.approx((weight + 1.1 * ice) / weight, rel=2e-3)


def test_weights_hang_on_supports_and_ends(make: Make) -> None:
    line = make((60.0,), ())
    case = line.under(ice={"messenger_wire": 7.0})
    length = line.result.wires[1].profile.s[-1]
    assert case.load[1, 2] == pytest.approx(-7.0 * length, rel=1e-12)
    assert case.load[0, 2] == pytest.approx(-3.5 * line.result.wires[0].profile.s[-1], rel=1e-12)


@pytest.mark.parametrize(
    ("altitude", "load"),
    [(0.0, 0.0), (500.0, 0.0), (501.0, 3.5), (1000.0, 3.5), (1500.0, 7.0), (1501.0, 15.0), (3000.0, 15.0)],
)
def test_the_spanish_rule(altitude: float, load: float) -> None:
    assert ice_by_altitude(altitude) == load
    weights = ice_on(Ice(altitude=altitude), ROLES, DIAMETER, G)
    np.testing.assert_array_equal(weights, [load / 2, load / 2, load, load, load])


def test_a_ring_of_ice() -> None:
    """Its area is that between two circles."""
    t, rho = 0.008, 900.0
    area = math.pi / 4.0 * ((DIAMETER + 2.0 * t) ** 2 - DIAMETER**2)
    weights = ice_on(Ice(thickness=t, density=rho), ROLES, DIAMETER, G)
    np.testing.assert_allclose(weights, area * rho * G, rtol=1e-12)
    assert not np.allclose(weights, ice_on(Ice(thickness=1.01 * t), ROLES, DIAMETER, G), rtol=1e-3)


def test_wind_meets_the_ring(make: Make) -> None:
    line, wind = make((60.0,), ()), {"speed": 20.0}
    bare, ringed = line.under(wind=wind), line.under(wind=wind, ice={"thickness": 0.01})
    d = line.line.conductor("contact").outer_diameter
    assert ringed.blow_off.load[-1] / bare.blow_off.load[-1] == pytest.approx((d + 0.02) / d, rel=1e-3)
    weighed = line.under(wind=wind, ice={"messenger_wire": 7.0})
    assert weighed.blow_off.load[-1] == pytest.approx(bare.blow_off.load[-1], rel=1e-9)


def test_rings_on_droppers(make: Make) -> None:
    line = make()
    case = line.under(ice={"thickness": 0.01})
    d = line.line.conductor("dropper").outer_diameter
    ring = math.pi * 0.01 * (d + 0.01) * 900.0 * G
    assert case.dropper_load[2] == pytest.approx(
        -ring * line.result.droppers.unstressed_length.sum(), rel=1e-9
    )
    assert not line.under(ice={"messenger_wire": 7.0}).dropper_load.any()
