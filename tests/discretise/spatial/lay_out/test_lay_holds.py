"""Supports against places and properties that are computed by hand."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from catenaria.discretise.spatial.layout import Holds, Layout

Tree = dict[str, Any]
Lay = Callable[[Tree], Layout]


def arm(tree: Tree, support: int, **properties: object) -> None:
    """Let a steady arm hold the contact wire at a support."""
    held = tree["supports"][support]["contact_wire"]
    held |= {"kind": "steady arm", "arm": {"length": 1.0, **properties}}


def of_wire(holds: Holds, wire: int) -> NDArray[np.int64]:
    return np.flatnonzero(holds.wire == wire)


def test_places_on_a_straight_track(tree: Tree, laid: Lay) -> None:
    tree["supports"][1] = {"stagger": 0.3, "messenger_stagger": 0.1, "messenger_wire": {"height": 7.2}}
    tree["supports"][2]["messenger_wire"] = {"encumbrance": 1.4}
    holds = laid(tree).holds
    np.testing.assert_array_equal(holds.wire, [0, 0, 0, 1, 1, 1, 1])
    np.testing.assert_array_equal(holds.support, [0, 2, 3, 0, 1, 2, 3])  # the contact wire passes S2 freely
    np.testing.assert_allclose(
        holds.X,
        [
            [100.0, -0.2, 5.5],
            [200.0, -0.2, 5.5],
            [250.0, 0.2, 5.5],
            [100.0, -0.2, 7.0],
            [150.0, 0.1, 7.2],
            [200.0, -0.2, 6.9],
            [250.0, 0.2, 7.0],
        ],
        rtol=1e-15,
    )
    assert set(holds.kind) == {"sliding"}
    np.testing.assert_array_equal(holds.frame.chainage, holds.X[:, 0])
    assert not holds.guided.any()
    assert not holds.hinged.any()


def test_places_in_a_canted_curve_on_a_gradient(
    tree: Tree, laid: Lay, in_curve: Callable[[float, float, float, float], NDArray[np.float64]]
) -> None:
    tree["track"] = {
        "curves": [{"start": 100.0, "length": 400.0, "radius": 300.0, "cant": 0.12}],
        "gradients": [{"start": 150.0, "slope": 0.01}],
    }
    holds, lean = laid(tree).holds, np.arcsin(0.12 / 1.5)
    expected = np.array([in_curve(50.0 * i, b, 5.5, lean) for i, b in enumerate((-0.2, 0.2, -0.2, 0.2))][1:])
    expected[:, 2] += [0.0, 0.5, 1.0]
    np.testing.assert_allclose(holds.X[1:4], expected, rtol=1e-12)
    level = in_curve(50.0, 0.2, 5.5, 0.0)  # negative control: the cant moves the wire 0.44 m to the inside
    assert np.linalg.norm(holds.X[1] - level) > 0.4


def test_two_contact_wires_lie_beside_the_stagger(tree: Tree, laid: Lay) -> None:
    tree["second_contact_wire"] = {"spacing": 0.06}
    arm(tree, 1, hinge={"stagger": 1.17, "height": 5.7})
    holds = laid(tree).holds
    np.testing.assert_allclose(holds.X[of_wire(holds, 0), 1], [-0.17, 0.23, -0.17, 0.23], rtol=1e-12)
    np.testing.assert_allclose(holds.X[of_wire(holds, 1), 1], [-0.23, 0.17, -0.23, 0.17], rtol=1e-12)
    np.testing.assert_allclose(holds.hinge[holds.hinged, 1], [1.2, 1.14], rtol=1e-12)
    np.testing.assert_allclose(holds.X[of_wire(holds, 2), 1], [-0.2, 0.2, -0.2, 0.2], rtol=1e-12)


def test_an_arm_and_its_properties(tree: Tree, laid: Lay) -> None:
    arm(tree, 1, length=1.2, mass=1.5, lift=30.0)
    arm(tree, 2, mass=0.8, hinge={"stagger": -1.15, "height": 5.8})
    holds = laid(tree).holds
    assert holds.kind == ("sliding", "arm", "arm", "sliding") + ("sliding",) * 4
    np.testing.assert_array_equal(holds.guided[:4], [False, True, True, False])
    np.testing.assert_array_equal(holds.hinged[:4], [False, False, True, False])
    np.testing.assert_array_equal(holds.arm_length[:4], [0.0, 1.2, 1.0, 0.0])
    np.testing.assert_array_equal(holds.arm_mass[:4], [0.0, 1.5, 0.8, 0.0])
    np.testing.assert_array_equal(holds.lift[:4], [np.nan, 30.0, np.nan, np.nan])
    np.testing.assert_allclose(holds.hinge[2], [200.0, -1.15, 5.8], rtol=1e-15)


@pytest.mark.parametrize(
    ("stagger", "properties", "side"),
    [
        (0.2, {"registration": "pull-off"}, 1.0),
        (-0.2, {"registration": "pull-off"}, -1.0),
        (0.2, {"registration": "push-off"}, 1.0),
        (-0.2, {"registration": "push-off"}, -1.0),
        (-0.2, {"registration": "push-off", "side": "left"}, 1.0),
        (0.0, {"side": "left"}, 1.0),
        (0.0, {"hinge": {"stagger": -0.99, "height": 5.6}}, -1.0),
    ],
)
def test_the_side_of_the_hinge(stagger: float, properties: Tree, side: float, tree: Tree, laid: Lay) -> None:
    tree["supports"][1]["stagger"] = stagger
    arm(tree, 1, **properties)
    np.testing.assert_array_equal(laid(tree).holds.side, [0.0, side, *[0.0] * 6])


def test_springs_give_way(tree: Tree, laid: Lay) -> None:
    tree["supports"][1]["messenger_wire"] |= {"kind": "spring", "stiffness": 20e3}
    tree["supports"][2]["messenger_wire"] |= {"kind": "spring", "stiffness": 10e3, "lateral_stiffness": 50e3}
    holds = laid(tree).holds
    np.testing.assert_allclose(holds.compliance[4:], [[0, 0], [0, 5e-5], [2e-5, 1e-4], [0, 0]], rtol=1e-15)
    assert not holds.compliance[:4].any()
    assert holds.kind[4:] == ("sliding", "spring", "spring", "sliding")


def test_brackets_and_clamps(tree: Tree, laid: Lay) -> None:
    tree["supports"][1]["messenger_wire"]["kind"] = "bracket"
    tree["supports"][2]["messenger_wire"]["kind"] = "clamped"
    holds = laid(tree).holds
    assert holds.kind[5:7] == ("bracket", "clamped")
    np.testing.assert_array_equal(holds.guided[4:], [False, True, False, False])


@pytest.mark.parametrize(
    ("pulled", "signs"),
    [("both", [-1.0, -1.0, 1.0, 1.0]), ("start", [-1.0] * 4), ("end", [1.0] * 4)],
)
def test_friction_takes_tension_on_the_way_from_the_device(
    pulled: str, signs: list[float], tree: Tree, laid: Lay
) -> None:
    tree["messenger_wire"]["tension"]["pulled"] = pulled
    for support in tree["supports"]:
        support["messenger_wire"]["friction"] = 0.03
    friction = laid(tree).holds.friction
    np.testing.assert_allclose(friction[4:], 0.03 * np.array(signs), rtol=1e-15)
    assert not friction[:4].any()


def test_a_support_in_the_very_middle_takes_no_tension(tree: Tree, laid: Lay) -> None:
    del tree["supports"][-1], tree["spans"][-1]
    for support in tree["supports"]:
        support["messenger_wire"]["friction"] = 0.03
    np.testing.assert_allclose(laid(tree).holds.friction[3:], [-0.03, 0.0, 0.03], rtol=1e-15)


@pytest.mark.parametrize(("side", "sign"), [("left", 1.0), ("right", -1.0)])
def test_a_cantilever_reaches_from_its_root_to_the_wire(
    side: str, sign: float, tree: Tree, laid: Lay
) -> None:
    tree["track"] = {"curves": [{"start": 150.0, "length": 300.0, "radius": 500.0, "cant": 0.15}]}
    beam = {"youngs_modulus": 210e9, "area": 2e-3, "mass_per_length": 16.0, "bending_stiffness": 6e5}
    cantilever = {"length": 3.0, "side": side, "elements": 2, **beam}
    tree["supports"][2]["messenger_wire"] |= {"kind": "cantilever", "cantilever": cantilever}
    layout = laid(tree)
    (laid_cantilever,) = layout.cantilevers
    hold = laid_cantilever.hold
    assert (layout.holds.kind[hold], layout.holds.support[hold], laid_cantilever.elements) == (
        "cantilever",
        2,
        2,
    )
    heading = 0.1  # 50 m in the curve of 500 m
    left = np.array([-np.sin(heading) * np.sqrt(0.99), np.cos(heading) * np.sqrt(0.99), -0.1])
    np.testing.assert_allclose(
        laid_cantilever.root - layout.holds.X[hold], sign * 3.0 * left, rtol=0, atol=1e-12
    )
    assert (laid_cantilever.section.EA, laid_cantilever.section.EJ) == (4.2e8, 6e5)
