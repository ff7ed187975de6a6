"""A synthetic network as a folder of line files."""

from __future__ import annotations

import os
from pathlib import Path

from ruamel.yaml import YAML

from catenaria.line.network import network
from catenaria.results import replace_folder


def write_network(count: int, seed: int, folder: str | os.PathLike[str]) -> tuple[Path, ...]:
    """Write the line files of a synthetic network into a folder, all of them or nothing.

    Parameters
    ----------
    count, seed : int
        As in `catenaria.line.network.network`.
    folder : path
        Where to; an earlier network in it is replaced, anything else is not touched.

    Returns
    -------
    tuple of Path
        The files.

    Raises
    ------
    InconsistentInputError
        If count or seed are out of range, or the folder holds something else.
    """
    documents = network(count, seed)
    yaml = YAML(typ="safe")
    yaml.default_flow_style = None  # the innermost mappings in one line each
    yaml.sort_base_mapping_type_on_output = False  # pyright: ignore[reportAttributeAccessIssue]  # has no types
    yaml.width = 110
    names: list[str] = []
    with replace_folder(folder) as new:
        for number, document in enumerate(documents, start=1):
            names.append(f"line_{number:04d}.yaml")
            yaml.dump(document, new / names[-1])  # pyright: ignore[reportUnknownMemberType]  # has no types
    return tuple(Path(folder) / name for name in names)
