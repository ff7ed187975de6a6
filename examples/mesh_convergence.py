"""Are the elements short enough? The same line on several meshes, compared with a much finer one.

    python examples/mesh_convergence.py

A wire bends within some decimetres of every support and clamp. Meshes that are graded towards these places
are compared with meshes of elements of about equal length.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from rich.console import Console
from rich.table import Table

from catenaria.line import Line, Mesh, load_line
from catenaria.workflow import solve

LINE = Path(__file__).with_name("yang2017_three_span.yaml")

# Only the fields that are given here replace those of the line.
MESHES = {
    "graded, as in the file": Mesh(),
    "graded, refine=2": Mesh(refine=2),
    "graded, refine=4": Mesh(refine=4),
    "even, up to 2.4 m": Mesh(fine=(), largest_element=2.4),
    "even, up to 1.2 m": Mesh(fine=(), largest_element=1.2),
    "even, up to 0.6 m": Mesh(fine=(), largest_element=0.6),
    "even, up to 0.3 m": Mesh(fine=(), largest_element=0.3),
}
REFERENCE = Mesh(refine=8)


@dataclass(frozen=True)
class Row:
    """What a mesh gives: work, and the largest differences from the reference."""

    mesh: str
    unknowns: int
    length: float  # of droppers, m
    force: float  # of droppers, N
    height: float  # of the messenger at droppers, m


def study(line: Line, meshes: Mapping[str, Mesh], reference: Mesh) -> list[Row]:
    """Solve a line on every mesh and compare dropper lengths, forces and messenger heights."""
    finest = solve(line, mesh=reference, rebuild="none").droppers
    rows: list[Row] = []
    for name, mesh in meshes.items():
        result = solve(line, mesh=mesh)
        found = result.droppers
        rows.append(
            Row(
                name,
                sum(counter.unknowns for counter in result.counters),
                float(np.max(np.abs(found.length - finest.length))),
                float(np.max(np.abs(found.force_bottom - finest.force_bottom))),
                float(np.max(np.abs(found.messenger_height - finest.messenger_height))),
            )
        )
    return rows


def main() -> None:
    """Print the study as a table."""
    title = "Largest differences from refine=8: dropper lengths and forces, messenger heights"
    table = Table("mesh", "unknowns", "length [mm]", "force [N]", "height [mm]", title=title)
    for row in study(load_line(LINE), MESHES, REFERENCE):
        length, height = (f"{1e3 * difference:.4f}" for difference in (row.length, row.height))
        table.add_row(row.mesh, str(row.unknowns), length, f"{row.force:.4f}", height)
    Console().print(table)


if __name__ == "__main__":
    main()
