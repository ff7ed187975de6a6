"""The result of a form-finding computation: named arrays in SI units, frozen.

Every array is read-only and one-dimensional unless its comment says otherwise. Column names of tables that
are written to files carry the unit as suffix (`length_m`, `tension_N`); attributes here do not, they are SI.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from catenaria.results.audit import NOT_AUDITED, Audit
from catenaria.results.rebuilt import NOT_REBUILT, Rebuilt

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


@dataclass(frozen=True)
class Droppers:
    """Dropper schedule, one entry for each dropper in the order of the line.

    Attributes
    ----------
    span, number : IntArray
        Span (from 1) and number within the span (from 1).
    x : FloatArray
        Position along the track [m].
    length : FloatArray
        Distance between the wire axes in the equilibrium [m].
    unstressed_length : FloatArray
        The same piece without force [m].
    cut_length : FloatArray
        Unstressed length minus what the clamps bridge [m].
    force_top, force_bottom : FloatArray
        Tension at the messenger clamp and force on the contact wire [N].
    height, target_height, height_error : FloatArray
        Contact-wire height at the dropper, the wanted one, and their difference [m].
    messenger_height : FloatArray
        Height of the messenger axis at the dropper [m].
    force_error : FloatArray
        Residual of eq. (23) [N].
    contact_coordinate, messenger_coordinate : FloatArray
        Material coordinates of the wires at the clamps, from the wires' starts [m].
    on_contact, on_messenger : FloatArray, shape (n, 3)
        Forces of dropper and clamp on the two wires [N].
    """

    span: IntArray
    number: IntArray
    x: FloatArray
    length: FloatArray
    unstressed_length: FloatArray
    cut_length: FloatArray
    force_top: FloatArray
    force_bottom: FloatArray
    height: FloatArray
    target_height: FloatArray
    height_error: FloatArray
    messenger_height: FloatArray
    force_error: FloatArray
    contact_coordinate: FloatArray
    messenger_coordinate: FloatArray
    on_contact: FloatArray
    on_messenger: FloatArray


@dataclass(frozen=True)
class Profile:
    """A wire's equilibrium configuration, sampled along it (several points in each element).

    Attributes
    ----------
    s : FloatArray
        Material (unstressed) arc length from the wire's start [m].
    x, y, z : FloatArray
        Position [m].
    tension : FloatArray
        True axial force EA eps |r'|, interpolated between its means over elements [N].
    strain_tension : FloatArray
        N = EA eps of eq. (11) at the point, which overshoots where a wire bends sharply [N].
    horizontal : FloatArray
        Component of the true axial force along the track [N].
    moment : FloatArray
        Bending moment EJ kappa, without sign [N m].
    """

    s: FloatArray
    x: FloatArray
    y: FloatArray
    z: FloatArray
    tension: FloatArray
    strain_tension: FloatArray
    horizontal: FloatArray
    moment: FloatArray


@dataclass(frozen=True)
class WireForm:
    """What was found for one wire.

    Attributes
    ----------
    name : str
        As in the line file, for example ``contact wire``.
    unstressed_length, stretched_length : float
        Between its first and last support, without and with force [m].
    target_tension, tension, tension_error : float
        The prescribed tension, the measured one and their difference [N].
    measure : str
        How the tension was measured: ``reaction`` or ``strain``.
    horizontal_start, horizontal_end : float
        Component along the track of the reaction at the two wire ends [N].
    reaction_start, reaction_end : float
        Size of the reaction at the two wire ends [N].
    end_force : FloatArray, shape (2, 3)
        Forces of the wire's start and end on the tensioning devices [N].
    tension_min, tension_max, tension_mean : float
        Of the element means of the true axial force between the first and the last support [N].
    travel : float
        How far each end was pulled outwards [m].
    sag : float
        Contact wire: largest depth below the line through two neighbouring droppers or supports that hold it;
        messenger: largest depth below the chord of a span [m].
    profile : Profile
        Equilibrium configuration with internal forces.
    start_x, start_z : FloatArray
        The starting configuration as a polyline [m].
    """

    name: str
    unstressed_length: float
    stretched_length: float
    target_tension: float
    tension: float
    tension_error: float
    measure: str
    horizontal_start: float
    horizontal_end: float
    reaction_start: float
    reaction_end: float
    end_force: FloatArray
    tension_min: float
    tension_max: float
    tension_mean: float
    travel: float
    sag: float
    profile: Profile
    start_x: FloatArray
    start_z: FloatArray


@dataclass(frozen=True)
class Supports:
    """Forces of the wires on their supports, one entry for each wire held at each support.

    Attributes
    ----------
    support, wire : tuple of str
        Names.
    x, z : FloatArray
        Where the wire is held [m].
    force_x, force_y, force_z : FloatArray
        Force of the wire on the support [N]; z is positive upwards, so a hanging wire gives a negative one.
    tension : FloatArray
        N = EA eps of eq. (11) at the joint [N].
    sliding_coordinate : FloatArray
        Material coordinate of the wire at the support [m].
    """

    support: tuple[str, ...]
    wire: tuple[str, ...]
    x: FloatArray
    z: FloatArray
    force_x: FloatArray
    force_y: FloatArray
    force_z: FloatArray
    tension: FloatArray
    sliding_coordinate: FloatArray


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
        The control parameter: how far a wire end or dropper end was moved [m].
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
        ``contact wire`` (first step of the paper) or ``messenger wire`` (second).
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
        Reaction at the wire's start and end [N].
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
        Names of the cables of the model: the wire, then one for each dropper.
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


@dataclass(frozen=True)
class FormResult:
    """Everything that a form-finding run found.

    Attributes
    ----------
    name, method : str
        Name of the line and of the method.
    stop_reason : str
        In words, why the computation ended.
    droppers, wires, supports, controls
        The tables; `wires` holds the contact wire, then the messenger wire.
    histories, counters, stages
        One entry for each dynamic step.
    inputs : dict
        Echo of the line file, all values in SI.
    versions : dict
        Versions of catenaria, Python, NumPy, SciPy and Numba.
    audit : Audit
        What an audit of the other fields found; empty until there was one.
    rebuilt : Rebuilt
        Where a line built from the found lengths came to rest; empty until there was one.
    physics : str
        What the wires are, which an audit must know: ``bending`` (eqs. (7)-(10), with `stages`), ``beam``
        (bending too, but with one strain in every element; `stages` hold the nodes) or ``string``
        (no bending stiffness, no `stages`; profiles are given behind joints, where forces jump).
    """

    name: str
    method: str
    stop_reason: str
    droppers: Droppers
    wires: tuple[WireForm, ...]
    supports: Supports
    controls: Controls
    histories: tuple[History, ...]
    counters: tuple[Counters, ...]
    stages: tuple[Stage, ...]
    inputs: dict[str, Any]
    versions: dict[str, str]
    audit: Audit = NOT_AUDITED
    rebuilt: Rebuilt = NOT_REBUILT
    physics: str = "bending"
