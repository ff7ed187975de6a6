"""Build what was found: a fresh model of the found lengths, which must come to rest at the same state.

The paper does it for its second example (Fig. 19). Here the whole line is built, without controls: dropper
bars of the found unstressed lengths, clamped where they were found, wire ends pulled as far as they were.
"""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.line_model import LineModel
from catenaria.errors import InfeasibleError, NotConvergedError, SingularError, UnsupportedError
from catenaria.formfinding.coupled import guess_line
from catenaria.formfinding.rebuild_allowance import Measured, allowance, measure
from catenaria.formfinding.relaxed_rebuild import rest_by_relaxation
from catenaria.formfinding.spatial.rebuild import rebuild_in_space
from catenaria.formfinding.static_rebuild import rest_statically
from catenaria.line import Line
from catenaria.results.form import FormResult
from catenaria.results.rebuilt import Comeback, Rebuilt

FloatArray = NDArray[np.float64]
Way = Literal["static", "relaxation"]

_ADVICE = "the other way to rebuild, or none, for the result as it is (--rebuild)"


def rebuild(line: Line, result: FormResult, way: Way = "static") -> Rebuilt:
    """Build a line from a result and let it come to rest.

    Parameters
    ----------
    line : Line
        The line for which the form was found.
    result : FormResult
        What was found, by any method.
    way : {"static", "relaxation"}
        Newton's method from a taut string, or from the found state if it fails; or dynamic relaxation from a
        disturbed taut string.

    Returns
    -------
    Rebuilt

    Raises
    ------
    NotConvergedError
        If the built line does not come to rest.
    """
    if not line.plane:
        if way != "static":
            raise UnsupportedError("lines in space are rebuilt by Newton's method only (--rebuild static)")
        return rebuild_in_space(line, result)
    model, z = _built(line, result)
    try:
        if way == "relaxation":
            at_rest, steps, said = *rest_by_relaxation(model, z), way
        else:
            at_rest, steps, said = rest_statically(model, z, result)
    except (NotConvergedError, SingularError) as error:
        raise NotConvergedError(f"the rebuilt line: {error.reason}", _ADVICE, error.partial) from error
    except InfeasibleError as error:
        raise NotConvergedError(f"the rebuilt line: {error}", _ADVICE) from error
    return _compare(model, at_rest, said, steps, result)


def _built(line: Line, result: FormResult) -> tuple[LineModel, FloatArray]:
    """Return the line near its equilibrium, with the found lengths, clamps and pulls."""
    droppers = result.droppers
    model, z = guess_line(line, (droppers.force_bottom, droppers.height))
    z[model.length] = droppers.unstressed_length
    z[model.contact.clamp_s] = droppers.contact_coordinate
    z[model.messenger.clamp_s] = droppers.messenger_coordinate
    for hung, form in zip((model.contact, model.messenger), result.wires, strict=True):
        z[hung.pull] = form.travel
    return model, z


def _compare(model: LineModel, z: FloatArray, way: str, iterations: int, result: FormResult) -> Rebuilt:
    droppers, wires = result.droppers, result.wires
    rebuilt, allowed = measure(model, z), allowance(model, z, result)
    found = Measured(
        droppers.height,
        droppers.messenger_height,
        droppers.force_bottom,
        np.array([wire.reaction_end for wire in wires]),
    )
    height, messenger_height, force, tension = (
        Comeback(after, after - before, limit)
        for after, before, limit in zip(rebuilt, found, allowed, strict=True)
    )
    return Rebuilt(
        way=way,
        iterations=iterations,
        height=height,
        messenger_height=messenger_height,
        force=force,
        tension=tension,
        height_error=rebuilt.height - droppers.target_height,
        # a strain at a support changes as the reaction does
        tension_error=np.array([wire.tension_error for wire in wires]) + tension.change,
    )
