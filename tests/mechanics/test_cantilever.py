"""A cable clamped at its root by two held points, of position and of slope, as a cantilever."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from catenaria.mechanics.chain import Chain, Section
from catenaria.mechanics.elements.cable import CableElements
from catenaria.mechanics.joints.held_point import HeldPoints
from catenaria.mechanics.system import System
from catenaria.mechanics.unknowns import Kind, UnknownsBuilder

Lay = Callable[..., Chain]
Solve = Callable[..., tuple[System, np.ndarray]]
SECTION, LENGTH = Section(EA=1e7, EJ=4e3, rhoA=5.0), 2.5


def loaded(
    lay_wire: Lay, solve_statics: Solve, force: np.ndarray, turn: np.ndarray, count: int = 3
) -> tuple[np.ndarray, np.ndarray]:
    """Return the tip's displacement and what the clamp feels of force and moment, in the beam's axes."""
    builder = UnknownsBuilder()
    beam = lay_wire(builder, [0, 0, 0], LENGTH * turn[:, 0], np.linspace(0.0, LENGTH, count + 1), SECTION)
    la = builder.add(Kind.MULTIPLIER, np.zeros((2, 3)))
    table = builder.build()
    root = np.stack((beam.nodes[0, :3], beam.nodes[0, 3:]))
    clamp = HeldPoints(root, la, table.start[root], np.zeros((2, 3)), np.array([-1, -1]))
    load = np.zeros(table.size)
    load[beam.nodes[-1, :3]] = turn @ force
    _, z = solve_statics(System(table, (CableElements.of([beam]), clamp)), table.start, load=load)
    return (z[beam.nodes[-1, :3]] - LENGTH * turn[:, 0]) @ turn, z[la] @ turn


def check_beam(displacement: np.ndarray, clamp: np.ndarray, force: np.ndarray, EJ: float) -> None:
    """Deflection F L^3/(3 EJ) of the tip; force F and moment F L at the root."""
    np.testing.assert_allclose(displacement[1:], force[1:] * LENGTH**3 / (3.0 * EJ), rtol=1e-4)
    np.testing.assert_allclose(clamp[0], force, atol=1e-6)
    np.testing.assert_allclose(clamp[1, 1:], force[1:] * LENGTH, rtol=1e-4)


def test_tip_load(lay_wire: Lay, solve_statics: Solve, turn: np.ndarray) -> None:
    force = np.array([0.0, 0.4, -0.7])
    displacement, clamp = loaded(lay_wire, solve_statics, force, turn)
    check_beam(displacement, clamp, force, SECTION.EJ)
    with pytest.raises(AssertionError):
        check_beam(displacement, clamp, force, 1.001 * SECTION.EJ)


def test_control_large_load_leaves_the_linear_theory(
    lay_wire: Lay, solve_statics: Solve, turn: np.ndarray
) -> None:
    force = np.array([0.0, 0.0, 900.0])
    with pytest.raises(AssertionError):
        check_beam(*loaded(lay_wire, solve_statics, force, turn, 6), force, SECTION.EJ)


@pytest.mark.parametrize("count", [2, 4, 8])
def test_root_without_strain_costs_part_of_an_element(
    lay_wire: Lay, solve_statics: Solve, turn: np.ndarray, count: int
) -> None:
    """Held by its whole slope, the root does not stretch; the cable gives along itself by a little less."""
    displacement, clamp = loaded(lay_wire, solve_statics, np.array([1000.0, 0.0, 0.0]), turn, count)
    np.testing.assert_allclose(clamp[0], [1000.0, 0.0, 0.0], atol=1e-6)
    missing = 1.0 - displacement[0] * SECTION.EA / (1000.0 * LENGTH)
    np.testing.assert_allclose(missing * count, 0.118, atol=2e-3)
