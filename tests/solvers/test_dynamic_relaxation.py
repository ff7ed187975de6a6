"""Dynamic relaxation: known solutions, Newton's method, the elastic catenary, stability, false steadiness."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.sparse import csc_array

from catenaria.errors import InconsistentInputError, NotConvergedError
from catenaria.solvers.dynamic_relaxation import relax
from catenaria.solvers.newton import solve_newton
from catenaria.solvers.relaxation_motion import Motion, advance_kinetically, advance_viscously
from catenaria.solvers.relaxation_values import Relaxation, RelaxationOptions, row_sums

DAMPINGS = ("kinetic", "viscous")


class Linear:
    """K y = K known."""

    def __init__(self, K, known, scale=1e-8):
        self.K, self.load, self.known = K, K @ known, known
        self.size, self.force_scale = known.size, np.full(known.size, scale)
        self.bound = np.abs(K).sum(axis=1)

    def residual(self, y):
        return self.K @ y - self.load

    def stiffness_bound(self, y):
        return self.bound


class Chain:
    """Point masses on n equal springs in the plane, both ends held: coordinates of the inner nodes."""

    span = 65.0

    def __init__(self, n, length, EA=1e6, weight=1000.0, scale=1e-5):
        self.n, self.h = n, length / n
        self.k, self.EA, self.length, self.weight = EA / self.h, EA, length, weight
        self.size = 2 * (n - 1)
        self.force_scale, self.newton_scale = np.full(self.size, scale), np.full(self.size, 1e-10)

    def nodes(self, y):
        return np.vstack(([0.0, 0.0], y.reshape(-1, 2), [self.span, 0.0]))

    def straight(self):
        return np.stack((np.linspace(0.0, self.span, self.n + 1)[1:-1], np.zeros(self.n - 1)), axis=1).ravel()

    def springs(self, y):
        """Return directions and forces."""
        d = np.diff(self.nodes(y), axis=0)
        stretched = np.hypot(*d.T)
        return d / stretched[:, None], self.k * (stretched - self.h), stretched

    def residual(self, y):
        t, force, _ = self.springs(y)
        pull = force[:, None] * t
        return (pull[:-1] - pull[1:] + [0.0, self.weight / self.n]).ravel()

    def blocks(self, y):
        t, force, stretched = self.springs(y)
        along = t[:, :, None] * t[:, None, :]
        return self.k * along + (force / stretched)[:, None, None] * (np.eye(2) - along)

    def jacobian(self, y):
        K = np.zeros((self.size + 4, self.size + 4))
        for i, block in enumerate(self.blocks(y)):
            K[2 * i : 2 * i + 4, 2 * i : 2 * i + 4] += np.kron([[1, -1], [-1, 1]], block)
        return csc_array(K[2:-2, 2:-2])

    def stiffness_bound(self, y):
        """Both directions get the bound of the stiffer one, so that a straight chain has masses, too."""
        rows = np.abs(self.blocks(y)).sum(axis=2)
        return np.repeat(2.0 * (rows[:-1] + rows[1:]).max(axis=1), 2)

    def reselect(self, y):
        return None


class Directed(Chain):
    """The same with each direction's own bound, which grows much when a chain turns."""

    def stiffness_bound(self, y):
        rows = np.abs(self.blocks(y)).sum(axis=2)
        return (2.0 * (rows[:-1] + rows[1:])).ravel()


def laplacian(n, scale=1e-8):
    """Return a string of n springs between two walls; its condition number is 4 (n + 1)^2 / pi^2."""
    K = 2.0 * np.eye(n) - np.eye(n, k=1) - np.eye(n, k=-1)
    return Linear(K, np.sin(np.linspace(0.0, 5.0, n)), scale)


def failure(problem, y, options):
    with pytest.raises(NotConvergedError) as caught:
        relax(problem, y, options)
    assert isinstance(caught.value.partial, Relaxation)
    assert not caught.value.partial.converged
    return caught.value, caught.value.partial


# Known solutions


def check_linear(problem, y):
    """An error is at most |K^-1| times the residual."""
    allowed = np.linalg.norm(np.linalg.inv(problem.K), np.inf) * problem.force_scale.max()
    assert np.abs(y - problem.known).max() <= allowed


@pytest.mark.parametrize("damping", DAMPINGS)
@pytest.mark.parametrize("seed", range(3))
def test_linear_systems_with_stiffness_over_four_decades(damping, seed):
    rng = np.random.default_rng(seed)
    size = 10.0 ** rng.uniform(0.0, 2.0, 30)  # entries of K lie between 1 and 1e4
    correlated = rng.normal(size=(30, 90))
    K = size[:, None] * (correlated @ correlated.T / 90 + np.eye(30)) * size
    problem = Linear(K, rng.normal(size=30))
    start = np.zeros(30)
    result = relax(problem, start, RelaxationOptions(damping))
    check_linear(problem, result.y)
    assert np.abs(problem.residual(result.y) / problem.force_scale).max() <= 1.0
    assert result.residual[-1] <= 1.0
    assert (start == 0.0).all()
    with pytest.raises(AssertionError):  # negative control
        check_linear(problem, result.y + 1e-3)


@pytest.mark.parametrize("damping", DAMPINGS)
def test_iterations_grow_like_the_root_of_the_condition_number(damping):
    """16 times the condition number takes about 4 times the iterations; gradient descent would need 16."""
    options = RelaxationOptions(damping)
    few, many = (relax(laplacian(n), np.zeros(n), options).iterations for n in (25, 103))
    assert few < 700
    assert many < 6 * few


@pytest.mark.parametrize("damping", DAMPINGS)
@pytest.mark.parametrize(("length", "EA"), [(64.9, 1e6), (64.9, 1e7), (68.0, 1e6)])
def test_a_chain_that_hangs_through_is_where_newton_finds_it(damping, length, EA):
    """From nodes up to metres off their places; the chain of 68 m hangs through by 8 m."""
    chain = Chain(20, length, EA)
    disturbed = chain.straight() + np.random.default_rng(5).uniform(-1.5, 1.5, chain.size)
    result = relax(chain, disturbed, RelaxationOptions(damping))
    newton = solve_newton(chain, result.y + 1e-3)
    softest = np.linalg.eigvalsh(chain.jacobian(newton.y).toarray())[0]
    distance = np.linalg.norm(result.y - newton.y)
    assert distance <= 1.01 * np.linalg.norm(chain.residual(result.y)) / softest + 1e-10
    assert distance < 2e-6
    assert result.iterations < 6000


def catenary_nodes(chain):
    """Return the nodes of the elastic catenary of the same length, stiffness and weight (Irvine 1981)."""
    L0, W, V = chain.length, chain.weight, 0.5 * chain.weight
    s = np.linspace(0.0, L0, chain.n + 1)

    def x(H, s):
        return H * s / chain.EA + H * L0 / W * (np.arcsinh(V / H) - np.arcsinh((V - W * s / L0) / H))

    H = brentq(lambda H: x(H, L0) - chain.span, 1.0, 1e6, xtol=1e-10)
    cosine = [np.hypot(1.0, (V - W * si / L0) / H) for si in (0.0, s)]
    z = -(W * s / chain.EA * (V / W - 0.5 * s / L0) + H * L0 / W * (cosine[0] - cosine[1]))
    return np.stack((x(H, s), z), axis=1)


def errors(damping, length, EA, wrong=1.0):
    """Return distances from the catenary with 32 and 64 springs, and of what both extrapolate to."""
    places, exact = [], catenary_nodes(Chain(32, length, wrong * EA))
    for n in (32, 64):
        chain = Chain(n, length, EA, scale=1e-6)
        places.append(chain.nodes(relax(chain, chain.straight(), RelaxationOptions(damping)).y)[:: n // 32])
    coarse, fine = places
    return [np.abs(place - exact).max() for place in (coarse, fine, (4.0 * fine - coarse) / 3.0)]


@pytest.mark.parametrize("damping", DAMPINGS)
@pytest.mark.parametrize(("length", "EA"), [(64.9, 1e6), (67.0, 1e6)])
def test_a_chain_of_point_masses_approaches_the_elastic_catenary(damping, length, EA):
    """Its distance falls with the square of the spacing; without that part it is the catenary to 2 um."""
    coarse, fine, extrapolated = errors(damping, length, EA)
    assert fine < 1e-3
    assert 3.9 < coarse / fine < 4.1
    assert extrapolated < 2e-6


def test_negative_control_another_stiffness_is_another_catenary():
    coarse, fine, extrapolated = errors("kinetic", 64.9, 1e6, wrong=1.001)
    assert not 3.9 < coarse / fine < 4.1
    assert extrapolated > 2e-6


def test_both_dampings_find_the_same():
    chain = Chain(30, 64.93, 1.2e7)
    kinetic, viscous = (relax(chain, chain.straight(), RelaxationOptions(d)) for d in DAMPINGS)
    assert np.abs(kinetic.y - viscous.y).max() < 1e-6
    assert kinetic.peaks.size > 3
    assert (kinetic.peaks > 0.0).all()
    assert viscous.peaks.size == 0


# Masses and stability


@pytest.mark.parametrize("damping", DAMPINGS)
def test_gershgorin_masses_are_stable_and_half_of_them_are_not(damping):
    """A string attains Gershgorin's bound: the highest eigenvalue of M^-1 K is 4 with the smallest masses."""
    problem, start = laplacian(40), np.zeros(40)
    eigenvalues = np.linalg.eigvals(problem.K / (problem.bound[:, None] / 4.0))
    assert eigenvalues.real.max() == pytest.approx(4.0, rel=1e-12)
    assert relax(problem, start, RelaxationOptions(damping, mass_factor=1.05)).restarts == 0
    error, partial = failure(problem, start, RelaxationOptions(damping, mass_factor=0.5))
    assert "motion grows" in error.reason
    assert np.isfinite(partial.y).all()
    assert partial.iterations < 200


@pytest.mark.parametrize("damping", DAMPINGS)
def test_a_bound_that_misses_stiffness_is_found_out(damping):
    class Bad(Chain):
        def stiffness_bound(self, y):
            return 0.2 * super().stiffness_bound(y)

    chain = Bad(20, 64.9)
    error, partial = failure(chain, chain.straight(), RelaxationOptions(damping))
    assert "stiffness bound" in error.advice
    assert np.abs(partial.y).max() < 1e3


@pytest.mark.parametrize("damping", DAMPINGS)
def test_masses_follow_a_chain_that_turns(damping):
    """Nearly straight and slack, it is softer across by a factor of a thousand than after it has turned."""
    chain, directed = (kind(60, 66.0, 1e7) for kind in (Chain, Directed))
    start = chain.straight() + 1e-2 * np.sin(np.arange(chain.size))
    result = relax(directed, start, RelaxationOptions(damping, mass_interval=10**6))
    assert result.restarts == result.mass_updates > 0
    assert np.abs(result.y - relax(chain, start).y).max() < 2e-6


def test_after_a_peak_or_growth_the_motion_begins_from_rest():
    """A first half step v = -f/(2 m) has the kinetic energy -v'f/4, and no later step has."""
    chain = Directed(20, 66.0, 1e7, scale=1.0)  # far above round-off
    steps = []
    start = chain.straight() + 1e-2 * np.sin(np.arange(chain.size))
    options = RelaxationOptions(mass_interval=10**6, record_interval=1)
    result = relax(chain, start, options, [steps.append])
    begun = 0
    for before, after in pairwise(steps):
        work = -(after.y - before.y) @ chain.residual(before.y)
        begun += after.kinetic_energy == pytest.approx(0.25 * work, rel=1e-5, abs=0.0)
    assert result.restarts > 0
    assert begun == 1 + result.restarts + result.peaks.size


def test_masses_that_follow_the_stiffness_save_iterations():
    chain = Directed(60, 64.93, 1.2e7)
    start = chain.straight() + np.random.default_rng(0).normal(size=chain.size)
    following, kept = (relax(chain, start, RelaxationOptions(mass_interval=i)) for i in (100, 10**6))
    assert following.mass_updates >= following.iterations // 100 - following.restarts
    assert 3 * following.iterations < kept.iterations


def test_round_off_is_not_taken_for_growth():
    motion = Motion(np.zeros(2), np.ones(2))
    for force in ([1.0, 1.0], [1.0 - 3e-9, 1.0 - 3e-9]):
        motion.observe(np.array(force))
        motion.kick(1.0, 1e-9)
    motion.omega2 = 5.0
    assert motion.is_unstable(np.full(2, 1e-12))
    assert not motion.is_unstable(np.full(2, 10.0))


# The motion


def test_the_observed_frequency_is_a_rayleigh_quotient():
    """It is exact for a mode and lies between the extreme eigenvalues for a mixture."""
    K = laplacian(12).K
    eigenvalues, modes = np.linalg.eigh(K / 5.0)
    for start, expected in ((modes[:, 3], eigenvalues[[3, 3]]), (modes.sum(axis=1), eigenvalues[[0, -1]])):
        motion = Motion(start, np.full(12, 5.0))
        for _ in range(20):
            motion.observe(K @ motion.y)
            assert motion.omega2 == 0.0 or expected[0] - 1e-12 <= motion.omega2 <= expected[1] + 1e-12
            motion.kick(1.0, 1.0)
            motion.drift()
        assert motion.omega2 > 0.0


def rest_of_oscillator(omega, back):
    """Return where an oscillator released at 1 first rests, in units of its longest step, and its energy."""
    motion, longest = Motion(np.ones(1), np.ones(1)), 0.0
    while True:
        motion.observe(omega**2 * motion.y)
        before = motion.y[0]
        energy = advance_kinetically(motion)
        if energy is not None:
            return abs(motion.y[0] if back else before) / longest, energy
        longest = max(longest, abs(motion.velocity[0]))


@pytest.mark.parametrize("omega", [0.01, 0.0312, 0.1, 0.27])
def test_kinetic_damping_rests_within_half_a_step_of_the_peak(omega):
    distance, energy = rest_of_oscillator(omega, back=True)
    assert distance <= 0.5
    assert energy == pytest.approx(0.5 * omega**2, rel=omega**2)  # what its spring had stored


def test_negative_control_without_going_back_it_rests_farther_off():
    assert max(rest_of_oscillator(omega, back=False)[0] for omega in (0.01, 0.0312, 0.1, 0.27)) > 0.5


def test_viscous_damping_is_critical():
    """One mode goes to rest without turning and as fast as exp(-omega t) (1 + omega t) says."""
    omega, motion = 0.05, Motion(np.ones(1), np.ones(1))
    path = []
    for _ in range(200):
        path.append(motion.y[0])
        motion.observe(omega**2 * motion.y)
        advance_viscously(motion)
    t = omega * np.arange(200)
    assert np.abs(np.array(path) - np.exp(-t) * (1.0 + t)).max() < 3e-3
    assert (np.diff(path) < 0.0).all()


# False steadiness, limits, observers, bad input


@pytest.mark.parametrize("damping", DAMPINGS)
def test_what_hardly_moves_has_not_converged(damping):
    """Masses a million million times too large: nothing seems to move, and every force is there still."""
    problem = laplacian(10, scale=1e-3)
    problem.bound = 1e12 * problem.bound
    options = RelaxationOptions(damping, max_iterations=500, record_interval=1)
    energies, moved = [], []
    with pytest.raises(NotConvergedError, match="500 iterations") as caught:
        relax(
            problem,
            np.zeros(10),
            options,
            [lambda step: energies.append(step.kinetic_energy), lambda step: moved.append(np.ptp(step.y))],
        )
    assert max(energies) < 1e-6
    assert max(moved) < 1e-6
    partial = caught.value.partial
    assert isinstance(partial, Relaxation)
    assert partial.residual.min() > 100.0


def test_iterations_are_limited_and_the_course_is_recorded():
    chain = Chain(30, 64.93)
    steps = []
    options = RelaxationOptions(max_iterations=350, record_interval=50)
    with pytest.raises(NotConvergedError, match="350 iterations") as caught:
        relax(chain, chain.straight(), options, [steps.append])
    partial = caught.value.partial
    assert isinstance(partial, Relaxation)
    assert partial.recorded.tolist() == [0, 50, 100, 150, 200, 250, 300]
    assert [step.iteration for step in steps] == partial.recorded.tolist()
    assert [step.residual for step in steps] == partial.residual.tolist()
    for step in steps:
        worst = np.abs(chain.residual(step.y) / chain.force_scale).max()
        assert step.residual == pytest.approx(worst, rel=1e-14)
    assert (steps[0].y == chain.straight()).all()


def test_an_equilibrium_is_recognised_at_once():
    problem = laplacian(5)
    result = relax(problem, problem.known)
    assert result.iterations == 1
    assert result.recorded.tolist() == [0]
    assert (result.y == problem.known).all()


@pytest.mark.parametrize("damping", DAMPINGS)
def test_a_problem_may_reuse_its_array(damping):
    class Reusing(Linear):
        buffer = np.empty(10)

        def residual(self, y):
            return np.subtract(self.K @ y, self.load, out=self.buffer)

    fresh = laplacian(10)
    reusing = Reusing(fresh.K, fresh.known)
    once, again = (relax(problem, np.zeros(10), RelaxationOptions(damping)) for problem in (fresh, reusing))
    assert (once.y == again.y).all()


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_a_force_that_is_not_finite_is_refused(bad):
    class Cliff(Linear):
        def residual(self, y):
            return super().residual(y) if np.abs(y).max() < 0.5 else np.full(10, bad)

    error, partial = failure(Cliff(laplacian(10).K, np.ones(10)), np.zeros(10), RelaxationOptions())
    assert "not finite" in error.reason
    assert np.isfinite(partial.y).all()
    assert np.isfinite(partial.residual).all()


@pytest.mark.parametrize("bad", [0.0, -1.0, np.nan, np.inf])
@pytest.mark.parametrize("attribute", ["bound", "force_scale"])
def test_scales_must_be_positive(attribute, bad):
    problem = laplacian(5)
    setattr(problem, attribute, np.where(np.arange(5) == 3, bad, 1.0))
    with pytest.raises(InconsistentInputError, match="unknown 3"):
        relax(problem, np.zeros(5))


def test_shapes_must_fit():
    with pytest.raises(InconsistentInputError, match="shape"):
        relax(laplacian(5), np.zeros(4))


@pytest.mark.parametrize("option", ["mass_factor", "mass_interval", "max_iterations", "record_interval"])
@pytest.mark.parametrize("value", [0, -1])
def test_options_must_be_positive(option, value):
    with pytest.raises(InconsistentInputError, match="positive"):
        replace(RelaxationOptions(), **{option: value})


def test_row_sums_of_a_sparse_matrix():
    chain = Chain(10, 66.0)
    K = chain.jacobian(chain.straight() + 0.1 * np.sin(np.arange(chain.size)))
    assert row_sums(K) == pytest.approx(np.abs(K.toarray()).sum(axis=1))
