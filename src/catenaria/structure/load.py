"""From a file to a `Structure`, or to a list of everything that is wrong with the file."""

from __future__ import annotations

from pathlib import Path

from catenaria.line.load import load_model
from catenaria.structure.structure import Structure


def load_structure(path: str | Path) -> Structure:
    """Read and check a structure file.

    Parameters
    ----------
    path : str or pathlib.Path
        A YAML file, or a JSON file with the suffix ``.json``.

    Returns
    -------
    Structure
        With every quantity in SI.

    Raises
    ------
    LineFileError
        With one `Fault` for each thing that is wrong, in the order of the file.
    """
    return load_model(path, Structure)
