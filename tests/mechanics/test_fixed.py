"""The fixed joint (16): rank in 3D, the printed form's zero gradient, and statics against shared nodes."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from catenaria.errors import InconsistentInputError
from catenaria.mechanics.chain import Chain, Section
from catenaria.mechanics.elements.cable import CableElements
from catenaria.mechanics.joints.fixed import FixedJoints, normals
from catenaria.mechanics.loads.gravity import Gravity, Ramp
from catenaria.mechanics.state import State
from catenaria.mechanics.system import System
from catenaria.mechanics.unknowns import Kind, UnknownsBuilder

Lay = Callable[..., Chain]
Solve = Callable[..., tuple[System, np.ndarray]]
NODES = np.arange(12, dtype=np.int64).reshape(2, 6)
LA = np.arange(12, 17, dtype=np.int64)[None, :]
LENGTH = 2.0


def joint(tangent: np.ndarray) -> FixedJoints:
    return FixedJoints(NODES[:1], NODES[1:], LA, normals(tangent[None, :]))


def constraint_gradient(part: FixedJoints, z: np.ndarray) -> np.ndarray:
    """Return C_q, shape (5, 12), by complex step."""
    rows = []
    for step in np.eye(17)[:12] * 1e-30j:
        f: Any = np.zeros(17, dtype=np.complex128)
        part.add_residual(State(0.0, z + step, z, z), f)
        rows.append(f[12:].imag / 1e-30)
    return np.array(rows).T


def printed_gradient(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Return the gradient by both slopes of the last row of (16), a . b - |a| |b|, shape (6,)."""
    size_a, size_b = np.linalg.norm(a), np.linalg.norm(b)
    return np.concatenate((b - a * size_b / size_a, a - b * size_a / size_b))


def joined(turn: np.ndarray, angle: float = 0.0) -> np.ndarray:
    """Return two nodes at one place with parallel slopes of different length, turned from `turn`'s x axis."""
    a = turn @ [np.cos(angle), np.sin(angle) * 0.6, np.sin(angle) * 0.8]
    r = np.array([3.0, -1.0, 2.0])
    return np.concatenate((r, 1.02 * a, r, 0.97 * a, np.zeros(5)))


def check_fixes_five(gradient: np.ndarray) -> None:
    """Five independent constraints: three positions, two directions."""
    values = np.linalg.svd(gradient, compute_uv=False)
    assert np.sum(values > 1e-6 * values[0]) == 5


@pytest.mark.parametrize("angle", [0.0, 0.7, 1.4, 2.5])
def test_five_independent_constraints(turn: np.ndarray, angle: float) -> None:
    """At a solution in a generic orientation, near its start and far from it."""
    part, z = joint(turn[:, 0]), joined(turn, angle)
    f = np.zeros(17)
    part.add_residual(State.at_rest(z), f)
    np.testing.assert_allclose(f, 0.0, atol=1e-14)
    check_fixes_five(constraint_gradient(part, z))


def test_dependent_only_at_a_right_angle(turn: np.ndarray) -> None:
    """The limit that the docstring states is real."""
    part = joint(turn[:, 0])
    with pytest.raises(AssertionError):
        check_fixes_five(constraint_gradient(part, joined(turn, 0.5 * np.pi)))
    check_fixes_five(constraint_gradient(part, joined(turn, 0.49 * np.pi)))


def test_control_printed_form_has_zero_gradient(turn: np.ndarray) -> None:
    """Wherever the printed row holds, its gradient vanishes: linearised it fixes nothing."""
    z = joined(turn)
    gradient = printed_gradient(z[3:6], z[9:12])
    np.testing.assert_allclose(gradient, 0.0, atol=1e-15)
    assert np.abs(printed_gradient(z[3:6], z[9:12] + 0.1)).max() > 1e-3
    rows = constraint_gradient(joint(turn[:, 0]), z)
    printed = np.zeros((4, 12))
    printed[:3], printed[3, [3, 4, 5, 9, 10, 11]] = rows[:3], gradient
    with pytest.raises(AssertionError):
        check_fixes_five(printed)


def test_constraint_forces_are_workless(turn: np.ndarray) -> None:
    """Forces and moments of both nodes balance: nothing acts on the joined body as a whole."""
    part, z = joint(turn[:, 0]), joined(turn, 0.4)
    z[12:] = np.random.default_rng(7).normal(size=5)
    f = np.zeros(17)
    part.add_residual(State.at_rest(z), f)
    np.testing.assert_allclose(f[:12], constraint_gradient(part, z).T @ z[12:], atol=1e-14)
    forces, arms = f[:12].reshape(4, 3), z[:12].reshape(4, 3)
    np.testing.assert_allclose(forces[::2].sum(axis=0), 0.0, atol=1e-14)
    np.testing.assert_allclose(np.cross(arms, forces).sum(axis=0), 0.0, atol=1e-13)


def test_normals() -> None:
    tangents = np.random.default_rng(12).normal(size=(50, 3))
    tangents[:3] = np.eye(3)
    e = normals(tangents)
    np.testing.assert_allclose(np.einsum("nki,nmi->nkm", e, e), np.tile(np.eye(2), (50, 1, 1)), atol=1e-14)
    np.testing.assert_allclose(np.einsum("nki,ni->nk", e, tangents), 0.0, atol=1e-14)
    with pytest.raises(InconsistentInputError):
        normals(np.zeros((1, 3)))


def cut_cantilever(
    lay_wire: Lay, turn: np.ndarray, sections: tuple[Section, Section]
) -> tuple[System, Chain, Chain]:
    """Return a wire along `turn`'s x axis of two chains with unequal elements, joined at 0.7 m."""
    builder = UnknownsBuilder()
    at = 0.7 * turn[:, 0]
    first = lay_wire(builder, [0, 0, 0], at, np.array([0.0, 0.5, 0.7]), sections[0])
    second = lay_wire(builder, at, LENGTH * turn[:, 0], np.array([0.7, 1.6, LENGTH]), sections[1])
    la = builder.add(Kind.MULTIPLIER, np.zeros((1, 5)))
    part = FixedJoints(first.nodes[-1:], second.nodes[:1], la, normals(turn[:, :1].T))
    return System(builder.build(), (CableElements.of([first, second]), part)), first, second


def tip_load(system: System, second: Chain, direction: np.ndarray, size: float) -> np.ndarray:
    load = np.zeros(system.size)
    load[second.nodes[-1, :3]] = size * direction
    return load


def check_tip(tip: np.ndarray, direction: np.ndarray, size: float, EJ: float) -> None:
    np.testing.assert_allclose(tip, size * LENGTH**3 / (3.0 * EJ) * direction, rtol=1e-5, atol=2e-5 * size)


def test_transmits_the_bending_moment(lay_wire: Lay, solve_statics: Solve, turn: np.ndarray) -> None:
    """The tip of a joined cantilever sinks by P L^3/(3 EJ), the same in both directions across it."""
    section = Section(EA=1e4, EJ=5.0, rhoA=1.0)
    for direction in (turn[:, 1], 0.6 * turn[:, 1] - 0.8 * turn[:, 2]):
        system, first, second = cut_cantilever(lay_wire, turn, (section, section))
        load = tip_load(system, second, direction, 1e-4)
        _, z = solve_statics(system, system.unknowns.start, first.nodes[0], load)
        tip = z[second.nodes[-1, :3]] - LENGTH * turn[:, 0]
        check_tip(tip, direction, 1e-4, section.EJ)
        with pytest.raises(AssertionError):
            check_tip(tip, direction, 1e-4, 1.001 * section.EJ)


def check_series_stretch(z: np.ndarray, first: Chain, second: Chain, turn: np.ndarray, pull: float) -> None:
    """Two stiffnesses in series: each its own uniform stretch, exactly."""
    for chain in (first, second):
        roots = np.roots([0.5 * chain.section.EA, 0.0, -0.5 * chain.section.EA, -pull])
        stretch = roots.real[np.argmin(np.abs(roots - 1.0))]
        slopes = z[chain.nodes[:, 3:]]
        np.testing.assert_allclose(slopes, np.tile(stretch * turn[:, 0], (slopes.shape[0], 1)), atol=1e-9)


def test_slopes_may_differ_in_length(lay_wire: Lay, solve_statics: Solve, turn: np.ndarray) -> None:
    """The strain jumps between a stiff and a soft piece, which a shared node cannot represent."""
    sections = (Section(1e4, 5.0, 1.0), Section(3e3, 5.0, 1.0))
    system, first, second = cut_cantilever(lay_wire, turn, sections)
    _, z = solve_statics(
        system, 1.005 * system.unknowns.start, first.nodes[0, :3], tip_load(system, second, turn[:, 0], 100.0)
    )
    check_series_stretch(z, first, second, turn, 100.0)
    with pytest.raises(AssertionError):
        check_series_stretch(z, second, first, turn, 101.0)


def loaded_wire(lay_wire: Lay, solve_statics: Solve, turn: np.ndarray, count: int, cut: bool) -> np.ndarray:
    """Return the tip of a clamped wire under a large dead load, in one piece or cut at a node."""
    knots = LENGTH * np.linspace(0.0, 1.0, count + 1) ** 1.3
    section, at = Section(EA=2e3, EJ=5.0, rhoA=1.0), count // 2
    builder = UnknownsBuilder()
    if cut:
        ends = (knots[0], knots[at], knots[-1])
        chains = [
            lay_wire(builder, ends[k] * turn[:, 0], ends[k + 1] * turn[:, 0], part, section)
            for k, part in enumerate((knots[: at + 1], knots[at:]))
        ]
    else:
        chains = [lay_wire(builder, 0.0 * turn[:, 0], LENGTH * turn[:, 0], knots, section)]
    la = builder.add(Kind.MULTIPLIER, np.zeros((int(cut), 5)))
    table = builder.build()
    elements = CableElements.of(chains)
    parts: tuple = (elements, Gravity(elements.weight(table.size), 9.81, Ramp(0.0)))
    if cut:
        parts += (FixedJoints(chains[0].nodes[-1:], chains[1].nodes[:1], la, normals(turn[:, :1].T)),)
    system = System(table, parts)
    load = np.zeros(table.size)
    load[chains[-1].nodes[-1, :3]] = 2.0 * turn[:, 1] + 1.5 * turn[:, 2]
    clamp = chains[0].nodes[0]
    _, z = solve_statics(system, table.start, clamp, load)
    return z[chains[-1].nodes[-1, :3]]


def test_same_statics_as_shared_nodes(lay_wire: Lay, solve_statics: Solve, turn: np.ndarray) -> None:
    """Large bending in space: the tips of cut and uncut wire approach each other under refinement."""
    differences = []
    for count in (4, 8, 16):
        tips = [loaded_wire(lay_wire, solve_statics, turn, count, cut) for cut in (False, True)]
        differences.append(np.linalg.norm(tips[0] - tips[1]))
        assert np.linalg.norm(tips[0] - LENGTH * turn[:, 0]) > 0.5
    assert differences[2] < 1e-5
    assert differences[2] < 0.2 * differences[0]


def check_sum_of_its_joints(batch: FixedJoints, singles: list[FixedJoints], z: np.ndarray) -> None:
    """A batch is the sum of its joints, also where they share a node."""
    total, f = np.zeros(z.size), np.zeros(z.size)
    for single in singles:
        single.add_residual(State.at_rest(z), total)
    batch.add_residual(State.at_rest(z), f)
    np.testing.assert_allclose(f, total, rtol=1e-13, atol=1e-14)


def test_two_joints_on_one_node() -> None:
    z = np.random.default_rng(6).normal(size=28)
    i, hub, la = np.arange(12).reshape(2, 6), np.arange(12, 18), np.arange(18, 28).reshape(2, 5)
    both, e = np.stack((hub, hub)), normals(np.eye(3)[:2])
    for a, b in ((i, both), (both, i)):
        singles = [FixedJoints(a[k : k + 1], b[k : k + 1], la[k : k + 1], e[k : k + 1]) for k in (0, 1)]
        check_sum_of_its_joints(FixedJoints(a, b, la, e), singles, z)
        with pytest.raises(AssertionError):
            check_sum_of_its_joints(FixedJoints(a, b, la, e), singles[:1], z)
