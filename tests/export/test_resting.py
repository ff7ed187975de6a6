"""The line at rest and its matrices, against loads that are put on it and against its energy."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.sparse.linalg import spsolve

from catenaria.errors import UnsupportedError
from catenaria.export.dynamics import dynamics_arrays
from catenaria.export.resting import RestingLine
from catenaria.export.vibrations import vibrations
from catenaria.formfinding.natural_frequencies import natural_frequencies
from catenaria.formfinding.static_problem import find_rest
from catenaria.line import Line
from catenaria.mechanics.loads.dead import DeadLoads
from catenaria.mechanics.loads.linear import Inertia, assemble
from catenaria.mechanics.system import System
from catenaria.results import FormResult
from catenaria.workflow import solve

FloatArray = NDArray[np.float64]
Arrays = dict[str, NDArray[Any]]


def resting(result: FormResult) -> RestingLine:
    return RestingLine.of(Line.model_validate(result.inputs), result)


def test_it_rests_where_it_was_found(every: FormResult) -> None:
    rest = resting(every)
    force, constraint = rest.residual
    assert force < 1e-3
    assert constraint < 1e-11
    droppers = every.droppers
    below = rest.model.lower_carrier.evaluate(rest.z, rest.z[rest.model.lower_s]).r
    np.testing.assert_allclose(below, droppers.position_bottom, rtol=0.0, atol=1e-8)
    assert abs(rest.tangent.K - rest.tangent.K.T).max() < 1e-12 * abs(rest.tangent.K).max()
    assert abs(rest.tangent.M - rest.tangent.M.T).max() < 1e-14 * abs(rest.tangent.M).max()


def test_small_loads_displace_as_the_matrices_say(frictionless: FormResult) -> None:
    """Nonlinear rests under a load and its opposite; what is odd in the load is linear."""
    rest = resting(frictionless)
    size = rest.coordinates.size
    moved = np.flatnonzero(np.arange(size) % 6 < 3)[: 6 * rest.strands[0].knots.size]
    f = np.zeros(size)
    f[moved] = 1e-2 * np.random.default_rng(3).normal(size=moved.size)
    K, _ = rest.tangent.whole()
    wanted = spsolve(K, np.concatenate((f, np.zeros(rest.multipliers.size))))
    found: list[FloatArray] = []
    for sign in (1.0, -1.0):
        load = np.zeros(rest.z.size)
        load[rest.coordinates] = sign * f
        system = System(rest.system.unknowns, (*rest.system.contributions, DeadLoads(load)))
        found.append(find_rest(system, rest.z).y)
    odd = 0.5 * (found[0] - found[1])
    scale = np.abs(wanted[:size]).max()
    assert scale > 1e-5
    np.testing.assert_allclose(odd[rest.coordinates], wanted[:size], rtol=0.0, atol=1e-3 * scale)
    mu = odd[rest.multipliers] * rest.bar_length
    np.testing.assert_allclose(mu, wanted[size:], rtol=0.0, atol=1e-3 * np.abs(wanted[size:]).max())


def test_rigid_and_slack_droppers(unlike: FormResult) -> None:
    """A slack dropper just reaches, so that it is taut under the one load and slack under its opposite."""
    test_it_rests_where_it_was_found(unlike)
    rest, kind = resting(unlike), Line.model_validate(unlike.inputs).dropper
    np.testing.assert_array_equal(rest.slack, unlike.droppers.slack)
    assert rest.slack.any() == (kind.slack == "allowed")
    assert np.count_nonzero(rest.rigid) == (21 - np.count_nonzero(rest.slack)) * (kind.model == "rigid")
    if not rest.slack.any():
        test_small_loads_displace_as_the_matrices_say(unlike)


def energy(x: NDArray[Any], arrays: Arrays) -> Any:
    """Return the energy of wires and droppers at coordinates that may be complex, by Gauss's rule."""
    nodes = x.reshape(-1, 6)
    ends, L = nodes[arrays["element_nodes"]], arrays["element_length"][:, None]
    points, weights = np.polynomial.legendre.leggauss(5)
    total: Any = 0.0
    for t, w in zip((points + 1.0) / 2.0, weights / 2.0, strict=True):
        r1 = cubic(ends, L, t, 1)
        bend = np.cross(r1, cubic(ends, L, t, 2))
        square = np.sum(r1**2, axis=1)
        strain = (square - 1.0) / 2.0
        curvature = np.sum(bend**2, axis=1) / square**3
        total += (
            w * np.sum(L[:, 0] * (arrays["element_EA"] * strain**2 + arrays["element_EJ"] * curvature)) / 2.0
        )
    clamps = [place(nodes, arrays, end) for end in ("lower", "upper")]
    l0 = arrays["dropper_length"]
    strain = (np.sum((clamps[1] - clamps[0]) ** 2, axis=1) / l0**2 - 1.0) / 2.0
    return total + np.sum(l0 * strain**2 / arrays["dropper_flexibility"]) / 2.0


def cubic(ends: NDArray[Any], L: Any, t: Any, order: int) -> NDArray[Any]:
    """Return r, r' or r'' of Hermite's cubics at t in (0, 1), from their power basis."""
    p = [np.polynomial.Polynomial(c) for c in ((1, 0, -3, 2), (0, 1, -2, 1), (0, 0, 3, -2), (0, 0, -1, 1))]
    N = [np.reshape((q.deriv(order) if order else q)(t), (-1, 1)) for q in p]
    own = (ends[:, 0, :3], L * ends[:, 0, 3:], ends[:, 1, :3], L * ends[:, 1, 3:])
    return sum((n * v for n, v in zip(N, own, strict=True)), np.zeros(1)) / L**order


def place(nodes: NDArray[Any], arrays: Arrays, end: str) -> NDArray[Any]:
    """Return where the clamps of droppers are."""
    wire, s = arrays[f"dropper_{end}_wire"], arrays[f"dropper_{end}_coordinate"]
    pairs, knots = arrays["element_nodes"], arrays["node_coordinate"]
    start, stop = knots[pairs[:, 0]], knots[pairs[:, 1]]
    e = np.array([np.flatnonzero((arrays["element_wire"] == k) & (start <= x) & (x <= stop))[0]
                  for k, x in zip(wire, s, strict=True)])  # fmt: skip
    L = arrays["element_length"][e][:, None]
    return cubic(nodes[pairs[e]], L, (s - start[e]) / L[:, 0], 0)


def test_forces_and_stiffness_are_derivatives_of_an_energy(plane: FormResult) -> None:
    """U(x) - w x + mu C x is stationary at rest, with K as its second derivative; complex steps are exact."""
    rest = resting(plane)
    arrays = dynamics_arrays(rest)
    own, count = arrays["coordinates"], 6 * arrays["node_position"].shape[0]
    C = rest.tangent.C
    outer = arrays["constraint_force"] @ C - arrays["load"]
    rng = np.random.default_rng(1)

    def slope(x: FloatArray, d: FloatArray) -> float:
        return float(energy(x + 1e-30j * d, arrays).imag / 1e-30)

    for _ in range(3):
        d = rng.normal(size=count)
        inner = slope(own[:count], d)
        assert abs(inner + outer[:count] @ d) < 1e-9 * np.abs(outer).max() * np.sqrt(count) + 1e-3
        h = 1e-6
        second = (slope(own[:count] + h * d, d) - slope(own[:count] - h * d, d)) / (2.0 * h)
        assert second == pytest.approx(d @ (rest.tangent.K[:count][:, :count] @ d), rel=1e-5)


def test_mass_is_all_that_there_is(space: FormResult) -> None:
    rest = resting(space)
    along = np.zeros(rest.coordinates.size)
    nodes = sum(chain.knots.size for chain in rest.strands)
    along[: 6 * nodes : 6] = 1.0  # everything moves along x, slopes stay
    wires = sum(chain.knots[-1] * chain.section.rhoA for chain in rest.strands)
    line = Line.model_validate(space.inputs)
    dropper = line.dropper
    hung = line.conductor(dropper.conductor).rhoA * space.droppers.length.sum()
    clamps = space.droppers.x.size * (dropper.clamp_mass_top + dropper.clamp_mass_bottom)
    arms = sum(s.contact_wire.arm.mass / 3.0 for s in line.supports if s.contact_wire and s.contact_wire.arm)
    found, masses = along @ (rest.tangent.M @ along), space.masses.mass.sum()  # clamps of arms too
    assert found == pytest.approx(wires + hung + clamps + arms + masses, rel=1e-9)


def test_modes_are_those_of_the_whole_system(plane: FormResult) -> None:
    """Sliding coordinates, dropper forces and given lengths kept as unknowns, instead of eliminated."""
    rest = resting(plane)
    model = rest.model
    size = rest.z.size
    mass: Any = assemble(model.elements, model.elements.mass(), size).tolil()
    point = rest.lumps.carrier.evaluate(rest.z, rest.lumps.s)
    for dofs, N, m in zip(point.dofs, point.N, rest.lumps.mass, strict=True):
        for axis in range(3):
            mass[np.ix_(dofs[:, axis], dofs[:, axis])] += m * np.outer(N, N)
    system = System(rest.system.unknowns, (*rest.system.contributions, Inertia(mass.tocsr())))
    wanted = natural_frequencies(system, rest.z, 12).frequency
    np.testing.assert_allclose(vibrations(rest, 12).frequency, wanted, rtol=1e-9)


def test_rayleigh_quotients_and_orthogonality(space: FormResult) -> None:
    rest = resting(space)
    found = vibrations(rest, 10)
    x, omega = found.shape, 2.0 * np.pi * found.frequency
    T = rest.tangent
    np.testing.assert_allclose(x.T @ (T.M @ x), np.eye(10), rtol=0.0, atol=1e-6)
    np.testing.assert_allclose(np.einsum("nk,nk->k", x, T.K @ x), omega**2, rtol=1e-7)
    assert np.abs(T.C @ x).max() < 1e-9 * np.abs(x).max() * abs(T.C).max() + 1e-9


def test_two_equal_wires_swing_together_like_a_string() -> None:
    """F = n/(2 L) sqrt(T/m) sideways; a dropper between them does not lean then."""
    section = {"youngs_modulus": 120e9, "area": 120e-6, "mass_per_length": 1.07, "bending_stiffness": 1.0}
    wire = {"conductor": "wire", "tension": {"force": 15e3}, "tail": 0.5}
    support = {"contact_wire": {"height": 5.5}, "messenger_wire": {"height": 7.5}}
    light = section | {"mass_per_length": 0.01}
    line = Line.model_validate(
        {
            "format": 1,
            "conductors": {"wire": section, "light": light},
            "contact_wire": wire,
            "messenger_wire": wire,
            "dropper": {"conductor": "light", "model": "bar"},
            "supports": [support, support],
            "spans": [{"length": 50.0, "droppers": {"positions": [25.0]}}],
        }
    )
    found = vibrations(resting(solve(line, rebuild="none")), 10)
    for n in (1, 2):
        string = n / 100.0 * np.sqrt(15e3 / 1.07)
        assert np.abs(found.frequency / string - 1.0).min() < 3e-3


def test_wires_stick_on_rollers_with_friction(space: FormResult, stitched: FormResult) -> None:
    line = Line.model_validate(space.inputs)
    assert any(support.messenger_wire.friction for support in line.supports)
    rubbing = np.flatnonzero(resting(space).model.layout.holds.friction)
    assert not resting(space).running[rubbing].any()
    assert resting(stitched).running.any()


def test_strings_have_no_such_rest(strings: FormResult) -> None:
    with pytest.raises(UnsupportedError, match="no nodes"):
        resting(strings)
