"""Lines unlike the paper's: free-body balances, closed forms and symmetries that know nothing of the program.

The balances read the result alone: forces on devices and supports, forces of droppers on wires, weights from
the lengths that were found.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from catenaria.catenary.taut_string import taut_string
from catenaria.line import Line, load_line
from catenaria.results import FormResult
from catenaria.workflow import solve

FloatArray = NDArray[np.float64]
Change = dict[str, Any]

EXAMPLE = Path(__file__).parents[2] / "examples" / "yang2017_three_span.yaml"
POSITIONS = (4.0, 13.5, 23.0, 32.5, 42.0, 51.5, 61.0)
PARABOLA = tuple(-0.02 * (1.0 - ((x - 32.5) / 28.5) ** 2) for x in POSITIONS)
UNEQUAL = ((50.0, (4.0, 14.5, 25.0, 35.5, 46.0)), (65.0, POSITIONS), (57.0, (3.0, 12.0, 24.0, 36.0, 48.0)))


def span(length: float = 65.0, positions: tuple[float, ...] = POSITIONS, height: Any = 0.0) -> Change:
    return {"length": length, "droppers": {"positions": positions}, "contact_wire_height": height}


def of_spans(*spans: Change, low: float = 0.0, high: float = 1.5, held: bool = False) -> Change:
    """Return spans and their supports; the contact wire is held at the ends, or everywhere."""
    messenger = {"messenger_wire": {"height": high}}
    both = messenger | {"contact_wire": {"height": low}}
    middle = both if held else messenger
    return {"spans": spans, "supports": (both, *[middle] * (len(spans) - 1), both)}


LINES: dict[str, Change] = {
    "one span": of_spans(span()),
    "one dropper": of_spans(span(20.0, (10.0,))),
    "unequal spans": of_spans(*(span(length, positions) for length, positions in UNEQUAL)),
    "25 spans": of_spans(*[span()] * 25),
    "pre-sag": of_spans(*[span(height=PARABOLA)] * 3),
    "high and far": of_spans(*[span(height=5.3)] * 3, low=5.3, high=6.8) | {"start_chainage": 123e3},
    "held everywhere": of_spans(*[span()] * 3, held=True),
    "other gravity": {"gravity": 9.80665},
    "clamps": {
        "dropper.clamp_mass_top": 0.2,
        "dropper.clamp_mass_bottom": 0.15,
        "dropper.clamp_height_top": 0.03,
        "dropper.clamp_height_bottom": 0.02,
    },
    "heavy wire": {"conductors.contact.density": 15e3},
}
MOVED = ("unequal spans", "clamps")
CASES = [(name, "direct") for name in LINES] + [(name, "dynamic") for name in MOVED]


def described(change: Change) -> Line:
    data = load_line(EXAMPLE).model_dump()
    for path, value in change.items():
        *way, last = path.split(".")
        place: Any = data
        for key in way:
            place = place[key]
        place[last] = value
    return Line.model_validate(data)


@cache
def solved(name: str, method: str) -> tuple[Line, FormResult]:
    line = described(LINES[name])
    return line, solve(line, method=method)


@pytest.fixture(params=CASES, ids=[" by ".join(case) for case in CASES])
def case(request: pytest.FixtureRequest) -> tuple[Line, FormResult]:
    """Each line with its form."""
    return solved(*request.param)


def wire_weight(line: Line, result: FormResult, which: int) -> float:
    """Return the weight of a wire with both tails: its unstressed length is what is laid out at first [N]."""
    wire = (line.contact_wire, line.messenger_wire)[which]
    rhoA = line.conductors[wire.conductor].rhoA
    start_x = result.wires[which].start_x
    return float(rhoA * line.gravity * (start_x[-1] - start_x[0]))


def on_wire(result: FormResult, which: int) -> FloatArray:
    """Sum all forces on a wire but its weight: from devices, supports and droppers, shape (3,) [N]."""
    supports, name = result.supports, result.wires[which].name
    here = np.array(supports.wire) == name
    held = np.column_stack((supports.force_x, supports.force_y, supports.force_z))[here]
    droppers = (result.droppers.on_contact, result.droppers.on_messenger)[which]
    return droppers.sum(axis=0) - held.sum(axis=0) - result.wires[which].end_force.sum(axis=0)


def check_balance(line: Line, result: FormResult) -> None:
    """Check that each wire is in balance; guides may hold droppers along the track, hence two directions."""
    for which in (0, 1):
        total = on_wire(result, which)
        assert total[2] == pytest.approx(wire_weight(line, result, which), abs=1e-4 * scale(result))
        assert total[1] == pytest.approx(0.0, abs=1e-4)


def scale(result: FormResult) -> float:
    """Return how much coarser the method resolves forces: Newton corrections of 10 mN against 0.01 mN."""
    return 1.0 if result.method == "direct" else 200.0


def test_wires_are_in_balance(case: tuple[Line, FormResult]) -> None:
    check_balance(*case)


def test_a_lost_force_is_noticed(case: tuple[Line, FormResult]) -> None:
    line, result = case
    droppers, supports = result.droppers, result.supports
    less = replace(droppers, on_contact=0.99 * droppers.on_contact)
    more = replace(droppers, on_messenger=1.01 * droppers.on_messenger)
    push = replace(supports, force_z=supports.force_z + 0.2)
    for wrong in (
        replace(result, droppers=less),
        replace(result, droppers=more),
        replace(result, supports=push),
    ):
        with pytest.raises(AssertionError):
            check_balance(line, wrong)


def test_a_wire_pulls_both_ways(case: tuple[Line, FormResult]) -> None:
    """The reactions along the track differ by what supports and guides take, far less than 1 % of T."""
    for wire in case[1].wires:
        np.testing.assert_allclose(wire.end_force[:, 0], [wire.tension, -wire.tension], rtol=5e-3)


def clamp_and_dropper_weight(line: Line, result: FormResult) -> FloatArray:
    kind, dropper = line.dropper, line.conductors[line.dropper.conductor]
    mass = dropper.rhoA * result.droppers.length
    return line.gravity * (mass + kind.clamp_mass_top + kind.clamp_mass_bottom)


def test_droppers_are_in_balance(case: tuple[Line, FormResult]) -> None:
    """Eq. (23): top force is bottom force, weight and both clamps, whose stretch weighs 0.1 mN."""
    line, result = case
    droppers = result.droppers
    G = clamp_and_dropper_weight(line, result)
    band = 1e-3 if result.method == "direct" else 0.05
    np.testing.assert_allclose(droppers.force_top - droppers.force_bottom, G, atol=band)
    np.testing.assert_allclose(droppers.on_contact[:, 2], droppers.force_bottom, atol=1e-12)
    np.testing.assert_allclose(droppers.on_messenger[:, 2], -droppers.force_top, atol=1e-12)
    assert not np.allclose(droppers.force_top - droppers.force_bottom, 0.9 * G, atol=band)


def check_string(line: Line, result: FormResult) -> None:
    """Check forces and heights against a string of horizontal tension T: what bending adds is small."""
    droppers, (contact, messenger) = result.droppers, (line.contact_wire, line.messenger_wire)
    x = np.concatenate((line.support_x, droppers.x))
    held = np.isin(np.arange(x.size), [*line.contact_support_indices, *range(len(line.support_x), x.size)])
    first = line.supports[0].contact_wire
    height = np.concatenate(
        (np.full(len(line.support_x), first.height if first else 0.0), droppers.target_height)
    )
    x, height = x[held], height[held]
    order = np.argsort(x)
    x, height = x[order], height[order]
    conductor = line.conductors[contact.conductor]
    w = conductor.rhoA * line.gravity
    bays, kink = np.diff(x), np.diff(np.diff(height) / np.diff(x))
    force = 0.5 * w * (bays[:-1] + bays[1:]) - contact.tension.force * kink
    force = force[np.isin(x[1:-1], droppers.x)]
    np.testing.assert_allclose(droppers.force_bottom, force, atol=1.5)

    conductor = line.conductors[messenger.conductor]
    w = conductor.rhoA * line.gravity
    supports = np.array(line.support_x), np.array([support.messenger_height for support in line.supports])
    top = force + clamp_and_dropper_weight(line, result)
    z, _ = taut_string(droppers.x, supports, messenger.tension.force, w, (droppers.x, top))
    near = max(6e-3, 0.01 * result.wires[1].sag)  # second order in the slopes
    np.testing.assert_allclose(droppers.messenger_height, z, atol=near)
    np.testing.assert_allclose(droppers.length, z - droppers.target_height, atol=near)


def test_forms_are_those_of_strings(case: tuple[Line, FormResult]) -> None:
    check_string(*case)


def test_other_forms_are_noticed(case: tuple[Line, FormResult]) -> None:
    line, result = case
    droppers = result.droppers
    for wrong in (
        replace(droppers, force_bottom=droppers.force_bottom + 4.0),
        replace(droppers, length=droppers.length + 0.0125),
        replace(droppers, messenger_height=droppers.messenger_height + 0.0125),
    ):
        with pytest.raises(AssertionError):
            check_string(line, replace(result, droppers=wrong))


@pytest.mark.parametrize("name", ["one span", "25 spans", "held everywhere", "other gravity", "heavy wire"])
def test_sags_are_those_of_the_textbook(name: str) -> None:
    """EN 50119's w h^2/(8 T): the contact wire between droppers, the messenger with all that it carries."""
    line, result = solved(name, "direct")
    conductors, g = line.conductors, line.gravity
    contact, messenger = (conductors[key] for key in ("contact", "messenger"))
    w = contact.rhoA * g
    bay = w * 9.5**2 / (8.0 * 15e3)
    assert result.wires[0].sag == pytest.approx(bay, rel=0.08)
    carried = w + messenger.rhoA * g + clamp_and_dropper_weight(line, result).mean() * 7 / 65.0
    assert result.wires[1].sag == pytest.approx(carried * 65.0**2 / (8.0 * 15e3), rel=0.08)
    assert result.wires[1].sag != pytest.approx(0.8 * carried * 65.0**2 / (8.0 * 15e3), rel=0.08)


@pytest.mark.parametrize(("name", "held"), [("pre-sag", PARABOLA * 3), ("high and far", (5.3,) * 21)])
def test_heights_are_those_wanted(name: str, held: tuple[float, ...]) -> None:
    droppers = solved(name, "direct")[1].droppers
    np.testing.assert_allclose(droppers.height, held, atol=1e-9)
    np.testing.assert_array_equal(droppers.target_height, held)


def test_pre_sag_takes_load_off_by_its_curvature() -> None:
    """Equal bays on a parabola of depth f: force w a - 8 f T a/l^2 less by 8*0.02*15e3*9.5/57^2 = 7.02 N."""
    level = solve(load_line(EXAMPLE)).droppers.force_bottom
    curved = solved("pre-sag", "direct")[1].droppers.force_bottom
    np.testing.assert_allclose((level - curved)[2:5], 8.0 * 0.02 * 15e3 * 9.5 / 57.0**2, atol=0.05)
    assert curved[0] > level[0] + 10.0  # the end droppers carry what hangs in the curve


def shape_of(result: FormResult) -> dict[str, FloatArray]:
    """Return what does not depend on where the line stands."""
    droppers, supports = result.droppers, result.supports
    return {
        "length": droppers.length,
        "cut_length": droppers.cut_length,
        "force_bottom": droppers.force_bottom,
        "force_top": droppers.force_top,
        "contact_coordinate": droppers.contact_coordinate,
        "messenger_coordinate": droppers.messenger_coordinate,
        "support force": supports.force_z,
        "unstressed": np.array([wire.unstressed_length for wire in result.wires]),
        "stretched": np.array([wire.stretched_length for wire in result.wires]),
        "travel": np.array([wire.travel for wire in result.wires]),
        "sag": np.array([wire.sag for wire in result.wires]),
    }


def check_same(
    found: dict[str, FloatArray], wanted: dict[str, FloatArray], metres: float, newtons: float
) -> None:
    for name, value in wanted.items():
        tolerance = newtons if "force" in name else metres
        np.testing.assert_allclose(found[name], value, rtol=0.0, atol=tolerance, err_msg=name)


HIGH = LINES["high and far"] | {"start_chainage": 0.0}
FAR = {"start_chainage": 123e3}


@pytest.mark.parametrize(
    ("change", "metres", "newtons"),
    [(HIGH, 1e-9, 1e-6), (FAR, 1e-7, 1e-4), (LINES["high and far"], 1e-7, 1e-4)],
    ids=["high", "far", "high and far"],
)
def test_a_line_elsewhere_has_the_same_form(change: Change, metres: float, newtons: float) -> None:
    here, there = solve(load_line(EXAMPLE)), solve(described(change))
    check_same(shape_of(there), shape_of(here), metres, newtons)
    np.testing.assert_allclose(there.droppers.x - there.droppers.x[0], here.droppers.x - here.droppers.x[0])
    lower = solve(described(change | {"contact_wire.tension.force": 15.001e3}))
    with pytest.raises(AssertionError):
        check_same(shape_of(lower), shape_of(here), metres, newtons)


def test_offsets_are_those_of_the_line() -> None:
    here, there = solve(load_line(EXAMPLE)), solved("high and far", "direct")[1]
    for a, b in zip(here.wires, there.wires, strict=True):
        np.testing.assert_allclose(b.profile.x - 123e3, a.profile.x, atol=1e-7)
        np.testing.assert_allclose(b.profile.z - 5.3, a.profile.z, atol=1e-7)
    np.testing.assert_allclose(there.droppers.height - 5.3, here.droppers.height, atol=1e-9)
    np.testing.assert_allclose(
        there.droppers.messenger_height - 5.3, here.droppers.messenger_height, atol=1e-7
    )
    assert there.supports.x[0] == 123e3


def test_clamps_shorten_what_is_cut_and_weigh_on_the_messenger() -> None:
    bare, clamped = solve(load_line(EXAMPLE)), solved("clamps", "direct")[1]
    droppers = clamped.droppers
    np.testing.assert_allclose(droppers.unstressed_length - droppers.cut_length, 0.05, atol=1e-12)
    np.testing.assert_allclose(bare.droppers.unstressed_length, bare.droppers.cut_length, atol=1e-15)
    np.testing.assert_allclose(droppers.force_bottom, bare.droppers.force_bottom, atol=1e-6)
    added = (droppers.force_top - bare.droppers.force_top) - 0.35 * 9.8
    np.testing.assert_allclose(
        added, 8900 * 10e-6 * 9.8 * (droppers.length - bare.droppers.length), atol=1e-5
    )
    assert (droppers.length < bare.droppers.length - 2e-3).all()


def test_unstressed_length_has_the_stretch_of_the_mean_force() -> None:
    """Of Green's bar T = EA (f^2 - 1) f/2, for the mean of the forces just inside the clamps."""
    droppers = solved("clamps", "direct")[1].droppers
    inner = 0.5 * (droppers.force_top - 0.2 * 9.8 + droppers.force_bottom + 0.15 * 9.8)
    f = droppers.length / droppers.unstressed_length
    np.testing.assert_allclose(119e9 * 10e-6 * 0.5 * (f**2 - 1.0) * f, inner, atol=1e-5)
    assert np.abs(inner - droppers.force_bottom).min() > 0.5


def test_the_tension_may_be_measured_at_either_end() -> None:
    """On a symmetric line it is the same."""
    start = solve(described({"contact_wire.tension.at": "start", "messenger_wire.tension.at": "start"}))
    check_same(shape_of(start), shape_of(solve(load_line(EXAMPLE))), 1e-7, 1e-4)


SCALED = (
    ("130 GPa", "130000 N/mm^2"),
    ("120 mm^2", "0.00012 m^2"),
    ("15 kN", "15000 N"),
    ("guessed_length: 1.5 m", "guessed_length: 1500 mm"),
    ("length: 65 m", "length: 65000 mm"),
    ("[4, 13.5, 23, 32.5, 42, 51.5, 61]", "[4000 mm, 1350 cm, 23, 32500 mm, 0.042 km, 51.5 m, 61 m]"),
    ("height: 1.5 m", "height: 150 cm"),
)


def test_other_units_in_the_file_change_nothing(tmp_path: Path) -> None:
    text = EXAMPLE.read_text(encoding="utf-8")
    for old, new in SCALED:
        assert old in text
        text = text.replace(old, new)
    path = tmp_path / "scaled.yaml"
    path.write_text(text, encoding="utf-8")
    wanted = shape_of(solve(EXAMPLE))
    check_same(shape_of(solve(path)), wanted, 1e-9, 1e-6)
    path.write_text(text.replace("15000 N", "15001 N"), encoding="utf-8")
    with pytest.raises(AssertionError):
        check_same(shape_of(solve(path)), wanted, 1e-9, 1e-6)


@pytest.mark.parametrize("name", MOVED)
def test_both_methods_find_the_same_form(name: str) -> None:
    """Within the dead bands: 5 N and 20 N of 15 kN, 0.01 mm of height."""
    direct, dynamic = (solved(name, method)[1].droppers for method in ("direct", "dynamic"))
    np.testing.assert_allclose(dynamic.length, direct.length, atol=1.5e-3)
    np.testing.assert_allclose(dynamic.force_bottom, direct.force_bottom, atol=0.15)
    assert not np.allclose(dynamic.length, direct.length, atol=1e-6)
