"""Drawings of a line for CAD: its profile over chainage, and its plan in true coordinates."""

from __future__ import annotations

import io
from collections.abc import Generator, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from catenaria.export.libraries import library
from catenaria.export.schedule import dropper_labels, rounded_lengths
from catenaria.line import Line
from catenaria.results import FormResult

FloatArray = NDArray[np.float64]

EXAGGERATION: Final = 10.0  # of heights in the profile

LAYERS: Final = {  # colours by AutoCAD's index
    "CONTACT_WIRE": 1,
    "AUXILIARY_MESSENGER": 6,
    "MESSENGER_WIRE": 150,
    "STITCH_WIRE": 4,
    "MID_POINT_ANCHOR": 30,
    "DROPPERS": 3,
    "SUPPORTS": 8,
    "ARMS": 2,
    "CANTILEVERS": 9,
    "TRACK": 7,
    "LABELS": 7,
}
_TEXT: Final = 0.4  # m high
_GAP: Final = 0.1  # m between what is labelled and its label
_STEP: Final = 5.0  # m of chainage between points of the track
_HALF_MARK: Final = 1.0  # m to either side of the track, for a support in plan


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
    Units are metres; layers are named by what is on them. Heights are those in the canted track frame.

    Raises
    ------
    UnsupportedError
        If ezdxf is not installed.
    """
    drawing = _Drawing()
    for form in result.wires:
        drawing.path(_layer(form.role), _profile_points(form.profile.chainage, form.profile.height))
    lengths = rounded_lengths(result.droppers.cut_length, step)
    digits = max(3, len(f"{step:g}".partition(".")[2]))
    droppers = result.droppers
    ends = zip(droppers.x, droppers.height, droppers.messenger_height, strict=True)
    for label, length, (x, low, high) in zip(dropper_labels(result), lengths, ends, strict=True):
        points = _profile_points(np.array([x, x]), np.array([low, high]))
        drawing.path("DROPPERS", points)
        at = points.mean(axis=0) - np.array([_GAP, 0.0, 0.0])
        drawing.text(f"{label}  {length:.{digits}f} m", at, rotation=90.0)
    for name, x, height in _supports(result):
        foot, head = _profile_points(np.array([x, x]), np.array([0.0, height]))
        drawing.path("SUPPORTS", np.stack((foot, head)))
        drawing.text(name, head + np.array([_GAP, _GAP, 0.0]))
    supports, arms = result.supports, result.arms
    held = dict(zip(zip(supports.support, supports.wire, strict=True), supports.height.tolist(), strict=True))
    for name, wire, x, hinge in zip(arms.support, arms.wire, arms.chainage, arms.hinge_height, strict=True):
        drawing.path("ARMS", _profile_points(np.array([x, x]), np.array([hinge, held[name, wire]])))
    start, end = _reach(result)
    drawing.path("TRACK", _profile_points(np.array([start, end]), np.zeros(2)))
    note = (
        f"{result.name}: profile, heights {EXAGGERATION:g} times exaggerated, metres, cut lengths of droppers"
    )
    drawing.text(note, np.array([start, -1.0, 0.0]))
    drawing.write(file)


def write_plan_dxf(result: FormResult, file: Path) -> None:
    """Write the line in true coordinates, heights included: a plan from above, and a model in space.

    Raises
    ------
    UnsupportedError
        If ezdxf is not installed.
    """
    drawing, alignment = _Drawing(), Line.model_validate(result.inputs).alignment
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
    for label, at in zip(dropper_labels(result), droppers.position_bottom, strict=True):
        drawing.text(label, at + np.array([0.0, _GAP, 0.0]))
    for name, x, _ in _supports(result):
        frames = alignment.frames(np.array([x, x]))
        mark = frames.origin + np.array([[-_HALF_MARK], [_HALF_MARK]]) * frames.left
        drawing.path("SUPPORTS", mark)
        drawing.text(name, mark[1])
    start, end = _reach(result)
    count = int(np.ceil((end - start) / _STEP)) + 1
    drawing.path("TRACK", alignment.frames(np.linspace(start, end, count)).origin)
    origin = alignment.frames(np.array([start])).origin[0]
    drawing.text(f"{result.name}: plan in true coordinates, metres", origin - np.array([0.0, 3.0, 0.0]))
    drawing.write(file)


@contextmanager
def _without_date(options: Any) -> Generator[None, None, None]:
    """Let ezdxf write no date and no random name, so that equal drawings give equal files."""
    before = options.write_fixed_meta_data_for_testing
    options.write_fixed_meta_data_for_testing = True
    try:
        yield
    finally:
        options.write_fixed_meta_data_for_testing = before


class _Drawing:
    """A DXF document with the layers of lines."""

    def __init__(self) -> None:
        ezdxf = library("ezdxf", "ezdxf", "DXF")
        self._options: Any = ezdxf.options
        with _without_date(self._options):
            self._document: Any = ezdxf.new("R2010", setup=False, units=6)  # metres
        self._document.header["$MEASUREMENT"] = 1  # metric
        for name, colour in LAYERS.items():
            self._document.layers.add(name, color=colour)
        self._space: Any = self._document.modelspace()

    def path(self, layer: str, points: FloatArray) -> None:
        """Add a line or polyline through points, shape (n, 3)."""
        attributes = {"layer": layer}
        if points.shape[0] == 2:
            self._space.add_line(*points.tolist(), dxfattribs=attributes)
        else:
            self._space.add_polyline3d(points.tolist(), dxfattribs=attributes)

    def text(self, text: str, at: FloatArray, rotation: float = 0.0) -> None:
        """Add a label."""
        attributes = {"layer": "LABELS", "height": _TEXT, "rotation": rotation, "insert": at.tolist()}
        self._space.add_text(" ".join(text.split()), dxfattribs=attributes)

    def write(self, file: Path) -> None:
        """Write the document; equal drawings give equal files."""
        stream = io.StringIO()
        with _without_date(self._options):
            self._document.write(stream)
        file.write_text(stream.getvalue(), encoding="utf-8", newline="\n")


def _layer(role: str) -> str:
    return role.upper().replace(" ", "_").replace("-", "_")


def _profile_points(chainage: FloatArray, height: FloatArray) -> FloatArray:
    return np.column_stack((chainage, EXAGGERATION * height, np.zeros_like(chainage)))


def _supports(result: FormResult) -> Iterator[tuple[str, float, float]]:
    """Yield name, chainage and greatest height of what each support holds."""
    supports = result.supports
    for name in dict.fromkeys(supports.support):
        own = np.array([each == name for each in supports.support], dtype=np.bool_)
        yield name, float(supports.chainage[own][0]), float(supports.height[own].max())


def _reach(result: FormResult) -> tuple[float, float]:
    """Return the chainages between which there are wires."""
    ends = np.array([form.profile.chainage[[0, -1]] for form in result.wires])
    return float(ends.min()), float(ends.max())
