"""Droppers against places, wires and heights that are counted by hand."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from catenaria.discretise.spatial.layout import Layout

Tree = dict[str, Any]
Lay = Callable[[Tree], Layout]


def wires(layout: Layout, span: int) -> list[tuple[int, str, str]]:
    """Return number, lower and upper wire of the droppers of a span."""
    droppers = layout.droppers
    return [
        (int(droppers.number[i]), layout.wires[droppers.lower[i]].name, layout.wires[droppers.upper[i]].name)
        for i in np.flatnonzero(droppers.span == span)
    ]


def test_droppers_of_a_simple_line(tree: Tree, laid: Lay) -> None:
    droppers = laid(tree).droppers
    np.testing.assert_array_equal(droppers.frame.chainage[:6], [105.0, 115.0, 125.0, 135.0, 145.0, 155.0])
    np.testing.assert_array_equal(droppers.span, [1] * 5 + [2] * 5 + [3] * 5)
    np.testing.assert_array_equal(droppers.number, [1, 2, 3, 4, 5] * 3)
    np.testing.assert_array_equal(droppers.lower, 0)
    np.testing.assert_array_equal(droppers.upper, 1)
    np.testing.assert_allclose(droppers.height, 5.5, rtol=1e-15)
    np.testing.assert_allclose(droppers.flexibility, 1.0 / 1.2e6, rtol=1e-15)
    np.testing.assert_array_equal(droppers.rhoA, 0.09)
    np.testing.assert_array_equal(droppers.mass_bottom, 0.1)
    np.testing.assert_array_equal(droppers.mass_top, 0.2)


def test_rigid_droppers_do_not_stretch(tree: Tree, laid: Lay) -> None:
    tree["dropper"]["model"] = "rigid"
    np.testing.assert_array_equal(laid(tree).droppers.flexibility, 0.0)


def test_heights_follow_gradient_and_pre_sag(tree: Tree, laid: Lay) -> None:
    for i, height in enumerate((5.5, 5.5, 5.4, 5.4)):
        tree["supports"][i]["contact_wire"]["height"] = height
    tree["spans"][0]["pre_sag"] = 0.02
    tree["spans"][2]["contact_wire_height"] = [5.41, 5.42, 5.43, 5.44, 5.45]
    height = laid(tree).droppers.height
    np.testing.assert_allclose(height[:5], [5.5, 5.485, 5.48, 5.485, 5.5], rtol=1e-14)
    np.testing.assert_allclose(height[5:10], [5.49, 5.47, 5.45, 5.43, 5.41], rtol=1e-14)
    np.testing.assert_allclose(height[10:], [5.41, 5.42, 5.43, 5.44, 5.45], rtol=1e-14)


def test_a_span_may_have_none(tree: Tree, laid: Lay) -> None:
    del tree["spans"][1]["droppers"]
    np.testing.assert_array_equal(laid(tree).droppers.span, [1] * 5 + [3] * 5)


def test_droppers_near_a_support_hang_from_its_stitch_wire(tree: Tree, laid: Lay) -> None:
    tree["stitch_wire"] = {"conductor": "stitch", "tension": 2e3, "length": 16.0}
    assert [upper for _, _, upper in wires(laid(tree), 2)] == [
        "stitch wire S2",
        *["messenger wire"] * 3,
        "stitch wire S3",
    ]
    assert [upper for _, _, upper in wires(laid(tree), 1)] == [*["messenger wire"] * 4, "stitch wire S2"]
    tree["stitch_wire"]["length"] = 9.0  # negative control: it ends before the first dropper
    assert {upper for _, _, upper in wires(laid(tree), 2)} == {"messenger wire"}


def test_alternate_droppers_of_two_contact_wires(tree: Tree, laid: Lay) -> None:
    tree["second_contact_wire"] = {"spacing": 0.04}
    first, second = "contact wire", "second contact wire"
    for span in (1, 2, 3):  # every span begins with the first wire
        found = [(number, lower) for number, lower, _ in wires(laid(tree), span)]
        assert found == [(1, first), (2, second), (3, first), (4, second), (5, first)]


def test_both_droppers_of_two_contact_wires(tree: Tree, laid: Lay) -> None:
    tree["second_contact_wire"] = {"spacing": 0.04, "droppers": "both"}
    layout = laid(tree)
    found = [(number, lower) for number, lower, _ in wires(layout, 2)]
    assert found[:4] == [
        (1, "contact wire"),
        (2, "second contact wire"),
        (3, "contact wire"),
        (4, "second contact wire"),
    ]
    assert len(found) == 10
    np.testing.assert_array_equal(layout.droppers.frame.chainage[:4], [105.0, 105.0, 115.0, 115.0])


def test_a_compound_line_has_two_rows(tree: Tree, laid: Lay) -> None:
    tree["auxiliary_messenger"] = {"conductor": "stitch", "tension": {"force": 8e3}}
    for support in tree["supports"]:
        support["auxiliary_messenger"] = {"height": 6.0}
    for span in tree["spans"]:
        span["auxiliary"] = {"droppers": {"positions": [10.0, 25.0, 40.0]}, "height": [6.0, 5.98, 6.0]}
    layout = laid(tree)
    hanger, upper = ("contact wire", "auxiliary messenger"), ("auxiliary messenger", "messenger wire")
    assert wires(layout, 2) == [
        (1, *hanger),
        (1, *upper),
        (2, *hanger),
        (3, *hanger),
        (2, *upper),
        (4, *hanger),
        (3, *upper),
        (5, *hanger),
    ]
    assert np.all(np.diff(layout.droppers.frame.chainage) >= 0.0)
    aux = layout.droppers.upper == 2
    np.testing.assert_array_equal(layout.droppers.height[aux], [6.0, 5.98, 6.0] * 3)


@pytest.mark.parametrize("radius", [300.0, -300.0])
def test_planes_across_a_curve(radius: float, tree: Tree, laid: Lay) -> None:
    tree["track"] = {"curves": [{"start": 100.0, "length": 400.0, "radius": radius}]}
    frame = laid(tree).droppers.frame
    heading = (frame.chainage - 100.0) / radius
    expected = np.column_stack([np.cos(heading), np.sin(heading), np.zeros(15)])
    np.testing.assert_allclose(frame.along, expected, atol=1e-14)
