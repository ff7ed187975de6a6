"""The exported script builds lines in Exudyn that stay at rest; collected where Exudyn is installed."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.linalg import eigh, null_space
from scipy.sparse import load_npz

from catenaria.export import line_in_exudyn
from catenaria.export.exudyn import SCRIPT, write_exudyn
from catenaria.line import Line, load_line
from catenaria.results import FormResult
from catenaria.workflow import solve

FloatArray = NDArray[np.float64]
EXAMPLE = Path(__file__).parents[2] / "examples" / "yang2017_three_span.yaml"


def run(folder: Path, *arguments: str) -> tuple[int, dict[str, float]]:
    """Run the script as a user would, and return its exit code and what it says."""
    done = subprocess.run(
        [sys.executable, str(folder / SCRIPT), *arguments],
        capture_output=True,
        text=True,
        check=False,
        timeout=300,
    )
    assert done.returncode in (0, 1), done.stderr
    return done.returncode, json.loads(done.stdout.splitlines()[-1])


def test_every_example_stays_at_rest(every: FormResult, tmp_path: Path) -> None:
    write_exudyn(every, tmp_path, modes=1)
    code, said = run(tmp_path)
    assert code == 0
    assert said["movement_m"] < 0.1e-6
    assert said["force_error"] < 1e-5


def test_so_do_lines_with_rigid_and_slack_droppers(unlike: FormResult, tmp_path: Path) -> None:
    write_exudyn(unlike, tmp_path, modes=1)
    code, said = run(tmp_path)
    assert code == 0
    assert said["movement_m"] < 0.1e-6


@pytest.mark.parametrize("name", ["plane", "space", "stitched"])
def test_and_in_time(name: str, tmp_path: Path, request: pytest.FixtureRequest) -> None:
    write_exudyn(request.getfixturevalue(name), tmp_path, modes=1)
    code, said = run(tmp_path, "--dynamic", "1")
    assert code == 0
    assert said["movement_m"] < 0.1e-6
    assert said["tension_change_N"] < 1e-3
    assert said["force_error"] < 1e-5


def test_a_line_that_is_pushed_swings_in_its_first_mode(plane: FormResult, tmp_path: Path) -> None:
    """A velocity v in the mode of circular frequency w takes it as far as v/w: time does pass."""
    write_exudyn(plane, tmp_path, modes=1)
    with np.load(tmp_path / "modes.npz") as modes:
        omega, shape = 2.0 * np.pi * modes["frequency"][0], modes["shape"][:, 0]
    line = line_in_exudyn.read(tmp_path, inertia=True)
    line.solve()
    count = 6 * line.arrays["node_position"].shape[0]
    data, initial = line.mbs.systemData, line.exu.ConfigurationType.Initial
    velocity = np.array(data.GetODE2Coordinates_t(configuration=initial))
    velocity[:count] = 0.01 * shape[:count] / np.abs(shape[:count]).max()
    data.SetODE2Coordinates_t(velocity.tolist(), configuration=initial)
    before = line.tensions()
    line.move(0.5 * np.pi / omega)
    assert line.farthest == pytest.approx(0.01 / omega, rel=0.02)
    assert np.abs(line.tensions() - before).max() > 5e-3


@pytest.mark.parametrize(
    ("array", "index", "change"),
    [
        ("dropper_length", 4, 1e-3),
        ("element_length", 100, 1e-3),
        ("mass_weight", 3, 1.0),
        ("dropper_lower_coordinate", 5, 0.05),
    ],
)
def test_what_is_changed_is_noticed(
    plane: FormResult, tmp_path: Path, array: str, index: int, change: float
) -> None:
    write_exudyn(plane, tmp_path, modes=1)
    with np.load(tmp_path / "arrays.npz") as archive:
        arrays = dict(archive)
    arrays[array][index] += change
    np.savez(tmp_path / "arrays.npz", **arrays)
    code, said = run(tmp_path)
    assert code == 1
    assert max(said["movement_m"] / line_in_exudyn.MOVEMENT, said["force_error"] / line_in_exudyn.FORCE) > 3.0


@pytest.mark.parametrize("left_out", ["strain", "bending"])
def test_laws_must_be_converted(plane: FormResult, tmp_path: Path, left_out: str) -> None:
    """Without either conversion the line is elsewhere."""
    write_exudyn(plane, tmp_path, modes=1)
    script = (tmp_path / SCRIPT).read_text(encoding="utf-8")
    old, new = {
        "strain": ("shorter = a - (tension - 2.0 * bending / a) / k", "shorter = np.ones_like(a)"),
        "bending": ("2.0 * bending / a", "0.0 * bending / a"),
    }[left_out]
    assert old in script
    (tmp_path / SCRIPT).write_text(script.replace(old, new), encoding="utf-8")
    _, said = run(tmp_path)
    assert said["movement_m"] > {"strain": 1e-5, "bending": 0.3e-6}[left_out]


def frequencies(folder: Path, count: int) -> FloatArray:
    """Return natural frequencies by the written matrices, with wires that stick to their rollers."""
    matrices: list[Any] = [load_npz(folder / f"{name}.npz") for name in ("mass", "stiffness", "constraints")]
    M, K, C = matrices
    nodes = json.loads((folder / "model.json").read_text(encoding="utf-8"))["counts"]["nodes"]
    kept = slice(0, 6 * nodes)
    free = null_space(C.toarray()[:, kept])
    stiffness, mass = (free.T @ (matrix[kept, kept] @ free) for matrix in (K, M))
    omega = np.sqrt(eigh(stiffness, mass, eigvals_only=True, subset_by_index=[0, count - 1]))
    return omega / (2.0 * np.pi)


@pytest.mark.slow
def test_natural_frequencies_are_those_of_exudyn(tmp_path: Path) -> None:
    """Its own tangent stiffness and masses, of what was converted, with constraints eliminated by itself."""
    line = load_line(EXAMPLE).model_dump()
    span = {"length": 30.0, "droppers": {"positions": [8.0, 22.0]}}
    line |= {"spans": [span], "supports": line["supports"][::3]}
    write_exudyn(solve(Line.model_validate(line), rebuild="none"), tmp_path, modes=1)
    wanted = frequencies(tmp_path, 20)
    peer = line_in_exudyn.read(tmp_path, inertia=True)
    peer.solve()
    found = peer.mbs.ComputeODE2Eigenvalues(
        ignoreAlgebraicEquations=False, convert2Frequencies=True, numberOfEigenvalues=20
    )[0]
    np.testing.assert_allclose(np.real(found), wanted, rtol=1e-4)
