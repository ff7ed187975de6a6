"""Constrained optimisation [13, 24]: the smallest change of lengths that meets all heights and tensions.

Our reconstruction of the family, which poses form-finding as an optimisation under constraints; objective
and algorithm differ between authors.
"""

from __future__ import annotations

from typing import Any, cast

import numpy as np
from numpy.typing import NDArray
from scipy import optimize  # pyright: ignore[reportMissingTypeStubs]

from catenaria.formfinding.finite_elements.found import Found
from catenaria.formfinding.finite_elements.line_system import LineSystem
from catenaria.formfinding.finite_elements.rest import come_to_rest
from catenaria.formfinding.finite_elements.start import first_guess
from catenaria.formfinding.finite_elements.trials import Trials
from catenaria.line import Line
from catenaria.results.form import FormResult

FloatArray = NDArray[np.float64]

_ROUNDS = 200
_PRECISION = 1e-9  # m: change of the objective, and sum of all constraints


def optimise_under_constraints(line: Line, start: FormResult | None) -> Found:
    r"""Find the lengths nearest to the first guess with which the line meets all its demands.

    Parameters
    ----------
    line : Line
        What the engineer describes.
    start : FormResult or None
        An earlier result to begin from.

    Raises
    ------
    NotConvergedError
        If no lengths meet the constraints, or a state of equilibrium is not found.

    Notes
    -----
    With the unstressed lengths of droppers and the travels of the wires' ends p,

    .. math:: \min_p \tfrac12 |p - p_0|^2 \quad\text{subject to}\quad z_i(p) = z_i^*,\; T_c(p) = T_c^*,\;
              T_m(p) = T_m^*,

    by sequential quadratic programming. There are as many constraints as lengths, so that the constraints
    alone decide and the objective only picks the way: the search is Newton's method in another dress. Its
    dense matrices make it slow beyond some hundred droppers.

    References
    ----------
    Kraft 1988, A software package for sequential quadratic programming, DFVLR-FB 88-28.
    """
    first = LineSystem.of(line)
    y, unstressed = first_guess(first, start)
    wanted = np.array([first.contact.mesh.tension, first.messenger.mesh.tension])
    pulls = np.array([part[-1] for part in first.parts(y)])
    system = first.pulled(*pulls.tolist())
    parameters = np.concatenate((unstressed, pulls))
    trials = Trials(come_to_rest(system, unstressed, y), parameters)

    def demands(lengths: FloatArray) -> FloatArray:
        state = trials.at(lengths)
        return np.concatenate((state.height - system.target, state.tension / wanted - 1.0))

    def derivative(lengths: FloatArray) -> FloatArray:
        state = trials.at(lengths)
        return np.vstack((state.height_by_parameter, state.tension_by_parameter / wanted[:, None]))

    solution = cast(
        "Any",
        optimize.minimize(  # pyright: ignore[reportUnknownMemberType, reportCallIssue]
            lambda p: 0.5 * float(np.sum((p - parameters) ** 2)),
            parameters,
            jac=lambda p: p - parameters,
            method="SLSQP",
            constraints=cast("Any", [{"type": "eq", "fun": demands, "jac": derivative}]),
            options={"ftol": _PRECISION, "maxiter": _ROUNDS},
        ),
    )
    lengths = np.asarray(solution.x, dtype=np.float64)
    return trials.found(lengths, int(solution.nit), "the change of lengths was minimised")
