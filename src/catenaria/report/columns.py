"""The columns of every table of a result, in full precision, named with the unit as suffix."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from catenaria.results import FormResult, History

Columns = dict[str, Sequence[Any] | NDArray[Any]]


def dropper_columns(result: FormResult) -> Columns:
    """Return the columns of ``droppers.csv``: one row for each dropper."""
    droppers = result.droppers
    return {
        "span": droppers.span,
        "dropper": droppers.number,
        "x_m": droppers.x,
        "length_m": droppers.length,
        "cut_length_m": droppers.cut_length,
        "unstressed_length_m": droppers.unstressed_length,
        "force_top_N": droppers.force_top,
        "force_bottom_N": droppers.force_bottom,
        "height_m": droppers.height,
        "target_height_m": droppers.target_height,
        "height_error_m": droppers.height_error,
        "messenger_height_m": droppers.messenger_height,
        "force_error_N": droppers.force_error,
        "chainage_m": droppers.x,
        "upper_wire": droppers.upper_wire,
        "lower_wire": droppers.lower_wire,
        "stagger_top_m": droppers.stagger_top,
        "stagger_bottom_m": droppers.stagger_bottom,
        "inclination_deg": np.degrees(droppers.inclination),
        "slack": droppers.slack,
        "reference_temperature_degC": np.full(droppers.x.size, float(result.inputs["reference_temperature"])),
    }


def wire_columns(result: FormResult) -> Columns:
    """Return the columns of ``wires.csv``: one row for each wire."""
    wires = result.wires
    return {
        "wire": [wire.name for wire in wires],
        "unstressed_length_m": [wire.unstressed_length for wire in wires],
        "stretched_length_m": [wire.stretched_length for wire in wires],
        "tension_target_N": [wire.target_tension for wire in wires],
        "tension_N": [wire.tension for wire in wires],
        "tension_error_N": [wire.tension_error for wire in wires],
        "tension_measure": [wire.measure for wire in wires],
        "horizontal_start_N": [wire.horizontal_start for wire in wires],
        "horizontal_end_N": [wire.horizontal_end for wire in wires],
        "reaction_start_N": [wire.reaction_start for wire in wires],
        "reaction_end_N": [wire.reaction_end for wire in wires],
        "tension_min_N": [wire.tension_min for wire in wires],
        "tension_max_N": [wire.tension_max for wire in wires],
        "tension_mean_N": [wire.tension_mean for wire in wires],
        "travel_m": [wire.travel for wire in wires],
        "sag_m": [wire.sag for wire in wires],
        "role": [wire.role for wire in wires],
    }


def support_columns(result: FormResult) -> Columns:
    """Return the columns of ``supports.csv``: one row for each wire held at each support."""
    supports = result.supports
    return {
        "support": supports.support,
        "wire": supports.wire,
        "x_m": supports.x,
        "z_m": supports.z,
        "force_x_N": supports.force_x,
        "force_y_N": supports.force_y,
        "force_z_N": supports.force_z,
        "strain_tension_N": supports.tension,
        "sliding_coordinate_m": supports.sliding_coordinate,
        "y_m": supports.y,
        "kind": supports.kind,
        "chainage_m": supports.chainage,
        "stagger_m": supports.stagger,
        "height_m": supports.height,
        "force_lateral_N": supports.force_lateral,
    }


def control_columns(result: FormResult) -> Columns:
    """Return the columns of ``controls.csv``: one row for each control, whose unit stands in a column."""
    controls = result.controls
    return {
        "control": controls.name,
        "unit": controls.unit,
        "target": controls.target,
        "value": controls.value,
        "error": controls.error,
        "dead_band": controls.dead_band,
        "parameter_m": controls.parameter,
    }


def counter_columns(result: FormResult) -> Columns:
    """Return the columns of ``counters.csv``: one row for each dynamic step."""
    counters = result.counters
    return {
        "step": [counter.step for counter in counters],
        "simulated_time_s": [counter.simulated_time for counter in counters],
        "wall_time_s": [counter.wall_time for counter in counters],
        "steps": [counter.steps for counter in counters],
        "rejected": [counter.rejected for counter in counters],
        "newton_failures": [counter.newton_failures for counter in counters],
        "residuals": [counter.residuals for counter in counters],
        "jacobians": [counter.jacobians for counter in counters],
        "factorisations": [counter.factorisations for counter in counters],
        "unknowns": [counter.unknowns for counter in counters],
    }


def configuration_columns(result: FormResult) -> Columns:
    """Return the columns of ``configuration.csv``: one row for each point along each wire."""
    fields = {
        "s_m": "s",
        "x_m": "x",
        "y_m": "y",
        "z_m": "z",
        "tension_N": "tension",
        "strain_tension_N": "strain_tension",
        "horizontal_N": "horizontal",
        "moment_Nm": "moment",
        "chainage_m": "chainage",
        "lateral_m": "lateral",
        "height_m": "height",
    }
    profiles = [wire.profile for wire in result.wires]
    columns: Columns = {"wire": [wire.name for wire in result.wires for _ in wire.profile.s]}
    for column, field in fields.items():
        columns[column] = np.concatenate([getattr(profile, field) for profile in profiles])
    return columns


def history_columns(result: FormResult) -> Columns:
    """Return the columns of ``history.csv``: both dynamic steps below each other, one row for each time step.

    A control or a joint that takes part in one step only is NaN in the rows of the other.
    """
    parts = [_step_columns(history) for history in result.histories]
    names = list(dict.fromkeys(name for part in parts for name in part))
    lengths = [len(history.time) for history in result.histories]
    columns: Columns = {"step": [history.step for history in result.histories for _ in history.time]}
    for name in names:
        pieces = [part.get(name, np.full(n, np.nan)) for part, n in zip(parts, lengths, strict=True)]
        columns[name] = np.concatenate(pieces)
    return columns


def _step_columns(history: History) -> dict[str, NDArray[Any]]:
    columns: dict[str, NDArray[Any]] = {
        "time_s": history.time,
        "step_size_s": history.step_size,
        "order": history.order,
        "kinetic_J": history.kinetic,
        "axial_J": history.axial,
        "bending_J": history.bending,
        "reaction_start_N": history.reaction[:, 0],
        "reaction_end_N": history.reaction[:, 1],
    }
    for joint, tension in zip(history.joint_name, history.joint_tension.T, strict=True):
        columns[f"tension at {joint}_N"] = tension
    for i, (control, unit) in enumerate(zip(history.control_name, history.control_unit, strict=True)):
        columns[f"{control} error_{unit}"] = history.error[:, i]
        columns[f"{control} parameter_m"] = history.parameter[:, i]
        columns[f"{control} velocity_m_per_s"] = history.velocity[:, i]
    return columns
