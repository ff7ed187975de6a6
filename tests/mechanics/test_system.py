"""The system: sum of its parts, sparsity, discrete state, and the table of unknowns."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from catenaria.errors import InconsistentInputError
from catenaria.mechanics.chain import Chain, Section
from catenaria.mechanics.elements.cable import CableElements
from catenaria.mechanics.joints.held_point import HeldPoints
from catenaria.mechanics.joints.sliding import SlidingJoints
from catenaria.mechanics.loads.gravity import Gravity, Ramp
from catenaria.mechanics.sparsity import SparsityPattern
from catenaria.mechanics.state import State
from catenaria.mechanics.system import System
from catenaria.mechanics.unknowns import Kind, UnknownsBuilder

Lay = Callable[..., Chain]


def model(lay_wire: Lay) -> tuple[System, Chain, np.ndarray]:
    """Return a hanging wire with supports in its first and last element, and their s."""
    builder = UnknownsBuilder()
    wire = lay_wire(builder, [0, 0, 0], [4, 0, 1], np.linspace(0.0, 4.0, 5), Section(1e3, 2.0, 1.0))
    s = builder.add(Kind.SLIDING, np.array([0.5, 3.5]))
    la = builder.add(Kind.MULTIPLIER, np.random.default_rng(1).normal(size=(3, 3)))
    table = builder.build()
    supports = SlidingJoints(wire, s, la[:2], np.array([0, 3]), np.array([[0.5, 0, 0.1], [3.5, 0, 0.9]]))
    end = HeldPoints(wire.nodes[:1, :3], la[2:], np.zeros((1, 3)), np.zeros((1, 3)), np.array([-1]))
    elements = CableElements.of([wire])
    gravity = Gravity(elements.weight(table.size), 9.8, Ramp(0.0))
    return System(table, (elements, gravity, supports, end)), wire, s


def test_residual_and_jacobian_are_sums(lay_wire: Lay) -> None:
    system, _, _ = model(lay_wire)
    state = State.at_rest(system.unknowns.start)
    total, matrix = np.zeros(system.size), np.zeros((system.size, system.size))
    for part in system.contributions:
        part.add_residual(state, total)
        np.add.at(matrix, part.pattern(), part.jacobian(state, 0.3, 0.2))
    np.testing.assert_allclose(system.residual(state), total, rtol=1e-14)
    np.testing.assert_allclose(system.jacobian(state, 0.3, 0.2).toarray(), matrix, rtol=1e-12, atol=1e-12)
    np.testing.assert_array_equal(
        system.jacobian(state).toarray(), system.jacobian(state, 0.0, 0.0).toarray()
    )


def check_conservative(system: System, state: State) -> None:
    """Elements and frictionless joints with constant multipliers have a symmetric Jacobian."""
    matrix = system.jacobian(state).toarray()
    np.testing.assert_allclose(matrix, matrix.T, atol=1e-12 * np.abs(matrix).max())


def test_symmetric(lay_wire: Lay) -> None:
    system, _, _ = model(lay_wire)
    rng = np.random.default_rng(2)
    z = system.unknowns.start + 0.1 * rng.normal(size=system.size)
    check_conservative(system, State.at_rest(z))

    class Lopsided(SlidingJoints):
        def jacobian(self, state: State, c1: float, c2: float) -> np.ndarray:
            entries = super().jacobian(state, c1, c2).copy()
            entries[: 12 * self.s.size] *= 1.001
            return entries

    part = system.contributions[2]
    assert isinstance(part, SlidingJoints)
    wrong = Lopsided(part.wire, part.s, part.multipliers, part.element, part.X)
    parts = tuple(wrong if other is part else other for other in system.contributions)
    with pytest.raises(AssertionError):
        check_conservative(System(system.unknowns, parts), State.at_rest(z))


def check_relocated(system: System, moved: System | None, z: np.ndarray, elements: list[int]) -> None:
    """A new system with the joints in the given elements; everything else is the same object."""
    assert moved is not None
    assert moved is not system
    assert moved.unknowns is system.unknowns
    for old, new in zip(system.contributions, moved.contributions, strict=True):
        if isinstance(new, SlidingJoints):
            np.testing.assert_array_equal(new.element, elements)
        else:
            assert new is old
    assert moved.relocate(z) is None


def test_relocate_returns_a_new_system_and_keeps_the_old(lay_wire: Lay) -> None:
    system, _, s = model(lay_wire)
    start = system.unknowns.start
    assert system.relocate(start) is None
    old_residual, old_matrix = system.residual(State.at_rest(start)), system.jacobian(State.at_rest(start))
    z = start.copy()
    z[s] = [1.7, 2.2]
    moved = system.relocate(z)
    check_relocated(system, moved, z, [1, 2])
    assert moved is not None
    joints = system.contributions[2]
    assert isinstance(joints, SlidingJoints)
    np.testing.assert_array_equal(joints.element, [0, 3])
    np.testing.assert_array_equal(system.residual(State.at_rest(start)), old_residual)
    np.testing.assert_array_equal(system.jacobian(State.at_rest(start)).toarray(), old_matrix.toarray())
    with pytest.raises(AssertionError):
        check_relocated(system, system, z, [1, 2])


def test_sparsity_follows_the_relocation(lay_wire: Lay) -> None:
    """The cached pattern of the old system must not be taken for the new one."""
    system, wire, s = model(lay_wire)
    _ = system.sparsity
    z = system.unknowns.start.copy()
    z[s] = [1.7, 2.2]
    moved = system.relocate(z)
    assert moved is not None
    place = moved.jacobian(State.at_rest(z)).toarray() != 0.0
    assert place[s[0], wire.nodes[2]].any()
    assert not place[s[0], wire.nodes[0]].any()


@pytest.mark.parametrize("seed", range(5))
def test_sparsity_pattern(seed: int) -> None:
    """Repeated entries share a place, columns are sorted by row, empty columns stay empty."""
    rng = np.random.default_rng(seed)
    rows, columns = rng.integers(0, 9, 40), rng.choice([0, 1, 3, 4, 8], 40)
    pattern = SparsityPattern.of(rows.astype(np.int32), columns.astype(np.int32), 9)
    entries = set(zip(columns.tolist(), rows.tolist(), strict=True))
    assert pattern.indices.size == len(entries)
    assert pattern.indptr.shape == (10,)
    found = [
        (column, int(row))
        for column in range(9)
        for row in pattern.indices[slice(*pattern.indptr[column : column + 2])]
    ]
    assert found == sorted(entries)
    assert [found[k] for k in pattern.place] == list(zip(columns.tolist(), rows.tolist(), strict=True))


def test_refuses_what_is_no_contribution(lay_wire: Lay) -> None:
    system, wire, _ = model(lay_wire)
    with pytest.raises(InconsistentInputError, match="Chain"):
        System(system.unknowns, (*system.contributions, wire))  # pyright: ignore[reportArgumentType]


def test_refuses_an_unknown_without_equation(lay_wire: Lay) -> None:
    """Without the supports nothing says where their sliding coordinates are."""
    system, _, s = model(lay_wire)
    parts = (*system.contributions[:2], *system.contributions[3:])
    with pytest.raises(InconsistentInputError, match=f"unknown {s[0]}"):
        System(system.unknowns, parts).jacobian(State.at_rest(system.unknowns.start))


def test_unknowns_table() -> None:
    builder = UnknownsBuilder()
    node = builder.add_node(np.array([1.0, 2.0, 3.0]), np.array([0.0, 0.0, 1.0]))
    la = builder.add(Kind.MULTIPLIER, np.full((2, 3), 7.0))
    s = builder.add(Kind.SLIDING, [0.5])
    p = builder.add(Kind.PARAMETER, np.zeros(0))
    table = builder.build()
    np.testing.assert_array_equal(node, np.arange(6))
    np.testing.assert_array_equal(la, [[6, 7, 8], [9, 10, 11]])
    np.testing.assert_array_equal(s, [12])
    assert p.size == 0
    assert table.size == 13
    np.testing.assert_array_equal(table.start, [1, 2, 3, 0, 0, 1, 7, 7, 7, 7, 7, 7, 0.5])
    np.testing.assert_array_equal(np.flatnonzero(table.where(Kind.SLOPE, Kind.SLIDING)), [3, 4, 5, 12])
    np.testing.assert_array_equal(np.flatnonzero(table.where(Kind.MULTIPLIER)), np.arange(6, 12))
    builder.add(Kind.POSITION, [1.0])
    assert table.size == 13, "a finished table does not grow"
