"""Checks of the contact wire's wave speed, and figures about waves."""

from __future__ import annotations

from collections.abc import Sequence

from catenaria.line import Line
from catenaria.report.checks.check import Check, Found, judged, stated
from catenaria.report.checks.formulas import doppler_factor, reflection_factor, wave_speed
from catenaria.report.checks.rules import Rules
from catenaria.results import FormResult, WireForm

_ABOVE = ("messenger wire", "auxiliary messenger")


def wave_checks(result: FormResult, rules: Rules, speed: float | None, line: Line) -> list[Check]:
    """Check the speed against the slowest contact wire, and state wave speeds and factors."""
    contact = [wire for wire in result.wires if wire.role == "contact wire"]
    above = [wire for wire in result.wires if wire.role in _ABOVE]
    simple = len(above) == 1  # the formula of reflection is for two wires
    slowest = min(contact, key=lambda wire: wave_speed(*_least(line, wire)))
    c = wave_speed(*_least(line, slowest))
    checks: list[Check] = []
    if rules.wave_speed is not None:
        found = _share(c, speed, slowest.name)
        checks.append(judged("speed by wave speed", rules.wave_speed, speed, found))
    for wire in (*contact, *above):
        checks.append(stated("wave speed", 3.6 * wave_speed(*_mean(line, [wire])), "km/h", wire.name))
    whole = 3.6 * wave_speed(*_mean(line, [*contact, *above]))
    checks.append(stated("wave speed", whole, "km/h", "whole line"))
    if simple:
        checks += _factors(reflection_factor(_mean(line, contact), _mean(line, above)), c, speed)
    return checks


def _least(line: Line, wire: WireForm) -> tuple[float, float]:
    """Return a wire's least tension [N] and its mass per length [kg/m]."""
    return wire.tension_min, _mass(line, wire)


def _mean(line: Line, wires: Sequence[WireForm]) -> tuple[float, float]:
    """Return the sums of the mean tensions [N] and of the masses per length [kg/m] of wires."""
    return sum(wire.tension_mean for wire in wires), sum(_mass(line, wire) for wire in wires)


def _mass(line: Line, wire: WireForm) -> float:
    """Return what is left of a wire's mass per length [kg/m]."""
    parts = {"messenger wire": line.messenger_wire, "auxiliary messenger": line.auxiliary_messenger}
    part = parts.get(wire.role) or line.contact_wire
    return line.conductor(part.conductor).rhoA * (1.0 - part.wear)


def _share(c: float, speed: float | None, place: str) -> Found | str:
    if speed is None:
        return "the speed is not known: give speed in the line file, or --speed"
    why = f"{3.6 * speed:.4g} km/h by {3.6 * c:.1f} km/h, of the least tension along the wire"
    return Found(speed / c, place, "%", 100.0, why=why)


def _factors(reflection: float, c: float, speed: float | None) -> list[Check]:
    checks = [stated("reflection factor", reflection, "", "droppers")]
    if speed is None or speed >= c:
        return checks
    doppler = doppler_factor(c, speed)
    at = f"{3.6 * speed:.4g} km/h"
    return [
        *checks,
        stated("Doppler factor", doppler, "", at),
        stated("amplification", reflection / doppler, "", at),
    ]
