"""What a rebuild says of itself: what came back, what did not, and what was wanted."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from catenaria.errors import InconsistentInputError
from catenaria.results import NOT_REBUILT, Comeback, FormResult, Rebuilt, load_result, save_result


def comeback(change: list[float], allowed: float) -> Comeback:
    return Comeback(np.array(change) + 1.0, np.array(change), np.full(len(change), allowed))


GOOD = Rebuilt(
    way="static",
    iterations=4,
    height=comeback([1e-6, -8e-6, 0.0], 1e-5),
    messenger_height=comeback([0.0, 2e-6, 0.0], 1e-5),
    force=comeback([0.02, 0.01, -0.05], 0.1),
    tension=comeback([0.0, 0.07], 0.1),
    height_error=np.array([0.0, -3e-5, 0.0]),
    tension_error=np.array([-5.25, 1.0]),
)


def test_what_comes_back_is_told_with_what_is_allowed() -> None:
    assert GOOD.passed
    assert GOOD.findings() == ()
    assert GOOD.lines() == (
        "Rebuilt from the found lengths (static, 4 steps), it comes back: height 0.0080 mm of 0.0100 mm; "
        "messenger height 0.0020 mm of 0.0100 mm; dropper force 0.050 N of 0.100 N; "
        "tension 0.070 N of 0.100 N.",
        "The rebuilt line misses what was wanted by 0.0300 mm of height and 5.250 N of tension.",
    )


@pytest.mark.parametrize(
    ("part", "change", "finding"),
    [
        (
            "height",
            [0.0, 0.0, -2e-5],
            "height off by -0.0200 mm at dropper 3, allowed 0.0100 mm; 1 such places",
        ),
        ("messenger_height", [3e-5, 0.0, 2e-5], "messenger height off by 0.0300 mm at dropper 1"),
        ("force", [0.0, 0.2, 0.0], "dropper force off by 0.200 N at dropper 2, allowed 0.100 N"),
        ("tension", [0.0, -0.2], "tension off by -0.200 N at messenger wire, allowed 0.100 N"),
        ("force", [0.0, float("nan"), 0.0], "dropper force off by nan N at dropper 2"),
    ],
)
def test_what_does_not_come_back_is_named(part: str, change: list[float], finding: str) -> None:
    allowed = float(getattr(GOOD, part).allowed[0])
    bad: Rebuilt = replace(GOOD, **{part: comeback(change, allowed)})
    assert not bad.passed
    (found,) = bad.findings()
    assert finding in found
    assert "DOES NOT COME BACK" in bad.lines()[0]


def test_a_line_that_was_not_rebuilt_has_nothing_to_say() -> None:
    assert NOT_REBUILT.findings() == ()
    assert "Not rebuilt" in NOT_REBUILT.lines()[0]


def test_it_is_stored_with_the_result(result: FormResult, tmp_path: Path) -> None:
    loaded = load_result(save_result(replace(result, rebuilt=GOOD), tmp_path))
    assert loaded.rebuilt.lines() == GOOD.lines()
    np.testing.assert_array_equal(loaded.rebuilt.force.change, GOOD.force.change)
    assert load_result(save_result(replace(result, rebuilt=NOT_REBUILT), tmp_path)).rebuilt.way == ""


def test_a_result_from_before_rebuilding_is_refused_by_the_name_of_the_field(
    result: FormResult, tmp_path: Path
) -> None:
    file = save_result(result, tmp_path)
    document: dict[str, Any] = json.loads(file.read_text(encoding="utf-8"))
    del document["result"]["rebuilt"]
    file.write_text(json.dumps(document), encoding="utf-8")
    with pytest.raises(InconsistentInputError, match=r"missing: \['rebuilt'\].*Solve the line again"):
        load_result(file)
