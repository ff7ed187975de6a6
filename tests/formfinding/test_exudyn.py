"""The forward model against Exudyn's plane ANCF cable; collected where that is installed.

Exudyn's axial force is EA (|r'| - 1), ours the true force EA a (a^2 - 1)/2 of Green strain at a = |r'|, and
its curvature is |r' x r''|/|r'|^2, ours with |r'|^3. A piece that is given to Exudyn therefore has the
length at which the same tension stretches it as far (2e-6 less at 15 kN, without which that tension were
26 N off), the bending stiffness EJ/a^2, and the same mass. Exudyn starts from a form made of lengths.
"""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from dataclasses import dataclass, replace
from importlib import import_module
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline
from scipy.optimize import brentq

from catenaria.discretise.mesh import Grading, graded_knots
from catenaria.formfinding.static_problem import find_rest
from catenaria.line import Conductor, Line
from catenaria.mechanics.chain import Chain, Section
from catenaria.mechanics.elements.cable import CableElements
from catenaria.mechanics.joints.held_point import HeldPoints
from catenaria.mechanics.loads.gravity import Gravity, Ramp
from catenaria.mechanics.system import System
from catenaria.mechanics.unknowns import Kind, UnknownsBuilder
from catenaria.results import FormResult
from catenaria.workflow import solve

FloatArray = NDArray[np.float64]

with warnings.catch_warnings():
    warnings.simplefilter("ignore", DeprecationWarning)
    exu: Any = import_module("exudyn")
    item: Any = import_module("exudyn.itemInterface")


def same_stretch(section: Section, tension: float) -> tuple[Section, float]:
    """Return the section for Exudyn at a tension, and by what unstressed lengths are multiplied."""
    EA = section.EA
    a = float(brentq(lambda a: 0.5 * EA * a * (a * a - 1.0) - tension, 0.9, 1.1, xtol=1e-15, rtol=1e-15))
    shorter = a / (1.0 + tension / EA)
    return Section(EA, section.EJ / a**2 / shorter, section.rhoA / shorter), shorter


class Peer:
    """A plane model in Exudyn: cables, held nodes, hinges, gravity."""

    def __init__(self, gravity: float) -> None:
        self._container, self._gravity = exu.SystemContainer(), gravity
        self.mbs = self._container.AddSystem()
        ground = self.mbs.AddNode(item.NodePointGround())
        self._ground = self.mbs.AddMarker(item.MarkerNodeCoordinate(nodeNumber=ground, coordinate=0))

    def cable(
        self, knots: FloatArray, start: FloatArray, slope: FloatArray, section: Section
    ) -> tuple[list[int], list[int]]:
        """Add a cable; return its nodes and its elements."""
        kind = item.NodePoint2DSlope1
        pairs = zip(start, slope, strict=True)
        nodes = [self.mbs.AddNode(kind(referenceCoordinates=[*r, *t])) for r, t in pairs]
        elements: list[int] = []
        for i, length in enumerate(np.diff(knots)):
            cable = item.ObjectANCFCable2D(
                length=length,
                massPerLength=section.rhoA,
                bendingStiffness=section.EJ,
                axialStiffness=section.EA,
                nodeNumbers=nodes[i : i + 2],
            )
            elements.append(self.mbs.AddObject(cable))
            mass = self.mbs.AddMarker(item.MarkerBodyMass(bodyNumber=elements[-1]))
            self.mbs.AddLoad(item.Gravity(markerNumber=mass, loadVector=[0, -self._gravity, 0]))
        return nodes, elements

    def hold(self, node: int) -> list[int]:
        """Hold a node where it is; return the constraints along x and z."""

        def hold(axis: int) -> int:
            marker = self.mbs.AddMarker(item.MarkerNodeCoordinate(nodeNumber=node, coordinate=axis))
            return self.mbs.AddObject(item.CoordinateConstraint(markerNumbers=[self._ground, marker]))

        return [hold(0), hold(1)]

    def hinge(self, one: int, other: int) -> None:
        """Join two nodes that may turn."""
        markers = [self.mbs.AddMarker(item.MarkerNodePosition(nodeNumber=node)) for node in (one, other)]
        self.mbs.AddObject(item.ObjectJointRevolute2D(markerNumbers=markers))

    def solve(self) -> None:
        """Find the equilibrium."""
        settings = exu.SimulationSettings()
        settings.linearSolver.solverType = exu.LinearSolverType.EigenSparse
        settings.parallel.numberOfThreads = 1
        settings.staticSolver.verboseMode = 0
        settings.staticSolver.newton.relativeTolerance = 1e-7  # round-off spoils fine meshes below it
        settings.solution.file.write = False
        self.mbs.Assemble()
        self.mbs.SolveStatic(settings)

    def position(self, nodes: Sequence[int]) -> FloatArray:
        """Return x and z of nodes."""
        position = exu.OutputVariableType.Position
        return np.array([self.mbs.GetNodeOutput(node, position)[:2] for node in nodes])

    def reaction(self, constraints: Sequence[int]) -> FloatArray:
        """Return forces of constraints on what they hold."""
        force = exu.OutputVariableType.Force
        return np.array([self.mbs.GetObjectOutput(number, force) for number in constraints]).ravel()

    def axial_force(self, element: int, at: float) -> float:
        """Return the axial force in an element at a local coordinate."""
        force = exu.OutputVariableType.ForceLocal
        return float(np.ravel(self.mbs.GetObjectOutputBody(element, force, [at, 0, 0]))[0])


G = 9.8
SPAN, RISE = 30.0, 2.0
MESSENGER = Section(EA=12.5e6, EJ=311.0, rhoA=0.615)


def starting_form(knots: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return positions and slopes on a parabola of about the cable's length between the hinges."""
    t, L = np.linspace(0.0, 1.0, 2001), knots[-1]
    depth = np.sqrt(max(0.375 * SPAN * (L - np.hypot(SPAN, RISE)), 0.0))
    points = np.column_stack((SPAN * t, RISE * t - 4.0 * depth * t * (1.0 - t)))
    arc = np.insert(np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1)), 0, 0.0)
    curve = CubicSpline(arc * L / arc[-1], points)
    return curve(knots), curve(knots, 1)


def our_cable(knots: FloatArray, section: Section) -> tuple[FloatArray, FloatArray]:
    """Return x and z of the nodes, and the forces of both hinges on the cable, shape (4,)."""
    r, t = (np.insert(values, 1, 0.0, axis=1) for values in starting_form(knots))
    builder = UnknownsBuilder()
    chain = Chain(np.array([builder.add_node(*pair) for pair in zip(r, t, strict=True)]), knots, section)
    la = builder.add(Kind.MULTIPLIER, np.zeros((2, 3)))
    table = builder.build()
    elements = CableElements.of([chain])
    hinges = HeldPoints(chain.nodes[[0, -1], :3], la, r[[0, -1]], np.zeros((2, 3)), np.array([-1, -1]))
    gravity = Gravity(elements.weight(table.size), G, Ramp(0.0))
    z = find_rest(System(table, (elements, gravity, hinges)), table.start).y
    return z[chain.nodes[:, [0, 2]]], -z[la][:, [0, 2]].ravel()


def peer_cable(knots: FloatArray, section: Section) -> tuple[FloatArray, FloatArray]:
    """Return the same of Exudyn."""
    peer = Peer(G)
    nodes, _ = peer.cable(knots, *starting_form(knots), section)
    held = peer.hold(nodes[0]) + peer.hold(nodes[-1])
    peer.solve()
    return peer.position(nodes), peer.reaction(held)


def pulled(cable: tuple[FloatArray, FloatArray], length: float) -> float:
    """Return the mean tension: the horizontal component times the mean of ds/dx."""
    return float(np.abs(cable[1][0]) * length / SPAN)


def check_cable(
    ours: tuple[FloatArray, FloatArray], peers: tuple[FloatArray, FloatArray], length: float, every: int = 1
) -> None:
    """Shape to 2 um on one mesh, 10 um between two, and end reactions to 5e-6 of the tension.

    One tension was taken for the conversion; 15 N more in the taut cable are 3 eps d(eps) EA = 0.04 N.
    In the slack one EJ kappa^2 = 0.3 N of axial force, by which the curvatures differ, are 0.7 um of length.
    """
    shape = 2e-6 if every == 1 else 10e-6
    np.testing.assert_allclose(peers[0][::every], ours[0], rtol=0.0, atol=shape)
    np.testing.assert_allclose(peers[1], ours[1], rtol=0.0, atol=5e-6 * pulled(ours, length))


@pytest.mark.parametrize("length", [31.0, 30.04], ids=["slack", "taut"])
def test_a_hinged_cable_hangs_like_that_of_exudyn(length: float) -> None:
    """At 0.2 kN it bends over 1.2 m, at 11 kN its strain is 0.9e-3; on one mesh and one 4 times finer."""
    knots = np.linspace(0.0, length, 31)
    ours = our_cable(knots, MESSENGER)
    section, shorter = same_stretch(MESSENGER, pulled(ours, length))
    check_cable(ours, peer_cable(shorter * knots, section), length)
    finer = np.linspace(0.0, shorter * length, 121)
    check_cable(ours, peer_cable(finer, section), length, every=4)


@pytest.mark.parametrize(
    ("length", "longer", "stiffer"),
    [(31.0, 1e-3, 1.0), (30.04, 1e-3, 1.0), (31.0, 0.0, 1.01)],
    ids=["1 mm, slack", "1 mm, taut", "bending stiffness"],
)
def test_another_cable_is_noticed(length: float, longer: float, stiffer: float) -> None:
    knots = np.linspace(0.0, length, 31)
    ours = our_cable(knots, MESSENGER)
    section, shorter = same_stretch(MESSENGER, pulled(ours, length))
    changed = replace(section, EJ=stiffer * section.EJ)
    other = peer_cable(shorter * knots * (1.0 + longer / length), changed)
    with pytest.raises(AssertionError):
        check_cable(ours, other, length)


def test_a_cable_of_another_strain_measure_is_noticed() -> None:
    """The taut cable without conversion: 0.08 mm and 15 N."""
    knots = np.linspace(0.0, 30.04, 31)
    with pytest.raises(AssertionError):
        check_cable(our_cable(knots, MESSENGER), peer_cable(knots, MESSENGER), 30.04)


@dataclass(frozen=True)
class Wire:
    """A cut wire: section for Exudyn, and points by material coordinate s and place x, z [m].

    Ends and supports are held in space; all other points are clamps, and their places are only where the
    search for the equilibrium starts.
    """

    section: Section
    s: FloatArray
    place: FloatArray
    held: NDArray[np.bool_]


@dataclass(frozen=True)
class Forward:
    """Where a line of given lengths comes to rest: heights [m], forces [N] of droppers and on holds."""

    height: FloatArray
    messenger_height: FloatArray
    force_bottom: FloatArray
    force_top: FloatArray
    on_contact_holds: FloatArray
    on_messenger_holds: FloatArray


def section_of(conductor: Conductor) -> Section:
    """Return the section of a conductor."""
    return Section(conductor.EA, conductor.EJ, conductor.rhoA)


def wire_supports(result: FormResult, which: int) -> NDArray[np.bool_]:
    """Return which supports hold a wire."""
    return np.array([wire == result.wires[which].name for wire in result.supports.wire])


def cut_wire(line: Line, result: FormResult, which: int) -> Wire:
    """Return the contact wire (0) or the messenger (1) as it is cut and marked."""
    form, droppers, supports = result.wires[which], result.droppers, result.supports
    conductor = line.conductors[(line.contact_wire, line.messenger_wire)[which].conductor]
    section, shorter = same_stretch(section_of(conductor), form.tension_mean)
    clamps = (droppers.contact_coordinate, droppers.messenger_coordinate)[which]
    height = which * droppers.unstressed_length
    mine = wire_supports(result, which)
    profile, ends = form.profile, [0, -1]
    s = np.concatenate((profile.s[ends], supports.sliding_coordinate[mine], clamps))
    x = np.concatenate((profile.x[ends], supports.x[mine], droppers.x))
    z = np.concatenate((profile.z[ends], supports.z[mine], height))
    order = np.argsort(s)
    held = np.arange(s.size) < 2 + mine.sum()
    return Wire(section, shorter * s[order], np.column_stack((x, z))[order], held[order])


def lay_wire(peer: Peer, line: Line, wire: Wire, refine: int) -> tuple[list[int], list[int]]:
    """Add a wire; return the nodes at its clamps and the constraints that hold it, in the order of s."""
    mesh = line.solver.mesh
    grading = Grading(tuple(mesh.fine), mesh.largest_element, refine)
    knots = graded_knots(float(wire.s[-1]), wire.s[1:-1], grading)
    form = CubicSpline(wire.s, wire.place)
    nodes, _ = peer.cable(knots, form(knots), form(knots, 1), wire.section)
    at = [nodes[int(np.abs(knots - s).argmin())] for s in wire.s]
    holds = [axis for node, held in zip(at, wire.held, strict=True) if held for axis in peer.hold(node)]
    return [node for node, held in zip(at, wire.held, strict=True) if not held], holds


def hang_droppers(
    peer: Peer, line: Line, lengths: FloatArray, feet: list[int], tops: list[int]
) -> list[list[int]]:
    """Add droppers of two elements; return these. Their own strain is 7e-5: no conversion."""
    section, t = section_of(line.conductors[line.dropper.conductor]), np.linspace(0.0, 1.0, 3)
    pieces: list[list[int]] = []
    for x, length, foot, top in zip(line.dropper_x, lengths, feet, tops, strict=True):
        start = np.column_stack((np.full(3, x), length * t))
        nodes, elements = peer.cable(length * t, start, np.tile([0.0, 1.0], (3, 1)), section)
        pieces.append(elements)
        peer.hinge(nodes[0], foot)
        peer.hinge(nodes[-1], top)
    return pieces


def build(line: Line, wires: tuple[Wire, Wire], lengths: FloatArray, refine: int = 1) -> Forward:
    """Build a line in Exudyn, droppers clamped to the marks on its wires, and let it come to rest."""
    peer = Peer(line.gravity)
    (feet, below), (tops, above) = (lay_wire(peer, line, wire, refine) for wire in wires)
    pieces = hang_droppers(peer, line, lengths, feet, tops)
    peer.solve()
    return Forward(
        peer.position(feet)[:, 1],
        peer.position(tops)[:, 1],
        np.array([peer.axial_force(lower, 0.0) for lower, _ in pieces]),
        np.array([peer.axial_force(p[1], 0.5 * L) for p, L in zip(pieces, lengths, strict=True)]),
        -peer.reaction(below).reshape(-1, 2),
        -peer.reaction(above).reshape(-1, 2),
    )


@pytest.fixture(scope="module")
def direct(line: Line) -> FormResult:
    return solve(line, method="direct")


@pytest.fixture(scope="module")
def wires(line: Line, direct: FormResult) -> tuple[Wire, Wire]:
    return cut_wire(line, direct, 0), cut_wire(line, direct, 1)


def on_holds(result: FormResult, which: int) -> FloatArray:
    """Return the forces of a wire on what holds its ends and on its supports, along the track and up."""
    supports, form = result.supports, result.wires[which]
    mine = wire_supports(result, which)
    between = np.column_stack((supports.force_x, supports.force_z))[mine]
    start, end = form.end_force[:, [0, 2]]
    return np.vstack((start, between, end))


def check_line(
    result: FormResult, built: Forward, height: float = 2e-6, force: float = 2e-3, hold: float = 1.0
) -> None:
    """Heights [m], forces of droppers and on holds [N] of the built line are those that were found.

    Every bay between holds has its own length, so a force along the track is as good as a length: 1 N is
    8e-8 of the messenger. Its tension varies by 0.6 %, 3 eps d(eps) = 2.5e-8, and was converted at its mean.
    """
    droppers = result.droppers
    np.testing.assert_allclose(built.height, droppers.height, rtol=0.0, atol=height)
    np.testing.assert_allclose(built.messenger_height, droppers.messenger_height, rtol=0.0, atol=height)
    np.testing.assert_allclose(built.force_bottom, droppers.force_bottom, rtol=0.0, atol=force)
    np.testing.assert_allclose(built.force_top, droppers.force_top, rtol=0.0, atol=force)
    np.testing.assert_allclose(built.on_contact_holds, on_holds(result, 0), rtol=0.0, atol=hold)
    np.testing.assert_allclose(built.on_messenger_holds, on_holds(result, 1), rtol=0.0, atol=hold)


def test_the_papers_line_built_in_exudyn_has_its_heights_forces_and_tensions(
    line: Line, direct: FormResult, wires: tuple[Wire, Wire]
) -> None:
    """Given are lengths only; the prescribed 15 kN and the heights 0 come back."""
    check_line(direct, build(line, wires, direct.droppers.unstressed_length))


def test_and_on_a_finer_mesh(line: Line, direct: FormResult, wires: tuple[Wire, Wire]) -> None:
    """Within what the default mesh contributes to lengths: 0.044 mm.

    Of a dropper that is 0.1 N, at 1.6 to 2.8 N a millimetre; 5 N are 0.026 mm of a bay of the messenger.
    """
    finer = build(line, wires, direct.droppers.unstressed_length, refine=4)
    check_line(direct, finer, height=0.044e-3, force=0.1, hold=5.0)


@pytest.mark.parametrize("dropper", [0, 3, 10])
def test_a_dropper_longer_by_1_mm_is_noticed(
    line: Line, direct: FormResult, wires: tuple[Wire, Wire], dropper: int
) -> None:
    lengths = direct.droppers.unstressed_length.copy()
    lengths[dropper] += 1e-3
    built = build(line, wires, lengths)
    assert direct.droppers.height[dropper] - built.height[dropper] > 0.3e-3
    with pytest.raises(AssertionError):
        check_line(direct, built, height=0.044e-3, force=0.1, hold=5.0)


@pytest.mark.parametrize("which", [0, 1], ids=["contact wire", "messenger"])
def test_a_wire_longer_by_1_mm_is_noticed(
    line: Line, direct: FormResult, wires: tuple[Wire, Wire], which: int
) -> None:
    """In the middle of the wire, between fixed supports: 80 N of tension and more (EA/L times 1 mm)."""
    wire = wires[which]
    middle = wire.s.size // 2
    longer = replace(wire, s=np.concatenate((wire.s[:middle], wire.s[middle:] + 1e-3)))
    changed = (longer, wires[1]) if which == 0 else (wires[0], longer)
    built = build(line, changed, direct.droppers.unstressed_length)
    with pytest.raises(AssertionError):
        check_line(direct, built, height=0.044e-3, force=0.1, hold=5.0)


def test_the_strain_measure_is_noticed(line: Line, direct: FormResult, wires: tuple[Wire, Wire]) -> None:
    """Unstressed lengths of Green strain in a program of engineering strain: 0.5 mm and 26 N."""
    contact, messenger = (
        replace(wire, s=wire.s * form.profile.s[-1] / wire.s[-1])
        for wire, form in zip(wires, direct.wires, strict=True)
    )
    built = build(line, (contact, messenger), direct.droppers.unstressed_length)
    with pytest.raises(AssertionError):
        check_line(direct, built, height=0.044e-3, force=0.1, hold=5.0)
