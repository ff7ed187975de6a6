"""Drawings of a line for CAD: its profile over chainage, and its plan in true coordinates."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from catenaria.export.drawing import TEXT, Anchor, Drawing, text_length
from catenaria.export.schedule import dropper_labels, rounded_lengths
from catenaria.line import Line
from catenaria.line.alignment import Alignment
from catenaria.results import FormResult

FloatArray = NDArray[np.float64]

EXAGGERATION: Final = 10.0  # of heights in the profile

_GAP: Final = 0.2  # m between what is labelled and its label
_STEP: Final = 5.0  # m of chainage between points of the track
_HALF_MARK: Final = 1.0  # m to either side of the track, for a support in plan
_SCALE: Final = 4.0  # m of chainage before the line, for the scale of heights


def write_profile_dxf(result: FormResult, file: Path, step: float) -> None:
    """Write the profile: chainage to the right, heights above the track upwards, ten times as large.

    Parameters
    ----------
    result : FormResult
        What was found.
    file : path
        With suffix ``.dxf``.
    step : float
        Droppers' labels give cut lengths rounded to whole steps [m].

    Notes
    -----
    Units are metres; layers are named by what is on them. Heights are those in the canted track frame. Labels
    of droppers stand below the contact wire, of those that hold another wire above what they hang from.

    Raises
    ------
    UnsupportedError
        If ezdxf is not installed.
    """
    drawing = Drawing()
    for form in result.wires:
        drawing.path(_layer(form.role), _profile_points(form.profile.chainage, form.profile.height))
    lowest = _droppers_in_profile(drawing, result, step)
    _supports_in_profile(drawing, result, lowest)
    start, end = _reach(result)
    drawing.path("TRACK", _profile_points(np.array([start, end]), np.zeros(2)))
    _scale(drawing, start - _SCALE, max(float(form.profile.height.max()) for form in result.wires))
    note = f"profile, metres, heights above the track {EXAGGERATION:g} times exaggerated"
    labels = "chainages of supports, lengths of spans, cut lengths of droppers"
    drawing.text(f"{result.name}: {note}; {labels}", (start, lowest - 5.0 * TEXT))
    drawing.write(file)


def write_plan_dxf(result: FormResult, file: Path) -> None:
    """Write the line in true coordinates, heights included: a plan from above, and a model in space.

    Raises
    ------
    UnsupportedError
        If ezdxf is not installed.
    """
    drawing, alignment = Drawing(), Line.model_validate(result.inputs).alignment
    for form in result.wires:
        profile = form.profile
        drawing.path(_layer(form.role), np.column_stack((profile.x, profile.y, profile.z)))
    droppers, arms, beams = result.droppers, result.arms, result.cantilevers
    for layer, starts, ends in (
        ("DROPPERS", droppers.position_bottom, droppers.position_top),
        ("ARMS", arms.hinge, arms.tip),
        ("CANTILEVERS", beams.root, beams.tip),
    ):
        for points in np.stack((starts, ends), axis=1):
            drawing.path(layer, points)
    _droppers_in_plan(drawing, result, alignment)
    for name, x, _ in _supports(result):
        frames = alignment.frames(np.array([x, x]))
        mark = frames.origin + np.array([[-_HALF_MARK], [_HALF_MARK]]) * frames.left
        drawing.path("SUPPORTS", mark)
        turned, upright = _along(frames.left[1])
        place = mark[1] + _GAP * frames.along[1]
        drawing.text(name, place, "MIDDLE_LEFT" if upright else "MIDDLE_RIGHT", turned)
    start, end = _reach(result)
    count = int(np.ceil((end - start) / _STEP)) + 1
    drawing.path("TRACK", alignment.frames(np.linspace(start, end, count)).origin)
    origin = alignment.frames(np.array([start])).origin[0]
    drawing.text(f"{result.name}: plan in true coordinates, metres", origin - np.array([0.0, 3.0, 0.0]))
    drawing.write(file)


def _supports_in_profile(drawing: Drawing, result: FormResult, lowest: float) -> None:
    """Draw supports, their arms, and the lengths of spans between them below everything else."""
    places = _supports(result)
    for name, x, height in places:
        foot, head = _profile_points(np.array([x, x]), np.array([0.0, height]))
        drawing.path("SUPPORTS", np.stack((foot, head)))
        drawing.text(f"{name}  {x:.2f} m", head + _GAP)
    for (_, x, _), (_, following, _) in pairwise(places):
        drawing.text(f"{following - x:.2f} m", (0.5 * (x + following), lowest - _GAP), "TOP_CENTER")
    supports, arms = result.supports, result.arms
    held = dict(zip(zip(supports.support, supports.wire, strict=True), supports.height.tolist(), strict=True))
    for name, wire, x, hinge in zip(arms.support, arms.wire, arms.chainage, arms.hinge_height, strict=True):
        drawing.path("ARMS", _profile_points(np.array([x, x]), np.array([hinge, held[name, wire]])))


def _droppers_in_profile(drawing: Drawing, result: FormResult, step: float) -> float:
    """Draw droppers and their labels, and return down to where they or the track reach."""
    droppers = result.droppers
    digits = max(3, len(f"{step:g}".partition(".")[2]))
    contact = {form.name for form in result.wires if form.role == "contact wire"}
    ends = np.stack((droppers.height, droppers.messenger_height), axis=1)
    taken: dict[tuple[str, int], float] = {}
    lowest = 0.0
    names = zip(dropper_labels(result), rounded_lengths(droppers.cut_length, step), strict=True)
    places = zip(names, droppers.x.tolist(), ends, droppers.lower_wire, strict=True)
    for (name, length), x, heights, lower in places:
        points = _profile_points(np.array([x, x]), heights)
        drawing.path("DROPPERS", points)
        text = f"{name}  {length:.{digits}f} m"
        anchor: Anchor = "MIDDLE_RIGHT" if lower in contact else "MIDDLE_LEFT"
        row = next(k for k in range(len(taken) + 1) if x - taken.get((anchor, k), -np.inf) > 1.5 * TEXT)
        taken[anchor, row] = x
        off = _GAP + row * text_length(text)
        y = points[0, 1] - off if lower in contact else points[1, 1] + off
        drawing.text(text, (x, y), anchor, rotation=90.0)
        lowest = min(lowest, y - text_length(text))
    return lowest


def _scale(drawing: Drawing, x: float, highest: float) -> None:
    """Draw a scale of heights, with a tick for every metre."""
    drawing.path("SCALE", _profile_points(np.array([x, x]), np.array([0.0, highest])))
    for height in range(int(highest) + 1):
        tick = _profile_points(np.array([x, x + 1.0]), np.full(2, float(height)))
        drawing.path("SCALE", tick)
        drawing.text(f"{height} m", tick[0] - np.array([_GAP, 0.0]), "MIDDLE_RIGHT")


def _droppers_in_plan(drawing: Drawing, result: FormResult, alignment: Alignment) -> None:
    """Write the labels of droppers along the track, on the side of the wire that is away from the track."""
    feet, frames = result.droppers.position_bottom, alignment.frames(result.droppers.x)
    beyond = np.einsum("ni,ni->n", (feet - frames.origin)[:, :2], frames.left[:, :2])
    sides = np.where(beyond >= 0.0, 1.0, -1.0)[:, None] * frames.left
    for label, foot, side in zip(dropper_labels(result), feet, sides, strict=True):
        turned, upright = _along(side)
        drawing.text(label, foot + _GAP * side, "BOTTOM_CENTER" if upright else "TOP_CENTER", turned)


def _along(side: FloatArray) -> tuple[float, bool]:
    """Return the angle of text on this side of a line along the line [deg], and whether it stands upright.

    Text is turned by half a turn where it would stand on its head.
    """
    angle = float(np.degrees(np.arctan2(-side[0], side[1])))
    upright = -90.0 < angle <= 90.0
    return (angle if upright else angle - float(np.copysign(180.0, angle))), upright


def _layer(role: str) -> str:
    return role.upper().replace(" ", "_").replace("-", "_")


def _profile_points(chainage: FloatArray, height: FloatArray) -> FloatArray:
    return np.column_stack((chainage, EXAGGERATION * height))


def _supports(result: FormResult) -> list[tuple[str, float, float]]:
    """Return name, chainage and greatest height of what each support holds, along the line."""
    supports, places = result.supports, list[tuple[str, float, float]]()
    for name in dict.fromkeys(supports.support):
        own = np.array([each == name for each in supports.support], dtype=np.bool_)
        places.append((name, float(supports.chainage[own][0]), float(supports.height[own].max())))
    return sorted(places, key=lambda place: place[1])


def _reach(result: FormResult) -> tuple[float, float]:
    """Return the chainages between which there are wires."""
    ends = np.array([form.profile.chainage[[0, -1]] for form in result.wires])
    return float(ends.min()), float(ends.max())
