"""Figures over simulated time: what the controls did (Figs. 10 and 21 of Yang et al. 2017), and the energies.

Each dynamic step has a column of panels of its own, because each counts its time from zero.
"""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from catenaria.report import draw, scales, style
from catenaria.results import FormResult, History, WireForm

FloatArray = NDArray[np.float64]

_TIME = "simulated time [s]"
_MOST_JOINTS = 6
_DASHES = ((6.0, 2.0), (3.0, 2.0), (1.0, 1.2), (6.0, 2.0, 1.0, 2.0), (9.0, 3.0), (3.0, 1.5, 1.0, 1.5))
_ERROR_FLOOR = 0.1  # of a dead band: smaller errors say nothing
_ENERGY_FLOOR = 1e-12  # of the largest energy: as good as at rest


def support_tension_figure(result: FormResult) -> Figure:
    """Draw the tensions of wires at their joints while they are controlled, as in Fig. 21."""
    text = (
        "A tensioning device pulls each wire end (mean of both). N = EA ε of eq. (11) is read at a support; "
        "it leaves out |r'|\nand so lies lower by the fraction T/EA of the tension T; it overshoots where "
        "the wire bends sharply."
    )
    figure, [panels] = _by_step(result, "Tensions at the supports during the controls", text, [3.8])
    for axes, history, title in zip(panels, result.histories, _titles(result), strict=True):
        device = 1e-3 * history.reaction.mean(axis=1)
        draw.line(axes, history.time, device, style.DARK, "tensioning device", width=1.0)
        _joint_lines(axes, history)
        wanted = 1e-3 * _controlled(result, history).target_tension
        draw.level(axes, wanted, f"wanted: {wanted:.3f} kN")
        scales.logarithmic_time(axes, history.time)
        style.describe(axes, title, _TIME, "tension [kN]")
        style.legend(axes, 2, length=2.8)
    return figure


def velocity_figure(result: FormResult) -> Figure:
    """Draw the velocities of all controls, as in Fig. 10."""
    text = (
        "A control rests within its dead band. Scales are logarithmic; those of velocities are linear about "
        f"zero.\n{_signs(result)}"
    )
    figure, rows = _by_step(result, "Velocities of the controls", text, [2.3, 2.3])
    for i, (history, title) in enumerate(zip(result.histories, _titles(result), strict=True)):
        pulls = _pulls(result, history)
        velocity = 1e3 * history.velocity
        draw.lines(rows[0][i], history.time, velocity[:, pulls], style.BLUE, "wire end", width=1.6)
        draw.lines(rows[1][i], history.time, velocity[:, ~pulls], style.GREEN, "dropper")
        for axes, chosen, moved, positive in (
            (rows[0][i], pulls, "wire ends", "outwards"),
            (rows[1][i], ~pulls, *_moved(result, history)),
        ):
            scales.logarithmic_both_ways(axes, velocity[:, chosen])
            scales.logarithmic_time(axes, history.time)
            style.describe(axes, f"{title}, {moved}", _TIME, f"velocity {positive} [mm/s]")
            style.legend(axes, 1)
    return figure


def error_figure(result: FormResult) -> Figure:
    """Draw the sizes of all control errors with their dead bands."""
    text = (
        "Size of the errors. The control law approaches a dead band from outside and never quite enters it.\n"
        f"Errors of less than {_ERROR_FLOOR:g} dead bands are not drawn."
    )
    figure, rows = _by_step(result, "Errors of the controls", text, [2.3, 2.3])
    bands = dict(zip(result.controls.name, result.controls.dead_band, strict=True))
    for i, (history, title) in enumerate(zip(result.histories, _titles(result), strict=True)):
        pulls = _pulls(result, history)
        band = np.array([bands[name] for name in history.control_name])
        height_or_force = (1e3, "height error", "mm") if _heights(history) else (1.0, "force error", "N")
        for axes, chosen, (scale, quantity, unit) in (
            (rows[0][i], pulls, (1.0, "tension error", "N")),
            (rows[1][i], ~pulls, height_or_force),
        ):
            error, bands_here = np.abs(scale * history.error[:, chosen]), scale * band[chosen]
            _error_lines(
                axes, history, error, float(bands_here.max()), "wire" if chosen is pulls else "dropper"
            )
            draw.level(axes, float(bands_here.max()), _told(bands_here, unit))
            scales.logarithmic_time(axes, history.time)
            style.describe(axes, f"{title}, {quantity}", _TIME, f"{quantity} [{unit}]")
            style.legend(axes, 3)
    return figure


def energy_figure(result: FormResult) -> Figure:
    """Draw the energies (7) and (8)."""
    text = (
        "Kinetic energy, eq. (7), and the axial and bending parts of the strain energy, eq. (8).\n"
        f"Values below {_ENERGY_FLOOR:g} of the largest energy are not drawn."
    )
    figure, [panels] = _by_step(result, "Energies", text, [3.4])
    for axes, history, title in zip(panels, result.histories, _titles(result), strict=True):
        energies = {"axial": history.axial, "bending": history.bending, "kinetic": history.kinetic}
        floor = _ENERGY_FLOOR * max(float(energy.max()) for energy in energies.values())
        scales.logarithmic(axes)
        for colour, (name, energy) in zip(style.CYCLE, energies.items(), strict=False):
            draw.line(axes, history.time, np.where(energy > floor, energy, np.nan), colour, name)
        scales.logarithmic_time(axes, history.time)
        style.describe(axes, title, _TIME, "energy [J]")
        style.legend(axes, 3)
    return figure


def _by_step(
    result: FormResult, title: str, text: str, heights: list[float]
) -> tuple[Figure, list[list[Axes]]]:
    return style.new_figure(title, text, heights, columns=len(result.histories))


def _titles(result: FormResult) -> list[str]:
    return [f"step {i}: {history.step}" for i, history in enumerate(result.histories, start=1)]


def _pulls(result: FormResult, history: History) -> NDArray[np.bool_]:
    """Tell the controls of tensions, one a wire and the first ones of every step, from those of droppers."""
    return np.arange(len(history.control_name)) < (len(result.wires) if result.spatial else 1)


def _heights(history: History) -> bool:
    """Tell whether droppers control heights; else forces."""
    return history.control_unit[-1] == "m"


def _signs(result: FormResult) -> str:
    if result.spatial:
        return "Positive is outwards for wire ends, and longer for tied wires and droppers."
    return (
        "Positive is outwards for wire ends, upwards for the tops of droppers that step 1 moves, and "
        "downwards for their bottoms in step 2."
    )


def _moved(result: FormResult, history: History) -> tuple[str, str]:
    """Return what droppers change and which way is positive: tops for heights, bottoms for forces."""
    if result.spatial:
        return "droppers", "of lengthening"
    return "dropper ends", "up" if _heights(history) else "down"


def _controlled(result: FormResult, history: History) -> WireForm:
    """Return the wire whose tension a step tells of: of a whole line the first one."""
    return result.wires[0] if result.spatial else result.wire(history.step)


def _joint_lines(axes: Axes, history: History) -> None:
    tension = 1e-3 * history.joint_tension
    if len(history.joint_name) > _MOST_JOINTS:
        draw.lines(axes, history.time, tension, style.SKY, "support")
        return
    for i, name in enumerate(history.joint_name):
        dashes = (0, _DASHES[i])  # symmetric lines coincide
        draw.line(axes, history.time, tension[:, i], style.CYCLE[i], f"N at {name}", style=dashes)


def _error_lines(axes: Axes, history: History, error: FloatArray, band: float, noun: str) -> None:
    size = np.where(error >= _ERROR_FLOOR * band, error, np.nan)
    largest = np.where(error.max(axis=1) >= _ERROR_FLOOR * band, error.max(axis=1), np.nan)
    scales.logarithmic(axes)
    if size.shape[1] > 1:
        draw.lines(axes, history.time, size, style.SKY, noun)
    draw.line(axes, history.time, largest, style.BLUE, "largest" if size.shape[1] > 1 else "")


def _told(bands: FloatArray, unit: str) -> str:
    """Return what to call the line that is drawn at the largest of dead bands."""
    which = "dead band" if bool(np.all(bands == bands[0])) else "largest dead band"
    return f"{which} {bands.max():g} {unit}"
