"""A whole line in space against elastic catenaries between its clamps, solved by SciPy's root finder.

Nothing but the line file and the track's frames is shared with the package: bays of wires are elastic
catenaries (Irvine 1981, Cable Structures, section 1.4, in space), droppers are straight bars. Unknowns are
force and unstressed length of every bay, where clamps are across the track, and the droppers' pulls.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest
from scipy.optimize import root

from catenaria.line import Line
from catenaria.line.alignment import Frames
from catenaria.results import FormResult

Change = dict[str, Any]
Make = Callable[..., Line]
Find = Callable[[Line], FormResult]

TAIL = 3.0
UP = np.array([0.0, 0.0, 1.0])


def reach(F: np.ndarray, L: np.ndarray, w: float, EA: float) -> np.ndarray:
    """Return from where to where elastic catenaries reach [m], with the force F behind their starts [N]."""
    b = F[:, 2] + w * L
    T, T_end = np.linalg.norm(F, axis=1), np.sqrt(F[:, 0] ** 2 + F[:, 1] ** 2 + b**2)
    flat = np.hypot(F[:, 0], F[:, 1])
    per_force = L / EA + (np.arcsinh(b / flat) - np.arcsinh(F[:, 2] / flat)) / w
    z = (T_end - T) / w + (b**2 - F[:, 2] ** 2) / (2.0 * EA * w)
    return np.column_stack((per_force * F[:, 0], per_force * F[:, 1], z))


@dataclass(frozen=True)
class Wire:
    """A wire: conductor, tension, and the places across the track of ends, supports and clamps."""

    EA: float
    w: float
    T: float
    b: np.ndarray
    h: np.ndarray


class Catenaries:
    """The equations of two wires with droppers between them; nodes are ends, supports and clamps in order."""

    def __init__(self, line: Line) -> None:
        at, x = np.array(line.support_x), np.array(line.dropper_x)
        self.chainage = np.sort(np.concatenate((at[[0, -1]], at, x)))
        self.clamp = np.isin(self.chainage, x)
        self.support = np.isin(self.chainage, at)
        self.support[[0, -1]] = False
        self.frame: Frames = line.alignment.frames(self.chainage)
        contact = np.array([support.stagger for support in line.supports])
        messenger = np.array([support.messenger_offset for support in line.supports])
        wires = (line.contact_wire, contact, 5.3), (line.messenger_wire, messenger, 6.7)
        self.wires = []
        for wire, b, height in wires:
            section = line.conductor(wire.conductor)
            weight = section.rhoA * line.gravity
            lateral = np.interp(self.chainage, at, b)
            h = np.full(lateral.size, height)
            self.wires.append(Wire(section.EA, weight, wire.tension.force, lateral, h))
        self.wires[0].h[self.clamp] = line.dropper_target_height
        dropper = line.conductor(line.dropper.conductor)
        self.dropper_weight = dropper.rhoA * line.gravity
        self.bays, self.clamps = self.chainage.size - 1, int(self.clamp.sum())

    def start(self) -> np.ndarray:
        """Return straight wires, the messenger half a metre lower at its clamps, and pulls of 70 N."""
        count = self.clamps
        places = np.concatenate([wire.b[self.clamp] for wire in self.wires])
        place = np.concatenate((places, self.wires[1].h[self.clamp] - 0.5, np.full(count, 70.0)))
        u = [place]
        for wire, r in zip(self.wires, self.positions(place), strict=True):
            chord = np.diff(r, axis=0)
            length = np.linalg.norm(chord, axis=1)
            u += [(wire.T * chord / length[:, None]).ravel() / 1e3, length / (1.0 + wire.T / wire.EA)]
        return np.concatenate(u)

    def positions(self, place: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return where the nodes of both wires are [m]; ends are straight on beyond the supports."""
        k, positions = self.clamps, []
        for i, wire in enumerate(self.wires):
            b, h = wire.b.copy(), wire.h.copy()
            b[self.clamp] = place[i * k : (i + 1) * k]
            if i == 1:
                h[self.clamp] = place[2 * k : 3 * k]
            r = self.frame.point(b, h)
            r[0] -= TAIL * self.frame.along[0]
            r[-1] += TAIL * self.frame.along[-1]
            positions.append(r)
        return positions[0], positions[1]

    def split(self, u: np.ndarray) -> tuple[np.ndarray, list[tuple[np.ndarray, np.ndarray]]]:
        """Return places and pulls of clamps, and forces [N] and lengths [m] of the bays of both wires."""
        n, k = self.bays, self.clamps
        parts = u[4 * k :].reshape(2, 4 * n)
        return u[: 4 * k], [(1e3 * part[: 3 * n].reshape(-1, 3), part[3 * n :]) for part in parts]

    def pulls(self, place: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the forces of droppers on both wires [N], half of their weights included."""
        lower, upper = (r[self.clamp] for r in self.positions(place))
        d, k = upper - lower, self.clamps
        length = np.linalg.norm(d, axis=1)[:, None]
        pull, half = place[3 * k :, None] * d / length, 0.5 * self.dropper_weight * length * UP
        return pull - half, -pull - half

    def __call__(self, u: np.ndarray) -> np.ndarray:
        """Return the residual: metres, and kilonewtons."""
        place, forces = self.split(u)
        f, along = [], self.frame.along
        for i, (wire, r, (F, L), on) in enumerate(
            zip(self.wires, self.positions(place), forces, self.pulls(place), strict=True)
        ):
            f.append((reach(F, L, wire.w, wire.EA) - np.diff(r, axis=0)).ravel())
            end = F + (wire.w * L)[:, None] * UP
            before, behind = np.concatenate((F[:1], end)), np.concatenate((F, end[-1:]))
            f.append((behind - before)[self.clamp].ravel() / 1e3 + on.ravel() / 1e3)
            if i == 0:  # arms take nothing along the track
                kept = np.einsum("ni,ni->n", behind - before, along)
            else:  # rollers let the tension pass
                kept = np.linalg.norm(behind, axis=1) - np.linalg.norm(before, axis=1)
            f += [kept[self.support] / 1e3, [(np.linalg.norm(end[-1]) - wire.T) / 1e3]]
        return np.concatenate(f)

    def held(self, u: np.ndarray, wire: int) -> np.ndarray:
        """Return the forces of a wire on its supports [N], shape (n, 3)."""
        F, L = self.split(u)[1][wire]
        end = F + (self.wires[wire].w * L)[:, None] * UP
        return (F[1:] - end[:-1])[self.support[1:-1]]


SPACE: Change = {
    "spans.1.length": 50.0,
    "spans.1.droppers.positions": [4.0, 13.0, 25.0, 37.0, 46.0],
    "spans.*.pre_sag": 0.02,
    "track": {
        "curves": [{"start": -30.0, "length": 500.0, "radius": 700.0, "transition": 80.0, "cant": 0.1}]
    },
    "solver.mesh.refine": 4,
} | {
    f"supports.{i}.{field}": b
    for field, staggers in (("stagger", (-0.3, 0.1, -0.25)), ("messenger_stagger", (-0.1, 0.0, -0.4)))
    for i, b in enumerate(staggers)
}


@pytest.fixture(scope="module")
def line(make: Make, arm: Change) -> Callable[..., Line]:
    """Return the line with a given bending stiffness of its wires."""

    def stiff(EJ: float, change: Change) -> Line:
        arms = {"supports.*.contact_wire": arm, "supports.*.contact_wire.arm.side": "left"}
        bending = {f"conductors.{wire}.bending_stiffness": EJ for wire in ("contact", "messenger")}
        return make(2, change, SPACE, arms, bending)

    return stiff


def observed(result: FormResult) -> dict[str, np.ndarray]:
    """Return lengths and lateral places [m] and forces [N] of droppers, and forces at supports [N]."""
    droppers, table = result.droppers, result.supports
    force = np.column_stack((table.force_x, table.force_y, table.force_z))
    own = np.array(table.wire) == "contact wire"
    return {
        "length": droppers.length,
        "lateral": np.concatenate((droppers.stagger_bottom, droppers.stagger_top)),
        "dropper": droppers.on_contact,
        "arm": force[own],
        "roller": force[~own],
    }


@pytest.fixture(scope="module")
def found(line: Callable[..., Line], find: Find, strings: Change) -> dict[str, np.ndarray]:
    """Return the form in the limit of no bending stiffness.

    Bending changes everything in proportion to its length (EJ/T)^(1/2), which is halved once.
    """
    half, whole = (observed(find(line(EJ, strings))) for EJ in (1e-3, 4e-3))
    return {name: 2.0 * half[name] - whole[name] for name in half}


def solve(line: Line) -> dict[str, np.ndarray]:
    """Return the same of catenaries."""
    task = Catenaries(line)
    solution = root(task, task.start(), tol=1e-13)
    assert np.abs(solution.fun).max() < 1e-9
    place = task.split(solution.x)[0]
    lower, upper = (r[task.clamp] for r in task.positions(place))
    return {
        "length": np.linalg.norm(upper - lower, axis=1),
        "lateral": place[: 2 * task.clamps],
        "dropper": task.pulls(place)[0],
        "arm": task.held(solution.x, 0),
        "roller": task.held(solution.x, 1),
    }


def check(found: dict[str, np.ndarray], catenaries: dict[str, np.ndarray]) -> None:
    """Micrometres, and 0.05 N, which is what the mesh leaves of the balance over rollers."""
    for name, value in catenaries.items():
        tolerance = 5e-6 if name in ("length", "lateral") else 0.05
        np.testing.assert_allclose(found[name], value, rtol=0.0, atol=tolerance, err_msg=name)


def test_a_line_in_space_is_made_of_catenaries(
    line: Callable[..., Line], found: dict[str, np.ndarray]
) -> None:
    catenaries = solve(line(0.0, {}))
    assert np.abs(catenaries["dropper"][:, :2]).max() > 5.0
    check(found, catenaries)


@pytest.mark.parametrize(
    "change",
    [
        {"messenger_wire.tension.force": 12.001e3},
        {"supports.1.messenger_stagger": 0.001},
        {"track.rail_spacing": 1.502},
        {"gravity": 9.8075},
    ],
)
def test_small_changes_are_noticed(
    line: Callable[..., Line], found: dict[str, np.ndarray], change: Change
) -> None:
    data = line(0.0, {}).model_dump()
    for path, value in change.items():
        place: Any = data
        *way, last = path.split(".")
        for key in way:
            place = place[int(key) if key.isdigit() else key]
        place[last] = value
    with pytest.raises(AssertionError):
        check(found, solve(Line.model_validate(data)))
