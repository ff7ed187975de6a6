"""What was found for a line in space, as a result, unless it cannot be built."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.spatial.model import SpatialModel
from catenaria.discretise.spatial.read_back import Found, read_back
from catenaria.errors import InfeasibleError, some
from catenaria.formfinding.spatial.at_rest import dropper_names
from catenaria.formfinding.versions import versions
from catenaria.line import Line
from catenaria.results.form import Counters, FormResult, History

FloatArray = NDArray[np.float64]

_NOTHING: Final = 1e-6  # N/m by which a dropper may push that hangs slack
_COMPRESSION: Final = (
    "The wanted heights are below where the tension lets the lower wire hang: a smaller pre-sag, less "
    "tension or other dropper positions would help"
)
_KINK: Final = ", and so would a longer rounding where the slope of the track changes beside them"
_UPSIDE_DOWN: Final = "The upper wire sags below the lower one: more tension or higher supports would help"
_SHORT: Final = "The clamps bridge more than there is between the wires: check the clamp heights"


def gather(
    line: Line,
    model: SpatialModel,
    z: FloatArray,
    method: str,
    reason: str,
    counters: tuple[Counters, ...],
    history: tuple[History, ...] = (),
    bands: tuple[float, ...] | None = None,
) -> FormResult:
    """Return all that was found.

    Parameters
    ----------
    line : Line
        The line.
    model : SpatialModel
        What was solved.
    z : FloatArray
        Its unknowns at rest.
    method, reason : str
        Name of the method, and why it stopped.
    counters, history
        Work, and the course of the motion if there was one.
    bands : tuple of float, optional
        Dead bands of all tensions and of the heights.

    Raises
    ------
    InfeasibleError
        Naming droppers that would be in compression, upside down or without length, and what would help.
    """
    found = read_back(line, model, z, bands)
    _refuse_impossible(line, model, z, found)
    return FormResult(
        name=line.name,
        method=method,
        stop_reason=reason,
        droppers=found.droppers,
        wires=found.wires,
        supports=found.supports,
        arms=found.arms,
        ties=found.ties,
        masses=found.masses,
        cantilevers=found.cantilevers,
        controls=found.controls,
        histories=history,
        counters=counters,
        stages=(found.stage,),
        inputs=line.model_dump(mode="json"),
        versions=versions(),
    )


def _refuse_impossible(line: Line, model: SpatialModel, z: FloatArray, found: Found) -> None:
    droppers, names = found.droppers, dropper_names(model)
    rise = droppers.position_top[:, 2] - droppers.position_bottom[:, 2]
    weakest = np.minimum(droppers.force_top, droppers.force_bottom)
    may_be_slack = model.layout.droppers.may_be_slack
    pushes = (weakest < 0.0) & (not may_be_slack or z[model.density] < -_NOTHING)
    why = _COMPRESSION
    if line.track.gradients:
        why += _KINK
    for size, wrong, unit, what, advice in (
        (rise, rise <= 0.0, "m", "would stand upside down", _UPSIDE_DOWN),
        (weakest, pushes, "N", "would be in compression", why),
        (droppers.cut_length, droppers.cut_length <= 0.0, "m", "would be cut to nothing", _SHORT),
    ):
        if np.any(wrong):
            named = [f"{names[i]} ({size[i]:.4g} {unit})" for i in np.flatnonzero(wrong)]
            raise InfeasibleError(f"droppers {what}: {some(named)}. {advice}", found)
