"""Every kind of line in space can be replayed: pieces of the examples, with what is particular to them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from catenaria import workflow
from catenaria.errors import InconsistentInputError
from catenaria.line import Line, load_line
from catenaria.results import FormResult
from catenaria.results.film import Film

EXAMPLES = Path(__file__).parents[2] / "examples"
SAMPLES = 8  # of a profile in every element


def piece(name: str, first: int, last: int) -> Line:
    """Return some spans of an example, without its point masses."""
    data: dict[str, Any] = load_line(EXAMPLES / f"{name}.yaml").model_dump(mode="json")
    data |= {"spans": data["spans"][first:last], "supports": data["supports"][first : last + 1]}
    return Line.model_validate(data | {"point_masses": []})


def farthest(film: Film, state: int, result: FormResult) -> float:
    """Return how far any node is from where the result has it [m]."""
    return max(
        float(np.abs(getattr(film.wires, name)[state, film.wires.nodes(k)] - found[::SAMPLES]).max())
        for k, wire in enumerate(result.wires)
        for name, found in (
            ("chainage", wire.profile.chainage),
            ("lateral", wire.profile.lateral),
            ("height", wire.profile.height),
        )
    )


@pytest.mark.parametrize(
    ("name", "first", "last", "roles"),
    [
        ("curve_800m", 0, 5, ["contact wire", "messenger wire"]),
        ("overlap", 0, 3, ["contact wire", "messenger wire"]),
        ("compound", 0, 2, ["contact wire", "auxiliary messenger", "messenger wire"]),
        ("stitched_re250", 0, 2, ["contact wire", "messenger wire", "stitch wire"]),
        (
            "two_contact_wires_3kv",
            9,
            11,
            ["contact wire", "contact wire", "messenger wire", "mid-point anchor", "mid-point anchor"],
        ),
    ],
)
def test_the_film_ends_in_the_form(name: str, first: int, last: int, roles: list[str]) -> None:
    result, (film,) = workflow.replay(piece(name, first, last), frames=4)
    assert list(film.role) == roles
    assert film.time.size == 4
    assert film.gravity[0] == 0.0
    assert farthest(film, -1, result) < 1e-9
    assert farthest(film, 0, result) > 0.1


def test_a_film_of_one_state_is_refused() -> None:
    with pytest.raises(InconsistentInputError, match="2, not 1"):
        workflow.replay(load_line(EXAMPLES / "yang2017_three_span.yaml"), frames=1)
