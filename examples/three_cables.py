"""Example 2 of Yang et al. 2017: the length of a cable between two others (section 4.2, Figs. 13-19)."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from catenaria.results.structure import StructureForm, StructureHistory
from catenaria.structure import Structure, load_structure
from catenaria.workflow import solve_structure

FILE = Path(__file__).with_name("yang2017_three_cables.yaml")
PAPER = {"force at A": 121.0, "force at D": 122.0, "height of A": 0.01, "height of D": 1.317, "length": 1.31}


def observed(form: StructureForm) -> dict[str, float]:
    """Return what the paper prints about its second example [N, m]."""
    A, D = form.position("A"), form.position("D")
    return {
        "force at A": float(np.linalg.norm(form.force("A"))),
        "force at D": float(np.linalg.norm(form.force("D"))),
        "height of A": float(A[2]),
        "height of D": float(D[2]),
        "length": float(np.linalg.norm(D - A)),
        "T1": float(np.linalg.norm(form.force("end of cable 1"))),
        "T2": float(np.linalg.norm(form.force("end of cable 2"))),
    }


def measured_as_in_the_paper(structure: Structure) -> Structure:
    """Return the structure with tensions taken from the strain at B and C, and tails of 0.1 m."""
    description = structure.model_dump()
    description["cables"]["cable 1"]["points"] = [(0, 0, 0), (25.1, 0, 0)]
    description["cables"]["cable 2"]["points"] = [(13, 0, 1.5), (2.9, 0, 1.5)]
    description["tensions"]["T1"] |= {"joint": "B", "measure": "strain"}
    description["tensions"]["T2"] |= {"joint": "C", "measure": "strain"}
    return Structure.model_validate(description)


def hinged(structure: Structure) -> Structure:
    """Return the structure with cables that end in hinges at B and C."""
    description = structure.model_dump()
    description["cables"]["cable 1"]["points"] = [(0, 0, 0), (25, 0, 0)]
    description["cables"]["cable 2"]["points"] = [(13, 0, 1.5), (3, 0, 1.5)]
    del description["joints"]["B"], description["joints"]["C"]
    return Structure.model_validate(description)


def rebuilt(structure: Structure, form: StructureForm) -> Structure:
    """Return the structure as it would be built: cables of the found lengths, no controls (Fig. 19).

    Cable 3 is one cable now. The structure is laid out straight and 10 mm too low at A and D, cables 1 and 2
    slightly stretched, and has to find its form by itself.
    """
    half = form.cable("cable 3 below")
    distance = float(form.position("D")[2] - form.position("A")[2])
    length = distance * half.unstressed_length / half.stretched_length
    layout = {
        "cable 1": [(0, 0, 0), (10, 0, 0), (25, 0, 0), tuple(form.position("end of cable 1"))],
        "cable 2": [(13, 0, 1.5), (10, 0, length), (3, 0, 1.5), tuple(form.position("end of cable 2"))],
        "cable 3": [(10, 0, 0), (10, 0, length)],
    }
    description = structure.model_dump()
    cables, joints = description["cables"], description["joints"]
    cables["cable 3"] = cables.pop("cable 3 below")
    del cables["cable 3 above"], joints["top"], joints["bottom"]
    for group in ("tensions", "heights", "balances"):
        description[group] = {}
    for name, points in layout.items():
        unstressed = length if name == "cable 3" else form.cable(name).unstressed_length
        cables[name] |= {"points": points, "unstressed_length": unstressed}
    joints["A"]["to"] = {"cable": "cable 3", "point": "start"}
    joints["D"]["to"] = {"cable": "cable 3", "point": "end"}
    for joint, cable, corner in (
        ("A", "cable 1", 1),
        ("B", "cable 1", 2),
        ("D", "cable 2", 1),
        ("C", "cable 2", 2),
    ):
        points = np.array(layout[cable])
        along = np.append(0.0, np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1)))
        joints[joint]["on"]["point"] = along[corner] / along[-1] * cables[cable]["unstressed_length"]
    return Structure.model_validate(description)


def table() -> pd.DataFrame:
    """Return the paper's numbers beside what was found here [N, m].

    Returns
    -------
    pandas.DataFrame
        Columns: ``paper``; ``direct`` and ``dynamic``: both methods; ``rebuilt``: the found structure relaxed
        without controls, as in Fig. 19; ``strain``: tensions measured as in the paper; ``hinged``: cables
        that end at B and C.
    """
    structure = load_structure(FILE)
    direct = solve_structure(structure)
    forms = {
        "direct": direct,
        "dynamic": solve_structure(structure, "dynamic"),
        "rebuilt": solve_structure(rebuilt(structure, direct), "dynamic"),
        "strain": solve_structure(measured_as_in_the_paper(structure)),
        "hinged": solve_structure(hinged(structure)),
    }
    return pd.DataFrame({"paper": PAPER, **{name: observed(form) for name, form in forms.items()}})


def course(history: StructureHistory, until: float = 150.0) -> Figure:
    """Draw tensions, forces of cable 3 and heights against time (Figs. 13-18; Fig. 19 if it is rebuilt)."""
    panels = {
        "tension (N)": {"T1": "end of cable 1", "T2": "end of cable 2"},
        "force of cable 3 (N)": {"A": "A", "D": "D"},
        "height (m)": {"A": "A", "D": "D"},
    }
    figure = Figure(figsize=(6.0, 7.0), layout="constrained")
    all_axes = figure.subplots(3, 1, sharex=True)
    for axes, (label, lines) in zip(all_axes, panels.items(), strict=True):
        for name, joint in lines.items():
            place = history.joint_name.index(joint)
            force = np.linalg.norm(history.joint_force[:, place], axis=1)
            axes.plot(
                history.time, history.joint_position[:, place, 2] if "height" in label else force, label=name
            )
        axes.set_ylabel(label)
        axes.legend()
    all_axes[-1].set_xlabel("time (s)")
    all_axes[-1].set_xlim(0.0, until)
    return figure


if __name__ == "__main__":
    from rich import print as show

    show(table().round(4))
    course(solve_structure(FILE, "dynamic").histories[0]).savefig("three_cables.svg")
