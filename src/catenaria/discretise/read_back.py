"""From a state of a wire model back to what an engineer asks for: profiles, tensions, sags, reactions."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.wire_model import WireModel
from catenaria.line.alignment import Frames
from catenaria.mechanics.chain import Chain, Points
from catenaria.mechanics.controls.control import Controls as ControlBatch
from catenaria.numerics.gauss import gauss_legendre
from catenaria.numerics.vectors import cross_sizes, sizes
from catenaria.results.form import Profile, Stage, WireForm

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

NEAR = 0.05  # m by which an element may lie beyond a support and still count as between supports
SAMPLES = 8  # points of a profile in each element: the sag of a 9.5 m bay is then met to 0.01 mm


def samples(chain: Chain) -> FloatArray:
    """Return the material coordinates of the points of a cable's profile: nodes and points between [m]."""
    parts = np.arange(SAMPLES) / SAMPLES
    return np.append((chain.knots[:-1, None] + chain.L[:, None] * parts).ravel(), chain.knots[-1])


def profile(chain: Chain, z: FloatArray, frames: Frames | None = None) -> Profile:
    """Return position and internal forces along a cable, eqs. (9)-(11), at several points of each element.

    Parameters
    ----------
    chain : Chain
        The cable.
    z : FloatArray
        Unknowns.
    frames : Frames, optional
        Those of the track in whose planes the `samples` are; without them the track is the x axis.

    Notes
    -----
    Axial strain at a point of a bent element is off by what the cubic position cannot follow, 100 N beside
    the supports of the paper's messenger; its mean over an element is not. `tension` is therefore
    interpolated between element means, while `strain_tension` is eq. (11) at the point, as the paper draws
    it.
    """
    s = samples(chain)
    point = chain.evaluate(z, s)
    size = sizes(point.r1)
    N = chain.section.EA * 0.5 * (size**2 - 1.0)
    kappa = _curvature(point)
    before = _curvature(chain.evaluate(z, chain.knots, _element_before(chain)))
    kappa[::SAMPLES] = 0.5 * (kappa[::SAMPLES] + before)
    x, y, up = point.r.T.copy()
    chainage, lateral, height, along = x, y, up, point.r1[:, 0]
    if frames is not None:
        chainage, lateral, height = frames.chainage, frames.lateral(point.r), frames.height(point.r)
        along = np.einsum("ni,ni->n", frames.along, point.r1)
    tension = np.interp(s, chain.knots[:-1] + 0.5 * chain.L, element_tension(chain, z))
    moment = chain.section.EJ * kappa
    return Profile(s, x, y, up, tension, N, tension * along / size, moment, chainage, lateral, height)


def _curvature(point: Points) -> FloatArray:
    """Return kappa of eq. (10) [1/m]."""
    return cross_sizes(point.r1, point.r2) / sizes(point.r1) ** 3


def _element_before(chain: Chain) -> IntArray:
    """Return the element before each node, where r'' jumps."""
    return np.maximum(np.arange(chain.knots.size) - 1, 0)


def element_tension(chain: Chain, z: FloatArray) -> FloatArray:
    """Return the mean of the true axial force EA eps |r'| over each element [N]."""
    points, weights = gauss_legendre(5)
    s = chain.knots[:-1, None] + 0.5 * chain.L[:, None] * (points + 1.0)
    size = sizes(chain.evaluate(z, s.ravel()).r1)
    force = chain.section.EA * 0.5 * (size**2 - 1.0) * size
    return 0.5 * (force.reshape(s.shape) @ weights)


def stretched_length(chain: Chain, z: FloatArray, start: float, end: float) -> float:
    """Return the deformed length between two material coordinates [m]."""
    points, weights = gauss_legendre(5)
    knots = np.unique(
        np.concatenate(([start], chain.knots[(chain.knots > start) & (chain.knots < end)], [end]))
    )
    half = 0.5 * np.diff(knots)[:, None]
    s = (knots[:-1, None] + half * (points + 1.0)).ravel()
    size = sizes(chain.evaluate(z, s).r1)
    return float(np.sum(size.reshape(half.shape[0], -1) * weights * half))


def sag(shape: Profile, chainage: FloatArray, height: FloatArray) -> float:
    """Return the largest depth of a wire below the chords between the given points on it [m]."""
    inside = (shape.chainage >= chainage[0]) & (shape.chainage <= chainage[-1])
    chord = np.interp(shape.chainage[inside], chainage, height)
    return float(np.max(chord - shape.height[inside], initial=0.0))


def support_strain_tension(model: WireModel, z: FloatArray) -> FloatArray:
    """Return N = EA eps of eq. (11) at the wire's supports [N]."""
    r1 = model.wire.evaluate(z, z[model.support_s]).r1
    return 0.5 * model.wire.section.EA * (np.einsum("ni,ni->n", r1, r1) - 1.0)


def reactions(model: WireModel, z: FloatArray) -> FloatArray:
    """Return the sizes of the forces at the wire's start and end [N]."""
    return np.linalg.norm(z[model.end_force], axis=1)


def wire_form(model: WireModel, control: ControlBatch, t: float, z: FloatArray) -> WireForm:
    """Return everything that was found for the wire of one step."""
    wire, setup = model.wire, model.setup
    shape = profile(wire, z)
    s_start, s_end = z[model.support_s[[0, -1]]]
    between = (wire.knots[:-1] >= s_start - NEAR) & (wire.knots[1:] <= s_end + NEAR)
    tension, L = element_tension(wire, z)[between], wire.L[between]
    error = float(control.error(t, z)[0])
    force = np.linalg.norm(z[model.end_force], axis=1)
    along = np.abs(z[model.end_force[:, 0]])
    start = model.system.unknowns.start[wire.nodes]
    hung_s = np.sort(np.concatenate((z[model.support_s], z[model.clamp_s] if setup.droppers.up else [])))
    hung = wire.evaluate(z, hung_s).r
    return WireForm(
        name=setup.name,
        role=setup.name,
        unstressed_length=float(s_end - s_start),
        stretched_length=stretched_length(wire, z, float(s_start), float(s_end)),
        target_tension=setup.tension.force,
        tension=setup.tension.force + error,
        tension_error=error,
        measure=setup.tension.measure,
        horizontal_start=float(along[0]),
        horizontal_end=float(along[1]),
        reaction_start=float(force[0]),
        reaction_end=float(force[1]),
        end_force=z[model.end_force],
        tension_min=float(tension.min()),
        tension_max=float(tension.max()),
        tension_mean=float(tension @ L / L.sum()),
        travel=float(z[model.pull[0]]),
        sag=sag(shape, hung[:, 0], hung[:, 2]),
        profile=shape,
        start_x=start[:, 0],
        start_z=start[:, 2],
    )


def stage(model: WireModel, z: FloatArray) -> Stage:
    """Return the state as values that another run can start from."""
    chains = (model.wire, *model.droppers.chains)
    nodes = np.concatenate([chain.nodes for chain in chains])
    names = (model.setup.name, *(f"dropper {i}" for i in range(1, len(chains))))
    return Stage(
        step=model.setup.name,
        chain=names,
        node_count=np.array([chain.knots.size for chain in chains]),
        s=np.concatenate([chain.knots for chain in chains]),
        position=z[nodes[:, :3]],
        slope=z[nodes[:, 3:]],
        sliding_coordinate=z[np.concatenate((model.support_s, model.clamp_s))],
        parameter=z[np.concatenate((model.pull, model.droppers.travel))],
        multiplier=z[model.multipliers],
    )
