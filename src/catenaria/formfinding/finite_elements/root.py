"""Newton's method for equations that are two functions of their unknowns, all of them lengths or angles."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from catenaria.errors import NotConvergedError
from catenaria.formfinding.finite_elements.sparse import Matrix
from catenaria.solvers.newton import NewtonOptions, solve_newton

FloatArray = NDArray[np.float64]

_SCALE = 1e-9  # m and rad: a correction that is negligible
_ITERATIONS = 60
_ADVICE = "--start from the result of another method, such as 'geometry variation'; or --method direct"


@dataclass(frozen=True)
class _Equations:
    """Residual and Jacobian as the solver wants them."""

    function: Callable[[FloatArray], FloatArray]
    derivative: Callable[[FloatArray], Matrix]
    newton_scale: FloatArray

    def residual(self, y: FloatArray) -> FloatArray:
        return self.function(y)

    def jacobian(self, y: FloatArray) -> Matrix:
        return self.derivative(y).tocsc()

    def reselect(self, y: FloatArray) -> None:
        """Return nothing: there is no discrete state."""


def find_root(
    function: Callable[[FloatArray], FloatArray], derivative: Callable[[FloatArray], Matrix], y: FloatArray
) -> tuple[FloatArray, int]:
    """Return the root near a first guess y, and the number of Jacobians that were factorised.

    Raises
    ------
    NotConvergedError
        If Newton's method finds none.
    """
    equations = _Equations(function, derivative, np.full(y.size, _SCALE))
    try:
        root = solve_newton(equations, y, NewtonOptions(max_iterations=_ITERATIONS))
    except NotConvergedError as error:
        raise NotConvergedError(f"no state of rest near the first guess: {error.reason}", _ADVICE) from error
    return root.y, root.corrections.size
