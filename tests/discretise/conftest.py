"""Lines, wire models and cables along known curves."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from catenaria.discretise.from_line import contact_wire_setup, messenger_wire_setup
from catenaria.discretise.wire_model import WireModel, build_wire_model
from catenaria.line import Line, load_line
from catenaria.mechanics.chain import Chain, Section
from catenaria.results import FormResult
from catenaria.workflow import solve

EXAMPLE = Path(__file__).parents[2] / "examples" / "yang2017_three_span.yaml"

FloatArray = NDArray[np.float64]
Change = dict[str, Any]


def changed(line: Line, change: Change) -> Line:
    """Return a line with some values replaced; keys are dotted paths."""
    data = line.model_dump()
    for path, value in change.items():
        *way, last = path.split(".")
        place: Any = data
        for key in way:
            place = place[key]
        place[last] = value
    return Line.model_validate(data)


@pytest.fixture(scope="session")
def line() -> Line:
    return load_line(EXAMPLE)


@pytest.fixture(scope="session")
def variant(line: Line) -> Callable[[Change], Line]:
    return lambda change: changed(line, change)


@pytest.fixture(scope="session")
def result(line: Line) -> FormResult:
    """The example's form."""
    return solve(line)


@pytest.fixture(scope="session")
def contact(line: Line) -> WireModel:
    """The example's first step at its starting configuration."""
    return build_wire_model(contact_wire_setup(line))


@pytest.fixture(scope="session")
def messenger(line: Line, result: FormResult) -> WireModel:
    """The example's second step at its starting configuration."""
    droppers = result.droppers
    return build_wire_model(messenger_wire_setup(line, droppers.force_bottom, droppers.height))


@pytest.fixture
def along() -> Callable[..., tuple[Chain, FloatArray]]:
    """Lay a cable along a curve: its nodes have the curve's r and r' at the knots."""

    def laid(
        knots: FloatArray, position: FloatArray, slope: FloatArray, EA: float = 2e6, EJ: float = 300.0
    ) -> tuple[Chain, FloatArray]:
        nodes = np.arange(6 * knots.size).reshape(-1, 6)
        return Chain(nodes, knots, Section(EA, EJ, 1.0)), np.hstack((position, slope)).ravel()

    return laid
