"""Small lines that were found, and what one measures on them if some droppers are too long."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from catenaria.discretise.spatial.loaded import with_dropper_lengths
from catenaria.formfinding.direct import Direct
from catenaria.line import Line, load_line
from catenaria.line.measured import MeasuredHeight, MeasuredHeights
from catenaria.loading.built_line import BuiltLine

EXAMPLE = Path(__file__).parents[3] / "examples" / "yang2017_three_span.yaml"
MARKS = {name: (1, 1) for name in ("span", "dropper", "chainage_m", "height_m", "lower_wire")}

Errors = Mapping[int, float]
Measure = Callable[..., MeasuredHeights]


@pytest.fixture(scope="session")
def three_spans() -> BuiltLine:
    line = load_line(EXAMPLE)
    return BuiltLine.of(line, Direct().find_form(line))


@pytest.fixture(scope="session")
def one_span() -> BuiltLine:
    """Seven droppers: few enough to try everything."""
    inputs = load_line(EXAMPLE).model_dump(mode="json")
    inputs["supports"] = [inputs["supports"][0], inputs["supports"][3]]
    inputs["spans"] = inputs["spans"][:1]
    line = Line.model_validate(inputs)
    return BuiltLine.of(line, Direct().find_form(line))


@pytest.fixture(scope="session")
def measure() -> Measure:
    """Return what is measured on a line some of whose droppers are longer than scheduled."""

    def heights(
        built: BuiltLine, errors: Errors, noise: NDArray[np.float64] | float = 0.0, every: int = 1
    ) -> MeasuredHeights:
        length = built.model.unknowns.start[built.model.length].copy()
        for i, error in errors.items():
            length[i] += error
        measured = built.under(model=with_dropper_lengths(built.model, length)).height + noise
        droppers = built.model.layout.droppers
        rows = zip(measured.tolist(), droppers.span.tolist(), droppers.number.tolist(), strict=True)
        return MeasuredHeights(
            "heights.csv", tuple(MeasuredHeight(*row, float("nan"), "", MARKS) for row in rows)[::every]
        )

    return heights
