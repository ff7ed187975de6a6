"""Which droppers to adjust: as few as can be, in whole steps, by mixed-integer linear programming."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any, Final, cast

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import Bounds, LinearConstraint, milp
from scipy.sparse import block_array, csr_array, diags_array, eye_array  # pyright: ignore[reportMissingTypeStubs]

from catenaria.errors import NotConvergedError

FloatArray = NDArray[np.float64]

SECONDS: Final = 30.0  # for each search, after which the best that was found is taken

_MM = 1e3  # lengths are millimetres within: tolerances of the solver are absolute
_DEVIATIONS = 0.5  # of a dropper: how much all deviations together may count
_GAP = 1e-4  # by which the value that is minimised may be off
_NEGLIGIBLE = 2e-4, 0.02  # slopes of heights, and of forces [N/m]; what they do is found by the next pass
_OPTIMAL, _STOPPED, _INFEASIBLE = 0, 1, 2  # of scipy.optimize.milp


@dataclass(frozen=True)
class Choice:
    """Changes of lengths.

    Attributes
    ----------
    change : FloatArray, shape (n,)
        How much longer each dropper is made [m]: whole steps.
    least : float
        What is minimised cannot be less than this.
    """

    change: FloatArray
    least: float

    @property
    def count(self) -> int:
        """Number of droppers that are changed."""
        return int(np.count_nonzero(self.change))

    @property
    def fewest(self) -> int:
        """Number of droppers of which it is proved that fewer do not do."""
        return max(0, math.ceil(self.least - _DEVIATIONS - 1e-6))


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

    def about(self, deviation: FloatArray, pull: FloatArray, change: FloatArray) -> Adjustable:
        """Return the same with deviations and forces that are known where lengths are changed already."""
        return replace(self, deviation=deviation - self.slope @ change, pull=pull - self.pull_slope @ change)

    def fewest(self, tolerance: float) -> Choice | None:
        r"""Return a choice of fewest droppers with all deviations within a tolerance, or None.

        Notes
        -----
        Of all choices of so few the one with the least sum of deviations is taken, for the number of droppers
        plus :math:`\tfrac12 \sum |d| / (m \tau) \le \tfrac12` is minimised.
        """
        m = self.deviation.size
        answer = self._solve(
            1.0, np.full(m, _DEVIATIONS / (m * _MM * tolerance)), eye_array(m), tolerance, self.count
        )
        if answer.status == _INFEASIBLE:
            return None
        if answer.x is None or answer.status not in (_OPTIMAL, _STOPPED):
            raise NotConvergedError(
                f"no choice of droppers was found within {SECONDS:g} s",
                "a wider tolerance, a larger step or smaller changes",
            )
        return Choice(self._change(answer), float(answer.mip_dual_bound))

    def best_tolerance(self, at_most: int) -> float | None:
        """Return the least tolerance [m] that so many droppers reach, or None if none was found."""
        fits = bool((self.pull >= self.least_pull).all())  # so that no change is a choice
        within = float(np.abs(self.deviation).max()) if fits else math.inf
        band = csr_array(np.ones((self.deviation.size, 1)))
        answer = self._solve(0.0, np.ones(1), band, within, at_most)
        return None if answer.x is None else float(answer.fun) / _MM

    @property
    def count(self) -> int:
        """Number of droppers."""
        return self.pull.size

    def _change(self, answer: Any) -> FloatArray:
        return self.step * np.round(cast(FloatArray, answer.x)[: self.count])

    def _solve(self, each: float, cost: FloatArray, band: Any, tolerance: float, at_most: int) -> Any:
        r"""Minimise over whole steps k, binaries b and bounds of deviations e.

        Notes
        -----
        With the deviations d = d_0 + s S k, for a step s, and at least L and at most U steps,

        .. math::
            |d| \le B e,\quad e \le \tau,\quad f_0 + s G k \ge f_{min},\quad
            L_i b_i \le k_i \le U_i b_i,\quad \sum b_i \le N.
        """
        n, e = self.count, cost.size
        low, high = self._steps(tolerance)
        lower = np.concatenate((low, np.zeros(n + e)))
        upper = np.concatenate((high, np.ones(n), np.full(e, _MM * tolerance)))
        return milp(
            np.concatenate((np.zeros(n), np.full(n, each), cost)),
            integrality=np.repeat([1, 1, 0], [n, n, e]),
            bounds=Bounds(lower, upper),
            constraints=[*self._limits(band), *_counted(low, high, at_most, e)],
            options={"time_limit": SECONDS, "mip_rel_gap": _GAP},
        )

    def _limits(self, band: Any) -> list[LinearConstraint]:
        """Return the bounds of deviations and of forces."""
        n, m, e = self.count, self.deviation.size, band.shape[1]
        off, none = _MM * self.deviation, csr_array((m, n))
        height = csr_array(_MM * self.step * _large(self.slope, _NEGLIGIBLE[0]))
        force = csr_array(self.step * _large(self.pull_slope, _NEGLIGIBLE[1]))
        pull = block_array([[force, csr_array((n, n + e))]])
        return [
            LinearConstraint(pull, self.least_pull - self.pull, np.inf),
            LinearConstraint(block_array([[height, none, -band]]), -np.inf, -off),
            LinearConstraint(block_array([[height, none, band]]), -off, np.inf),
        ]

    def _steps(self, tolerance: float) -> tuple[FloatArray, FloatArray]:
        r"""Return the least and the greatest number of steps of each dropper, shape (n,) each.

        Notes
        -----
        Where there are as many heights as lengths, k = S^{-1} (d - d_0) / s and every |d| is within the
        tolerance. So k is within :math:`\tau \sum_j |S^{-1}_{ij}| / s` of its middle, which is mostly far
        less than the largest change and spares the search most of its branches.
        """
        most = math.floor(self.largest / self.step * (1.0 + 1e-9))
        low, high = np.full(self.count, -float(most)), np.full(self.count, float(most))
        if np.isfinite(tolerance) and self.deviation.size == self.count:
            inverse = np.linalg.inv(_large(self.slope, _NEGLIGIBLE[0])) / self.step
            middle = -inverse @ self.deviation
            reach = tolerance * np.abs(inverse).sum(axis=1) + 1e-6
            low = np.clip(np.ceil(middle - reach), -most, most)
            high = np.maximum(np.clip(np.floor(middle + reach), -most, most), low)
        return low, high


def _large(slope: FloatArray, negligible: float) -> FloatArray:
    return np.where(np.abs(slope) < negligible, 0.0, slope)


def _counted(low: FloatArray, high: FloatArray, at_most: int, e: int) -> list[LinearConstraint]:
    """Return that only counted droppers change, and that no more than so many do."""
    n = low.size
    rest, most, least = csr_array((n, e)), np.maximum(high, 0.0), np.minimum(low, 0.0)
    up = LinearConstraint(block_array([[eye_array(n), -diags_array(most), rest]]), -np.inf, 0.0)
    down = LinearConstraint(block_array([[eye_array(n), -diags_array(least), rest]]), 0.0, np.inf)
    number = np.concatenate((np.zeros(n), np.ones(n), np.zeros(e)))
    return [up, down, LinearConstraint(number[None], 0.0, float(at_most))]
