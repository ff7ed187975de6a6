"""The audit of lines in space: what is found passes, and whatever is changed in it is noticed and named."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from catenaria.audit import audit_result
from catenaria.errors import InconsistentInputError
from catenaria.results import FormResult
from catenaria.results.form import LINE_STEP, Stage
from catenaria.workflow import solve

Change = Callable[[Any], Any]
Alter = Callable[[FormResult, str, Change], FormResult]


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


def to(value: Any) -> Change:
    return lambda _: value


def swapped(names: tuple[str, ...]) -> tuple[str, ...]:
    return (names[1], names[0], *names[2:])


MM, CM, PERCENT = plus(1e-3), plus(1e-2), times(1.01)


@pytest.mark.parametrize("name", ["curve", "compound"])
def test_what_the_direct_method_finds_passes(name: str, request: pytest.FixtureRequest) -> None:
    audit = audit_result(request.getfixturevalue(name))
    assert audit.findings == ()
    assert np.all(audit.deviation <= audit.allowed)
    assert {"equilibrium", "lengths", "targets"} == set(audit.group)
    residual = audit.deviation[audit.name.index("residual of nodes over the largest tension")]
    assert residual < 1e-8


def test_what_the_dynamic_method_finds_passes_within_its_bands() -> None:
    result = solve(Path(__file__).with_name("every_support.yaml"), method="dynamic")
    assert audit_result(result).findings == ()
    assert not audit_result(replace(result, method="direct")).passed  # who may not stop at bands has missed


def as_line(result: FormResult) -> FormResult:
    """Return a plane result written like one in which all wires were found at once."""
    contact, messenger = result.stages
    nodes = [slice(0, int(stage.node_count[0])) for stage in (contact, messenger)]
    joined = {
        field.name: np.concatenate(
            [getattr(contact, field.name)[nodes[0]], getattr(messenger, field.name)[nodes[1]]]
        )
        for field in fields(Stage)
        if field.name in ("s", "position", "slope")
    }
    stage = replace(
        contact,
        step=LINE_STEP,
        chain=("contact wire", "messenger wire"),
        node_count=np.array([part.stop for part in nodes]),
        **joined,
    )
    force = np.flatnonzero([not name.startswith("force") for name in result.controls.name])
    keep = {
        field.name: tuple(np.array(getattr(result.controls, field.name))[force].tolist())
        if field.name in ("name", "unit")
        else getattr(result.controls, field.name)[force]
        for field in fields(result.controls)
    }
    return replace(result, stages=(stage,), controls=replace(result.controls, **keep))


def test_a_plane_line_passes_as_a_line_in_space(direct: FormResult) -> None:
    """The plane method shares no joint, no dropper and no read-back with the method in space."""
    audit = audit_result(as_line(direct))
    assert audit.findings == ()
    assert "residual of nodes over the largest tension" in audit.name


def test_a_plane_line_out_of_balance_fails_as_a_line_in_space(direct: FormResult, altered: Alter) -> None:
    wrong = altered(as_line(direct), "supports.force_z", at(3, PERCENT))
    assert any("residual" in finding for finding in audit_result(wrong).findings)


# path of what is changed, change, words of a finding that must name it
CORRUPTIONS: dict[str, tuple[str, Change, list[str]]] = {
    "dropper length": ("droppers.length", at(3, MM), ["droppers, length", "dropper 4"]),
    "unstressed dropper": ("droppers.unstressed_length", at(3, MM), ["unstressed length", "dropper 4"]),
    "cut length": ("droppers.cut_length", at(3, MM), ["length to be cut", "dropper 4"]),
    "dropper moved": ("droppers.x", at(3, MM), ["place along the track", "dropper 4"]),
    "clamp slid": ("droppers.contact_coordinate", at(3, MM), ["place along the track", "dropper 4"]),
    "lower clamp": ("droppers.position_bottom", at((3, 1), MM), ["lower clamp", "dropper 4"]),
    "upper clamp": ("droppers.position_top", at((3, 2), MM), ["upper clamp", "dropper 4"]),
    "lower stagger": ("droppers.stagger_bottom", at(3, MM), ["stagger of the lower", "dropper 4"]),
    "upper stagger": ("droppers.stagger_top", at(3, MM), ["stagger of the upper", "dropper 4"]),
    "height": ("droppers.height", at(3, MM), ["height of the lower", "dropper 4"]),
    "upper height": ("droppers.messenger_height", at(3, MM), ["height of the upper", "dropper 4"]),
    "height error": ("droppers.height_error", at(3, MM), ["stated height errors", "dropper 4"]),
    "force at the top": ("droppers.force_top", at(3, PERCENT), ["force at the top", "dropper 4"]),
    "force at the bottom": ("droppers.force_bottom", at(3, PERCENT), ["force at the bottom", "dropper 4"]),
    "force on lower wire": ("droppers.on_contact", at((3, 2), PERCENT), ["contact wire, dropper 4"]),
    "force on stitch wire": ("droppers.on_messenger", at((4, 2), PERCENT), ["stitch wire S2, dropper 5"]),
    "sideways": ("droppers.on_contact", at((3, 1), plus(0.5)), ["across the dropper", "dropper 4"]),
    "weight": ("droppers.on_messenger", at((3, 2), plus(0.5)), ["forces and weight (23)", "dropper 4"]),
    "force error": ("droppers.force_error", at(3, plus(0.1)), ["stated force error", "dropper 4"]),
    "reaction": ("supports.force_z", at(8, PERCENT), ["residual of nodes", "messenger wire, support S3"]),
    "radial reaction": ("supports.force_y", at(8, PERCENT), ["messenger wire as a whole"]),
    "spring": ("supports.force_z", at(7, PERCENT), ["place at supports", "support S2"]),
    "friction": ("inputs.supports.5.messenger_wire.friction", plus(0.01), ["along the wire", "support S6"]),
    "friction turned": ("inputs.supports.1.messenger_wire.friction", times(-1.0), ["along the wire", "S2"]),
    "bracket pulls": ("supports.force_x", at(8, plus(1.0)), ["brackets and arms along the track", "S3"]),
    "slid": ("supports.sliding_coordinate", at(8, MM), ["messenger wire, place at supports", "S3"]),
    "place": ("supports.y", at(8, MM), ["stated place at supports", "support S3"]),
    "stagger": ("supports.stagger", at(2, MM), ["stated chainage, stagger and height", "support S3"]),
    "lateral force": ("supports.force_lateral", at(2, PERCENT), ["stated lateral force", "support S3"]),
    "strain tension": ("supports.tension", at(2, PERCENT), ["strain tension (11) at supports", "S3"]),
    "arm's tip": ("arms.tip", at((2, 0), MM), ["arms, tip at the wire", "arm at S3"]),
    "arm's hinge": ("arms.hinge", at((2, 2), MM), ["across the arm", "arm at S3"]),
    "arm's length": ("arms.length", at(2, MM), ["arms, length", "arm at S3"]),
    "arm's angle": ("arms.angle", at(2, MM), ["stated angle", "arm at S3"]),
    "axial force": ("arms.axial", at(2, PERCENT), ["stated axial", "arm at S3"]),
    "radial force": ("arms.radial", at(2, PERCENT), ["stated radial force", "arm at S3"]),
    "vertical force": ("arms.vertical", at(2, PERCENT), ["stated vertical", "arm at S3"]),
    "hinge's stagger": ("arms.hinge_stagger", at(2, MM), ["stated place of the hinge", "arm at S3"]),
    "given hinge": (
        "inputs.supports.3.contact_wire.arm.hinge.height",
        MM,
        ["where it is given", "arm at S4"],
    ),
    "arm's side": ("inputs.supports.2.contact_wire.arm.side", to("left"), ["on its side", "arm at S3"]),
    "arm's mass": ("inputs.supports.2.contact_wire.arm.mass", plus(0.5), ["across the arm", "arm at S3"]),
    "pull wanted": ("inputs.supports.2.contact_wire.arm.minimum_pull", PERCENT, ["minimum", "arm at S3"]),
    "tie's force": ("ties.force", at((1, 0), PERCENT), ["action and reaction", "end of the stitch wire S2"]),
    "tie slid": ("ties.coordinate", at(1, MM), ["ends at their hosts", "end of the stitch wire S2"]),
    "tie moved": ("ties.chainage", at(1, MM), ["ties, place along the track", "end of the stitch wire S2"]),
    "mass slid": ("masses.coordinate", at(-1, MM), ["masses, place along the track", "insulator"]),
    "mass": ("masses.mass", at(-1, plus(0.1)), ["masses, mass", "insulator"]),
    "mass forgotten": ("masses.mass", at(-1, to(0.0)), ["messenger wire as a whole"]),
    "force on root": ("cantilevers.force", at((0, 2), PERCENT), ["cantilevers, balance", "root"]),
    "root": ("cantilevers.root", at((0, 0), MM), ["cantilevers, places", "stated root"]),
    "tip": ("cantilevers.tip", at((0, 0), MM), ["cantilevers, places", "stated tip"]),
    "cantilever's node": ("stages.0.position", at((-3, 2), plus(1e-4)), ["cantilever S4, nodes"]),
    "cantilever turned": ("stages.0.slope", at((-5, 2), MM), ["direction of the root"]),
    "unstressed wire": ("wires.1.unstressed_length", MM, ["messenger wire, lengths", "unstressed"]),
    "stretched wire": ("wires.1.stretched_length", MM, ["messenger wire, lengths", "stretched"]),
    "unstressed stitch wire": ("wires.2.unstressed_length", MM, ["stitch wire S2, lengths", "unstressed"]),
    "travel": ("wires.0.travel", MM, ["contact wire, place of ends", "its end"]),
    "end force": ("wires.0.end_force", at((1, 1), plus(1.0)), ["contact wire, strain times EA", "its end"]),
    "force of a stitch wire": ("wires.2.end_force", at((1, 1), plus(1.0)), ["action and reaction", "S2"]),
    "reaction at the end": ("wires.0.reaction_end", PERCENT, ["contact wire, stated forces", "reaction"]),
    "horizontal": ("wires.0.horizontal_end", PERCENT, ["contact wire, stated forces", "horizontal"]),
    "profile": ("wires.1.profile.y", at(50, MM), ["profile: ", "messenger wire"]),
    "profile, chainage": ("wires.1.profile.chainage", at(50, MM), ["profile, chainage", "messenger wire"]),
    "profile, lateral": ("wires.1.profile.lateral", at(50, MM), ["profile, lateral", "messenger wire"]),
    "profile, height": ("wires.1.profile.height", at(50, MM), ["profile, height", "messenger wire"]),
    "profile, tension": ("wires.2.profile.tension", at(50, PERCENT), ["profile, tension", "stitch wire"]),
    "profile, moment": ("wires.1.profile.moment", at(50, plus(0.1)), ["bending moment", "messenger wire"]),
    "node": ("stages.0.position", at((70, 1), plus(1e-6)), ["residual of nodes", "contact wire"]),
    "slope": ("stages.0.slope", at((70, 1), plus(1e-6)), ["residual of nodes", "contact wire"]),
    "radius": ("inputs.track.curves.0.radius", plus(1.0), ["droppers, place along the track"]),
    "transition": ("inputs.track.curves.0.transition", MM, ["droppers, place along the track"]),
    "cant": ("inputs.track.curves.0.cant", plus(1e-4), ["contact wire, place at supports"]),
    "rail spacing": ("inputs.track.rail_spacing", MM, ["contact wire, place at supports"]),
    "gradient": ("inputs.track.gradients.0.slope", plus(1e-5), ["height at droppers", "dropper 25"]),
    "wear": ("inputs.contact_wire.wear", plus(0.01), ["contact wire, strain times EA"]),
    "efficiency": ("inputs.contact_wire.tension.device.efficiency", plus(1e-3), ["tension: ", "contact"]),
    "which end": ("inputs.contact_wire.tension.pulled", to("both"), ["place of ends", "its start"]),
    "anchor": ("inputs.contact_wire.anchor_end.stagger", CM, ["contact wire, place of ends", "its end"]),
    "stagger wanted": ("inputs.supports.2.stagger", MM, ["contact wire, place at supports", "support S3"]),
    "messenger's stagger": (
        "inputs.supports.2.messenger_stagger",
        MM,
        ["messenger wire, place at supports", "support S3"],
    ),
    "stiffness": ("inputs.supports.1.messenger_wire.stiffness", PERCENT, ["place at supports", "S2"]),
    "sideways stiffness": (
        "inputs.supports.1.messenger_wire.lateral_stiffness",
        times(0.9),
        ["place at supports", "S2"],
    ),
    "cantilever's stiffness": (
        "inputs.supports.3.messenger_wire.cantilever.bending_stiffness",
        PERCENT,
        ["cantilevers, balance"],
    ),
    "cantilever's length": (
        "inputs.supports.3.messenger_wire.cantilever.length",
        MM,
        ["cantilevers, places", "cantilever S4"],
    ),
    "lift": ("inputs.supports.1.contact_wire.arm.lift", plus(1.0), ["prescribed lift", "support S2"]),
    "stitch tension": ("inputs.stitch_wire.tension", plus(1.0), ["tension: ", "stitch wire S"]),
    "stitch length": ("inputs.stitch_wire.length", MM, ["ties, place along the track"]),
    "stitch conductor": ("inputs.conductors.stitch.youngs_modulus", PERCENT, ["stitch wire S5, strain"]),
    "pre-sag": ("inputs.spans.0.pre_sag", MM, ["height at droppers", "dropper 3"]),
    "pre-sag per mille": (
        "inputs.spans.4.pre_sag_per_mille",
        plus(0.1),
        ["height at droppers", "dropper 23"],
    ),
    "point mass": ("inputs.point_masses.0.mass", plus(0.1), ["masses, mass", "insulator"]),
    "clamp": ("inputs.dropper.clamp_mass_top", plus(0.1), ["forces and weight (23)"]),
    "clamp height": ("inputs.dropper.clamp_height_top", MM, ["length to be cut"]),
    "gravity": ("inputs.gravity", times(1.0 + 1e-3), ["the line as a whole"]),
    "compression": ("droppers.on_contact", at(3, times(-1.0)), ["slack or in compression", "dropper 4"]),
    "control": ("controls.error", at(2, plus(0.1)), ["stated control errors", "stitch wire S2 tension"]),
}


@pytest.mark.parametrize(("path", "change", "words"), CORRUPTIONS.values(), ids=CORRUPTIONS)
def test_a_corruption_is_noticed_and_named(
    path: str, change: Change, words: list[str], curve: FormResult, altered: Alter
) -> None:
    findings = audit_result(altered(curve, path, change)).findings
    assert any(all(word in finding for word in words) for finding in findings), findings


COMPOUND: dict[str, tuple[str, Change, list[str]]] = {
    "spacing": ("inputs.second_contact_wire.spacing", MM, ["second contact wire, place at supports"]),
    "auxiliary height": ("inputs.spans.1.auxiliary.height.2", MM, ["height at droppers: "]),
    "auxiliary support": (
        "inputs.supports.1.auxiliary_messenger.height",
        MM,
        ["auxiliary messenger, place at supports", "support S2"],
    ),
    "reach": ("inputs.mid_point.reach", MM, ["ties, place along the track", "mid-point anchor"]),
    "clearance": ("inputs.mid_point.clearance", MM, ["ties, place along the track", "mid-point anchor"]),
    "anchor tension": ("inputs.mid_point.tension", plus(1.0), ["tension: ", "mid-point anchor"]),
    "elastic droppers": ("inputs.dropper.model", to("bar"), ["droppers, unstressed length"]),
    "which end is pulled": (
        "inputs.auxiliary_messenger.tension.pulled",
        to("end"),
        ["auxiliary messenger, place of ends"],
    ),
    "measured tension": ("wires.0.tension", plus(1.0), ["contact wire, stated forces: ", "at tension"]),
    "node of the anchor": (
        "wires.4.end_force",
        at((1, 2), plus(1.0)),
        ["mid-point anchor 1, strain times EA"],
    ),
}


@pytest.mark.parametrize(("path", "change", "words"), COMPOUND.values(), ids=COMPOUND)
def test_a_corruption_of_a_compound_line_is_noticed_and_named(
    path: str, change: Change, words: list[str], compound: FormResult, altered: Alter
) -> None:
    findings = audit_result(altered(compound, path, change)).findings
    assert any(all(word in finding for word in words) for finding in findings), findings


@pytest.mark.parametrize(
    ("path", "change"),
    [
        ("droppers.length", at(3, plus(1e-9))),
        ("supports.force_z", at(8, plus(1e-4))),
        ("arms.hinge", at((2, 2), plus(1e-9))),
        ("stages.0.position", at((70, 1), plus(1e-12))),
    ],
)
def test_what_is_far_below_the_tolerances_passes(
    path: str, change: Change, curve: FormResult, altered: Alter
) -> None:
    """The controls above fail because of their size, not because something was touched."""
    assert audit_result(altered(curve, path, change)).findings == ()


@pytest.mark.parametrize(
    ("path", "change", "words"),
    [
        ("supports.support", swapped, "supports"),
        ("supports.kind", lambda kinds: ("sliding", *kinds[1:]), "kinds of supports"),
        ("droppers.number", at(3, plus(1)), "numbers of droppers"),
        ("droppers.upper_wire", lambda names: ("stitch wire S2", *names[1:]), "upper wires of droppers"),
        ("ties.host", lambda names: ("contact wire", *names[1:]), "hosts"),
        ("masses.name", swapped, "masses"),
        ("wires.0.measure", to("strain"), "measures"),
        ("wires", lambda wires: wires[:-1], "wires"),
        ("arms.support", swapped, "steady arms"),
        ("arms.registration", lambda kinds: ("push-off", *kinds[1:]), "pull-off and push-off"),
        ("cantilevers.support", to(("S3",)), "cantilevers"),
        ("stages", lambda stages: stages * 2, "one stage"),
        ("physics", to("string"), "wires that bend"),
    ],
)
def test_a_result_of_another_line_is_refused(
    path: str, change: Change, words: str, curve: FormResult, altered: Alter
) -> None:
    with pytest.raises(InconsistentInputError, match=words):
        audit_result(altered(curve, path, change))
