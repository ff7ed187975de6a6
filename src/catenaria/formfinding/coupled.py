"""The whole line at once: both wires and all droppers in one Newton iteration.

In the plane it must give what the staged direct method gives, as every dropper's height is prescribed; its
droppers are bars with unknown lengths instead of cables with driven ends.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from catenaria.catenary.green_bar import stretch
from catenaria.discretise.from_line import contact_wire_setup, messenger_wire_setup
from catenaria.discretise.guess import guess_wire
from catenaria.discretise.line_model import LineModel, build_line_model
from catenaria.discretise.tensioned_wire import TensionedWire
from catenaria.errors import UnsupportedError
from catenaria.formfinding.static_problem import find_rest
from catenaria.line import Line
from catenaria.solvers.newton import Root

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class CoupledForm:
    """The line in equilibrium with all targets met.

    Attributes
    ----------
    model : LineModel
        The line.
    z : FloatArray
        Its unknowns.
    length, unstressed_length : FloatArray, shape (n,)
        Distances of the wire axes at the droppers, and lengths of the droppers without force [m].
    on_contact, on_messenger : FloatArray, shape (n, 3)
        Forces of droppers and clamps on the wires [N].
    iterations : int
        Newton iterations.
    """

    model: LineModel
    z: FloatArray
    length: FloatArray
    unstressed_length: FloatArray
    on_contact: FloatArray
    on_messenger: FloatArray
    iterations: int


def find_coupled_form(line: Line) -> CoupledForm:
    """Find the form of a line with guided droppers all at once.

    Parameters
    ----------
    line : Line
        What the engineer describes.

    Returns
    -------
    CoupledForm

    Raises
    ------
    UnsupportedError
        If the dropper joints are frictionless.
    NotConvergedError
        If Newton's method does not converge.
    """
    if line.dropper.joint != "guided":
        raise UnsupportedError("the whole line at once is solved with guided dropper joints only")
    model, z = guess_line(line)
    return _form(model, find_rest(model.to_find(z), z))


def guess_line(line: Line, feet: tuple[FloatArray, FloatArray] | None = None) -> tuple[LineModel, FloatArray]:
    """Return the line and a first guess of its equilibrium: two taut wires with droppers between them.

    Parameters
    ----------
    line : Line
        What the engineer describes.
    feet : tuple of FloatArray, shape (n,) each, optional
        Forces of the droppers on the contact wire [N] and its heights there [m], if they are known: the guess
        and the messenger's mesh follow from them.
    """
    contact = contact_wire_setup(line)
    droppers = contact.droppers
    force, height = feet or (TensionedWire.of(contact).shape.force(droppers.x), droppers.target)
    model = build_line_model(contact, messenger_wire_setup(line, force, height))
    z = model.unknowns.start.copy()
    guess_wire(model.contact, z)
    guess_wire(model.messenger, z)
    z[model.length] = _distance(model, z) / stretch(force, droppers.section.EA)
    return model, z


def _distance(model: LineModel, z: FloatArray) -> FloatArray:
    """Return the distances between the clamps [m]."""
    below, above = (hung.wire.evaluate(z, z[hung.clamp_s]).r for hung in (model.contact, model.messenger))
    return np.linalg.norm(above - below, axis=1)


def _form(model: LineModel, root: Root) -> CoupledForm:
    z = root.y
    on_contact, on_messenger = model.droppers(z, clamped=False).loads(z)
    return CoupledForm(
        model, z, _distance(model, z), z[model.length], on_contact, on_messenger, root.iterations
    )
