"""Ties, masses and the mesh of a line against hand computation."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from catenaria.discretise.spatial.layout import Layout
from catenaria.mechanics.controls.velocity_law import VelocityLaw

Tree = dict[str, Any]
Lay = Callable[[Tree], Layout]


def ties(layout: Layout) -> list[tuple[str, int, str, float]]:
    rows = zip(layout.ties.wire, layout.ties.end, layout.ties.host, layout.ties.frame.chainage, strict=True)
    return [
        (layout.wires[wire].name, int(end), layout.wires[host].name, float(chainage))
        for wire, end, host, chainage in rows
    ]


def test_what_a_simple_line_does_not_have_is_empty(tree: Tree, laid: Lay) -> None:
    layout = laid(tree)
    assert layout.ties.wire.shape == layout.ties.frame.chainage.shape == (0,)
    assert layout.masses.mass.shape == (0,)
    assert layout.masses.frame.origin.shape == (0, 3)
    assert layout.cantilevers == ()


def test_stitch_wires_are_tied_to_the_messenger(tree: Tree, laid: Lay) -> None:
    tree["stitch_wire"] = {"conductor": "stitch", "tension": 2e3, "length": 16.0}
    assert ties(laid(tree)) == [
        ("stitch wire S2", 0, "messenger wire", 142.0),
        ("stitch wire S2", 1, "messenger wire", 158.0),
        ("stitch wire S3", 0, "messenger wire", 192.0),
        ("stitch wire S3", 1, "messenger wire", 208.0),
    ]


def test_mid_point_anchors_come_down_to_the_contact_wire(tree: Tree, laid: Lay) -> None:
    tree["supports"][2]["name"] = "M17"
    tree["mid_point"] = {"support": "M17", "conductor": "stitch", "tension": 500.0, "reach": 12.0}
    assert ties(laid(tree)) == [
        ("mid-point anchor 1", 0, "messenger wire", 188.0),
        ("mid-point anchor 1", 1, "contact wire", 199.5),
        ("mid-point anchor 2", 0, "contact wire", 200.5),
        ("mid-point anchor 2", 1, "messenger wire", 212.0),
    ]


def test_masses_and_clamps_of_arms(tree: Tree, laid: Lay) -> None:
    tree["point_masses"] = [
        {"name": "insulator", "wire": "messenger wire", "chainage": 120.0, "mass": 5.0},
        {"name": "section insulator", "wire": "contact wire", "chainage": 230.0, "mass": 9.0},
    ]
    for support, mass in ((1, 0.3), (2, 0.0)):
        held = tree["supports"][support]["contact_wire"]
        held |= {"kind": "steady arm", "arm": {"length": 1.0, "clamp_mass": mass}}
    masses = laid(tree).masses
    assert masses.name == ("clamp at S2", "section insulator", "insulator")
    np.testing.assert_array_equal(masses.wire, [0, 0, 1])
    np.testing.assert_array_equal(masses.frame.chainage, [150.0, 230.0, 120.0])
    np.testing.assert_array_equal(masses.mass, [0.3, 9.0, 5.0])


def test_each_of_two_contact_wires_has_a_clamp(tree: Tree, laid: Lay) -> None:
    tree["second_contact_wire"] = {"spacing": 0.04}
    held = tree["supports"][1]["contact_wire"]
    held |= {"kind": "steady arm", "arm": {"length": 1.0, "clamp_mass": 0.3}}
    masses = laid(tree).masses
    assert masses.name == ("clamp at S2", "clamp at S2")
    np.testing.assert_array_equal(masses.wire, [0, 1])


def test_options_reach_the_layout(tree: Tree, laid: Lay) -> None:
    tree["solver"] = {
        "mesh": {"fine": [0.2], "largest_element": 3.0, "refine": 2, "gauss_points": 6},
        "dynamic": {
            "ramp_time": 7.0,
            "damping": {"mass": 0.1, "stiffness": 0.2},
            "height": {"velocity": 1e-3, "dead_band": 1e-6, "saturation": 1e-4},
        },
    }
    layout = laid(tree)
    assert (layout.grading.fine, layout.grading.largest, layout.grading.refine) == ((0.2,), 3.0, 2)
    assert (layout.gauss_points, layout.g, layout.ramp_time, layout.damping) == (6, 9.81, 7.0, (0.1, 0.2))
    assert layout.height_law == VelocityLaw(1e-3, 1e-6, 1e-4)
