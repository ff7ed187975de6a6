"""Random lines in the plane: each is solved and passes the audit, or is refused with a named reason.

Never a NaN, never an exception that does not say what is wrong with the line, never a silent wrong answer.
Examples are drawn by hypothesis from fixed seeds.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields, is_dataclass, replace
from typing import Any, cast

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from catenaria.catenary.taut_string import taut_string
from catenaria.errors import CatenariaError, InfeasibleError
from catenaria.formfinding.coupled import find_coupled_form
from catenaria.line import Line
from catenaria.results import FormResult
from catenaria.workflow import solve

FloatArray = NDArray[np.float64]
Change = dict[str, Any]

MM = 1e-3


def reproducible(examples: int) -> settings:
    """Return settings with which every run draws the same lines."""
    slow = [HealthCheck.too_slow]
    return settings(
        max_examples=examples, derandomize=True, database=None, deadline=None, suppress_health_check=slow
    )


def thousandths(low: float, high: float) -> st.SearchStrategy[float]:
    """Return numbers in steps of a thousandth: they shrink well, and are what is written into files."""
    return st.integers(round(low * 1000), round(high * 1000)).map(lambda number: number / 1000)


@st.composite
def sensible_positions(draw: st.DrawFn, length: float) -> tuple[float, ...]:
    """Return droppers as they are built: about evenly spaced, some metres from both supports."""
    count = draw(st.integers(1, 9))
    if count == 1:
        return (draw(thousandths(0.3 * length, 0.7 * length)),)
    first, last = draw(thousandths(1.5, 5.0)), length - draw(thousandths(1.5, 5.0))
    spacing = (last - first) / (count - 1)
    shifts = draw(st.lists(thousandths(-0.3, 0.3), min_size=count - 2, max_size=count - 2))
    return (first, *(first + spacing * (i + shift) for i, shift in enumerate(shifts, start=1)), last)


@st.composite
def nasty_positions(draw: st.DrawFn, length: float) -> tuple[float, ...]:
    """Return droppers anywhere: millimetres apart, most of the span empty.

    None hangs nearer than 0.2 m to a support, where a stiff wire makes it carry kilonewtons. So loaded it
    stretches by millimetres, whose weight (23) counts and the audit does not.
    """
    places = st.integers(200, round(length * 1000) - 200)
    return tuple(x * MM for x in sorted(draw(st.lists(places, min_size=1, max_size=9, unique=True))))


@st.composite
def spans(draw: st.DrawFn, level: float, curvature: float, built: bool) -> Change:
    """Return one span whose droppers hold the contact wire on a parabola.

    Lines as they are built have at most half of `curvature` [1/m], at which droppers have nothing to carry.
    """
    length = draw(thousandths(30.0, 75.0))
    x = draw(sensible_positions(length) if built or draw(st.booleans()) else nasty_positions(length))
    middle, half = 0.5 * (x[0] + x[-1]), max(0.5 * (x[-1] - x[0]), MM)
    pre_sag = draw(st.sampled_from([0.0, 0.5, 1.0, 2.0])) * MM * length
    if built:
        pre_sag = min(pre_sag, 0.25 * curvature * half**2)
    height = (
        [level - pre_sag * (1.0 - ((place - middle) / half) ** 2) for place in x] if len(x) > 2 else level
    )
    return {"length": length, "droppers": {"positions": x}, "contact_wire_height": height}


COPPER, BRONZE, ALUMINIUM, STEEL = (120e9, 8900.0), (105e9, 8900.0), (60e9, 2700.0), (190e9, 7850.0)


@st.composite
def conductors(
    draw: st.DrawFn, metals: list[tuple[float, float]], area: tuple[float, float], stiffest: float
) -> Change:
    """Return a wire of one of the metals, each a modulus and a density."""
    modulus, density = draw(st.sampled_from(metals))
    return {
        "youngs_modulus": modulus,
        "area": draw(thousandths(*area)) * 1e-6,
        "density": density,
        "bending_stiffness": draw(st.sampled_from([1.0, 0.5, 0.1, 0.0])) * stiffest,
    }


@st.composite
def tensions(draw: st.DrawFn, low: int, high: int) -> Change:
    """Return a tension, measured at one of the two ends."""
    return {"force": draw(st.integers(low, high)), "at": draw(st.sampled_from(["end", "start"]))}


@st.composite
def lines(draw: st.DrawFn, built: bool = False) -> Line:
    """Return a line with one to five spans, of all kinds, or as they are built.

    Frictionless droppers lean, and the weight in (23) is that of vertical ones: under a slack messenger it is
    off by millinewtons, which the audit finds. Therefore they hang from messengers of 8 kN or more.
    """
    wires = {
        "contact": draw(conductors([COPPER, BRONZE], (80.0, 150.0), 500.0)),
        "messenger": draw(conductors([BRONZE, COPPER, ALUMINIUM, STEEL], (50.0, 150.0), 300.0)),
    }
    weight = {name: 9.8 * wire["density"] * wire["area"] for name, wire in wires.items()}
    contact, messenger = (draw(tensions(8_000 if built else 3_000, 30_000)) for _ in wires)
    level = draw(st.sampled_from([0.0, 5.5]))
    curvature = weight["contact"] / contact["force"]
    laid = draw(st.lists(spans(level, curvature, built), min_size=1, max_size=5))
    # The contact wire may hang at one dropper in mid-span, where it weighs twice; clamps and droppers: 3 N/m.
    carried = weight["messenger"] + 2.0 * weight["contact"] + 3.0
    sag = carried * max(span["length"] for span in laid) ** 2 / (8.0 * messenger["force"])
    free = {"messenger_wire": {"height": level + round(sag + draw(thousandths(0.2, 1.2)), 3)}}
    held = free | {"contact_wire": {"height": level}}
    inner = [held if draw(st.booleans()) else free for _ in laid[1:]]
    upright = built or messenger["force"] < 8_000
    joint = "guided" if upright else draw(st.sampled_from(["guided", "frictionless"]))
    return Line.model_validate(
        {
            "format": 1,
            "conductors": wires | {"dropper": draw(conductors([STEEL], (10.0, 16.0), 4.0))},
            "contact_wire": {"conductor": "contact", "tension": contact},
            "messenger_wire": {"conductor": "messenger", "tension": messenger, "tail": 1.0},
            "dropper": {
                "conductor": "dropper",
                "joint": joint,
                "clamp_mass_top": draw(thousandths(0.0, 0.5)),
                "clamp_mass_bottom": draw(thousandths(0.0, 0.5)),
            },
            "supports": [held, *inner, held],
            "spans": laid,
        }
    )


def arrays(value: object, place: str = "result") -> Iterator[tuple[str, FloatArray]]:
    """Yield every floating-point number of a result with its place."""
    if is_dataclass(value):
        for field in fields(value):
            yield from arrays(getattr(value, field.name), f"{place}.{field.name}")
    elif isinstance(value, tuple):
        for i, part in enumerate(cast("tuple[object, ...]", value)):
            yield from arrays(part, f"{place}[{i}]")
    elif isinstance(value, float):
        yield place, np.array([value])
    elif isinstance(value, np.ndarray) and value.dtype.kind == "f":
        yield place, value


def check_result(result: FormResult) -> None:
    """Check that a form is finite, passed its audit and can be built."""
    unknown = [place for place, values in arrays(result) if not np.isfinite(values).all()]
    assert unknown == []
    assert result.audit.group  # there was one
    assert result.audit.findings == ()
    assert result.rebuilt.findings() == ()
    droppers = result.droppers
    assert min(droppers.force_top.min(), droppers.force_bottom.min()) >= 0.0
    assert min(droppers.length.min(), droppers.cut_length.min()) > 0.0
    assert (droppers.messenger_height > droppers.height).all()
    assert np.abs(droppers.height_error).max() < 1e-8


def check_refusal(refusal: CatenariaError) -> None:
    """Check that a refusal says in words what is wrong, and what would help."""
    words = str(refusal)
    assert len(words) > 40
    assert "nan" not in words.lower()
    assert "Try: " in words or "would" in words


def outcome(line: Line) -> FormResult | CatenariaError:
    """Solve a line; whatever is raised that is not a refusal is a fault of the program."""
    try:
        return solve(line)
    except CatenariaError as refusal:
        return refusal


@reproducible(120)
@given(lines())
def test_a_line_is_solved_or_refused(line: Line) -> None:
    found = outcome(line)
    if isinstance(found, FormResult):
        check_result(found)
    else:
        check_refusal(found)


@reproducible(60)
@given(lines(built=True))
def test_a_line_as_they_are_built_is_solved(line: Line) -> None:
    """None is refused, and the form is that of strings.

    Most take 2 or 3 iterations; wires without bending stiffness take more, as their clamps change elements.
    """
    found = outcome(line)
    assert isinstance(found, FormResult), found
    check_result(found)
    assert max(work.steps for work in found.counters) <= 12
    check_forces(line, found)
    check_heights(line, found)


def check_forces(line: Line, result: FormResult) -> None:
    """Check dropper forces against a string over the wanted heights.

    A wire that bends is a string whose bays begin a bending length l_b = sqrt(EJ/T) beside the clamps: forces
    differ by l_b/a of what the neighbouring droppers carry, a being the shorter bay. Slopes and elements of
    0.1 m add less than 1 %.
    """
    wire = line.conductors[line.contact_wire.conductor]
    T, w = line.contact_wire.tension.force, wire.rhoA * line.gravity
    held = np.array(line.support_x)[list(line.contact_support_indices)]
    level = np.full(
        held.size, 0.0 if line.supports[0].contact_wire is None else line.supports[0].contact_wire.height
    )
    x, height = np.concatenate((held, line.dropper_x)), np.concatenate((level, line.dropper_target_height))
    order = np.argsort(x)
    bay, rise = np.diff(x[order]), np.diff(height[order])
    force = 0.5 * w * (bay[1:] + bay[:-1]) - T * np.diff(rise / bay)
    size = np.abs(np.pad(force, 1))
    nearby = np.maximum(np.maximum(size[:-2], size[2:]), size[1:-1])
    allowed = (np.sqrt(wire.EJ / T) / np.minimum(bay[1:], bay[:-1]) + 0.01) * nearby
    here = np.isin(x[order][1:-1], line.dropper_x)
    assert (np.abs(result.droppers.force_bottom - force[here]) < allowed[here]).all()


def check_heights(line: Line, result: FormResult) -> None:
    """Check the messenger against a string under the forces of its droppers.

    Of second order in the slope and the strain; and rounded over supports and clamps, within a bending length
    and an element of 0.1 m, by the slope times that length.
    """
    wire, droppers = line.conductors[line.messenger_wire.conductor], result.droppers
    H, w = line.messenger_wire.tension.force, wire.rhoA * line.gravity
    supports = np.array(line.support_x), np.array([support.messenger_height for support in line.supports])
    loads = droppers.x, droppers.force_top
    everywhere = np.linspace(supports[0][0], supports[0][-1], 1000)
    depth = float((supports[1][0] - taut_string(everywhere, supports, H, w, loads)[0]).max())
    slope = float(np.abs(taut_string(everywhere, supports, H, w, loads)[1]).max())
    allowed = depth * (slope**2 + H / wire.EA) + slope * (1.5 * np.sqrt(wire.EJ / H) + 0.03)
    height, _ = taut_string(droppers.x, supports, H, w, loads)
    np.testing.assert_allclose(droppers.messenger_height, height, rtol=0.0, atol=allowed)


def check_at_once(line: Line, result: FormResult) -> None:
    """Check against all wires and droppers in one iteration, with droppers of another kind."""
    form, droppers = find_coupled_form(line), result.droppers
    np.testing.assert_allclose(droppers.length, form.length, rtol=0.0, atol=1e-6)
    np.testing.assert_allclose(droppers.unstressed_length, form.unstressed_length, rtol=0.0, atol=1e-6)
    np.testing.assert_allclose(droppers.on_contact, form.on_contact, rtol=0.0, atol=1e-3)
    np.testing.assert_allclose(droppers.on_messenger, form.on_messenger, rtol=0.0, atol=1e-3)


@reproducible(25)
@given(lines(built=True))
def test_staged_and_at_once_agree(line: Line) -> None:
    check_at_once(line, solve(line))


@reproducible(3)
@given(lines(built=True))
def test_wrong_forms_are_noticed(line: Line) -> None:
    result = solve(line)
    droppers = result.droppers
    pushed, lost = droppers.force_bottom.copy(), droppers.length.copy()
    pushed[0], lost[-1] = -1e-3, np.nan
    for wrong in ({"force_bottom": pushed}, {"length": lost}, {"height_error": droppers.height_error + 1e-7}):
        with pytest.raises(AssertionError):
            check_result(replace(result, droppers=replace(droppers, **wrong)))
    with pytest.raises(AssertionError):
        check_result(replace(result, audit=replace(result.audit, findings=("off by 1 N",))))
    with pytest.raises(AssertionError):
        check_forces(
            line, replace(result, droppers=replace(droppers, force_bottom=1.3 * droppers.force_bottom))
        )
    higher = replace(droppers, messenger_height=droppers.messenger_height + 0.05)
    with pytest.raises(AssertionError):
        check_heights(line, replace(result, droppers=higher))


@reproducible(3)
@given(lines(built=True))
def test_the_form_of_another_line_is_noticed(line: Line) -> None:
    data = line.model_dump()
    data["messenger_wire"]["tension"]["force"] += 5.0
    with pytest.raises(AssertionError):
        check_at_once(Line.model_validate(data), solve(line))


@pytest.mark.parametrize(
    "words", ["", "singular matrix", "the force is nan N; another tension would help it very much"]
)
def test_refusals_that_say_nothing_are_noticed(words: str) -> None:
    with pytest.raises(AssertionError):
        check_refusal(InfeasibleError(words))


def test_the_lines_are_of_all_kinds() -> None:
    """What is drawn is neither all solved nor all refused."""
    drawn: list[Line] = []

    @reproducible(60)
    @given(lines())
    def draw(line: Line) -> None:
        drawn.append(line)

    draw()
    assert {line.dropper.joint for line in drawn} == {"guided", "frictionless"}
    assert {1, 5} <= {len(line.spans) for line in drawn}
    solved = [isinstance(outcome(line), FormResult) for line in drawn[:30]]
    assert 5 < sum(solved) < 28
