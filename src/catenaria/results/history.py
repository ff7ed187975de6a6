"""How a result was found: controls, the course of dynamic steps, the work, and states to start from."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


@dataclass(frozen=True)
class Controls:
    """Final state of every control.

    Attributes
    ----------
    name : tuple of str
        For example ``contact wire tension`` or ``height of dropper 3``.
    unit : tuple of str
        Unit of target, value, error and dead band: ``N`` or ``m``.
    target, value, error, dead_band : FloatArray
        What was wanted, what was measured, value - target, and the half width of the band without motion.
    parameter : FloatArray
        The control parameter [m]: how far a wire end or dropper end was moved; of lines in space also by how
        much a tied wire was made longer, and the unstressed length of a dropper.
    """

    name: tuple[str, ...]
    unit: tuple[str, ...]
    target: FloatArray
    value: FloatArray
    error: FloatArray
    dead_band: FloatArray
    parameter: FloatArray


@dataclass(frozen=True)
class History:
    """What happened in one dynamic step, at every accepted time step.

    Attributes
    ----------
    step : str
        ``contact wire`` (first step of the paper), ``messenger wire`` (second), or ``line`` (all wires at
        once).
    time, step_size : FloatArray, shape (n_t,)
        Simulated time and step size [s].
    order : IntArray, shape (n_t,)
        BDF order.
    control_name : tuple of str
        The controls of this step, n_c of them.
    control_unit : tuple of str
        Unit of each control's error.
    error, parameter, velocity : FloatArray, shape (n_t, n_c)
        Control errors [N or m], control parameters [m] and their velocities [m/s].
    joint_name : tuple of str
        Names of the n_j supports at which the wire is held.
    joint_tension : FloatArray, shape (n_t, n_j)
        N = EA eps of eq. (11) at those joints [N].
    reaction : FloatArray, shape (n_t, 2)
        Reaction at the start and the end of the wire, of all wires the first contact wire [N].
    kinetic, axial, bending : FloatArray, shape (n_t,)
        Energies (7) and the two terms of (8) [J].
    """

    step: str
    time: FloatArray
    step_size: FloatArray
    order: IntArray
    control_name: tuple[str, ...]
    control_unit: tuple[str, ...]
    error: FloatArray
    parameter: FloatArray
    velocity: FloatArray
    joint_name: tuple[str, ...]
    joint_tension: FloatArray
    reaction: FloatArray
    kinetic: FloatArray
    axial: FloatArray
    bending: FloatArray


@dataclass(frozen=True)
class Counters:
    """Work of one dynamic step."""

    step: str
    simulated_time: float
    wall_time: float
    steps: int
    rejected: int
    newton_failures: int
    residuals: int
    jacobians: int
    factorisations: int
    unknowns: int


@dataclass(frozen=True)
class Stage:
    """Final state of one dynamic step: what a later run can start from.

    Attributes
    ----------
    step : str
        As in `History`.
    chain : tuple of str
        Names of the cables of the model: the wire, then one for each dropper; of a step ``line`` all wires,
        then cantilevers.
    node_count : IntArray
        Number of nodes of each cable.
    s : FloatArray, shape (n_nodes,)
        Material coordinate of every node within its cable [m].
    position, slope : FloatArray, shape (n_nodes, 3)
        r [m] and r' of every node.
    sliding_coordinate : FloatArray
        The sliding coordinates [m], supports first, then droppers.
    parameter : FloatArray
        Control parameters [m], tension first, then droppers.
    multiplier : FloatArray
        Lagrange multipliers [N], three each: forces of the wire on supports, on droppers (guided: the first
        is the force of the dropper's guide), of the droppers' far ends on what moves them, of the wire's ends
        on the devices.

    Notes
    -----
    In a step ``line`` the three last hold the unknowns of their kinds in the order of the unknowns' numbers,
    and coordinates and slopes are by the unstressed length also of wires whose length was found.
    """

    step: str
    chain: tuple[str, ...]
    node_count: IntArray
    s: FloatArray
    position: FloatArray
    slope: FloatArray
    sliding_coordinate: FloatArray
    parameter: FloatArray
    multiplier: FloatArray
