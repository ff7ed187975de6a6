"""All checks of a result."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np

from catenaria.line import Line
from catenaria.report.checks.check import Check, Found, first_largest, judged
from catenaria.report.checks.droppers import dropper_checks
from catenaria.report.checks.elasticity import elasticity_checks
from catenaria.report.checks.heights import height_checks
from catenaria.report.checks.holds import hold_checks
from catenaria.report.checks.rules import Rules
from catenaria.report.checks.waves import wave_checks
from catenaria.report.columns import Columns
from catenaria.report.tables import write_csv
from catenaria.results import FormResult, WireForm
from catenaria.results.case import LoadStudy
from catenaria.results.elasticity import ElasticityStudy

_TIED = ("stitch wire", "mid-point anchor")


def judge(
    result: FormResult,
    rules: Rules,
    speed: float | None = None,
    elasticity: ElasticityStudy | None = None,
    loads: LoadStudy | None = None,
) -> tuple[Check, ...]:
    """Check a result by rules.

    Parameters
    ----------
    result : FormResult
        What was found; values are read from its tables, nothing is solved.
    rules : Rules
        The limits.
    speed : float, optional
        Of trains [m/s]; by default that of the line file, if it has one.
    elasticity, loads : optional
        Studies of the same result.
    """
    line = Line.model_validate(result.inputs)
    speed = line.speed if speed is None else speed
    return (
        *height_checks(result, rules, speed),
        *dropper_checks(result, rules, speed),
        *hold_checks(result, rules, speed, loads),
        *_tension_checks(result, rules, speed),
        *wave_checks(result, rules, speed, line),
        *elasticity_checks(result, elasticity, rules, speed),
    )


def _tension_checks(result: FormResult, rules: Rules, speed: float | None) -> list[Check]:
    rule = rules.tension_variation
    if rule is None:
        return []
    found = [_variation(wire) for wire in result.wires if wire.role not in _TIED]
    for role in _TIED:  # of these there are many: the worst one stands for all
        tied = [_variation(wire) for wire in result.wires if wire.role == role]
        found += [tied[first_largest(np.array([one.value for one in tied]))]] if tied else []
    return [judged("tension along the wire", rule, speed, one) for one in found]


def _variation(wire: WireForm) -> Found:
    wanted = wire.target_tension
    off = max(wanted - wire.tension_min, wire.tension_max - wanted) / wanted
    why = f"{wire.tension_min:.1f} N to {wire.tension_max:.1f} N, wanted {wanted:.1f} N"
    return Found(off, wire.name, "%", 100.0, why=why)


def check_columns(checks: tuple[Check, ...]) -> Columns:
    """Return the columns of ``checks.csv``: one row for each check, whose unit stands in a column."""
    return {
        "check": [check.name for check in checks],
        "rule": [check.rule for check in checks],
        "value": [float("nan") if check.value is None else check.value for check in checks],
        "unit": [check.unit for check in checks],
        "bound": [check.bound for check in checks],
        "limit": [float("nan") if check.limit is None else check.limit for check in checks],
        "place": [check.place for check in checks],
        "verdict": [check.verdict for check in checks],
        "why": [check.why for check in checks],
        "source": [check.source for check in checks],
        "status": [check.status for check in checks],
    }


def write_checks(checks: tuple[Check, ...], file: str | os.PathLike[str]) -> Path:
    """Write checks into a CSV file, all of it or nothing."""
    file = Path(file)
    file.parent.mkdir(parents=True, exist_ok=True)
    new = file.with_name(f".{file.name}.new")
    try:
        write_csv(new, check_columns(checks))
        return new.replace(file)
    finally:
        new.unlink(missing_ok=True)
