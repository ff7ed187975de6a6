"""Build an overhead contact line in Exudyn from the files beside this one, and see whether it stays at rest.

    python line_in_exudyn.py                  static solution
    python line_in_exudyn.py --dynamic 0.2    and then 0.2 s of motion without any disturbance

It needs numpy and exudyn, nothing else. The files are a line at rest in catenaria's neutral format for
dynamics codes. Printed is, as JSON, how far nodes are away from where they should rest, at any time, and how
much the forces differ; after a motion also by how much it has changed tensions. The exit code is 0 if the
first two are below 1 um and 0.1 %, else 1.

What differs from catenaria is converted: wires and droppers have engineering strain here instead of Green
strain, and a curvature by |r'|^2 instead of |r'|^3, both with the force and the stiffness of every element at
rest. Wires that run over rollers and through brackets are clamped there, and lateral springs are rigid; at
rest that makes no difference.
"""

from __future__ import annotations

import argparse
import json
import sys
import warnings
from dataclasses import dataclass, field
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
Arrays = dict[str, NDArray[Any]]
Joint = dict[str, Any]

MOVEMENT = 1e-6  # m
FORCE = 1e-3  # of a force
LEAST = 10.0  # N: what smaller forces are compared with
_UP = np.array([0.0, 0.0, 1.0])


@dataclass(frozen=True)
class Engineering:
    """Pieces whose law in engineering strain has the force and the tangent stiffness of one in Green strain.

    Attributes
    ----------
    a : FloatArray
        |r'| at tensions T = EA a (a^2 - 1)/2; the cubic is solved by Viete's cosine.
    shorter : FloatArray
        Unstressed lengths as parts of the given ones.
    EA : FloatArray
        Axial stiffness [N].

    Notes
    -----
    With k = dT/da = EA (3 a^2 - 1)/2, the law T + k (a' - a) has no force at a' = a - T/k. Bending pulls at
    a wire by dU/da, which is -6 U/a for a curvature by |r'|^3 and -4 U/a for one by |r'|^2; the difference is
    taken from T.
    """

    a: FloatArray
    shorter: FloatArray
    EA: FloatArray

    @classmethod
    def at(cls, EA: FloatArray, tension: FloatArray, bending: FloatArray | float = 0.0) -> Engineering:
        """Return pieces of stiffness EA at their tensions, with an energy of bending U per length [N]."""
        a = 2.0 / np.sqrt(3.0) * np.cos(np.arccos(3.0 * np.sqrt(3.0) * tension / EA) / 3.0)
        k = 0.5 * EA * (3.0 * a**2 - 1.0)
        shorter = a - (tension - 2.0 * bending / a) / k
        return cls(a, shorter, shorter * k)


def bending_energy(arrays: Arrays) -> FloatArray:
    """Return the mean over every element of EJ kappa^2/2 at rest [N], kappa = |r' x r''|/|r'|^3."""
    points, weights = np.polynomial.legendre.leggauss(5)
    L, pairs = arrays["element_length"][:, None], arrays["element_nodes"]
    r, r1 = arrays["node_position"][pairs], L[:, :, None] * arrays["node_slope"][pairs]
    energy = np.zeros(pairs.shape[0])
    for x, weight in zip(0.5 * (points + 1.0), 0.5 * weights, strict=True):
        slope = 6.0 * x * (1.0 - x) * (r[:, 1] - r[:, 0])
        slope += (1.0 - x) * (1.0 - 3.0 * x) * r1[:, 0] + x * (3.0 * x - 2.0) * r1[:, 1]
        bend = (
            (6.0 - 12.0 * x) * (r[:, 1] - r[:, 0]) + (6.0 * x - 4.0) * r1[:, 0] + (6.0 * x - 2.0) * r1[:, 1]
        )
        square = np.einsum("ni,ni->n", *(np.cross(slope / L, bend / L**2),) * 2)
        energy += weight * square / np.einsum("ni,ni->n", *(slope / L,) * 2) ** 3
    return 0.5 * arrays["element_EJ"] * energy


@dataclass(frozen=True)
class Connector:
    """A connector, and the force on its first marker at rest [N], of arms and rigid droppers their thrust."""

    number: int
    force: FloatArray
    spring: bool

    def error(self, found: FloatArray, after_motion: bool) -> float:
        """Return the error of a force, relative to it or to 10 N."""
        turned = (
            after_motion and not self.spring
        )  # Exudyn's integrators tell constraint forces with the other sign
        off = (-found if turned else found) - self.force
        return float(np.linalg.norm(off) / max(np.linalg.norm(self.force), LEAST))


@dataclass
class LineInExudyn:
    """The line as an Exudyn system; clamps, arms and masses have inertia only if it is to move."""

    model: dict[str, Any]
    arrays: Arrays
    inertia: bool
    exu: Any
    item: Any
    container: Any
    mbs: Any
    pieces: Engineering
    connectors: list[Connector] = field(default_factory=list[Connector])
    farthest: float = 0.0

    def build(self) -> None:
        """Add wires, masses, joints and droppers."""
        self._cables()
        self._masses()
        for joint in self.model["joints"]:
            if joint["kind"] == "root":
                self._root(joint["node"])
            elif joint["kind"] == "arm":
                self._arm(joint)
            elif joint["kind"] != "rigid dropper":
                self._join(joint)
        for i in range(self.arrays["dropper_length"].size):
            self._dropper(i)
        self.mbs.Assemble()

    def _cables(self) -> None:
        """Add nodes and elements where they rest, under their weight."""
        arrays, item = self.arrays, self.item
        pairs, count = arrays["element_nodes"], arrays["node_position"].shape[0]
        a, shorter = self.pieces.a, self.pieces.shorter
        ends = np.bincount(pairs.ravel(), minlength=count)
        factor = np.bincount(pairs.ravel(), np.repeat(shorter, 2), minlength=count) / ends
        for state in np.hstack((arrays["node_position"], arrays["node_slope"] / factor[:, None])):
            self.mbs.AddNode(item.NodePointSlope1(referenceCoordinates=state.tolist()))
        EJ, rhoA = arrays["element_EJ"] / a**2 / shorter, arrays["element_rhoA"] / shorter
        for i, pair in enumerate(pairs.tolist()):
            cable = item.ObjectANCFCable(
                length=shorter[i] * arrays["element_length"][i],
                massPerLength=rhoA[i],
                bendingStiffness=EJ[i],
                axialStiffness=self.pieces.EA[i],
                nodeNumbers=pair,
            )
            mass = self.mbs.AddMarker(item.MarkerBodyMass(bodyNumber=self.mbs.AddObject(cable)))
            weight = [0.0, 0.0, -self.model["gravity"]]
            self.mbs.AddLoad(item.Gravity(markerNumber=mass, loadVector=weight))

    def _within(self, wire: int, s: float) -> tuple[int, float]:
        """Return in which element a material coordinate of a wire is, and in which part of it."""
        strand = self.model["wires"][wire]
        first, count = strand["first_node"], strand["nodes"]
        knots = self.arrays["node_coordinate"][first : first + count]
        i = int(np.clip(np.searchsorted(knots, s, side="right") - 1, 0, count - 2))
        return strand["first_element"] + i, float((s - knots[i]) / (knots[i + 1] - knots[i]))

    def point(self, wire: int, s: float) -> int:
        """Return a marker at a material coordinate of a wire."""
        element, part = self._within(wire, s)
        local = [part * self.pieces.shorter[element] * self.arrays["element_length"][element], 0.0, 0.0]
        return self.mbs.AddMarker(self.item.MarkerBodyPosition(bodyNumber=element, localPosition=local))

    def place(self, wire: int, s: float) -> FloatArray:
        """Return where a point of a wire should rest, by the cubic between its nodes."""
        element, x = self._within(wire, s)
        i, j = self.arrays["element_nodes"][element]
        L, r, r1 = (self.arrays[name] for name in ("element_length", "node_position", "node_slope"))
        bend = L[element] * x * (1.0 - x) * ((1.0 - x) * r1[i] - x * r1[j])
        return (1.0 - x) ** 2 * (1.0 + 2.0 * x) * r[i] + x**2 * (3.0 - 2.0 * x) * r[j] + bend

    def _node(self, number: int) -> int:
        return self.mbs.AddMarker(self.item.MarkerNodePosition(nodeNumber=number))

    def _ground(self, place: list[float]) -> int:
        ground = self.mbs.AddObject(self.item.ObjectGround(referencePosition=place))
        return self.mbs.AddMarker(self.item.MarkerBodyPosition(bodyNumber=ground))

    def _connect(self, connector: Any, force: FloatArray, *, spring: bool = False) -> None:
        self.connectors.append(Connector(self.mbs.AddObject(connector), force, spring))

    def _masses(self) -> None:
        names = ("mass_wire", "mass_coordinate", "mass_inertia", "mass_weight")
        for wire, s, mass, weight in zip(*(self.arrays[name].tolist() for name in names), strict=True):
            marker = self.point(wire, s)
            self.mbs.AddLoad(self.item.Force(markerNumber=marker, loadVector=[0.0, 0.0, -weight]))
            if self.inertia and mass > 0.0:
                at = self.item.NodePoint(referenceCoordinates=self.place(wire, s).tolist())
                body = self.item.MassPoint(mass=mass, nodeNumber=self.mbs.AddNode(at))
                number = self.mbs.AddObject(body)
                other = self.mbs.AddMarker(self.item.MarkerBodyPosition(bodyNumber=number))
                self.mbs.AddObject(self.item.SphericalJoint(markerNumbers=[marker, other]))

    def _join(self, joint: Joint) -> None:
        """Hold a wire in place, at the tip of a cantilever or to another wire; springs give vertically."""
        kind, force = joint["kind"], np.array(joint["force"])
        if kind in ("end", "tie"):
            on = self._node(joint["node"])
        else:
            on = self.point(joint["wire"], joint["coordinate"])
        if kind == "tie":
            to = self.point(joint["host"], joint["coordinate"])
        else:
            to = self._node(joint["node"]) if kind == "cantilever" else self._ground(joint["place"])
        if kind == "bracket":
            force = force[0] * np.array(joint["left"]) + force[1] * _UP
        soft = joint["compliance"][1] if kind == "spring" else 0.0
        held = np.array([1.0, 1.0, 0.0 if soft else 1.0])
        ball = self.item.SphericalJoint(markerNumbers=[to, on], constrainedAxes=held.astype(int).tolist())
        self._connect(ball, -held * force)
        if soft:
            root = self._ground([*joint["place"][:2], joint["unloaded"][2]])
            spring = self.item.CartesianSpringDamper(
                markerNumbers=[root, on], stiffness=[0.0, 0.0, 1.0 / soft]
            )
            self._connect(spring, (1.0 - held) * force, spring=True)

    def _arm(self, joint: Joint) -> None:
        """Keep a wire at its distance from a hinge."""
        markers = [self._ground(joint["hinge"]), self.point(joint["wire"], joint["coordinate"])]
        bar = self.item.DistanceConstraint(markerNumbers=markers, distance=joint["length"])
        self._connect(bar, -np.array(joint["force"]))

    def _root(self, node: int) -> None:
        """Hold a node and its slope."""
        ground = self.mbs.AddNode(self.item.NodePointGround())
        fixed = self.mbs.AddMarker(self.item.MarkerNodeCoordinate(nodeNumber=ground, coordinate=0))
        for i in range(6):
            own = self.mbs.AddMarker(self.item.MarkerNodeCoordinate(nodeNumber=node, coordinate=i))
            self.mbs.AddObject(self.item.CoordinateConstraint(markerNumbers=[fixed, own]))

    def _dropper(self, i: int) -> None:
        """Add a dropper, unless it is slack."""
        arrays = self.arrays
        if arrays["dropper_slack"][i]:
            return
        length, force = arrays["dropper_length"][i], arrays["dropper_force"][i]
        ends = [(arrays[f"dropper_{end}_wire"][i], arrays[f"dropper_{end}_coordinate"][i]) for end in ENDS]
        markers = [self.point(int(wire), float(s)) for wire, s in ends]
        below, above = (self.place(int(wire), float(s)) for wire, s in ends)
        direction = (above - below) / np.linalg.norm(above - below)
        flexibility = arrays["dropper_flexibility"][i]
        if flexibility == 0.0:
            bar = self.item.DistanceConstraint(markerNumbers=markers, distance=length)
            self._connect(bar, np.array([-force]))
        else:
            piece = Engineering.at(np.array(1.0 / flexibility), force)
            own = float(piece.shorter * length)
            spring = self.item.SpringDamper(
                markerNumbers=markers, referenceLength=own, stiffness=float(piece.EA) / own
            )
            self._connect(spring, force * direction, spring=True)

    def solve(self) -> None:
        """Find the equilibrium."""
        settings = self._settings()
        settings.staticSolver.verboseMode = 0
        settings.staticSolver.newton.relativeTolerance = 1e-7  # round-off spoils fine meshes below it
        self.mbs.SolveStatic(settings, updateInitialValues=True)

    def move(self, seconds: float) -> None:
        """Let it move for some time, from where it is, without any disturbance."""
        settings = self._settings()
        settings.timeIntegration.verboseMode = 0
        settings.timeIntegration.endTime = seconds
        settings.timeIntegration.numberOfSteps = max(10, round(seconds / 2e-3))
        settings.timeIntegration.newton.relativeTolerance = 1e-6
        settings.timeIntegration.newton.absoluteTolerance = 1e-6
        settings.timeIntegration.generalizedAlpha.spectralRadius = 0.8
        self.mbs.SetPostStepUserFunction(self._watch)
        self.mbs.SolveDynamic(settings)

    def _settings(self) -> Any:
        settings = self.exu.SimulationSettings()
        settings.linearSolver.solverType = self.exu.LinearSolverType.EigenSparse
        settings.parallel.numberOfThreads = 1
        settings.solution.file.write = False
        return settings

    def _watch(self, mbs: Any, t: float) -> bool:
        """Note the largest movement of a step in time; Exudyn goes on with the next one."""
        self.farthest = max(self.farthest, self.movement())
        return True

    def movement(self) -> float:
        """Return how far a node is at most from where it should rest [m]."""
        count = self.arrays["node_position"].shape[0]
        moved = np.array(self.mbs.systemData.GetODE2Coordinates())[: 6 * count].reshape(count, 6)[:, :3]
        return float(np.linalg.norm(moved, axis=1).max())

    def tensions(self) -> FloatArray:
        """Return the axial forces in the middle of all elements [N]."""
        kind, half = self.exu.OutputVariableType.ForceLocal, 0.5 * self.pieces.shorter
        middles = half * self.arrays["element_length"]
        return np.array(
            [self.mbs.GetObjectOutputBody(i, kind, [x, 0.0, 0.0]) for i, x in enumerate(middles.tolist())]
        )

    def force_error(self) -> float:
        """Return the largest relative error of a connector's force."""
        kind = self.exu.OutputVariableType.Force
        pairs = ((each, self.mbs.GetObjectOutput(each.number, kind)) for each in self.connectors)
        return max(each.error(np.atleast_1d(found), self.inertia) for each, found in pairs)


ENDS = ("lower", "upper")


def read(folder: Path, inertia: bool) -> LineInExudyn:
    """Return the line that a folder describes, built in Exudyn."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)
        exu, item = import_module("exudyn"), import_module("exudyn.itemInterface")
    model = json.loads((folder / "model.json").read_text(encoding="utf-8"))
    with np.load(folder / "arrays.npz") as archive:
        arrays = {name: archive[name] for name in archive.files}
    pieces = Engineering.at(arrays["element_EA"], arrays["element_tension"], bending_energy(arrays))
    container = exu.SystemContainer()
    line = LineInExudyn(model, arrays, inertia, exu, item, container, container.AddSystem(), pieces)
    line.build()
    return line


def main() -> int:
    """Build, solve and report."""
    parser = argparse.ArgumentParser(description="Build a line in Exudyn and see whether it stays at rest.")
    parser.add_argument("--folder", type=Path, default=Path(__file__).parent, help="with model.json")
    parser.add_argument("--dynamic", type=float, default=0.0, metavar="SECONDS", help="move for some time")
    options = parser.parse_args()
    line = read(options.folder, inertia=options.dynamic > 0.0)
    line.solve()
    said = {"movement_m": line.movement()}
    if options.dynamic > 0.0:
        before = line.tensions()
        line.move(options.dynamic)
        said["movement_m"] = max(said["movement_m"], line.farthest)
        said["tension_change_N"] = float(np.abs(line.tensions() - before).max())
    said["force_error"] = line.force_error()
    sys.stdout.write(json.dumps(said) + "\n")
    return 0 if said["movement_m"] < MOVEMENT and said["force_error"] < FORCE else 1


if __name__ == "__main__":
    sys.exit(main())
