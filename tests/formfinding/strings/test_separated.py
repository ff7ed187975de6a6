"""The separated model against closed forms of the taut string."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from catenaria.catenary.taut_string import taut_string
from catenaria.formfinding.strings.separated import find_rest
from catenaria.formfinding.strings.task import StringLine, string_line
from catenaria.line import Line
from catenaria.results import FormResult


def test_droppers_carry_weight_less_what_the_kink_lifts(vary: Callable[..., Line], line: Line) -> None:
    """F = w (h + h')/2 - T (difference of slopes), w by the stretched length."""
    heights = (0.0, -0.01, -0.02, -0.025, -0.02, -0.01, 0.0)
    spans = line.model_dump()["spans"]
    task = string_line(vary({"spans": ({**spans[0], "contact_wire_height": heights}, *spans[1:])}), "test")
    contact = find_rest(task).found.contact
    w = 7710 * 120e-6 * 9.8 / (1.0 + 15e3 / 15.6e6)
    slope = np.diff(heights) / 9.5
    weight, lift = 9.5 * w, 15e3 * np.diff(slope)
    force = contact.force[contact.clamp, 2][1:6]
    np.testing.assert_allclose(force, weight - lift, atol=2e-3)
    assert np.abs(force - weight).max() > 1.0  # negative control: without the kinks it is 8 N off


def test_the_messenger_is_a_taut_string_under_its_loads(task: StringLine) -> None:
    """To what the closed form neglects: the weight of the arc over that of the chord, slope^2/2."""
    messenger = find_rest(task).found.messenger
    first = messenger.force[1:-1]
    at = messenger.r[messenger.clamp]
    load = -messenger.force[messenger.clamp, 2]
    H = float(messenger.force[0, 0] * -1.0 - first[0, 0])
    supports = (task.messenger.support_x, task.messenger.support_z)
    w = task.messenger.w / (1.0 + H / task.messenger.EA)
    height, _ = taut_string(at[:, 0], supports, H, w, (at[:, 0], load))
    np.testing.assert_allclose(at[:, 2], height, atol=0.1e-3)
    off, _ = taut_string(at[:, 0], supports, H, 1.01 * w, (at[:, 0], load))
    assert np.abs(at[:, 2] - off).max() > 1e-3


def test_a_level_string_without_load_sags_like_a_catenary(task: StringLine) -> None:
    """Tails: their reach and their ends' forces, against the weight and length of the wire."""
    wire, contact = task.contact, find_rest(task).found.contact
    assert contact.s[-1] == pytest.approx(wire.laid, abs=1e-12)
    pull = np.linalg.norm(contact.force[[0, -1]], axis=1)
    np.testing.assert_allclose(pull, 15e3, rtol=1e-12)
    np.testing.assert_allclose(contact.force[[0, -1], 2], 0.5 * wire.w * contact.s[1], rtol=1e-9)


def test_the_tensioned_end_may_be_either(
    vary: Callable[..., Line], found: Callable[[str, Line], FormResult], uneven: Line
) -> None:
    """Mirror images: a line read backwards with the tension at the other end has the same lengths."""
    data: dict[str, Any] = uneven.model_dump()
    spans: list[dict[str, Any]] = []
    heights = list(reversed(uneven.dropper_target_height))
    for span, old in zip(reversed(data["spans"]), reversed(uneven.spans), strict=True):
        x = tuple(old.length - x for x in reversed(old.droppers.x))
        own, heights = heights[: len(x)], heights[len(x) :]
        spans.append({**span, "droppers": {"positions": x}, "contact_wire_height": own})
    tension = data["messenger_wire"]["tension"] | {"at": "end"}
    contact = data["contact_wire"]["tension"] | {"at": "start"}
    mirrored = Line.model_validate(
        data
        | {
            "spans": spans,
            "supports": tuple(data["supports"][::-1]),
            "messenger_wire": data["messenger_wire"] | {"tension": tension},
            "contact_wire": data["contact_wire"] | {"tension": contact},
        }
    )
    there, back = found("separated", uneven), found("separated", mirrored)
    np.testing.assert_allclose(back.droppers.length[::-1], there.droppers.length, atol=1e-10)
    same = found("separated", vary({}))
    assert same.droppers.length.size != there.droppers.length.size
