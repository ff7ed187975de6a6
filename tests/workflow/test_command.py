"""`catenaria solve` as a user runs it: a process of its own, real lines, exit codes, Ctrl-C."""

from __future__ import annotations

import json
import signal
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from catenaria.line import Line
from catenaria.results import FormResult, load_result

Process = subprocess.Popen[str]
Start = Callable[..., Process]

TIMEOUT = 120.0  # s; most of it is for compiling on a machine that never did


def run(command: Start, *arguments: object) -> tuple[int, str, str]:
    process = command("solve", *arguments)
    out, err = process.communicate(timeout=TIMEOUT)
    return process.returncode, out, err


def test_a_line_is_solved_directly(
    command: Start, small_file: Path, small_result: FormResult, tmp_path: Path
) -> None:
    code, out, err = run(command, small_file, "--no-figures")
    assert (code, err) == (0, "")
    assert "Written to results/small: " in out
    assert f"{small_result.droppers.length[0]:.4f}" in out
    found = load_result(tmp_path / "results" / "small")
    np.testing.assert_allclose(found.droppers.length, small_result.droppers.length, atol=1e-12)
    assert found.method == "direct"


def test_a_line_is_solved_dynamically_and_taken_up_again(
    command: Start, small_file: Path, tmp_path: Path
) -> None:
    code, out, err = run(command, small_file, "--method", "dynamic", "--out", "first", "--no-figures")
    assert (code, err) == (0, "")
    headlines = [line for line in out.splitlines() if line.startswith("Step ")]
    assert headlines[:3] == [
        "Step 1 of 3: contact wire",
        "Step 2 of 3: messenger wire",
        "Step 3 of 3: lengths",
    ]
    code, _, err = run(
        command, small_file, "--method", "dynamic", "--start", "first", "--out", "second", "--no-figures"
    )
    assert (code, err) == (0, "")
    first, second = (load_result(tmp_path / name) for name in ("first", "second"))
    np.testing.assert_allclose(second.droppers.length, first.droppers.length, atol=1e-3)
    assert sum(work.steps for work in second.counters) < sum(work.steps for work in first.counters)


def test_another_mesh_and_rebuild_are_recorded(command: Start, small_file: Path, tmp_path: Path) -> None:
    options = ("--mesh", "refine=2", "--mesh", "largest_element=1.2m", "--rebuild", "relaxation")
    code, out, err = run(command, small_file, *options, "--no-figures")
    assert (code, err) == (0, "")
    assert "Rebuilt from the found lengths (relaxation, " in out
    assert "it comes back: height 0.00" in out
    found = load_result(tmp_path / "results" / "small")
    mesh = found.inputs["solver"]["mesh"]
    assert (mesh["refine"], mesh["largest_element"]) == (2, 1.2)
    assert (found.rebuilt.way, found.rebuilt.passed) == ("relaxation", True)


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (("--mesh", "refine=0"), "--mesh: refine: found 0; allowed: 1 or more"),
        (("--rebuild", "dynamic"), "there is no rebuild 'dynamic'"),
    ],
)
def test_a_wrong_option_is_bad_input(
    command: Start, small_file: Path, tmp_path: Path, options: tuple[str, ...], said: str
) -> None:
    code, _, err = run(command, small_file, *options)
    assert code == 2
    assert said in err
    assert list(tmp_path.iterdir()) == []


def with_change(path: Path, change: dict[str, Any], folder: Path) -> Path:
    tree = json.loads(path.read_text(encoding="utf-8")) | change
    changed = folder / "changed.json"
    changed.write_text(json.dumps(tree), encoding="utf-8")
    return changed


@pytest.mark.parametrize(
    ("change", "said"),
    [({"gravity": "9.8 kg"}, "gravity"), ({"colour": "red"}, "colour"), ({"spans": []}, "spans")],
)
def test_a_bad_file_is_bad_input(
    command: Start, small_file: Path, tmp_path: Path, change: dict[str, Any], said: str
) -> None:
    bad = with_change(small_file, change, tmp_path)
    code, _, err = run(command, bad)
    assert code == 2
    assert "changed.json:" in err
    assert said in err
    assert "Traceback" not in err
    assert list(tmp_path.iterdir()) == [bad]


@pytest.mark.parametrize("method", ["direct", "dynamic"])
def test_an_infeasible_line_is_bad_input(
    command: Start, small: Line, small_file: Path, tmp_path: Path, method: str
) -> None:
    span = small.model_dump(mode="json", exclude_none=True)["spans"][0] | {"contact_wire_height": -0.04}
    code, _, err = run(command, with_change(small_file, {"spans": [span]}, tmp_path), "--method", method)
    assert (code, "Traceback" in err) == (2, False)
    assert err.startswith("droppers would be in compression: 1 (-")
    assert not (tmp_path / "results").exists()


def interrupt_at(command: Start, headline: str, *arguments: object) -> tuple[int, str]:
    """Send the signal of Ctrl-C when a line of output begins with the headline."""
    process = command("solve", *arguments)
    assert process.stdout is not None
    try:
        for line in process.stdout:
            if line.startswith(headline):
                process.send_signal(signal.SIGINT)
                break
        _, err = process.communicate(timeout=30.0)
    finally:
        process.kill()
        process.wait()
    return process.returncode, err


@pytest.fixture(scope="session")
def long_file(vary: Callable[[dict[str, Any]], Line], tmp_path_factory: pytest.TempPathFactory) -> Path:
    """25 spans, which move for seconds."""
    span = vary({}).model_dump()["spans"][0]
    held = {"contact_wire": {"height": 0.0}, "messenger_wire": {"height": 1.5}}
    free = {"messenger_wire": {"height": 1.5}}
    line = vary({"spans": (span,) * 25, "supports": (held, *[free] * 24, held)})
    path = tmp_path_factory.mktemp("lines") / "long.json"
    path.write_text(json.dumps(line.model_dump(mode="json", exclude_none=True)), encoding="utf-8")
    return path


def test_ctrl_c_ends_a_motion_and_nothing_is_written(command: Start, long_file: Path, tmp_path: Path) -> None:
    code, err = interrupt_at(command, "Step 1 of 3", long_file, "--method", "dynamic")
    assert code == 130
    assert err.startswith("Interrupted in the stage 'contact wire' at ")
    assert err.endswith("Nothing was written.\n")
    assert list(tmp_path.iterdir()) == []


def test_ctrl_c_keeps_the_earlier_result(
    command: Start, small_file: Path, long_file: Path, tmp_path: Path
) -> None:
    assert run(command, small_file, "--out", "out", "--no-figures")[0] == 0
    before = {path.name: path.read_bytes() for path in (tmp_path / "out").iterdir()}
    code, err = interrupt_at(command, "Step 1 of 3", long_file, "--method", "dynamic", "--out", "out")
    assert (code, "Traceback" in err) == (130, False)
    assert {path.name: path.read_bytes() for path in (tmp_path / "out").iterdir()} == before
    assert list(tmp_path.iterdir()) == [tmp_path / "out"]


def test_a_run_without_ctrl_c_ends_by_itself(command: Start, small_file: Path) -> None:
    """Negative control of the interruptions: what never says the headline is not interrupted."""
    code, _ = interrupt_at(command, "no such headline", small_file, "--no-figures")
    assert code == 0
