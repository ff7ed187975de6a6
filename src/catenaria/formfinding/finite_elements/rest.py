"""The forward problem: where a line with given dropper lengths comes to rest, and what a length changes."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from catenaria.errors import NotConvergedError
from catenaria.formfinding.finite_elements.line_system import LineSystem
from catenaria.formfinding.finite_elements.root import find_root
from catenaria.formfinding.finite_elements.sparse import solve

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class LineState:
    """A line at rest.

    Attributes
    ----------
    system : LineSystem
        Its equations.
    unstressed : FloatArray, shape (n,)
        Unstressed lengths of the droppers [m].
    y : FloatArray, shape (size,)
        Its unknowns.
    iterations : int
        Newton iterations that led here, those of earlier states included.
    """

    system: LineSystem
    unstressed: FloatArray
    y: FloatArray
    iterations: int

    @property
    def height(self) -> FloatArray:
        """Heights of the contact wire at the droppers [m]."""
        return self.y[self.system.foot]

    @property
    def length(self) -> FloatArray:
        """Lengths of the droppers [m]."""
        return self.y[self.system.top] - self.y[self.system.foot]

    @property
    def foot_force(self) -> FloatArray:
        """Forces with which droppers lift the contact wire [N]."""
        return -self.system.bars.loads(self.length, self.unstressed)[0]

    @property
    def top_force(self) -> FloatArray:
        """Forces with which droppers pull at the messenger [N]."""
        return self.system.bars.loads(self.length, self.unstressed)[1]

    @cached_property
    def by_parameter(self) -> FloatArray:
        """Derivative of all unknowns by unstressed lengths and by given travels of the two wires' ends.

        Shape (size, n) or (size, n + 2): one factorisation, and a back-substitution for each.
        """
        given = self.system.by_length(self.y, self.unstressed)
        if self.system.contact.pull is not None:
            travel = np.zeros((self.system.size, 2))
            travel[[self.system.contact.size - 1, -1], [0, 1]] = -1.0
            given = np.hstack((given, travel))
        return -solve(self.system.jacobian(self.y, self.unstressed), given)

    @property
    def height_by_parameter(self) -> FloatArray:
        """Derivative of the heights by the parameters, n rows."""
        return self.by_parameter[self.system.foot]

    @property
    def foot_force_by_length(self) -> FloatArray:
        """Derivative of the forces on the contact wire [N/m], shape (n, n)."""
        N_l, N_u = self.system.bars.tension_by(self.length, self.unstressed)
        length = self.by_parameter[self.system.top] - self.by_parameter[self.system.foot]
        return N_l[:, None] * length + np.diag(N_u - 0.5 * self.system.bars.weight)

    @property
    def tension(self) -> FloatArray:
        """Reactions of the devices of the two wires [N]."""
        lower, upper = self.system.parts(self.y)
        return np.array([self.system.contact.tension(lower), self.system.messenger.tension(upper)])

    @property
    def tension_by_parameter(self) -> FloatArray:
        """Derivative of the reactions by the parameters, two rows."""
        lower, upper = self.system.parts(self.y)
        moved = self.system.parts(self.by_parameter)
        return np.stack(
            (
                self.system.contact.tension_gradient(lower) @ moved[0],
                self.system.messenger.tension_gradient(upper) @ moved[1],
            )
        )


def come_to_rest(system: LineSystem, unstressed: FloatArray, y: FloatArray, before: int = 0) -> LineState:
    """Find where a line comes to rest.

    Parameters
    ----------
    system : LineSystem
        The line.
    unstressed : FloatArray, shape (n,)
        Unstressed lengths of the droppers [m].
    y : FloatArray, shape (size,)
        First guess.
    before : int
        Iterations that were made before, to be counted on.

    Raises
    ------
    NotConvergedError
        If a length is not positive, or Newton's method finds no rest.
    """
    if not np.all(unstressed > 0.0):
        number = int(np.argmin(unstressed)) + 1
        raise NotConvergedError(
            f"dropper {number} of the line would have to be shorter than nothing",
            "a larger encumbrance or more tension",
        )
    y, iterations = find_root(
        lambda y: system.residual(y, unstressed), lambda y: system.jacobian(y, unstressed), y
    )
    return LineState(system, unstressed, y, before + iterations)
