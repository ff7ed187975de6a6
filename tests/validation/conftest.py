"""A check with one number, and a case around it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from catenaria.validation import Case, CaseOutcome, Check, compare

Data = dict[str, Any]


@pytest.fixture
def data() -> Data:
    """A case as it would stand in a file."""
    check = {
        "title": "Sag",
        "source": "Fig. 22",
        "quantity": "contact-wire sag",
        "unit": "mm",
        "decimals": 2,
        "rows": ["first", "second"],
        "reference": [6.41, 5.0],
        "tolerance": 0.05,
        "reason": "printed to 0.01 mm",
        "columns": [{"title": "direct", "runs": ["a"]}, {"title": "dynamic", "runs": ["b"]}],
    }
    drawing = {
        "name": "sag",
        "drawn": "differences",
        "runs": ["a"],
        "of": ["Sag"],
        "paper": "Fig. 22",
        "text": "Sag.",
    }
    return {
        "title": "A wire",
        "source": "a book",
        "text": "One wire.",
        "runs": {"a": {"file": "a.yaml"}, "b": {"file": "a.yaml", "method": "dynamic"}},
        "checks": [check],
        "figures": [drawing],
        "discussion": "Nothing else.",
    }


@pytest.fixture
def check(data: Data) -> Check:
    return Case.model_validate(data).checks[0]


@pytest.fixture
def outcome(data: Data) -> Callable[..., CaseOutcome]:
    """Judge observed numbers [mm] of the two columns, with a known difference if there shall be one."""

    def judged(direct: list[float], dynamic: list[float], known: Data | None = None) -> CaseOutcome:
        checks = [data["checks"][0] | {"known": known}]
        case = Case.model_validate(data | {"checks": checks})
        observed = [1e-3 * np.array(column) for column in (direct, dynamic)]
        return CaseOutcome("wire", case, (compare(case.checks[0], observed),))

    return judged
