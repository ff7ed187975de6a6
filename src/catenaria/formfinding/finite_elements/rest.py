"""The forward problem: where a line with given dropper lengths comes to rest, and what a length changes."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.sparse.linalg import splu  # pyright: ignore

from catenaria.errors import NotConvergedError
from catenaria.formfinding.finite_elements.line_system import LineSystem
from catenaria.formfinding.finite_elements.sparse import Matrix
from catenaria.solvers.newton import NewtonOptions, solve_newton

FloatArray = NDArray[np.float64]

_SCALE = 1e-9  # m and rad: a correction that is negligible
_ITERATIONS = 60


@dataclass(frozen=True)
class _Equations:
    """A system with fixed dropper lengths, as Newton's method wants it."""

    system: LineSystem
    unstressed: FloatArray

    @property
    def newton_scale(self) -> FloatArray:
        return np.full(self.system.size, _SCALE)

    def residual(self, y: FloatArray) -> FloatArray:
        return self.system.residual(y, self.unstressed)

    def jacobian(self, y: FloatArray) -> Matrix:
        return self.system.jacobian(y, self.unstressed).tocsc()

    def reselect(self, y: FloatArray) -> None:
        """Return nothing: there is no discrete state."""


@dataclass(frozen=True)
class LineAtRest:
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
    def by_length(self) -> FloatArray:
        """Derivative of all unknowns by the unstressed lengths: one factorisation, shape (size, n)."""
        matrix = self.system.jacobian(self.y, self.unstressed).tocsc()
        return -splu(matrix).solve(self.system.by_length(self.y, self.unstressed))

    @property
    def height_by_length(self) -> FloatArray:
        """Derivative of the heights, shape (n, n)."""
        return self.by_length[self.system.foot]

    @property
    def foot_force_by_length(self) -> FloatArray:
        """Derivative of the forces on the contact wire [N/m], shape (n, n)."""
        N_l, N_u = self.system.bars.tension_by(self.length, self.unstressed)
        length = self.by_length[self.system.top] - self.by_length[self.system.foot]
        return N_l[:, None] * length + np.diag(N_u - 0.5 * self.system.bars.weight)


def come_to_rest(system: LineSystem, unstressed: FloatArray, y: FloatArray, before: int = 0) -> LineAtRest:
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
            f"dropper {number} would have to be shorter than nothing", "a larger encumbrance or more tension"
        )
    options = NewtonOptions(max_iterations=_ITERATIONS)
    root = solve_newton(_Equations(system, unstressed), y, options)
    return LineAtRest(system, unstressed, root.y, before + root.corrections.size)


def begin(system: LineSystem, start: tuple[FloatArray, FloatArray]) -> LineAtRest:
    """Return the line at rest with the dropper lengths of a first guess."""
    y, unstressed = start
    return come_to_rest(system, unstressed, y)
