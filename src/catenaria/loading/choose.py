"""Which droppers to adjust: as few as can be, in whole steps, by mixed-integer linear programming."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any, Final, Literal, cast

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import Bounds, LinearConstraint, milp
from scipy.sparse import block_array, csr_array, diags_array, eye_array  # pyright: ignore[reportMissingTypeStubs]

from catenaria.errors import NotConvergedError

FloatArray = NDArray[np.float64]

SECONDS: Final = 60.0  # for each search, after which the best that was found is taken

_MM = 1e3  # lengths are millimetres within: tolerances of the solver are absolute
_OPTIMAL, _STOPPED, _INFEASIBLE = 0, 1, 2  # of scipy.optimize.milp

Goal = Literal["fewest", "nearest", "tolerance"]


@dataclass(frozen=True)
class Choice:
    """Changes of lengths.

    Attributes
    ----------
    change : FloatArray, shape (n,)
        How much longer each dropper is made [m]: whole steps.
    value : float
        What was minimised: the number of droppers that are changed, the sum of the deviations or the largest
        one [m].
    least : float
        A value that no choice can be below.
    """

    change: FloatArray
    value: float
    least: float

    @property
    def proved(self) -> bool:
        """Whether it is proved that fewer droppers do not do."""
        return math.ceil(self.least - 1e-6) >= round(self.value)


@dataclass(frozen=True)
class Adjustable:
    """Heights and forces as linear functions of changes of lengths, and what is allowed.

    Attributes
    ----------
    deviation : FloatArray, shape (m,)
        Heights less the wanted ones, without any change [m].
    slope : FloatArray, shape (m, n)
        Their derivatives by the lengths.
    pull : FloatArray, shape (n,)
        Forces in droppers without any change [N].
    pull_slope : FloatArray, shape (n, n)
        Their derivatives [N/m].
    least_pull : FloatArray, shape (n,)
        Forces that must be left [N].
    step, largest : float
        Changes are whole steps, and none is larger than this [m].
    """

    deviation: FloatArray
    slope: FloatArray
    pull: FloatArray
    pull_slope: FloatArray
    least_pull: FloatArray
    step: float
    largest: float

    def fewest(self, tolerance: float) -> Choice | None:
        """Return a choice of fewest droppers with all deviations within the tolerance, or None."""
        return self._solve("fewest", tolerance, self.count)

    def nearest(self, tolerance: float, at_most: int) -> Choice | None:
        """Return the choice of so many droppers within the tolerance whose deviations have the least sum."""
        return self._solve("nearest", tolerance, at_most)

    def best_tolerance(self, at_most: int) -> Choice | None:
        """Return the choice of so many droppers whose largest deviation is least, or None if forces forbid all."""
        fits = bool((self.pull >= self.least_pull).all())  # so that it is no worse than no change at all
        return self._solve("tolerance", float(np.abs(self.deviation).max()) if fits else math.inf, at_most)

    @property
    def count(self) -> int:
        """Number of droppers."""
        return self.pull.size

    def _solve(self, goal: Goal, tolerance: float, at_most: int) -> Choice | None:
        r"""Minimise over whole steps k, binaries b and deviations e.

        Notes
        -----
        With the deviations d = d_0 + s S k, for a step s and at most K steps each,

        .. math::
            |d| \le e \le \tau,\quad f_0 + s G k \ge f_{min},\quad |k_i| \le K b_i,\quad \sum b_i \le N,

        the sum of b, or that of e, or the largest e, which is then one number for all, is minimised.
        """
        n, e = self.count, 0 if goal == "fewest" else 1 if goal == "tolerance" else self.deviation.size
        low, high = self._steps(tolerance)
        cost = np.concatenate((np.zeros(n), np.full(n, float(goal == "fewest")), np.ones(e)))
        lower = np.concatenate((low, np.zeros(n + e)))
        upper = np.concatenate((high, np.ones(n), np.full(e, np.inf)))
        answer = cast(
            Any,
            milp(
                cost,
                integrality=np.concatenate((np.ones(2 * n), np.zeros(e))),
                bounds=Bounds(lower, upper),
                constraints=[*self._limits(goal, tolerance, e), *self._count(low, high, at_most, e)],
                options={"time_limit": SECONDS, "mip_rel_gap": 0.0 if goal == "fewest" else 1e-3},
            ),
        )
        if answer.status == _INFEASIBLE:
            return None
        if answer.x is None or answer.status not in (_OPTIMAL, _STOPPED):
            raise NotConvergedError(
                f"no choice of droppers was found within {SECONDS:g} s",
                "a wider tolerance, a larger step or smaller changes",
            )
        unit = 1.0 if goal == "fewest" else _MM
        change = self.step * np.round(cast(FloatArray, answer.x)[:n])
        return Choice(change, float(answer.fun) / unit, float(answer.mip_dual_bound) / unit)

    def _limits(self, goal: Goal, tolerance: float, e: int) -> list[LinearConstraint]:
        """Return the bounds of deviations and of forces."""
        n, m = self.count, self.deviation.size
        height = csr_array(_MM * self.step * self.slope)
        off, none = _MM * self.deviation, csr_array((m, n))
        pull = block_array([[csr_array(self.step * self.pull_slope), csr_array((n, n + e))]])
        forces = LinearConstraint(pull, self.least_pull - self.pull, np.inf)
        within = LinearConstraint(block_array([[height, csr_array((m, n + e))]]), -np.inf, np.inf)
        if np.isfinite(tolerance):
            within.lb, within.ub = -_MM * tolerance - off, _MM * tolerance - off
        if goal == "fewest":
            return [forces, within]
        band = csr_array(np.ones((m, 1))) if goal == "tolerance" else eye_array(m)
        above = LinearConstraint(block_array([[height, none, -band]]), -np.inf, -off)
        below = LinearConstraint(block_array([[height, none, band]]), -off, np.inf)
        return [forces, above, below] + ([within] if np.isfinite(tolerance) else [])

    def _steps(self, tolerance: float) -> tuple[FloatArray, FloatArray]:
        r"""Return the least and the greatest number of steps of each dropper, shape (n,) each.

        Notes
        -----
        Where there are as many heights as lengths, k = S^{-1} (d - d_0) / s and every |d| is within the
        tolerance. So k is within :math:`\tau \sum_j |S^{-1}_{ij}| / s` of its middle, which is mostly far less
        than K and spares the search most of its branches.
        """
        most = math.floor(self.largest / self.step * (1.0 + 1e-9))
        low, high = np.full(self.count, -float(most)), np.full(self.count, float(most))
        if np.isfinite(tolerance) and self.deviation.size == self.count:
            inverse = np.linalg.inv(self.slope) / self.step
            middle = -inverse @ self.deviation
            reach = tolerance * np.abs(inverse).sum(axis=1) + 1e-6
            low = np.clip(np.ceil(middle - reach), -most, most)
            high = np.clip(np.floor(middle + reach), -most, most)
        return low, high

    def _count(self, low: FloatArray, high: FloatArray, at_most: int, e: int) -> list[LinearConstraint]:
        """Return that only counted droppers change, and that no more than so many do."""
        n = self.count
        rest = csr_array((n, e))
        up = LinearConstraint(block_array([[eye_array(n), -diags_array(high), rest]]), -np.inf, 0.0)
        down = LinearConstraint(block_array([[eye_array(n), -diags_array(low), rest]]), 0.0, np.inf)
        number = np.concatenate((np.zeros(n), np.ones(n), np.zeros(e)))
        return [up, down, LinearConstraint(number[None], 0.0, float(at_most))]

    def about(self, deviation: FloatArray, pull: FloatArray, change: FloatArray) -> Adjustable:
        """Return the same with deviations and forces that are known where lengths are changed already."""
        return replace(
            self, deviation=deviation - self.slope @ change, pull=pull - self.pull_slope @ change
        )
