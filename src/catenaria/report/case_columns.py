"""The columns of the tables of load cases, in full precision, named with the unit as suffix."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from catenaria.report.columns import Columns
from catenaria.results.case import CaseResult, LineState, LoadStudy

FloatArray = NDArray[np.float64]

NARROW, WIDE = 0.40, 0.55  # m to which pantograph heads of 1600 and 1950 mm allow a contact wire (TSI ENE)


def case_columns(study: LoadStudy) -> Columns:
    """Return the columns of ``cases.csv``: one row for each case, the line as it was built first."""
    rows = [_case_row(study, None), *(_case_row(study, case) for case in study.cases)]
    columns: Columns = {name: [row[name] for row in rows] for name in rows[0]}
    return columns


def _case_row(study: LoadStudy, case: CaseResult | None) -> dict[str, str | float]:
    state = study.before if case is None else case.state
    contact = [wire for wire in state.wires if wire.role == "contact wire"]
    inside = [_between_supports(state, wire.name, wire.chainage) for wire in contact]
    heights = np.concatenate([wire.height[mask] for wire, mask in zip(contact, inside, strict=True)])
    lateral = np.concatenate([wire.lateral[mask] for wire, mask in zip(contact, inside, strict=True)])
    furthest = float(np.abs(lateral).max())
    force = state.droppers.force[~state.droppers.broken]
    blown = None if case is None or not case.blow_off.wire else case.blow_off
    row: dict[str, str | float] = {
        "case": "as built" if case is None else case.name,
        "warming_K": 0.0 if case is None else case.warming,
        "temperature_degC": study.reference_temperature + (0.0 if case is None else case.warming),
        "lowest_contact_wire_m": float(heights.min()),
        "highest_contact_wire_m": float(heights.max()),
        "largest_lateral_m": furthest,
        "within_400_mm": str(furthest <= NARROW),
        "within_550_mm": str(furthest <= WIDE),
        "support_uplift_m": float(support_uplift(study.before, state).max(initial=0.0)),
        "push_uplift_m": float("nan") if case is None else _largest(case.pushed.uplift),
        "slack_droppers": str(int(state.droppers.slack.sum())),
        "dropper_force_min_N": float(force.min()) if force.size else float("nan"),
        "dropper_force_max_N": float(force.max()) if force.size else float("nan"),
        "textbook_lateral_m": float("nan") if blown is None else _largest(np.abs(blown.alone)),
        "textbook_error_m": float("nan") if blown is None else _largest(np.abs(blown.alone - blown.solved)),
    }
    for wire, was in zip(state.wires, study.before.wires, strict=True):
        if wire.role not in ("stitch wire", "mid-point anchor"):
            column = wire.name.replace(" ", "_")
            row[f"{column}_stroke_m"] = wire.travel - was.travel
            row[f"{column}_tension_min_N"] = wire.tension_min
            row[f"{column}_tension_max_N"] = wire.tension_max
    return row


def support_uplift(before: LineState, after: LineState) -> FloatArray:
    """Return by how much contact wires are higher at their supports than before [m]."""
    roles = {wire.name: wire.role for wire in before.wires}
    contact = np.array([roles[name] == "contact wire" for name in before.supports.wire], dtype=np.bool_)
    return (after.supports.height - before.supports.height)[contact]


def _between_supports(state: LineState, wire: str, chainage: FloatArray) -> NDArray[np.bool_]:
    held = np.array([name == wire for name in state.supports.wire], dtype=np.bool_)
    at = state.supports.chainage[held]
    return (chainage >= at.min()) & (chainage <= at.max())


def _largest(values: FloatArray) -> float:
    return float(values.max()) if values.size else float("nan")


def dropper_columns(study: LoadStudy, case: CaseResult) -> Columns:
    """Return the columns of a case's ``droppers.csv``: one row for each dropper."""
    before, after = study.before.droppers, case.state.droppers
    return {
        "span": after.span,
        "dropper": after.number,
        "lower_wire": after.lower_wire,
        "upper_wire": after.upper_wire,
        "chainage_m": after.chainage,
        "height_before_m": before.height,
        "height_m": after.height,
        "rise_m": after.height - before.height,
        "lateral_before_m": before.lateral,
        "lateral_m": after.lateral,
        "force_before_N": before.force,
        "force_N": after.force,
        "slack": after.slack,
        "broken": after.broken,
    }


def wire_columns(study: LoadStudy, case: CaseResult) -> Columns:
    """Return the columns of a case's ``wires.csv``: one row for each wire."""
    pairs = list(zip(study.before.wires, case.state.wires, strict=True))
    return {
        "wire": [wire.name for wire in case.state.wires],
        "role": [wire.role for wire in case.state.wires],
        "tension_min_before_N": [was.tension_min for was, _ in pairs],
        "tension_max_before_N": [was.tension_max for was, _ in pairs],
        "tension_min_N": [wire.tension_min for wire in case.state.wires],
        "tension_max_N": [wire.tension_max for wire in case.state.wires],
        "force_start_N": [wire.force_start for wire in case.state.wires],
        "force_end_N": [wire.force_end for wire in case.state.wires],
        "stroke_m": [wire.travel - was.travel for was, wire in pairs],
        "load_x_N": case.load[:, 0],
        "load_y_N": case.load[:, 1],
        "load_z_N": case.load[:, 2],
    }


def support_columns(study: LoadStudy, case: CaseResult) -> Columns:
    """Return the columns of a case's ``supports.csv``: one row for each wire held at each support."""
    before, after = study.before.supports, case.state.supports
    return {
        "support": after.support,
        "wire": after.wire,
        "kind": after.kind,
        "chainage_m": after.chainage,
        "height_m": after.height,
        "uplift_m": after.height - before.height,
        "stagger_m": after.stagger,
        "moved_left_m": after.stagger - before.stagger,
        "force_x_N": after.force_x,
        "force_y_N": after.force_y,
        "force_z_N": after.force_z,
        "force_lateral_N": after.force_lateral,
        "force_lateral_before_N": before.force_lateral,
    }


def arm_columns(study: LoadStudy, case: CaseResult) -> Columns:
    """Return the columns of a case's ``arms.csv``: one row for each steady arm."""
    before, after = study.before.arms, case.state.arms
    return {
        "support": after.support,
        "wire": after.wire,
        "registration": after.registration,
        "axial_N": after.axial,
        "radial_before_N": before.radial,
        "radial_N": after.radial,
        "vertical_N": after.vertical,
        "angle_before_deg": np.degrees(before.angle),
        "angle_deg": np.degrees(after.angle),
    }


def span_columns(study: LoadStudy, case: CaseResult) -> Columns:
    """Return the columns of a case's ``spans.csv``: one row for each contact wire and span."""
    extremes = case.extremes
    return {
        "wire": extremes.wire,
        "span": extremes.span,
        "lowest_chainage_m": extremes.lowest_chainage,
        "lowest_height_m": extremes.lowest_height,
        "lateral_chainage_m": extremes.lateral_chainage,
        "lateral_m": extremes.lateral,
        "within_400_mm": np.abs(extremes.lateral) <= NARROW,
        "within_550_mm": np.abs(extremes.lateral) <= WIDE,
    }


def blow_off_columns(study: LoadStudy, case: CaseResult) -> Columns:
    """Return the columns of a case's ``blow_off.csv``: one row for each contact wire and span under wind."""
    blown = case.blow_off
    return {
        "wire": blown.wire,
        "span": blown.span,
        "start_m": blown.start,
        "length_m": blown.length,
        "stagger_start_m": blown.stagger_start,
        "stagger_end_m": blown.stagger_end,
        "curvature_per_m": blown.curvature,
        "load_N_per_m": blown.load,
        "tension_N": blown.tension,
        "combined_load_N_per_m": blown.combined_load,
        "combined_tension_N": blown.combined_tension,
        "lateral_alone_m": blown.alone,
        "lateral_combined_m": blown.combined,
        "lateral_solved_m": blown.solved,
        "alone_error_m": blown.alone - blown.solved,
        "combined_error_m": blown.combined - blown.solved,
    }


def push_columns(study: LoadStudy, case: CaseResult) -> Columns:
    """Return the columns of a case's ``pushes.csv``: one row for each push."""
    pushed = case.pushed
    return {
        "wire": pushed.wire,
        "chainage_m": pushed.chainage,
        "force_N": pushed.force,
        "uplift_m": pushed.uplift,
    }


def configuration_columns(study: LoadStudy, case: CaseResult) -> Columns:
    """Return the columns of a case's ``configuration.csv``: one row for each point along each wire."""
    wires = case.state.wires
    return {
        "wire": [wire.name for wire in wires for _ in wire.s],
        "s_m": np.concatenate([wire.s for wire in wires]),
        "chainage_m": np.concatenate([wire.chainage for wire in wires]),
        "lateral_m": np.concatenate([wire.lateral for wire in wires]),
        "height_m": np.concatenate([wire.height for wire in wires]),
        "tension_N": np.concatenate([wire.tension for wire in wires]),
    }
