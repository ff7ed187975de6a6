"""Elasticity: how far the contact wire rises where a static force pushes it, along a line."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from catenaria.errors import InconsistentInputError
from catenaria.loading.between_nodes import between_nodes
from catenaria.loading.built_line import BuiltLine
from catenaria.loading.nonlinear_pushes import HELD, NonlinearPushes
from catenaria.loading.push_points import PushPoints, Stretch, contact_wires, push_points, stretches
from catenaria.loading.read_case import line_state
from catenaria.loading.reduced import ReducedLine, push
from catenaria.results.elasticity import Compared, ElasticityStudy, PushedPoint, SpanElasticity, nonuniformity
from catenaria.results.form import FormResult
from catenaria.results.running import used_contact_wires

FloatArray = NDArray[np.float64]
Mask = NDArray[np.bool_]
Listener = Callable[[str, int, int], None]

_SAME: Final = 1e-6  # m
_LONG: Final = ("contact wire", "auxiliary messenger", "messenger wire")


@dataclass(frozen=True)
class Wanted:
    """What of a line's elasticity is wanted.

    Attributes
    ----------
    force : float
        With which contact wires are pushed up, all together [N]; 0 for the limit of a small force.
    spacing : float
        Of the points [m].
    nonlinear : bool
        Whether each point is solved with all nonlinearities.
    start, end : float, optional
        First and last chainage [m]; by default the first and the last support of the contact wire.
    elasticity_limit, nonuniformity_limit : tuple of float
        What elasticity and non-uniformity may be [m/N], [-], if there is a limit.
    """

    force: float = 100.0
    spacing: float = 0.5
    nonlinear: bool = False
    start: float | None = None
    end: float | None = None
    elasticity_limit: tuple[float, ...] = ()
    nonuniformity_limit: tuple[float, ...] = ()


def elasticity_of(built: BuiltLine, wanted: Wanted, progress: Listener | None = None) -> ElasticityStudy:
    """Return the elasticity along a built line.

    Parameters
    ----------
    built : BuiltLine
        The line.
    wanted : Wanted
        Force, points and what is linearised.
    progress : callable, optional
        Receives what is done, how many points of it are done, and of how many.

    Raises
    ------
    InconsistentInputError
        If the force is negative, or the points are none.
    NotConvergedError, InfeasibleError
        If the line does not come to rest.
    """
    force = wanted.force
    if not (np.isfinite(force) and force >= 0.0):
        raise InconsistentInputError(f"the force is {force:g} N; it must be positive, or 0 for its limit")
    if wanted.nonlinear and force == 0.0:
        raise InconsistentInputError("the limit of a small force is linear; give a force above 0 N")
    reduced = ReducedLine.of(built)
    points = push_points(built.line, reduced.model, wanted.spacing, wanted.start, wanted.end)
    responses = reduced.respond(points.forces, _part(progress, "linear responses"))
    lacking = between_nodes(reduced.model, points.wires, points.s)
    responses = replace(responses, own=responses.own + np.where(responses.own > HELD, lacking, 0.0))
    pushes = push(reduced, responses, force)
    elasticity, slack, compared = pushes.elasticity, pushes.slack, _none()
    pushed = NonlinearPushes(built, reduced, points.forces, lacking, pushes, force)
    if wanted.nonlinear:
        every = np.arange(points.chainage.size)
        elasticity, slack = pushed.at(every, _part(progress, "nonlinear solutions"))
    elif force > 0.0:
        compared = _compared(pushed, points, _part(progress, "comparison"))
    return _study(built, reduced, wanted, points, elasticity, slack, compared)


def _part(progress: Listener | None, name: str) -> Callable[[int, int], None] | None:
    return None if progress is None else lambda done, count: progress(name, done, count)


def _compared(
    pushed: NonlinearPushes, points: PushPoints, progress: Callable[[int, int], None] | None
) -> Compared:
    """Compare both lines in the first, the middle and the last span, and where most happens."""
    pushes = pushed.pushes
    chosen = {int(np.argmax(pushes.elasticity)): "largest"}
    count = pushes.slack.sum(axis=1)
    if count.any():
        chosen.setdefault(int(np.argmax(count)), "most slack droppers")
    spans = np.unique(points.span)
    for span in sorted({int(spans[0]), int(spans[spans.size // 2]), int(spans[-1])}):
        for i in np.flatnonzero(points.span == span).tolist():
            kind = next((name for name in ("mid span", "support") if name in points.place[i]), None)
            if kind is not None:
                chosen.setdefault(i, kind)
    some = np.array(sorted(chosen), dtype=np.int64)
    elasticity, slack = pushed.at(some, progress)
    return Compared(
        chainage=points.chainage[some],
        why=tuple(chosen[i] for i in some.tolist()),
        linearised=pushes.elasticity[some],
        nonlinear=elasticity,
        linearised_slack=count[some].astype(np.int64),
        nonlinear_slack=slack.sum(axis=1).astype(np.int64),
        same_slack=np.all(slack == pushes.slack[some], axis=1),
    )


def _none() -> Compared:
    nothing, none = np.empty(0), np.empty(0, dtype=np.int64)
    return Compared(nothing, (), nothing, nothing, none, none, np.empty(0, dtype=np.bool_))


def _study(
    built: BuiltLine,
    reduced: ReducedLine,
    wanted: Wanted,
    points: PushPoints,
    elasticity: FloatArray,
    slack: Mask,
    compared: Compared,
) -> ElasticityStudy:
    model, droppers = reduced.model, reduced.model.layout.droppers
    every = stretches(built.line, model)
    spans = _spans(built, every, points, elasticity)
    counted = np.ones(points.chainage.size, dtype=np.bool_)
    if spans.inner.any():
        start, end = spans.start[spans.inner].min(), spans.end[spans.inner].max()
        counted = (points.chainage >= start) & (points.chainage <= end)
    largest, smallest = elasticity[counted].max(), elasticity[counted].min()
    at_support = [i for i, place in enumerate(points.place) if "support" in place and elasticity[i] < HELD]
    return ElasticityStudy(
        line=built.result.name,
        method=built.result.method,
        force=wanted.force,
        spacing=wanted.spacing,
        nonlinear=wanted.nonlinear,
        points=PushedPoint(
            chainage=points.chainage,
            span=np.array([span.span for span in every], dtype=np.int64)[points.span],
            place=points.place,
            elasticity=elasticity,
            slack=slack.sum(axis=1).astype(np.int64),
        ),
        spans=spans,
        largest=float(largest),
        smallest=float(smallest),
        nonuniformity=float(nonuniformity(largest, smallest)),
        slack_at_rest=int(reduced.slack.sum()),
        held=tuple(points.place[i].rpartition("support ")[2] for i in at_support),
        compared=compared,
        elasticity_limit=wanted.elasticity_limit,
        nonuniformity_limit=wanted.nonuniformity_limit,
        supports=np.array([every[0].start, *(span.end for span in every)]),
        droppers=droppers.frame.chainage[np.isin(droppers.lower, contact_wires(model))],
        inputs=built.result.inputs,
    )


def _spans(
    built: BuiltLine, every: tuple[Stretch, ...], points: PushPoints, elasticity: FloatArray
) -> SpanElasticity:
    """Return what is found in spans that have been pushed from support to support."""
    x = points.chainage
    whole = [span for span in every if x[0] <= span.start + _SAME and span.end <= x[-1] + _SAME]
    inside = [np.flatnonzero((x >= span.start - _SAME) & (x <= span.end + _SAME)) for span in whole]
    high = np.array([i[np.argmax(elasticity[i])] for i in inside], dtype=np.int64)
    low = np.array([i[np.argmin(elasticity[i])] for i in inside], dtype=np.int64)
    middle = np.array([np.argmin(np.abs(x - span.middle)) for span in whole], dtype=np.int64)
    ends = np.array([(i[0], i[-1]) for i in inside], dtype=np.int64).reshape(-1, 2)
    number = np.array([span.span for span in whole], dtype=np.int64)
    return SpanElasticity(
        span=number,
        start=x[ends[:, 0]],
        end=x[ends[:, 1]],
        largest=elasticity[high],
        largest_chainage=x[high],
        smallest=elasticity[low],
        smallest_chainage=x[low],
        at_start=elasticity[ends[:, 0]],
        at_middle=elasticity[middle],
        at_end=elasticity[ends[:, 1]],
        nonuniformity=nonuniformity(elasticity[high], elasticity[low]),
        tension=_tension(built, whole),
        inner=_counted(built.result, every, whole),
    )


def _counted(result: FormResult, every: tuple[Stretch, ...], spans: list[Stretch]) -> Mask:
    """Return which spans count: none at the ends of the line, none in which a contact wire is out of use.

    Each of the two holds only as long as it leaves any span.
    """
    inner = np.array([span not in (every[0], every[-1]) for span in spans], dtype=np.bool_)
    middle = np.array([span.middle for span in spans], dtype=np.float64)
    counted = np.ones(len(spans), dtype=np.bool_)
    for kept in (inner, *(wire.between(middle) for wire in used_contact_wires(result))):
        counted = counted & kept if (counted & kept).any() else counted
    return counted


def _tension(built: BuiltLine, spans: list[Stretch]) -> FloatArray:
    """Return the sums of the mean tensions of all long wires within spans [N]."""
    state = line_state(built.line, built.at_rest, np.zeros(built.model.length.size, dtype=np.bool_))
    total = np.zeros(len(spans))
    for wire in state.wires:
        if wire.role not in _LONG:
            continue
        for k, span in enumerate(spans):
            within = (wire.chainage >= span.start) & (wire.chainage <= span.end)
            total[k] += wire.tension[within].mean() if within.any() else 0.0
    return total
