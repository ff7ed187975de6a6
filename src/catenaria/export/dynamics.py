"""The initial state for dynamics codes: a found line at rest, neutrally described, with matrices and modes.

The format is described in ``docs/theory/dynamics_format.md``.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.read_back import element_tension
from catenaria.export.joints import first_nodes, joints
from catenaria.export.resting import RestingLine
from catenaria.export.tangent import sparse
from catenaria.export.vibrations import Vibrations, vibrations
from catenaria.line import Line
from catenaria.results import FormResult

FloatArray = NDArray[np.float64]

FORMAT: Final = "catenaria dynamics model"
VERSION: Final = 1
MODES: Final = 20


def write_dynamics(result: FormResult, folder: Path, modes: int = MODES) -> None:
    """Write a found line at rest for dynamics codes.

    Parameters
    ----------
    result : FormResult
        What was found.
    folder : path
        An existing folder, which gets ``model.json``, ``arrays.npz``, ``mass.npz``, ``stiffness.npz``,
        ``constraints.npz``, ``compliance.npz`` and ``modes.npz``.
    modes : int
        How many natural modes; the line may have fewer coordinates.

    Raises
    ------
    UnsupportedError
        If the result comes from a method without nodes.
    InconsistentInputError, InfeasibleError
        If the line has no such modes.
    """
    rest = RestingLine.of(Line.model_validate(result.inputs), result)
    found = vibrations(rest, modes)
    arrays = dynamics_arrays(rest)
    text = json.dumps(dynamics_model(rest, found), indent=1, ensure_ascii=False, allow_nan=False)
    (folder / "model.json").write_text(text + "\n", encoding="utf-8")
    np.savez(folder / "arrays.npz", **arrays)  # pyright: ignore[reportArgumentType]  # numpy's own keyword
    np.savez(folder / "modes.npz", frequency=found.frequency, shape=found.shape)
    tangent = rest.tangent
    matrices = {"mass": tangent.M, "stiffness": tangent.K, "constraints": tangent.C, "compliance": tangent.D}
    for name, matrix in matrices.items():
        sparse.save_npz(folder / f"{name}.npz", matrix)


def dynamics_model(rest: RestingLine, found: Vibrations) -> dict[str, Any]:
    """Return the content of ``model.json``."""
    force, constraint = rest.residual
    nodes = int(first_nodes(rest)[-1])
    return {
        "format": FORMAT,
        "version": VERSION,
        "line": rest.result.name,
        "method": rest.result.method,
        "units": "m, kg, s, N",
        "gravity": rest.model.layout.g,
        "strain": "Green",
        "counts": {
            "nodes": nodes,
            "sliding_coordinates": rest.coordinates.size - 6 * nodes,
            "coordinates": rest.coordinates.size,
            "constraints": rest.multipliers.size,
            "droppers": rest.slack.size,
        },
        "residual_at_rest": {"force": force, "constraint": constraint},
        "wires": _wires(rest),
        "joints": joints(rest),
        "mass_kinds": list(rest.lumps.kind),
        "frequencies": found.frequency.tolist(),
    }


def _wires(rest: RestingLine) -> list[dict[str, Any]]:
    """Return wires, then cantilevers, as strands of nodes and elements."""
    layout = rest.model.layout
    wires = [
        {"name": laid.name, "role": laid.role, "tension": form.tension, "tension_target": form.target_tension}
        for laid, form in zip(layout.wires, rest.result.wires, strict=True)
    ]
    supports = rest.result.supports.support
    beams = [
        {"name": f"cantilever {supports[part.hold]}", "role": "cantilever", "tension": None}
        for part in layout.cantilevers
    ]
    first = first_nodes(rest).tolist()
    return [
        own
        | {
            "first_node": first[k],
            "nodes": chain.knots.size,
            "first_element": first[k] - k,
            "unstressed_length": float(chain.knots[-1]),
            "EA": chain.section.EA,
            "EJ": chain.section.EJ,
            "rhoA": chain.section.rhoA,
        }
        for k, (own, chain) in enumerate(zip([*wires, *beams], rest.strands, strict=True))
    ]


def dynamics_arrays(rest: RestingLine) -> dict[str, NDArray[Any]]:
    """Return the content of ``arrays.npz``."""
    nodes = np.concatenate([chain.nodes for chain in rest.strands])
    return {
        "coordinates": rest.z[rest.coordinates],
        "constraint_force": rest.constraint_force,
        "load": rest.load,
        "node_position": rest.z[nodes[:, :3]],
        "node_slope": rest.z[nodes[:, 3:]],
        "node_coordinate": np.concatenate([chain.knots for chain in rest.strands]),
        "node_wire": np.repeat(np.arange(len(rest.strands)), [chain.knots.size for chain in rest.strands]),
        **_element_arrays(rest),
        **_dropper_arrays(rest),
        "mass_wire": rest.lumps.carrier.of,
        "mass_coordinate": rest.lumps.s,
        "mass_inertia": rest.lumps.mass,
        "mass_weight": rest.lumps.weight,
    }


def _element_arrays(rest: RestingLine) -> dict[str, NDArray[Any]]:
    strands, first = rest.strands, first_nodes(rest)
    count = [chain.L.size for chain in strands]
    start = np.concatenate([first[k] + np.arange(n) for k, n in enumerate(count)])
    return {
        "element_nodes": np.column_stack((start, start + 1)),
        "element_wire": np.repeat(np.arange(len(strands)), count),
        "element_length": np.concatenate([chain.L for chain in strands]),
        "element_EA": np.repeat([chain.section.EA for chain in strands], count),
        "element_EJ": np.repeat([chain.section.EJ for chain in strands], count),
        "element_rhoA": np.repeat([chain.section.rhoA for chain in strands], count),
        "element_tension": np.concatenate([element_tension(chain, rest.z) for chain in strands]),
    }


def _dropper_arrays(rest: RestingLine) -> dict[str, NDArray[Any]]:
    model, z = rest.model, rest.z
    droppers = model.layout.droppers
    return {
        "dropper_lower_wire": droppers.lower,
        "dropper_upper_wire": droppers.upper,
        "dropper_lower_coordinate": z[model.lower_s],
        "dropper_upper_coordinate": z[model.upper_s],
        "dropper_length": z[model.length],
        "dropper_flexibility": droppers.flexibility,
        "dropper_force": z[model.density] * rest.dropper_reach,
        "dropper_slack": rest.slack,
        "dropper_span": rest.result.droppers.span,
        "dropper_number": rest.result.droppers.number,
    }
