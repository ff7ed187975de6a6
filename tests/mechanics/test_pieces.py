"""Pieces whose length is a parameter: the same as cable elements of a mesh with the longer natural length."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from catenaria.mechanics.chain import Chain, Section
from catenaria.mechanics.controls.given import Given
from catenaria.mechanics.elements.cable import CableElements
from catenaria.mechanics.elements.pieces import Pieces
from catenaria.mechanics.joints.held_point import HeldPoints
from catenaria.mechanics.loads.gravity import Ramp
from catenaria.mechanics.state import State
from catenaria.mechanics.system import System
from catenaria.mechanics.unknowns import Kind, UnknownsBuilder

Lay = Callable[..., Chain]
Solve = Callable[..., tuple[System, np.ndarray]]
G, NOW = 9.81, Ramp(0.0)
SECTION, OTHER = Section(EA=5e3, EJ=30.0, rhoA=1.3), Section(EA=2e3, EJ=7.0, rhoA=0.4)
KNOTS = (np.array([0.0, 0.9, 2.0, 3.4]), np.array([0.0, 1.1, 1.8]))
EXTRA = np.array([0.21, -0.07])
SIZE, P = 44, np.array([42, 43])


def chains(factors: np.ndarray) -> tuple[Chain, Chain]:
    """Return two cables of 4 and 3 nodes whose material coordinates are multiplied."""
    first, second = np.arange(24).reshape(4, 6), np.arange(24, 42).reshape(3, 6)
    return Chain(first, factors[0] * KNOTS[0], SECTION), Chain(second, factors[1] * KNOTS[1], OTHER)


def models(gauss_points: int = 5) -> tuple[Pieces, CableElements, np.ndarray, np.ndarray]:
    """Return pieces, elements of the longer mesh, a bent state of the pieces, and dz_longer/dz_pieces.

    By natural arc the slopes are smaller by l than by the mesh's coordinate.
    """
    factors = 1.0 + EXTRA / [knots[-1] for knots in KNOTS]
    pieces = Pieces.of(chains(np.ones(2)), P, gauss_points, G, NOW)
    longer = CableElements.of(chains(factors), gauss_points)
    rng, z, scale = np.random.default_rng(9), np.zeros(SIZE), np.ones(SIZE)
    for chain, factor in zip(chains(np.ones(2)), factors, strict=True):
        angle = 0.4 * chain.knots
        z[chain.nodes[:, :3]] = np.column_stack((2.5 * np.sin(angle), 0.1 * angle, 2.5 * np.cos(angle)))
        z[chain.nodes[:, 3:]] = np.column_stack((np.cos(angle), 0.04 + 0.0 * angle, -np.sin(angle)))
        scale[chain.nodes[:, 3:]] = 1.0 / factor
    z[:42] += 0.02 * rng.normal(size=42)
    z[P] = EXTRA
    return pieces, longer, z, scale


def check_same_forces(pieces: Pieces, longer: CableElements, z: np.ndarray, scale: np.ndarray) -> None:
    """Elastic forces and weight, to 1e-10 of the largest."""
    f, expected = np.zeros(SIZE), np.zeros(SIZE)
    pieces.add_residual(State.at_rest(z), f)
    longer.add_residual(State.at_rest(scale * z), expected)
    expected -= G * longer.weight(SIZE)
    np.testing.assert_allclose(f, scale * expected, rtol=0.0, atol=1e-10 * np.abs(expected).max())


@pytest.mark.parametrize("gauss_points", [3, 5])
def test_equal_to_elements_of_the_longer_mesh(gauss_points: int) -> None:
    pieces, longer, z, scale = models(gauss_points)
    check_same_forces(pieces, longer, z, scale)
    f = scale[pieces.elements.dofs]
    expected = f[:, :, None] * longer.stiffness(scale * z) * f[:, None, :]
    np.testing.assert_allclose(pieces.stiffness(z), expected, rtol=0.0, atol=1e-10 * np.abs(expected).max())
    np.testing.assert_allclose(pieces.energies(z), longer.energies(scale * z), rtol=1e-10)


@pytest.mark.parametrize("k", [0, 1])
def test_control_other_length_has_other_forces(k: int) -> None:
    pieces, longer, z, scale = models()
    z[P[k]] += 1e-6
    with pytest.raises(AssertionError):
        check_same_forces(pieces, longer, z, scale)


def test_control_without_natural_strain_forces_differ() -> None:
    """Other stiffnesses alone do not make a longer cable."""

    class Unrelieved(Pieces):
        def _relief(self, factor: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
            return 0.0 * factor, 0.0 * factor

    pieces, longer, z, scale = models()
    wrong = Unrelieved(pieces.elements, pieces.parameter, pieces.whole, G, NOW)
    with pytest.raises(AssertionError):
        check_same_forces(wrong, longer, z, scale)


def test_no_extra_length_is_a_cable() -> None:
    pieces, _, z, _ = models()
    z[P] = 0.0
    check_same_forces(pieces, CableElements.of(chains(np.ones(2))), z, np.ones(SIZE))
    np.testing.assert_array_equal(pieces.mass(), CableElements.of(chains(np.ones(2))).mass())


def test_forces_are_derivatives_of_the_energy() -> None:
    """By every coordinate; the weight is switched off."""
    pieces, _, z, _ = models()
    pieces = replace(pieces, g=0.0)
    f = np.zeros(SIZE)
    pieces.add_residual(State.at_rest(z), f)
    h, numerical = 1e-4, np.zeros(42)
    for k in range(42):
        step = h * np.eye(SIZE)[k]
        numerical[k] = (pieces.energies(z + step).sum() - pieces.energies(z - step).sum()) / (2.0 * h)
    np.testing.assert_allclose(f[:42], numerical, atol=1e-4 * np.abs(f).max())
    with pytest.raises(AssertionError):
        np.testing.assert_allclose(1.001 * f[:42], numerical, atol=1e-4 * np.abs(f).max())


def straight(factor: float) -> np.ndarray:
    """Return a state in which the first cable is straight and uniformly stretched by a factor."""
    z = np.zeros(SIZE)
    for chain in chains(np.ones(2)):
        z[chain.nodes[:, 0]], z[chain.nodes[:, 3]] = factor * chain.knots, factor
    return z


def test_at_its_natural_length_a_piece_is_without_force() -> None:
    pieces = replace(models()[0], g=0.0)
    for extra in (0.3, 0.0, -0.2):
        factor, f = 1.0 + extra / 3.4, np.zeros(SIZE)
        z = straight(factor)
        z[P[0]] = extra
        pieces.add_residual(State.at_rest(z), f)
        assert np.abs(f[:24]).max() < 1e-11 * SECTION.EA
        assert np.abs(pieces.energies(z)[:3, 0]).max() < 1e-11 * SECTION.EA
        z[P[0]] += 1e-3
        pieces.add_residual(State.at_rest(z), f := np.zeros(SIZE))
        assert f[0] > 1.0, "longer than where its ends are, it pushes them apart"


def test_weight_grows_with_the_length() -> None:
    pieces, _, z, _ = models()
    f, without = np.zeros(SIZE), np.zeros(SIZE)
    pieces.add_residual(State.at_rest(z), f)
    replace(pieces, g=0.0).add_residual(State.at_rest(z), without)
    positions = np.concatenate([chain.nodes[:, 2] for chain in chains(np.ones(2))])
    whole = SECTION.rhoA * (3.4 + EXTRA[0]) + OTHER.rhoA * (1.8 + EXTRA[1])
    np.testing.assert_allclose((f - without)[positions].sum(), G * whole, rtol=1e-12)


def test_where_no_length_is_left_there_is_no_number() -> None:
    """A damped Newton method takes it for a step that leads nowhere."""
    pieces, _, z, _ = models()
    z[P[1]] = -1.8
    f = np.zeros(SIZE)
    pieces.add_residual(State.at_rest(z), f)
    assert np.isnan(f[24:42]).all()
    assert np.isfinite(f[:24]).all()


def check_tension(pull: float, distance: float, natural: float) -> None:
    """The closed form of a straight cable with Green strain."""
    a = distance / natural
    np.testing.assert_allclose(pull, SECTION.EA * 0.5 * (a * a - 1.0) * a, rtol=1e-9)


def test_shorter_piece_is_tighter(lay_wire: Lay, solve_statics: Solve) -> None:
    builder = UnknownsBuilder()
    wire = lay_wire(builder, [0, 0, 0], [0, 10.05, 0], np.linspace(0.0, 10.0, 6), SECTION)
    ends, p = builder.add(Kind.MULTIPLIER, np.zeros((2, 3))), builder.add(Kind.PARAMETER, [0.0])
    table = builder.build()
    nodes = wire.nodes[[0, -1], :3]
    hinges = HeldPoints(nodes, ends, table.start[nodes], np.zeros((2, 3)), np.array([-1, -1]))
    for extra in (0.02, -0.03):
        piece = Pieces.of([wire], p, 5, 0.0, NOW)
        _, z = solve_statics(System(table, (piece, hinges, Given(p, np.array([extra])))), table.start)
        check_tension(float(z[ends[0, 1]]), 10.05, 10.0 + extra)
        with pytest.raises(AssertionError):
            check_tension(float(z[ends[0, 1]]), 10.05, 10.0)
