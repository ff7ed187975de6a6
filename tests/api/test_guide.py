"""The code of the page about Python runs as it stands, and says what the page says."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import pytest

import catenaria

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "guide" / "python.md").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def scope(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    """Run all code of the page, in a folder with the examples, and return its names."""
    folder = tmp_path_factory.mktemp("guide")
    (folder / "examples").symlink_to(ROOT / "examples")
    names: dict[str, Any] = {"folder": folder}
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        for code in re.findall(r"^```python\n(.*?)^```", PAGE, flags=re.MULTILINE | re.DOTALL):
            exec(code, names)
    return names


def test_the_code_runs(scope: dict[str, Any]) -> None:
    result = scope["result"]
    assert result.passed
    assert round(scope["here"].wire("contact wire").height, 4) == -0.0063
    assert scope["here"].dropper.number == 4
    assert scope["study"].cases[0].name == "summer"
    assert (scope["folder"] / "profile.png").stat().st_size > 10_000
    assert catenaria.load_result(scope["folder"] / "results" / "three_spans") == result
    assert {"profile.dxf", "plan.dxf", "line.vtu"} < {
        path.name for path in (scope["folder"] / "drawings").iterdir()
    }


def test_a_line_of_one_s_own_is_solved_and_kept(scope: dict[str, Any]) -> None:
    [said] = re.findall(r"tolist\(\)\[:3\]  # (\[.*\])", PAGE)
    found = catenaria.solve(scope["mine"], rebuild="none").droppers["cut_length_m"]
    assert found.round(3).tolist()[:3] == json.loads(said)
    assert catenaria.load(scope["folder"] / "mine.json") == scope["mine"]


def test_the_page_shows_what_a_terminal_shows(scope: dict[str, Any]) -> None:
    [shown] = re.findall(r"^```text\n(.*?)\n```", PAGE, flags=re.MULTILINE | re.DOTALL)
    assert shown == repr(scope["result"])


def test_the_page_names_all_names() -> None:
    named = set(re.findall(r"`(\w+)", PAGE))
    assert set(catenaria.__all__) <= named
    members = {name for name in dir(catenaria.Result) if not name.startswith("_")}
    assert members | {"form"} <= named
