"""The adaptive force density method: densities are corrected by forces and heights until both are met."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import solveh_banded  # pyright: ignore[reportUnknownVariableType]

from catenaria.errors import InfeasibleError, NotConvergedError
from catenaria.formfinding.strings.at_rest import LineAtRest
from catenaria.formfinding.strings.bays import with_tails
from catenaria.formfinding.strings.method import Solved
from catenaria.formfinding.strings.named import named
from catenaria.formfinding.strings.net import Division, Part
from catenaria.formfinding.strings.task import StringLine

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

NEGLECTS = "bending; weight is lumped at nodes at most 2.4 m apart; converges slowly"

_LARGEST = 2.4  # m, of an element
_ENOUGH = 2e-8  # m by which heights may miss their targets
_SETTLED = 1e-9  # part of the tension by which it may do so
_SLACK = 1e-3  # part of the mean force below which a dropper counts as slack: densities stay positive
_MOST = 20000


def find_rest(task: StringLine) -> Solved:
    r"""Find both strings at rest.

    Parameters
    ----------
    task : StringLine
        What was asked for.

    Notes
    -----
    Both wires and the droppers are one network with prescribed places along the track. Each pass solves the
    linear system :math:`C^TQC\,z=-p` and corrects densities by what is wrong: those of wires by :math:`T^*/T`
    at the end of a span where the tension is known, those of droppers to the force of the pass before over
    the length to the wanted height,

    .. math:: q \leftarrow q\,\frac{z_m-z}{z_m-z^*}.

    No derivative is ever formed, so that convergence is linear. With densities q the contact wire has the
    stiffness K + q against heights, of which the correction uses q: smooth errors go quickly, an error that
    changes its sign from dropper to dropper shrinks by 1 - q/(4 T/h) a pass.

    References
    ----------
    The family of the adaptive force density method, [20] of Yang et al. 2017, in our reconstruction: the
    original was not available.
    """
    net = _Network.of(task)
    z, along, force = net.start()
    worst = np.inf
    for count in range(1, _MOST):
        length = z[net.top] - task.height
        _refuse(task, length <= 0.0, "stand upside down", "more tension of the messenger wire")
        _refuse(task, force < _SLACK * np.mean(force), "be slack or in compression", "a smaller pre-sag")
        z, L, unstressed = net.heights(z, along, force / length)
        factor, off = net.tension(z, along, L)
        worst = float(np.max(np.abs(task.height - z[net.foot])))
        if worst < _ENOUGH and off < _SETTLED:
            return Solved(net.at_rest(z, along, L, unstressed), count, z.size)
        force *= (z[net.top] - z[net.foot]) / length
        along = along * factor
    raise NotConvergedError(
        f"heights are still {1e3 * worst:.3g} mm off after {_MOST} passes",
        "--method 'extended force density'",
    )


def _refuse(task: StringLine, wrong: NDArray[np.bool_], what: str, advice: str) -> None:
    """Refuse droppers that no positive density can hold."""
    if np.any(wrong):
        names = named(task.span, wrong)
        raise InfeasibleError(f"droppers would {what}: {names}; {advice} would help")


class _Network(NamedTuple):
    """Both wires and the droppers; free nodes in order along the track, so that the matrix is banded.

    `place` is the number of each node in that order, -1 if it is held.
    """

    task: StringLine
    parts: tuple[Part, Part]
    edge: IntArray
    foot: IntArray
    top: IntArray
    place: IntArray

    @classmethod
    def of(cls, task: StringLine) -> _Network:
        """Divide the wires and number everything."""
        line = Division.of(task, _LARGEST)
        edges = np.column_stack((np.append(line.start, line.foot), np.append(line.start + 1, line.top)))
        order = np.argsort(np.concatenate([part.net.x for part in line.parts]), kind="stable")
        free = order[~np.isin(order, line.held)]
        place = np.full(line.node_count, -1, dtype=np.int64)
        place[free] = np.arange(free.size, dtype=np.int64)
        return cls(task, line.parts, edges, line.foot, line.top, place)

    def start(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return heights of nodes, forces along the track in branches, and forces of droppers.

        The messenger is a parabola under the weight of both wires.
        """
        contact, messenger = self.parts
        at, tension = messenger.wire.support_x, messenger.wire.tension
        span = np.clip(np.searchsorted(at, messenger.net.x), 1, at.size - 1)
        sag = (messenger.net.x - at[span - 1]) * (at[span] - messenger.net.x) / (2.0 * tension)
        hung = np.interp(messenger.net.x, at, messenger.wire.support_z)
        level = np.interp(contact.net.x, contact.wire.support_x, contact.wire.support_z)
        z = np.concatenate((level, hung - (messenger.wire.w + contact.wire.w) * sag))
        H = np.concatenate([np.full(part.net.dx.size, part.wire.tension) for part in self.parts])
        h, clamp = np.diff(contact.joints.x), contact.joints.clamp
        return z, H, 0.5 * contact.wire.w * (h[clamp - 1] + h[clamp])

    def heights(
        self, z: FloatArray, H: FloatArray, density: FloatArray
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return heights for given densities, and unstressed lengths of wires' branches and of droppers."""
        task, load, lengths = self.task, np.zeros_like(z), list[FloatArray]()
        for part in self.parts:
            L = part.net.unstressed(part.wire, z[part.nodes], H[part.edges])
            load[part.nodes][:-1] += 0.5 * part.wire.w * L
            load[part.nodes][1:] += 0.5 * part.wire.w * L
            lengths.append(L)
        length = z[self.top] - z[self.foot]
        unstressed = task.unstressed(length, density * length - task.bottom - 0.5 * task.w * length)
        load[self.foot] += 0.5 * task.w * unstressed + task.bottom
        load[self.top] += 0.5 * task.w * unstressed + task.top
        dx = np.concatenate([part.net.dx for part in self.parts])
        return self._solve(np.append(H / dx, density), load, z), np.concatenate(lengths), unstressed

    def _solve(self, q: FloatArray, load: FloatArray, z: FloatArray) -> FloatArray:
        """Return the heights of free nodes that balance the loads, with those of held nodes kept."""
        i, j = self.place[self.edge].T
        free = self.place >= 0
        right = np.zeros(int(np.max(self.place)) + 1)
        right[self.place[free]] = -load[free]
        inside, width = (i >= 0) & (j >= 0), int(np.max(np.abs(i - j)[(i >= 0) & (j >= 0)]))
        D = np.zeros((width + 1, right.size))
        D[np.abs(i - j)[inside], np.minimum(i, j)[inside]] = -q[inside]
        for own, other, far in ((i, j, self.edge[:, 1]), (j, i, self.edge[:, 0])):
            np.add.at(D[0], own[own >= 0], q[own >= 0])
            edge = (own >= 0) & (other < 0)
            np.add.at(right, own[edge], q[edge] * z[far[edge]])
        new = z.copy()
        solution = np.asarray(solveh_banded(D, right, lower=True, check_finite=False), dtype=np.float64)
        new[free] = solution[self.place[free]]
        return new

    def tension(self, z: FloatArray, H: FloatArray, L: FloatArray) -> tuple[FloatArray, float]:
        """Return T*/T of every branch, and by which part the worst tension is off."""
        factor = np.empty_like(H)
        for part in self.parts:
            wire, support = part.wire, part.net.joint[part.joints.support]
            along = H[part.edges]
            up, half = along * np.diff(z[part.nodes]) / part.net.dx, 0.5 * wire.w * L[part.edges]
            spans = list(zip(support[:-1].tolist(), support[1:].tolist(), strict=True))
            wanted = wire.tension
            for first, last in reversed(spans) if wire.at_end else spans:
                sides = (
                    np.hypot(along[first], up[first] - half[first]),
                    np.hypot(along[last - 1], up[last - 1] + half[last - 1]),
                )
                near, far = sides[::-1] if wire.at_end else sides
                factor[part.edges][first:last] = wanted / near
                wanted *= float(far / near)
        return factor, float(np.max(np.abs(factor - 1.0)))

    def at_rest(self, z: FloatArray, H: FloatArray, L: FloatArray, unstressed: FloatArray) -> LineAtRest:
        """Return the strings that the network amounts to."""
        contact, messenger = (
            with_tails(
                part.wire,
                part.joints,
                part.net.bays(part.wire, z[part.nodes], H[part.edges], L[part.edges]),
            )
            for part in self.parts
        )
        return LineAtRest(contact, messenger, unstressed)
