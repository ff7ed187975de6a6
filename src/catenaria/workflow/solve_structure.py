"""From a free structure, or the file that describes it, to its form."""

from __future__ import annotations

from pathlib import Path

from catenaria.formfinding.progress import Listener, Progress
from catenaria.formfinding.structure_form import Method, find_structure
from catenaria.mechanics.kernels.warm_up import need_compiling, warm_up
from catenaria.results.structure import StructureForm
from catenaria.structure import Structure, load_structure


def solve_structure(
    structure: Structure | str | Path, method: Method = "direct", progress: Listener | None = None
) -> StructureForm:
    """Find the form of a structure of cables and rods.

    Parameters
    ----------
    structure : Structure or path
        The structure, or the YAML or JSON file that describes it.
    method : str
        ``direct`` or ``dynamic``.
    progress : callable, optional
        Receives a `Progress` after every time step.

    Returns
    -------
    StructureForm

    Raises
    ------
    LineFileError
        If the file cannot be used; the error lists every fault with its place.
    UnsupportedError
        If there is no such method.
    NotConvergedError
        If no equilibrium is found.
    """
    if not isinstance(structure, Structure):
        structure = load_structure(structure)
    if progress is not None and need_compiling():
        progress(Progress("compiling", 1, 1))
        warm_up()
    return find_structure(structure, method, progress)
