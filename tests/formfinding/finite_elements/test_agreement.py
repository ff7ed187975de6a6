"""Every method against the direct method, before the audit, and rebuilt by other elements."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from catenaria.audit import audit_result
from catenaria.errors import InconsistentInputError, InfeasibleError, UnsupportedError
from catenaria.formfinding.finite_elements.registry import ELEMENT_METHODS
from catenaria.formfinding.progress import Progress
from catenaria.formfinding.rebuild import rebuild
from catenaria.line import Line
from catenaria.results import FormResult

AGREED = 0.02e-3  # m, of 0.1 mm that are wanted: both meshes are the same, their elements are not

Vary = Callable[[dict[str, Any]], Line]


def test_lengths_and_forces_are_those_of_the_direct_method(found: FormResult, direct: FormResult) -> None:
    ours, theirs = found.droppers, direct.droppers
    np.testing.assert_allclose(ours.length, theirs.length, rtol=0, atol=AGREED)
    np.testing.assert_allclose(ours.cut_length, theirs.cut_length, rtol=0, atol=AGREED)
    np.testing.assert_allclose(ours.force_bottom, theirs.force_bottom, rtol=0, atol=0.01)
    np.testing.assert_allclose(ours.force_top, theirs.force_top, rtol=0, atol=0.01)
    for wire, other in zip(found.wires, direct.wires, strict=True):
        assert wire.unstressed_length == pytest.approx(other.unstressed_length, abs=AGREED)
        assert wire.stretched_length == pytest.approx(other.stretched_length, abs=AGREED)
        assert wire.travel == pytest.approx(other.travel, abs=AGREED)
        assert wire.tension_mean == pytest.approx(other.tension_mean, abs=0.1)
        assert wire.sag == pytest.approx(other.sag, abs=AGREED)
        assert wire.profile.moment.max() == pytest.approx(other.profile.moment.max(), rel=1e-3)
    np.testing.assert_allclose(found.supports.force_z, direct.supports.force_z, rtol=0, atol=0.2)


def test_bending_is_seen(vary: Vary, line: Line) -> None:
    """Without bending stiffness lengths are others by millimetres: the agreement is not that of strings."""
    soft = {f"conductors.{name}.bending_stiffness": 0.0 for name in ("contact", "messenger")}
    both = (ELEMENT_METHODS["adjusted lengths"](None).find_form(each) for each in (line, vary(soft)))
    with_bending, without = (result.droppers.length for result in both)
    assert np.max(np.abs(with_bending - without)) > 3e-3


def test_the_audit_passes(found: FormResult) -> None:
    audit = audit_result(found)
    assert audit.findings == ()
    assert found.physics == "beam"


def test_it_comes_back_when_it_is_built_of_other_elements(found: FormResult, any_line: Line) -> None:
    rebuilt = rebuild(any_line, found)
    assert np.max(np.abs(rebuilt.height.change)) < AGREED
    assert np.max(np.abs(rebuilt.force.change)) < 0.1


def test_a_dropper_that_is_cut_wrong_does_not_come_back(line: Line) -> None:
    result = ELEMENT_METHODS["geometry variation"](None).find_form(line)
    unstressed = result.droppers.unstressed_length + 1e-3 * (np.arange(21) == 4)
    wrong = replace(result, droppers=replace(result.droppers, unstressed_length=unstressed))
    assert np.max(np.abs(rebuild(line, wrong).height.change)) > 10.0 * AGREED


def test_a_finer_mesh_changes_little(line: Line) -> None:
    mesh = line.solver.mesh.model_copy(update={"refine": 3})
    fine = line.model_copy(update={"solver": line.solver.model_copy(update={"mesh": mesh})})
    method = ELEMENT_METHODS["adjusted lengths"](None)
    a, b = (method.find_form(each).droppers.length for each in (line, fine))
    assert np.max(np.abs(a - b)) < 0.05e-3


@pytest.mark.parametrize(
    ("change", "named"),
    [
        ({"dropper.joint": "frictionless"}, "dropper.joint: frictionless"),
        ({"messenger_wire.tension.measure": "strain"}, "messenger_wire.tension.measure: strain"),
        ({"solver.mesh.even": 100}, "solver.mesh.even"),
    ],
)
def test_what_cannot_be_done_is_refused_by_name(
    vary: Vary, method: str, change: dict[str, Any], named: str
) -> None:
    with pytest.raises(UnsupportedError, match=named) as refusal:
        ELEMENT_METHODS[method](None).find_form(vary(change))
    assert method in str(refusal.value)


def test_droppers_in_compression_are_refused(vary: Vary, line: Line) -> None:
    spans = [span.model_dump() for span in line.spans]
    spans[1] |= {"contact_wire_height": (0.0, 0.0, 0.0, -0.2, 0.0, 0.0, 0.0)}
    with pytest.raises(InfeasibleError, match="4 in span 2"):
        ELEMENT_METHODS["adjusted lengths"](None).find_form(vary({"spans": tuple(spans)}))


def test_an_earlier_result_saves_iterations(method: str, line: Line) -> None:
    own = ELEMENT_METHODS[method](None)
    first = own.find_form(line)
    again = own.find_form(line, first)
    assert again.counters[0].steps <= first.counters[0].steps
    np.testing.assert_allclose(again.droppers.length, first.droppers.length, rtol=0, atol=1e-6)


def test_an_earlier_result_of_another_line_is_refused(line: Line, uneven: Line) -> None:
    own = ELEMENT_METHODS["adjusted lengths"](None)
    with pytest.raises(InconsistentInputError, match="21 droppers, the line 13"):
        own.find_form(uneven, own.find_form(line))


def test_the_listener_is_told(line: Line) -> None:
    told: list[Progress] = []
    ELEMENT_METHODS["adjusted lengths"](told.append).find_form(line)
    assert [message.stage for message in told] == ["both wires"]
