"""Checks of what holds contact wires sideways: radial pull of steady arms, lateral position."""

from __future__ import annotations

import numpy as np

from catenaria.line.load_units import Force
from catenaria.report.checks.check import Check, Found, by_limit, first_largest, judged
from catenaria.report.checks.rules import Rule, Rules
from catenaria.results import FormResult, WireForm
from catenaria.results.case import LoadStudy
from catenaria.results.running import Running, contact_wires, running
from catenaria.units import NonNegativeLength

_AT_SUPPORT = 1.0  # m: arms that swing take the wire along the track
_NOWHERE = 1e-6  # m


def hold_checks(
    result: FormResult, rules: Rules, speed: float | None, loads: LoadStudy | None
) -> list[Check]:
    """Check the radial pull at steady arms, and how far contact wires are off the middle of the track."""
    checks: list[Check] = []
    if rules.radial_pull is not None:
        checks.append(_pull(result, rules.radial_pull, speed))
    if rules.lateral_position is not None:
        wires = contact_wires(result)
        checks += [_lateral(result, wire, rules.lateral_position, speed, len(wires) > 1) for wire in wires]
        if loads is not None and loads.cases:
            checks.append(_lateral_of_cases(result, loads, rules.lateral_position, speed))
    return checks


def _pull(result: FormResult, rule: Rule[Force], speed: float | None) -> Check:
    """Judge the arm that is closest to its limit: that of the rules, or a higher one of the line file."""
    name, arms = "radial pull of steady arms", result.arms
    if not arms.support:
        return judged(name, rule, speed, "no support has a steady arm")
    general = rule.at(speed)
    least = arms.minimum_radial if isinstance(general, str) else np.maximum(arms.minimum_radial, general)
    i = first_largest(least - arms.pull)
    wanted = float(arms.minimum_radial[i])
    found = Found(float(arms.pull[i]), arms.support[i], "N", bound="at least", why=_whose(wanted, general))
    return by_limit(name, rule, float(least[i]) if wanted > 0.0 else general, found)


def _whose(wanted: float, general: float | str) -> str:
    own = wanted > 0.0 and (isinstance(general, str) or wanted > general)
    return "the limit is that of the line file" if own else ""


def _lateral(
    result: FormResult, wire: WireForm, rule: Rule[NonNegativeLength], speed: float | None, several: bool
) -> Check:
    """Judge a contact wire where it is in use, between supports as well as at them."""
    name, of = "lateral position of the contact wire", f"{wire.name}, " if several else ""
    used, profile = running(result, wire), wire.profile
    if used.chainage.size < 2:
        return judged(name, rule, speed, f"fewer than two supports hold the {wire.name}")
    here = used.between(profile.chainage)
    x = np.concatenate([profile.chainage[here], used.chainage])
    b = np.concatenate([profile.lateral[here], used.stagger])
    i = first_largest(np.abs(b))
    furthest = abs(float(b[i]))
    place = f"{of}{_place(used, float(x[i]))}" if furthest > _NOWHERE else f"{of}everywhere"
    return judged(name, rule, speed, Found(furthest, place, "mm", 1e3, why=used.note))


def _lateral_of_cases(
    result: FormResult, loads: LoadStudy, rule: Rule[NonNegativeLength], speed: float | None
) -> Check:
    """Judge the load case that takes a contact wire furthest aside where it is in use."""
    worst = Found(-1.0, "", "mm", 1e3)
    for own in contact_wires(result):
        used = running(result, own)
        for case in loads.cases:
            wire = next(one for one in case.state.wires if one.name == own.name)
            lateral = np.where(used.between(wire.chainage), np.abs(wire.lateral), 0.0)
            i = first_largest(lateral)
            if lateral[i] > worst.value:
                place = f"{case.name}: {_place(used, float(wire.chainage[i]))}"
                worst = Found(float(lateral[i]), place, "mm", 1e3, why=used.note)
    return judged("lateral position under load cases", rule, speed, worst)


def _place(used: Running, x: float) -> str:
    """Return the support that is there, or the chainage."""
    i = int(np.argmin(np.abs(used.chainage - x)))
    return used.support[i] if abs(used.chainage[i] - x) < _AT_SUPPORT else f"{x:.1f} m"
