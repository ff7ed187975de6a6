"""Figures: which are written, what they show, and that no text is cut off or covered."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import matplotlib
import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from catenaria.report import history_figures, line_figures, style
from catenaria.report.figures import write_figures
from catenaria.results import FormResult

LINE_FIGURES = {"configurations", "contact_wire", "moments", "contact_tension", "messenger_tension"}
HISTORY_FIGURES = {"tensions", "controls", "errors", "energy"}
DRAWINGS: dict[str, Callable[[FormResult], Figure]] = {
    "configurations": line_figures.configuration_figure,
    "contact_wire": line_figures.contact_wire_figure,
    "moments": line_figures.moment_figure,
    "contact_tension": lambda result: line_figures.tension_figure(result, result.wires[0]),
    "messenger_tension": lambda result: line_figures.tension_figure(result, result.wires[1]),
    "tensions": history_figures.support_tension_figure,
    "controls": history_figures.velocity_figure,
    "errors": history_figures.error_figure,
    "energy": history_figures.energy_figure,
}


def lines_of(figure: Figure, panel: int = 0) -> dict[str, Any]:
    return {str(line.get_label()): line for line in figure.axes[panel].get_lines()}


def cut_off(figure: Figure) -> list[str]:
    """Name panels, titles and legends that reach over the figure's edge, and legends that cross a panel's."""
    FigureCanvasAgg(figure).draw()
    found = [text.get_text() for text in figure.texts if not _within(text.get_window_extent(), figure.bbox)]
    for axes in figure.axes:
        if not _within(axes.get_tightbbox(), figure.bbox):
            found.append(f"labels of {axes.get_ylabel()}")
        legend = axes.get_legend()
        if legend is not None:
            box = legend.get_window_extent()
            above = box.y0 >= axes.bbox.y1 and _within(box, figure.bbox)
            if not (above or _within(box, axes.bbox)):
                found.append(f"legend of {axes.get_ylabel()}")
    return found


def covered(figure: Figure) -> list[str]:
    """Name what the legends lie over: titles, names of supports, and lines that mark supports."""
    FigureCanvasAgg(figure).draw()
    found: list[str] = []
    for axes in figure.axes:
        legend = axes.get_legend()
        if legend is None:
            continue
        box = legend.get_window_extent()
        texts = [*figure.texts, *axes.texts, axes._left_title]  # pyright: ignore[reportAttributeAccessIssue]
        found += [
            text.get_text() for text in texts if text.get_text() and box.overlaps(text.get_window_extent())
        ]
        upright = [line for line in axes.get_lines() if len({*np.asarray(line.get_xdata()).tolist()}) == 1]
        found += [f"line {line.get_label()}" for line in upright if box.overlaps(line.get_window_extent())]
    return found


def _within(box: Any, edge: Any) -> bool:
    return bool(edge.x0 <= box.x0 and box.x1 <= edge.x1 and edge.y0 <= box.y0 and box.y1 <= edge.y1)


@pytest.mark.parametrize("spans", [1, 3, 40])
@pytest.mark.parametrize("name", list(DRAWINGS))
def test_no_text_is_cut_off(make_result: Callable[[int], FormResult], name: str, spans: int) -> None:
    assert cut_off(DRAWINGS[name](make_result(spans))) == []


@pytest.mark.parametrize("spans", [1, 3, 40])
@pytest.mark.parametrize("name", list(DRAWINGS))
def test_no_legend_covers_anything(make_result: Callable[[int], FormResult], name: str, spans: int) -> None:
    assert covered(DRAWINGS[name](make_result(spans))) == []


def test_a_covered_support_line_would_be_noticed(result: FormResult) -> None:
    """Negative control of the test above: a legend within a panel lies over the last support."""
    figure = line_figures.configuration_figure(result)
    style.legend(figure.axes[0], 3)
    assert covered(figure) != []


def test_text_that_is_cut_off_would_be_noticed(result: FormResult) -> None:
    """Negative control of the test above."""
    figure = line_figures.contact_wire_figure(result)
    figure.axes[0].set_ylabel("a label that is longer than the axis " * 4)
    figure.axes[0].get_lines()[0].set_label("a name that is longer than the panel " * 6)
    figure.axes[0].legend()
    figure.text(0.9, 0.5, "a title that is too long")
    assert len(cut_off(figure)) == 3


@pytest.mark.parametrize("name", list(DRAWINGS))
def test_every_panel_states_quantity_and_unit(result: FormResult, name: str) -> None:
    figure = DRAWINGS[name](result)
    assert figure.texts[0].get_text()
    for axes in figure.axes:
        assert axes.get_xlabel().partition(";")[0].endswith((" [m]", " [s]"))
        assert axes.get_ylabel().endswith("]")


@pytest.mark.parametrize("spans", [1, 3])
def test_all_figures_are_written(
    make_result: Callable[[int], FormResult], tmp_path: Path, spans: int
) -> None:
    files = write_figures(make_result(spans), tmp_path / "figures")
    assert {file.stem for file in files} == LINE_FIGURES | HISTORY_FIGURES
    for file in files:
        assert file.read_bytes().startswith(b"\x89PNG")


def test_a_method_without_dynamic_steps_has_no_figures_over_time(result: FormResult, tmp_path: Path) -> None:
    files = write_figures(replace(result, histories=(), counters=(), stages=()), tmp_path)
    assert {file.stem for file in files} == LINE_FIGURES


def test_equal_results_give_equal_pictures(result: FormResult, tmp_path: Path) -> None:
    pictures = [
        [file.read_bytes() for file in write_figures(replace(result, histories=()), tmp_path / name)]
        for name in ("a", "b")
    ]
    assert pictures[0] == pictures[1]


def test_contact_wire_is_drawn_in_millimetres_over_the_wanted_height(result: FormResult) -> None:
    raised = replace(result.droppers, target_height=result.droppers.target_height - 0.5)
    profile = result.wires[0].profile
    for droppers, datum in ((result.droppers, 0.0), (raised, -0.5)):
        drawn = lines_of(line_figures.contact_wire_figure(replace(result, droppers=droppers)))
        np.testing.assert_allclose(drawn["contact wire"].get_ydata(), 1e3 * (profile.z - datum), atol=1e-9)
        np.testing.assert_array_equal(drawn["dropper"].get_xdata(), droppers.x)


def test_the_stated_exaggeration_is_that_of_the_picture(result: FormResult) -> None:
    figure = line_figures.contact_wire_figure(result)
    axes = figure.axes[0]
    stated = float(axes.get_xlabel().split("scale ")[1].split(" times")[0])
    (x0, y0), (x1, y1) = axes.transData.transform([(0.0, 0.0), (1.0, 1000.0)])  # 1 m each way
    assert stated == pytest.approx((y1 - y0) / (x1 - x0), rel=0.05)


def test_dropper_lengths_are_written_if_they_fit(make_result: Callable[[int], FormResult]) -> None:
    few, many = make_result(3), make_result(10)
    written = {text.get_text() for text in line_figures.configuration_figure(few).axes[1].texts}
    assert {f"{length:.3f}" for length in few.droppers.length} <= written
    crowded = line_figures.configuration_figure(many)
    assert not {f"{length:.3f}" for length in many.droppers.length} & {
        t.get_text() for t in crowded.axes[1].texts
    }
    assert "droppers.csv" in crowded.texts[1].get_text()


def test_tension_figure_shows_true_and_strain_tension_and_what_is_wanted(result: FormResult) -> None:
    wire = result.wires[1]
    drawn = lines_of(line_figures.tension_figure(result, wire))
    np.testing.assert_array_equal(drawn["tension"].get_ydata(), 1e-3 * wire.profile.tension)
    np.testing.assert_array_equal(drawn["N = EA ε, eq. (11)"].get_ydata(), 1e-3 * wire.profile.strain_tension)
    assert drawn["wanted: 15.000 kN"].get_ydata()[0] == 15.0
    figure = line_figures.tension_figure(result, wire)
    assert f"{wire.tension_mean:.1f} N in the mean" in figure.texts[1].get_text()
    (band,) = (patch for patch in figure.axes[0].patches if patch.get_label() == "dead band: ±20 N")
    assert (band.get_extents().y0, band.get_extents().y1) == pytest.approx(
        figure.axes[0].transData.transform([(0.0, 14.98), (0.0, 15.02)])[:, 1]
    )


def test_the_stated_offset_of_the_strain_tension_is_that_of_the_curves(result: FormResult) -> None:
    """T^2/EA, from the closed form behind the synthetic result."""
    for wire, stiffness in zip(result.wires, (15.6e6, 12.5e6), strict=True):
        text = line_figures.tension_figure(result, wire).texts[1].get_text()
        stated = float(text.partition("here by ")[2].partition(" N")[0])
        assert stated == pytest.approx(15_000.0**2 / stiffness, abs=0.2)


def test_a_method_without_dead_bands_has_none_in_its_figures(result: FormResult) -> None:
    """Negative control of the band above."""
    figure = line_figures.tension_figure(replace(result, histories=()), result.wires[1])
    assert list(figure.axes[0].patches) == []


def test_supports_of_the_other_wire_are_marked_lightly(result: FormResult) -> None:
    axes = line_figures.contact_wire_figure(result).axes[0]
    places = [(np.asarray(line.get_xdata(), dtype=float), line.get_color()) for line in axes.get_lines()]
    marks = {x[0]: colour for x, colour in places if len(x) == 2}
    assert marks == {0.0: style.GREY, 65.0: style.FAINT, 130.0: style.FAINT, 195.0: style.GREY}
    assert {text.get_text() for text in axes.texts} == {"S1", "S2", "S3", "S4"}


def test_the_tension_control_is_told_by_its_place_not_by_its_name(result: FormResult) -> None:
    renamed = replace(result.histories[0], control_name=("pull", *result.histories[0].control_name[1:]))
    figure = history_figures.velocity_figure(replace(result, histories=(renamed, result.histories[1])))
    ends = lines_of(figure, 0)["each wire end"].get_ydata()
    np.testing.assert_array_equal(ends, 1e3 * renamed.velocity[:, 0])


def test_velocities_say_which_direction_is_positive(result: FormResult) -> None:
    figure = history_figures.velocity_figure(result)
    directions = [axes.get_ylabel().split()[1] for axes in figure.axes]
    assert directions == ["outwards", "outwards", "up", "down"]
    assert {axes.get_yscale() for axes in figure.axes} == {"symlog"}


def test_line_styles_of_tensions_differ(make_result: Callable[[int], FormResult]) -> None:
    figure = history_figures.support_tension_figure(make_result(5))
    lines = [line for name, line in lines_of(figure, 1).items() if name.startswith("N at")]
    assert len(lines) == 6
    dashes = [str(line._unscaled_dash_pattern) for line in lines]
    assert len(set(dashes)) == 6
    assert figure.axes[0].get_xscale() == "log"


def test_errors_are_drawn_with_their_dead_bands(result: FormResult) -> None:
    figure = history_figures.error_figure(result)
    bands = ["dead band 5 N", "dead band 20 N", "dead band 0.01 mm", "dead band 0.02 N"]
    for panel, band in enumerate(bands):
        drawn = lines_of(figure, panel)
        assert band in drawn
        assert drawn[band].get_ydata()[0] == pytest.approx(float(band.split()[2]))
        assert figure.axes[panel].get_yscale() == "log"
    height = 1e3 * np.abs(result.histories[0].error[:, 1:]).max(axis=1)
    height[height < 0.001] = np.nan  # a tenth of the dead band, as the caption says
    assert "less than 0.1 dead bands are not drawn" in figure.texts[1].get_text()
    np.testing.assert_allclose(lines_of(figure, 2)["largest"].get_ydata(), height)


def test_very_many_droppers_are_thinned_out_and_that_is_said(
    make_result: Callable[[int], FormResult],
) -> None:
    figure = history_figures.velocity_figure(make_result(40))
    assert "1 in 5 droppers" in lines_of(figure, 2)
    assert len(figure.axes[2].get_lines()) == 56


def test_matplotlib_is_left_as_it_was(result: FormResult, tmp_path: Path) -> None:
    before = dict(matplotlib.rcParams)
    write_figures(replace(result, histories=()), tmp_path)
    assert dict(matplotlib.rcParams) == before


def test_pyplot_is_not_loaded() -> None:
    code = "import catenaria.report.figures, sys; print(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    modules = set(done.stdout.split())
    assert "matplotlib.pyplot" not in modules
    assert "matplotlib.figure" in modules
