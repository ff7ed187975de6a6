"""What a line file describes, in a few lines of text."""

from __future__ import annotations

from itertools import groupby

from catenaria.line.line import Line
from catenaria.line.wire import Wire

Section = tuple[str, list[tuple[str, str]]]


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
    return [
        ("Line", _line(line)),
        ("Contact wire", _wire(line, line.contact_wire)),
        ("Messenger wire", _wire(line, line.messenger_wire)),
        ("Droppers", _droppers(line)),
        ("Prescribed", _prescribed(line)),
        ("Dynamic method", _dynamic(line)),
    ]


def _line(line: Line) -> list[tuple[str, str]]:
    contact = [support.contact_wire.height for support in line.supports if support.contact_wire]
    held = ", ".join(line.supports[i].name for i in line.contact_support_indices)
    rows = [
        ("spans", _runs([f"{span.length:g} m" for span in line.spans])),
        ("length", f"{line.length:g} m"),
        ("supports", f"{len(line.supports)}, {line.supports[0].name} to {line.supports[-1].name}"),
        ("messenger height", _range([support.messenger_height for support in line.supports], "m")),
        ("contact wire held", f"at {held}, height {_range(contact, 'm')}"),
        ("gravity", f"{line.gravity:g} m/s^2"),
    ]
    return [("name", line.name), *rows] if line.name else rows


def _wire(line: Line, wire: Wire) -> list[tuple[str, str]]:
    conductor = line.conductors[wire.conductor]
    tension = wire.tension
    return [
        ("conductor", wire.conductor),
        ("mass per length", f"{conductor.rhoA:.4g} kg/m"),
        ("EA", f"{conductor.EA / 1e6:.5g} MN"),
        ("EJ", f"{conductor.EJ:g} N m^2"),
        ("tension", f"{tension.force / 1e3:g} kN, measured as {tension.measure} at the {tension.at}"),
        ("tails", f"{wire.tail:g} m beyond the end supports"),
    ]


def _droppers(line: Line) -> list[tuple[str, str]]:
    conductor = line.conductors[line.dropper.conductor]
    counts = [str(len(span.droppers.x)) for span in line.spans]
    return [
        ("number", str(len(line.dropper_x))),
        ("in each span", _runs(counts)),
        ("wanted heights", _range(line.dropper_target_height, "m")),
        ("conductor", line.dropper.conductor),
        ("mass per length", f"{conductor.rhoA:.4g} kg/m"),
        ("joint", line.dropper.joint),
    ]


def _prescribed(line: Line) -> list[tuple[str, str]]:
    """Count what is wanted and what is free to fulfil it: a form is determined if both agree."""
    tensions = [line.contact_wire.tension, line.messenger_wire.tension]
    wires = [line.contact_wire, line.messenger_wire]
    heights = sum(len(span.heights) for span in line.spans)
    droppers = sum(len(span.droppers.x) for span in line.spans)
    return [
        ("wanted", f"{len(tensions)} tensions + {heights} heights"),
        ("found", f"{len(wires)} wire lengths + {droppers} dropper lengths"),
    ]


def _dynamic(line: Line) -> list[tuple[str, str]]:
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


def _runs(items: list[str]) -> str:
    """Write equal neighbours once: ``3 x 65 m, 50 m``."""
    runs = [(item, len(list(group))) for item, group in groupby(items)]
    return ", ".join(f"{count} x {item}" if count > 1 else item for item, count in runs)


def _range(values: list[float] | tuple[float, ...], unit: str) -> str:
    low, high = min(values), max(values)
    return f"{low:g} {unit}" if low == high else f"{low:g} to {high:g} {unit}"
