"""Methods for strings against each other, against the direct method, and before the audit."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from catenaria.audit import audit_result
from catenaria.errors import InconsistentInputError, InfeasibleError, UnsupportedError
from catenaria.formfinding.direct import Direct
from catenaria.formfinding.progress import Progress
from catenaria.formfinding.strings.registry import STRING_METHODS
from catenaria.line import Line
from catenaria.results import FormResult, load_result, save_result

Found = Callable[[str, Line], FormResult]
Vary = Callable[[dict[str, Any]], Line]

AGREED = 0.05e-3  # m


def lengths(result: FormResult) -> np.ndarray:
    """Return all lengths that are cut."""
    wires = [wire.unstressed_length for wire in result.wires]
    return np.concatenate((result.droppers.length, result.droppers.unstressed_length, wires))


@pytest.mark.parametrize("name", STRING_METHODS)
def test_methods_agree(any_line: Line, found: Found, name: str) -> None:
    one, other = found("separated", any_line), found(name, any_line)
    np.testing.assert_allclose(lengths(other), lengths(one), rtol=0.0, atol=AGREED)
    np.testing.assert_allclose(other.droppers.force_bottom, one.droppers.force_bottom, atol=0.01)
    np.testing.assert_allclose(other.supports.force_z, one.supports.force_z, atol=0.05)


@pytest.mark.parametrize("name", STRING_METHODS)
def test_a_newton_of_tension_would_be_noticed(vary: Vary, line: Line, found: Found, name: str) -> None:
    """Negative control: 0.02 % of tension is more than what methods may disagree by."""
    changed = vary({"messenger_wire.tension.force": 15e3 * 1.0002})
    difference = np.abs(lengths(found(name, changed)) - lengths(found("separated", line)))
    assert difference.max() > AGREED


@pytest.mark.parametrize("name", STRING_METHODS)
def test_results_pass_the_audit(any_line: Line, found: Found, name: str) -> None:
    assert audit_result(found(name, any_line)).findings == ()


def random_line(line: Line, seed: int) -> Line:
    """Return spans, supports, droppers and tensions at random."""
    rng = np.random.default_rng(seed)
    data = line.model_dump()
    spans, supports, count = [], [], int(rng.integers(1, 5))
    for _ in range(count):
        length = float(rng.uniform(25.0, 70.0))
        x = np.sort(rng.uniform(2.0, length - 2.0, int(rng.integers(1, 9))))
        x = x[np.insert(np.diff(x) > 1.5, 0, True)]
        height = -0.12 * x * (length - x) / length**2
        spans.append(
            {
                "length": length,
                "droppers": {"positions": tuple(x.tolist())},
                "contact_wire_height": tuple(height.tolist()),
            }
        )
    for i in range(count + 1):
        held = {"contact_wire": {"height": 0.0}} if i in (0, count) or rng.random() < 0.4 else {}
        supports.append({"messenger_wire": {"height": 1.5}} | held)
    for name in ("contact_wire", "messenger_wire"):
        tension = {"force": float(rng.uniform(9e3, 22e3)), "at": str(rng.choice(["start", "end"]))}
        data[name] = data[name] | {"tension": tension}
    return Line.model_validate(data | {"spans": tuple(spans), "supports": tuple(supports)})


@pytest.mark.parametrize("name", [name for name in STRING_METHODS if name != "adaptive force density"])
@pytest.mark.parametrize("seed", [3, 11, 48])
def test_methods_agree_on_any_line(line: Line, found: Found, name: str, seed: int) -> None:
    """All but the one that converges too slowly where droppers are close together."""
    some = random_line(line, seed)
    result = found(name, some)
    assert audit_result(result).findings == ()
    np.testing.assert_allclose(lengths(result), lengths(found("separated", some)), rtol=0.0, atol=AGREED)


def test_the_difference_from_the_direct_method_is_bending(line: Line, vary: Vary, found: Found) -> None:
    """A bent wire leaves a support like a string from l J/2 above it, with l = sqrt(EJ/T).

    So the difference is up to 5 mm, and a hundredth of the stiffness leaves a tenth of it; the direct method
    has nodes 0.1 m beside supports, which rounds a kink as well.
    """
    string = found("separated", line)

    def difference(share: float) -> float:
        stiffness = {"contact": 400.0, "messenger": 311.0}
        changed = vary({f"conductors.{k}.bending_stiffness": share * v for k, v in stiffness.items()})
        bent = Direct().find_form(changed)
        return float(np.max(np.abs(bent.droppers.length - string.droppers.length)))

    whole = difference(1.0)
    assert 3e-3 < whole < 5.5e-3
    assert whole / difference(0.1) == pytest.approx(np.sqrt(10.0), rel=0.02)
    assert difference(0.01) < 0.7e-3


@pytest.mark.parametrize("name", STRING_METHODS)
def test_what_strings_cannot_do_is_refused_by_name(vary: Vary, name: str) -> None:
    method = STRING_METHODS[name](None)
    for change, field in (
        ({"dropper.joint": "frictionless"}, "dropper.joint"),
        ({"contact_wire.tension": {"force": 15e3, "measure": "strain"}}, r"contact_wire\.tension\.measure"),
        ({"contact_wire.tension": {"force": 15e3, "pulled": "end"}}, r"contact_wire\.tension\.pulled"),
    ):
        with pytest.raises(UnsupportedError, match=field):
            method.find_form(vary(change))


@pytest.mark.parametrize("name", STRING_METHODS)
def test_an_earlier_result_is_refused(line: Line, found: Found, name: str) -> None:
    with pytest.raises(UnsupportedError, match="earlier result"):
        STRING_METHODS[name](None).find_form(line, found("separated", line))


@pytest.mark.parametrize("name", STRING_METHODS)
def test_compression_and_slack_are_refused(vary: Vary, line: Line, name: str) -> None:
    method, spans = STRING_METHODS[name](None), line.model_dump()["spans"]
    low = ({**spans[0], "contact_wire_height": (0, 0, 0, -0.2, 0, 0, 0)}, *spans[1:])
    with pytest.raises(InfeasibleError, match="compression: 4"):
        method.find_form(vary({"spans": low}))
    with pytest.raises(InfeasibleError, match=r"upside down: \d"):
        method.find_form(vary({"messenger_wire.tension.force": 4e3}))


@pytest.mark.parametrize("name", STRING_METHODS)
def test_droppers_are_named_as_results_name_them(vary: Vary, line: Line, name: str) -> None:
    spans = line.model_dump()["spans"]
    low = (*spans[:2], {**spans[2], "contact_wire_height": (0, 0, 0, -0.2, 0, 0, 0)})
    with pytest.raises(InfeasibleError, match="compression: 4 in span 3"):
        STRING_METHODS[name](None).find_form(vary({"spans": low}))
    with pytest.raises(InfeasibleError, match=r"upside down: .*4.* in span 2"):
        STRING_METHODS[name](None).find_form(vary({"messenger_wire.tension.force": 4e3}))


@pytest.mark.parametrize("name", STRING_METHODS)
def test_the_listener_hears_that_it_begins(line: Line, name: str) -> None:
    heard: list[Progress] = []
    STRING_METHODS[name](heard.append).find_form(line)
    assert [progress.stage for progress in heard] == ["both wires"]


def test_a_result_without_stages_is_stored(line: Line, found: Found, tmp_path: Any) -> None:
    result = found("separated", line)
    save_result(result, tmp_path)
    again = load_result(tmp_path)
    assert (again.physics, again.stages) == ("string", ())
    np.testing.assert_array_equal(again.droppers.length, result.droppers.length)


def broken(result: FormResult, what: str) -> FormResult:
    """Return a result with one thing wrong."""
    droppers, wire = result.droppers, result.wires[1]
    one = np.zeros(droppers.x.size)
    one[3] = 1.0
    replace = dataclasses.replace
    if what == "a length":
        return replace(result, droppers=replace(droppers, length=droppers.length + 1e-3 * one))
    if what == "a force":
        on_messenger = droppers.on_messenger * (1.0 + 0.01 * one[:, None])
        return replace(result, droppers=replace(droppers, on_messenger=on_messenger))
    if what == "a support":
        supports = replace(result.supports, force_z=1.01 * result.supports.force_z)
        return replace(result, supports=supports)
    if what == "a point":
        z = wire.profile.z.copy()
        z[40] += 1e-4
        return replace(result, wires=(result.wires[0], replace(wire, profile=replace(wire.profile, z=z))))
    if what == "a tension":
        tension = 1.0001 * wire.profile.tension
        shape = replace(wire.profile, tension=tension)
        return replace(result, wires=(result.wires[0], replace(wire, profile=shape)))
    if what == "a stiffness":
        conductors = result.inputs["conductors"]
        messenger = conductors["messenger"] | {"youngs_modulus": 82e9}
        return replace(result, inputs=result.inputs | {"conductors": conductors | {"messenger": messenger}})
    return replace(result, inputs=result.inputs | {"gravity": 9.81})


FINDINGS = {
    "a length": "droppers, length: off by 1 mm at dropper 4",
    "a force": "droppers, vertical forces",
    "a support": "messenger wire as a whole",
    "a point": "messenger wire, force across the string",
    "a tension": "profile, tension",
    "a stiffness": "messenger wire, stretched length between points",
    "gravity": "contact wire as a whole",
}


@pytest.mark.parametrize("what", FINDINGS)
def test_the_audit_of_strings_finds_what_is_wrong(line: Line, found: Found, what: str) -> None:
    findings = audit_result(broken(found("separated", line), what)).findings
    assert any(FINDINGS[what] in finding for finding in findings), findings


def test_a_bent_wire_is_no_string(line: Line, found: Found) -> None:
    """The stated physics matters: forces and shape of one are not those of the other."""
    bent = dataclasses.replace(Direct().find_form(line), physics="string")
    assert any("force across the string" in finding for finding in audit_result(bent).findings)
    with pytest.raises(InconsistentInputError, match="does not hold the nodes"):
        audit_result(dataclasses.replace(found("separated", line), physics="bending"))
    with pytest.raises(InconsistentInputError, match="not 'rope'"):
        audit_result(dataclasses.replace(bent, physics="rope"))
