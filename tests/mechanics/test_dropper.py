"""Dropper bars between two straight wires against statics by hand."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from catenaria.mechanics.chain import Chain, Section
from catenaria.mechanics.elements.dropper import Droppers
from catenaria.mechanics.state import State
from catenaria.mechanics.unknowns import Kind, UnknownsBuilder

EA, RHO_A, G = 1.19e6, 0.089, 9.8
SECTION = Section(1e6, 0.0, 1.0)


def two_wires(shift: float = 0.0, length: float = 1.2) -> tuple[Droppers, np.ndarray]:
    """Return one dropper between straight wires 1.2 m apart, its upper clamp shifted along the track."""
    unknowns = UnknownsBuilder()
    knots = np.array([0.0, 4.0])
    along = np.tile([1.0, 0.0, 0.0], (2, 1))
    lower = unknowns.add_nodes(np.array([[0.0, 0, 0], [4.0, 0, 0]]), along)
    upper = unknowns.add_nodes(np.array([[0.0, 0, 1.2], [4.0, 0, 1.2]]), along)
    s = unknowns.add(Kind.SLIDING, [1.0]), unknowns.add(Kind.SLIDING, [1.0 + shift])
    l0 = unknowns.add(Kind.PARAMETER, [length])
    wires = Chain(lower, knots, SECTION), Chain(upper, knots, SECTION)
    one = np.array([0])
    bars = Droppers(*wires, *s, one, one, l0, np.array([1.0]), EA, RHO_A, 0.2, 0.1, G)
    return bars, unknowns.build().start


def check_loads(bars: Droppers, z: np.ndarray, tension: float) -> None:
    """The lower wire is lifted by the tension; each wire carries half of the weight and its clamp."""
    on_lower, on_upper = bars.loads(z)
    half = 0.5 * RHO_A * 1.2 * G
    np.testing.assert_allclose(on_lower[0], [0.0, 0.0, tension - half - 0.2 * G], rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(on_upper[0], [0.0, 0.0, -tension - half - 0.1 * G], rtol=1e-9, atol=1e-12)


def test_pull_of_a_stretched_bar() -> None:
    bars, z = two_wires(length=1.1999)
    x = 1.2 / 1.1999
    check_loads(bars, z, EA * 0.5 * (x**2 - 1.0) * x)


def test_engineering_strain_is_noticed() -> None:
    bars, z = two_wires(length=1.19)
    with pytest.raises(AssertionError):
        check_loads(bars, z, EA * (1.2 / 1.19 - 1.0))


def test_a_slack_bar_only_weighs() -> None:
    bars, z = two_wires(length=1.25)
    check_loads(bars, z, 0.0)
    x = 1.2 / 1.25
    check_loads(replace(bars, may_push=True), z, EA * 0.5 * (x**2 - 1.0) * x)


def test_forces_on_the_nodes_are_those_on_the_wires() -> None:
    bars, z = two_wires(length=1.1999)
    f = np.zeros_like(z)
    bars.add_residual(State.at_rest(z), f)
    for wire, load in zip((bars.lower, bars.upper), bars.loads(z), strict=True):
        np.testing.assert_allclose(-f[wire.nodes[:, :3]].sum(axis=0), load[0], atol=1e-12)


def test_a_guide_takes_the_force_along_the_track_and_a_clamp_does_not() -> None:
    guided, z = two_wires(shift=0.3, length=1.2)
    clamped = replace(guided, clamped=(z[guided.s_lower], z[guided.s_upper]))
    assert guided.loads(z)[0][0, 0] == 0.0
    pull = clamped.loads(z)[0][0] + [0.0, 0.0, 0.5 * RHO_A * np.hypot(1.2, 0.3) * G + 0.2 * G]
    assert pull[0] / pull[2] == pytest.approx(0.3 / 1.2)
    f, h = np.zeros_like(z), np.zeros_like(z)
    guided.add_residual(State.at_rest(z), f)
    clamped.add_residual(State.at_rest(z), h)
    assert f[guided.s_upper[0]] == pytest.approx(0.3)  # x(s) = X is not met
    assert h[guided.s_upper[0]] == 0.0  # s = s* is
