"""The rebuilt line brought to rest by Newton's method."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.line_model import LineModel
from catenaria.errors import InfeasibleError, NotConvergedError, SingularError
from catenaria.formfinding.static_problem import find_rest
from catenaria.results.form import FormResult

FloatArray = NDArray[np.float64]

FROM_FOUND = "static, from the found state"

_ITERATIONS = 30


def rest_statically(model: LineModel, z: FloatArray, result: FormResult) -> tuple[FloatArray, int, str]:
    """Return where a line of given lengths is at rest.

    Parameters
    ----------
    model : LineModel
        The line.
    z : FloatArray, shape (n,)
        Its unknowns at a taut string; lengths, clamps and pulls are given by them.
    result : FormResult
        Where to start if there is no way from the taut string.

    Returns
    -------
    z : FloatArray, shape (n,)
        At rest.
    iterations : int
        Of Newton's method.
    way : str
        From where it was found.

    Raises
    ------
    NotConvergedError, InfeasibleError, SingularError
        If there is no way from the found state either.
    """
    try:
        return *_rest(model, z), "static"
    except (NotConvergedError, InfeasibleError, SingularError):
        return *_rest(model, _as_found(model, z, result)), FROM_FOUND


def _rest(model: LineModel, z: FloatArray) -> tuple[FloatArray, int]:
    """Return the line at rest and the number of Newton iterations."""
    iterations = 0
    for may_push in (True, False):  # bars that cannot push may be slack, and without stiffness, at the start
        root = find_rest(model.as_built(z, may_push), z, _ITERATIONS)
        z, iterations = root.y, iterations + root.iterations
    return z, iterations


def _as_found(model: LineModel, z: FloatArray, result: FormResult) -> FloatArray:
    """Return the state that the method found, with lengths, clamps and pulls as they are."""
    found, supports = z.copy(), result.supports
    force = np.column_stack((supports.force_x, supports.force_y, supports.force_z))
    wires = zip((model.contact, model.messenger), result.wires, result.stages, strict=True)
    for hung, form, stage in wires:
        held = np.array([wire == form.name for wire in supports.wire])
        count = int(stage.node_count[0])  # the wire's nodes; those of its dropper cables follow
        if count != hung.wire.knots.size:
            raise NotConvergedError("the found state has another mesh", "to solve the line again")
        found[hung.wire.nodes] = np.hstack((stage.position[:count], stage.slope[:count]))
        found[hung.support_s], found[hung.support_force] = supports.sliding_coordinate[held], force[held]
        found[hung.end_force] = form.end_force
    return found
