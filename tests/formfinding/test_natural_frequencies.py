"""Natural frequencies against closed forms: the tensioned beam, Irvine's cable, a wire between droppers."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import pytest
from scipy.optimize import brentq

from catenaria.catenary.green_bar import stretch
from catenaria.discretise.from_line import contact_wire_setup
from catenaria.discretise.wire_model import WireModel, build_wire_model
from catenaria.errors import InconsistentInputError, InfeasibleError
from catenaria.formfinding.natural_frequencies import Modes, natural_frequencies
from catenaria.formfinding.static_problem import find_rest, statics
from catenaria.line import Line
from catenaria.mechanics.chain import Chain, Section
from catenaria.mechanics.elements.cable import CableElements
from catenaria.mechanics.joints.held_point import HeldPoints
from catenaria.mechanics.loads.gravity import Gravity, Ramp
from catenaria.mechanics.loads.linear import Inertia, assemble
from catenaria.mechanics.system import System
from catenaria.mechanics.unknowns import Kind, UnknownsBuilder

TENSION, BEAM = 15e3, 50.0  # N, m of unstressed length
WIRE = Section(EA=15.6e6, EJ=400.0, rhoA=0.9252)
SPAN, SAG = 50.0, 0.02  # m, and w l/H: an eighth of it is the sag ratio
RHO_A, G = 1.0, 9.8


@dataclass(frozen=True)
class Hung:
    """A wire between two hinges, at rest."""

    system: System
    z: np.ndarray
    wire: Chain
    end_force: np.ndarray

    @property
    def H(self) -> float:  # noqa: N802, the symbol of the field
        """Horizontal component of the tension [N]."""
        return abs(float(self.z[self.end_force[0, 0]]))

    @property
    def stretched(self) -> float:
        """Stretched per unstressed length, from the mean axial strain."""
        knots = np.linspace(0.0, self.wire.knots[-1], 2001)
        r1 = self.wire.evaluate(self.z, 0.5 * (knots[1:] + knots[:-1])).r1
        return float(np.linalg.norm(r1, axis=1).mean())


def hung(r: np.ndarray, r1: np.ndarray, knots: np.ndarray, section: Section, force: float, g: float) -> Hung:
    """Return a wire between two hinges with a guess of its form, shape (n, 3) each."""
    builder = UnknownsBuilder()
    nodes = builder.add_nodes(r, r1)
    ends = builder.add(Kind.MULTIPLIER, np.outer([force, -force], [1.0, 0.0, 0.0]), r[[0, -1], 0])
    table, number = builder.build_along_line()
    wire, ends = Chain(number[nodes], knots, section), number[ends]
    elements = CableElements.of([wire])
    inertia = Inertia(assemble(elements, elements.mass(), table.size))
    gravity = Gravity(elements.weight(table.size), g, Ramp(0.0))
    held = HeldPoints(wire.nodes[[0, -1], :3], ends, r[[0, -1]], np.zeros((2, 3)), np.array([-1, -1]))
    system = System(table, (elements, inertia, gravity, held))
    return Hung(system, find_rest(system, table.start).y, wire, ends)


def tensioned_beam(count: int = 50, section: Section = WIRE) -> Hung:
    """Return a straight wire without gravity."""
    f, knots = float(stretch(TENSION, section.EA)), np.linspace(0.0, BEAM, count + 1)
    along = np.array([[f, 0.0, 0.0]])
    return hung(knots[:, None] * along, np.repeat(along, count + 1, axis=0), knots, section, TENSION, 0.0)


def beam_frequencies(section: Section = WIRE, unstressed: bool = False) -> np.ndarray:
    """Return the first ten of a hinged tensioned beam [Hz]: omega^2 = k^2 (T + EJ k^2)/m, k = n pi/L.

    Length, mass and bending stiffness are those of the stretched wire: L = f L0, m = rhoA/f, and EJ/f, as the
    energy (8) is an integral over the unstressed length.
    """
    f = 1.0 if unstressed else float(stretch(TENSION, section.EA))
    k = np.arange(1, 11) * np.pi / (f * BEAM)
    return np.sqrt(k**2 * (TENSION + section.EJ / f * k**2) * f / section.rhoA) / (2.0 * np.pi)


def check_beam(modes: Modes, expected: np.ndarray, tolerance: float) -> None:
    """Each frequency comes twice, across and upright."""
    np.testing.assert_allclose(modes.frequency[::2], expected, rtol=tolerance)
    np.testing.assert_allclose(modes.frequency[1::2], expected, rtol=tolerance)


def test_tensioned_beam() -> None:
    """Far within 0.1 %: elements of 1 m miss the tenth frequency by 2e-6, of half that length by 1e-7."""
    check_beam(natural_frequencies(*rest(tensioned_beam()), 20), beam_frequencies(), 3e-6)
    check_beam(natural_frequencies(*rest(tensioned_beam(100)), 20), beam_frequencies(), 2e-7)


def rest(wire: Hung) -> tuple[System, np.ndarray]:
    return wire.system, wire.z


WRONG = {
    "no bending": beam_frequencies(replace(WIRE, EJ=0.0)),
    "1 % more bending": beam_frequencies(replace(WIRE, EJ=404.0)),
    "unstressed length and mass": beam_frequencies(unstressed=True),
    "other mass": beam_frequencies(replace(WIRE, rhoA=1.0001 * WIRE.rhoA)),
}


@pytest.mark.parametrize("wrong", WRONG.values(), ids=WRONG)
def test_other_beams_are_noticed(wrong: np.ndarray) -> None:
    with pytest.raises(AssertionError):
        check_beam(natural_frequencies(*rest(tensioned_beam()), 20), wrong, 3e-6)


def check_sine(wire: Hung, modes: Modes, number: int) -> None:
    """A pair of modes consists of sin(n pi s/L) in y and z, and of nothing along the wire."""
    shape = modes.shape[wire.wire.nodes[:, :3]][:, :, 2 * number - 2 : 2 * number]
    sine = np.sin(number * np.pi * wire.wire.knots / wire.wire.knots[-1])
    for k in range(2):
        amplitude = sine @ shape[:, :, k] / (sine @ sine)
        np.testing.assert_allclose(shape[:, :, k], np.outer(sine, amplitude), atol=1e-6)
        assert np.linalg.norm(amplitude) > 0.5
        assert abs(amplitude[0]) < 1e-6


def test_shapes_of_a_beam_are_sines() -> None:
    wire = tensioned_beam()
    modes = natural_frequencies(*rest(wire), 20)
    for number in range(1, 11):
        check_sine(wire, modes, number)
    with pytest.raises(AssertionError):
        check_sine(wire, replace(modes, shape=modes.shape[:, 2:]), 1)


def sagging_cable(lambda2: float) -> Hung:
    """Return a shallow cable with about this parameter lambda^2 of Irvine, by its axial stiffness."""
    H = RHO_A * G * SPAN / SAG
    EA = lambda2 / SAG**2 * H * (1.0 + SAG**2 / 8.0)
    arc = 1.0 + SAG**2 / 24.0
    f = float(stretch(H * arc, EA))
    share = np.linspace(0.0, 1.0, 61)
    slope = -0.5 * SAG * (1.0 - 2.0 * share)
    r = SPAN * np.column_stack((share, 0.0 * share, -0.5 * SAG * share * (1.0 - share)))
    r1 = f * np.column_stack((np.ones_like(share), 0.0 * share, slope)) / np.hypot(1.0, slope)[:, None]
    return hung(r, r1, share * SPAN * arc / f, Section(EA, 0.0, RHO_A), H, G)


def irvine_parameter(wire: Hung) -> float:
    """Return lambda^2 = (w l/H)^2 l EA/(H L_e), L_e = l (1 + (w l/H)^2/8)."""
    ratio = RHO_A * G * SPAN / wire.H
    return ratio**2 * wire.wire.section.EA / (wire.H * (1.0 + ratio**2 / 8.0))


def irvine_frequency(lambda2: float, number: int) -> float:
    """Return the root of tan(W/2) = W/2 - (4/lambda^2)(W/2)^3 between (2 n - 1) pi and (2 n + 1) pi."""

    def equation(W: float) -> float:
        half = 0.5 * W
        return float(np.sin(half) - np.cos(half) * (half - 4.0 / lambda2 * half**3))

    return float(brentq(equation, (2 * number - 1 + 1e-9) * np.pi, (2 * number + 1 - 1e-9) * np.pi))


def dimensionless(wire: Hung, modes: Modes) -> np.ndarray:
    """Return W = omega l/sqrt(H/m) with the mass m per stretched length."""
    return 2.0 * np.pi * modes.frequency * SPAN * np.sqrt(RHO_A / wire.stretched / wire.H)


def kinds(wire: Hung, modes: Modes) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return masks: upright and symmetric, upright and antisymmetric, across."""
    y, z = modes.shape[wire.wire.nodes[:, 1]], modes.shape[wire.wire.nodes[:, 2]]
    size_y, size_z = np.abs(y).max(axis=0), np.abs(z).max(axis=0)
    assert (np.minimum(size_y, size_z) < 1e-6).all()  # no mode is both
    upright, symmetric = size_z > size_y, np.abs(z - z[::-1]).max(axis=0) < 1e-6
    antisymmetric = np.abs(z + z[::-1]).max(axis=0) < 1e-6
    return upright & symmetric, upright & antisymmetric, ~upright


def check_irvine(wire: Hung, modes: Modes, lambda2: float) -> None:
    """The first three symmetric modes; Irvine neglects terms of the order (w l/H)^2/8 = 5e-5."""
    symmetric = kinds(wire, modes)[0]
    expected = [irvine_frequency(lambda2, number) for number in (1, 2, 3)]
    np.testing.assert_allclose(dimensionless(wire, modes)[symmetric][:3], expected, rtol=5e-5)


CROSSOVER = 4.0 * np.pi**2
PARAMETERS = (0.5, 5.0, 20.0, 39.0, 40.0, 60.0, 160.0, 400.0)


@pytest.mark.parametrize("lambda2", PARAMETERS)
def test_sagging_cable(lambda2: float) -> None:
    wire = sagging_cable(lambda2)
    modes = natural_frequencies(*rest(wire), 16)
    assert irvine_parameter(wire) == pytest.approx(lambda2, rel=1e-3)
    check_irvine(wire, modes, irvine_parameter(wire))
    with pytest.raises(AssertionError):
        check_irvine(wire, modes, 1.05 * irvine_parameter(wire))


def check_string(wire: Hung, modes: Modes, wrong: float = 1.0) -> None:
    """Across W = n pi, antisymmetric W = 2 n pi: neither stretches the cable."""
    W, (_, antisymmetric, across) = wrong * dimensionless(wire, modes), kinds(wire, modes)
    np.testing.assert_allclose(W[across][:5], np.arange(1, 6) * np.pi, rtol=5e-5)
    np.testing.assert_allclose(W[antisymmetric][:2], np.array([2.0, 4.0]) * np.pi, rtol=5e-5)


@pytest.mark.parametrize("lambda2", PARAMETERS)
def test_other_modes_of_a_cable_are_those_of_a_string(lambda2: float) -> None:
    wire = sagging_cable(lambda2)
    modes = natural_frequencies(*rest(wire), 16)
    check_string(wire, modes)
    with pytest.raises(AssertionError):
        check_string(wire, modes, 1.0 + 1e-4)


def first_is_symmetric(lambda2: float) -> bool:
    """Tell whether the lowest upright mode is symmetric."""
    wire = sagging_cable(lambda2)
    symmetric, antisymmetric, _ = kinds(wire, natural_frequencies(*rest(wire), 8))
    return bool(np.argmax(symmetric) < np.argmax(antisymmetric))


def test_the_first_two_modes_cross_over() -> None:
    """At lambda^2 = 4 pi^2 both have W = 2 pi; beyond it the antisymmetric one is the lower."""
    assert first_is_symmetric(0.99 * CROSSOVER)
    assert not first_is_symmetric(1.01 * CROSSOVER)


@pytest.fixture(scope="module")
def contact(line: Line) -> tuple[WireModel, System, np.ndarray]:
    """The paper's contact wire between its droppers."""
    model = build_wire_model(replace(contact_wire_setup(line), gravity_ramp=Ramp(0.0)))
    start = model.system.unknowns.start
    root = find_rest(statics(model.system, start), start, 60)
    return model, statics(model.system, root.y), root.y


def check_band(modes: Modes, model: WireModel, bay: float) -> None:
    """The 18 equal bays have a band of upright modes: hinged at the clamps below, clamped there above."""
    shape = np.abs(modes.shape[model.wire.nodes[:, :3]]).max(axis=0)
    band = modes.frequency[shape[2] > 10.0 * shape[:2].max(axis=0)][:18]
    section, k = model.wire.section, np.pi / bay
    hinged = np.sqrt(k**2 * (15e3 + section.EJ * k**2) / section.rhoA) / (2.0 * np.pi)
    clamped = hinged / (1.0 - 2.0 * np.sqrt(section.EJ / 15e3) / bay)  # shorter by two bending lengths
    assert band.size == 18
    assert hinged < band[0] < 1.005 * hinged
    assert 0.995 * clamped < band[-1] < 1.005 * clamped


def test_a_wire_between_droppers(contact: tuple[WireModel, System, np.ndarray]) -> None:
    """Bays of 9.5 m swing in turn up and down, or in step, or something in between.

    Guided clamps make the matrix unsymmetric. The wire's end moves freely under its target, a weight stack.
    """
    model, system, z = contact
    modes = natural_frequencies(system, z, 70)
    check_band(modes, model, 9.5)
    for bay in (9.4, 9.6):
        with pytest.raises(AssertionError):
            check_band(modes, model, bay)


def test_an_unstable_equilibrium_is_refused() -> None:
    """A hinged beam under more than its buckling load pi^2 EJ/L^2 = 1.58 N; under less it swings slowly."""
    along = np.linspace(0.0, BEAM, 21)[:, None] * np.array([[1.0, 0.0, 0.0]])
    for force, stable in ((-1.5, True), (-1.7, False)):
        f = float(stretch(force, WIRE.EA))
        slope = np.tile([f, 0.0, 0.0], (21, 1))
        wire = hung(f * along, slope, along[:, 0].copy(), WIRE, force, 0.0)
        if stable:
            low = natural_frequencies(*rest(wire), 1).frequency[0]
            assert low == pytest.approx(np.sqrt((1.579 - 1.5) / WIRE.rhoA) / (2.0 * BEAM), rel=0.01)
        else:
            with pytest.raises(InfeasibleError, match="not stable"):
                natural_frequencies(*rest(wire), 1)


def test_what_moves_freely_is_refused() -> None:
    """One end is held twice, the other one not at all."""
    wire = tensioned_beam()
    first = wire.wire.nodes[[0, 0], :3]
    twice = HeldPoints(first, wire.end_force, wire.z[first], np.zeros((2, 3)), np.array([-1, -1]))
    loose = replace(wire.system, contributions=(*wire.system.contributions[:3], twice))
    with pytest.raises(InconsistentInputError, match="moves without force"):
        natural_frequencies(loose, wire.z, 1)
    assert natural_frequencies(wire.system, wire.z, 1).frequency[0] > 1.0
