"""The line that was found, to be built: found hinges become given ones, found lengths and clamps known."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.spatial.layout import Layout
from catenaria.discretise.spatial.model import SpatialModel
from catenaria.discretise.spatial.numbering import NONE
from catenaria.results.form import FormResult

FloatArray = NDArray[np.float64]


def with_found_hinges(layout: Layout, result: FormResult) -> Layout:
    """Return the layout in which all steady arms turn about the hinges that were found."""
    hinge = layout.holds.hinge.copy()
    hinge[np.array([kind == "arm" for kind in layout.holds.kind], dtype=np.bool_)] = result.arms.hinge
    return replace(layout, holds=replace(layout.holds, hinge=hinge))


def with_found_lengths(model: SpatialModel, result: FormResult) -> FloatArray:
    """Return the unknowns of a model's start with the found lengths, pulls and clamps."""
    z, droppers, layout = model.unknowns.start.copy(), result.droppers, model.layout
    z[model.length] = droppers.unstressed_length
    travel = np.array([wire.travel for wire in result.wires])
    for changed in (model.pull, model.piece):
        own = changed != NONE
        z[changed[own]] = travel[own]
    laid = np.array([chain.knots[-1] for chain in model.wires])
    by_mesh = laid / (laid + np.where(model.piece != NONE, travel, 0.0))  # pieces are told by natural length
    z[model.lower_s] = droppers.contact_coordinate * by_mesh[layout.droppers.lower]
    z[model.upper_s] = droppers.messenger_coordinate * by_mesh[layout.droppers.upper]
    z[model.hold_s] = result.supports.sliding_coordinate * by_mesh[layout.holds.wire]
    z[model.tie_s] = result.ties.coordinate * by_mesh[layout.ties.host]
    z[model.mass_s] = result.masses.coordinate * by_mesh[layout.masses.wire]
    return z
