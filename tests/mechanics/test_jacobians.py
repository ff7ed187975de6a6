"""Every contribution's Jacobian and every measure's gradient against numerical derivatives.

The classes are found by walking the package: a new one without an entry below fails the tests.
"""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Callable
from dataclasses import dataclass, replace
from types import ModuleType
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import catenaria
from catenaria.mechanics.carrier import Strands
from catenaria.mechanics.chain import Chain, Section
from catenaria.mechanics.contribution import Contribution, Relocatable
from catenaria.mechanics.controls.balance import ForceBalance
from catenaria.mechanics.controls.control import Controls, Measure
from catenaria.mechanics.controls.given import Given
from catenaria.mechanics.controls.measures import (
    DropperForce,
    Height,
    HungForce,
    ReactionTension,
    StrainTension,
    WireHeight,
)
from catenaria.mechanics.controls.pull import Pull
from catenaria.mechanics.controls.sprung import Sprung
from catenaria.mechanics.controls.target import Targets
from catenaria.mechanics.controls.track_height import TrackHeight
from catenaria.mechanics.controls.value import Value
from catenaria.mechanics.controls.velocity_law import VelocityLaw
from catenaria.mechanics.elements.arms import Arms
from catenaria.mechanics.elements.bars import Bars
from catenaria.mechanics.elements.cable import CableElements
from catenaria.mechanics.elements.dropper import Droppers
from catenaria.mechanics.elements.pieces import Pieces
from catenaria.mechanics.joints.clamps import Clamps
from catenaria.mechanics.joints.fixed import FixedJoints, normals
from catenaria.mechanics.joints.guided import GuidedJoints
from catenaria.mechanics.joints.guides import Guides
from catenaria.mechanics.joints.held_across import HeldAcross
from catenaria.mechanics.joints.held_point import HeldPoints
from catenaria.mechanics.joints.hung_point import HungPoints
from catenaria.mechanics.joints.sliding import SlidingJoints
from catenaria.mechanics.joints.spherical import SphericalJoints
from catenaria.mechanics.joints.supports import Supports
from catenaria.mechanics.joints.ties import Ties
from catenaria.mechanics.loads.dead import DeadLoads
from catenaria.mechanics.loads.gravity import Gravity, Ramp
from catenaria.mechanics.loads.hung_masses import HungMasses
from catenaria.mechanics.loads.linear import Inertia, RayleighDamping, assemble, point_masses
from catenaria.mechanics.state import State
from catenaria.mechanics.system import System
from catenaria.mechanics.unknowns import Unknowns

SURFACES = ("cli", "studio", "report", "workflow", "__main__")  # no mechanics by the layer contract
SIZE = 48
C1, C2 = 1.7, 0.6
SECTION = Section(EA=50.0, EJ=3.0, rhoA=1.3)
RAMP = Ramp(duration=4.0)
TIME = 1.5  # inside the ramp
COMPLEX = np.complex128

Matrix = NDArray[np.float64]

# One shuffled numbering for all parts, so that nothing depends on an order of the unknowns.
NUMBERS = np.random.default_rng(11).permutation(SIZE)
WIRE = Chain(NUMBERS[:18].reshape(3, 6), np.array([0.3, 1.0, 2.2]), SECTION)
OTHER = NUMBERS[18:30].reshape(2, 6)
S, LA, P = NUMBERS[30:32], NUMBERS[32:44], NUMBERS[44:48]
IN_ELEMENT = np.array([0, 1])
UNIT = np.array([[0.6, 0.0, -0.8], [0.48, 0.64, 0.6]])


def generic_state() -> State:
    """Return a state with large rotations and stretches, multipliers, velocities and accelerations."""
    rng = np.random.default_rng(2017)
    z = rng.normal(size=SIZE)
    angle = 0.9 * WIRE.knots
    z[WIRE.nodes[:, :3]] += np.column_stack((2.0 * np.sin(angle), WIRE.knots, 2.0 * np.cos(angle)))
    z[S] = [0.55, 1.7]
    return State(TIME, z, rng.normal(size=SIZE), rng.normal(size=SIZE))


def elements() -> CableElements:
    return CableElements(
        WIRE.dofs, WIRE.L, np.array([50.0, 20.0]), np.array([3.0, 7.0]), np.array([1.3, 0.4]), gauss_points=4
    )


def mass() -> Inertia:
    cables = elements()
    point, _ = point_masses(OTHER[:, :3], np.array([2.0, 3.0]), SIZE)
    return Inertia(assemble(cables, cables.mass(), SIZE) + point)


def damping() -> RayleighDamping:
    cables = elements()
    stiffness = assemble(cables, cables.stiffness(generic_state().z), SIZE)
    return RayleighDamping(0.4 * mass().M + 0.02 * stiffness)


def gravity() -> Gravity:
    return Gravity(elements().weight(SIZE), 9.81, RAMP)


def supports() -> SlidingJoints:
    return SlidingJoints(WIRE, S, LA[:6].reshape(2, 3), IN_ELEMENT, UNIT)


def clamps() -> SlidingJoints:
    return SlidingJoints(WIRE, S, LA[:6].reshape(2, 3), IN_ELEMENT, UNIT, OTHER[:, :3])


def guides() -> GuidedJoints:
    return GuidedJoints(WIRE, S, LA[:6].reshape(2, 3), IN_ELEMENT, np.array([0.4, -1.0]), OTHER[:, :3])


def fixed() -> FixedJoints:
    return FixedJoints(WIRE.nodes[[0, 2]], OTHER, LA[:10].reshape(2, 5), normals(UNIT + 0.1))


def hinges() -> SphericalJoints:
    return SphericalJoints(WIRE.nodes[:2, :3], OTHER[:, :3], LA[6:].reshape(2, 3))


def held() -> HeldPoints:
    """Return four points: two share a parameter, one is fixed, one has its own."""
    nodes = np.concatenate((WIRE.nodes[[0, 2], :3], OTHER[:, :3]))
    direction = np.concatenate((UNIT, -UNIT))
    return HeldPoints(nodes, LA.reshape(4, 3), direction + 0.3, direction, np.array([P[0], -1, P[1], P[0]]))


def bars(clamped: bool) -> Droppers:
    """Return a taut bar between the wire and another one of one element."""
    upper = Chain(OTHER, np.array([0.3, 2.2]), SECTION)
    at = (np.array([0.5]), np.array([1.6])) if clamped else None
    one = np.array([0])
    s, x = (S[:1], S[1:]), UNIT[0, :1]
    return Droppers(WIRE, upper, *s, one, one, P[:1], x, 50.0, 0.3, 0.1, 0.2, 9.81, at, may_push=True)


def leaning(only_pull: bool, length: NDArray[np.int64]) -> Bars:
    """Return an elastic and a rigid bar from the wire to another one and to itself; slack if it has P[0]."""
    upper = Strands.on((Chain(OTHER, np.array([0.3, 2.2]), SECTION), WIRE), np.array([0, 1]))
    s = (S, S[::-1])
    at = (IN_ELEMENT, np.array([0, 1]))
    section = (np.array([0.02, 0.0]), np.array([0.3, 0.2]), np.array([0.1, 0.4]), np.array([0.2, 0.5]))
    return Bars(WIRE, upper, *s, *at, LA[:2], length, *section, 9.81, RAMP, only_pull)


def rollers(nodes: NDArray[np.int64] | None = None) -> Supports:
    """Return a rigid support with friction and a spring with friction the other way."""
    spring = np.array([[0.3, 0.1, 0.0], [0.1, 0.4, -0.2], [0.0, -0.2, 0.5]])
    compliance, friction = np.stack((np.zeros((3, 3)), spring)), np.array([0.3, -0.2])
    return Supports(WIRE, S, LA[:6].reshape(2, 3), IN_ELEMENT, UNIT, compliance, friction, nodes)


def brackets() -> HeldAcross:
    """Return a point held at a height and one with a given lift, on tracks of different directions."""
    along, lift = np.array([[0.6, 0.8, 0.0], [-0.28, 0.96, 0.0]]), np.array([np.nan, 3.0])
    return HeldAcross(WIRE, S, LA[:4].reshape(2, 2), IN_ELEMENT, UNIT, along, lift)


def arms() -> Arms:
    return Arms(WIRE, S, LA[:2], IN_ELEMENT, UNIT, np.array([0.9, 1.4]), np.array([2.0, 3.0]), 9.81, RAMP)


def pieces() -> Pieces:
    """Return two cables of two and one elements, both made longer."""
    return Pieces.of((WIRE, Chain(OTHER, np.array([0.3, 2.2]), SECTION)), P[1:3], 4, 9.81, RAMP)


def reaction() -> ReactionTension:
    return ReactionTension(LA[:6].reshape(2, 3), UNIT)


def strain() -> StrainTension:
    return StrainTension(WIRE, S, IN_ELEMENT)


def height() -> Height:
    return Height(OTHER[:, 2])


def force_balance() -> ForceBalance:
    sign, mass = np.array([[1.0, -1.0], [-1.0, -1.0]]), np.array([0.3, 0.5])
    return ForceBalance(LA[:4].reshape(2, 2), sign, OTHER[:, [2, 1]], 0.2 * mass, mass, 9.81, RAMP)


def dropper() -> DropperForce:
    return DropperForce(LA[[2, 5]], OTHER[:, :3], 0.3 * UNIT, 0.2, np.array([0.3, 0.5]), 9.81, RAMP)


def hung_force() -> HungForce:
    top = WireHeight(WIRE, S, IN_ELEMENT)
    return HungForce(LA[:2], top, np.array([-0.4, 0.3]), 0.2, np.array([0.3, 0.5]), 9.81)


def controls(measure: Measure, parameter: NDArray[np.int64]) -> Controls:
    """Return controls whose errors lie on both curved branches of the law, far from its breaks."""
    return aimed(
        Controls(parameter, measure, np.zeros(2), VelocityLaw(0.8, 0.5, 2.5), RAMP, RAMP), generic_state()
    )


def aimed(part: Controls, state: State) -> Controls:
    """Return the same controls with targets and bands that fit the state and the size of the gradients."""
    width = max(1.0, float(np.abs(part.measure.gradient(state.t, state.z)).max()))
    target = part.measure.value(state.t, state.z) - width * np.array([1.1, -1.6])
    target = target / part.target_ramp(state.t)
    return replace(part, target=target, law=VelocityLaw(0.8, 0.5 * width, 2.5 * width))


@dataclass(frozen=True)
class Entry:
    """How to make a part, and whether its code takes complex unknowns."""

    make: Callable[[], Contribution]
    complex_step: bool = True


PARTS: dict[str, Entry] = {
    "CableElements": Entry(elements, complex_step=False),
    "Inertia": Entry(mass),
    "RayleighDamping": Entry(damping),
    "Gravity": Entry(gravity),
    "DeadLoads": Entry(lambda: DeadLoads(np.random.default_rng(5).normal(size=SIZE))),
    "SlidingJoints": Entry(supports),
    "SlidingJoints of nodes": Entry(clamps),
    "GuidedJoints": Entry(guides),
    "HungPoints": Entry(lambda: HungPoints(WIRE, S, LA[:2], IN_ELEMENT, UNIT[:, 0])),
    "FixedJoints": Entry(fixed),
    "SphericalJoints": Entry(hinges),
    "HeldPoints": Entry(held),
    "Controls of reaction": Entry(lambda: controls(reaction(), P[:2]), complex_step=False),
    "Controls of strain": Entry(lambda: controls(strain(), P[2:]), complex_step=False),
    "Controls of height": Entry(lambda: controls(height(), P[:2]), complex_step=False),
    "Controls of dropper force": Entry(lambda: controls(dropper(), P[2:]), complex_step=False),
    "Droppers": Entry(lambda: bars(clamped=False), complex_step=False),
    "Droppers clamped": Entry(lambda: bars(clamped=True), complex_step=False),
    "Guides": Entry(lambda: Guides(WIRE, S, IN_ELEMENT, 0.3 * UNIT, UNIT[::-1])),
    "HungMasses": Entry(lambda: HungMasses(WIRE, S, IN_ELEMENT, np.array([2.0, 3.0]), 9.81, RAMP)),
    "Bars": Entry(lambda: leaning(False, P[[0, 2]])),
    "Bars elastic taut, rigid slack": Entry(lambda: leaning(True, P[[2, 0]])),
    "Bars elastic slack, rigid taut": Entry(lambda: leaning(True, P[[0, 2]])),
    "Supports": Entry(rollers),
    "Supports of nodes": Entry(lambda: rollers(OTHER[:, :3])),
    "HeldAcross": Entry(brackets),
    "Arms": Entry(arms),
    "Clamps": Entry(lambda: Clamps(WIRE, S, LA[6:].reshape(2, 3), IN_ELEMENT, UNIT)),
    "Ties": Entry(lambda: Ties(OTHER[:, :3], WIRE, S, IN_ELEMENT, LA[6:].reshape(2, 3))),
    "Pieces": Entry(pieces, complex_step=False),
    "Given": Entry(lambda: Given(P[:2], np.array([0.1, 0.2]))),
    "Targets": Entry(lambda: Targets.of(controls(strain(), P[2:])), complex_step=False),
}
MEASURES: dict[str, Callable[[], Measure]] = {
    "ReactionTension": reaction,
    "StrainTension": strain,
    "WireHeight": lambda: WireHeight(WIRE, S, IN_ELEMENT),
    "Height": height,
    "DropperForce": dropper,
    "ForceBalance": force_balance,
    "TrackHeight": lambda: TrackHeight(WIRE, S, IN_ELEMENT, 0.3 * UNIT, UNIT[::-1]),
    "Value": lambda: Value(LA[[2, 5]]),
    "Sprung": lambda: Sprung(reaction(), P[[3, 1]], np.array([0.7, 1.9])),
    "Pull": lambda: Pull(LA[:6].reshape(2, 3), UNIT),
    "HungForce": hung_force,
}


def modules() -> list[ModuleType]:
    """Return all modules in which mechanics could be defined."""
    paths = pkgutil.walk_packages(catenaria.__path__, "catenaria.")
    names = (info.name for info in paths)
    return [importlib.import_module(name) for name in names if not set(name.split(".")) & set(SURFACES)]


def implementations(protocol: type) -> set[type]:
    """Return all classes of the package that have the protocol's members."""
    found: set[type] = set()
    for module in modules():
        classes = {item for item in vars(module).values() if isinstance(item, type)}
        found |= {
            item for item in classes if item.__module__ == module.__name__ and issubclass(item, protocol)
        }
    return found - {protocol}


def check_registered(found: set[type], made: set[type]) -> None:
    """Every class that was found has been made by an entry."""
    missing = {item.__qualname__ for item in found - made}
    assert not missing, f"no entry in this test's registry for {missing}"


def residual(part: Contribution | System, state: State, dtype: type = np.float64) -> Any:
    if isinstance(part, System):
        return part.residual(state)
    f = np.zeros(SIZE, dtype=dtype)
    part.add_residual(state, f)
    return f


def moved(state: State, k: int, step: complex) -> State:
    """Return the state with unknown k moved, and z' and z'' along as in a time discretisation."""
    direction: Any = np.zeros(SIZE)
    direction[k] = 1.0
    return State(
        state.t,
        state.z + step * direction,
        state.zd + C1 * step * direction,
        state.zdd + C2 * step * direction,
    )


def numerical_jacobian(part: Contribution | System, state: State, complex_step: bool) -> Matrix:
    """Return F_z + c1 F_z' + c2 F_z'' by complex step or by differences of fourth order."""
    if complex_step:
        columns = [residual(part, moved(state, k, 1e-30j), COMPLEX).imag / 1e-30 for k in range(SIZE)]
        return np.stack(columns, axis=1)
    h = 3e-4

    def difference(k: int) -> np.ndarray:
        at = [residual(part, moved(state, k, step * h)) for step in (-2.0, -1.0, 1.0, 2.0)]
        return (at[0] - 8.0 * at[1] + 8.0 * at[2] - at[3]) / (12.0 * h)

    return np.stack([difference(k) for k in range(SIZE)], axis=1)


def dense(rows: np.ndarray, columns: np.ndarray, values: np.ndarray) -> Matrix:
    matrix = np.zeros((SIZE, SIZE))
    np.add.at(matrix, (rows, columns), values)
    return matrix


def check_close(exact: Matrix, numerical: Matrix) -> None:
    """Agree to 1e-7 of the largest entry of the row."""
    scale = np.abs(numerical).max(axis=1, keepdims=True)
    excess = np.abs(exact - numerical) - 1e-7 * scale
    row, column = np.unravel_index(np.argmax(excess), excess.shape)
    assert excess[row, column] <= 0.0, (
        f"entry ({row}, {column}): {exact[row, column]} != {numerical[row, column]}"
    )


def test_every_contribution_is_registered() -> None:
    found = implementations(Contribution)
    assert len(found) >= 9
    check_registered(found, {type(entry.make()) for entry in PARTS.values()})


def test_every_measure_is_registered() -> None:
    found = implementations(Measure)
    assert len(found) >= 4
    check_registered(found, {type(make()) for make in MEASURES.values()})


def test_control_a_missing_entry_is_noticed() -> None:
    made = {type(entry.make()) for name, entry in PARTS.items() if name != "GuidedJoints"}
    with pytest.raises(AssertionError, match="GuidedJoints"):
        check_registered(implementations(Contribution), made)


@pytest.mark.parametrize("name", PARTS)
def test_jacobian(name: str) -> None:
    part, state = PARTS[name].make(), generic_state()
    exact = dense(*part.pattern(), part.jacobian(state, C1, C2))
    check_close(exact, numerical_jacobian(part, state, PARTS[name].complex_step))


@pytest.mark.parametrize("name", PARTS)
def test_control_every_corrupted_or_dropped_entry_is_noticed(name: str) -> None:
    """Each entry of each Jacobian, 1e-5 wrong or left out, fails the same check."""
    part, state = PARTS[name].make(), generic_state()
    rows, columns = part.pattern()
    values = part.jacobian(state, C1, C2)
    numerical = numerical_jacobian(part, state, PARTS[name].complex_step)
    total = dense(rows, columns, values)
    for k in range(values.size):
        wrong = total.copy()
        wrong[rows[k], columns[k]] += 1e-5 * np.abs(numerical[rows[k]]).max()
        with pytest.raises(AssertionError):
            check_close(wrong, numerical)
        dropped = np.abs(values[k]) > 1e-6 * np.abs(numerical[rows[k]]).max()
        if dropped:
            wrong[rows[k], columns[k]] = total[rows[k], columns[k]] - values[k]
            with pytest.raises(AssertionError):
                check_close(wrong, numerical)


def test_control_follower_load_is_noticed() -> None:
    """Gravity has no entry to corrupt; a load that depends on z must fail."""

    @dataclass(frozen=True)
    class Follower(Gravity):
        def add_residual(self, state: State, f: np.ndarray) -> None:
            f -= self.g * state.z[0] * self.weight

    part = Follower(elements().weight(SIZE), 9.81, RAMP)
    with pytest.raises(AssertionError):
        check_close(np.zeros((SIZE, SIZE)), numerical_jacobian(part, generic_state(), complex_step=True))


@pytest.mark.parametrize("name", PARTS)
def test_residual_adds_and_changes_nothing_else(name: str) -> None:
    """A part adds its share to what is there, and neither call writes into the state."""
    part, state = PARTS[name].make(), generic_state()
    before = (state.z.copy(), state.zd.copy(), state.zdd.copy())
    there = np.random.default_rng(3).normal(size=SIZE)
    f = there.copy()
    part.add_residual(state, f)
    part.jacobian(state, C1, C2)
    np.testing.assert_allclose(f - there, residual(part, state), rtol=1e-12, atol=1e-12)
    for old, new in zip(before, (state.z, state.zd, state.zdd), strict=True):
        np.testing.assert_array_equal(old, new)


@pytest.mark.parametrize("name", MEASURES)
def test_gradient(name: str) -> None:
    measure, z, h = MEASURES[name](), generic_state().z, 3e-4
    columns, exact = measure.columns(), measure.gradient(TIME, z)
    assert columns.shape == exact.shape
    for row in range(columns.shape[0]):
        expected = np.zeros(SIZE)
        for k in range(SIZE):
            at = [
                measure.value(TIME, moved(generic_state(), k, n * h).z)[row] for n in (-2.0, -1.0, 1.0, 2.0)
            ]
            expected[k] = (at[0] - 8.0 * at[1] + 8.0 * at[2] - at[3]) / (12.0 * h)
        gradient = np.zeros(SIZE)
        np.add.at(gradient, columns[row], exact[row])
        check_close(gradient[None, :], expected[None, :])
        wrong = gradient.copy()
        wrong[columns[row, 0]] *= 1.0 + 1e-5
        with pytest.raises(AssertionError):
            check_close(wrong[None, :], expected[None, :])


def all_parts() -> System:
    """Return a system of all parts at once; nonsense as a structure, generic as an algebraic system."""
    parts = tuple(entry.make() for entry in PARTS.values())
    return System(Unknowns(np.zeros(SIZE, dtype=np.int64), generic_state().z), parts)


def test_system_jacobian() -> None:
    system, state = all_parts(), generic_state()
    numerical = numerical_jacobian(system, state, complex_step=False)
    matrix = system.jacobian(state, C1, C2)
    check_close(matrix.toarray(), numerical)
    assert matrix.has_canonical_format
    pattern = np.zeros((SIZE, SIZE), dtype=bool)
    for part in system.contributions:
        pattern[part.pattern()] = True
    assert matrix.nnz == pattern.sum(), "a place that no part asked for, or one place twice"
    assert np.abs(numerical[~pattern]).max() <= 1e-9 * np.abs(numerical).max(), (
        "dependence outside the pattern"
    )


def test_control_system_without_a_parts_jacobian_fails() -> None:
    """Whichever part is left out of the Jacobian, the check sees it."""
    system, state = all_parts(), generic_state()
    numerical = numerical_jacobian(system, state, complex_step=False)
    total = system.jacobian(state, C1, C2).toarray()
    for part in system.contributions:
        if isinstance(part, Gravity | DeadLoads):
            continue
        with pytest.raises(AssertionError):
            check_close(total - dense(*part.pattern(), part.jacobian(state, C1, C2)), numerical)


@pytest.mark.parametrize("name", [name for name in PARTS if isinstance(PARTS[name].make(), Relocatable)])
def test_jacobian_after_relocation(name: str) -> None:
    """Both joints moved to the other element: pattern and entries move along."""
    part, state = PARTS[name].make(), generic_state()
    assert isinstance(part, Relocatable)
    z = state.z.copy()
    z[S] = [1.9, 0.7]
    state = replace(state, z=z)
    other = part.relocate(z)
    moved = ("SlidingJoints", "SlidingJoints of nodes", "GuidedJoints", "HungPoints", "Guides", "HungMasses")
    moved += ("Supports", "Supports of nodes", "HeldAcross", "Arms", "Clamps", "Ties")
    if name in (*moved, "Controls of strain", "Targets", "Droppers", "Droppers clamped") or "Bars" in name:
        assert other is not None
        assert isinstance(other, Contribution)
        other = aimed(other, state) if isinstance(other, Controls) else other
        exact = dense(*other.pattern(), other.jacobian(state, C1, C2))
        check_close(exact, numerical_jacobian(other, state, PARTS[name].complex_step))
        old = dense(*part.pattern(), other.jacobian(state, C1, C2))
        with pytest.raises(AssertionError):
            check_close(old, numerical_jacobian(other, state, PARTS[name].complex_step))
    else:
        assert other is None
