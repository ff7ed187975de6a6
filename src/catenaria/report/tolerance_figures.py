"""Figures of tolerance studies: bands along the line, histogram, what matters; and of rounded lengths."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from catenaria.report import draw, draw_statistics, style
from catenaria.results.rounding import RoundingStudy
from catenaria.results.tolerance import LEVELS, Scatter, ToleranceStudy

FloatArray = NDArray[np.float64]

_CHAINAGE = "chainage [m]"
_BANDS = ((1.0, 99.0, 0.2), (5.0, 95.0, 0.35), (25.0, 75.0, 0.6))  # percentiles, and how dark
_BINS = 60
_MOST = 24  # single errors in a figure


def write_tolerance_figures(study: ToleranceStudy, folder: str | os.PathLike[str]) -> tuple[Path, ...]:
    """Draw all figures of a study into a folder, which is made if need be."""
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    figures = {
        "heights": band_figure(study),
        "worst": histogram_figure(study),
        "importance": importance_figure(study),
        "forces": force_figure(study),
    }
    return tuple(style.save(figure, folder / f"{name}.png") for name, figure in figures.items())


def band_figure(study: ToleranceStudy) -> Figure:
    """Draw the percentiles of heights along the line, and how probable it is to leave the tolerance."""
    own, limit = study.on_contact_wire, 1e3 * study.tolerance
    text = (
        f"{study.samples} samples, {study.model}, seed {study.seed}. Heights of the contact wire at droppers "
        "above the wanted ones;\nbetween droppers points are joined by straight lines."
    )
    figure, [[band], [outside]] = style.new_figure(
        "Contact wire under errors of installation", text, [3.4, 1.8]
    )
    x = study.chainage[own]
    above = _above(study.height, study.wanted_height, own)
    for low, high, dark in _BANDS:
        least, most = (above[LEVELS.index(level)] for level in (low, high))
        draw_statistics.between(band, x, least, most, dark, f"{low:g} % to {high:g} %")
    draw.line(band, x, above[LEVELS.index(50.0)], style.BLUE, "median", width=1.2)
    for extreme, label in ((study.height.minimum, "least, most"), (study.height.maximum, "")):
        line = 1e3 * (extreme - study.wanted_height)[own]
        draw.line(band, x, line, style.GREY, label, width=0.7, style=(0, (2, 2)))
    draw.level(band, limit, f"±{limit:g} mm")
    draw.level(band, -limit, "")
    _percent(outside, x, study, own)
    for axes, title, quantity in (
        (band, "(a) heights", "above wanted [mm]"),
        (outside, f"(b) share of the samples beyond ±{limit:g} mm, with 95 % limits", "share [%]"),
    ):
        style.describe(axes, title, _CHAINAGE, quantity)
        draw.mark_supports(axes, study.supports)
    style.legend_above(band)
    return figure


def histogram_figure(study: ToleranceStudy) -> Figure:
    """Draw how the largest height error of a line is distributed."""
    share, low, high = (100.0 * value for value in study.event("leaving"))
    by_linear = 100.0 * study.event("leaving, linear")[0]
    text = (
        f"{study.samples} samples, {study.model}. Somewhere beyond ±{1e3 * study.tolerance:g} mm: "
        f"{share:.3g} % (95 % limits {low:.3g} % to {high:.3g} %); linearised line: {by_linear:.3g} %.\n"
        f"Samples without rest: {study.count_of('no rest')}; with a slack dropper: {study.count_of('slack')}."
    )
    figure, [[axes]] = style.new_figure("Largest height error of a line", text, [3.4])
    most = 1.001 * max(float(study.worst.max()), study.tolerance)
    edges: FloatArray = np.linspace(0.0, 1e3 * most, _BINS + 1)
    draw_statistics.histogram(axes, 1e3 * study.worst, edges, f"{study.model} line")
    if study.model != "linear":
        draw_statistics.outline(axes, 1e3 * study.linear_worst, edges, "linearised line")
    draw_statistics.upright(axes, 1e3 * study.tolerance, "tolerance")
    style.describe(axes, "", "largest deviation from wanted heights at droppers [mm]", "samples")
    style.legend_above(axes)
    return figure


def importance_figure(study: ToleranceStudy) -> Figure:
    """Draw which groups of errors and which single errors make heights scatter."""
    of, errors = study.importance, study.errors
    order = np.argsort(-errors.share, kind="stable")[:_MOST]
    text = (
        "Shares of the variance of contact-wire heights, summed over all droppers.\n"
        "Bars: from linear sensitivities. Dots: first-order Sobol indices from the samples."
    )
    heights = [0.5 + 0.26 * max(len(of.group), 1), 0.5 + 0.2 * max(order.size, 1)]
    figure, [[groups], [single]] = style.new_figure("Which errors matter", text, heights)
    draw_statistics.named_shares(groups, of.group, of.share)
    if of.group:
        draw.points(
            groups, 100.0 * of.sampled_share, np.arange(float(len(of.group))), style.DARK, "from samples"
        )
    names = tuple(f"{errors.group[k]}, {errors.name[k]}" for k in order)
    draw_statistics.named_shares(single, names, errors.share[order])
    for axes, title in ((groups, "(a) groups"), (single, "(b) single errors that matter most")):
        style.describe(axes, title, "share of variance [%]", "")
    draw_statistics.reach(groups, 140.0 * max([1e-3, *of.share, *of.sampled_share]))
    draw_statistics.reach(single, 160.0 * max([1e-3, *errors.share]))
    return figure


def force_figure(study: ToleranceStudy) -> Figure:
    """Draw the percentiles of forces in droppers."""
    text = f"{study.samples} samples, {study.model}. Samples with a slack dropper: {study.count_of('slack')}."
    figure, [[axes]] = style.new_figure("Forces in droppers under errors of installation", text, [3.2])
    x, force = study.chainage, study.force
    for (low, high, _), colour in zip(_BANDS[::2], (style.SKY, style.BLUE), strict=True):
        least, most = (force.percentile[:, LEVELS.index(level)] for level in (low, high))
        draw.bars(axes, x, least, most, f"{low:g} % to {high:g} %", colour)
    draw.points(axes, x, force.nominal, style.DARK, "without errors")
    style.describe(axes, "", _CHAINAGE, "force [N]")
    draw.mark_supports(axes, study.supports)
    style.legend_above(axes)
    return figure


def rounding_figure(study: RoundingStudy) -> Figure:
    """Draw the height errors that follow from rounded dropper lengths."""
    text = "Heights of the contact wire at droppers above the wanted ones, with lengths rounded half up."
    figure, [[axes]] = style.new_figure("Contact wire with rounded dropper lengths", text, [3.4])
    own = study.on_contact_wire
    for rounded, colour in zip(study.rounded, _colours(len(study.rounded)), strict=True):
        error, label = 1e3 * rounded.height_error[own], f"step {1e3 * rounded.step:g} mm"
        draw.line(axes, study.chainage[own], error, colour, width=0.9)
        draw.points(axes, study.chainage[own], error, colour, label)
    style.describe(axes, "", _CHAINAGE, "above wanted [mm]")
    draw.mark_supports(axes, study.supports)
    style.legend_above(axes)
    return figure


def _colours(count: int) -> list[str]:
    return [style.CYCLE[i % len(style.CYCLE)] for i in range(count)]


def _above(height: Scatter, wanted: FloatArray, own: NDArray[np.bool_]) -> FloatArray:
    """Return percentiles above the wanted heights, shape (n_levels, n) [mm]."""
    return 1e3 * (height.percentile - wanted[:, None])[own].T


def _percent(axes: Axes, x: FloatArray, study: ToleranceStudy, own: NDArray[np.bool_]) -> None:
    low, high = (100.0 * values[own] for values in (study.outside.lower, study.outside.upper))
    draw.bars(axes, x, low, high, "", style.GREY)
    draw.points(axes, x, 100.0 * study.outside.probability[own], style.RED, "")
