"""Every example line can be looked at in every way."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

import catenaria

EXAMPLES = Path(__file__).parents[2] / "examples"
LINES = sorted(path.stem for path in EXAMPLES.glob("*.yaml") if "\nspans:\n" in path.read_text("utf-8"))


def test_they_are_found() -> None:
    assert len(LINES) >= 9
    assert {"bridge", "curve_800m", "yang2017_three_span"} < set(LINES)


@pytest.mark.parametrize("name", LINES)
def test_it_can_be_looked_at(name: str) -> None:
    result = catenaria.solve(EXAMPLES / f"{name}.yaml", rebuild="none")
    assert result.passed
    assert repr(result).startswith(f"Result: {result.name}\n")
    assert ElementTree.fromstring(result._repr_html_()).find(".//svg") is not None
    assert len(result.droppers) == result.form.droppers.x.size > 0
    for wire in result.wires["wire"]:
        shape = result.profile(wire)
        assert (np.diff(shape["chainage_m"]) > 0.0).all()
        middle = float(shape["chainage_m"].iloc[[0, -1]].mean())
        here = result.at(middle).wire(wire)
        assert shape["height_m"].min() <= here.height <= shape["height_m"].max()
        assert shape["tension_N"].min() <= here.tension <= shape["tension_N"].max()
    for figure in (result.plot.profile(), result.plot.plan(), result.plot.tension(), result.plot.moments()):
        assert figure.axes
