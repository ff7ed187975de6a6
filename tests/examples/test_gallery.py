"""The scripts of the gallery run as they stand, draw, and show what their texts say."""

from __future__ import annotations

import re
import runpy
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest

GALLERY = Path(__file__).parents[2] / "examples" / "gallery"
SCRIPTS = sorted(path.stem for path in GALLERY.glob("*.py"))

Run = Callable[[str], dict[str, Any]]


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Run:
    """Run a script once, in a folder of its own, and return its names."""
    done: dict[str, dict[str, Any]] = {}

    def once(name: str) -> dict[str, Any]:
        if name not in done:
            folder = tmp_path_factory.mktemp(name)
            with pytest.MonkeyPatch.context() as patch:
                patch.chdir(folder)
                done[name] = runpy.run_path(str(GALLERY / f"{name}.py"), run_name="__main__")
            done[name]["drawn"] = sorted(path.name for path in folder.iterdir())
        return done[name]

    return once


def test_there_are_five_and_the_page_shows_all() -> None:
    root = GALLERY.parents[1]
    page = (root / "docs" / "guide" / "gallery.md").read_text(encoding="utf-8")
    assert len(SCRIPTS) == 5
    for name in SCRIPTS:
        assert f"../images/gallery_{name}.png" in page
        assert f"../../examples/gallery/{name}.py" in page


@pytest.mark.parametrize("name", SCRIPTS)
def test_it_draws_and_is_made_of_cells(name: str, run: Run) -> None:
    assert run(name)["drawn"] == [f"{name}.png"]
    text = (GALLERY / f"{name}.py").read_text(encoding="utf-8")
    assert re.search(r"^# %% \[markdown\]\n# # ", text, flags=re.MULTILINE)
    assert len(re.findall(r"^# %%", text, flags=re.MULTILINE)) >= 5
    assert f"python examples/gallery/{name}.py" in text
    assert f"Draws {name}.png" in text


def test_the_paper_s_line(run: Run) -> None:
    found = run("solve_and_plot")
    assert found["result"].passed
    np.testing.assert_allclose(found["sag"], 6.3e-3, atol=0.05e-3)


def check_methods(table: pd.DataFrame) -> None:
    """Methods for strings agree with each other, and those that bend with the direct one."""
    bends = table["bends"].astype(bool)
    elements = table[bends].drop(index="dynamic")
    assert elements["largest_mm"].max() < 0.01
    assert 0.1 < table["largest_mm"].to_dict()["dynamic"] < 1.0
    strings = table.loc[~bends, "mean_mm"]
    assert len(strings) == 7
    assert np.ptp(strings) < 1e-3
    assert strings.max() < -4.0


def test_methods(run: Run) -> None:
    table = run("compare_methods")["table"]
    check_methods(table)
    wrong = table.copy()
    wrong.loc["separated", "mean_mm"] += 0.01
    with pytest.raises(AssertionError):
        check_methods(wrong)


def test_radial_forces(run: Run) -> None:
    """The formula holds within 1 N everywhere; without cant it does not, where the text says so."""
    found = run("radial_forces")
    table, at, T = found["table"], found["at"], found["T"]
    assert len(table) == 18
    assert table["difference_N"].abs().max() < 1.0
    slope = np.diff(found["stagger"]) / np.diff(at)
    without = found["side"] * T * (slope[:-1] - slope[1:] - found["angle"])
    np.testing.assert_allclose(np.abs(table["found_N"] - without).max(), 46.0, atol=0.5)


def test_temperature_and_wind(run: Run) -> None:
    found = run("temperature_and_wind")
    strokes, wind = found["strokes"], found["wind"]
    assert len(strokes) == 8
    np.testing.assert_allclose(strokes["stroke_mm"], strokes["formula_mm"], rtol=0.03)
    assert (strokes["stroke_mm"] - strokes["formula_mm"]).abs().min() > 1.0
    np.testing.assert_allclose(strokes["formula_mm"].abs().max(), 17e-6 * 720.0 * 40.0 * 1e3, rtol=3e-3)
    np.testing.assert_allclose(wind["solved_mm"], wind["textbook_mm"], rtol=0.05)


def test_pre_sag(run: Run) -> None:
    found = run("pre_sag")
    table = found["table"].set_index("pre_sag_mm")
    assert table["path_mm"].idxmin() == 30
    assert table.loc[30, "path_mm"] < 0.3 * table.loc[0, "path_mm"]
    assert (table["outer_dropper_N"].diff().dropna() > 0.0).all()
    assert (table["middle_dropper_N"].diff().dropna() < 0.0).all()
    chainage, _ = found["paths"][30]
    assert (chainage[0], chainage[-1]) == (110.0, 165.0)
