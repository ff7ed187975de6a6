"""Checks of the contact wire's heights: gradient, its change, and what is wanted at droppers."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from catenaria.report.checks.check import Check, Found, first_largest, judged
from catenaria.report.checks.formulas import gradients
from catenaria.report.checks.rules import Rules
from catenaria.report.names import dropper_names, dropper_place
from catenaria.results import FormResult
from catenaria.results.running import Running, used_contact_wires

_PER_MILLE = 1e3
_FINEST = 1e-5  # 0.6 mm on 60 m: finer differences of height cannot be built


def height_checks(result: FormResult, rules: Rules, speed: float | None) -> list[Check]:
    """Check gradients between supports and between droppers, and heights at droppers."""
    checks: list[Check] = []
    wires = used_contact_wires(result)
    several = len(wires) > 1
    for wire in wires:
        of = f"{wire.wire}, " if several else ""
        if rules.gradient is not None:
            checks.append(judged("gradient of the contact wire", rules.gradient, speed, _gradient(wire, of)))
        if rules.gradient_change is not None:
            checks.append(judged("change of gradient", rules.gradient_change, speed, _change(wire, of)))
        checks += _at_droppers(result, rules, speed, wire, of)
    if rules.height_at_droppers is not None:
        checks.append(judged("heights at droppers", rules.height_at_droppers, speed, _height_error(result)))
    return checks


def _gradient(wire: Running, of: str) -> Found | str:
    g = gradients(wire.chainage, wire.height)
    if not g.size:
        return f"fewer than two supports hold the {wire.wire}"
    i = first_largest(np.abs(g))
    place = f"{of}{wire.support[i]} to {wire.support[i + 1]}"
    return Found(abs(float(g[i])), place, "‰", _PER_MILLE, why=wire.note, resolution=_FINEST)


def _change(wire: Running, of: str) -> Found | str:
    change = np.diff(gradients(wire.chainage, wire.height))
    if not change.size:
        return f"fewer than three supports hold the {wire.wire}"
    i = first_largest(np.abs(change))
    place = f"{of}{wire.support[i + 1]}"
    return Found(abs(float(change[i])), place, "‰", _PER_MILLE, why=wire.note, resolution=_FINEST)


def _at_droppers(
    result: FormResult, rules: Rules, speed: float | None, wire: Running, of: str
) -> list[Check]:
    """Look at the heights that were found at a wire's droppers, pre-sag included."""
    droppers = result.droppers
    own = np.flatnonzero([name == wire.wire for name in droppers.lower_wire])
    own = own[np.argsort(droppers.x[own], kind="stable")]
    own = own[wire.between(droppers.x[own])]
    names = dropper_names(result)
    named = [f"{of}{names[i]}" for i in own.tolist()]
    g = gradients(droppers.x[own], droppers.height[own])
    checks: list[Check] = []
    if rules.gradient_at_droppers is not None:
        rule, found = rules.gradient_at_droppers, _steepest(g, named, wire.note)
        checks.append(judged("gradient between droppers", rule, speed, found))
    if rules.gradient_change_at_droppers is not None:
        rule, found = rules.gradient_change_at_droppers, _steepest(np.diff(g), named[1:], wire.note)
        checks.append(judged("change of gradient at droppers", rule, speed, found))
    return checks


def _steepest(slope: NDArray[np.float64], place: list[str], note: str) -> Found | str:
    if not slope.size:
        return "there are too few droppers"
    i = first_largest(np.abs(slope))
    return Found(abs(float(slope[i])), place[i], "‰", _PER_MILLE, why=note, resolution=_FINEST)


def _height_error(result: FormResult) -> Found | str:
    droppers = result.droppers
    if not droppers.x.size:
        return "there are no droppers"
    i = first_largest(np.abs(droppers.height_error))
    return Found(abs(float(droppers.height_error[i])), dropper_place(result, i), "mm", 1e3)
