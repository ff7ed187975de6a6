"""How wires moved while a dynamic method found their form: a few of its states, for a replay."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


@dataclass(frozen=True)
class Film:
    """States of one dynamic step, evenly spread over its accepted time steps.

    Attributes
    ----------
    step : str
        As in `catenaria.results.History`.
    time : FloatArray, shape (n_f,)
        Simulated time of every state [s].
    node_count : IntArray
        Number of nodes of the wire, then of every dropper cable.
    position : FloatArray, shape (n_f, n_nodes, 3)
        Positions of all nodes [m].
    control_name, control_unit : tuple of str
        The n_c controls and the units of their errors, ``N`` or ``m``.
    error : FloatArray, shape (n_f, n_c)
        Control errors in these states.
    """

    step: str
    time: FloatArray
    node_count: IntArray
    position: FloatArray
    control_name: tuple[str, ...]
    control_unit: tuple[str, ...]
    error: FloatArray
