"""Wires against sections, forces and ends that are computed by hand."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from catenaria.discretise.spatial.layout import Layout

Tree = dict[str, Any]
Lay = Callable[[Tree], Layout]


def names(layout: Layout) -> list[str]:
    return [wire.name for wire in layout.wires]


def test_contact_and_messenger_wire(tree: Tree, laid: Lay) -> None:
    contact, messenger = laid(tree).wires
    assert (contact.name, contact.role, contact.tied) == ("contact wire", "contact wire", False)
    assert (messenger.name, messenger.role) == ("messenger wire", "messenger wire")
    assert (contact.section.EA, contact.section.EJ, contact.section.rhoA) == (12e6, 100.0, 0.9)
    assert (contact.tension.force, contact.tension.measure, contact.tension.at_end) == (
        10e3,
        "reaction",
        True,
    )
    assert contact.pulled == messenger.pulled == (True, True)


def test_order_and_names_of_all_wires(tree: Tree, laid: Lay) -> None:
    tree["second_contact_wire"] = {"spacing": 0.04}
    tree["stitch_wire"] = {"conductor": "stitch", "tension": 2e3, "length": 16.0}
    tree["mid_point"] = {"support": "S3", "conductor": "stitch", "tension": 500.0, "reach": 12.0}
    layout = laid(tree)
    assert names(layout) == [
        "contact wire",
        "second contact wire",
        "messenger wire",
        "stitch wire S2",
        "stitch wire S3",
        "mid-point anchor 1",
        "mid-point anchor 2",
    ]
    assert [wire.tied for wire in layout.wires] == [False] * 3 + [True] * 4
    for wire in layout.wires[3:]:
        assert wire.pulled == (False, False)
        assert wire.tension.force == (2e3 if wire.role == "stitch wire" else 500.0)


def test_the_auxiliary_messenger_comes_before_the_messenger(tree: Tree, laid: Lay) -> None:
    tree["auxiliary_messenger"] = {"conductor": "stitch", "tension": {"force": 8e3}}
    for support in tree["supports"]:
        support["auxiliary_messenger"] = {"height": 6.0}
    for span in tree["spans"]:
        span["auxiliary"] = {"droppers": {"positions": [25.0]}, "height": 6.0}
    layout = laid(tree)
    assert names(layout) == ["contact wire", "auxiliary messenger", "messenger wire"]
    np.testing.assert_array_equal(layout.wires[1].ends, [[99.5, -0.2, 6.0], [250.5, 0.2, 6.0]])


def test_a_support_can_go_without_stitch_wire(tree: Tree, laid: Lay) -> None:
    tree["stitch_wire"] = {"conductor": "stitch", "tension": 2e3, "length": 16.0}
    tree["supports"][1]["stitch_wire"] = False
    assert names(laid(tree))[2:] == ["stitch wire S3"]


def test_laws_are_those_of_the_contact_wire_and_of_all_others(tree: Tree, laid: Lay) -> None:
    tree["stitch_wire"] = {"conductor": "stitch", "tension": 2e3, "length": 16.0}
    bands = {
        name: {"velocity": velocity, "dead_band": 5.0, "saturation": 100.0}
        for name, velocity in (("contact_tension", 1e-3), ("messenger_tension", 2e-3))
    }
    tree["solver"] = {"dynamic": bands}
    assert [wire.tension.law.v_s for wire in laid(tree).wires] == [1e-3, 2e-3, 2e-3, 2e-3]


@pytest.mark.parametrize(
    ("pulled", "flags"), [("both", (True, True)), ("start", (True, False)), ("end", (False, True))]
)
def test_the_device_pulls_where_it_stands(
    pulled: str, flags: tuple[bool, bool], tree: Tree, laid: Lay
) -> None:
    tree["contact_wire"]["tension"] |= {"pulled": pulled, "at": "start", "device": {"efficiency": 0.95}}
    contact, messenger = laid(tree).wires
    assert contact.pulled == flags
    assert contact.tension.force == pytest.approx(9500.0, abs=1e-9)
    assert not contact.tension.at_end
    assert messenger.tension.force == 12e3


def test_a_worn_wire_is_lighter_and_less_stiff(tree: Tree, laid: Lay) -> None:
    tree["contact_wire"]["wear"] = 0.2
    contact, messenger = (wire.section for wire in laid(tree).wires)
    np.testing.assert_allclose((contact.EA, contact.EJ, contact.rhoA), (9.6e6, 64.0, 0.72), rtol=1e-14)
    assert (messenger.EA, messenger.EJ) == (6e6, 100.0)


def test_without_anchors_wires_run_straight_on_for_their_tails(tree: Tree, laid: Lay) -> None:
    contact, messenger = laid(tree).wires
    np.testing.assert_array_equal(contact.ends, [[99.0, -0.2, 5.5], [251.0, 0.2, 5.5]])
    np.testing.assert_array_equal(messenger.ends, [[98.0, -0.2, 7.0], [252.0, 0.2, 7.0]])
    np.testing.assert_array_equal(contact.outwards, [[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]])


def test_anchors_stand_aside(tree: Tree, laid: Lay) -> None:
    tree["contact_wire"]["anchor_end"] = {"distance": 30.0, "height": 6.5, "stagger": 2.7}
    tree["messenger_wire"]["anchor_start"] = {"height": 7.1}
    contact, messenger = laid(tree).wires
    np.testing.assert_allclose(contact.ends[1], [280.0, 2.7, 6.5], rtol=1e-15)
    np.testing.assert_allclose(contact.outwards[1], np.array([30.0, 2.5, 1.0]) / np.sqrt(907.25), rtol=1e-12)
    np.testing.assert_allclose(messenger.ends[0], [98.0, -0.2, 7.1], rtol=1e-15)
    np.testing.assert_allclose(np.linalg.norm(messenger.outwards, axis=1), 1.0, rtol=1e-15)


def test_both_contact_wires_end_beside_each_other(tree: Tree, laid: Lay) -> None:
    tree["second_contact_wire"] = {"spacing": 0.04}
    tree["contact_wire"]["anchor_end"] = {"distance": 30.0, "stagger": 1.0}
    first, second, messenger = laid(tree).wires
    np.testing.assert_allclose(first.ends[:, 1], [-0.18, 1.02], rtol=1e-12)
    np.testing.assert_allclose(second.ends[:, 1], [-0.22, 0.98], rtol=1e-12)
    np.testing.assert_array_equal(messenger.ends[:, 1], [-0.2, 0.2])


def test_ends_go_on_straight_where_the_track_curves(
    tree: Tree, laid: Lay, in_curve: Callable[[float, float, float, float], NDArray[np.float64]]
) -> None:
    tree["track"] = {"curves": [{"start": 100.0, "length": 400.0, "radius": 300.0, "cant": 0.12}]}
    tree["contact_wire"]["anchor_end"] = {"distance": 30.0}
    lean = np.arcsin(0.12 / 1.5)
    tangent = np.array([np.cos(0.5), np.sin(0.5), 0.0])
    contact = laid(tree).wires[0]
    np.testing.assert_allclose(contact.ends[1], in_curve(150.0, 0.2, 5.5, lean) + 30.0 * tangent, rtol=1e-12)
    np.testing.assert_allclose(contact.outwards[1], tangent, atol=1e-12)
    along_the_curve = in_curve(180.0, 0.2, 5.5, lean)  # negative control: 30^2/(2 R) = 1.5 m aside
    assert np.linalg.norm(contact.ends[1] - along_the_curve) > 1.0


def test_ends_are_level_where_the_track_rises(tree: Tree, laid: Lay) -> None:
    tree["track"] = {"gradients": [{"start": 0.0, "slope": 0.01}]}
    contact = laid(tree).wires[0]
    rise = contact.ends[1, 2] - contact.ends[0, 2]
    assert rise == pytest.approx(1.5, abs=1e-12)  # 150 m from support to support, not 152 m
    np.testing.assert_allclose(contact.outwards[:, 2], 0.0, atol=1e-12)
