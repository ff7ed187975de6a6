"""Figures over simulated time for free structures, as Figs. 9 to 11 and 13 to 19 of Yang et al. 2017."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from catenaria.errors import InconsistentInputError
from catenaria.report import draw, scales, style
from catenaria.results.structure import StructureForm, StructureHistory

FloatArray = NDArray[np.float64]

_SMALL = 1e-3  # m or m/s: what stays below it is drawn in thousandths of a millimetre
_RESTING = 1e-12  # m/s: rounding
_LONG = 100.0  # s: a longer motion is drawn over logarithmic time


def joint_height_figure(form: StructureForm, joints: Sequence[str], marks: Mapping[str, float]) -> Figure:
    """Draw how high joints are, with levels to be marked [m]."""
    history = _history(form)
    height = history.joint_position[:, _places(history.joint_name, joints), 2]
    return _figure("Heights of joints", history, (joints, height), marks, "height", "m")


def joint_force_figure(form: StructureForm, joints: Sequence[str], marks: Mapping[str, float]) -> Figure:
    """Draw the forces that joints bear, with levels to be marked [N]."""
    history = _history(form)
    force = np.linalg.norm(history.joint_force[:, _places(history.joint_name, joints)], axis=2)
    return _figure("Forces at joints", history, (joints, force), marks, "force", "N")


def velocity_figure(form: StructureForm, controls: Sequence[str], marks: Mapping[str, float]) -> Figure:
    """Draw with which velocities controls move what they move, with levels to be marked [m/s]."""
    history = _history(form)
    velocity = history.velocity[:, _places(history.control_name, controls)]
    velocity = np.where(np.abs(velocity) < _RESTING, 0.0, velocity)
    return _figure("Velocities of controls", history, (controls, velocity), marks, "velocity", "m/s")


def _history(form: StructureForm) -> StructureHistory:
    if not form.histories:
        raise InconsistentInputError(f"{form.name}: the method {form.method} has no course to be drawn")
    return form.histories[0]


def _places(names: tuple[str, ...], chosen: Sequence[str]) -> list[int]:
    return [names.index(name) for name in chosen]


def _figure(
    title: str,
    history: StructureHistory,
    series: tuple[Sequence[str], FloatArray],
    marks: Mapping[str, float],
    quantity: str,
    unit: str,
) -> Figure:
    names, values = series
    small = unit != "N" and 0.0 < float(np.abs(values).max()) < _SMALL
    scale, shown = (1e6, f"µ{unit}") if small else (1.0, unit)
    figure, [[axes]] = style.new_figure(title, "Simulated time is counted from the start of the run.", [3.2])
    for i, name in enumerate(names):
        colour = style.CYCLE[i % len(style.CYCLE)]
        draw.line(axes, history.time, scale * values[:, i], colour, name)
    for name, level in marks.items():
        draw.level(axes, scale * level, f"{name}: {scale * level:g} {shown}")
    if history.time[-1] > _LONG:
        scales.logarithmic_time(axes, history.time)
    style.describe(axes, "", "simulated time [s]", f"{quantity} [{shown}]")
    style.legend_above(axes)
    return figure
