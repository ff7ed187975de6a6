"""Tables read back from solved lines in space: balance of forces, closed forms of arms, curves and ties."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from catenaria.discretise.spatial.lay_out import lay_out
from catenaria.discretise.spatial.model import SpatialModel
from catenaria.discretise.spatial.natural import Natural
from catenaria.discretise.spatial.read_back import Found, read_back
from catenaria.formfinding.spatial.at_rest import find_line_at_rest
from catenaria.line import Line, load_line
from catenaria.results.form import Arms

FloatArray = NDArray[np.float64]

EXAMPLE = Path(__file__).parents[3] / "examples" / "yang2017_three_span.yaml"
SPAN, STAGGER, T, G = 55.0, 0.2, 15_000.0, 9.8
STITCH = 2_000.0
CLAMPS = {"clamp_mass_top": 0.1, "clamp_mass_bottom": 0.2, "clamp_height_top": 0.03}


@dataclass(frozen=True)
class Solved:
    """A line, its model at rest, and what is read back."""

    line: Line
    model: SpatialModel
    z: FloatArray
    found: Found

    @property
    def unstressed(self) -> dict[str, float]:
        """Unstressed lengths of all wires, end to end [m]."""
        lengths = (self.model.natural_length(self.z, k) for k in range(len(self.model.wires)))
        return dict(zip((wire.name for wire in self.model.layout.wires), lengths, strict=True))


def describe(spans: int, **more: Any) -> dict[str, Any]:
    """Describe a straight line with steady arms; the messenger is staggered like the contact wire."""
    paper = load_line(EXAMPLE).model_dump(mode="json", exclude_none=True)
    arm = {"length": 1.2, "mass": 1.5, "minimum_pull": 80.0}
    supports = [
        {
            "stagger": STAGGER * (-1) ** i,
            "contact_wire": {"height": 5.3, "kind": "steady arm", "arm": arm},
            "messenger_wire": {"encumbrance": 1.6},
        }
        for i in range(spans + 1)
    ]
    wires = {name: {**paper[name], "tail": 20.0} for name in ("contact_wire", "messenger_wire")}
    droppers = {"droppers": {"positions": [5, 14, 23, 32, 41, 50]}}
    return {
        "format": paper["format"],
        "gravity": G,
        "conductors": paper["conductors"],
        "dropper": {**paper["dropper"], **CLAMPS},
        "supports": supports,
        "spans": [{"length": SPAN, **droppers} for _ in range(spans)],
        **wires,
        **more,
    }


def solve(description: dict[str, Any]) -> Solved:
    line = Line.model_validate(description)
    rest = find_line_at_rest(lay_out(line))
    return Solved(line, rest.model, rest.z, read_back(line, rest.model, rest.z))


@pytest.fixture(scope="module")
def straight() -> Solved:
    return solve(describe(4))


@pytest.fixture(scope="module")
def inclined() -> Solved:
    """The messenger over the middle of the track, a point mass, and a flexible cantilever."""
    mass = {"name": "M", "wire": "contact wire", "chainage": 80.5, "mass": 4.0}
    description = describe(4, point_masses=[mass])
    for support in description["supports"]:
        support["messenger_stagger"] = 0.0
    beam = {"youngs_modulus": 2.1e11, "area": 1e-3, "bending_stiffness": 2e5, "mass_per_length": 8.0}
    held = description["supports"][2]["messenger_wire"]
    held |= {"kind": "cantilever", "cantilever": {"length": 2.5, "side": "left", **beam}}
    return solve(description)


@pytest.fixture(scope="module")
def stitched() -> Solved:
    description = describe(4, stitch_wire={"conductor": "dropper", "tension": STITCH, "length": 16.0})
    for span in description["spans"]:
        span["droppers"] = {"positions": [3.5, 14, 23, 32, 41, 51.5]}
    return solve(description)


@pytest.fixture(scope="module")
def curved() -> Solved:
    """An arc of 800 m radius to the left from before the first to behind the last anchor."""
    curve = {"start": -40.0, "length": 300.0, "radius": 800.0}
    description = describe(4, track={"curves": [curve]})
    for support in description["supports"]:
        support["stagger"] = -STAGGER
        support["contact_wire"]["arm"] = {"length": 1.2, "mass": 1.5, "side": "right"}
    return solve(description)


def weight(solved: Solved) -> float:
    """Return the weight of everything that hangs in the supports [N]."""
    section = {wire.name: wire.section for wire in solved.model.layout.wires}
    wires = sum(section[name].rhoA * length for name, length in solved.unstressed.items())
    droppers, kind = solved.found.droppers, solved.line.dropper
    rod = solved.model.layout.droppers.rhoA @ droppers.length
    clamps = droppers.x.size * (kind.clamp_mass_top + kind.clamp_mass_bottom)
    return G * (wires + rod + clamps + solved.found.masses.mass.sum())


def unbalanced(solved: Solved) -> FloatArray:
    """Return by how much the forces on supports, devices and terminations differ from all weights [N]."""
    supports = solved.found.supports
    own = [wire for wire in solved.found.wires if wire.role in ("contact wire", "messenger wire")]
    held = np.column_stack((supports.force_x, supports.force_y, supports.force_z)).sum(axis=0)
    ends = np.sum([wire.end_force.sum(axis=0) for wire in own], axis=0)
    return held + ends + np.array([0.0, 0.0, weight(solved)])


@pytest.mark.parametrize("name", ["straight", "inclined", "stitched", "curved"])
def test_supports_and_ends_bear_all_weights(name: str, request: pytest.FixtureRequest) -> None:
    solved: Solved = request.getfixturevalue(name)
    np.testing.assert_allclose(unbalanced(solved), 0.0, atol=1e-3)
    heavier = replace(solved.found.masses, mass=np.append(solved.found.masses.mass, 0.01))
    other = replace(solved, found=replace(solved.found, masses=heavier))
    assert abs(unbalanced(other)[2]) > 0.09


def test_a_dropper_is_a_straight_bar_in_balance(inclined: Solved) -> None:
    droppers, kind = inclined.found.droppers, inclined.line.dropper
    reach = droppers.position_top - droppers.position_bottom
    np.testing.assert_allclose(np.linalg.norm(reach, axis=1), droppers.length, rtol=1e-14)
    np.testing.assert_allclose(reach[:, 0], 0.0, atol=1e-9)  # guided
    both = droppers.on_contact + droppers.on_messenger
    rhoA = inclined.model.layout.droppers.rhoA
    clamps = kind.clamp_mass_top + kind.clamp_mass_bottom
    np.testing.assert_allclose(both[:, 2], -G * (rhoA * droppers.length + clamps), rtol=1e-9)
    np.testing.assert_allclose(both[:, :2], 0.0, atol=1e-9)
    inner = droppers.on_contact.copy()
    inner[:, 2] += G * (0.5 * rhoA * droppers.length + kind.clamp_mass_bottom)
    np.testing.assert_allclose(np.cross(inner, reach), 0.0, atol=1e-9)
    force = np.linalg.norm(inner, axis=1)
    EA = 1.0 / inclined.model.layout.droppers.flexibility
    strain = 0.5 * ((droppers.length / droppers.unstressed_length) ** 2 - 1.0)
    np.testing.assert_allclose(EA * strain * droppers.length / droppers.unstressed_length, force, rtol=1e-6)
    np.testing.assert_allclose(droppers.unstressed_length - droppers.cut_length, 0.03, atol=1e-12)


def test_droppers_lean_by_their_staggers(straight: Solved, inclined: Solved) -> None:
    for solved in (straight, inclined):
        droppers = solved.found.droppers
        across = droppers.stagger_top - droppers.stagger_bottom
        lean = np.arctan2(np.abs(across), droppers.messenger_height - droppers.height)
        np.testing.assert_allclose(droppers.inclination, lean, atol=1e-12)
        assert not droppers.slack.any()
    assert np.degrees(straight.found.droppers.inclination).max() < 0.5
    assert np.degrees(inclined.found.droppers.inclination).max() > 5.0


def test_wanted_heights_and_tensions_are_met(inclined: Solved) -> None:
    found, controls = inclined.found, inclined.found.controls
    np.testing.assert_allclose(found.droppers.height, 5.3, atol=1e-8)
    assert [wire.tension for wire in found.wires] == pytest.approx([T, T], abs=1e-3)
    assert controls.name[:3] == ("contact wire tension", "messenger wire tension", "height at dropper 1")
    assert controls.unit == ("N", "N", *("m",) * 24)
    np.testing.assert_array_equal(controls.parameter[2:], found.droppers.unstressed_length)
    np.testing.assert_array_equal(controls.target, [T, T, *(5.3,) * 24])
    np.testing.assert_allclose(controls.value - controls.target, controls.error, atol=1e-9)
    assert not controls.dead_band.any()
    bands = read_back(inclined.line, inclined.model, inclined.z, (5.0, 20.0, 1e-5)).controls.dead_band
    np.testing.assert_array_equal(bands, [5.0, 20.0, *(1e-5,) * 24])


def torque(arms: Arms, force: FloatArray) -> FloatArray:
    """Return the moment about the hinge of the wire's force and of the arm's weight, in its middle [N m]."""
    reach = arms.tip - arms.hinge
    return np.cross(reach, force) + np.cross(0.5 * reach, np.array([0.0, 0.0, -1.5 * G]))


def forces_on_arms(solved: Solved) -> FloatArray:
    supports = solved.found.supports
    arm = np.array([kind == "arm" for kind in supports.kind])
    return np.column_stack((supports.force_x, supports.force_y, supports.force_z))[arm]


@pytest.mark.parametrize("name", ["straight", "curved"])
def test_arms_are_in_balance_about_their_hinges(name: str, request: pytest.FixtureRequest) -> None:
    solved: Solved = request.getfixturevalue(name)
    arms, force = solved.found.arms, forces_on_arms(solved)
    np.testing.assert_allclose(np.linalg.norm(arms.tip - arms.hinge, axis=1), 1.2, rtol=1e-12)
    np.testing.assert_allclose(torque(arms, force), 0.0, atol=1e-6)
    turned = replace(arms, hinge=arms.hinge + np.array([0.0, 0.0, 1e-3]))
    assert np.abs(torque(turned, force)).max() > 0.1
    np.testing.assert_allclose(arms.vertical, -force[:, 2])
    upwards = arms.vertical + 0.5 * 1.5 * G
    np.testing.assert_allclose(np.hypot(arms.radial, upwards), arms.axial, rtol=1e-9)
    np.testing.assert_allclose(np.sin(arms.angle) * 1.2, arms.tip[:, 2] - arms.hinge[:, 2], atol=1e-12)


def test_arms_pull_with_what_the_stagger_turns_the_wire_by(straight: Solved) -> None:
    """T (4 b/L) where the wire turns by 2 b/L on either side, hinges on the side of the stagger."""
    arms = straight.found.arms
    assert arms.support == ("S1", "S2", "S3", "S4", "S5")
    assert arms.registration == ("pull-off",) * 5
    np.testing.assert_allclose(arms.radial[1:4], T * 4.0 * STAGGER / SPAN, rtol=1e-2)
    assert np.all(arms.enough)
    np.testing.assert_array_equal(arms.minimum_radial, 80.0)
    side = np.sign(arms.hinge_stagger - STAGGER * (-1.0) ** np.arange(5))
    np.testing.assert_array_equal(side, [1.0, -1.0, 1.0, -1.0, 1.0])


def test_arms_at_the_outside_of_a_curve_pull_outwards(curved: Solved) -> None:
    """T L/R, where the wire turns with the track; hinges are to the right, the outside."""
    arms = curved.found.arms
    np.testing.assert_allclose(arms.radial[1:4], T * SPAN / 800.0, rtol=5e-3)
    assert np.all(arms.hinge_stagger < -1.0)
    np.testing.assert_array_equal(arms.minimum_radial, 0.0)


def test_an_arm_of_the_other_side_is_pushed(straight: Solved) -> None:
    """Negative control: the same forces with hinges on the other side are compression."""
    holds = straight.model.layout.holds
    other = replace(straight.model.layout, holds=replace(holds, side=-holds.side))
    arms = read_back(straight.line, replace(straight.model, layout=other), straight.z).arms
    assert np.all(arms.radial < 0.0)
    assert np.all(arms.axial < 0.0)
    assert not arms.enough.any()


def test_supports_tell_what_holds_a_wire_and_where(curved: Solved) -> None:
    supports = curved.found.supports
    assert supports.kind == ("arm",) * 5 + ("sliding",) * 5
    assert supports.wire == ("contact wire",) * 5 + ("messenger wire",) * 5
    np.testing.assert_allclose(supports.chainage, np.tile(SPAN * np.arange(5), 2))
    np.testing.assert_allclose(supports.stagger, -STAGGER, atol=1e-9)
    np.testing.assert_allclose(supports.height, np.repeat([5.3, 6.9], 5), atol=1e-9)
    angle = supports.chainage / 800.0
    lateral = -np.sin(angle) * supports.force_x + np.cos(angle) * supports.force_y
    np.testing.assert_allclose(supports.force_lateral, lateral, atol=1e-6)
    np.testing.assert_allclose(supports.tension[5:], T, rtol=2e-2)


def test_profiles_in_the_frame_of_a_circular_track(curved: Solved) -> None:
    """About the centre (0, R): chainage is the angle times R, offset to the left R minus the distance."""
    for wire in curved.found.wires:
        shape, R = wire.profile, 800.0
        angle = np.arctan2(shape.x, R - shape.y)
        np.testing.assert_allclose(shape.chainage, R * angle, atol=1e-9)
        np.testing.assert_allclose(shape.lateral, R - np.hypot(shape.x, R - shape.y), atol=1e-9)
        np.testing.assert_allclose(shape.height, shape.z, atol=1e-12)
        assert np.abs(shape.chainage - shape.x).max() > 0.5
        np.testing.assert_allclose(shape.horizontal, T, rtol=1e-2)


def test_ends_of_stitch_wires_bear_their_tension(stitched: Solved) -> None:
    ties, wires = stitched.found.ties, stitched.found.wires[2:]
    assert [wire.role for wire in wires] == ["stitch wire"] * 3
    assert ties.host == ("messenger wire",) * 6
    np.testing.assert_array_equal(ties.end, [0, 1] * 3)
    np.testing.assert_allclose(np.linalg.norm(ties.force[1::2], axis=1), STITCH, atol=1e-3)
    for k, wire in enumerate(wires):
        np.testing.assert_array_equal(wire.end_force, ties.force[2 * k : 2 * k + 2])
        assert wire.tension == pytest.approx(STITCH, abs=1e-3)
        assert wire.unstressed_length == pytest.approx(stitched.unstressed[wire.name])
        assert wire.unstressed_length < wire.stretched_length
        assert ties.force[2 * k, 0] > 1900.0 > -1900.0 > ties.force[2 * k + 1, 0]


def jumps_of_tension(solved: Solved) -> Iterator[float]:
    """Yield what the messenger loses of its tension along the track at the start of each stitch wire [N]."""
    shape, ties = solved.found.wires[1].profile, solved.found.ties
    for s in ties.coordinate[ties.end == 0].tolist():
        before, after = np.interp([s - 1.5, s + 1.5], shape.s, shape.horizontal)
        yield float(before - after)


def test_the_messenger_loses_what_a_stitch_wire_takes(stitched: Solved) -> None:
    taken = stitched.found.ties.force[stitched.found.ties.end == 0, 0]
    np.testing.assert_allclose(list(jumps_of_tension(stitched)), taken, rtol=2e-3)


def test_a_piece_is_told_by_its_natural_length(stitched: Solved) -> None:
    """The same curve by other coordinates: nothing moves, slopes shrink, and clamps shift in proportion."""
    model, z = stitched.model, stitched.z.copy()
    z[model.piece[2]] += 0.08
    state = Natural(model, z)
    factor = state.stretch[2]
    assert factor == pytest.approx((model.wires[2].knots[-1] + z[model.piece[2]]) / model.wires[2].knots[-1])
    assert factor > 1.004
    assert state.wires[2].knots[-1] == pytest.approx(model.natural_length(z, 2))
    s = np.linspace(0.0, model.wires[2].knots[-1], 40)
    by_mesh, natural = model.wires[2].evaluate(z, s), state.wires[2].evaluate(state.z, factor * s)
    np.testing.assert_allclose(natural.r, by_mesh.r, atol=1e-12)
    np.testing.assert_allclose(natural.r1 * factor, by_mesh.r1, atol=1e-12)
    on = model.upper_s[model.layout.droppers.upper == 2]
    np.testing.assert_allclose(state.z[on], factor * z[on])
    untied = model.wires[1].nodes
    np.testing.assert_array_equal(state.z[untied], z[untied])


def test_a_stage_holds_natural_coordinates(stitched: Solved) -> None:
    """The tension of a stitch wire follows from the stage alone; a slope that is 0.1 % off is noticed."""
    stage = stitched.found.stage
    assert stage.step == "line"
    assert stage.chain[:3] == ("contact wire", "messenger wire", "stitch wire S2")
    first = np.concatenate(([0], np.cumsum(stage.node_count)))
    assert first[-1] == stage.s.size == stage.position.shape[0] == stage.slope.shape[0]
    own = slice(first[2], first[3])
    assert stage.s[own][-1] == pytest.approx(stitched.found.wires[2].unstressed_length)
    end = stage.slope[own][-1]
    EA = stitched.model.wires[2].section.EA
    force = 0.5 * EA * (end @ end - 1.0) * np.linalg.norm(end)
    assert force == pytest.approx(STITCH, rel=1e-3)
    longer = end * (1.0 + 1e-3)
    assert 0.5 * EA * (longer @ longer - 1.0) != pytest.approx(STITCH, rel=1e-2)
    others = stage.sliding_coordinate.size + stage.parameter.size + stage.multiplier.size
    assert others + 6 * stage.s.size == stitched.model.unknowns.size


def test_masses_and_cantilevers(inclined: Solved) -> None:
    masses, cantilevers = inclined.found.masses, inclined.found.cantilevers
    assert "M" in masses.name
    i = masses.name.index("M")
    shape = inclined.found.wires[0].profile
    assert np.interp(masses.coordinate[i], shape.s, shape.chainage) == pytest.approx(80.5, abs=1e-6)
    assert (masses.wire[i], masses.mass[i], masses.chainage[i]) == ("contact wire", 4.0, 80.5)
    assert cantilevers.support == ("S3",)
    supports = inclined.found.supports
    held = supports.kind.index("cantilever")
    tip = [supports.x[held], supports.y[held], supports.z[held]]
    np.testing.assert_allclose(cantilevers.tip[0], tip, atol=1e-9)
    np.testing.assert_allclose(cantilevers.root[0], [110.0, 2.5, 6.9], atol=1e-12)
    assert 0.0 < 6.9 - cantilevers.tip[0, 2] < 0.2
    borne = np.array([supports.force_x[held], supports.force_y[held], supports.force_z[held]])
    np.testing.assert_allclose(cantilevers.force[0], borne - [0.0, 0.0, 8.0 * 2.5 * G], atol=1e-4)
    assert inclined.found.stage.chain[-1] == "cantilever S3"


def test_wires_are_measured_between_their_supports(straight: Solved) -> None:
    contact, messenger = straight.found.wires
    assert (contact.role, messenger.role) == ("contact wire", "messenger wire")
    assert contact.stretched_length == pytest.approx(np.hypot(SPAN, 2 * STAGGER) * 4, abs=2e-3)
    section = straight.model.wires[0].section
    strain = contact.stretched_length / contact.unstressed_length - 1.0
    assert section.EA * strain == pytest.approx(contact.tension_mean, rel=2e-3)
    assert 0.3 < messenger.sag < 0.8
    assert 4e-3 < contact.sag < 7e-3  # w b^2/8T = 6.1 mm without bending
    assert contact.start_x.size == contact.start_z.size == straight.model.wires[0].knots.size
    assert (contact.start_x[0], contact.start_z[0]) == pytest.approx((-20.0, 5.3), abs=0.05)
