"""Minimising the error of the dropper tensions [10].

Our reconstruction of the family: wanted tensions are those with which the droppers hold the contact wire in
its wanted form; the sum of their squared errors is an objective over dropper lengths.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from catenaria.formfinding.finite_elements.found import Found
from catenaria.formfinding.finite_elements.held_feet import held_feet_forces
from catenaria.formfinding.finite_elements.least_squares import least_squares
from catenaria.formfinding.finite_elements.line_system import LineSystem
from catenaria.formfinding.finite_elements.rest import come_to_rest
from catenaria.formfinding.finite_elements.start import first_guess
from catenaria.formfinding.finite_elements.trials import Trials
from catenaria.line import Line
from catenaria.results.form import FormResult

FloatArray = NDArray[np.float64]


def minimise_force_error(line: Line, start: FormResult | None) -> Found:
    r"""Find the dropper lengths for which :math:`\sum_i (F_i - F_i^*)^2` is least, and zero.

    Parameters
    ----------
    line : Line
        What the engineer describes.
    start : FormResult or None
        An earlier result to begin from.

    Raises
    ------
    NotConvergedError
        If the least is not zero, or a state of equilibrium is not found.

    Notes
    -----
    The wanted forces :math:`F^*` are the reactions of the contact wire alone, held at the wanted heights: the
    objective is only as good as they are. It is worse conditioned than the distance (condition 100 instead
    of 3 on the paper's line): one foot that is off changes its own force by 2T/h a metre, but a smooth
    deviation of many feet hardly changes any.
    """
    system = LineSystem.of(line)
    y, unstressed = first_guess(system, start)
    wanted = held_feet_forces(system)
    trials = Trials(come_to_rest(system, unstressed, y), unstressed)

    def error(lengths: FloatArray) -> FloatArray:
        return trials.at(lengths).foot_force - wanted

    def derivative(lengths: FloatArray) -> FloatArray:
        return trials.at(lengths).foot_force_by_length

    lengths, rounds = least_squares(error, derivative, unstressed)
    return trials.found(lengths, rounds, "the error of dropper tensions was minimised")
