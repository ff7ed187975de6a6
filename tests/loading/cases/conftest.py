"""Small lines, found and built, and ways to put them under loads."""

from __future__ import annotations

import copy
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
import pytest

from catenaria.formfinding.spatial.direct import find_directly
from catenaria.line import Line
from catenaria.line.load_case import LoadCase
from catenaria.loading.built_line import BuiltLine
from catenaria.loading.case import solve_case
from catenaria.loading.read_case import line_state
from catenaria.results import FormResult
from catenaria.results.case import CaseResult, LineState

CONTACT = {"youngs_modulus": 120e9, "area": 120e-6, "mass_per_length": 1.07, "bending_stiffness": 2.0}
MESSENGER = {"youngs_modulus": 113e9, "area": 65.8e-6, "mass_per_length": 0.596, "bending_stiffness": 2.0}
DROPPER = {"youngs_modulus": 119e9, "area": 10e-6, "mass_per_length": 0.089, "bending_stiffness": 0.0}
STUB = 6.0  # m


@dataclass(frozen=True)
class Loaded:
    """A line before it is loaded, and how to load it."""

    line: Line
    result: FormResult
    built: BuiltLine
    before: LineState

    def under(self, name: str = "case", **case: Any) -> CaseResult:
        """Return the line under a case."""
        return solve_case(self.built, name, LoadCase.model_validate(case), self.before)


Make = Callable[..., Loaded]


def document(
    spans: tuple[float, ...] = (60.0, 60.0, 60.0),
    droppers: tuple[float, ...] = (0.1, 0.3, 0.5, 0.7, 0.9),
    stagger: tuple[float, ...] = (),
    **change: Any,
) -> dict[str, Any]:
    """Return a line file's tree; `droppers` are parts of each span, `change` replaces fields of the file.

    Without droppers wires hang alone from chainage 0 on, behind a short span with the one that a line needs.
    """
    lateral = stagger or (0.0,) * (len(spans) + 1)
    if not droppers:
        spans, lateral = (STUB, *spans), (lateral[0], *lateral)
    data: dict[str, Any] = {
        "format": 1,
        "conductors": {"contact": CONTACT, "messenger": MESSENGER, "dropper": DROPPER},
        "contact_wire": {"conductor": "contact", "tension": {"force": 15e3}, "tail": 3.0},
        "messenger_wire": {"conductor": "messenger", "tension": {"force": 12e3}, "tail": 3.0},
        "dropper": {"conductor": "dropper", "model": "bar"},
        "start_chainage": 0.0 if droppers else -STUB,
        "supports": [
            {"stagger": b, "contact_wire": {"height": 5.3}, "messenger_wire": {"height": 6.7}}
            for b in lateral
        ],
        "spans": [
            {
                "length": a,
                "droppers": {"positions": [part * a for part in droppers or ((0.5,) if i == 0 else ())]},
                "contact_wire_height": 5.3,
            }
            for i, a in enumerate(spans)
        ],
    }
    return data | copy.deepcopy(change)


@cache
def _built(text: str) -> Loaded:
    line = Line.model_validate_json(text)
    result = find_directly(line, None)
    built = BuiltLine.of(line, result)
    return Loaded(
        line, result, built, line_state(line, built.at_rest, np.zeros(built.model.length.size, np.bool_))
    )


@pytest.fixture(scope="session")
def make() -> Make:
    """Return the line that `document` describes, found and built; equal ones once."""

    def made(*args: Any, **change: Any) -> Loaded:
        return _built(Line.model_validate(document(*args, **change)).model_dump_json(exclude_none=True))

    return made
