"""The force density method with constraints, which finds the densities of wires and droppers as well."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from catenaria.errors import InfeasibleError, NotConvergedError
from catenaria.formfinding.strings.at_rest import LineAtRest
from catenaria.formfinding.strings.bays import with_tails
from catenaria.formfinding.strings.method import Solved
from catenaria.formfinding.strings.named import named
from catenaria.formfinding.strings.net import Division, Part
from catenaria.formfinding.strings.sparse import Entries, Matrix, blocks, diagonal, factorised, matrix
from catenaria.formfinding.strings.task import StringLine

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

NEGLECTS = "bending; weight is lumped at nodes at most 2.4 m apart, their sag added afterwards"

_LARGEST = 2.4  # m, of an element
_ENOUGH = 1e-10  # m by which coordinates may still change
_MOST = 60


def find_rest(task: StringLine) -> Solved:
    r"""Find both strings at rest.

    Parameters
    ----------
    task : StringLine
        What was asked for.

    Notes
    -----
    Both wires and the droppers are one network with unknown force densities q; all nodes but supports are
    free in the plane. Its coordinates x(q), z(q) follow from :math:`C^TQC\,x=p` [18], and Newton's method
    finds the densities with which constraints g(q, x, z) = 0 hold:

    .. math:: D\,dx + C^TU\,dq = 0,\quad D\,dz + C^TW\,dq = 0,\quad g_x\,dx + g_z\,dz + g_q\,dq = -g,

    with the coordinate differences U and W of branches. There are as many constraints as branches: every node
    stays at its place along the track, the contact wire has its height at droppers, the tension has its value
    at one end and passes supports. The least-squares step of the method is Newton's then.

    References
    ----------
    Schek 1974. The extension to catenaries, [19] of Yang et al. 2017, is our reconstruction: the
    original was not available.
    """
    network = _Network.of(task)
    state = network.start()
    for count in range(1, _MOST):
        try:
            load, L = network.loads(state)
        except InfeasibleError:  # not the line, but forces that a step beyond all bounds led to
            break
        new = network.step(state, load)
        change = max(float(np.max(np.abs(new.x - state.x))), float(np.max(np.abs(new.z - state.z))))
        state = new
        network.refuse_upside_down(state)
        if change < _ENOUGH:
            return Solved(network.at_rest(state, L), count, network.edge.shape[0])
        if not np.isfinite(change):
            break
    raise NotConvergedError(
        "the force densities that meet all targets were not found", "--method 'catenary equations'"
    )


class _State(NamedTuple):
    """Force densities of all branches, coordinates of all nodes."""

    q: FloatArray
    x: FloatArray
    z: FloatArray


@dataclass(frozen=True)
class _Network:
    """Both wires and the droppers between them; branches of the wires first."""

    task: StringLine
    parts: tuple[Part, Part]
    edge: IntArray
    free: IntArray
    place: FloatArray

    @classmethod
    def of(cls, task: StringLine) -> _Network:
        """Divide the wires and number everything."""
        line = Division.of(task, _LARGEST)
        edge = np.column_stack((np.append(line.start, line.foot), np.append(line.start + 1, line.top)))
        free = np.setdiff1d(np.arange(line.node_count, dtype=np.int64), line.held)
        place = np.concatenate([part.net.x for part in line.parts])
        return cls(task, line.parts, edge, free, place)

    @property
    def droppers(self) -> slice:
        """The branches that are droppers."""
        return slice(self.parts[1].edges.stop, None)

    def start(self) -> _State:
        """Return a contact wire through its targets, a messenger bent by the weight of both, and densities.

        A dropper carries what is beside it less what the tension lifts by the kink of the contact wire.
        """
        contact, messenger = self.parts
        joints, clamp = contact.joints, contact.joints.clamp
        target = np.empty_like(joints.x)
        target[joints.support], target[clamp] = contact.wire.support_z, self.task.height
        wanted = np.interp(contact.net.x, joints.x, target)
        at, T = messenger.wire.support_x, messenger.wire.tension
        span = np.clip(np.searchsorted(at, messenger.net.x), 1, at.size - 1)
        sag = (messenger.net.x - at[span - 1]) * (at[span] - messenger.net.x) / (2.0 * T)
        hung = np.interp(messenger.net.x, at, messenger.wire.support_z)
        hung -= (messenger.wire.w + contact.wire.w) * sag
        z = np.concatenate((wanted, hung))
        bays = np.diff(joints.x)
        slope = np.diff(target) / bays
        carried = 0.5 * contact.wire.w * (bays[clamp - 1] + bays[clamp])
        force = carried - contact.wire.tension * (slope[clamp] - slope[clamp - 1])
        length = np.diff(z[self.edge[self.droppers]], axis=1)[:, 0]
        tight = [np.full(part.net.dx.size, part.wire.tension) / part.net.dx for part in self.parts]
        q = np.concatenate((*tight, force / np.maximum(length, 0.1 * np.max(np.abs(length)))))
        return _State(q, self.place, z)

    def refuse_upside_down(self, state: _State) -> None:
        """Refuse droppers without length, whose force density has no limit."""
        short = np.diff(state.z[self.edge[self.droppers]], axis=1)[:, 0] <= 0.0
        if np.any(short):
            names = named(self.task.span, short)
            raise InfeasibleError(f"droppers would stand upside down: {names}; more tension would help")

    def loads(self, state: _State) -> tuple[FloatArray, tuple[FloatArray, FloatArray]]:
        """Return the loads on all nodes, downwards, and the unstressed lengths of both wires' branches."""
        load = np.zeros_like(state.z)
        lengths: list[FloatArray] = []
        for part in self.parts:
            q, net = state.q[part.edges], part.net
            L = net.unstressed(part.wire, state.z[part.nodes], q * net.dx)
            load[part.nodes][:-1] += 0.5 * part.wire.w * L
            load[part.nodes][1:] += 0.5 * part.wire.w * L
            lengths.append(L)
        foot, top = self.edge[self.droppers].T
        half = 0.5 * self.task.w * self._unstressed(state)
        load[foot] += half + self.task.bottom
        load[top] += half + self.task.top
        return load, (lengths[0], lengths[1])

    def _unstressed(self, state: _State) -> FloatArray:
        """Return the unstressed lengths of droppers."""
        foot, top = self.edge[self.droppers].T
        length = state.z[top] - state.z[foot]
        task, unstressed = self.task, length
        for _ in range(2):  # the force is that at half height
            force = state.q[self.droppers] * length - task.bottom - 0.5 * task.w * unstressed
            unstressed = task.unstressed(length, force)
        return unstressed

    def step(self, state: _State, load: FloatArray) -> _State:
        """Return coordinates for the densities, and one Newton step of all."""
        C, n = self._branch_node(state.x.size), self.free.size
        free_C = C[:, self.free]
        D = free_C.T @ diagonal(state.q) @ C
        inner = D[:, self.free]
        solve = factorised(inner)
        x, z = self.place.copy(), state.z.copy()
        x[self.free] = z[self.free] = 0.0
        x[self.free], z[self.free] = solve(-(D @ x)), solve(-load[self.free] - D @ z)
        g, g_x, g_z, g_q = self._constraints(state.q, x, z)
        whole = blocks(
            [
                [inner, None, free_C.T @ diagonal(C @ x)],
                [None, inner, free_C.T @ diagonal(C @ z)],
                [g_x[:, self.free], g_z[:, self.free], g_q],
            ]
        )
        step = factorised(whole)(np.concatenate((np.zeros(2 * n), -g)))
        x[self.free] += step[:n]
        z[self.free] += step[n : 2 * n]
        return _State(state.q + step[2 * n :], x, z)

    def _branch_node(self, nodes: int) -> Matrix:
        """Return the branch-node matrix C, with which C x are differences along branches."""
        branch = np.arange(self.edge.shape[0], dtype=np.int64)
        one = np.ones(branch.size)
        start, end = self.edge.T
        return matrix([(branch, start, -one), (branch, end, one)], (branch.size, nodes))

    def _constraints(
        self, q: FloatArray, x: FloatArray, z: FloatArray
    ) -> tuple[FloatArray, Matrix, Matrix, Matrix]:
        """Return the constraints and their derivatives by coordinates of nodes and by densities."""
        contact = self.parts[0]
        feet = contact.nodes.start + contact.net.joint[contact.joints.clamp]
        row, k = self.free.size, feet.size
        g = [x[self.free] - self.place[self.free], z[feet] - self.task.height]
        by_x: Entries = [(np.arange(row, dtype=np.int64), self.free, np.ones(row))]
        by_z: Entries = [(np.arange(row, row + k, dtype=np.int64), feet, np.ones(k))]
        by_q: Entries = []
        row += k
        for part in self.parts:
            tension = self._tensions(part, q, x, z)
            rows, edge, (slope_x, slope_z, slope_q) = tension.row + row, tension.edge, tension.by
            g.append(tension.g)
            start, end = self.edge[edge].T
            by_x += [(rows, end, slope_x * q[edge]), (rows, start, -slope_x * q[edge])]
            by_z += [(rows, end, slope_z * q[edge]), (rows, start, -slope_z * q[edge])]
            by_q.append((rows, edge, slope_q))
            row += tension.g.size
        nodes, branches = (row, x.size), (row, q.size)
        return np.concatenate(g), matrix(by_x, nodes), matrix(by_z, nodes), matrix(by_q, branches)

    def _tensions(self, part: Part, q: FloatArray, x: FloatArray, z: FloatArray) -> _Tensions:
        """Return the tension at the prescribed end and its jumps at inner supports, over the wanted one."""
        wire, net = part.wire, part.net
        support = net.joint[part.joints.support]
        behind = part.edges.start + support[:-1]
        before = part.edges.start + support[1:] - 1
        end, m = (before[-1:], support.size - 1) if wire.at_end else (behind[:1], support.size - 1)
        inner = np.arange(1, m)
        edge = np.concatenate((end, behind[1:], before[:-1]))
        row = np.concatenate(([0], inner, inner))
        sign = np.concatenate(([1.0], np.ones(m - 1), -np.ones(m - 1)))
        L = net.unstressed(wire, z[part.nodes], q[part.edges] * net.dx)
        half = 0.5 * wire.w * L[edge - part.edges.start]
        side = np.concatenate(([1.0 if wire.at_end else -1.0], -np.ones(m - 1), np.ones(m - 1)))
        dx, dz = (np.diff(coordinate[self.edge[edge]], axis=1)[:, 0] for coordinate in (x, z))
        along, up = q[edge] * dx, q[edge] * dz + side * half
        size = np.hypot(along, up)
        g = np.zeros(m)
        np.add.at(g, row, sign * size / wire.tension)
        g[0] -= 1.0
        by_x, by_z = sign * along / size / wire.tension, sign * up / size / wire.tension
        return _Tensions(g, row, edge, (by_x, by_z, by_x * dx + by_z * dz))

    def at_rest(self, state: _State, L: tuple[FloatArray, FloatArray]) -> LineAtRest:
        """Return the strings that the network amounts to."""
        strings = [
            with_tails(
                part.wire,
                part.joints,
                part.net.bays(part.wire, state.z[part.nodes], state.q[part.edges] * part.net.dx, length),
            )
            for part, length in zip(self.parts, L, strict=True)
        ]
        return LineAtRest(strings[0], strings[1], self._unstressed(state))


class _Tensions(NamedTuple):
    """Constraints on tensions: values, and rows, branches and derivatives of what enters them."""

    g: FloatArray
    row: IntArray
    edge: IntArray
    by: tuple[FloatArray, FloatArray, FloatArray]
