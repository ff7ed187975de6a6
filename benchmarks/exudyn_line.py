"""The peer: form-finding of a plane line scripted around Exudyn's static solver.

Exudyn has neither unknown lengths nor prescribed tensions, so the staged method is written out in Python:
the contact wire is pinned at the wanted heights, its reactions are the droppers' forces, the messenger hangs
under these, and the lengths lie between the two. Where the script could choose, it does what is fastest:
plane ANCF cables, droppers as forces, the sparse solver with its pattern kept, warm restarts, the module
without range checks, and one loop for reference strain (by secants) and dropper weights together.

The droppers are clamped to nodes, which are material points and move along the track by up to 2 mm as the
wire takes its form, and the weight lacks the excess of the arc over its chord: hundredths of a millimetre in
the lengths, which would cost time to mend. In `catenaria` the clamps keep their places.
"""

from __future__ import annotations

import sys
import warnings
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.mesh import Grading, graded_knots
from catenaria.line import Conductor, Line

sys.exudynFast = True  # pyright: ignore[reportAttributeAccessIssue]  # Exudyn's own switch: no range checks
with warnings.catch_warnings():
    warnings.simplefilter("ignore", DeprecationWarning)
    import exudyn as exu  # pyright: ignore[reportMissingImports]
    import exudyn.itemInterface as item  # noqa: N813  # pyright: ignore[reportMissingImports]

FloatArray = NDArray[np.float64]

TENSION_TOLERANCE = 0.1  # N
LENGTH_TOLERANCE = 1e-6  # m
_ROUNDS = 20


@dataclass(frozen=True)
class PeerForm:
    """What was found, and the work: lengths [m], unknowns with multipliers, static solves, Newton steps."""

    unstressed_length: FloatArray
    unknowns: int
    solves: int
    newton: int


@dataclass
class Wire:
    """A wire between pinned ends, held at heights and loaded in points.

    Parameters
    ----------
    conductor, x, height, gravity
        What it is made of, its nodes along the track [m], their height before [m], and gravity [m/s^2].
    strain_wanted : float
        What the wanted tension strains it by; the mass of a tensioned metre follows.
    measured_at : float
        Where the tension is measured: in the field between the first support and the first dropper, where
        the wire is straight. A wire that slides without friction has the same tension behind its support.
    """

    conductor: Conductor
    x: FloatArray
    height: float
    gravity: float
    strain_wanted: float
    measured_at: float
    mbs: Any = field(init=False)  # the types of Exudyn's stubs are modules
    strain: float = 0.0
    solves: int = 0
    newton: int = 0

    def __post_init__(self) -> None:
        self._container = exu.SystemContainer()
        self.mbs = self._container.AddSystem()
        ground = self.mbs.AddNode(item.NodePointGround())
        self._ground = self.mbs.AddMarker(item.MarkerNodeCoordinate(nodeNumber=ground, coordinate=0))
        slope = item.NodePoint2DSlope1
        self.nodes = [self.mbs.AddNode(slope(referenceCoordinates=[x, self.height, 1, 0])) for x in self.x]
        self._elements = [self._element(i) for i in range(self.x.size - 1)]
        for end, axis in ((0, 0), (0, 1), (-1, 0), (-1, 1)):
            self._hold(self.nodes[end], axis, 0.0)

    def _element(self, i: int) -> int:
        of = self.conductor
        cable = item.ObjectANCFCable2D(
            length=self.x[i + 1] - self.x[i],
            massPerLength=of.rhoA / (1.0 + self.strain_wanted),
            bendingStiffness=of.EJ,
            axialStiffness=of.EA,
            nodeNumbers=self.nodes[i : i + 2],
        )
        number = self.mbs.AddObject(cable)
        mass = self.mbs.AddMarker(item.MarkerBodyMass(bodyNumber=number))
        self.mbs.AddLoad(item.Gravity(markerNumber=mass, loadVector=[0, -self.gravity, 0]))
        return number

    def _marker(self, node: int, coordinate: int) -> int:
        return self.mbs.AddMarker(item.MarkerNodeCoordinate(nodeNumber=node, coordinate=coordinate))

    def _hold(self, node: int, coordinate: int, offset: float) -> int:
        markers = [self._ground, self._marker(node, coordinate)]
        return self.mbs.AddObject(item.CoordinateConstraint(markerNumbers=markers, offset=offset))

    def node_at(self, x: float) -> int:
        """Return the node at a position."""
        return self.nodes[int(np.argmin(np.abs(self.x - x)))]

    def hold(self, x: float, height: float) -> int:
        """Hold the wire at a height and return the constraint."""
        return self._hold(self.node_at(x), 1, height - self.height)

    def load(self, x: float) -> int:
        """Add a vertical force, zero so far, and return it."""
        return self.mbs.AddLoad(item.LoadCoordinate(markerNumber=self._marker(self.node_at(x), 1), load=0.0))

    def set_strain(self, strain: float) -> None:
        """Change the reference strain of the whole wire."""
        self.strain = strain
        for number in self._elements:
            self.mbs.SetObjectParameter(number, "referenceAxialStrain", strain)

    def solve(self, settings: exu.SimulationSettings) -> None:
        """Find the equilibrium, from the last one if there is one."""
        if self.solves:
            data, initial = self.mbs.systemData, exu.ConfigurationType.Initial
            data.SetODE2Coordinates(data.GetODE2Coordinates(), initial)
            data.SetAECoordinates(data.GetAECoordinates(), initial)
        self.mbs.SolveStatic(settings, updateInitialValues=False, storeSolver=True)
        self.solves += 1
        self.newton += int(self.mbs.sys["staticSolver"].it.newtonStepsCount)

    @property
    def tension(self) -> float:
        """Axial force where it is measured [N]."""
        element = int(np.searchsorted(self.x, self.measured_at)) - 1
        force, place = exu.OutputVariableType.ForceLocal, [self.measured_at - self.x[element], 0, 0]
        return float(np.ravel(self.mbs.GetObjectOutputBody(self._elements[element], force, place))[0])

    @property
    def unknowns(self) -> int:
        """Coordinates and multipliers."""
        data = self.mbs.systemData
        return len(data.GetODE2Coordinates()) + len(data.GetAECoordinates())

    def position(self, x: float) -> FloatArray:
        """Return where the node at a position is now."""
        return np.array(self.mbs.GetNodeOutput(self.node_at(x), exu.OutputVariableType.Position)[:2])


def find_peer_form(line: Line, grading: Grading) -> PeerForm:
    """Find the dropper lengths of a plane line whose clamps and clamped lengths have no mass.

    Parameters
    ----------
    line : Line
        The line.
    grading : Grading
        How both wires are divided.

    Raises
    ------
    RuntimeError
        If the outer loop does not converge.
    """
    kind, settings = line.dropper, _settings()
    contact, foot_force = _contact_wire(line, grading, settings)
    feet = np.array([contact.position(x) for x in line.dropper_x])
    messenger = _wire(line, grading, contact=False)
    loads = [messenger.load(x) for x in line.dropper_x]
    messenger.mbs.Assemble()
    conductor = line.conductors[kind.conductor]
    length = np.full(len(loads), kind.guessed_length)

    def hang() -> float:
        """Load the wire by forces and weights, solve, update the lengths; return their largest change."""
        nonlocal length
        weight = conductor.rhoA * line.gravity * length
        for load, force in zip(loads, foot_force + weight, strict=True):
            messenger.mbs.SetLoadParameter(load, "load", -force)
        messenger.solve(settings)
        tops = np.array([messenger.position(x) for x in line.dropper_x])
        distance = np.linalg.norm(tops - feet, axis=1)
        previous, length = length, distance / (1.0 + (foot_force + 0.5 * weight) / conductor.EA)
        return float(np.abs(length - previous).max())

    _tighten(messenger, line.messenger_wire.tension.force, hang)
    return PeerForm(
        length,
        contact.unknowns + messenger.unknowns,
        contact.solves + messenger.solves,
        contact.newton + messenger.newton,
    )


def _contact_wire(line: Line, grading: Grading, settings: exu.SimulationSettings) -> tuple[Wire, FloatArray]:
    """Return the contact wire at the wanted heights and the forces that hold it there."""
    wire = _wire(line, grading, contact=True)
    wanted = zip(line.dropper_x, line.dropper_target_height, strict=True)
    held = [wire.hold(x, height) for x, height in wanted]
    wire.mbs.Assemble()

    def settle() -> float:
        wire.solve(settings)
        return 0.0

    _tighten(wire, line.contact_wire.tension.force, settle)
    outputs = [wire.mbs.GetObjectOutput(number, exu.OutputVariableType.Force) for number in held]
    return wire, np.array(outputs, dtype=np.float64).ravel()


def _wire(line: Line, grading: Grading, contact: bool) -> Wire:
    """Return the wire on its supports; the reference strain is the first guess."""
    supports = [line.supports[i] for i in line.contact_support_indices] if contact else line.supports
    x = np.array(line.support_x)
    if contact:
        x = x[list(line.contact_support_indices)]
    what = line.contact_wire if contact else line.messenger_wire
    conductor = line.conductors[what.conductor]
    strain = what.tension.force / conductor.EA
    start, end = x[0] - what.tail, x[-1] + what.tail
    centres = np.concatenate((x, line.dropper_x)) - start
    knots = start + graded_knots(float(end - start), centres, grading)
    heights = [s.contact_wire.height if contact and s.contact_wire else s.messenger_height for s in supports]
    wire = Wire(conductor, knots, heights[0], line.gravity, strain, 0.5 * (x[0] + line.dropper_x[0]))
    for at, height in zip(x, heights, strict=True):
        wire.hold(at, height)
    wire.set_strain(-strain)
    return wire


def _tighten(wire: Wire, tension: float, solve: Callable[[], float]) -> None:
    """Find the reference strain of a tension by secants; `solve` returns what else has changed [m]."""
    change, excess = solve(), wire.tension - tension
    stiffness = wire.conductor.EA
    for _ in range(_ROUNDS):
        if abs(excess) < TENSION_TOLERANCE and change < LENGTH_TOLERANCE:
            return
        step, before = excess / stiffness, excess
        wire.set_strain(wire.strain + step)
        change, excess = solve(), wire.tension - tension
        if abs(step) * stiffness > TENSION_TOLERANCE:
            stiffness = min(max((before - excess) / step, 0.1 * stiffness), 10.0 * stiffness)
    raise RuntimeError(f"Exudyn's wire misses its tension by {excess:.3g} N after {_ROUNDS} rounds")


def _settings() -> exu.SimulationSettings:
    settings = exu.SimulationSettings()
    settings.linearSolver.solverType = exu.LinearSolverType.EigenSparse
    settings.linearSolver.reuseAnalyzedPattern = True
    settings.parallel.numberOfThreads = 1
    settings.staticSolver.verboseMode = 0
    settings.staticSolver.newton.relativeTolerance = 1e-6  # with its 1e-8 round-off spoils fine meshes
    settings.solution.file.write = False
    return settings
