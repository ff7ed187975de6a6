"""Profiles, tensions and lengths of cables along known curves, against closed forms."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from catenaria.discretise.read_back import (
    element_tension,
    profile,
    reactions,
    sag,
    stage,
    stretched_length,
    support_strain_tension,
)
from catenaria.discretise.wire_model import WireModel
from catenaria.mechanics.chain import Chain
from catenaria.results.form import Profile, Stage

FloatArray = NDArray[np.float64]
Laid = tuple[Chain, FloatArray]
Along = Callable[..., Laid]

EA, EJ = 2e6, 300.0
RADIUS, STRETCH = 40.0, 1.001
UNEVEN = np.array([0.0, 0.3, 0.8, 1.1, 2.0, 2.4, 3.1])


@pytest.fixture
def arc(along: Along) -> Laid:
    """A cable bent to an arc of 40 m radius, stretched by 0.1 %."""
    angle = STRETCH * UNEVEN / RADIUS
    position = RADIUS * np.column_stack((np.sin(angle), 0.0 * angle, 1.0 - np.cos(angle)))
    slope = STRETCH * np.column_stack((np.cos(angle), 0.0 * angle, np.sin(angle)))
    return along(UNEVEN, position, slope)


@pytest.fixture
def stretching(along: Along) -> Laid:
    """A straight cable in space with r' = (1 + 2 a s) d, |d| = 1: a cubic follows it exactly."""
    direction = np.array([2.0, -1.0, 2.0]) / 3.0
    position = (UNEVEN + GROWTH * UNEVEN**2)[:, None] * direction
    return along(UNEVEN, position, (1.0 + 2.0 * GROWTH * UNEVEN)[:, None] * direction)


GROWTH = 2e-3  # a [1/m]


def test_an_arc_carries_the_moment_of_its_radius(arc: Laid) -> None:
    """Kappa of (10) is the geometric curvature 1/R; the cubic's r'' errs by (L/R)^2/12 at most."""
    np.testing.assert_allclose(profile(*arc).moment, EJ / RADIUS, rtol=1e-4)


def test_another_radius_is_noticed(arc: Laid) -> None:
    chain, z = arc
    bent = z.reshape(-1, 6).copy()
    bent[:, [2, 5]] *= 1.001
    with pytest.raises(AssertionError):
        test_an_arc_carries_the_moment_of_its_radius((chain, bent.ravel()))


def test_an_arc_has_the_tension_of_its_stretch(arc: Laid) -> None:
    """N = EA (f^2 - 1)/2 and T = N f; a cubic follows an arc to (L/R)^4/720 of its stretch."""
    N = 0.5 * EA * (STRETCH**2 - 1.0)
    shape = profile(*arc)
    np.testing.assert_allclose(shape.strain_tension, N, atol=1e-2)
    np.testing.assert_allclose(shape.tension, N * STRETCH, atol=1e-2)
    angle = STRETCH * shape.s / RADIUS
    np.testing.assert_allclose(shape.horizontal, N * STRETCH * np.cos(angle), atol=1e-1)
    assert not np.allclose(shape.strain_tension, N * STRETCH, atol=1e-2)  # the two are told apart


def test_an_arc_is_where_it_is_and_as_long_as_it_is(arc: Laid) -> None:
    shape = profile(*arc)
    angle = STRETCH * shape.s / RADIUS
    np.testing.assert_allclose(shape.x, RADIUS * np.sin(angle), atol=1e-7)
    np.testing.assert_allclose(shape.y, 0.0, atol=1e-15)
    np.testing.assert_allclose(shape.z, RADIUS * (1.0 - np.cos(angle)), atol=1e-7)
    for start, end in ((0.0, 3.1), (0.45, 2.9), (0.5, 0.6)):
        assert stretched_length(*arc, start, end) == pytest.approx(STRETCH * (end - start), rel=1e-8)
    assert stretched_length(*arc, 0.45, 2.9) != pytest.approx(STRETCH * 2.44, rel=1e-8)


def test_a_profile_has_all_nodes_and_ascends(arc: Laid) -> None:
    shape = profile(*arc)
    assert set(UNEVEN) <= set(shape.s)
    assert np.diff(shape.s).min() > 0.0
    assert (shape.s[0], shape.s[-1]) == (UNEVEN[0], UNEVEN[-1])


def mean_tension(start: FloatArray, end: FloatArray) -> FloatArray:
    """Return the mean of EA (u^2 - 1) u/2, u = 1 + 2 a s; its antiderivative is EA (u^4/4 - u^2/2)/(4 a)."""

    def integral(s: FloatArray) -> FloatArray:
        u = 1.0 + 2.0 * GROWTH * s
        return EA * (0.25 * u**4 - 0.5 * u**2) / (4.0 * GROWTH)

    return (integral(end) - integral(start)) / (end - start)


def test_element_tension_is_the_mean_over_the_element(stretching: Laid) -> None:
    mean = mean_tension(UNEVEN[:-1], UNEVEN[1:])
    np.testing.assert_allclose(element_tension(*stretching), mean, rtol=1e-9)
    middle = 1.0 + GROWTH * (UNEVEN[:-1] + UNEVEN[1:])
    assert not np.allclose(0.5 * EA * (middle**2 - 1.0) * middle, mean, rtol=1e-9)


def test_profile_tension_goes_through_the_means(stretching: Laid) -> None:
    shape = profile(*stretching)
    mean = mean_tension(UNEVEN[:-1], UNEVEN[1:])
    np.testing.assert_allclose(np.interp(0.5 * (UNEVEN[:-1] + UNEVEN[1:]), shape.s, shape.tension), mean)
    u = 1.0 + 2.0 * GROWTH * shape.s
    np.testing.assert_allclose(shape.strain_tension, 0.5 * EA * (u**2 - 1.0), rtol=1e-9, atol=1e-6)
    np.testing.assert_allclose(shape.horizontal, shape.tension * 2.0 / 3.0, rtol=1e-12)
    np.testing.assert_allclose(shape.moment, 0.0, atol=1e-9)


def test_stretched_length_of_a_growing_stretch(stretching: Laid) -> None:
    start, end = 0.35, 2.75
    exact = end - start + GROWTH * (end**2 - start**2)
    assert stretched_length(*stretching, start, end) == pytest.approx(exact, rel=1e-12)
    assert stretched_length(*stretching, start, end) != pytest.approx(end - start, rel=1e-4)


@pytest.fixture
def kinked(along: Along) -> Laid:
    """Two elements of 1 m, the first curved by 0.02/m at its end, the second by 0.06/m at its start.

    r'' of a cubic with slopes m_i, m_j and rise h over length L is (6 h/L - 4 m_i - 2 m_j)/L at i and
    (-6 h/L + 2 m_i + 4 m_j)/L at j.
    """
    knots = np.array([0.0, 1.0, 2.0])
    height = np.array([0.0, -0.02 / 6.0, -0.02 / 6.0 + 0.01])
    position = np.column_stack((knots, 0.0 * knots, height))
    return along(knots, position, np.tile([1.0, 0.0, 0.0], (3, 1)))


def test_the_moment_at_a_node_is_the_mean_of_its_two_sides(kinked: Laid) -> None:
    """Neither side is preferred, so that a mirrored wire has the mirrored moment."""
    shape = profile(*kinked)
    assert shape.moment[shape.s == 1.0] == pytest.approx(EJ * 0.5 * (0.02 + 0.06), rel=1e-9)
    assert shape.moment[0] == pytest.approx(EJ * 0.02, rel=1e-9)
    assert shape.moment[-1] == pytest.approx(EJ * 0.06, rel=1e-9)


def test_a_mirrored_cable_has_the_mirrored_profile(kinked: Laid, along: Along) -> None:
    chain, z = kinked
    shape, nodes = profile(chain, z), z.reshape(-1, 6)[::-1]
    mirrored = profile(*along(chain.knots, nodes[:, :3] * [-1, 1, 1], nodes[:, 3:] * [1, 1, -1]))
    for name in ("z", "tension", "strain_tension", "horizontal", "moment"):
        np.testing.assert_allclose(
            getattr(mirrored, name)[::-1], getattr(shape, name), rtol=1e-9, atol=1e-9, err_msg=name
        )
    assert not np.allclose(mirrored.moment, shape.moment)


def parabola(depth: float) -> Profile:
    """Sample z = depth ((x/5)^2 - 1) from -5 to 5 m: depth ((b - a)/10)^2 below its chord from a to b."""
    x = np.linspace(-5.0, 5.0, 2001)
    none = np.zeros_like(x)
    z = depth * ((x / 5.0) ** 2 - 1.0)
    return Profile(x + 5.0, x, none, z, none, none, none, none, x, none, z)


@pytest.mark.parametrize(
    ("held", "deepest"),
    [((-5.0, 5.0), 10.0), ((-5.0, 0.0, 5.0), 5.0), ((-5.0, -1.0, 3.0, 5.0), 4.0), ((1.0, 2.0), 1.0)],
)
def test_sag_is_measured_from_the_chords(held: tuple[float, ...], deepest: float) -> None:
    x = np.array(held)
    height = 0.3 * ((x / 5.0) ** 2 - 1.0)
    assert sag(parabola(0.3), x, height) == pytest.approx(0.3 * (deepest / 10.0) ** 2, abs=1e-6)
    assert sag(parabola(0.31), x, height) != pytest.approx(0.3 * (deepest / 10.0) ** 2, abs=1e-6)


def test_a_wire_above_its_chords_has_no_sag() -> None:
    x = np.array([-5.0, 5.0])
    assert sag(parabola(-0.3), x, np.zeros(2)) == 0.0


def test_reactions_and_strain_at_supports(contact: WireModel) -> None:
    z = contact.system.unknowns.start.copy()
    z[contact.end_force] = [[3.0, 0.0, -4.0], [-12.0, 4.0, 3.0]]
    np.testing.assert_allclose(reactions(contact, z), [5.0, 13.0])
    np.testing.assert_allclose(support_strain_tension(contact, z), 0.0, atol=1e-4)
    z[contact.wire.nodes[:, 0]] *= STRETCH
    z[contact.wire.nodes[:, 3]] *= STRETCH
    N = 0.5 * contact.wire.section.EA * (STRETCH**2 - 1.0)
    np.testing.assert_allclose(support_strain_tension(contact, z), N, rtol=1e-9)


def check_complete(kept: Stage, z: FloatArray) -> None:
    parts = (kept.position, kept.slope, kept.sliding_coordinate, kept.parameter, kept.multiplier)
    everything = np.sort(np.concatenate([part.ravel() for part in parts]))
    np.testing.assert_array_equal(everything, np.sort(z))


def test_a_stage_lists_every_unknown_once(messenger: WireModel) -> None:
    z = np.arange(messenger.system.size, dtype=np.float64)
    kept = stage(messenger, z)
    check_complete(kept, z)
    assert kept.node_count.sum() == kept.s.size == kept.position.shape[0]
    assert kept.chain == ("messenger wire", *(f"dropper {i}" for i in range(1, 22)))
    with pytest.raises(AssertionError):
        check_complete(replace(kept, parameter=kept.parameter[1:]), z)
    with pytest.raises(AssertionError):
        check_complete(replace(kept, slope=kept.position), z)
