"""Lines in space against Exudyn's ANCF cable in space; collected where that is installed.

What was found is built of its lengths: clamps fixed to their wires, arms on their hinges. As for plane
lines, pieces are converted from Green strain to Exudyn's engineering strain, and from a curvature by |r'|^3
to one by |r'|^2, here at the tension of every element. Droppers (strain 1e-4) need no conversion. Exudyn's
search for the equilibrium starts up to 5 mm beside every clamp.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from importlib import import_module
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from catenaria.line import Line
from catenaria.results import FormResult
from catenaria.workflow import solve

FloatArray = NDArray[np.float64]

with warnings.catch_warnings():
    warnings.simplefilter("ignore", DeprecationWarning)
    exu: Any = import_module("exudyn")
    item: Any = import_module("exudyn.itemInterface")

SPANS, LENGTH = 2, 50.0
DROPPERS = (5.0, 15.0, 25.0, 35.0, 45.0)
CLAMP, ARM = 0.2, 3.0  # kg
LIBRARY = {
    "contact": {"youngs_modulus": 120e9, "area": 120e-6, "mass_per_length": 1.07, "bending_stiffness": 131.0},
    "messenger": {"youngs_modulus": 113e9, "area": 66e-6, "mass_per_length": 0.60, "bending_stiffness": 20.0},
    "thin": {"youngs_modulus": 119e9, "area": 10e-6, "mass_per_length": 0.089, "bending_stiffness": 4.0},
}
CURVE = {"start": 20.0, "length": 500.0, "radius": 600.0, "transition": 60.0, "cant": 0.12}
CASES: dict[str, dict[str, Any]] = {
    "stagger": {},
    "stitch wire": {"stitch_wire": {"conductor": "thin", "tension": 2800.0, "length": 16.0}},
    "curve": {"track": {"curves": [CURVE]}},
}
BESIDE = 5e-3  # m, of the clamps' places from where the search starts


def support(number: int, case: str) -> dict[str, Any]:
    """Return a support: zigzag on straight track, outwards in the curve."""
    arm = {"length": 1.2, "mass": ARM, "registration": "pull-off"}
    return {
        "stagger": -0.2 if case == "curve" else 0.2 * (-1) ** number,
        "messenger_stagger": 0.0,
        "contact_wire": {"height": 5.5, "kind": "steady arm", "arm": arm},
        "messenger_wire": {"encumbrance": 1.6},
    }


def line_of(case: str) -> Line:
    """Return a short line; its droppers lean, because the messenger has no stagger."""
    wire = {"tension": {"force": 15e3}, "tail": 5.0}
    clamps = {"clamp_mass_top": CLAMP, "clamp_mass_bottom": CLAMP}
    fields = {
        "format": 1,
        "name": case,
        "conductors": LIBRARY,
        "contact_wire": {"conductor": "contact", **wire},
        "messenger_wire": {"conductor": "messenger", **wire},
        "dropper": {"conductor": "thin", "model": "bar", **clamps},
        "supports": [support(i, case) for i in range(SPANS + 1)],
        "spans": [{"length": LENGTH, "pre_sag": 0.03, "droppers": {"positions": DROPPERS}}] * SPANS,
    }
    return Line.model_validate(fields | CASES[case])


Convert = Callable[[float, FloatArray], tuple[FloatArray, FloatArray]]


def by_engineering_strain(EA: float, tension: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return a = |r'| at tensions EA a (a^2 - 1)/2, and by what pieces are shorter for EA (a - 1).

    The cubic is solved by Viete's cosine.
    """
    a = 2.0 / np.sqrt(3.0) * np.cos(np.arccos(3.0 * np.sqrt(3.0) * tension / EA) / 3.0)
    return a, a / (1.0 + tension / EA)


@dataclass(frozen=True)
class Pieces:
    """A wire for Exudyn: natural coordinates of nodes [m], and length, EJ and mass per length of elements."""

    s: FloatArray
    EA: float
    length: FloatArray
    EJ: FloatArray
    rhoA: FloatArray


def pieces_of(line: Line, result: FormResult, wire: int, refine: int, convert: Convert) -> Pieces:
    """Return a wire on its own mesh with every element divided, as long as it was found."""
    stage, form = result.stages[0], result.wires[wire]
    knots = np.split(stage.s, np.cumsum(stage.node_count)[:-1])[wire]
    s = np.interp(np.arange(refine * (knots.size - 1) + 1) / refine, np.arange(knots.size), knots)
    names = {
        "contact wire": line.contact_wire.conductor,
        "messenger wire": line.messenger_wire.conductor,
        "stitch wire": line.stitch_wire.conductor if line.stitch_wire else "",
    }
    conductor = line.conductors[names[form.role]]
    tension = np.interp(0.5 * (s[1:] + s[:-1]), form.profile.s, form.profile.tension)
    a, shorter = convert(conductor.EA, tension)
    return Pieces(
        s, conductor.EA, shorter * np.diff(s), conductor.EJ / a**2 / shorter, conductor.rhoA / shorter
    )


def marks(result: FormResult, wire: str) -> Iterator[tuple[float, FloatArray]]:
    """Yield natural coordinates of ends, supports and droppers on a wire, and where they are."""
    droppers, supports, form = result.droppers, result.supports, result.wire(wire).profile
    held = np.column_stack((supports.x, supports.y, supports.z))
    yield from zip(form.s[[0, -1]], np.column_stack((form.x, form.y, form.z))[[0, -1]], strict=True)
    for on, s, r in (
        (supports.wire, supports.sliding_coordinate, held),
        (droppers.lower_wire, droppers.contact_coordinate, droppers.position_bottom),
        (droppers.upper_wire, droppers.messenger_coordinate, droppers.position_top),
    ):
        own = [name == wire for name in on]
        yield from zip(s[own], r[own], strict=True)


class Peer:
    """A line in space in Exudyn."""

    def __init__(self, gravity: float) -> None:
        self._container, self._gravity = exu.SystemContainer(), gravity
        self._mbs = self._container.AddSystem()
        self._wires: dict[str, tuple[FloatArray, FloatArray, list[int]]] = {}

    def wire(self, name: str, pieces: Pieces, near: CubicSpline) -> None:
        """Add a wire under its weight."""
        states = np.hstack((near(pieces.s), near(pieces.s, 1)))
        nodes = [self._mbs.AddNode(item.NodePointSlope1(referenceCoordinates=list(r))) for r in states]
        elements: list[int] = []
        for i, (length, EJ, rhoA) in enumerate(zip(pieces.length, pieces.EJ, pieces.rhoA, strict=True)):
            cable = item.ObjectANCFCable(
                length=length,
                massPerLength=rhoA,
                bendingStiffness=EJ,
                axialStiffness=pieces.EA,
                nodeNumbers=nodes[i : i + 2],
            )
            elements.append(self._mbs.AddObject(cable))
            mass = self._mbs.AddMarker(item.MarkerBodyMass(bodyNumber=elements[-1]))
            self._mbs.AddLoad(item.Gravity(markerNumber=mass, loadVector=[0, 0, -self._gravity]))
        self._wires[name] = (pieces.s, pieces.length, elements)

    def _local(self, wire: str, s: float) -> tuple[int, list[float]]:
        """Return in which element of a wire a natural coordinate is, and where in it."""
        knots, length, elements = self._wires[wire]
        i = min(int(np.searchsorted(knots, s, side="right")) - 1, len(elements) - 1)
        return elements[i], [length[i] * (s - knots[i]) / (knots[i + 1] - knots[i]), 0.0, 0.0]

    def point(self, wire: str, s: float, mass: float = 0.0) -> int:
        """Return a marker on a wire; a mass hangs from it."""
        element, local = self._local(wire, s)
        marker = self._mbs.AddMarker(item.MarkerBodyPosition(bodyNumber=element, localPosition=local))
        self._mbs.AddLoad(item.Force(markerNumber=marker, loadVector=[0, 0, -mass * self._gravity]))
        return marker

    def ground(self, place: FloatArray) -> int:
        """Return a marker on the ground."""
        ground = self._mbs.AddObject(item.ObjectGround(referencePosition=list(place)))
        return self._mbs.AddMarker(item.MarkerBodyPosition(bodyNumber=ground))

    def join(self, one: int, other: int) -> int:
        """Keep two markers together."""
        return self._mbs.AddObject(item.SphericalJoint(markerNumbers=[one, other]))

    def arm(self, hinge: int, tip: int, length: float) -> int:
        """Keep two markers at a distance."""
        return self._mbs.AddObject(item.DistanceConstraint(markerNumbers=[hinge, tip], distance=length))

    def bar(self, bottom: int, top: int, length: float, EA: float) -> int:
        """Hang one marker from another."""
        spring = item.SpringDamper(markerNumbers=[bottom, top], referenceLength=length, stiffness=EA / length)
        return self._mbs.AddObject(spring)

    def solve(self) -> None:
        """Find the equilibrium."""
        settings = exu.SimulationSettings()
        settings.linearSolver.solverType = exu.LinearSolverType.EigenSparse
        settings.parallel.numberOfThreads = 1
        settings.staticSolver.verboseMode = 0
        settings.staticSolver.newton.relativeTolerance = 1e-7  # round-off spoils fine meshes below it
        settings.solution.file.write = False
        self._mbs.Assemble()
        self._mbs.SolveStatic(settings)

    def place(self, wire: str, s: float) -> FloatArray:
        """Return where a point of a wire is."""
        element, local = self._local(wire, s)
        return np.array(self._mbs.GetObjectOutputBody(element, exu.OutputVariableType.Position, local))

    def force(self, connectors: list[int]) -> FloatArray:
        """Return forces of connectors."""
        force = exu.OutputVariableType.Force
        return np.array([self._mbs.GetObjectOutput(number, force) for number in connectors])


@dataclass(frozen=True)
class Built:
    """Where clamps come to rest [m], and forces on lower wires, of wires on supports, ends and ties [N].

    Of arms the tension, positive if they pull.
    """

    bottom: FloatArray
    top: FloatArray
    on_lower: FloatArray
    on_support: FloatArray
    arm: FloatArray
    on_end: FloatArray
    on_host: FloatArray


def build(line: Line, result: FormResult, refine: int = 1, convert: Convert = by_engineering_strain) -> Built:
    """Build the lengths, clamps and hinges of a result in Exudyn, and let it come to rest."""
    peer, random = Peer(line.gravity), np.random.default_rng(5)
    for k, form in enumerate(result.wires):
        s, r = (np.array(v) for v in zip(*sorted(marks(result, form.name), key=_coordinate), strict=True))
        beside = random.uniform(-BESIDE, BESIDE, r.shape)
        peer.wire(form.name, pieces_of(line, result, k, refine, convert), CubicSpline(s, r + beside))
    arms, joints = hold(peer, result)
    ends, ties = end(peer, result), tie(peer, result)
    droppers, weight = hang(peer, line, result)
    peer.solve()
    schedule = result.droppers
    below = zip(schedule.lower_wire, schedule.contact_coordinate, strict=True)
    above = zip(schedule.upper_wire, schedule.messenger_coordinate, strict=True)
    return Built(
        np.array([peer.place(*point) for point in below]),
        np.array([peer.place(*point) for point in above]),
        peer.force(droppers) - np.multiply.outer(weight, [0.0, 0.0, 1.0]),
        -peer.force(joints),
        -peer.force(arms),
        -peer.force(ends),
        -peer.force(ties).reshape(-1, 3),
    )


def _coordinate(mark: tuple[float, FloatArray]) -> float:
    return mark[0]


def hold(peer: Peer, result: FormResult) -> tuple[list[int], list[int]]:
    """Add arms that turn about their hinges, and supports that hold wires where they are; return both."""
    supports, hinges = result.supports, iter(zip(result.arms.hinge, result.arms.length, strict=True))
    arms: list[int] = []
    joints: list[int] = []
    places = np.column_stack((supports.x, supports.y, supports.z))
    for kind, wire, s, place in zip(
        supports.kind, supports.wire, supports.sliding_coordinate, places, strict=True
    ):
        if kind == "arm":
            hinge, length = next(hinges)
            arms.append(peer.arm(peer.ground(hinge), peer.point(wire, s, 0.5 * ARM), length))
        else:
            joints.append(peer.join(peer.ground(place), peer.point(wire, s)))
    return arms, joints


def end(peer: Peer, result: FormResult) -> list[int]:
    """Hold the ends of wires that are not tied."""
    ends: list[int] = []
    for form in result.wires:
        if form.role != "stitch wire":
            profile = form.profile
            places = np.column_stack((profile.x, profile.y, profile.z))[[0, -1]]
            for s, place in zip(profile.s[[0, -1]], places, strict=True):
                ends.append(peer.join(peer.ground(place), peer.point(form.name, s)))
    return ends


def tie(peer: Peer, result: FormResult) -> list[int]:
    """Clamp ends of wires to their hosts."""
    ties = result.ties
    return [
        peer.join(
            peer.point(host, coordinate), peer.point(wire, (0.0, result.wire(wire).profile.s[-1])[which])
        )
        for wire, which, host, coordinate in zip(ties.wire, ties.end, ties.host, ties.coordinate, strict=True)
    ]


def hang(peer: Peer, line: Line, result: FormResult) -> tuple[list[int], FloatArray]:
    """Add droppers with half of their weight and a clamp on either end; return them, and these weights."""
    schedule, conductor = result.droppers, line.conductors[line.dropper.conductor]
    mass = 0.5 * conductor.rhoA * schedule.unstressed_length + CLAMP
    droppers = [
        peer.bar(peer.point(lower, below, m), peer.point(upper, above, m), length, conductor.EA)
        for lower, below, upper, above, m, length in zip(
            schedule.lower_wire,
            schedule.contact_coordinate,
            schedule.upper_wire,
            schedule.messenger_coordinate,
            mass,
            schedule.unstressed_length,
            strict=True,
        )
    ]
    return droppers, mass * line.gravity


def found(result: FormResult) -> Built:
    """Return the same of the result."""
    droppers, supports = result.droppers, result.supports
    force = np.column_stack((supports.force_x, supports.force_y, supports.force_z))
    untied = [form.end_force for form in result.wires if form.role != "stitch wire"]
    return Built(
        droppers.position_bottom,
        droppers.position_top,
        droppers.on_contact,
        force[[kind != "arm" for kind in supports.kind]],
        result.arms.axial,
        np.concatenate(untied),
        result.ties.force,
    )


@dataclass(frozen=True)
class Tolerance:
    """What passes: of places [m], of droppers and arms, and of supports, ends and ties [N].

    Along the wires, forces are as good as lengths: the 0.02 N that are measured are 1e-7 m of a span.
    """

    place: float
    force: float
    hold: float


SAME_MESH = Tolerance(1e-6, 1e-3, 0.05)
FINER_MESH = Tolerance(0.044e-3, 0.1, 1.0)  # what the default mesh contributes to lengths; see `test_exudyn`


def check(built: Built, wanted: Built, tolerance: Tolerance) -> None:
    """Places and forces are those that were found."""
    for names, allowed in (
        (("bottom", "top"), tolerance.place),
        (("on_lower", "arm"), tolerance.force),
        (("on_support", "on_end", "on_host"), tolerance.hold),
    ):
        for name in names:
            ours, theirs = getattr(wanted, name), getattr(built, name)
            np.testing.assert_allclose(theirs, ours, rtol=0.0, atol=allowed, err_msg=name)


@pytest.fixture(scope="module", params=tuple(CASES))
def solved(request: pytest.FixtureRequest) -> tuple[Line, FormResult]:
    line = line_of(request.param)
    return line, solve(line, method="direct")


def test_a_line_built_in_exudyn_has_the_places_and_forces_that_were_found(
    solved: tuple[Line, FormResult],
) -> None:
    """Given are lengths, clamps and hinges only; arms, leaning droppers and ties find their forces."""
    line, result = solved
    assert result.droppers.inclination.max() > 0.1
    check(build(line, result), found(result), SAME_MESH)


def test_and_on_a_finer_mesh(solved: tuple[Line, FormResult]) -> None:
    line, result = solved
    check(build(line, result, refine=4), found(result), FINER_MESH)


def changed(result: FormResult, part: str, field: str, index: int | tuple[int, int], by: float) -> FormResult:
    """Return the result with one number changed."""
    table = getattr(result, part)
    values = getattr(table, field).copy()
    values[index] += by
    return replace(result, **{part: replace(table, **{field: values})})


@pytest.mark.parametrize("dropper", [0, 4, 7])
def test_a_dropper_longer_by_1_mm_is_noticed(solved: tuple[Line, FormResult], dropper: int) -> None:
    line, result = solved
    built = build(line, changed(result, "droppers", "unstressed_length", dropper, 1e-3))
    assert result.droppers.position_bottom[dropper, 2] - built.bottom[dropper, 2] > 0.3e-3
    with pytest.raises(AssertionError):
        check(built, found(result), FINER_MESH)


@pytest.mark.parametrize("axis", [1, 2], ids=["sideways", "vertically"])
def test_a_hinge_that_is_moved_by_1_mm_is_noticed(solved: tuple[Line, FormResult], axis: int) -> None:
    line, result = solved
    built = build(line, changed(result, "arms", "hinge", (1, axis), 1e-3))
    with pytest.raises(AssertionError):
        check(built, found(result), FINER_MESH)


def test_a_clamp_that_is_moved_by_10_mm_along_its_wire_is_noticed(solved: tuple[Line, FormResult]) -> None:
    """The dropper then pulls along the track, which no dropper does that was found."""
    line, result = solved
    built = build(line, changed(result, "droppers", "contact_coordinate", 2, 0.01))
    assert abs(built.on_lower[2, 0]) > 0.3
    with pytest.raises(AssertionError):
        check(built, found(result), FINER_MESH)


def test_the_strain_measure_is_noticed(solved: tuple[Line, FormResult]) -> None:
    """Unstressed lengths of Green strain in a program of engineering strain: 45 N of the messenger."""
    line, result = solved
    built = build(line, result, convert=lambda EA, tension: (np.ones_like(tension), np.ones_like(tension)))
    assert np.abs(built.on_end - found(result).on_end).max() > 40.0
    with pytest.raises(AssertionError):
        check(built, found(result), FINER_MESH)
