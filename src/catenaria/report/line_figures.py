"""Figures over the length of the line, as Figs. 22 to 25 of Yang et al. 2017, and the bending moments."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from catenaria.report import draw, scales, style
from catenaria.results import FormResult, WireForm

_ALONG = "distance along the track [m]"
_MOST_LENGTHS = 45  # more dropper lengths than these would be written over each other


def contact_wire_figure(result: FormResult) -> Figure:
    """Draw the shape of the contact wire with its droppers, as in Fig. 22."""
    wire, droppers = result.wires[0], result.droppers
    datum = float(droppers.target_height[0])
    text = (
        f"Height is counted from {datum:.3f} m, the wanted height at the first dropper. "
        f"Largest sag between two neighbours: {1e3 * wire.sag:.2f} mm.\n"
        "Supports that hold the messenger wire only are marked lightly."
    )
    figure, [[axes]] = style.new_figure(f"Shape of the {wire.name} in equilibrium", text, [3.4])
    draw.line(axes, wire.profile.chainage, 1e3 * (wire.profile.height - datum), style.RED, wire.name)
    draw.points(axes, droppers.x, 1e3 * (droppers.height - datum), style.DARK, "dropper")
    style.describe(axes, "", _ALONG, "height [mm]")
    draw.mark_supports(axes, _supports(result, result.wires[-1]), _supports(result, wire))
    style.legend_above(axes)
    scales.state_exaggeration(axes, y_unit=1e-3)
    return figure


def configuration_figure(result: FormResult) -> Figure:
    """Draw the starting and the found configuration with all droppers, as in Fig. 23."""
    droppers = result.droppers
    few = len(droppers.x) <= _MOST_LENGTHS
    where = "are written beside them, in metres" if few else "are in droppers.csv"
    figure, [[start], [final]] = style.new_figure(
        "Starting configuration and equilibrium", f"The lengths of the droppers {where}.", [2.0, 3.4]
    )
    ends = [np.interp(droppers.x, wire.start_x, wire.start_z) for wire in result.wires]
    for wire in result.wires:
        colour = style.wire_colour(wire.name, wire.role)
        draw.line(start, wire.start_x, wire.start_z, colour, wire.name)
        draw.line(final, wire.profile.chainage, wire.profile.height, colour, wire.name)
    draw.bars(start, droppers.x, ends[0], ends[-1], "dropper")
    draw.bars(final, droppers.x, droppers.height, droppers.messenger_height, "dropper")
    if few:
        middles = 0.5 * (droppers.height + droppers.messenger_height)
        for x, y, length in zip(droppers.x, middles, droppers.length, strict=True):
            draw.write_beside(final, float(x), float(y), f"{length:.3f}")
    for axes, title in ((start, "(a) starting configuration"), (final, "(b) equilibrium")):
        style.describe(axes, title, _ALONG, "height [m]")
        draw.mark_supports(axes, _supports(result, result.wires[-1]))
        style.legend_above(axes)
        scales.state_exaggeration(axes, y_unit=1.0)
    return figure


def tension_figure(result: FormResult, wire: WireForm) -> Figure:
    """Draw the tension along a wire, as in Figs. 24 and 25."""
    profile, x, colour = wire.profile, wire.profile.chainage, style.wire_colour(wire.name, wire.role)
    below = float(np.median(profile.tension - profile.strain_tension))
    text = (
        f"Axial force between the end supports: {wire.tension_min:.1f} N to {wire.tension_max:.1f} N, "
        f"{wire.tension_mean:.1f} N in the mean; measured: {wire.tension:.1f} N.\n"
        "N leaves out |r'| and so lies lower by the "
        f"fraction T/EA of the tension T, here by {below:.1f} N; it overshoots where the wire bends sharply."
    )
    figure, [[axes]] = style.new_figure(f"Tension along the {wire.name} in equilibrium", text, [3.6])
    draw.line(axes, x, 1e-3 * profile.strain_tension, style.GREY, "N = EA ε, eq. (11)", width=0.8)
    draw.line(axes, x, 1e-3 * profile.tension, colour, "tension")
    wanted = 1e-3 * wire.target_tension
    draw.level(axes, wanted, f"wanted: {wanted:.3f} kN")
    if result.histories:  # other methods have no dead bands
        half = _dead_band(result, wire)
        draw.band(axes, wanted, 1e-3 * half, f"dead band: ±{half:g} N")
    style.describe(axes, "", _ALONG, "tension [kN]")
    draw.mark_supports(axes, _supports(result, wire))
    draw.mark_droppers(axes, result.droppers.x)
    style.legend_above(axes)
    return figure


def moment_figure(result: FormResult) -> Figure:
    """Draw the bending moment along every wire that supports hold."""
    wires = long_wires(result)
    text, heights = "Size of EJ κ, without sign.", [2.2] * len(wires)
    figure, rows = style.new_figure("Bending moments in equilibrium", text, heights)
    for wire, [axes] in zip(wires, rows, strict=True):
        moment = wire.profile.moment
        draw.line(axes, wire.profile.chainage, moment, style.wire_colour(wire.name, wire.role), width=1.0)
        style.describe(axes, f"{wire.name}: up to {moment.max():.3g} N m", _ALONG, "moment [N m]")
        axes.set_ylim(bottom=0.0)
        draw.mark_supports(axes, _supports(result, wire))
        draw.mark_droppers(axes, result.droppers.x)
        style.legend_above(axes)
    return figure


def long_wires(result: FormResult) -> list[WireForm]:
    """Return the wires that supports hold, not those between other wires."""
    return [wire for wire in result.wires if wire.name in result.supports.wire]


def _dead_band(result: FormResult, wire: WireForm) -> float:
    """Half width of the dead band of a wire's tension control [N]."""
    bands = dict(zip(result.controls.name, result.controls.dead_band.tolist(), strict=True))
    return bands[f"{wire.name} tension"]


def _supports(result: FormResult, wire: WireForm) -> dict[str, float]:
    """Positions by name of the supports that hold a wire."""
    held = zip(result.supports.support, result.supports.wire, result.supports.chainage, strict=True)
    return {name: float(x) for name, of, x in held if of == wire.name}
