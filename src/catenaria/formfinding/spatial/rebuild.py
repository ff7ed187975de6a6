"""Build what was found in space: given lengths, clamps and hinges must come to rest at the same state."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.spatial.built import with_found_hinges, with_found_lengths
from catenaria.discretise.spatial.demands import as_built, heights
from catenaria.discretise.spatial.guess import guess
from catenaria.discretise.spatial.lay_out import lay_out
from catenaria.discretise.spatial.model import SpatialModel, build_model
from catenaria.discretise.spatial.numbering import graded_meshes
from catenaria.errors import InfeasibleError, NotConvergedError, SingularError
from catenaria.formfinding.static_problem import find_rest
from catenaria.line import Line
from catenaria.mechanics.controls.track_height import TrackHeight
from catenaria.results.form import FormResult
from catenaria.results.rebuilt import Comeback, Rebuilt

FloatArray = NDArray[np.float64]

_ITERATIONS = 30
_LENGTH, _FORCE = 1e-5, 0.1  # m and N: what passes
_ADVICE = "the result as it is, without a rebuild (--rebuild none)"


class _Measured(NamedTuple):
    """Heights of both wires [m] and forces on the lower one [N] at droppers, reactions at wire ends [N]."""

    height: FloatArray
    upper_height: FloatArray
    force: FloatArray
    tension: FloatArray


def rebuild_in_space(line: Line, result: FormResult) -> Rebuilt:
    """Build a line in space from a result and let it come to rest by Newton's method from a taut string.

    Parameters
    ----------
    line : Line
        The line for which the form was found.
    result : FormResult
        What was found.

    Returns
    -------
    Rebuilt

    Raises
    ------
    NotConvergedError
        If the built line does not come to rest.
    """
    layout = lay_out(line)
    first = guess(layout)
    model = build_model(with_found_hinges(layout, result), first, graded_meshes(layout, first))
    z = with_found_lengths(model, result)
    iterations = 0
    try:
        for may_push in (
            True,
            False,
        ):  # bars that cannot push may be slack, and without stiffness, at the start
            root = find_rest(as_built(model, z, may_push=may_push), z, _ITERATIONS)
            z, iterations = root.y, iterations + root.iterations
            if np.all(z[model.density] > 0.0):
                break  # none would push
    except (NotConvergedError, SingularError) as error:
        raise NotConvergedError(f"the rebuilt line: {error.reason}", _ADVICE, error.partial) from error
    except InfeasibleError as error:
        raise NotConvergedError(f"the rebuilt line: {error}", _ADVICE) from error
    return _compare(_measure(model, z), iterations, result)


def _measure(model: SpatialModel, z: FloatArray) -> _Measured:
    on, frame = model.upper_carrier, model.layout.droppers.frame
    upper = TrackHeight(on, model.upper_s, on.locate(z[model.upper_s]), frame.origin, frame.up)
    force = model.bars(z, only_pull=True).loads(0.0, z)[0][:, 2]
    ties = model.layout.ties
    last = model.end_force[:, 1].copy()
    last[ties.wire[ties.end == 1]] = model.tie_force[ties.end == 1]
    tension = np.array([float(np.linalg.norm(force)) for force in z[last]])
    return _Measured(heights(model, z).value(0.0, z), upper.value(0.0, z), force, tension)


def _compare(rebuilt: _Measured, iterations: int, result: FormResult) -> Rebuilt:
    droppers, wires = result.droppers, result.wires
    before = _Measured(
        droppers.height,
        droppers.messenger_height,
        droppers.on_contact[:, 2],
        np.array([wire.reaction_end for wire in wires]),
    )
    limits = (_LENGTH, _LENGTH, _FORCE, _FORCE)
    height, upper_height, force, tension = (
        Comeback(after, after - found, np.full(after.size, limit))
        for after, found, limit in zip(rebuilt, before, limits, strict=True)
    )
    return Rebuilt(
        way="static",
        iterations=iterations,
        height=height,
        messenger_height=upper_height,
        force=force,
        tension=tension,
        height_error=rebuilt.height - droppers.target_height,
        tension_error=np.array([wire.tension_error for wire in wires]) + tension.change,
    )
