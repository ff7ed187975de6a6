"""From a loaded line at rest to what an engineer asks for."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.read_back import NEAR, element_tension
from catenaria.discretise.spatial.natural import Natural
from catenaria.discretise.spatial.on_track import track_profiles
from catenaria.discretise.spatial.read_supports import arms, supports
from catenaria.line import Line
from catenaria.loading.built_line import LoadedLine
from catenaria.results.case import LineState, LoadedDroppers, LoadedWire

FloatArray = NDArray[np.float64]
Mask = NDArray[np.bool_]

_SLACK = 1e-6  # N: a dropper that pulls less is slack


def line_state(line: Line, loaded: LoadedLine, broken: Mask) -> LineState:
    """Return what a line at rest looks like and bears; `broken` says which droppers are missing."""
    state = Natural(loaded.model, loaded.z)
    return LineState(
        droppers=_droppers(line, loaded, broken),
        wires=tuple(_wires(line, loaded, state)),
        supports=supports(line, state),
        arms=arms(line, state),
    )


def _droppers(line: Line, loaded: LoadedLine, broken: Mask) -> LoadedDroppers:
    model, z, laid = loaded.model, loaded.z, loaded.model.layout.droppers
    bottom = model.lower_carrier.evaluate(z, z[model.lower_s]).r
    frames = line.alignment.frames(line.alignment.locate(bottom, laid.frame.chainage))
    slack = (loaded.dropper_pull <= _SLACK) & ~broken
    wires = model.layout.wires
    return LoadedDroppers(
        span=laid.span,
        number=laid.number,
        lower_wire=tuple(wires[int(k)].name for k in laid.lower),
        upper_wire=tuple(wires[int(k)].name for k in laid.upper),
        chainage=frames.chainage,
        height=frames.height(bottom),
        lateral=frames.lateral(bottom),
        force=np.where(slack | broken, 0.0, loaded.dropper_pull),
        slack=slack,
        broken=broken,
    )


def _wires(line: Line, loaded: LoadedLine, state: Natural) -> Iterator[LoadedWire]:
    model, z = state.model, state.z
    profiles = track_profiles(state, line.alignment)
    for k, (laid, wire, shape) in enumerate(zip(model.layout.wires, state.wires, profiles, strict=True)):
        held = z[model.hold_s[model.layout.holds.wire == k]]
        start, end = (0.0, wire.knots[-1]) if laid.tied else (held.min(), held.max())
        between = (wire.knots[:-1] >= start - NEAR) & (wire.knots[1:] <= end + NEAR)
        tension = element_tension(wire, z)[between]
        yield LoadedWire(
            name=laid.name,
            role=laid.role,
            end_force=loaded.end_force[k],
            tension_min=float(tension.min()),
            tension_max=float(tension.max()),
            travel=float(loaded.travel[k]),
            s=shape.s,
            chainage=shape.chainage,
            lateral=shape.lateral,
            height=shape.height,
            tension=shape.tension,
        )
