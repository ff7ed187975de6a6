"""The tables of a page about checks, audit, rebuild, elasticity and load cases."""

from __future__ import annotations

from collections.abc import Sequence

from catenaria.report.case_columns import case_columns
from catenaria.report.checks import Check
from catenaria.report.html.table import Table, column
from catenaria.results import FormResult
from catenaria.results.audit import amount
from catenaria.results.case import LoadStudy
from catenaria.results.elasticity import ElasticityStudy

_BOUND = {"at most": "≤", "at least": "≥", "more than": ">"}


def number(size: float | None, unit: str) -> str:
    """Return a value with its unit, to as many digits as an engineer compares.

    Examples
    --------
    >>> number(0.0, "‰"), number(1.97392, "‰"), number(389.0222, "km/h"), number(None, "m")
    ('0 ‰', '1.974 ‰', '389 km/h', '')
    """
    if size is None:
        return ""
    rounded = round(size, 3) + 0.0
    text = f"{rounded:.4g}" if abs(rounded) < 1e4 else f"{rounded:.0f}"
    return f"{text} {unit}".strip()


def value(check: Check) -> str:
    """Return the value of a check with its unit."""
    return number(check.value, check.unit)


def limit(check: Check) -> str:
    """Return the limit of a check with its sign."""
    return f"{_BOUND[check.bound]} {number(check.limit, check.unit)}" if check.bound else ""


def figure_table(checks: Sequence[Check]) -> Table:
    """Return what is stated without being judged by any rule."""
    return Table(
        "",
        (
            column("", "", [check.name for check in checks]),
            column("of", "", [check.place for check in checks]),
            column("value", "", [value(check) for check in checks]),
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
    """Return elasticities of all whole spans."""
    spans = study.spans
    return Table(
        "",
        (
            column("span", "", spans.span),
            column("from", "m", spans.start, ".2f"),
            column("to", "m", spans.end, ".2f"),
            column("largest", "mm/N", 1e3 * spans.largest, ".4f"),
            column("smallest", "mm/N", 1e3 * spans.smallest, ".4f"),
            column("mid span", "mm/N", 1e3 * spans.at_middle, ".4f"),
            column("non-uniformity", "%", 100.0 * spans.nonuniformity, ".1f"),
        ),
    )


def case_table(study: LoadStudy) -> Table:
    """Return a row for each load case."""
    values = case_columns(study)
    shown = (
        ("case", "", "case", ""),
        ("warmer by", "K", "warming_K", "g"),
        ("lowest", "m", "lowest_contact_wire_m", ".4f"),
        ("highest", "m", "highest_contact_wire_m", ".4f"),
        ("furthest aside", "m", "largest_lateral_m", ".4f"),
        ("uplift at supports", "m", "support_uplift_m", ".4f"),
        ("uplift at pushes", "m", "push_uplift_m", ".4f"),
        ("slack droppers", "", "slack_droppers", "d"),
        ("least dropper force", "N", "dropper_force_min_N", ".1f"),
        ("largest dropper force", "N", "dropper_force_max_N", ".1f"),
    )
    values["slack_droppers"] = [int(count) for count in values["slack_droppers"]]
    return Table("", tuple(column(name, unit, values[of], form) for name, unit, of, form in shown))
