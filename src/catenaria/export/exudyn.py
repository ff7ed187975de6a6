"""A script that builds the line in Exudyn, beside the neutral format from which it builds it."""

from __future__ import annotations

from importlib.resources import files
from pathlib import Path
from typing import Final

from catenaria.export.dynamics import MODES, write_dynamics
from catenaria.results import FormResult

SCRIPT: Final = "line_in_exudyn.py"


def write_exudyn(result: FormResult, folder: Path, modes: int = MODES) -> None:
    """Write the files of `write_dynamics`, and the script ``line_in_exudyn.py`` that needs nothing else.

    Raises
    ------
    UnsupportedError
        If the result comes from a method without nodes.
    """
    write_dynamics(result, folder, modes)
    script = files("catenaria.export").joinpath(SCRIPT).read_text(encoding="utf-8")
    (folder / SCRIPT).write_text(script, encoding="utf-8")
