"""Small problems with known solutions, given to the tests as factories."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.sparse import csc_array

GRAVITY = 9.81


def dense(matrix):
    """Return a matrix in column form with every entry stored, so that the sparsity never changes."""
    n = matrix.shape[0]
    indices = np.tile(np.arange(n, dtype=np.int32), n)
    return csc_array((matrix.T.ravel(), indices, np.arange(0, n * n + 1, n, dtype=np.int32)), shape=(n, n))


class Problem:
    """What all test problems share: sizes, scales, no discrete state."""

    def __init__(self, order_of, multipliers, error, newton):
        self.order_of = np.array(order_of, dtype=np.int8)
        self.size = self.order_of.size
        self.constraint = np.zeros(self.size, dtype=bool)
        self.constraint[list(multipliers)] = True
        self.error_scale = np.where(self.order_of > 0, error, np.inf)
        self.newton_scale = np.where(self.order_of > 0, newton, 1e-6)

    def reselect(self, y):
        return None


class Pendulum(Problem):
    """Unknowns x, z, la: x'' + 2 x la = 0, z'' + 2 z la + g = 0, x^2 + z^2 - 1 = 0."""

    def __init__(self, error=1e-5, newton=1e-8):
        super().__init__([2, 2, 0], [2], error, newton)

    def residual(self, t, y, yd, ydd):
        x, z, la = y
        return np.array([ydd[0] + 2 * x * la, ydd[1] + 2 * z * la + GRAVITY, x * x + z * z - 1.0])

    def jacobian(self, t, y, yd, ydd, c1, c2):
        x, z, la = y
        return dense(np.array([[c2 + 2 * la, 0.0, 2 * x], [0.0, c2 + 2 * la, 2 * z], [2 * x, 2 * z, 0.0]]))


class Forced(Problem):
    """Particle forced along z = x^2 / 2 by x = sin t, with la = 2 + cos 2t and p = cos t driven by x.

    The forces are made for this solution:
    x'' + x la = F_x, z'' - la = F_z, x^2/2 - z = 0, p' + p - x = -2 sin t + cos t.
    """

    def __init__(self, error=1e-6, newton=1e-14):
        super().__init__([2, 2, 0, 1], [2], error, newton)

    def exact(self, t):
        """Return y, y', y'' at times t, shape (m, 4)."""
        s, c = np.sin(t), np.cos(t)
        y = np.stack([s, s * s / 2, 2 + np.cos(2 * t), c], axis=-1)
        yd = np.stack([c, s * c, -2 * np.sin(2 * t), -s], axis=-1)
        ydd = np.stack([-s, np.cos(2 * t), -4 * np.cos(2 * t), -c], axis=-1)
        return y, yd, ydd

    def unforced(self, y, yd, ydd):
        x, z, la, p = y
        return np.array([ydd[0] + x * la, ydd[1] - la, x * x / 2 - z, yd[3] + p - x])

    def residual(self, t, y, yd, ydd):
        return self.unforced(y, yd, ydd) - self.unforced(*self.exact(t))

    def jacobian(self, t, y, yd, ydd, c1, c2):
        x, _, la, _ = y
        return dense(
            np.array(
                [
                    [c2 + la, 0.0, x, 0.0],
                    [0.0, c2, -1.0, 0.0],
                    [x, -1.0, 0.0, 0.0],
                    [-1.0, 0.0, 0.0, c1 + 1.0],
                ]
            )
        )


class Linear(Problem):
    """y' = A (y - phi(t)) + phi'(t) with phi = (sin t, cos t): eigenvalues -1000 and -1."""

    A = np.array([[-500.5, 499.5], [499.5, -500.5]])

    def __init__(self, error=1e-5, newton=1e-8):
        super().__init__([1, 1], [], error, newton)

    def exact(self, t):
        return np.stack([np.sin(t), np.cos(t)], axis=-1)

    def residual(self, t, y, yd, ydd):
        return yd - self.A @ (y - self.exact(t)) - np.array([np.cos(t), -np.sin(t)])

    def jacobian(self, t, y, yd, ydd, c1, c2):
        return dense(c1 * np.eye(2) - self.A)


@pytest.fixture
def pendulum():
    return Pendulum


@pytest.fixture
def forced():
    return Forced


@pytest.fixture
def linear():
    return Linear


@pytest.fixture
def base_problem():
    return Problem


@pytest.fixture
def to_sparse():
    return dense
