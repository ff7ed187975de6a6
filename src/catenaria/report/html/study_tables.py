"""The tables of a page about checks, audit, rebuild, elasticity and load cases."""

from __future__ import annotations

from collections.abc import Sequence

from catenaria.report.case_columns import case_columns
from catenaria.report.checks import Check
from catenaria.report.elasticity_tables import HAND_FACTORS
from catenaria.report.html.table import Table, column
from catenaria.results import FormResult
from catenaria.results.audit import amount
from catenaria.results.case import LoadStudy
from catenaria.results.elasticity import ElasticityStudy

_BOUND = {"at most": "≤", "at least": "≥", "more than": ">"}
_DIGITS = {"m": 3, "mm": 1, "N": 1, "‰": 2, "%": 2, "km/h": 1}
_MOST_DIGITS = 3
_TIED = ("stitch wire", "mid-point anchor")


def number(size: float | None, unit: str, digits: int | None = None) -> str:
    """Return a value with its unit, to as many digits as an engineer compares, or to the digits asked for.

    Examples
    --------
    >>> number(0.0, "‰"), number(1.97392, "‰"), number(389.0222, "km/h"), number(None, "m")
    ('0.00 ‰', '1.97 ‰', '389.0 km/h', '')
    """
    if size is None:
        return ""
    places = _DIGITS.get(unit, _MOST_DIGITS) if digits is None else digits
    return f"{round(size, places) + 0.0:.{places}f} {unit}".strip()


def value(check: Check) -> str:
    """Return the value of a check with its unit; one that fails never reads as if it were the limit."""
    digits = _DIGITS.get(check.unit, _MOST_DIGITS)
    if check.verdict == "fails" and check.value is not None and check.limit is not None:
        while digits < 2 * _MOST_DIGITS and round(check.value, digits) == round(check.limit, digits):
            digits += 1
    return number(check.value, check.unit, digits)


def limit(check: Check) -> str:
    """Return the limit of a check with its sign."""
    return f"{_BOUND[check.bound]} {check.limit:g} {check.unit}".strip() if check.bound else ""


def figure_table(checks: Sequence[Check]) -> Table:
    """Return what is stated without being judged by any rule."""
    return Table(
        "",
        (
            column("", "", [check.name for check in checks]),
            column("of", "", [check.place for check in checks]),
            column("value", "", [value(check) for check in checks], flush=True),
        ),
    )


def audit_table(result: FormResult) -> Table:
    """Return every check of the audit."""
    audit = result.audit
    rows = range(len(audit.name))
    return Table(
        "Every check of the audit",
        (
            column("of", "", audit.group),
            column("check", "", audit.name),
            column("deviation", "", [amount(float(audit.deviation[i]), audit.unit[i]) for i in rows]),
            column("allowed", "", [amount(float(audit.allowed[i]), audit.unit[i]) for i in rows]),
            column("place", "", audit.place),
        ),
        open=False,
    )


def elasticity_table(study: ElasticityStudy) -> Table:
    """Return elasticities of all whole spans, those that count and the others, beside the hand formula."""
    spans = study.spans
    hand = (column(f"L/({k:g} ΣT)", "mm/N", 1e3 * spans.textbook(k), ".3f") for k in HAND_FACTORS)
    return Table(
        "",
        (
            column("span", "", spans.span),
            column("from", "m", spans.start, ".2f"),
            column("to", "m", spans.end, ".2f"),
            column("largest", "mm/N", 1e3 * spans.largest, ".4f"),
            column("smallest", "mm/N", 1e3 * spans.smallest, ".4f"),
            column("mid span", "mm/N", 1e3 * spans.at_middle, ".4f"),
            *hand,
            column("non-uniformity", "%", 100.0 * spans.nonuniformity, ".1f"),
            column("counts", "", spans.inner),
        ),
    )


def case_table(study: LoadStudy) -> Table:
    """Return a row for each load case."""
    values = case_columns(study)

    def millimetres(of: str) -> list[float]:
        return [1e3 * value for value in values[of]]

    return Table(
        "",
        (
            column("case", "", values["case"]),
            column("warmer by", "K", values["warming_K"], "g"),
            column("lowest", "m", values["lowest_contact_wire_m"], ".4f"),
            column("highest", "m", values["highest_contact_wire_m"], ".4f"),
            column("furthest aside", "mm", millimetres("largest_lateral_m"), ".0f"),
            column("uplift at supports", "mm", millimetres("support_uplift_m"), ".1f"),
            column("uplift at pushes", "mm", millimetres("push_uplift_m"), ".1f"),
            column("slack droppers", "", [int(count) for count in values["slack_droppers"]]),
            column("least dropper force", "N", values["dropper_force_min_N"], ".1f"),
            column("largest dropper force", "N", values["dropper_force_max_N"], ".1f"),
        ),
    )


def case_wire_table(study: LoadStudy) -> Table:
    """Return tensions of wires under load cases, and how far tensioning devices have moved."""
    states = [("as built", study.before), *((case.name, case.state) for case in study.cases)]
    long = [k for k, wire in enumerate(study.before.wires) if wire.role not in _TIED]
    rows = [(name, state.wires[k], study.before.wires[k]) for k in long for name, state in states]
    return Table(
        "",
        (
            column("wire", "", [wire.name for _, wire, _ in rows]),
            column("case", "", [name for name, _, _ in rows]),
            column("least tension", "N", [wire.tension_min for _, wire, _ in rows], ".1f"),
            column("largest tension", "N", [wire.tension_max for _, wire, _ in rows], ".1f"),
            column("devices moved", "mm", [1e3 * (wire.travel - was.travel) for _, wire, was in rows], ".1f"),
        ),
    )
