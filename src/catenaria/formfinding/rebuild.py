"""Build what was found: a fresh model of the found lengths, which must come to rest at the same state.

The paper does it for its second example (Fig. 19). Here the whole line is built, without controls: dropper
bars of the found unstressed lengths, clamped where they were found, wire ends pulled as far as they were.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.line_model import LineModel
from catenaria.errors import NotConvergedError
from catenaria.formfinding.coupled import guess_line
from catenaria.formfinding.static_problem import find_rest
from catenaria.line import Line
from catenaria.results.form import FormResult

FloatArray = NDArray[np.float64]

_ITERATIONS = 50


@dataclass(frozen=True)
class Rebuilt:
    """Where the rebuilt line came to rest.

    Attributes
    ----------
    height, messenger_height : FloatArray, shape (n,)
        Heights of the two wires at the droppers [m].
    force : FloatArray, shape (n,)
        Vertical forces of the droppers on the contact wire [N].
    tension : FloatArray, shape (2,)
        Reactions at the ends of contact wire and messenger [N].
    height_change, messenger_height_change, force_change, tension_change : FloatArray
        The same minus what the method had returned.
    height_error : FloatArray, shape (n,)
        Height of the contact wire minus the wanted one [m].
    iterations : int
        Newton iterations from a taut-string start.
    """

    height: FloatArray
    messenger_height: FloatArray
    force: FloatArray
    tension: FloatArray
    height_change: FloatArray
    messenger_height_change: FloatArray
    force_change: FloatArray
    tension_change: FloatArray
    height_error: FloatArray
    iterations: int


def rebuild(line: Line, result: FormResult) -> Rebuilt:
    """Build a line from a result and let it come to rest.

    Parameters
    ----------
    line : Line
        The line for which the form was found.
    result : FormResult
        What was found, by any method.

    Returns
    -------
    Rebuilt

    Raises
    ------
    NotConvergedError
        If the built line has no equilibrium near a taut string.
    """
    model, z = guess_line(line)
    droppers = result.droppers
    z[model.length] = droppers.unstressed_length
    z[model.contact.clamp_s] = droppers.contact_coordinate
    z[model.messenger.clamp_s] = droppers.messenger_coordinate
    for hung, form in zip((model.contact, model.messenger), result.wires, strict=True):
        z[hung.pull] = form.travel
    iterations = 0
    for may_push in (True, False):  # bars that cannot push may be slack, and without stiffness, at the start
        try:
            root = find_rest(model.as_built(z, may_push), z, _ITERATIONS)
        except NotConvergedError as error:
            reason, advice = f"the rebuilt line: {error.reason}", "checking the found lengths"
            raise NotConvergedError(reason, advice, error.partial) from error
        z, iterations = root.y, iterations + root.corrections.size
    return _compare(model, z, iterations, result)


def _compare(model: LineModel, z: FloatArray, iterations: int, result: FormResult) -> Rebuilt:
    droppers = result.droppers
    wires = (model.contact, model.messenger)
    height, messenger_height = (hung.wire.evaluate(z, z[hung.clamp_s]).r[:, 2] for hung in wires)
    force = model.droppers(z, clamped=True).loads(z)[0][:, 2]
    tension = np.array([float(np.linalg.norm(z[hung.end_force[1]])) for hung in wires])
    return Rebuilt(
        height,
        messenger_height,
        force,
        tension,
        height - droppers.height,
        messenger_height - droppers.messenger_height,
        force - droppers.force_bottom,
        tension - np.array([form.reaction_end for form in result.wires]),
        height - droppers.target_height,
        iterations,
    )
