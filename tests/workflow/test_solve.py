"""From a line or its file to a result: what is accepted, what is refused, what is said on the way."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from itertools import groupby
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from catenaria.errors import InconsistentInputError, LineFileError, NotConvergedError, UnsupportedError
from catenaria.line import Line, Mesh
from catenaria.results import NOT_REBUILT, FormResult
from catenaria.workflow import METHODS, NEGLECTS, Progress, Rebuild, solve
from catenaria.workflow.methods import SPATIAL

Vary = Callable[[dict[str, Any]], Line]

STAGES = ["contact wire", "messenger wire", "lengths", "rebuild"]


def test_a_file_and_its_line_give_the_same(small_file: Path, small_result: FormResult) -> None:
    for path in (small_file, str(small_file)):
        again = solve(path)
        np.testing.assert_array_equal(again.droppers.length, small_result.droppers.length)
        assert again.inputs == small_result.inputs


def test_another_line_gives_another_result(vary: Vary, small: Line, small_result: FormResult) -> None:
    data = small.model_dump()
    data["gravity"] = 9.9
    assert not np.array_equal(solve(Line.model_validate(data)).droppers.length, small_result.droppers.length)


def test_direct_is_the_default(small: Line, small_result: FormResult) -> None:
    assert small_result.method == "direct"
    assert solve(small, method="dynamic").method == "dynamic"
    assert small_result.histories == ()


BENT = ("direct", "dynamic")  # methods whose results have nodes, to be rebuilt and to begin from


def test_what_each_method_neglects_is_said() -> None:
    assert list(NEGLECTS) == list(METHODS)
    assert all(NEGLECTS.values())


def test_strings_are_not_rebuilt(small: Line) -> None:
    result = solve(small, method="force density", rebuild="static")
    assert (result.audit.passed, result.rebuilt) == (True, NOT_REBUILT)


@pytest.mark.parametrize("method", ["", "Direct", "newton"])
def test_an_unknown_method_is_refused_with_those_there_are(small: Line, method: str) -> None:
    with pytest.raises(UnsupportedError) as refusal:
        solve(small, method=method)
    assert repr(method) in str(refusal.value)
    assert all(name in str(refusal.value) for name in METHODS)


@pytest.mark.parametrize("rebuild", ["static", "relaxation"])
@pytest.mark.parametrize("method", BENT)
def test_every_result_is_rebuilt_as_asked(small: Line, method: str, rebuild: Rebuild) -> None:
    rebuilt = solve(small, method=method, rebuild=rebuild).rebuilt
    assert (rebuilt.way, rebuilt.passed) == (rebuild, True)
    assert rebuilt.height.value.shape == (2,)


def test_the_rebuild_is_static_or_left_out(small: Line, small_result: FormResult) -> None:
    assert small_result.rebuilt.way == "static"
    assert solve(small, rebuild="none").rebuilt == NOT_REBUILT


def test_an_unknown_rebuild_is_refused_with_those_there_are(small: Line) -> None:
    wrong: Any = "dynamic"
    with pytest.raises(UnsupportedError, match="no rebuild 'dynamic'; there is static, relaxation, none"):
        solve(small, rebuild=wrong)


def test_a_rebuild_by_relaxation_that_there_is_not_is_refused(small: Line) -> None:
    with pytest.raises(
        UnsupportedError, match="only forms by direct and dynamic are rebuilt, not by 'separated'"
    ):
        solve(small, method="separated", rebuild="relaxation")
    assert "Not rebuilt" in solve(small, method="separated").rebuilt.lines()[0]


def test_a_rebuild_that_fails_hands_the_result_on(small: Line, monkeypatch: pytest.MonkeyPatch) -> None:
    def failing(line: Line, result: FormResult, way: str) -> None:
        raise NotConvergedError("the rebuilt line: lost", "none")

    monkeypatch.setattr(import_module("catenaria.workflow.solve"), "rebuild_line", failing)
    with pytest.raises(NotConvergedError, match="the rebuilt line: lost") as failure:
        solve(small)
    assert isinstance(failure.value.partial, FormResult)
    assert failure.value.partial.audit.passed
    assert failure.value.partial.rebuilt == NOT_REBUILT


def test_fields_of_a_mesh_replace_those_of_the_line(small: Line, small_result: FormResult) -> None:
    finer = solve(small, mesh=Mesh(refine=2))
    before, after = (result.inputs["solver"]["mesh"] for result in (small_result, finer))
    assert after == before | {"refine": 2}
    assert finer.counters[0].unknowns > 1.5 * small_result.counters[0].unknowns
    assert np.abs(finer.droppers.length - small_result.droppers.length).max() < 0.1e-3
    assert solve(small, mesh=Mesh()).inputs == small_result.inputs


def test_an_unknown_method_is_refused_before_the_file_is_read(tmp_path: Path) -> None:
    with pytest.raises(UnsupportedError):
        solve(tmp_path / "no file", method="newton")


@pytest.mark.parametrize("method", METHODS)
def test_an_unsupported_line_is_refused_before_solving(vary: Vary, method: str) -> None:
    heard: list[Progress] = []
    line = vary({"contact_wire.tension.pulled": "end", "dropper.joint": "frictionless"})
    with pytest.raises(UnsupportedError, match=r"dropper\.joint: .* is not solved"):
        solve(line, method=method, progress=heard.append)
    assert heard == []


@pytest.mark.parametrize("method", [method for method in METHODS if method not in SPATIAL])
def test_a_line_beyond_the_plane_is_refused_by_methods_for_plane_lines(vary: Vary, method: str) -> None:
    heard: list[Progress] = []
    with pytest.raises(UnsupportedError, match=rf"contact_wire\.tension\.pulled: .* the method '{method}'"):
        solve(vary({"contact_wire.tension.pulled": "end"}), method=method, progress=heard.append)
    assert heard == []


def test_a_missing_or_broken_file_is_refused(tmp_path: Path) -> None:
    with pytest.raises(LineFileError):
        solve(tmp_path / "missing.yaml")
    broken = tmp_path / "broken.yaml"
    broken.write_text("format: 1\nname: [", encoding="utf-8")
    with pytest.raises(LineFileError):
        solve(broken)


def stages(heard: list[Progress]) -> list[tuple[str, int]]:
    """Return the stages in the order in which they were heard, compiling left out."""
    names = [(progress.stage, progress.stage_number) for progress in heard if progress.stage != "compiling"]
    return [name for name, _ in groupby(names)]


@pytest.mark.parametrize("method", BENT)
def test_stages_are_told_in_order(small: Line, method: str) -> None:
    heard: list[Progress] = []
    solve(small, method=method, progress=heard.append)
    assert stages(heard) == list(zip(STAGES, (1, 2, 3, 3), strict=True))
    assert len({progress.stage_count for progress in heard}) == 1
    elapsed = [progress.elapsed for progress in heard if progress.stage != "compiling"]
    assert elapsed == sorted(elapsed)
    assert stages(heard[::-1]) != stages(heard)


def test_the_dynamic_method_tells_every_step(small: Line) -> None:
    heard: list[Progress] = []
    result = solve(small, method="dynamic", progress=heard.append)
    for history in result.histories:
        steps = [progress for progress in heard if progress.stage == history.step and progress.step > 0]
        np.testing.assert_array_equal([step.time for step in steps], history.time[1:])
        np.testing.assert_array_equal([step.step for step in steps], np.arange(1, history.time.size))
        assert {step.worst_control for step in steps} <= set(history.control_name)
        worst = steps[-1].worst_error_in_bands
        errors = {
            e
            for e, name in zip(history.error[-1], history.control_name, strict=True)
            if name == steps[-1].worst_control
        }
        assert worst == pytest.approx(np.abs(errors.pop()) / band(result, steps[-1].worst_control))


def band(result: FormResult, name: str) -> float:
    controls = result.controls
    return float(controls.dead_band[controls.name.index(name)])


def test_a_listener_that_fails_ends_the_run(small: Line) -> None:
    """Nothing swallows what a listener raises: that is how Ctrl-C gets out."""

    def failing(progress: Progress) -> None:
        if progress.stage == "messenger wire":
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        solve(small, method="dynamic", progress=failing)


@pytest.mark.parametrize("first", BENT)
@pytest.mark.parametrize("second", BENT)
def test_each_method_starts_from_each(small: Line, first: str, second: str) -> None:
    """The second run has next to nothing to do."""
    begun = solve(small, method=first)
    again = solve(small, method=second, start=begun)
    np.testing.assert_allclose(again.droppers.length, begun.droppers.length, atol=1e-3)
    work = max(counter.steps for counter in again.counters)
    assert work <= max(counter.steps for counter in solve(small, method=second).counters)


@pytest.mark.parametrize("method", BENT)
def test_a_start_of_another_line_is_refused(
    vary: Vary, small_result: FormResult, example: Path, method: str
) -> None:
    with pytest.raises(InconsistentInputError, match="has 2 droppers, the line has 21"):
        solve(example, method=method, start=small_result)
