"""What a line file describes, in a few lines of text."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby

from catenaria.line.installation_summary import installation_rows
from catenaria.line.line import Line
from catenaria.line.wire import Anchor, Wire

Rows = list[tuple[str, str]]
Section = tuple[str, Rows]


def summarise(line: Line) -> list[Section]:
    """Say in a few lines what a line file describes.

    Parameters
    ----------
    line : Line
        The line.

    Returns
    -------
    list of (title, list of (label, value))
        Sections of a short table.
    """
    sections = [
        ("Line", [*_line(line), *_track(line)]),
        ("Contact wire", [*_wire(line, line.contact_wire), *_second(line)]),
        ("Auxiliary messenger", _wire(line, line.auxiliary_messenger)),
        ("Messenger wire", _wire(line, line.messenger_wire)),
        ("Stitch wires", _stitch_wires(line)),
        ("Mid-point anchor", _mid_point(line)),
        ("Point masses", [(mass.wire, f"{_named(mass.name)}{mass.mass:g} kg") for mass in line.point_masses]),
        ("Droppers", _droppers(line)),
        ("Prescribed", _prescribed(line)),
        ("Errors of installation", installation_rows(line.installation)),
        ("Dynamic method", _dynamic(line)),
    ]
    return [(title, rows) for title, rows in sections if rows]


def _line(line: Line) -> Rows:
    contact = [support.contact_wire.height for support in line.supports if support.contact_wire]
    rows = [
        ("spans", _runs([f"{span.length:g} m" for span in line.spans])),
        ("length", f"{line.length:g} m"),
        ("supports", f"{len(line.supports)}, {line.supports[0].name} to {line.supports[-1].name}"),
        ("messenger height", _range([support.messenger_height for support in line.supports], "m")),
        ("contact wire held", f"at {_held(line)}, height {_range(contact, 'm')}"),
        *_special_supports(line),
        *_staggers(line),
        *([] if line.speed is None else [("speed", f"{3.6 * line.speed:g} km/h")]),
        ("gravity", f"{line.gravity:g} m/s^2"),
    ]
    return [("name", line.name), *rows] if line.name else rows


def _held(line: Line) -> str:
    """Name the supports that hold the contact wire, unless they are many, and say by what they do."""
    held = line.contact_support_indices
    names = [line.supports[i].name for i in held]
    text = "all supports" if len(held) == len(line.supports) > 4 else ", ".join(names)
    contact = [line.supports[i].contact_wire for i in held]
    arms = [support.arm.registration for support in contact if support and support.arm]
    return f"{text} ({_kinds([f'{arm} arm' for arm in arms])})" if arms else text


def _special_supports(line: Line) -> Rows:
    """Say how supports hold the messenger wire, if not all of them by rollers without friction."""
    supports = [support.messenger_wire for support in line.supports]
    friction = [support.friction for support in supports]
    rows = [
        ("messenger held", _kinds([support.kind for support in supports])),
        ("friction", _range(friction)),
    ]
    shown = (any(support.kind != "sliding" for support in supports), any(friction))
    return [row for row, show in zip(rows, shown, strict=True) if show]


def _staggers(line: Line) -> Rows:
    stagger = [support.stagger for support in line.supports]
    messenger = [support.messenger_offset for support in line.supports]
    rows = [("stagger", _range(stagger, "m")), ("messenger stagger", _range(messenger, "m"))]
    return [row for row, values in zip(rows, (stagger, messenger), strict=True) if any(values)]


def _track(line: Line) -> Rows:
    """Say how the track runs, if not straight and level."""
    curves = [
        f"radius {abs(curve.radius):g} m to the {'left' if curve.radius > 0.0 else 'right'} from "
        f"{curve.start:g} m, {curve.length:g} m long, cant {curve.cant * 1e3:g} mm"
        for curve in line.track.curves
    ]
    slopes = [f"{slope.slope * 1e3:g} mm/m from {slope.start:g} m" for slope in line.track.gradients]
    return [*(("curve", text) for text in curves), *(("gradient", text) for text in slopes)]


def _wire(line: Line, wire: Wire | None) -> Rows:
    if wire is None:
        return []
    conductor, tension = line.conductor(wire.conductor), wire.tension
    rows = [
        ("conductor", wire.conductor),
        ("mass per length", f"{conductor.rhoA:.4g} kg/m"),
        ("EA", f"{conductor.EA / 1e6:.5g} MN"),
        ("EJ", f"{conductor.EJ:g} N m^2"),
        ("tension", f"{tension.force / 1e3:g} kN, measured as {tension.measure} at the {tension.at}"),
    ]
    if tension.pulled != "both":
        rows.append(("pulled", f"at the {tension.pulled} only, by a {tension.device.kind}"))
    if tension.device.efficiency != 1.0:
        efficiency = f"{tension.device.efficiency:g}: {tension.on_wire / 1e3:g} kN on the wire"
        rows.append(("efficiency", efficiency))
    if wire.wear > 0.0:
        rows.append(("wear", f"{wire.wear * 100:g} % of the section"))
    return [*rows, *_ends(wire)]


def _ends(wire: Wire) -> Rows:
    ends = {"start": wire.anchor_start, "end": wire.anchor_end}
    rows = [(f"anchor at the {end}", _anchor(anchor, wire)) for end, anchor in ends.items() if anchor]
    return rows if len(rows) == 2 else [("tails", f"{wire.tail:g} m beyond the end supports"), *rows]


def _anchor(anchor: Anchor, wire: Wire) -> str:
    distance = wire.tail if anchor.distance is None else anchor.distance
    parts = [f"{distance:g} m beyond the support"]
    parts += [f"height {anchor.height:g} m"] if anchor.height is not None else []
    parts += [f"stagger {anchor.stagger:g} m"] if anchor.stagger is not None else []
    return ", ".join(parts)


def _second(line: Line) -> Rows:
    second = line.second_contact_wire
    if second is None:
        return []
    return [("second wire", f"{second.spacing * 1e3:g} mm beside it, droppers: {second.droppers}")]


def _stitch_wires(line: Line) -> Rows:
    stitch = line.stitch_wire
    if stitch is None:
        return []
    return [
        ("number", str(len(line.stitched_supports))),
        ("conductor", stitch.conductor),
        ("length", f"{stitch.length:g} m along the track"),
        ("tension", f"{stitch.tension / 1e3:g} kN"),
    ]


def _mid_point(line: Line) -> Rows:
    anchor = line.mid_point
    if anchor is None:
        return []
    return [
        ("at", anchor.support),
        ("conductor", anchor.conductor),
        ("reach", f"{anchor.reach:g} m on the messenger, {anchor.clearance:g} m on the contact wire"),
        ("tension", f"{anchor.tension / 1e3:g} kN"),
    ]


def _droppers(line: Line) -> Rows:
    kind, conductor = line.dropper, line.conductor(line.dropper.conductor)
    rows = [
        ("number", str(_lower(line))),
        ("in each span", _runs([str(len(span.droppers.x)) for span in line.spans])),
        ("wanted heights", _range(line.dropper_target_height, "m")),
        ("conductor", kind.conductor),
        ("mass per length", f"{conductor.rhoA:.4g} kg/m"),
        ("joint", kind.joint),
    ]
    upper = [len(span.auxiliary.droppers.x) for span in line.spans if span.auxiliary]
    if upper:
        rows.insert(2, ("auxiliary messenger's", f"{sum(upper)}"))
    return rows if kind.model == "cables" else [*rows, ("model", kind.model)]


def _lower(line: Line) -> int:
    """Count the droppers of the contact wires."""
    second = line.second_contact_wire
    return len(line.dropper_x) * (2 if second is not None and second.droppers == "both" else 1)


def _prescribed(line: Line) -> Rows:
    """Count what is wanted and what is free to fulfil it: a form is determined if both agree."""
    per_place = _lower(line) // max(len(line.dropper_x), 1)
    heights = per_place * len(line.dropper_target_height)
    heights += sum(len(span.auxiliary.heights) for span in line.spans if span.auxiliary)
    droppers = per_place * sum(len(span.droppers.x) for span in line.spans)
    droppers += sum(len(span.auxiliary.droppers.x) for span in line.spans if span.auxiliary)
    long = [line.contact_wire, line.messenger_wire, line.auxiliary_messenger]
    wires = sum(wire is not None for wire in long) + (line.second_contact_wire is not None)
    wires += len(line.stitched_supports) + (2 if line.mid_point is not None else 0)
    return [
        ("wanted", f"{wires} tensions + {heights} heights"),
        ("found", f"{wires} wire lengths + {droppers} dropper lengths"),
    ]


def _dynamic(line: Line) -> Rows:
    options = line.solver.dynamic
    rows = [("gravity ramp", f"{options.ramp_time:g} s")]
    for label, control in (
        ("contact wire tension", options.contact_tension),
        ("messenger wire tension", options.messenger_tension),
        ("dropper force", options.dropper_force),
    ):
        band = f"band {control.dead_band:g} N, full speed from {control.saturation:g} N"
        rows.append((label, f"{control.velocity * 1e3:g} mm/s, {band}"))
    height = options.height
    band = f"band {height.dead_band * 1e3:g} mm, full speed from {height.saturation * 1e3:g} mm"
    return [*rows, ("height", f"{height.velocity * 1e3:g} mm/s, {band}")]


def _named(name: str) -> str:
    return f"{name}, " if name else ""


def _kinds(items: Sequence[str]) -> str:
    """Count what there is of each kind, the first one first: ``23 sliding, 2 clamped``."""
    return ", ".join(f"{items.count(kind)} {kind}" for kind in dict.fromkeys(items))


def _runs(items: list[str]) -> str:
    """Write equal neighbours once: ``3 x 65 m, 50 m``."""
    runs = [(item, len(list(group))) for item, group in groupby(items)]
    return ", ".join(f"{count} x {item}" if count > 1 else item for item, count in runs)


def _range(values: Sequence[float], unit: str = "") -> str:
    low, high = min(values), max(values)
    return (f"{low:g}" if low == high else f"{low:g} to {high:g}") + (f" {unit}" if unit else "")
