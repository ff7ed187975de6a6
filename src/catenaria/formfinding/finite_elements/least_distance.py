"""Minimising the distance of the contact wire from its wanted place [5].

Our reconstruction of the family: the sum of squared height errors at the droppers as an objective over
dropper lengths, with every state of equilibrium computed by finite elements.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from catenaria.formfinding.finite_elements.found import Found
from catenaria.formfinding.finite_elements.least_squares import least_squares
from catenaria.formfinding.finite_elements.line_system import LineSystem
from catenaria.formfinding.finite_elements.rest import come_to_rest
from catenaria.formfinding.finite_elements.start import first_guess
from catenaria.formfinding.finite_elements.trials import Trials
from catenaria.line import Line
from catenaria.results.form import FormResult

FloatArray = NDArray[np.float64]


def minimise_distance(line: Line, start: FormResult | None) -> Found:
    r"""Find the dropper lengths for which :math:`\sum_i (z_i - z_i^*)^2` is least, and zero.

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
    Tensions are held in every state. Trust-region least squares of SciPy with the exact derivatives
    :math:`dz/dl_0`, whose singular values lie within a factor of three of each other on the paper's line:
    the best conditioned objective of all.
    """
    system = LineSystem.of(line)
    y, unstressed = first_guess(system, start)
    trials = Trials(come_to_rest(system, unstressed, y), unstressed)

    def error(lengths: FloatArray) -> FloatArray:
        return trials.at(lengths).height - system.target

    def derivative(lengths: FloatArray) -> FloatArray:
        return trials.at(lengths).height_by_parameter

    lengths, rounds = least_squares(error, derivative, unstressed)
    return trials.found(lengths, rounds, "the distance was minimised")
