"""The negative sag method: a line is built higher by what it will sag, and sags to where it is wanted."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from catenaria.errors import InfeasibleError, NotConvergedError
from catenaria.formfinding.strings.at_rest import LineAtRest
from catenaria.formfinding.strings.bays import with_tails
from catenaria.formfinding.strings.method import Solved
from catenaria.formfinding.strings.named import named
from catenaria.formfinding.strings.net import Division, Part
from catenaria.formfinding.strings.sparse import Matrix, diagonal, factorised, matrix
from catenaria.formfinding.strings.task import StringLine

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

NEGLECTS = "bending; weight is lumped at nodes at most 2.4 m apart; droppers may push while it is on its way"

_LARGEST = 2.4  # m, of an element
_ENOUGH = 2e-8  # m by which heights may miss their targets
_SETTLED = 1e-10  # m by which a line at rest may still move
_MOST = 200


def find_rest(task: StringLine) -> Solved:
    r"""Find both strings at rest.

    Parameters
    ----------
    task : StringLine
        What was asked for.

    Notes
    -----
    A line is laid out with a level messenger and the contact wire at z0; droppers are cut to the distance.
    Under its weight it comes to rest at z = z0 + u. The next line is laid out with the sag turned upwards,

    .. math:: z_0 \leftarrow z^* - u = z_0 + (z^* - z),

    which for droppers is l0 <- l0 + z - z*. If the sag did not depend on z0, one pass would do. What contact
    wire and messenger share between them of a change is T_c : T_m in bays that are short against spans, so
    that errors shrink by T_c/(T_c + T_m) a pass.

    References
    ----------
    The family of the negative sag method, [11] of Yang et al. 2017, in our reconstruction: the original was
    not available.
    """
    model = _Model.of(task)
    z, along = model.level()
    unstressed = z[model.top] - task.height
    worst, work = np.inf, 0
    for _ in range(_MOST):
        z, along, L, count = model.come_to_rest(z, along, unstressed)
        work += count
        error = z[model.foot] - task.height
        worst = float(np.max(np.abs(error)))
        if worst < _ENOUGH:
            return Solved(model.at_rest(z, along, L, unstressed), work, model.free.size)
        unstressed = unstressed + error
        _refuse_upside_down(task, unstressed)
    raise NotConvergedError(
        f"heights are still {1e3 * worst:.3g} mm off after {_MOST} passes",
        "--method 'extended force density'",
    )


def _refuse_upside_down(task: StringLine, length: FloatArray) -> None:
    short = length <= 0.0
    if np.any(short):
        names = named(task.span, short)
        raise InfeasibleError(f"droppers would stand upside down: {names}; more tension would help")


@dataclass(frozen=True)
class _Model:
    """A line of given dropper lengths under its weight: strings under tension, droppers as elastic bars.

    `C` takes heights of nodes to rises of branches: both wires', then the droppers'.
    """

    task: StringLine
    parts: tuple[Part, Part]
    C: Matrix
    foot: IntArray
    top: IntArray
    free: IntArray

    @classmethod
    def of(cls, task: StringLine) -> _Model:
        """Divide the wires and number everything."""
        line = Division.of(task, _LARGEST)
        start, end = np.append(line.start, line.foot), np.append(line.start + 1, line.top)
        branch, one = np.arange(start.size, dtype=np.int64), np.ones(start.size)
        C = matrix([(branch, start, -one), (branch, end, one)], (start.size, line.node_count))
        free = np.setdiff1d(np.arange(line.node_count, dtype=np.int64), line.held)
        return cls(task, line.parts, C, line.foot, line.top, free)

    def level(self) -> tuple[FloatArray, FloatArray]:
        """Return heights of both wires as they are laid out, and forces along the track."""
        z = [np.interp(part.net.x, part.wire.support_x, part.wire.support_z) for part in self.parts]
        along = [np.full(part.net.dx.size, part.wire.tension) for part in self.parts]
        return np.concatenate(z), np.concatenate(along)

    def come_to_rest(
        self, z: FloatArray, along: FloatArray, unstressed: FloatArray
    ) -> tuple[FloatArray, FloatArray, FloatArray, int]:
        """Return heights, forces along the track and lengths of branches at rest, and the iterations.

        Newton's method for heights; weights and H are those of the iteration before.
        """
        task, dx = self.task, np.concatenate([part.net.dx for part in self.parts])
        for count in range(1, _MOST):
            load, L = self._loads(z, along, unstressed)
            x = (z[self.top] - z[self.foot]) / unstressed
            force = np.append(along / dx * (self.C @ z)[: dx.size], 0.5 * task.EA * (x * x - 1.0) * x)
            stiffness = np.append(along / dx, 0.5 * task.EA * (3.0 * x * x - 1.0) / unstressed)
            C = self.C[:, self.free]
            step = factorised(C.T @ diagonal(stiffness) @ C)(C.T @ force + load[self.free])
            z = z.copy()
            z[self.free] -= step
            along = self._along(z, along, L)
            if np.max(np.abs(step)) < _SETTLED:
                return z, along, L, count
        raise NotConvergedError("a line of given dropper lengths does not come to rest", "more tension")

    def _loads(
        self, z: FloatArray, along: FloatArray, unstressed: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Return the weights on all nodes and the unstressed lengths of the wires' branches."""
        load, lengths = np.zeros_like(z), list[FloatArray]()
        for part in self.parts:
            L = part.net.unstressed(part.wire, z[part.nodes], along[part.edges])
            load[part.nodes][:-1] += 0.5 * part.wire.w * L
            load[part.nodes][1:] += 0.5 * part.wire.w * L
            lengths.append(L)
        load[self.foot] += 0.5 * self.task.w * unstressed + self.task.bottom
        load[self.top] += 0.5 * self.task.w * unstressed + self.task.top
        return load, np.concatenate(lengths)

    def _along(self, z: FloatArray, along: FloatArray, L: FloatArray) -> FloatArray:
        """Return H of all branches: the tension passes supports, and vertical forces take their part."""
        new = along.copy()
        for part in self.parts:
            wire, support = part.wire, part.net.joint[part.joints.support]
            up = along[part.edges] * np.diff(z[part.nodes]) / part.net.dx
            half, tension = 0.5 * wire.w * L[part.edges], wire.tension
            spans = list(zip(support[:-1].tolist(), support[1:].tolist(), strict=True))
            for first, last in reversed(spans) if wire.at_end else spans:
                sides = up[first] - half[first], up[last - 1] + half[last - 1]
                near, far = sides[::-1] if wire.at_end else sides
                if not abs(near) < tension:
                    text = f"the {wire.name} cannot carry its loads with a tension of {tension:.4g} N"
                    raise InfeasibleError(text)
                H = float(np.sqrt(tension**2 - near**2))
                new[part.edges][first:last], tension = H, float(np.hypot(H, far))
        return new

    def at_rest(self, z: FloatArray, H: FloatArray, L: FloatArray, unstressed: FloatArray) -> LineAtRest:
        """Return the strings that the model amounts to."""
        contact, messenger = (
            with_tails(
                part.wire,
                part.joints,
                part.net.bays(part.wire, z[part.nodes], H[part.edges], L[part.edges]),
            )
            for part in self.parts
        )
        return LineAtRest(contact, messenger, unstressed)
