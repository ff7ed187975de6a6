"""Quantities of free structures, on a structure whose numbers are known by hand."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from catenaria.errors import InconsistentInputError
from catenaria.workflow.structure_observables import observe_structure

HEIGHTS = {"low": 0.5, "high": 2.0}
FORCES = {"low": (3.0, 0.0, 4.0), "high": (0.0, 0.0, -2.0)}

EXPECTED: dict[str, tuple[tuple[str, ...], list[float]]] = {
    "joint force": (("low", "high"), [5.0, 2.0]),
    "joint height": (("high",), [2.0]),
    "rise between joints": (("low", "high"), [1.5]),
    "strain tension at joint": (("high", "low"), [8.0, 7.0]),
    "mean tension": (("rope",), [17.5]),
    "simulated time": ((), [12.0]),
    "input": (("sections.rope.EA",), [5e6]),
    "joint place along x": (("low", "high"), [1.0, 1.0]),
}


@pytest.fixture
def form() -> Any:
    rope = SimpleNamespace(tension=np.array([10.0, 20.0]), s=np.array([0.0, 1.0, 4.0]))
    return SimpleNamespace(
        force=lambda joint: np.array(FORCES[joint]),
        position=lambda joint: np.array([1.0, 0.0, HEIGHTS[joint]]),
        inputs={"sections": {"rope": {"EA": 5e6}}},
        joints=SimpleNamespace(name=("low", "high"), strain_tension=np.array([7.0, 8.0])),
        cable=lambda name: {"rope": rope}[name],
        counters=SimpleNamespace(simulated_time=12.0),
    )


@pytest.mark.parametrize("quantity", EXPECTED)
def test_a_quantity_is_read(form: Any, quantity: str) -> None:
    of, expected = EXPECTED[quantity]
    np.testing.assert_allclose(observe_structure(form, quantity, of), expected)


def test_an_unknown_quantity_is_refused(form: Any) -> None:
    with pytest.raises(InconsistentInputError, match="no quantity 'colour' of structures"):
        observe_structure(form, "colour", ())
