"""The figures of a page about elasticity and load cases."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from catenaria.report.html import drawing
from catenaria.report.html.drawing import Drawing, Trace, colour
from catenaria.report.html.figures import with_margins
from catenaria.report.html.thinning import thinned
from catenaria.results.case import LineState, LoadStudy
from catenaria.results.elasticity import ElasticityStudy

FloatArray = NDArray[np.float64]

_CYCLE = ("messenger", "contact", "dropper", "second", "stitch", "auxiliary")
_MOST_CASES = 12
_AS_BUILT = "as built"


def elasticity_figure(study: ElasticityStudy, supports: Mapping[str, float]) -> Drawing:
    """Draw the elasticity along the line; supports by name [m]."""
    points = study.points
    kept = thinned(points.chainage, (points.elasticity,), most=2000)
    x, e = points.chainage[kept], 1e3 * points.elasticity[kept]
    hover = "chainage %{x:.2f} m<br>elasticity %{y:.4f} mm/N<br>slack droppers %{customdata[0]:.0f}"
    slack = points.slack[kept].astype(np.float64)
    data = [drawing.line(x, e, "elasticity", colour("messenger"), hover, extra=(slack,), digits=5)]
    own = (study.droppers >= x.min()) & (study.droppers <= x.max())
    at = study.droppers[own]
    texts = [f"dropper at {place:.2f} m" for place in at]
    data.append(drawing.points(at, 0.0 * at, "dropper", colour("dropper"), texts, symbol="triangle-up"))
    extent = with_margins((float(x.min()), float(x.max())))
    layout = drawing.layout(extent, "elasticity [mm/N]", supports, rangemode="tozero")
    return Drawing("elasticity-1", "Elasticity along the line", 320, data, layout)


def case_figures(study: LoadStudy) -> list[Drawing]:
    """Draw contact wires under all load cases: heights and, if they move sideways, lateral offsets."""
    first = study.before.supports
    supports = dict(zip(first.support, first.chainage.tolist(), strict=True))
    states = {_AS_BUILT: study.before, **{case.name: case.state for case in study.cases[:_MOST_CASES]}}
    wires = [wire for wire in study.before.wires if wire.role == "contact wire"]
    x = with_margins(
        (min(float(wire.chainage.min()) for wire in wires), max(float(wire.chainage.max()) for wire in wires))
    )
    few = f", the first {_MOST_CASES} of them" if len(study.cases) > _MOST_CASES else ""
    figures = [
        Drawing(
            "cases-height",
            f"Height of the contact wire under load cases{few}",
            340,
            [
                trace
                for i, (name, state) in enumerate(states.items())
                for trace in _state(state, name, i, "height")
            ],
            drawing.layout(x, "height [m]", supports),
        )
    ]
    if _deviates(study):
        lateral = [
            trace
            for i, (name, state) in enumerate(states.items())
            for trace in _state(state, name, i, "lateral")
        ]
        layout = drawing.layout(x, "to the left [m]", supports)
        figures.append(
            Drawing("cases-lateral", f"Contact wire from above under load cases{few}", 340, lateral, layout)
        )
    return figures


def _state(state: LineState, name: str, number: int, quantity: str) -> list[Trace]:
    """Draw the contact wires of one state, all with the label of the state."""
    built = name == _AS_BUILT and number == 0
    of = colour("ink") if built else colour(_CYCLE[(number - 1) % len(_CYCLE)])
    dash = "dash" if built else "solid" if number <= len(_CYCLE) else "dot"
    traces: list[Trace] = []
    for wire in state.wires:
        if wire.role != "contact wire":
            continue
        y: FloatArray = getattr(wire, quantity)
        kept = thinned(wire.chainage, (y,), most=600)
        hover = (
            "chainage %{x:.2f} m<br>height %{customdata[0]:.4f} m<br>"
            "to the left %{customdata[1]:.1f} mm<br>tension %{customdata[2]:.0f} N"
        )
        extra = (wire.height[kept], 1e3 * wire.lateral[kept], wire.tension[kept])
        traces.append(
            drawing.line(
                wire.chainage[kept],
                y[kept],
                name,
                of,
                hover,
                extra=extra,
                dash=dash,
                width=1.4,
                legend=not traces,
            )
        )
    return traces


def _deviates(study: LoadStudy) -> bool:
    """Return whether any case moves a contact wire sideways by more than a millimetre."""
    return any(
        float(np.abs(_at_droppers(case.state) - _at_droppers(study.before)).max(initial=0.0)) > 1e-3
        for case in study.cases
    )


def _at_droppers(state: LineState) -> FloatArray:
    return state.droppers.lateral
