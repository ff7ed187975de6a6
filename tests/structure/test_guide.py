"""The guide's Python runs and does what the guide says."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from catenaria.results.structure import StructureForm

ROOT = Path(__file__).parents[2]


@pytest.fixture
def names(monkeypatch: pytest.MonkeyPatch) -> dict[str, Any]:
    """Return what the code blocks of the guide define, run one after the other from the project's folder."""
    monkeypatch.chdir(ROOT)
    text = (ROOT / "docs" / "guide" / "structures.md").read_text(encoding="utf-8")
    blocks = re.findall(r"^```python\n(.*?)^```", text, flags=re.MULTILINE | re.DOTALL)
    assert len(blocks) == 2
    found: dict[str, Any] = {}
    for block in blocks:
        exec(block, found)
    return found


def test_the_lamp(names: dict[str, Any]) -> None:
    """Both ends bear half of 15 kg of wire and 4 kg of lamp, and one reacts with 1 kN."""
    form: StructureForm = names["form"]
    weight = (30.0 * 0.5 + 4.0) * 9.80665
    np.testing.assert_allclose(form.force("left")[2], -0.5 * weight, rtol=1e-3)
    np.testing.assert_allclose(np.linalg.norm(form.force("right")), 1000.0, rtol=1e-9)
    assert form.name == names["lamp"].name
