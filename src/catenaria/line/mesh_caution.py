"""A caution about meshes that are too coarse where wires bend, which neither audit nor rebuild can see."""

from __future__ import annotations

import math
from typing import Final

from catenaria.line.line import Line

_COARSE: Final = 0.36  # m: square of an element's length per bending length


def mesh_caution(line: Line) -> str | None:
    """Return what to say about a mesh whose elements beside supports and clamps are too long, if they are.

    Parameters
    ----------
    line : Line
        With its mesh.

    Returns
    -------
    str or None

    Notes
    -----
    A wire under tension T bends within some lengths b = sqrt(EJ/T) of supports and clamps. Elements of length
    h there leave an error in dropper lengths that grows like h^2/b. In the line of Yang et al. 2017 it was
    about 0.05 mm where h^2/b is 0.36 m, for b from 0.012 to 0.144 m.
    """
    mesh = line.solver.mesh
    length = min(mesh.fine, default=mesh.largest_element)
    if mesh.even is not None:
        length = sum(span.length for span in line.spans) / mesh.even
    length = min(length, mesh.largest_element) / mesh.refine
    wires = [line.contact_wire, line.messenger_wire]
    wires += [line.auxiliary_messenger] if line.auxiliary_messenger is not None else []
    bending = min(math.sqrt(line.conductor(wire.conductor).EJ / wire.tension.on_wire) for wire in wires)
    if length**2 <= _COARSE * bending:
        return None
    return (
        f"Caution: wires bend within {bending:.2g} m of supports and clamps, where elements are "
        f"{length:.2g} m long. Neither audit nor rebuild sees what this does to the lengths: compare with "
        "--mesh refine=4."
    )
