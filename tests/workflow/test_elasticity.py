"""From a result to a study of elasticity on disk, with its tables and its figure."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from catenaria.errors import InconsistentInputError
from catenaria.line.load_case import LoadCases
from catenaria.report.elasticity_figure import elasticity_figure
from catenaria.results import FormResult, load_result, save_result
from catenaria.results.elasticity import ElasticityStudy
from catenaria.workflow import elasticity, solve, under_loads, write_elasticity

EXAMPLE = Path(__file__).parents[2] / "examples" / "yang2017_three_span.yaml"


@pytest.fixture(scope="module")
def result() -> FormResult:
    """Return the form of the paper's line."""
    return solve(EXAMPLE, rebuild="none")


@pytest.fixture(scope="module")
def study(result: FormResult) -> ElasticityStudy:
    """Return its elasticity under 200 N."""
    return elasticity(result, 200.0, 1.0, elasticity_limit=0.6e-3, nonuniformity_limit=0.4)


def rows(file: Path) -> list[dict[str, str]]:
    with file.open(encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


def test_comes_back_from_disk(study: ElasticityStudy, tmp_path: Path) -> None:
    save_result(study, tmp_path)
    again = load_result(tmp_path, ElasticityStudy)
    np.testing.assert_array_equal(again.points.elasticity, study.points.elasticity)
    np.testing.assert_array_equal(again.compared.nonlinear, study.compared.nonlinear)
    assert (again.held, again.points.place, again.inputs) == (study.held, study.points.place, study.inputs)
    with pytest.raises(InconsistentInputError, match="not a catenaria form-finding result"):
        load_result(tmp_path)


@pytest.mark.parametrize("chainage", [91.5, 93.0, 97.5, 99.0])
def test_a_load_case_gives_the_same_uplift(result: FormResult, chainage: float) -> None:
    """Which puts nodes where it pushes, instead of adding what elements lack, up to 1 % here."""
    study = elasticity(result, 200.0, 0.5, nonlinear=True, start=chainage - 2.0, end=chainage + 2.0)
    case = {"push": [{"chainage": chainage, "force": 200.0}]}
    loads = under_loads(result, LoadCases.model_validate({"format": 1, "cases": {"push": case}}))
    uplift = float(loads.cases[0].pushed.uplift[0])
    (i,) = np.flatnonzero(np.abs(study.points.chainage - chainage) < 1e-6)
    assert study.points.elasticity[i] == pytest.approx(uplift / 200.0, rel=5e-4)
    assert study.points.elasticity[i - 3] != pytest.approx(uplift / 200.0, rel=5e-4)


def test_tables(study: ElasticityStudy, tmp_path: Path) -> None:
    files = write_elasticity(study, tmp_path / "out")
    names = {file.name for file in files}
    wanted = {"elasticity.csv", "spans.csv", "comparison.csv", "elasticity.png", "result.json", "result.npz"}
    assert wanted <= names
    points = rows(tmp_path / "out" / "elasticity.csv")
    assert list(points[0]) == [
        *("chainage_m", "span", "place", "elasticity_mm_per_N", "uplift_mm", "slack_droppers"),
    ]
    assert len(points) == study.points.chainage.size
    row = points[int(np.argmax(study.points.elasticity))]
    assert float(row["uplift_mm"]) == pytest.approx(200.0 * float(row["elasticity_mm_per_N"]), rel=1e-4)
    spans = rows(tmp_path / "out" / "spans.csv")
    assert [row["inner"] for row in spans] == ["False", "True", "False"]
    low, high = (float(spans[1][f"by_hand_k_{k}_mm_per_N"]) for k in ("4", "3.5"))
    assert low == pytest.approx(1e3 * 65.0 / 30e3 / 4.0, rel=1e-3)
    assert high == pytest.approx(low * 4.0 / 3.5, rel=1e-5)
    assert {row["same_slack"] for row in rows(tmp_path / "out" / "comparison.csv")} == {"True"}


def test_limits(study: ElasticityStudy) -> None:
    """The largest elasticity is 0.63 mm/N, the non-uniformity 36 %."""
    (broken,) = study.broken_limits()
    assert broken.startswith("the elasticity is 0.6339")
    assert broken.endswith("the limit is 0.6 mm/N")


def test_the_figure_shows_the_study(study: ElasticityStudy) -> None:
    figure = elasticity_figure(study)
    FigureCanvasAgg(figure).draw()
    whole, span = figure.axes
    lines = {str(line.get_label()): line for line in whole.get_lines()}
    np.testing.assert_array_equal(lines["elasticity"].get_ydata(), 1e3 * study.points.elasticity)
    slack = np.asarray(lines["droppers slack"].get_ydata(), dtype=np.float64)
    np.testing.assert_array_equal(np.isfinite(slack), study.points.slack > 0)
    np.testing.assert_array_equal(lines["nonlinear"].get_ydata(), 1e3 * study.compared.nonlinear)
    assert list(np.asarray(lines["limit"].get_ydata())) == [0.6, 0.6]
    assert "36.0 %" in span.get_title(loc="left")
    marks = {str(line.get_label()): line for line in span.get_lines()}
    assert np.size(marks["dropper"].get_xdata()) == 7
    boxes = [axes.get_tightbbox() for axes in figure.axes]
    assert all(box is not None and box.x1 <= figure.bbox.x1 for box in boxes)


def test_progress_is_told(result: FormResult) -> None:
    told: list[tuple[str, int, int]] = []
    elasticity(result, 100.0, 20.0, progress=lambda *news: told.append(news))
    assert {name for name, _, _ in told} == {"linear responses", "comparison"}
    assert all(done <= of for _, done, of in told)
    assert told[-1][1] == told[-1][2]


def test_a_line_and_its_file_are_solved_first(study: ElasticityStudy) -> None:
    other = elasticity(EXAMPLE, 200.0, 1.0)
    np.testing.assert_allclose(other.points.elasticity, study.points.elasticity, atol=1e-12)
