"""A caution about meshes that are too coarse where wires bend, which neither audit nor rebuild can see."""

from __future__ import annotations

import math

from catenaria.line.line import Line

_COARSE = 2.0  # bending lengths; by default 0.1 m where wires bend within 0.14 m


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
    A wire under tension T bends within some lengths sqrt(EJ/T) of supports and clamps. Elements of twice that
    leave an error of 0.1 mm in dropper lengths, much longer ones millimetres.
    """
    mesh = line.solver.mesh
    length = min(mesh.fine, default=mesh.largest_element)
    if mesh.even is not None:
        length = sum(span.length for span in line.spans) / mesh.even
    length = min(length, mesh.largest_element) / mesh.refine
    wires = line.contact_wire, line.messenger_wire
    bending = min(math.sqrt(line.conductors[wire.conductor].EJ / wire.tension.force) for wire in wires)
    if length <= _COARSE * bending:
        return None
    return (
        f"Caution: wires bend within {bending:.2g} m of supports and clamps, where elements are "
        f"{length:.2g} m long. Neither audit nor rebuild sees what this does to the lengths: compare with "
        "--mesh refine=4."
    )
