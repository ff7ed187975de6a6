"""From lines and results to studies and their folders."""

from __future__ import annotations

import csv
from pathlib import Path

import pytest

from catenaria import workflow
from catenaria.errors import InconsistentInputError, LineFileError, UnsupportedError
from catenaria.line import Line, load_line
from catenaria.line.installation import usual_installation
from catenaria.loading.tolerance import Options
from catenaria.results import FormResult, save_result
from catenaria.results.tolerance import ToleranceStudy

EXAMPLES = Path(__file__).parents[2] / "examples"
EXAMPLE = EXAMPLES / "yang2017_three_span.yaml"
FEW = Options(samples=60)


@pytest.fixture(scope="module")
def result() -> FormResult:
    return workflow.solve(EXAMPLE)


@pytest.fixture(scope="module")
def study(result: FormResult) -> ToleranceStudy:
    return workflow.tolerances(result, options=FEW)


def rows(file: Path) -> list[dict[str, str]]:
    with file.open(encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


def test_results_folders_lines_and_files_give_the_same(
    result: FormResult, study: ToleranceStudy, tmp_path: Path
) -> None:
    save_result(result, tmp_path)
    for source in (tmp_path, tmp_path / "result.json", EXAMPLE, load_line(EXAMPLE)):
        other = workflow.tolerances(source, options=FEW)
        assert other.worst == pytest.approx(study.worst, abs=1e-8)


def test_errors_come_from_the_file_then_the_line_then_practice(tmp_path: Path, result: FormResult) -> None:
    usual = workflow.tolerances(result, options=FEW)
    assert usual.installation == usual_installation().model_dump(mode="json")
    own = {"dropper_length": {"distribution": "uniform", "scale": 0.001}, "seed": 5}
    line = Line.model_validate(result.inputs | {"installation": own})
    assert workflow.tolerances(line, options=FEW).importance.group == ("dropper length",)
    assert workflow.tolerances(line, options=FEW).seed == 5
    assert workflow.tolerances(line, options=FEW, seed=6).seed == 6
    given = workflow.tolerances(line, EXAMPLES / "installation_errors.yaml", FEW)
    assert given.seed == 2017
    assert len(given.importance.group) == 7
    file = tmp_path / "errors.yaml"
    file.write_text("known: {supports: [{support: S9}]}\n", encoding="utf-8")
    with pytest.raises(LineFileError, match="S9"):
        workflow.tolerances(result, file, FEW)


def test_forms_without_nodes_are_refused() -> None:
    strings = workflow.solve(EXAMPLE, method="separated")
    with pytest.raises(UnsupportedError, match="separated"):
        workflow.tolerances(strings, options=FEW)


def test_a_folder_holds_everything(study: ToleranceStudy, tmp_path: Path) -> None:
    files = {
        path.relative_to(tmp_path / "out").as_posix()
        for path in workflow.write_tolerances(study, tmp_path / "out")
    }
    names = ("heights", "forces", "tensions", "elasticity", "groups", "errors", "events")
    figures = ("heights", "worst", "importance", "forces")
    assert files == {"result.json", "result.npz"} | {f"{name}.csv" for name in names} | {
        f"figures/{name}.png" for name in figures
    }
    heights = rows(tmp_path / "out" / "heights.csv")
    assert len(heights) == 21
    assert float(heights[3]["percentile_50_above_wanted_mm"]) == pytest.approx(
        1e3 * (study.height.percentile[3, 3] - study.wanted_height[3]), abs=1e-4
    )
    shares = [float(row["share_of_variance"]) for row in rows(tmp_path / "out" / "errors.csv")]
    assert shares == sorted(shares, reverse=True)
    events = {row["event"]: row for row in rows(tmp_path / "out" / "events.csv")}
    assert int(events["leaving"]["count"]) == study.count_of("leaving")
    assert float(rows(tmp_path / "out" / "elasticity.csv")[1]["nominal_mm_per_N"]) == pytest.approx(
        0.569, abs=1e-3
    )


def test_studies_without_scatter_are_drawn_too(result: FormResult, tmp_path: Path) -> None:
    line = Line.model_validate(result.inputs | {"installation": {"seed": 1}})
    study = workflow.tolerances(line, options=Options(samples=2))
    assert len(workflow.write_tolerances(study, tmp_path / "out")) == 13


def test_somebody_elses_folder_is_left_alone(study: ToleranceStudy, tmp_path: Path) -> None:
    (tmp_path / "mine.txt").write_text("mine", encoding="utf-8")
    with pytest.raises(InconsistentInputError, match=r"mine\.txt"):
        workflow.write_tolerances(study, tmp_path, figures=False)
    assert [path.name for path in tmp_path.iterdir()] == ["mine.txt"]


def test_rounded_lengths_are_written(result: FormResult, tmp_path: Path) -> None:
    study = workflow.rounding(result, [0.005, 0.01])
    files = workflow.write_rounding(study, tmp_path / "out")
    assert {path.name for path in files} == {
        "result.json",
        "result.npz",
        "rounding.csv",
        "steps.csv",
        "rounding.png",
    }
    table = rows(tmp_path / "out" / "rounding.csv")
    assert len(table) == 42
    assert float(table[21]["rounded_cut_length_m"]) * 100 == pytest.approx(
        round(float(table[21]["rounded_cut_length_m"]) * 100)
    )
    steps = rows(tmp_path / "out" / "steps.csv")
    worst = max(abs(float(row["height_error_m"])) for row in table[:21])
    assert float(steps[0]["largest_height_error_m"]) == pytest.approx(worst)
