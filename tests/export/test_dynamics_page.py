"""The code on the page of the neutral format reads what is written, and finds the line at rest."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from catenaria.export.dynamics import write_dynamics
from catenaria.results import FormResult

FloatArray = NDArray[np.float64]
PAGE = Path(__file__).parents[2] / "docs" / "theory" / "dynamics_format.md"
KINDS = ["plane", "space", "stitched", "compound"]  # springs, cantilevers, ties, brackets and rigid droppers


def run(folder: Path, result: FormResult | None = None) -> dict[str, Any]:
    """Write a line, and return the names that the code of the page leaves."""
    if result is not None:
        (folder / "dynamics").mkdir()
        write_dynamics(result, folder / "dynamics", modes=1)
    names: dict[str, Any] = {}
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        for code in re.findall(
            r"^```python\n(.*?)^```", PAGE.read_text("utf-8"), flags=re.MULTILINE | re.DOTALL
        ):
            exec(code, names)
    return names


@pytest.mark.parametrize("name", KINDS)
def test_the_line_rests(name: str, tmp_path: Path, request: pytest.FixtureRequest) -> None:
    names = run(tmp_path, request.getfixturevalue(name))
    assert np.abs(names["unbalanced"]).max() < 2e-4
    model = json.loads((tmp_path / "dynamics" / "model.json").read_text(encoding="utf-8"))
    assert model["residual_at_rest"]["force"] < 2e-4
    assert names["omega"] == pytest.approx(2.0 * np.pi * model["frequencies"][0], rel=1e-6)


@pytest.mark.parametrize("array", ["element_length", "dropper_length", "load", "constraint_force"])
def test_what_is_changed_is_noticed(array: str, plane: FormResult, tmp_path: Path) -> None:
    run(tmp_path, plane)
    file = tmp_path / "dynamics" / "arrays.npz"
    with np.load(file) as archive:
        arrays = dict(archive)
    largest = np.argmax(np.abs(arrays[array]))
    arrays[array][largest] *= 1.0 + 1e-4
    np.savez(file, **arrays)
    assert np.abs(run(tmp_path)["unbalanced"]).max() > 2e-4


def test_rows_of_arms_and_rigid_droppers_are_those_of_the_page(compound: FormResult, tmp_path: Path) -> None:
    """Their second derivatives are in the stiffness: (d^2 - l^2)/2l has another one than d - l."""
    names = run(tmp_path, compound)
    model = json.loads((tmp_path / "dynamics" / "model.json").read_text(encoding="utf-8"))
    a, K = names["a"], names["K"].tocsr()
    joint = next(joint for joint in model["joints"] if joint["kind"] == "rigid dropper")
    i = joint["dropper"]
    ends = [
        names["clamp"](a[f"dropper_{e}_wire"][i], a[f"dropper_{e}_coordinate"][i]) for e in ("lower", "upper")
    ]
    for _, N in ends:
        assert N.max() == pytest.approx(1.0, abs=1e-4)  # at nodes
    lower, upper = (dof[np.argmax(N[:, 0])] for dof, N in ends)
    stiffness = joint["force"][0] / a["dropper_length"][i]
    for axis in range(3):  # vertically too, where the dropper is
        assert K[lower[axis], upper[axis]] == pytest.approx(-stiffness, rel=1e-3)
