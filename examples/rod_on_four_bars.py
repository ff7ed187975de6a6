"""Example 1 of Yang et al. 2017: how bars share the weight of a rod (section 4.1, Table 1, Figs. 9-11)."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from catenaria.results.structure import StructureForm, StructureHistory
from catenaria.structure import Structure, load_structure
from catenaria.workflow import solve_structure

FILE = Path(__file__).with_name("yang2017_rod.yaml")
BARS = (1, 2, 3, 4)
TABLE_1 = {"(30)": (45.03, 90.05, 135.08, 180.11), "paper": (45.18, 90.15, 135.03, 180.06)}  # N


def bar_forces(form: StructureForm) -> list[float]:
    """Return the forces with which the bars hold the rod [N]."""
    return [float(np.linalg.norm(form.force(f"P{bar}"))) for bar in BARS]


def with_rod_stiffness(structure: Structure, factor: float) -> Structure:
    """Return the structure with another bending stiffness of the rod."""
    description = structure.model_dump()
    description["sections"]["rod"]["bending_stiffness"] *= factor
    return Structure.model_validate(description)


def with_weight_of_bars(structure: Structure) -> Structure:
    """Return the structure with gravity on the bars too."""
    description = structure.model_dump()
    for cable in description["cables"].values():
        cable["weight"] = True
    return Structure.model_validate(description)


def table() -> pd.DataFrame:
    """Return Table 1 of the paper beside what was found here, and what makes the difference [N].

    Returns
    -------
    pandas.DataFrame
        One row for each bar. Columns: (30) and the paper's numbers; ``dynamic``: the paper's method;
        ``fixed tops``: statics without controls; ``pi d^4/64``: with the rod's true moment of area;
        ``rigid``: with a rod a thousand times as stiff; ``heavy bars``: with the weight of the bars;
        ``exact heights``: statics with all four heights met.
    """
    structure = load_structure(FILE)
    held = structure.without_controls()
    forms = {
        "dynamic": solve_structure(structure, "dynamic"),
        "fixed tops": solve_structure(held),
        "pi d^4/64": solve_structure(with_rod_stiffness(held, 0.5)),
        "rigid": solve_structure(with_rod_stiffness(held, 1e3)),
        "heavy bars": solve_structure(with_weight_of_bars(held)),
        "exact heights": solve_structure(structure),
    }
    columns = {**TABLE_1, **{name: bar_forces(form) for name, form in forms.items()}}
    return pd.DataFrame(columns, index=pd.Index(BARS, name="bar"))


def course(history: StructureHistory) -> Figure:
    """Draw heights, velocities of the tops and forces of the bars against time (Figs. 9-11)."""
    figure = Figure(figsize=(6.0, 7.0), layout="constrained")
    heights, velocities, forces = figure.subplots(3, 1, sharex=True)
    for bar in BARS:
        joint, control = history.joint_name.index(f"P{bar}"), history.control_name.index(f"height {bar}")
        force = np.linalg.norm(history.joint_force[:, joint], axis=1)
        heights.plot(history.time, 1e6 * history.joint_position[:, joint, 2], label=f"bar {bar}")
        velocities.plot(history.time, 1e6 * history.velocity[:, control])
        forces.plot(history.time, force)
    heights.set_ylabel("height of the rod (µm)")
    velocities.set_ylabel("velocity of the top (µm/s)")
    forces.set_ylabel("force (N)")
    forces.set_xlabel("time (s)")
    heights.legend()
    return figure


if __name__ == "__main__":
    from rich import print as show

    show(table().round(2))
    course(solve_structure(FILE, "dynamic").histories[0]).savefig("rod_on_four_bars.svg")
