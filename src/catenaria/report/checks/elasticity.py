"""Checks of a study of elasticity, in the spans in which the contact wire is in use."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from catenaria.report.checks.check import Check, Found, by_limit, judged, stated
from catenaria.report.checks.rules import Rule, Rules, Share
from catenaria.report.checks.running import contact_wires, running
from catenaria.results import FormResult
from catenaria.results.elasticity import ElasticityStudy, nonuniformity

_NOT_STUDIED = "there is no study of elasticity of this result (the command: catenaria elasticity)"
_CLOSE = 1e-3  # m


@dataclass(frozen=True)
class Softness:
    """Elasticity where it counts.

    Attributes
    ----------
    largest, smallest : float
        [m/N].
    nonuniformity : float
        u = (e_max - e_min)/(e_max + e_min).
    counted : NDArray of bool
        Which spans of the study count.
    note : str
        What one must know of spans that are out of use.
    """

    largest: float
    smallest: float
    nonuniformity: float
    counted: NDArray[np.bool_]
    note: str


def softness(result: FormResult, study: ElasticityStudy) -> Softness:
    """Return the elasticity of the inner spans, or of those of them in which the contact wire is in use.

    Notes
    -----
    Where a contact wire is lifted beyond the reach of pantographs, its elasticity says nothing; at the end
    of a line without arm it is held, and its elasticity is 0.
    """
    spans, used = study.spans, running(result, contact_wires(result)[0])
    counted = spans.inner
    if used.left_out and used.chainage.size:
        start, end = used.chainage[0] - _CLOSE, used.chainage[-1] + _CLOSE
        counted = counted & (spans.start >= start) & (spans.end <= end)
    if counted is spans.inner or not counted.any():
        return Softness(study.largest, study.smallest, study.nonuniformity, spans.inner, "")
    largest, smallest = spans.largest[counted].max(), spans.smallest[counted].min()
    u = nonuniformity(np.array([largest]), np.array([smallest]))[0]
    return Softness(float(largest), float(smallest), float(u), counted, used.note)


def elasticity_checks(
    result: FormResult, study: ElasticityStudy | None, rules: Rules, speed: float | None
) -> list[Check]:
    """Check the non-uniformity of elasticity, and state the largest one."""
    name, rule = "non-uniformity of elasticity", rules.nonuniformity
    if study is None:
        return [] if rule is None else [judged(name, rule, speed, _NOT_STUDIED)]
    soft = softness(result, study)
    checks = [stated("largest elasticity", 1e3 * soft.largest, "mm/N", "inner spans")]
    if rule is None:
        return checks
    push = f"with {study.force:g} N" if study.force > 0.0 else "limit of a small push"
    why = "; ".join(text for text in (push, soft.note) if text)
    found = Found(soft.nonuniformity, "inner spans", "%", 100.0, why=why)
    return [*checks, by_limit(name, rule, _least_limit(rule, speed, study), found)]


def _least_limit(rule: Rule[Share], speed: float | None, study: ElasticityStudy) -> float | str:
    limit = rule.at(speed)
    if isinstance(limit, str):
        return min(study.nonuniformity_limit, default=limit)
    return min(limit, *study.nonuniformity_limit)
