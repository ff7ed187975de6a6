"""From shapes and lengths to a result: the tables of strings, and profiles of wires that bend."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from catenaria.formfinding.finite_elements import beam
from catenaria.formfinding.finite_elements.found import Found, WireShape
from catenaria.formfinding.strings.at_rest import LineAtRest, StringAtRest
from catenaria.formfinding.strings.read_back import form_result
from catenaria.formfinding.strings.task import string_line
from catenaria.line import Line
from catenaria.numerics import hermite
from catenaria.results.form import Counters, FormResult, Profile, Stage, WireForm

FloatArray = NDArray[np.float64]

Function = Callable[[FloatArray, FloatArray], FloatArray]

_SAMPLES = 8  # points in each element
_FUNCTIONS: tuple[Function, ...] = (hermite.shape, hermite.shape_1, hermite.shape_2)


def element_result(line: Line, method: str, found: Found, wall_time: float) -> FormResult:
    """Return the result that a found form amounts to.

    Parameters
    ----------
    line : Line
        What was asked for.
    method : str
        Name of the method.
    found : Found
        What was found.
    wall_time : float
        How long that took [s].

    Raises
    ------
    InfeasibleError
        If droppers would be in compression, stand upside down, or be cut to nothing.

    Notes
    -----
    Forces at joints, lengths and schedule do not depend on whether a wire bends, and are read like those of
    strings. What is between joints does.
    """
    shapes = found.contact, found.messenger
    contact, messenger = (_joined(shape) for shape in shapes)
    size = sum(shape.q.size for shape in shapes)
    n = found.iterations
    work = Counters("both wires", 0.0, wall_time, n, 0, 0, n, n, n, size)
    strings = LineAtRest(contact, messenger, found.unstressed)
    result = form_result(line, string_line(line, method), method, found.how, strings, (work,))
    wires = tuple(_bent(form, shape) for form, shape in zip(result.wires, shapes, strict=True))
    tension = np.concatenate([_strain_tension(shape)[shape.mesh.support] for shape in shapes])
    return replace(
        result,
        wires=wires,
        supports=replace(result.supports, tension=tension),
        stages=tuple(_stage(shape, form) for form, shape in zip(wires, shapes, strict=True)),
        physics="beam",
    )


def _joined(shape: WireShape) -> StringAtRest:
    """Return a wire by its nodes and the forces of joints and devices on them."""
    mesh, force = shape.mesh, np.zeros((shape.q.shape[0], 3))
    force[mesh.knots, 0], force[mesh.knots, 2] = shape.nodal_force[mesh.knots, :2].T
    force[mesh.clamp, 0] = 0.0  # to Newton's tolerance
    return StringAtRest(shape.s, _positions(shape), force, mesh.support, mesh.clamp)


def _positions(shape: WireShape) -> FloatArray:
    """Return the positions of the nodes, shape (n, 3) [m]."""
    x, z = shape.q[:, 0] + shape.mesh.origin, shape.q[:, 1]
    return np.column_stack((x, np.zeros_like(x), z))


def _slopes(shape: WireShape) -> FloatArray:
    """Return r' of every node in x and z, of the size that the wire is stretched there, shape (n, 2)."""
    stretch = np.interp(shape.s, *_along(shape, beam.arc_length(shape.element_q) / shape.unstressed))
    return stretch[:, None] * np.column_stack((np.cos(shape.q[:, 2]), np.sin(shape.q[:, 2])))


def _profile(shape: WireShape) -> Profile:
    """Return a wire at several points of each element; at nodes the moment is the mean of both sides."""
    at = np.arange(_SAMPLES + 1) / _SAMPLES
    s = _closed(shape.s[:-1, None] + shape.unstressed[:, None] * at)
    r, r1, r2 = (_hermite(shape, 2.0 * at - 1.0, function) for function in _FUNCTIONS)
    size = np.hypot(r1[..., 0], r1[..., 1])
    kappa = np.abs(r1[..., 0] * r2[..., 1] - r1[..., 1] * r2[..., 0]) / size**3
    bend = shape.mesh.section.EJ * kappa
    bend[:-1, -1] = bend[1:, 0] = 0.5 * (bend[:-1, -1] + bend[1:, 0])
    x, z = _closed(r[..., 0]) + shape.mesh.origin, _closed(r[..., 1])
    tension, strain_tension = (np.interp(s, *_along(shape, values)) for values in _tensions(shape))
    y = np.zeros_like(s)
    return Profile(
        s=s,
        x=x,
        y=y,
        z=z,
        tension=tension,
        strain_tension=strain_tension,
        horizontal=tension * _closed(r1[..., 0] / size),
        moment=_closed(bend),
        chainage=x,
        lateral=y,
        height=z,
    )


def _hermite(shape: WireShape, at: FloatArray, function: Function) -> FloatArray:
    """Return x and z, or derivatives, at points from -1 to 1 of every element: (n_elements, points, 2)."""
    slopes, r, L = _slopes(shape), shape.q[:, :2], shape.unstressed[:, None]
    nodes = np.stack((r[:-1], slopes[:-1], r[1:], slopes[1:]), axis=1)
    return function(np.broadcast_to(at, (L.size, at.size)), L) @ nodes


def _closed(values: FloatArray) -> FloatArray:
    """Return the values at the points of all elements in a row, nodes between elements once."""
    return np.append(values[:, :-1].ravel(), values[-1, -1])


def _tensions(shape: WireShape) -> tuple[FloatArray, FloatArray]:
    """Return the true axial force and N = EA eps of every element [N]."""
    force = beam.axial_force(shape.element_q, shape.unstressed, shape.mesh.section)
    arc = beam.arc_length(shape.element_q)
    return force, force * shape.unstressed / arc


def _along(shape: WireShape, values: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return material coordinates of the elements' middles and the values there."""
    return shape.s[:-1] + 0.5 * shape.unstressed, values


def _strain_tension(shape: WireShape) -> FloatArray:
    """Return N = EA eps of eq. (11) at all nodes, between the elements' [N]."""
    return np.interp(shape.s, *_along(shape, _tensions(shape)[1]))


def _bent(form: WireForm, shape: WireShape) -> WireForm:
    """Return what was found for a wire, with what its bending and its elements change."""
    mesh, profile = shape.mesh, _profile(shape)
    between = slice(int(mesh.support[0]), int(mesh.support[-1]))
    force, arc = _tensions(shape)[0][between], beam.arc_length(shape.element_q)[between]
    hung = mesh.joint if mesh.name == "contact wire" else mesh.support
    inside = slice(_SAMPLES * int(hung[0]), _SAMPLES * int(hung[-1]) + 1)
    joints = _positions(shape)[hung]
    chord: FloatArray = np.interp(profile.x[inside], joints[:, 0], joints[:, 2])
    return replace(
        form,
        stretched_length=float(arc.sum()),
        tension_min=float(force.min()),
        tension_max=float(force.max()),
        tension_mean=float(force @ shape.unstressed[between] / shape.unstressed[between].sum()),
        sag=float(np.max(chord - profile.z[inside], initial=0.0)),
        profile=profile,
    )


def _stage(shape: WireShape, form: WireForm) -> Stage:
    """Return the nodes with slopes r' of the size that the wire is stretched there."""
    mesh, slope, none = shape.mesh, _slopes(shape), np.zeros(shape.q.shape[0])
    return Stage(
        step=mesh.name,
        chain=(mesh.name,),
        node_count=np.array([none.size]),
        s=shape.s,
        position=_positions(shape),
        slope=np.column_stack((slope[:, 0], none, slope[:, 1])),
        sliding_coordinate=shape.s[np.concatenate((mesh.support, mesh.clamp))],
        parameter=np.array([form.travel]),
        multiplier=np.zeros(0),
    )
