"""The audit passes what the methods find, and notices whatever is changed in it afterwards."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from catenaria.audit import audit_result
from catenaria.errors import InconsistentInputError
from catenaria.line import load_line
from catenaria.results import FormResult
from catenaria.results.codec import decode, encode
from catenaria.workflow import solve

EXAMPLE = Path(__file__).parents[2] / "examples" / "yang2017_three_span.yaml"

Change = Callable[[Any], Any]
Corrupt = Callable[[str, Change], FormResult]


def at(index: Any, change: Change) -> Change:
    """Return a function that changes one entry of an array."""

    def changed(values: Any) -> Any:
        values[index] = change(values[index])
        return values

    return changed


def plus(amount: float) -> Change:
    return lambda value: value + amount


def times(factor: float) -> Change:
    return lambda value: value * factor


def swapped(values: Any) -> Any:
    """The first two droppers of a schedule are exchanged."""
    values[[0, 1]] = values[[1, 0]]
    return values


def test_the_paper_line_passes(paper: FormResult) -> None:
    audit = audit_result(paper)
    assert audit.findings == ()
    assert audit.passed
    assert np.all(audit.deviation <= audit.allowed)
    assert {"equilibrium", "lengths", "targets"} == set(audit.group)


def test_the_dynamic_result_rests_far_within_the_tolerance(paper: FormResult) -> None:
    """1e-6 of 15 kN passes; what limits the residual is round-off, EA u/L of a 0.1 m element: some 1e-5 N."""
    audit = audit_result(paper)
    residual = audit.deviation[audit.name.index("residual of nodes")]
    assert residual < 1e-4


def test_the_direct_result_passes_by_the_same_checks(direct: FormResult, paper: FormResult) -> None:
    audit, other = audit_result(direct), audit_result(paper)
    assert audit.findings == ()
    assert audit.name == other.name
    assert audit.deviation[audit.name.index("residual of nodes")] < 1e-4  # round-off, as above


@pytest.mark.parametrize(
    "change",
    [
        {"joint": "frictionless"},
        {"clamp_mass_top": 0.3, "clamp_mass_bottom": 0.2, "clamp_height_top": 0.05},
    ],
)
def test_other_droppers_pass(change: dict[str, Any]) -> None:
    line = load_line(EXAMPLE)
    other = line.model_copy(update={"dropper": line.dropper.model_copy(update=change)})
    assert audit_result(solve(other, method="direct")).findings == ()


def test_a_pre_sag_is_what_was_asked_for() -> None:
    """Heights less a parabola that is zero at the first and last dropper; forgotten, it is missed."""
    line = load_line(EXAMPLE)
    spans = tuple(span.model_copy(update={"pre_sag": 0.02}) for span in line.spans)
    result = solve(line.model_copy(update={"spans": spans}), method="direct")
    assert audit_result(result).findings == ()
    asked = [span | {"pre_sag": 0.0} for span in result.inputs["spans"]]
    forgotten = audit_result(replace(result, inputs=result.inputs | {"spans": asked}))
    assert any(finding.startswith("height at droppers: off by 20 mm") for finding in forgotten.findings)


def test_only_the_dynamic_method_may_stop_at_its_bands(paper: FormResult) -> None:
    """Another method that leaves 1.08 dead bands has missed its targets."""
    audit = audit_result(replace(paper, method="direct"))
    assert {finding.split(":")[0] for finding in audit.findings} >= {"tension", "height at droppers"}


def test_three_lines(paper: FormResult, corrupted: Corrupt) -> None:
    lines = audit_result(paper).lines()
    assert [line.split(":")[0] for line in lines] == [
        "Audit of equilibrium",
        "Audit of lengths",
        "Audit of targets",
    ]
    assert all("passed" in line for line in lines)
    broken = audit_result(corrupted("droppers.length", at(3, plus(1e-3)))).lines()
    assert ["FAILED" in line for line in broken] == [False, True, False]
    assert "dropper 4" in broken[1]


def test_an_audit_can_be_stored(paper: FormResult) -> None:
    audit = audit_result(paper)
    back = decode(*_swap(encode(audit, type(audit))))
    assert back.findings == audit.findings
    np.testing.assert_array_equal(back.deviation, audit.deviation)


def _swap(stored: tuple[Any, Any]) -> tuple[Any, Any, Any]:
    from catenaria.audit import Audit

    return stored[0], Audit, stored[1]


MM = plus(1e-3)
PERCENT = times(1.01)

# path of what is changed, change, words of a finding that must name it
CORRUPTIONS = {
    "dropper length": ("droppers.length", at(3, MM), ["length", "dropper 4"]),
    "unstressed dropper": ("droppers.unstressed_length", at(3, MM), ["unstressed length", "dropper 4"]),
    "cut length": ("droppers.cut_length", at(3, MM), ["length to be cut", "dropper 4"]),
    "dropper moved": ("droppers.x", at(3, MM), ["place along the track", "dropper 4"]),
    "swapped lengths": ("droppers.length", swapped, ["droppers, length", "of 2 places"]),
    "swapped forces": ("droppers.on_contact", swapped, ["residual of nodes", "contact wire, dropper"]),
    "foot height": ("droppers.height", at(3, MM), ["height of the contact wire", "dropper 4"]),
    "top height": ("droppers.messenger_height", at(3, MM), ["height of the messenger wire", "dropper 4"]),
    "height error": ("droppers.height_error", at(3, MM), ["stated height errors", "dropper 4"]),
    "control error": ("controls.error", at(0, plus(0.1)), ["stated control errors", "contact wire tension"]),
    "force at the top": ("droppers.force_top", at(3, PERCENT), ["force at the top", "dropper 4"]),
    "force at the bottom": ("droppers.force_bottom", at(3, PERCENT), ["force at the bottom", "dropper 4"]),
    "force on contact wire": ("droppers.on_contact", at((3, 2), PERCENT), ["contact wire, dropper 4"]),
    "force on messenger": ("droppers.on_messenger", at((3, 2), PERCENT), ["messenger wire, dropper 4"]),
    "force along the track": ("droppers.on_contact", at((3, 0), plus(0.1)), ["along the track", "dropper 4"]),
    "sideways force": ("droppers.on_contact", at((3, 1), plus(0.1)), ["horizontal forces", "dropper 4"]),
    "reaction": ("supports.force_z", at(3, PERCENT), ["messenger wire, support S2"]),
    "no reaction": ("supports.force_z", at(3, times(0.0)), ["the line as a whole"]),
    "friction": ("supports.force_x", at(3, plus(0.1)), ["supports along the wire", "support S2"]),
    "end force": ("wires.0.end_force", at((1, 0), PERCENT), ["contact wire, strain times EA", "its end"]),
    "tension": ("wires.1.tension", PERCENT, ["messenger wire, stated forces", "tension"]),
    "support moved": ("supports.z", at(3, MM), ["messenger wire, place at supports", "support S2"]),
    "wire length": ("wires.0.unstressed_length", MM, ["contact wire, lengths", "unstressed"]),
    "wire stretched": ("wires.0.stretched_length", MM, ["contact wire, lengths", "stretched"]),
    "travel": ("wires.1.travel", MM, ["messenger wire, place of ends"]),
    "node up 0.1 mm": ("stages.0.position", at((80, 2), plus(1e-4)), ["residual of nodes", "contact wire"]),
    "node along 0.1 mm": ("stages.1.position", at((90, 0), plus(1e-4)), ["residual of nodes", "messenger"]),
    "node aside 0.1 mm": (
        "stages.0.position",
        at((80, 1), plus(1e-4)),
        ["residual of nodes", "contact wire"],
    ),
    "slope": ("stages.0.slope", at((80, 2), plus(1e-4)), ["residual of nodes", "contact wire"]),
    "profile": ("wires.0.profile.z", at(300, MM), ["profile", "contact wire"]),
    "profile tension": ("wires.0.profile.tension", at(300, PERCENT), ["profile, tension", "contact wire"]),
    "profile moment": ("wires.1.profile.moment", at(482, plus(0.1)), ["bending moment", "messenger wire"]),
    "strain at support": ("supports.tension", at(2, PERCENT), ["strain tension (11) at supports", "S1"]),
    "not a number": ("droppers.length", at(3, times(np.nan)), ["length", "nan", "dropper 4"]),
    "modulus of contact wire": (
        "inputs.conductors.contact.youngs_modulus",
        PERCENT,
        ["contact wire, strain times EA", "'contact'"],
    ),
    "area of messenger": (
        "inputs.conductors.messenger.area",
        times(1.001),
        ["strain times EA", "'messenger'"],
    ),
    "modulus of droppers": (
        "inputs.conductors.dropper.youngs_modulus",
        times(0.5),
        ["droppers, unstressed length"],
    ),
    "bending stiffness": (
        "inputs.conductors.contact.bending_stiffness",
        PERCENT,
        ["contact wire", "residual"],
    ),
    "weight of contact wire": ("inputs.conductors.contact.density", PERCENT, ["contact wire as a whole"]),
    "weight of droppers": ("inputs.conductors.dropper.density", times(0.0), ["forces and weight (23)"]),
    "weight of a clamp": ("inputs.dropper.clamp_mass_top", plus(0.1), ["forces and weight (23)"]),
    "gravity": ("inputs.gravity", times(1.0 + 1e-3), ["the line as a whole"]),
    "wanted height": ("inputs.spans.1.contact_wire_height", MM, ["height at droppers"]),
    "wanted tension": (
        "inputs.contact_wire.tension.force",
        plus(100.0),
        ["tension: off by", "contact wire;"],
    ),
    "wanted support": (
        "inputs.supports.2.messenger_wire.height",
        MM,
        ["messenger wire, place at supports", "support S3"],
    ),
    "compressed dropper": (
        "droppers.force_bottom",
        at(3, times(-1.0)),
        ["slack or in compression", "dropper 4"],
    ),
}


@pytest.mark.parametrize(("path", "change", "words"), CORRUPTIONS.values(), ids=CORRUPTIONS)
def test_a_corruption_is_noticed_and_named(
    path: str, change: Change, words: list[str], corrupted: Corrupt
) -> None:
    audit = audit_result(corrupted(path, change))
    assert not audit.passed
    assert any(all(word in finding for word in words) for finding in audit.findings), audit.findings


def test_what_is_far_below_the_tolerances_passes(corrupted: Corrupt) -> None:
    """The controls above fail because of their size, not because something was touched."""
    assert audit_result(corrupted("droppers.length", at(3, plus(1e-9)))).passed
    assert audit_result(corrupted("droppers.on_contact", at((3, 2), plus(1e-4)))).passed


def test_the_bands_are_those_of_the_controls(paper: FormResult) -> None:
    """A result that claims bands of a hundredth misses its own targets."""
    controls = replace(paper.controls, dead_band=0.01 * paper.controls.dead_band)
    audit = audit_result(replace(paper, controls=controls))
    assert {finding.split(":")[0] for finding in audit.findings} >= {"tension", "height at droppers"}


def test_without_controls_targets_must_be_met(paper: FormResult) -> None:
    none = replace(
        paper.controls,
        name=(),
        unit=(),
        **{field: np.empty(0) for field in ("target", "value", "error", "dead_band", "parameter")},
    )
    audit = audit_result(replace(paper, controls=none))
    assert any("messenger wire" in finding for finding in audit.findings)
    assert not any("residual" in finding for finding in audit.findings)


def test_a_result_without_all_parts_is_refused(paper: FormResult, corrupted: Corrupt) -> None:
    with pytest.raises(InconsistentInputError, match="two wires"):
        audit_result(replace(paper, stages=paper.stages[:1]))
    with pytest.raises(InconsistentInputError, match="supports of the messenger wire"):
        audit_result(corrupted("supports.support", lambda names: (*names[:-1], "S9")))
    with pytest.raises(InconsistentInputError, match="ascending"):
        audit_result(corrupted("stages.0.s", at(5, times(0.0))))
