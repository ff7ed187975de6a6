"""Catenary equations in space: bays of both wires and droppers are elastic catenaries, found together."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from catenaria.catenary.green_bar import stretch
from catenaria.errors import InfeasibleError, NotConvergedError
from catenaria.formfinding.strings.at_rest import LineAtRest
from catenaria.formfinding.strings.axial_law import tangent_law
from catenaria.formfinding.strings.bays import Bays, with_tails
from catenaria.formfinding.strings.method import Solved
from catenaria.formfinding.strings.named import named
from catenaria.formfinding.strings.sparse import Entries, factorised, matrix
from catenaria.formfinding.strings.task import Joints, StringLine, StringWire

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

NEGLECTS = "bending; the axial law is linear about the expected force, which costs less than 0.1 um"

_ENOUGH = 1e-11  # Newton's last correction in metres, and of forces in parts of the tension
_MOST = 50


def find_rest(task: StringLine) -> Solved:
    r"""Find both strings at rest.

    Parameters
    ----------
    task : StringLine
        What was asked for.

    Notes
    -----
    Unknowns are, for every bay and every dropper, the force (F1, F2, F3) behind its start and its unstressed
    length, and the coordinates of joints that are not prescribed: y of all clamps, z of those on the
    messenger. Equations: every element reaches from joint to joint, forces are in balance at every clamp,
    the tension passes supports and is prescribed at one end of each wire. Newton's method, one sparse matrix.

    References
    ----------
    Such et al., [22] of Yang et al. 2017, in our reconstruction: the original was not available.
    """
    equations = _Equations.of(task)
    u = equations.start()
    for count in range(1, _MOST):
        f, entries = equations.evaluate(u)
        try:
            step = factorised(matrix(entries, (u.size, u.size)))(f)
        except RuntimeError:  # a singular matrix
            break
        u = u - step
        if np.max(np.abs(step) / equations.scale) < _ENOUGH:
            return Solved(equations.at_rest(u), count, u.size)
        equations.refuse_compression(u)
    raise NotConvergedError("Newton's method did not find the line at rest", "more tension would help")


class Reach(NamedTuple):
    """Reaches of elastic catenaries, shape (n, 3), and their derivatives by F1, F2, F3 and L, (n, 3, 4)."""

    r: FloatArray
    by: FloatArray


def spatial_catenary(
    F: FloatArray, L: FloatArray, w: FloatArray, law: tuple[FloatArray, FloatArray]
) -> Reach:
    r"""Return how far elastic catenaries reach in space.

    Parameters
    ----------
    F : FloatArray, shape (n, 3)
        Force behind the start, of what follows on what comes before [N].
    L, w : FloatArray, shape (n,)
        Unstressed lengths [m] and weights per unstressed length [N/m].
    law : tuple of FloatArray, shape (n,)
        c and E of the stretch c + T/E.

    Notes
    -----
    With F3 growing to F3 + w L and T = \|F\| at both ends,

    .. math:: \Delta x=F_1\Big(\frac cw\Lambda+\frac LE\Big),\quad
              \Delta y=F_2\Big(\frac cw\Lambda+\frac LE\Big),\quad
              \Delta z=\frac cw(T_j-T_i)+\frac{L(F_{3i}+F_{3j})}{2E},\quad
              \Lambda=\ln\frac{T_j+F_{3j}}{T_i+F_{3i}},

    which has no singularity for vertical elements under tension.

    Examples
    --------
    A dropper of 1 m, 0.87 N/m, that carries 80 N is 80.4 N/EA longer:

    >>> one = np.ones(1)
    >>> reach = spatial_catenary(np.array([[0.0, 0.0, 80.0]]), one, 0.87 * one, (one, 1.19e6 * one))
    >>> round(1e6 * float(reach.r[0, 2] - 1.0), 3)
    67.592
    """
    (c, E), F_j = law, F.copy()
    F_j[:, 2] += w * L
    T_i, T_j = np.linalg.norm(F, axis=1), np.linalg.norm(F_j, axis=1)
    a, b = F[:, 2], F_j[:, 2]
    flexibility = c / w * np.log((T_j + b) / (T_i + a)) + L / E
    r = flexibility[:, None] * F
    r[:, 2] = c * L * (a + b) / (T_i + T_j) + 0.5 * L * (a + b) / E
    by = np.zeros((L.size, 3, 4))
    inverse = 1.0 / T_j - 1.0 / T_i
    outward = 1.0 / (T_j * (T_j + b)) - 1.0 / (T_i * (T_i + a))
    for i in range(2):
        by[:, i, i] = flexibility
        for k in range(2):
            by[:, i, k] += F[:, i] * F[:, k] * c / w * outward
        by[:, i, 2] = by[:, 2, i] = F[:, i] * c / w * inverse
        by[:, i, 3] = F[:, i] * (c / T_j + 1.0 / E)
    by[:, 2, 2] = c / w * (b / T_j - a / T_i) + L / E
    by[:, 2, 3] = b * (c / T_j + 1.0 / E)
    return Reach(r, by)


class _Part(NamedTuple):
    """A wire: its joints, and where its bays begin among the elements."""

    wire: StringWire
    joints: Joints
    first: int


@dataclass(frozen=True)
class _Equations:
    """Residual and matrix of the whole line.

    Nodes are the joints of the contact wire, then those of the messenger; elements the bays of both, then the
    droppers. Unknowns are F of all elements, L of all elements, then coordinates; `unknown` is the number of
    each coordinate of each node, -1 where it is given in `place`.
    """

    task: StringLine
    parts: tuple[_Part, _Part]
    node: IntArray
    place: FloatArray
    unknown: IntArray
    w: FloatArray
    law: tuple[FloatArray, FloatArray]
    scale: FloatArray

    @classmethod
    def of(cls, task: StringLine) -> _Equations:
        """Number everything."""
        contact, messenger = (wire.joints(task.x) for wire in (task.contact, task.messenger))
        n, m, k = contact.x.size, messenger.x.size, task.x.size
        parts = _Part(task.contact, contact, 0), _Part(task.messenger, messenger, n - 1)
        start = np.concatenate((np.arange(n - 1), np.arange(n, n + m - 1)))
        foot, top = contact.clamp, n + messenger.clamp
        node = np.column_stack((np.append(start, foot), np.append(start + 1, top))).astype(np.int64)
        place, unknown = np.zeros((n + m, 3)), np.full((n + m, 3), -1, dtype=np.int64)
        place[:, 0] = np.concatenate((contact.x, messenger.x))
        place[contact.support, 2], place[foot, 2] = task.contact.support_z, task.height
        place[n:, 2] = _hung(task, messenger.x)
        elements = node.shape[0]
        unknown[foot, 1] = 4 * elements + np.arange(k)
        unknown[top, 1] = 4 * elements + np.arange(k, 2 * k)
        unknown[top, 2] = 4 * elements + np.arange(2 * k, 3 * k)
        laws = [tangent_law(wire.tension, wire.EA) for wire in (task.contact, task.messenger)]
        own = [tangent_law(force, task.EA) for force in _bay_weights(parts[0]).tolist()]
        c, E = np.array([laws[0]] * (n - 1) + [laws[1]] * (m - 1) + own).T.copy()
        w = np.repeat([task.contact.w, task.messenger.w, task.w], (n - 1, m - 1, k))
        scale = np.ones(4 * elements + 3 * k)
        scale[: 3 * elements] = max(task.contact.tension, task.messenger.tension)
        return cls(task, parts, node, place, unknown, w, (c, E), scale)

    def start(self) -> FloatArray:
        """Return wires under their tension without vertical forces, and droppers with the weight of bays."""
        u = np.zeros(self.scale.size)
        elements = self.node.shape[0]
        F, L = u[: 3 * elements].reshape(-1, 3), u[3 * elements : 4 * elements]
        length = np.diff(self.place[self.node], axis=1)[:, 0]
        L[:] = np.abs(length[:, 2])
        for part in self.parts:
            h = np.diff(part.joints.x)
            bays = slice(part.first, part.first + h.size)
            F[bays, 0], L[bays] = part.wire.tension, h / float(stretch(part.wire.tension, part.wire.EA))
        F[-self.task.x.size :, 2] = _bay_weights(self.parts[0])
        free = self.unknown >= 0
        u[self.unknown[free]] = self.place[free]
        return u

    def _split(self, u: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return F, L and the positions of all nodes."""
        elements, r, free = self.node.shape[0], self.place.copy(), self.unknown >= 0
        r[free] = u[self.unknown[free]]
        return u[: 3 * elements].reshape(-1, 3), u[3 * elements : 4 * elements], r

    def refuse_compression(self, u: FloatArray) -> None:
        """Refuse droppers that would have to push."""
        pushed = self._split(u)[0][-self.task.x.size :, 2] <= 0.0
        if np.any(pushed):
            names = named(self.task.span, pushed)
            raise InfeasibleError(f"droppers would be in compression: {names}; a smaller pre-sag would help")

    def evaluate(self, u: FloatArray) -> tuple[FloatArray, Entries]:
        """Return the residual and the entries of the matrix."""
        F, L, r = self._split(u)
        reach = spatial_catenary(F, L, self.w, self.law)
        elements = np.arange(L.size, dtype=np.int64)
        f, entries = np.zeros(u.size), Entries()
        gap = reach.r - np.diff(r[self.node], axis=1)[:, 0]
        f[: 3 * L.size] = gap.ravel()
        for i in range(3):
            row = 3 * elements + i
            entries += [(row, 3 * elements + k, reach.by[:, i, k]) for k in range(3)]
            entries.append((row, 3 * L.size + elements, reach.by[:, i, 3]))
            for end, sign in ((0, 1.0), (1, -1.0)):
                column = self.unknown[self.node[:, end], i]
                free = column >= 0
                entries.append((row[free], column[free], np.full(int(np.sum(free)), sign)))
        row = self._balance(F, L, f, entries)
        for part in self.parts:
            row = self._tension(part, F, L, row, f, entries)
        return f, entries

    def _balance(self, F: FloatArray, L: FloatArray, f: FloatArray, entries: Entries) -> int:
        """Add the balance of forces at all clamps; return the number of the next row."""
        n, k = L.size, self.task.x.size
        dropper = np.arange(n - k, n, dtype=np.int64)
        row = 3 * n
        for part, load, at_top in zip(
            self.parts, (self.task.bottom, self.task.top), (False, True), strict=True
        ):
            behind = part.first + part.joints.clamp
            rows = row + 3 * np.arange(k, dtype=np.int64)
            sides = (behind, 1.0, False), (behind - 1, -1.0, True), (dropper, -1.0 if at_top else 1.0, at_top)
            f[rows + 2] = -load
            for element, sign, end in sides:
                for i in range(3):
                    f[rows + i] += sign * F[element, i]
                    entries.append((rows + i, 3 * element + i, np.full(k, sign)))
                if end:
                    f[rows + 2] += sign * self.w[element] * L[element]
                    entries.append((rows + 2, 3 * n + element, sign * self.w[element]))
            row += 3 * k
        return row

    def _tension(
        self, part: _Part, F: FloatArray, L: FloatArray, row: int, f: FloatArray, entries: Entries
    ) -> int:
        """Add that the tension is given at one end of a wire and the same on both sides of its supports."""
        wire, n = part.wire, L.size
        support = part.first + part.joints.support
        rows = row + np.arange(support.size - 1, dtype=np.int64)
        behind, before = support[:-1], support[1:] - 1
        given = before[-1:] if wire.at_end else behind[:1]
        sides: list[tuple[IntArray, IntArray, bool, float]] = [
            (rows[:1], given, wire.at_end, 1.0),
            (rows[1:], behind[1:], False, 1.0),
            (rows[1:], before[:-1], True, -1.0),
        ]
        f[rows[0]] = -wire.tension
        for place, element, end, sign in sides:
            force = F[element].copy()
            if end:
                force[:, 2] += wire.w * L[element]
            size = np.linalg.norm(force, axis=1)
            f[place] += sign * size
            entries += [(place, 3 * element + i, sign * force[:, i] / size) for i in range(3)]
            if end:
                entries.append((place, 3 * n + element, sign * wire.w * force[:, 2] / size))
        return row + support.size - 1

    def at_rest(self, u: FloatArray) -> LineAtRest:
        """Return the strings."""
        F, L, r = self._split(u)
        strings: list[Bays] = []
        for part in self.parts:
            n = part.joints.x.size
            bays = slice(part.first, part.first + n - 1)
            first = 0 if part.first == 0 else self.parts[0].joints.x.size
            strings.append(Bays(r[first : first + n, 2], F[bays, 0], F[bays, 2], L[bays]))
        contact, messenger = (
            with_tails(part.wire, part.joints, bays) for part, bays in zip(self.parts, strings, strict=True)
        )
        return LineAtRest(contact, messenger, L[-self.task.x.size :])


def _bay_weights(contact: _Part) -> FloatArray:
    """Return what droppers of a level contact wire carry: half the weight of both bays beside them [N]."""
    h, clamp = np.diff(contact.joints.x), contact.joints.clamp
    return 0.5 * contact.wire.w * (h[clamp - 1] + h[clamp])


def _hung(task: StringLine, x: FloatArray) -> FloatArray:
    """Return the messenger as a parabola under the weight of both wires."""
    at, wire = task.messenger.support_x, task.messenger
    span = np.clip(np.searchsorted(at, x), 1, at.size - 1)
    sag = (wire.w + task.contact.w) * (x - at[span - 1]) * (at[span] - x) / (2.0 * wire.tension)
    return np.interp(x, at, wire.support_z) - sag
