"""A DXF document with the layers of lines: paths, labels, and the view with which it opens."""

from __future__ import annotations

import io
from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Final, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from catenaria.export.libraries import library

FloatArray = NDArray[np.float64]

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
    "SCALE": 8,
    "LABELS": 7,
}
TEXT: Final = 0.4  # m high
_PER_LETTER: Final = 0.9  # width of a letter by its height, rather too large
_MARGIN: Final = 1.05  # of the view, by the drawing's size

Anchor = Literal["LEFT", "BOTTOM_CENTER", "TOP_CENTER", "MIDDLE_LEFT", "MIDDLE_RIGHT"]


def text_length(text: str) -> float:
    """Return how long a label becomes at most [m]."""
    return _PER_LETTER * TEXT * len(text)


class Drawing:
    """A DXF document in metres."""

    def __init__(self) -> None:
        ezdxf = library("ezdxf", "ezdxf", "DXF")
        self._options: Any = ezdxf.options
        self._enums: Any = ezdxf.enums
        with _without_date(self._options):
            self._document: Any = ezdxf.new("R2010", setup=False, units=6)  # metres
        self._document.header["$MEASUREMENT"] = 1  # metric
        for name, colour in LAYERS.items():
            self._document.layers.add(name, color=colour)
        self._space: Any = self._document.modelspace()
        self._low, self._high = np.full(3, np.inf), np.full(3, -np.inf)

    def path(self, layer: str, points: FloatArray) -> None:
        """Add a line or polyline through points, shape (n, 2) or (n, 3): flat, or in space."""
        attributes = {"layer": layer}
        if points.shape[0] == 2:
            self._space.add_line(*points.tolist(), dxfattribs=attributes)
        elif points.shape[1] == 2:
            self._space.add_lwpolyline(points.tolist(), dxfattribs=attributes)
        else:
            self._space.add_polyline3d(points.tolist(), dxfattribs=attributes)
        self._reach(points)

    def text(self, text: str, at: ArrayLike, anchor: Anchor = "LEFT", rotation: float = 0.0) -> None:
        """Add a label; `anchor` says which of its points is at the place, before it is turned."""
        label = " ".join(text.split())
        attributes = {"layer": "LABELS", "height": TEXT, "rotation": rotation}
        place = np.asarray(at, dtype=np.float64)
        entity = self._space.add_text(label, dxfattribs=attributes)
        entity.set_placement(place.tolist(), align=self._enums.TextEntityAlignment[anchor])
        self._reach(place[None, :])

    def write(self, file: Path) -> None:
        """Write the document, which opens with all of it in view; equal drawings give equal files."""
        low, high = self._low, self._high
        self._space.reset_extents(low.tolist(), high.tolist())
        wide, tall = (high - low)[:2].tolist()
        middle = (0.5 * (low + high))[:2].tolist()
        self._document.set_modelspace_vport(_MARGIN * max(tall, wide / 2.0), center=middle)
        stream = io.StringIO()
        with _without_date(self._options):
            self._document.write(stream)
        file.write_text(stream.getvalue(), encoding="utf-8", newline="\n")

    def _reach(self, points: FloatArray) -> None:
        """Note how far the drawing goes."""
        corners = np.zeros((2, 3))  # what is flat is at height 0
        corners[:, : points.shape[1]] = points.min(axis=0), points.max(axis=0)
        self._low, self._high = np.minimum(self._low, corners[0]), np.maximum(self._high, corners[1])


@contextmanager
def _without_date(options: Any) -> Generator[None, None, None]:
    """Let ezdxf write no date and no random name, so that equal drawings give equal files."""
    before = options.write_fixed_meta_data_for_testing
    options.write_fixed_meta_data_for_testing = True
    try:
        yield
    finally:
        options.write_fixed_meta_data_for_testing = before
