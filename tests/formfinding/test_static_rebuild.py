"""Where the taut strings lead nowhere, the found state is tried; what is no rest is not taken for one."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from catenaria.errors import NotConvergedError
from catenaria.formfinding import static_rebuild
from catenaria.formfinding.rebuild import rebuild
from catenaria.line import Line
from catenaria.results import FormResult, Stage
from catenaria.workflow import solve


@pytest.fixture(scope="module")
def found(line: Line) -> FormResult:
    return solve(line, rebuild="none")


@pytest.fixture
def no_way_from_strings(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let the first attempt fail."""
    find_rest, attempts = static_rebuild.find_rest, iter([True])

    def reluctant(*arguments: Any) -> Any:
        if next(attempts, False):
            raise NotConvergedError("no way", "another start")
        return find_rest(*arguments)

    monkeypatch.setattr(static_rebuild, "find_rest", reluctant)


def test_strings_come_first(line: Line, found: FormResult) -> None:
    assert rebuild(line, found).way == "static"


@pytest.mark.usefixtures("no_way_from_strings")
def test_the_found_state_is_at_rest(line: Line, found: FormResult) -> None:
    rebuilt = rebuild(line, found)
    assert (rebuilt.way, rebuilt.passed) == ("static, from the found state", True)
    assert rebuilt.iterations <= 3  # one for each kind of bars, and one for round-off
    np.testing.assert_allclose(rebuilt.height.change, 0.0, atol=1e-8)


@pytest.mark.usefixtures("no_way_from_strings")
def test_a_wrong_length_leaves_the_found_state(line: Line, found: FormResult) -> None:
    """Negative control: starting there does not mean staying there."""
    longer = found.droppers.unstressed_length + 1e-3 * (np.arange(21) == 10)
    wrong = replace(found, droppers=replace(found.droppers, unstressed_length=longer))
    rebuilt = rebuild(line, wrong)
    assert not rebuilt.passed
    assert -1e-3 < rebuilt.height.change[10] < -0.3e-3


@pytest.mark.usefixtures("no_way_from_strings")
def test_a_state_on_another_mesh_is_refused(line: Line, found: FormResult) -> None:
    def shorter(stage: Stage) -> Stage:
        return replace(stage, node_count=stage.node_count - 1)

    other = replace(found, stages=tuple(shorter(stage) for stage in found.stages))
    with pytest.raises(NotConvergedError, match="the rebuilt line: the found state has another mesh"):
        rebuild(line, other)
