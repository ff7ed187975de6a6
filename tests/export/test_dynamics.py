"""The neutral format: its files, and what they say."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.sparse import load_npz

from catenaria.errors import InconsistentInputError, UnsupportedError
from catenaria.export.dynamics import write_dynamics
from catenaria.results import FormResult

FILES = {
    "model.json",
    "arrays.npz",
    "modes.npz",
    *(f"{m}.npz" for m in ("mass", "stiffness", "constraints", "compliance")),
}


def read(folder: Path) -> tuple[dict[str, Any], Any, dict[str, Any]]:
    model = json.loads((folder / "model.json").read_text(encoding="utf-8"))
    matrices = {
        name: load_npz(folder / f"{name}.npz") for name in ("mass", "stiffness", "constraints", "compliance")
    }
    return model, np.load(folder / "arrays.npz"), matrices


def test_every_example(every: FormResult, tmp_path: Path) -> None:
    write_dynamics(every, tmp_path, modes=3)
    assert {path.name for path in tmp_path.iterdir()} == FILES
    model, arrays, matrices = read(tmp_path)
    n, m = model["counts"]["coordinates"], model["counts"]["constraints"]
    assert [matrices[name].shape for name in matrices] == [(n, n), (n, n), (m, n), (m, m)]
    assert sorted(row for joint in model["joints"] for row in joint["rows"]) == list(range(m))
    nodes = model["counts"]["nodes"]
    np.testing.assert_array_equal(
        arrays["coordinates"][: 6 * nodes].reshape(-1, 6),
        np.hstack((arrays["node_position"], arrays["node_slope"])),
    )
    assert arrays["element_length"].size == nodes - len(model["wires"])
    for wire, form in zip(model["wires"], every.wires, strict=False):
        own = slice(wire["first_element"], wire["first_element"] + wire["nodes"] - 1)
        assert arrays["element_length"][own].sum() == pytest.approx(wire["unstressed_length"])
        assert arrays["element_tension"][own].min() == pytest.approx(form.tension_min, rel=0.03)
    np.testing.assert_allclose(
        arrays["dropper_length"], every.droppers.unstressed_length, rtol=0.0, atol=1e-9
    )
    assert model["residual_at_rest"]["force"] < 1e-3
    assert len(model["frequencies"]) == 3


def test_forces_in_joints_are_those_that_were_found(every: FormResult, tmp_path: Path) -> None:
    write_dynamics(every, tmp_path, modes=1)
    model, arrays, _ = read(tmp_path)
    supports = every.supports
    held = [j for j in model["joints"] if "support" in j]
    for i, joint in enumerate(held):
        assert (joint["support"], joint["kind"]) == (supports.support[i], supports.kind[i])
        wanted = np.array([supports.force_x[i], supports.force_y[i], supports.force_z[i]])
        if joint["kind"] == "bracket":
            wanted = np.array([wanted @ joint["left"], wanted[2]])
        if joint["kind"] == "arm":
            arm = list(zip(every.arms.support, every.arms.wire, strict=True)).index(
                (supports.support[i], supports.wire[i])
            )
            wanted = every.arms.axial[[arm]]
        np.testing.assert_allclose(joint["force"], wanted, rtol=1e-6, atol=2e-3)
    ends = [j for j in model["joints"] if j["kind"] == "end"]
    for joint in ends:
        form = every.wires[joint["wire"]]
        wanted = form.end_force[0 if joint["coordinate"] == 0.0 else 1]
        np.testing.assert_allclose(joint["force"], wanted, rtol=0.0, atol=2e-3)
    dropper = every.droppers.on_contact
    pull = np.linalg.norm(dropper, axis=1)
    assert np.abs(arrays["dropper_force"] - pull).max() < 10.0  # which weighs clamps as well
    ties = [j["force"] for j in model["joints"] if j["kind"] == "tie"]
    np.testing.assert_allclose(np.reshape(ties, (-1, 3)), every.ties.force, rtol=0.0, atol=2e-3)


def test_methods_without_nodes_and_too_many_modes_are_refused(
    strings: FormResult, plane: FormResult, tmp_path: Path
) -> None:
    with pytest.raises(UnsupportedError, match="no nodes"):
        write_dynamics(strings, tmp_path)
    with pytest.raises(InconsistentInputError, match="modes"):
        write_dynamics(plane, tmp_path, modes=10**6)
    assert list(tmp_path.iterdir()) == []


def test_equal_results_give_equal_files(plane: FormResult, tmp_path: Path) -> None:
    folders = [tmp_path / name for name in ("one", "other")]
    for folder in folders:
        folder.mkdir()
        write_dynamics(plane, folder)
    for name in FILES:
        assert (folders[0] / name).read_bytes() == (folders[1] / name).read_bytes()
