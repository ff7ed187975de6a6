"""Figures of lines in space: what they show, and that they fit their panels."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure

from catenaria.report import history_figures, space_figures, style
from catenaria.report.figures import write_figures
from catenaria.results import FormResult

DRAWINGS: dict[str, Callable[[FormResult], Figure]] = {
    "profile": space_figures.profile_figure,
    "plan": space_figures.plan_figure,
    "contact_wire": space_figures.wanted_height_figure,
}


def lines_of(figure: Figure, panel: int = 0) -> dict[str, Any]:
    return {str(line.get_label()): line for line in figure.axes[panel].get_lines()}


def segments(figure: Figure, label: str) -> np.ndarray:
    """Return all bars of one label, shape (n, 2, 2)."""
    bars = [bars for axes in figure.axes for bars in axes.collections if isinstance(bars, LineCollection)]
    return np.concatenate([np.array(each.get_segments()) for each in bars if each.get_label() == label])


def outside(figure: Figure) -> list[str]:
    """Name panels and legends that reach over the figure's edge."""
    FigureCanvasAgg(figure).draw()
    found: list[str] = []
    for axes in figure.axes:
        legend = axes.get_legend()
        boxes = [axes.get_tightbbox(), *([] if legend is None else [legend.get_window_extent()])]
        if not all(figure.bbox.x0 <= box.x0 and box.x1 <= figure.bbox.x1 for box in boxes):
            found.append(axes.get_ylabel())
    return found


@pytest.mark.parametrize("name", list(DRAWINGS))
@pytest.mark.parametrize("spans", [1, 3, 20])
def test_nothing_is_cut_off(make_in_space: Callable[[int], FormResult], name: str, spans: int) -> None:
    figure = DRAWINGS[name](make_in_space(spans))
    assert outside(figure) == []
    assert len(figure.axes) == {1: 1, 3: 1, 20: 3}[spans]
    figure.axes[0].set_ylabel("beyond")
    figure.axes[0].set_title("a title that is wider than the page " * 8)
    assert outside(figure) == ["beyond"]


def test_the_profile_shows_all_wires_and_droppers(in_space: FormResult) -> None:
    figure = space_figures.profile_figure(in_space)
    drawn = lines_of(figure)
    for wire in in_space.wires[:2]:
        np.testing.assert_array_equal(drawn[wire.name].get_ydata(), wire.profile.height)
    assert "stitch wire" in drawn  # one label for both
    bars, droppers = segments(figure, "dropper"), in_space.droppers
    np.testing.assert_array_equal(bars[:, 0], np.column_stack((droppers.x, droppers.height)))
    np.testing.assert_array_equal(bars[:, 1], np.column_stack((droppers.x, droppers.messenger_height)))
    np.testing.assert_array_equal(drawn["slack dropper"].get_xdata(), droppers.x[2:3])
    assert "those that lift nothing are marked: 1 of 21" in figure.texts[1].get_text()


def test_without_slack_droppers_none_are_marked(in_space: FormResult) -> None:
    """Negative control of the mark above."""
    tight = replace(in_space.droppers, force_bottom=np.abs(in_space.droppers.force_bottom))
    assert "slack dropper" not in lines_of(space_figures.profile_figure(replace(in_space, droppers=tight)))


def test_the_plan_shows_stagger_and_arms(in_space: FormResult) -> None:
    figure = space_figures.plan_figure(in_space)
    drawn, arms = lines_of(figure), in_space.arms
    np.testing.assert_array_equal(drawn["contact wire"].get_ydata(), in_space.wires[0].profile.lateral)
    (hinges,) = (line for line in figure.axes[0].get_lines() if line.get_marker() == "o")
    np.testing.assert_array_equal(hinges.get_ydata(), arms.hinge_stagger)
    np.testing.assert_allclose(segments(figure, "steady arm")[:, 1, 1], [0.2, -0.2, 0.2, -0.2])
    bars = segments(figure, "dropper")
    np.testing.assert_array_equal(bars[:, 0, 1], in_space.droppers.stagger_bottom)


def test_panels_follow_each_other_to_one_scale(make_in_space: Callable[[int], FormResult]) -> None:
    figure = space_figures.profile_figure(make_in_space(20))
    windows = [axes.get_xlim() for axes in figure.axes]
    assert [end for _, end in windows[:-1]] == [start for start, _ in windows[1:]]
    assert windows[0][0] == pytest.approx(-0.5)
    assert windows[-1][1] == pytest.approx(1300.5)
    assert len({axes.get_ylim() for axes in figure.axes}) == 1
    assert len({axes.get_xlabel() for axes in figure.axes}) == 1


def test_the_contact_wire_is_drawn_against_its_wanted_heights(in_space: FormResult) -> None:
    """Equal shifts of wire and wish change nothing, a shift of the wish does."""
    first = lines_of(space_figures.wanted_height_figure(in_space))["contact wire"].get_ydata()
    rise = in_space.droppers.x * 0.01
    risen = replace(in_space, droppers=replace(in_space.droppers, target_height=rise))
    profile = in_space.wires[0].profile
    wires = (
        replace(in_space.wires[0], profile=replace(profile, height=profile.height + 0.01 * profile.chainage)),
    )
    both = lines_of(space_figures.wanted_height_figure(replace(risen, wires=wires + in_space.wires[1:])))
    np.testing.assert_allclose(both["contact wire"].get_ydata(), first, atol=1e-9)
    other = lines_of(space_figures.wanted_height_figure(risen))["contact wire"].get_ydata()
    assert np.abs(other - first).max() > 100.0


def test_all_figures_are_written(in_space: FormResult, tmp_path: Path) -> None:
    files = {file.stem for file in write_figures(in_space, tmp_path)}
    over_time = {"tensions", "controls", "errors", "energy"}
    assert files == {*DRAWINGS, "moments", "contact_tension", "messenger_tension"} | over_time


def test_controls_of_all_tensions_are_told_from_those_of_droppers(in_space: FormResult) -> None:
    figure = history_figures.velocity_figure(in_space)
    assert [len(axes.get_lines()) for axes in figure.axes] == [4, 18]
    assert "longer for tied wires and droppers" in figure.texts[1].get_text()
    assert [axes.get_ylabel() for axes in figure.axes] == [
        "velocity outwards [mm/s]",
        "velocity of lengthening [mm/s]",
    ]


def test_wires_of_one_role_have_one_colour() -> None:
    assert style.wire_colour("stitch wire S2", "stitch wire") == style.wire_colour(
        "stitch wire", "stitch wire"
    )
    colours = [style.wire_colour(name, name) for name in style.WIRE_COLOURS]
    assert len(set(colours)) == len(colours)
    second = style.wire_colour("second contact wire", "contact wire")
    assert second != style.wire_colour("contact wire", "contact wire")
