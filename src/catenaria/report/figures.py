"""Write all figures of a result into a folder."""

from __future__ import annotations

import os
from pathlib import Path

from matplotlib.figure import Figure

from catenaria.report import history_figures, line_figures, space_figures, style
from catenaria.results import FormResult, WireForm


def write_figures(result: FormResult, folder: str | os.PathLike[str]) -> tuple[Path, ...]:
    """Draw every figure that a result has data for.

    Parameters
    ----------
    result : FormResult
        The result.
    folder : path
        Where the PNG files go; it is made if need be.

    Returns
    -------
    tuple of Path
        The files. A method without dynamic steps has no figures over time.
    """
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    figures = _line_figures(result) | (_history_figures(result) if result.histories else {})
    return tuple(style.save(figure, folder / f"{name}.png") for name, figure in figures.items())


def _line_figures(result: FormResult) -> dict[str, Figure]:
    shapes = _space_figures if result.spatial else _plane_figures
    tensions = {
        f"{_short(wire)}_tension": line_figures.tension_figure(result, wire)
        for wire in line_figures.long_wires(result)
    }
    return {**shapes(result), "moments": line_figures.moment_figure(result), **tensions}


def _short(wire: WireForm) -> str:
    return wire.name.removesuffix(" wire").replace(" ", "_")


def _plane_figures(result: FormResult) -> dict[str, Figure]:
    return {
        "configurations": line_figures.configuration_figure(result),
        "contact_wire": line_figures.contact_wire_figure(result),
    }


def _space_figures(result: FormResult) -> dict[str, Figure]:
    return {
        "profile": space_figures.profile_figure(result),
        "plan": space_figures.plan_figure(result),
        "contact_wire": space_figures.wanted_height_figure(result),
    }


def _history_figures(result: FormResult) -> dict[str, Figure]:
    return {
        "tensions": history_figures.support_tension_figure(result),
        "controls": history_figures.velocity_figure(result),
        "errors": history_figures.error_figure(result),
        "energy": history_figures.energy_figure(result),
    }
