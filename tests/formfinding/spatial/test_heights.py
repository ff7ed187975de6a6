"""Heights: wanted profiles, gradients, cant, unequal supports, against strings and hand calculation."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from scipy.optimize import brentq

from catenaria.catenary.green_bar import stretch
from catenaria.errors import InfeasibleError
from catenaria.line import Line
from catenaria.results import FormResult

Change = dict[str, Any]
Make = Callable[..., Line]
Find = Callable[[Line], FormResult]

GRAVITY = 9.80665
T_CONTACT, T_MESSENGER = 15e3, 12e3
W_CONTACT = 1.07 * GRAVITY / float(stretch(T_CONTACT, 120e9 * 120e-6))  # N per metre of the taut wire
W_MESSENGER = 0.596 * GRAVITY / float(stretch(T_MESSENGER, 113e9 * 65.8e-6))
X = np.array([5.0, 17.5, 30.0, 42.5, 55.0])
UNEVEN: Change = {
    "supports.0.contact_wire.height": 5.3,
    "supports.1.contact_wire.height": 5.1,
    "supports.2.contact_wire.height": 5.25,
}


def parabola(sag: float) -> np.ndarray:
    return 5.3 - sag * (1.0 - ((X - 30.0) / 25.0) ** 2)


@pytest.mark.parametrize(
    ("change", "sag"),
    [({"spans.1.pre_sag": 0.04}, 0.04), ({"spans.1.pre_sag_per_mille": 0.5}, 0.03)],
    ids=["depth", "per mille"],
)
def test_pre_sag_is_a_parabola_between_the_outer_droppers(
    make: Make, find: Find, change: Change, sag: float
) -> None:
    droppers = find(make(2, change)).droppers
    np.testing.assert_allclose(droppers.height[:5], 5.3, rtol=0.0, atol=1e-10)
    np.testing.assert_allclose(droppers.position_bottom[5:, 2], parabola(sag), rtol=0.0, atol=1e-10)
    with pytest.raises(AssertionError):
        np.testing.assert_allclose(droppers.position_bottom[5:, 2], parabola(sag + 1e-5), rtol=0.0, atol=1e-6)


def test_heights_left_out_lie_between_the_supports(make: Make, find: Find) -> None:
    """Also past a support that does not hold the contact wire."""
    held = find(make(2, UNEVEN)).droppers.height
    np.testing.assert_allclose(held[:5], 5.3 - 0.2 * X / 60.0, rtol=0.0, atol=1e-10)
    np.testing.assert_allclose(held[5:], 5.1 + 0.15 * X / 60.0, rtol=0.0, atol=1e-10)
    past = find(make(2, UNEVEN | {"supports.1.contact_wire": None})).droppers.height
    np.testing.assert_allclose(past[:5], 5.3 - 0.05 * X / 120.0, rtol=0.0, atol=1e-10)
    assert np.abs(past - held).max() > 0.1


def uplift(height: float) -> tuple[float, float]:
    """Return the force of a string on a support [N], upwards, and of the first dropper on the string [N].

    On the other side of the support is a tail of 3 m to an anchor as high as the support, and the droppers'
    height is 5.3 m.
    """
    d, tail, h = X[0], 3.0, X[1] - X[0]
    slope = (5.3 - height) / d
    return T_CONTACT * slope - 0.5 * W_CONTACT * (d + tail), 0.5 * W_CONTACT * (d + h) + T_CONTACT * slope


def test_a_support_that_is_higher_than_the_droppers_carries_more(
    make: Make, find: Find, strings: Change
) -> None:
    """A centimetre is 30 N; the tolerance is that of a micrometre, by which bending rounds the kink."""
    height = 5.31
    change = {"supports.0.contact_wire.height": height, "spans.0.contact_wire_height": 5.3}
    result = find(make(2, strings, change))
    found = result.supports.force_z[0], result.droppers.on_contact[0, 2]
    np.testing.assert_allclose(found, uplift(height), rtol=0.0, atol=5e-3)
    with pytest.raises(AssertionError):
        np.testing.assert_allclose(found, uplift(height + 1e-5), rtol=0.0, atol=5e-3)


class Messenger:
    """The messenger as a string over rollers, whose tension is the same on both sides of each of them."""

    def __init__(self, line: Line, result: FormResult, *, lost: float = 0.0) -> None:
        droppers = result.droppers
        self.x = np.array(line.support_x)
        height = np.array([support.messenger_height for support in line.supports])
        self.z = line.alignment.frames(self.x).origin[:, 2] + height
        self.at, self.P = droppers.x, -droppers.on_messenger[:, 2]
        self.lost = lost

    def _chords(self, span: int, H: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return the slopes of the bays' chords, the bays' lengths in plan and their weights."""
        a, b = self.x[span : span + 2]
        own = (self.at > a) & (self.at < b)
        ends = np.concatenate(([a], self.at[own], [b]))
        bay = ends[1:] - ends[:-1]
        chord, weight, rise = np.zeros(bay.size), np.zeros(bay.size), float(np.diff(self.z)[span])
        for _ in range(5):
            weight = W_MESSENGER * bay * np.sqrt(1.0 + chord**2)
            load = self.P[own] + 0.5 * (weight[1:] + weight[:-1])
            chord = np.concatenate(([0.0], np.cumsum(load))) / H
            chord += (rise - float(np.sum(chord * bay))) / (b - a)
        return chord, bay, weight

    def _tensions(self, span: int, H: float) -> tuple[float, float]:
        """Return the tensions behind the start and before the end of a span [N]."""
        chord, _, weight = self._chords(span, H)
        V = H * chord[0] - 0.5 * weight[0], H * chord[-1] + 0.5 * weight[-1]
        return float(np.hypot(H, V[0])), float(np.hypot(H, V[1]))

    def heights(self) -> np.ndarray:
        """Return the heights at all droppers [m]; the tension is that of the tail beyond the last span."""
        tension, z = T_MESSENGER, []
        for span in reversed(range(self.x.size - 1)):
            wanted = tension * (1.0 - self.lost)
            H = brentq(lambda H, k=span, T=wanted: self._tensions(k, H)[1] - T, 8e3, 13e3)
            tension = self._tensions(span, H)[0]
            chord, bay, _ = self._chords(span, H)
            z.append(self.z[span] + np.cumsum(chord * bay)[:-1])
        return np.concatenate(z[::-1])


SPANS: Change = {
    "spans.1.length": 45.0,
    "spans.1.droppers.positions": [4.0, 16.0, 29.0, 41.0],
    "supports.1.messenger_wire.height": 7.0,
    "supports.2.messenger_wire.height": 6.5,
    "supports.3.messenger_wire.height": 6.8,
}


def check_messenger(line: Line, result: FormResult, messenger: Messenger) -> None:
    """Rounded by bending, with l = 0.3 mm, a kink J = 0.07 lifts the wire by J l/2 = 10 um."""
    np.testing.assert_allclose(result.droppers.position_top[:, 2], messenger.heights(), rtol=0.0, atol=15e-6)


@pytest.mark.parametrize("gradient", [0.0, 0.02])
def test_unequal_spans_and_supports_give_strings_over_rollers(
    make: Make, find: Find, strings: Change, gradient: float
) -> None:
    track = {"track": {"gradients": [{"start": -500.0, "slope": gradient}]}} if gradient else {}
    line = make(3, strings, SPANS, track, {"solver.mesh.refine": 2})
    result = find(line)
    check_messenger(line, result, Messenger(line, result))
    with pytest.raises(AssertionError):
        check_messenger(line, result, Messenger(line, result, lost=5e-5))


def check_gradient(result: FormResult, slope: float) -> None:
    """The contact wire parallel to the track: heights above it, droppers that carry what is between them.

    Along the slope T grows by w per height, as in any catenary, and falls by F z' at a dropper, which changes
    z' under constant H: T = H (1 + z'^2)^(1/2).
    """
    droppers = result.droppers
    np.testing.assert_allclose(droppers.height, 5.3, rtol=0.0, atol=1e-10)
    expected = 5.3 + slope * droppers.x
    np.testing.assert_allclose(droppers.position_bottom[:, 2], expected, rtol=0.0, atol=1e-9)
    weight = W_CONTACT * np.hypot(1.0, slope)
    np.testing.assert_allclose(droppers.on_contact[[1, 2, 3], 2], 12.5 * weight, atol=2e-3)
    start, end = np.linalg.norm(result.wire("contact wire").end_force, axis=1)
    grown = slope * (weight * 180.0 - droppers.on_contact[:, 2].sum())
    assert grown > 3.0 or slope == 0.0
    assert end - start == pytest.approx(grown, abs=5e-3)


def test_a_line_on_a_gradient_follows_the_track(make: Make, find: Find, strings: Change) -> None:
    result = find(make(3, strings, {"track": {"gradients": [{"start": -500.0, "slope": 0.02}]}}))
    check_gradient(result, 0.02)
    with pytest.raises(AssertionError):
        check_gradient(result, 0.0201)
    check_gradient(find(make(3, strings)), 0.0)


def kinked(rounding: float) -> Change:
    """Return a track whose slope changes by 12 mm/m at the first span's middle dropper: 180 N of 15 kN."""
    return {"track": {"gradients": [{"start": 30.0, "slope": 0.012, "rounding": rounding}]}}


def test_droppers_that_push_at_a_change_of_slope_are_refused_with_a_vertical_curve_as_advice(
    make: Make, find: Find
) -> None:
    with pytest.raises(InfeasibleError, match=r"dropper 3 in span 1 .* longer rounding"):
        find(make(2, kinked(0.0)))
    assert find(make(2, kinked(40.0))).droppers.force_bottom.min() > 0.0
    with pytest.raises(InfeasibleError) as level:
        find(make(2, {"spans.0.contact_wire_height": [5.3, 5.3, 5.2, 5.3, 5.3]}))
    assert "rounding" not in str(level.value)


def in_curve(radius: float, chainage: float, b: float, h: float, sin_phi: float) -> np.ndarray:
    """Return the point with lateral offset b and height h in the canted plane of a curve to the left [m].

    The outer rail is raised: the plane is lower to the left, and what is above it is nearer to the centre.
    """
    cos_phi = np.sqrt(1.0 - sin_phi**2)
    distance = radius - (b * cos_phi + h * sin_phi)
    angle = chainage / radius
    return np.array([distance * np.sin(angle), radius - distance * np.cos(angle), h * cos_phi - b * sin_phi])


def check_cant(result: FormResult, sin_phi: float) -> None:
    droppers = result.droppers
    for x, b, r in zip(droppers.x, droppers.stagger_bottom, droppers.position_bottom, strict=True):
        np.testing.assert_allclose(r, in_curve(600.0, x, b, 5.3, sin_phi), rtol=0.0, atol=1e-8)
    supports = result.supports
    for i, wire in enumerate(supports.wire):
        h = 5.3 if wire == "contact wire" else 6.7
        r = np.array([supports.x[i], supports.y[i], supports.z[i]])
        expected = in_curve(600.0, supports.chainage[i], -0.2, h, sin_phi)
        np.testing.assert_allclose(r, expected, rtol=0.0, atol=1e-8)


def test_heights_are_normal_to_the_canted_track(make: Make, find: Find) -> None:
    curve = {"start": -300.0, "length": 900.0, "radius": 600.0, "cant": 0.15}
    result = find(make(2, {"track": {"curves": [curve]}, "supports.*.stagger": -0.2}))
    np.testing.assert_allclose(result.droppers.height, 5.3, rtol=0.0, atol=1e-10)
    check_cant(result, 0.15 / 1.5)
    with pytest.raises(AssertionError):
        check_cant(result, 0.15 / 1.5001)
    wider = {"curves": [curve], "rail_spacing": 1.4}
    check_cant(find(make(2, {"track": wider, "supports.*.stagger": -0.2})), 0.15 / 1.4)


def test_a_messenger_that_hangs_plumb_is_outside_of_the_contact_wire(make: Make, find: Find) -> None:
    """Seen from the canted track: by the encumbrance times the tangent; what is left are the arcs."""
    track = {"curves": [{"start": -300.0, "length": 900.0, "radius": 600.0, "cant": 0.15}]}
    aside = 1.4 * np.tan(np.arcsin(0.1))

    def lean(messenger: float) -> float:
        staggers = {"supports.*.stagger": -0.2, "supports.*.messenger_stagger": messenger}
        return float(np.degrees(find(make(2, {"track": track}, staggers)).droppers.inclination.max()))

    assert lean(-0.2 - aside) < 0.2
    assert lean(-0.2) > 4.0
    assert lean(-0.2 + aside) > 8.0
