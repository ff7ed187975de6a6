"""The tables of a page: dropper schedule, wires, supports, steady arms, cantilevers."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from catenaria.line.alignment import Alignment, Frames
from catenaria.line.track import Track
from catenaria.report.html.table import Table, column
from catenaria.report.html.windows import support_places
from catenaria.results import FormResult, WireForm

FloatArray = NDArray[np.float64]

_FOLDED_FROM = 5  # tables of one kind: more than these are folded


def dropper_tables(result: FormResult) -> list[Table]:
    """Return the dropper schedule, a table for each span."""
    spans = np.unique(result.droppers.span)
    few = spans.size < _FOLDED_FROM
    return [_dropper_table(result, int(span), few) for span in spans]


def _dropper_table(result: FormResult, span: int, unfolded: bool) -> Table:
    d = result.droppers
    own = np.flatnonzero(d.span == span)
    several = len(set(zip(d.lower_wire, d.upper_wire, strict=True))) > 1
    wires = [
        column("holds", "", [d.lower_wire[i] for i in own]),
        column("from", "", [d.upper_wire[i] for i in own]),
    ]
    cut = d.cut_length[own]
    return Table(
        f"Span {span}: {own.size} dropper{'s' if own.size != 1 else ''}, "
        f"cut to {cut.min():.3f} to {cut.max():.3f} m",
        (
            column("dropper", "", d.number[own]),
            *(wires if several else []),
            column("chainage", "m", d.x[own], ".3f"),
            column("length", "m", d.length[own], ".4f"),
            column("cut to", "m", d.cut_length[own], ".4f"),
            column("unstressed", "m", d.unstressed_length[own], ".4f"),
            column("force above", "N", d.force_top[own], ".1f"),
            column("force below", "N", d.force_bottom[own], ".1f"),
            column("height", "m", d.height[own], ".4f"),
            column("error", "mm", 1e3 * d.height_error[own], ".3f"),
        ),
        open=unfolded,
    )


def wire_table(result: FormResult) -> Table:
    """Return lengths, tensions, horizontal components at the ends, and sag of all wires."""
    wires = result.wires
    return Table(
        "",
        (
            column("wire", "", [wire.name for wire in wires]),
            column("unstressed length", "m", [wire.unstressed_length for wire in wires], ".4f"),
            column("elongation", "mm", [_elongation(wire) for wire in wires], ".1f"),
            column("wanted tension", "N", [wire.target_tension for wire in wires], ".1f"),
            column("tension", "N", [wire.tension for wire in wires], ".1f"),
            column("least", "N", [wire.tension_min for wire in wires], ".1f"),
            column("largest", "N", [wire.tension_max for wire in wires], ".1f"),
            column("horizontal at start", "N", [wire.horizontal_start for wire in wires], ".1f"),
            column("at end", "N", [wire.horizontal_end for wire in wires], ".1f"),
            column("sag", "mm", [1e3 * wire.sag for wire in wires], ".2f"),
        ),
    )


def _elongation(wire: WireForm) -> float:
    """Return by how much the force stretches a wire [mm]."""
    return 1e3 * (wire.stretched_length - wire.unstressed_length)


def _frames(result: FormResult, chainage: FloatArray) -> Frames:
    """Return the axes of the track."""
    track = Track.model_validate(result.inputs.get("track", {}))
    return Alignment.of(track, float(result.inputs.get("start_chainage", 0.0))).frames(chainage)


def support_table(result: FormResult) -> Table:
    """Return where supports hold wires, and the forces on them along and across the track."""
    held = result.supports
    along = _frames(result, held.chainage).along
    force_along = along[:, 0] * held.force_x + along[:, 1] * held.force_y
    return Table(
        "",
        (
            column("support", "", held.support),
            column("wire", "", held.wire),
            column("held by", "", held.kind),
            column("chainage", "m", held.chainage, ".2f"),
            column("stagger", "mm", 1e3 * held.stagger, ".0f"),
            column("height", "m", held.height, ".4f"),
            column("force along", "N", force_along, ".1f"),
            column("to the left", "N", held.force_lateral, ".1f"),
            column("upwards", "N", held.force_z, ".1f"),
        ),
    )


def arm_table(result: FormResult) -> Table:
    """Return geometry and forces of all steady arms."""
    arms = result.arms
    return Table(
        "",
        (
            column("support", "", arms.support),
            column("wire", "", arms.wire),
            column("kind", "", arms.registration),
            column("chainage", "m", arms.chainage, ".2f"),
            column("length", "m", arms.length, ".3f"),
            column("hinge stagger", "mm", 1e3 * arms.hinge_stagger, ".0f"),
            column("hinge height", "m", arms.hinge_height, ".3f"),
            column("angle", "°", np.degrees(arms.angle), ".2f"),
            column("radial", "N", arms.radial, ".1f"),
            column("vertical", "N", arms.vertical, ".1f"),
            column("at least", "N", arms.minimum_radial, ".0f"),
        ),
    )


def cantilever_table(result: FormResult) -> Table:
    """Return roots and tips of flexible cantilevers, and their forces along and across the track."""
    beams = result.cantilevers
    places = support_places(result)
    frames = _frames(result, np.array([places[name] for name in beams.support]))
    along = np.einsum("ni,ni->n", frames.along, beams.force)
    left = frames.along[:, 0] * beams.force[:, 1] - frames.along[:, 1] * beams.force[:, 0]
    return Table(
        "",
        (
            column("support", "", beams.support),
            column("root height", "m", frames.height(beams.root), ".3f"),
            column("tip height", "m", frames.height(beams.tip), ".4f"),
            column("force along", "N", along, ".1f"),
            column("to the left", "N", left, ".1f"),
            column("upwards", "N", beams.force[:, 2], ".1f"),
        ),
    )
