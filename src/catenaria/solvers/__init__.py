"""Numerical solvers that know no mechanics: BDF for index-3 systems, Newton, starting values, sparse LU."""

from __future__ import annotations

from catenaria.solvers.bdf import integrate
from catenaria.solvers.initial_values import InitialValues, consistent_start
from catenaria.solvers.newton import NewtonOptions, Root, solve_newton
from catenaria.solvers.outcome import Counters, Options, Solution, Start, Status, Step
from catenaria.solvers.problem import AlgebraicProblem, DaeProblem

__all__ = [
    "AlgebraicProblem",
    "Counters",
    "DaeProblem",
    "InitialValues",
    "NewtonOptions",
    "Options",
    "Root",
    "Solution",
    "Start",
    "Status",
    "Step",
    "consistent_start",
    "integrate",
    "solve_newton",
]
