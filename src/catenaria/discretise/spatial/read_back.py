"""From a state of a line in space back to what an engineer asks for: the tables of a result."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.spatial.model import SpatialModel
from catenaria.discretise.spatial.natural import Natural
from catenaria.discretise.spatial.read_droppers import dropper_schedule, masses, ties
from catenaria.discretise.spatial.read_supports import arms, cantilevers, held_by_cantilevers, supports
from catenaria.discretise.spatial.read_wires import wire_forms
from catenaria.line import Line
from catenaria.mechanics.unknowns import Kind
from catenaria.results.form import (
    LINE_STEP,
    Arms,
    Cantilevers,
    Controls,
    Droppers,
    Masses,
    Stage,
    Supports,
    Ties,
    WireForm,
)

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class Found:
    """The tables of a `FormResult` that a state amounts to."""

    droppers: Droppers
    wires: tuple[WireForm, ...]
    supports: Supports
    arms: Arms
    ties: Ties
    masses: Masses
    cantilevers: Cantilevers
    controls: Controls
    stage: Stage


def read_back(
    line: Line, model: SpatialModel, z: FloatArray, bands: tuple[float, ...] | None = None
) -> Found:
    """Return the tables that a state amounts to.

    Parameters
    ----------
    line : Line
        What the engineer describes.
    model : SpatialModel
        What was solved.
    z : FloatArray, shape (n,)
        All unknowns, at rest under the whole gravity.
    bands : tuple of float, optional
        Within what the tensions of all wires [N] and then the heights [m] meet their targets, one number a
        wire and one for all heights; dead bands of zero if left out.
    """
    state = Natural(model, z)
    droppers, wires = dropper_schedule(line, state), wire_forms(state, line.alignment)
    return Found(
        droppers=droppers,
        wires=wires,
        supports=supports(line, state),
        arms=arms(line, state),
        ties=ties(state),
        masses=masses(state),
        cantilevers=cantilevers(line, state),
        controls=_controls(state, wires, droppers, bands or (0.0,) * (len(wires) + 1)),
        stage=stage(line, state),
    )


def control_names(model: SpatialModel) -> tuple[str, ...]:
    """Return the names of the controls of all tensions and heights."""
    heights = (f"height at dropper {i + 1}" for i in range(model.length.size))
    return (*(f"{wire.name} tension" for wire in model.layout.wires), *heights)


def control_units(model: SpatialModel) -> tuple[str, ...]:
    """Return the units of the controls' errors."""
    return ("N",) * len(model.layout.wires) + ("m",) * model.length.size


def _controls(
    state: Natural, wires: tuple[WireForm, ...], droppers: Droppers, bands: tuple[float, ...]
) -> Controls:
    model = state.model
    tension = np.array([[wire.target_tension, wire.tension, wire.tension_error] for wire in wires])
    height = np.column_stack((droppers.target_height, droppers.height, droppers.height_error))
    target, value, error = np.concatenate((tension, height)).T.copy()
    *tension_bands, height_band = bands
    return Controls(
        name=control_names(model),
        unit=control_units(model),
        target=target,
        value=value,
        error=error,
        dead_band=np.concatenate((tension_bands, np.full(droppers.x.size, height_band))),
        parameter=np.concatenate(([wire.travel for wire in wires], droppers.unstressed_length)),
    )


def stage(line: Line, state: Natural) -> Stage:
    """Return the state as values, by natural coordinates."""
    layout, z = state.model.layout, state.z
    chains = (*state.wires, *state.model.cantilevers)
    nodes = np.concatenate([chain.nodes for chain in chains])
    held = (line.supports[i].name for i in held_by_cantilevers(layout))
    return Stage(
        step=LINE_STEP,
        chain=(*(wire.name for wire in layout.wires), *(f"cantilever {name}" for name in held)),
        node_count=np.array([chain.knots.size for chain in chains]),
        s=np.concatenate([chain.knots for chain in chains]),
        position=z[nodes[:, :3]],
        slope=z[nodes[:, 3:]],
        sliding_coordinate=state.unknowns(Kind.SLIDING),
        parameter=state.unknowns(Kind.PARAMETER),
        multiplier=state.unknowns(Kind.MULTIPLIER),
    )
