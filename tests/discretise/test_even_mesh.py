"""Meshes of equal elements, which do not follow supports and clamps, for comparison with the literature."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from catenaria.discretise.from_line import messenger_wire_setup
from catenaria.discretise.mesh import Grading, graded_knots
from catenaria.discretise.wire_model import build_wire_model
from catenaria.errors import InconsistentInputError
from catenaria.line import Line, load_line

EXAMPLE = Path(__file__).parents[2] / "examples" / "yang2017_three_span.yaml"


def spread(knots: np.ndarray) -> float:
    """Return by how much elements differ in length [m]."""
    return float(np.ptp(np.diff(knots)))


@pytest.mark.parametrize(("even", "refine", "count"), [(1, 1, 1), (7, 1, 7), (7, 3, 21)])
def test_elements_are_equal_wherever_the_centres_are(even: int, refine: int, count: int) -> None:
    knots = graded_knots(10.0, [1.0, 4.3], Grading((0.1,), 2.0, refine, even))
    assert (knots.size, knots[0], knots[-1]) == (count + 1, 0.0, 10.0)
    assert spread(knots) < 1e-14


def test_without_it_they_are_graded() -> None:
    """Negative control."""
    assert spread(graded_knots(10.0, [1.0, 4.3], Grading((0.1,), 2.0))) > 1.0


def test_centres_are_still_checked() -> None:
    with pytest.raises(InconsistentInputError, match="beyond the end"):
        graded_knots(10.0, [11.0], Grading((0.1,), 2.0, 1, 7))


def test_a_line_file_may_ask_for_it() -> None:
    data = load_line(EXAMPLE).model_dump()
    data["solver"]["mesh"]["even"] = 130
    line = Line.model_validate(data)
    model = build_wire_model(messenger_wire_setup(line, np.zeros(21), np.zeros(21)))
    assert model.wire.knots.size == 131
    assert spread(model.wire.knots) < 1e-12
