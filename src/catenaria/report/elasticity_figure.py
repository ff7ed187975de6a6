"""The figure of a study of elasticity: along the line, and within one span."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from catenaria.report import draw, style
from catenaria.report.elasticity_tables import HAND_FACTORS
from catenaria.results.elasticity import ElasticityStudy


def elasticity_figure(study: ElasticityStudy) -> Figure:
    """Draw elasticity over chainage, and again in the span in the middle."""
    spans = study.spans
    figure, panels = style.new_figure(
        f"Elasticity: {study.line}" if study.line else "Elasticity", _said(study), [3.0] * _rows(study)
    )
    whole = panels[0][0]
    x = study.points.chainage
    _draw(whole, study, x[0], x[-1])
    style.describe(whole, "(a) along the line", "chainage [m]", "elasticity [mm/N]")
    style.legend_above(whole)
    if len(panels) > 1:
        axes, k = panels[1][0], spans.span.size // 2
        _draw(axes, study, spans.start[k], spans.end[k])
        droppers = study.droppers
        draw.mark_droppers(axes, droppers[(droppers > spans.start[k]) & (droppers < spans.end[k])])
        u = 100.0 * spans.nonuniformity[k]
        style.describe(
            axes, f"(b) span {spans.span[k]}: non-uniformity {u:.1f} %", "chainage [m]", "elasticity [mm/N]"
        )
    for row in panels:
        row[0].set_ylim(bottom=0.0)
    return figure


def _rows(study: ElasticityStudy) -> int:
    return 1 + int(study.spans.span.size > 1)


def _said(study: ElasticityStudy) -> str:
    way = "nonlinear" if study.nonlinear else "geometry linearised about the line at rest, droppers go slack"
    force = f"Push of {study.force:g} N" if study.force > 0.0 else "Limit of a small push"
    inner = "inner spans" if study.spans.inner.any() else "the points"
    limit = "".join(f" (limit {100.0 * u:.3g} %)" for u in study.nonuniformity_limit)
    return (
        f"{force}; {way}.\nIn {inner}: {1e3 * study.smallest:.3f} to {1e3 * study.largest:.3f} mm/N, "
        f"non-uniformity {100.0 * study.nonuniformity:.1f} %{limit}. "
        "Dashed verticals: supports, triangles: droppers."
        + (f"\nSpans count {study.in_use}." if study.in_use else "")
    )


def _draw(axes: Axes, study: ElasticityStudy, start: float, end: float) -> None:
    points, spans, compared = study.points, study.spans, study.compared
    within = (points.chainage >= start) & (points.chainage <= end)
    x, e = points.chainage[within], 1e3 * points.elasticity[within]
    draw.line(axes, x, e, style.BLUE, "elasticity")
    slack = points.slack[within] > study.slack_at_rest
    if slack.any():
        draw.line(axes, x, np.where(slack, e, np.nan), style.RED, "droppers slack", width=2.4)
    shown = (spans.start >= start) & (spans.end <= end)
    middle = 0.5 * (spans.start + spans.end)[shown]
    high, low = (1e3 * spans.textbook(k)[shown] for k in HAND_FACTORS)
    label = "L/(k ΣT), k = {:g} to {:g}".format(*HAND_FACTORS)
    draw.bars(axes, middle, low, high, label)
    near = (compared.chainage >= start) & (compared.chainage <= end)
    if near.any():
        draw.points(axes, compared.chainage[near], 1e3 * compared.nonlinear[near], style.DARK, "nonlinear")
    for limit in study.elasticity_limit:
        draw.level(axes, 1e3 * limit, "limit")
    names = study.inputs.get("supports", [])
    known = [str(names[i]["name"]) for i in range(len(names))] if len(names) == study.supports.size else []
    marks = known or [f"{i + 1}" for i in range(study.supports.size)]
    at = dict(zip(marks, study.supports.tolist(), strict=True))
    draw.mark_supports(axes, {name: c for name, c in at.items() if start <= c <= end})
