"""The columns of the tables that only lines in space have: arms, ties, masses, cantilevers."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from catenaria.report.columns import Columns
from catenaria.results import FormResult


def arm_columns(result: FormResult) -> Columns:
    """Return the columns of ``arms.csv``: one row for each steady arm."""
    arms = result.arms
    return {
        "support": arms.support,
        "wire": arms.wire,
        "registration": arms.registration,
        "chainage_m": arms.chainage,
        "hinge_stagger_m": arms.hinge_stagger,
        "hinge_height_m": arms.hinge_height,
        "length_m": arms.length,
        "angle_deg": np.degrees(arms.angle),
        "axial_N": arms.axial,
        "radial_N": arms.radial,
        "vertical_N": arms.vertical,
        "minimum_radial_N": arms.minimum_radial,
        "enough": arms.enough,
        **_places("hinge", arms.hinge),
        **_places("tip", arms.tip),
    }


def tie_columns(result: FormResult) -> Columns:
    """Return the columns of ``ties.csv``: one row for each end of a wire that is clamped to another wire."""
    ties = result.ties
    return {
        "wire": ties.wire,
        "end": np.array(("start", "end"))[ties.end],
        "host": ties.host,
        "chainage_m": ties.chainage,
        "coordinate_m": ties.coordinate,
        "force_x_N": ties.force[:, 0],
        "force_y_N": ties.force[:, 1],
        "force_z_N": ties.force[:, 2],
    }


def mass_columns(result: FormResult) -> Columns:
    """Return the columns of ``masses.csv``: one row for each point mass."""
    masses = result.masses
    return {
        "mass": masses.name,
        "wire": masses.wire,
        "chainage_m": masses.chainage,
        "coordinate_m": masses.coordinate,
        "mass_kg": masses.mass,
    }


def cantilever_columns(result: FormResult) -> Columns:
    """Return the columns of ``cantilevers.csv``: one row for each flexible cantilever."""
    cantilevers = result.cantilevers
    return {
        "support": cantilevers.support,
        **_places("root", cantilevers.root),
        **_places("tip", cantilevers.tip),
        "force_x_N": cantilevers.force[:, 0],
        "force_y_N": cantilevers.force[:, 1],
        "force_z_N": cantilevers.force[:, 2],
    }


def _places(name: str, r: NDArray[np.float64]) -> Columns:
    """Return positions, shape (n, 3), as three columns."""
    return {f"{name}_{axis}_m": r[:, i] for i, axis in enumerate("xyz")}
