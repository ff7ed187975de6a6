"""Checks of droppers: length, spacing, force."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from catenaria.report.checks.check import Check, Found, first_largest, judged
from catenaria.report.checks.rules import Rules
from catenaria.report.names import are_hangers, dropper_place
from catenaria.results import FormResult
from catenaria.results.running import result_role

_NONE = "there are no droppers"


def dropper_checks(result: FormResult, rules: Rules, speed: float | None) -> list[Check]:
    """Check the shortest dropper, the widest gap between two, and the smallest force."""
    checks: list[Check] = []
    hangers = are_hangers(result)
    if rules.dropper_length is not None:
        checks.append(judged("shortest dropper", rules.dropper_length, speed, _shortest(result, ~hangers)))
    if rules.hanger_length is not None and hangers.any():
        checks.append(judged("shortest hanger", rules.hanger_length, speed, _shortest(result, hangers)))
    if rules.dropper_spacing is not None:
        checks.append(judged("dropper spacing", rules.dropper_spacing, speed, _widest(result)))
    if rules.dropper_force is not None:
        checks.append(judged("slack droppers", rules.dropper_force, speed, _weakest(result)))
    return checks


def _shortest(result: FormResult, among: NDArray[np.bool_]) -> Found | str:
    if not among.any():
        return _NONE
    length = np.where(among, result.droppers.length, np.inf)
    i = first_largest(-length)
    return Found(float(length[i]), dropper_place(result, i), "m", bound="at least")


def _weakest(result: FormResult) -> Found | str:
    force = result.droppers.force_bottom
    if not force.size:
        return _NONE
    i = first_largest(-force)
    return Found(float(force[i]), dropper_place(result, i), "N", bound="more than")


def _widest(result: FormResult) -> Found | str:
    """Look at droppers on contact wires; those of two contact wires count together."""
    x, span = _on_contact_wires(result)
    gap, same = np.diff(x), np.diff(span) == 0
    if not same.any():
        return "no span has two droppers"
    i = first_largest(np.where(same, gap, 0.0))
    place = f"span {span[i]}, {x[i]:.2f} m to {x[i + 1]:.2f} m"
    return Found(float(gap[i]), place, "m", why="between neighbouring droppers of a span")


def _on_contact_wires(result: FormResult) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    droppers = result.droppers
    own = np.flatnonzero([result_role(result, name) == "contact wire" for name in droppers.lower_wire])
    own = own[np.argsort(droppers.x[own], kind="stable")]
    return droppers.x[own], droppers.span[own]
