"""A swinging ANCF cable: elements, hinge and integrator together, against the period of a rigid rod.

A uniform rod of length L that swings with amplitude a has the period 4 K(sin^2(a/2)) sqrt(2 L/(3 g)), K being
the complete elliptic integral. The cable is stiff enough (EJ = 1000 N m^2 for 1 kg and 1 m) to differ from a
rigid rod by 1e-4; BDF of order 2 with 400 steps a period lengthens the period by about (omega h)^2/3 = 1e-4.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np
import pytest
from scipy.special import ellipk

from catenaria.formfinding.motion_problem import MotionProblem, Tolerances
from catenaria.mechanics.chain import Chain, Section
from catenaria.mechanics.elements.cable import CableElements
from catenaria.mechanics.joints.held_point import HeldPoints
from catenaria.mechanics.loads.gravity import Gravity, Ramp
from catenaria.mechanics.loads.linear import Inertia, assemble
from catenaria.mechanics.system import System
from catenaria.mechanics.unknowns import Kind, UnknownsBuilder
from catenaria.solvers.bdf import integrate
from catenaria.solvers.outcome import Options, Solution, Start

LENGTH, AMPLITUDE, G = 1.0, 0.5, 9.80665
PERIOD = 4.0 * float(ellipk(np.sin(AMPLITUDE / 2) ** 2)) * np.sqrt(2.0 * LENGTH / (3.0 * G))


@dataclass(frozen=True)
class Pendulum:
    """The system and its parts."""

    system: System
    chain: Chain
    elements: CableElements
    inertia: Inertia
    gravity: Gravity

    def energy(self, z: np.ndarray, zd: np.ndarray) -> float:
        """Return kinetic, strain and potential energy, (7) and (8) [J]."""
        strain = float(self.elements.energies(z).sum())
        return self.inertia.kinetic_energy(zd) + strain - G * float(self.gravity.weight @ z)


def pendulum(g: float = G, elements: int = 2) -> Pendulum:
    """Return a cable hinged at the origin, straight, at an angle to the vertical."""
    unknowns = UnknownsBuilder()
    along = np.array([np.sin(AMPLITUDE), 0.0, -np.cos(AMPLITUDE)])
    knots = np.linspace(0.0, LENGTH, elements + 1)
    nodes = np.array([unknowns.add_node(s * along, along) for s in knots])
    hinge = unknowns.add(Kind.MULTIPLIER, np.zeros((1, 3)))
    table = unknowns.build()
    chain = Chain(nodes, knots, Section(EA=1e6, EJ=1e3, rhoA=1.0))
    batch = CableElements.of([chain])
    inertia = Inertia(assemble(batch, batch.mass(), table.size))
    gravity = Gravity(batch.weight(table.size), g, Ramp(0.0))
    origin, none = np.zeros((1, 3)), np.array([-1])
    system = System(table, (batch, inertia, gravity, HeldPoints(nodes[:1, :3], hinge, origin, origin, none)))
    return Pendulum(system, chain, batch, inertia, gravity)


@cache
def swing(g: float = G, periods: float = 3.0, steps: int = 400) -> tuple[Pendulum, Solution]:
    """Return the motion from rest at the amplitude, constant steps, order 2."""
    model = pendulum(g)
    start = model.system.unknowns.start
    problem = MotionProblem(model.system, Tolerances(1e-6, 1e-6, 1e-10, 1e-4))
    options = Options(max_order=2, constant_step=PERIOD / steps)
    return model, integrate(problem, Start(0.0, start, np.zeros_like(start)), periods * PERIOD, options)


def period(model: Pendulum, solution: Solution) -> float:
    """Return the mean period from the tip's passages of the vertical [s]."""
    tip = solution.y[:, model.chain.nodes[-1, 0]]
    before = np.flatnonzero(tip[:-1] * tip[1:] < 0.0)
    share = tip[before] / (tip[before] - tip[before + 1])
    passage = solution.t[before] + share * (solution.t[before + 1] - solution.t[before])
    return 2.0 * float(np.mean(np.diff(passage)))


def test_period_of_a_rigid_rod() -> None:
    assert period(*swing()) == pytest.approx(PERIOD, rel=4e-4)


def test_another_gravity_is_noticed() -> None:
    """Negative control: 0.2 % of gravity is 0.1 % of the period."""
    assert period(*swing(1.002 * G)) != pytest.approx(PERIOD, rel=4e-4)


def test_period_converges_with_the_step() -> None:
    errors = [abs(period(*swing(steps=steps)) - period(*swing(steps=3200))) for steps in (200, 400, 800)]
    slopes = np.log2(np.array(errors[:-1]) / np.array(errors[1:]))
    assert np.all(slopes > 1.7)


def test_hinge_does_not_drift() -> None:
    model, solution = swing(periods=20.0, steps=200)
    assert np.abs(solution.y[:, model.chain.nodes[0, :3]]).max() < 1e-10


def test_energy_is_lost_slowly_and_never_gained() -> None:
    model, solution = swing()
    energy = np.array([model.energy(z, zd) for z, zd in zip(solution.y, solution.yd, strict=True)])
    swing_energy = 0.5 * LENGTH * G * (1.0 - np.cos(AMPLITUDE))
    assert np.max(np.diff(energy[10:])) < 1e-5 * swing_energy
    assert 0.0 < energy[10] - energy[-1] < 5e-3 * swing_energy
