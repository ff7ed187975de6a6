"""Checks of a study of elasticity."""

from __future__ import annotations

from catenaria.report.checks.check import Check, Found, by_limit, judged, stated
from catenaria.report.checks.rules import Rule, Rules, Share
from catenaria.results import FormResult
from catenaria.results.elasticity import ElasticityStudy

_NOT_STUDIED = "no study of elasticity is given (the command: catenaria elasticity)"
_NEEDS_NODES = "results of this method have no elasticity; those of methods direct and dynamic have"


def elasticity_checks(
    result: FormResult, study: ElasticityStudy | None, rules: Rules, speed: float | None
) -> list[Check]:
    """Check the non-uniformity of elasticity, and state the largest one."""
    name, rule = "non-uniformity of elasticity", rules.nonuniformity
    if study is None:
        why = _NOT_STUDIED if result.physics == "bending" else _NEEDS_NODES
        return [] if rule is None else [judged(name, rule, speed, why)]
    checks = [stated("largest elasticity", 1e3 * study.largest, "mm/N", "inner spans")]
    if rule is None:
        return checks
    push = f"with {study.force:g} N" if study.force > 0.0 else "limit of a small push"
    why = "; ".join(text for text in (push, study.in_use) if text)
    found = Found(study.nonuniformity, "inner spans", "%", 100.0, why=why)
    return [*checks, by_limit(name, rule, _least_limit(rule, speed, study), found)]


def _least_limit(rule: Rule[Share], speed: float | None, study: ElasticityStudy) -> float | str:
    limit = rule.at(speed)
    if isinstance(limit, str):
        return min(study.nonuniformity_limit, default=limit)
    return min(limit, *study.nonuniformity_limit)
