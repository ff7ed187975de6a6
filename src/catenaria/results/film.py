"""How wires moved while a dynamic method found their form: a few of its states, for a replay."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


@dataclass(frozen=True)
class Polylines:
    """Lines through nodes, in the track frame, in n_f states.

    Attributes
    ----------
    node_count : IntArray, shape (n_lines,)
        Number of nodes of every line.
    chainage, lateral, height : FloatArray, shape (n_f, n_nodes)
        Where the nodes are, line after line: along the track, to the left of its middle, and normal to it, as
        in `catenaria.results.Profile` [m].
    """

    node_count: IntArray
    chainage: FloatArray
    lateral: FloatArray
    height: FloatArray

    def nodes(self, line: int) -> slice:
        """Return which nodes are those of a line."""
        end = int(self.node_count[: line + 1].sum())
        return slice(end - int(self.node_count[line]), end)


@dataclass(frozen=True)
class Film:
    """States of one motion, evenly spread over its accepted time steps.

    Attributes
    ----------
    step : str
        As in `catenaria.results.History`.
    time : FloatArray, shape (n_f,)
        Simulated time of every state [s].
    gravity : FloatArray, shape (n_f,)
        Part of gravity that acts, from 0 to 1.
    wire, role : tuple of str
        Names and roles of the wires that move, as in `catenaria.results.WireForm`.
    wires : Polylines
        One line a wire, through the nodes of its mesh.
    droppers : Polylines
        One line a dropper: the nodes of a cable, from its clamp on, or the two clamps of a straight one.
    control_name, control_quantity, control_unit : tuple of str
        The n_c controls, what they control, and the units of their errors: ``tension`` [``N``], ``height``
        [``m``] or ``dropper force`` [``N``].
    error : FloatArray, shape (n_f, n_c)
        Control errors in these states.
    """

    step: str
    time: FloatArray
    gravity: FloatArray
    wire: tuple[str, ...]
    role: tuple[str, ...]
    wires: Polylines
    droppers: Polylines
    control_name: tuple[str, ...]
    control_quantity: tuple[str, ...]
    control_unit: tuple[str, ...]
    error: FloatArray
