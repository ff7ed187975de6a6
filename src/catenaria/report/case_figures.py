"""Figures of load cases: heights before and after, lateral positions with the textbook's, strokes."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from catenaria.catenary.blow_off import BlownSpan
from catenaria.report import draw, scales, style
from catenaria.report.case_columns import NARROW, WIDE
from catenaria.results.case import BlowOff, CaseResult, LineState, LoadedWire, LoadStudy

_CHAINAGE = "chainage [m]"
_ONCE = ("stitch wire", "mid-point anchor")
_POINTS = 81  # of a parabola


def write_case_figures(study: LoadStudy, folder: str | os.PathLike[str]) -> tuple[Path, ...]:
    """Draw the figures of every case into the folder of its name, and those of the study.

    Parameters
    ----------
    study : LoadStudy
        The cases.
    folder : path
        With a folder for each case.

    Returns
    -------
    tuple of Path
        The PNG files.
    """
    folder = Path(folder)
    files: list[Path] = []
    for case in study.cases:
        files.append(style.save(height_figure(study, case), folder / case.name / "heights.png"))
        if deviates(study, case):
            files.append(style.save(lateral_figure(study, case), folder / case.name / "lateral.png"))
    if len(_of_temperature(study)) > 1:
        files.append(style.save(stroke_figure(study), folder / "stroke.png"))
    return tuple(files)


def height_figure(study: LoadStudy, case: CaseResult) -> Figure:
    """Draw heights of all wires and of the contact wire before and after."""
    slack, broken = int(case.state.droppers.slack.sum()), int(case.state.droppers.broken.sum())
    text = (
        f"Dashed: as built. Slack droppers: {slack}, missing ones: {broken}. Heights above the canted track."
    )
    figure, [[all_wires], [contact]] = style.new_figure(f"Heights: {case.name}", text, [2.6, 3.0])
    for wire, was in zip(case.state.wires, study.before.wires, strict=True):
        _before_and_after(all_wires, was.chainage, was.height, wire.chainage, wire.height, wire, case.state)
        if wire.role == "contact wire":
            _before_and_after(contact, was.chainage, was.height, wire.chainage, wire.height, wire, case.state)
    _mark_pushes(contact, case)
    for axes, title in ((all_wires, "(a) all wires"), (contact, "(b) contact wire")):
        style.describe(axes, title, _CHAINAGE, "height [m]")
        draw.mark_supports(axes, _supports(case.state))
        style.legend_above(axes)
        scales.state_exaggeration(axes, y_unit=1.0)
    return figure


def _before_and_after(
    axes: Axes,
    x0: draw.FloatArray,
    y0: draw.FloatArray,
    x: draw.FloatArray,
    y: draw.FloatArray,
    wire: LoadedWire,
    state: LineState,
) -> None:
    colour = style.wire_colour(wire.name, wire.role)
    first = next(other.name for other in state.wires if other.role == wire.role)
    label = wire.role if wire.role in _ONCE else wire.name
    draw.line(axes, x0, y0, colour, width=0.9, style=(0, (5, 3)))
    draw.line(axes, x, y, colour, label if wire.role not in _ONCE or wire.name == first else "")


def _mark_pushes(axes: Axes, case: CaseResult) -> None:
    for wire in case.state.wires:
        mask = np.array([name == wire.name for name in case.pushed.wire], dtype=np.bool_)
        if mask.any() and wire.role == "contact wire":
            x = case.pushed.chainage[mask]
            draw.points(axes, x, np.interp(x, wire.chainage, wire.height), style.DARK, "push")


def deviates(study: LoadStudy, case: CaseResult) -> bool:
    """Return whether any wire has moved to a side by a millimetre."""
    pairs = zip(study.before.wires, case.state.wires, strict=True)
    return any(
        bool(np.abs(wire.lateral - np.interp(wire.chainage, was.chainage, was.lateral)).max() > 1e-3)
        for was, wire in pairs
        if wire.role not in _ONCE
    )


def lateral_figure(study: LoadStudy, case: CaseResult) -> Figure:
    """Draw lateral positions before and after, with the textbook's parabolas and usual limits."""
    text = (
        "Dashed: as built. Dotted: textbook parabola of the contact wire alone, dash-dotted: of all wires as "
        f"one.\nLevel lines: {1e3 * NARROW:.0f} and {1e3 * WIDE:.0f} mm, for pantograph heads of 1600 and "
        "1950 mm."
    )
    figure, [[axes]] = style.new_figure(f"Lateral position: {case.name}", text, [3.8])
    for wire, was in zip(case.state.wires, study.before.wires, strict=True):
        if wire.role not in _ONCE:
            _before_and_after(axes, was.chainage, was.lateral, wire.chainage, wire.lateral, wire, case.state)
    _parabolas(axes, case.blow_off)
    for limit in (NARROW, WIDE):
        draw.level(axes, limit, "")
        draw.level(axes, -limit, "")
    style.describe(axes, "", _CHAINAGE, "to the left [m]")
    draw.mark_supports(axes, _supports(case.state))
    style.legend_above(axes)
    return figure


def _parabolas(axes: Axes, blown: BlowOff) -> None:
    ways = (
        ("textbook, alone", (0, (1, 2)), blown.load, blown.tension),
        ("textbook, all as one", (0, (6, 2, 1, 2)), blown.combined_load, blown.combined_tension),
    )
    for label, dashes, load, tension in ways:
        for i in range(len(blown.wire)):
            ends = blown.length[i], blown.stagger_start[i], blown.stagger_end[i]
            span = BlownSpan(*map(float, (*ends, load[i], tension[i], blown.curvature[i])))
            x = np.linspace(0.0, span.length, _POINTS)
            place = blown.start[i] + x
            draw.line(axes, place, span.lateral(x), style.DARK, "" if i else label, width=1.2, style=dashes)


def stroke_figure(study: LoadStudy) -> Figure:
    """Draw the strokes of tensioning devices over temperature, of cases in which nothing else acts."""
    text = "How far devices pull the ends of wires further outwards than at the reference temperature."
    figure, [[axes]] = style.new_figure("Stroke over temperature", text, [3.4])
    states = [(0.0, study.before), *((case.warming, case.state) for case in _of_temperature(study))]
    states.sort(key=lambda pair: pair[0])
    warmth = study.reference_temperature + np.array([warming for warming, _ in states])
    for k, wire in enumerate(study.before.wires):
        stroke = np.array([state.wires[k].travel - wire.travel for _, state in states])
        if wire.role not in _ONCE and np.any(stroke != 0.0):
            draw.line(axes, warmth, 1e3 * stroke, style.wire_colour(wire.name, wire.role), wire.name)
            draw.points(axes, warmth, 1e3 * stroke, style.wire_colour(wire.name, wire.role), "")
    style.describe(axes, "", "temperature [°C]", "stroke [mm]")
    if axes.get_legend_handles_labels()[1]:
        style.legend_above(axes)
    return figure


def _of_temperature(study: LoadStudy) -> list[CaseResult]:
    """Return the cases in which nothing acts but a change of temperature."""
    others = ("wind", "ice", "broken_droppers", "moved_supports", "push")
    return [case for case in study.cases if case.warming and not any(case.stated[name] for name in others)]


def _supports(state: LineState) -> dict[str, float]:
    return dict(zip(state.supports.support, state.supports.chainage.tolist(), strict=True))
