"""Load stepping: from a state that is held to one that holds itself, when Newton's method alone fails."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from catenaria.errors import InfeasibleError, NotConvergedError
from catenaria.solvers.newton import NewtonOptions, Root, solve_newton
from catenaria.solvers.problem import AlgebraicProblem, FloatArray, SparseMatrix

_NEWTON = NewtonOptions(max_iterations=12)


@dataclass(frozen=True)
class SteppingOptions:
    """Limits of load stepping.

    Parameters
    ----------
    first, smallest : float
        First and smallest step of the part that is released.
    max_steps : int
        Limit of steps, refused ones counted.
    quick : int
        Newton iterations up to which the next step is twice as long.
    newton : NewtonOptions
        Limits of the iteration in each step.
    """

    first: float = 0.125
    smallest: float = 1e-4
    max_steps: int = 100
    quick: int = 5
    newton: NewtonOptions = _NEWTON


@dataclass(frozen=True)
class Released:
    """Where load stepping arrived.

    Attributes
    ----------
    root : Root
        Root at the last part; its problem is the caller's, with the discrete state that fits.
    parts : FloatArray, shape (steps,)
        Parts that were released step by step, the last one 1 unless stepping failed; empty if the first step
        already did.
    refused : int
        Steps that had to be shortened.
    iterations : int
        Newton iterations of all steps, refused ones left out.
    """

    root: Root
    parts: FloatArray
    refused: int
    iterations: int

    @property
    def part(self) -> float:
        """Part that was released in the end."""
        return float(self.parts[-1]) if self.parts.size else 0.0


@dataclass(frozen=True)
class _Held:
    """f(y) - g = 0, in which the loads g are held."""

    problem: AlgebraicProblem
    held: FloatArray

    @property
    def newton_scale(self) -> FloatArray:
        return self.problem.newton_scale

    def residual(self, y: FloatArray) -> FloatArray:
        return self.problem.residual(y) - self.held

    def jacobian(self, y: FloatArray) -> SparseMatrix:
        return self.problem.jacobian(y)

    def reselect(self, y: FloatArray) -> _Held | None:
        selected = self.problem.reselect(y)
        return None if selected is None else replace(self, problem=selected)


def solve_by_steps(
    problem: AlgebraicProblem, y: FloatArray, options: SteppingOptions | None = None
) -> Released:
    """Find a root of f by releasing step by step what holds the starting guess.

    Parameters
    ----------
    problem : AlgebraicProblem
        The equations.
    y : FloatArray, shape (n,)
        Starting guess; it is not changed.
    options : SteppingOptions, optional
        Limits.

    Returns
    -------
    Released

    Raises
    ------
    NotConvergedError
        If the step becomes too small or the steps run out; `partial` is the `Released` so far.

    Notes
    -----
    The homotopy f(y) - (1 - p) f(y0) = 0 has the root y0 at p = 0 and that of f at p = 1. In mechanics
    (1 - p) f(y0) are forces that hold the guess, and offsets by which it misses its constraints. Each
    step of p is one Newton iteration from the state before; a step is halved when the iteration fails, and
    doubled when it was quick.

    Examples
    --------
    >>> from scipy.sparse import csc_array
    >>> class Cube:
    ...     newton_scale = np.array([1e-12])
    ...
    ...     def residual(self, y):
    ...         return y**3 + y - 10.0
    ...
    ...     def jacobian(self, y):
    ...         return csc_array([[3.0 * y[0] ** 2 + 1.0]])
    ...
    ...     def reselect(self, y):
    ...         return None
    >>> released = solve_by_steps(Cube(), np.zeros(1))
    >>> round(float(released.root.y[0]), 12), released.part
    (2.0, 1.0)

    References
    ----------
    Deuflhard 2004, Newton Methods for Nonlinear Problems, section 5.1 (continuation, global homotopy).
    """
    options = options or SteppingOptions()
    held = problem.residual(y)
    if not np.isfinite(held).all():
        root = Root(y, False, np.empty(0), np.empty(0), 0, problem)
        raise _failure(
            Released(root, np.empty(0), 0, 0), "the starting guess has a residual that is not finite"
        )
    start = Root(np.array(y, dtype=np.float64), True, np.empty(0), np.empty(0), 0, problem)
    return _release(Released(start, np.empty(0), 0, 0), held, options)


def _release(released: Released, held: FloatArray, options: SteppingOptions) -> Released:
    """Release the rest of what is held."""
    step = options.first
    while released.part < 1.0:
        if released.parts.size + released.refused >= options.max_steps:
            raise _failure(released, f"load stepping has made {options.max_steps} steps")
        part = min(released.part + step, 1.0)
        try:
            root = _root(released.root, (1.0 - part) * held, options.newton)
        except (NotConvergedError, InfeasibleError) as error:
            released, step = replace(released, refused=released.refused + 1), 0.5 * step
            if step < options.smallest:
                why = error.reason if isinstance(error, NotConvergedError) else str(error)
                raise _failure(released, f"load stepping is stuck; {why}") from error
            continue
        iterations = released.iterations + root.iterations
        released = Released(root, np.append(released.parts, part), released.refused, iterations)
        step *= 2.0 if root.corrections.size <= options.quick else 1.0
    return released


def _root(start: Root, held: FloatArray, options: NewtonOptions) -> Root:
    root = solve_newton(_Held(start.problem, held), start.y, options)
    if not isinstance(root.problem, _Held):
        raise TypeError("reselect has changed the type of the problem")
    return replace(root, problem=root.problem.problem)


def _failure(released: Released, reason: str) -> NotConvergedError:
    return NotConvergedError(
        f"{reason} when {released.part:.1%} of the starting guess was released",
        "a starting guess nearer to the solution",
        replace(released, root=replace(released.root, converged=False)),
    )
