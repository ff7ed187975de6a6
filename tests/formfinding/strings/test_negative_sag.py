"""The negative sag method: its forward model, and how fast it converges."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from catenaria.errors import NotConvergedError
from catenaria.formfinding.strings import negative_sag, separated
from catenaria.formfinding.strings.negative_sag import _Model, find_rest
from catenaria.formfinding.strings.task import StringLine


def heights(task: StringLine, unstressed: np.ndarray) -> np.ndarray:
    """Return how high a line of given dropper lengths hangs."""
    model = _Model.of(task)
    z, along = model.level()
    return model.come_to_rest(z, along, unstressed)[0][model.foot]


def test_lengths_of_another_method_come_to_rest_at_the_wanted_heights(task: StringLine) -> None:
    unstressed = separated.find_rest(task).found.unstressed
    np.testing.assert_allclose(heights(task, unstressed), task.height, atol=1e-6)
    longer = unstressed.copy()
    longer[3] += 1e-3
    sunk = heights(task, longer) - task.height
    assert -1e-3 < sunk[3] < -0.3e-3
    assert np.argmin(sunk) == 3


@pytest.mark.parametrize("ratio", [0.5, 1.0])
def test_errors_shrink_by_the_share_of_the_contact_wire(
    task: StringLine, ratio: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    line = replace(task, contact=replace(task.contact, tension=ratio * task.messenger.tension))
    passes: list[int] = []
    plain = _Model.come_to_rest

    def counted(self: _Model, *arguments: np.ndarray) -> object:
        passes[-1] += 1
        return plain(self, *arguments)

    monkeypatch.setattr(_Model, "come_to_rest", counted)
    for enough in (1e-4, 1e-7):
        monkeypatch.setattr(negative_sag, "_ENOUGH", enough)
        passes.append(0)
        find_rest(line)
    share = ratio / (1.0 + ratio)
    assert passes[1] - passes[0] == pytest.approx(3.0 * np.log(10.0) / -np.log(share), abs=1.5)


def test_an_end_without_agreement_is_a_failure(task: StringLine, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(negative_sag, "_MOST", 15)
    with pytest.raises(NotConvergedError, match="mm off after 15 passes"):
        find_rest(task)
