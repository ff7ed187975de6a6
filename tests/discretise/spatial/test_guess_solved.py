"""The first guess against solved lines: the paper's, and a tension length with all that there is."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from numpy.typing import NDArray

from catenaria.discretise.from_line import contact_wire_setup, section
from catenaria.discretise.spatial.guess import Guess, guess
from catenaria.discretise.spatial.layout import Layout
from catenaria.discretise.tensioned_wire import TensionedWire
from catenaria.formfinding.spatial.at_rest import LineAtRest, find_line_at_rest
from catenaria.line import Line
from catenaria.line.alignment import Alignment
from catenaria.mechanics.chain import Section
from catenaria.results import FormResult

FloatArray = NDArray[np.float64]


@pytest.fixture(scope="module")
def paper(drawn: SimpleNamespace, line: Line) -> Layout:
    """The paper's plane line as one in space."""
    last = line.support_x[-1]
    names = (("contact wire", 0.0, line.contact_wire), ("messenger wire", 1.5, line.messenger_wire))
    ropes = [
        drawn.rope(
            ((-0.5, 0.0, height), (last + 0.5, 0.0, height)),
            wire.tension.force,
            section(line.conductors[wire.conductor]),
            name=name,
            role=name,
        )
        for name, height, wire in names
    ]
    held = [drawn.hold(0, x, 0.0) for x in (0.0, last)] + [drawn.hold(1, x, 1.5) for x in line.support_x]
    kind = section(line.conductors[line.dropper.conductor])
    hung = [
        drawn.dropper(0, 1, x, height, 1.0 / kind.EA, kind.rhoA)
        for x, height in zip(line.dropper_x, line.dropper_target_height, strict=True)
    ]
    return drawn.lay(ropes, held, hung, g=line.gravity)


def check_paper(found: Guess, result: FormResult) -> None:
    """In the solution both ends are pulled: all material coordinates are the guess's plus those ways."""
    droppers = result.droppers
    for own, solved in (
        (found.lower_s, droppers.contact_coordinate),
        (found.upper_s, droppers.messenger_coordinate),
    ):
        np.testing.assert_allclose(own - own.mean(), solved - solved.mean(), atol=2e-5)
    np.testing.assert_allclose(found.dropper_length, droppers.unstressed_length, atol=5e-4)


def test_paper_line_is_near_its_solution(paper: Layout, result: FormResult) -> None:
    found = guess(paper)
    check_paper(found, result)
    with pytest.raises(AssertionError):
        check_paper(replace(found, lower_s=found.lower_s * 1.00001), result)
    with pytest.raises(AssertionError):
        check_paper(guess(replace(paper, g=1.01 * paper.g)), result)


def test_paper_contact_wire_is_the_plane_one(paper: Layout, line: Line) -> None:
    setup = contact_wire_setup(line)
    plane, found = TensionedWire.of(setup), guess(paper)
    moved = found.lower_s - plane.material(setup.droppers.x)
    np.testing.assert_allclose(moved, moved.mean(), atol=2e-6)
    x = np.linspace(1.0, 194.0, 500)
    r, r1 = found.courses[0].place(plane.material(x) + moved.mean())
    np.testing.assert_allclose(r[:, 0], x, atol=2e-6)
    np.testing.assert_allclose(r[:, 2], plane.shape.height(x), atol=2e-5)
    np.testing.assert_allclose(r1[:, 2] / r1[:, 0], plane.shape.slope(x), atol=2e-4)


CONTACT = Section(EA=120e-6 * 124e9, EJ=150.0, rhoA=1.07)
MESSENGER = Section(EA=65.8e-6 * 113e9, EJ=50.0, rhoA=0.59)
STITCH = Section(EA=34.4e-6 * 113e9, EJ=15.0, rhoA=0.31)
POSITIONS = (5.0, 13.0, 22.0, 31.0, 40.0, 47.0)
SPAN, SPANS, HALF = 52.0, 25, 9.0


def tension_length(drawn: SimpleNamespace, alignment: Alignment) -> Layout:
    """Twenty-five stitched spans in a canted curve, with arms, droppers from both upper wires, a mass."""
    places = [SPAN * i for i in range(SPANS + 1)]
    last, stitched = places[-1], places[1:-1]
    ropes = [
        drawn.rope(
            ((-1.0, 0.2, 5.3), (last + 1.0, 0.2, 5.3)),
            15e3,
            CONTACT,
            name="contact wire",
            role="contact wire",
        ),
        drawn.rope(((-1.0, 0.0, 7.1), (last + 1.0, 0.0, 7.1)), 15e3, MESSENGER),
        *(drawn.rope(None, 2.8e3, STITCH, name=f"stitch wire {x}", role="stitch wire") for x in stitched),
    ]
    inner = {"kind": "arm", "arm_length": 1.0, "arm_mass": 1.5, "side": 1.0}
    held = [
        drawn.hold(0, x, 5.3, lateral=0.2 if i % 2 else 0.3, **(inner if 0.0 < x < last else {}))
        for i, x in enumerate(places)
    ]
    held[0], held[-1] = (replace(held[i], lateral=0.2) for i in (0, -1))
    held += [drawn.hold(1, x, 7.1) for x in places]
    hung = []
    for i in range(SPANS):
        for at in POSITIONS:
            x = SPAN * i + at
            near = [k for k, support in enumerate(stitched) if abs(x - support) < HALF]
            upper = 2 + near[0] if near else 1
            hung.append(drawn.dropper(0, upper, x, 5.3, 8.4e-7, 0.09, 0.15, 0.2))
    tied = [
        drawn.tie(2 + k, end, 1, x + (2 * end - 1) * HALF) for k, x in enumerate(stitched) for end in (0, 1)
    ]
    return drawn.lay(ropes, held, hung, tied, [drawn.mass(0, 62.3, 4.0)], alignment=alignment)


def check_near(at_rest: LineAtRest) -> None:
    """Millimetres of material coordinates over 1.3 km, and of places; lengths to 2 mm."""
    model, start = at_rest.model, at_rest.model.unknowns.start
    off = at_rest.z - start
    for s in (model.hold_s, model.lower_s, model.upper_s, model.tie_s, model.mass_s):
        assert np.abs(off[s]).max() < 1.5e-3
    for wire in model.wires:
        assert np.abs(off[wire.nodes[:, :3]]).max() < 2e-3
    assert np.abs(off[model.length]).max() < 2e-3
    assert np.abs(off[model.tie_force]).max() < 1.0


def test_newton_converges_from_the_guess_of_a_tension_length(
    drawn: SimpleNamespace, curved: Callable[..., Alignment]
) -> None:
    layout = tension_length(drawn, curved(800.0, 0.1, 78.0))
    at_rest = find_line_at_rest(layout)
    assert at_rest.work.steps <= 6
    check_near(at_rest)
    lighter = guess(replace(layout, g=0.99 * layout.g)).courses[1]
    chain = at_rest.model.wires[1]
    moved = at_rest.z.copy()
    moved[chain.nodes[:, :3]] = lighter.place(chain.knots * lighter.length / chain.knots[-1])[0]
    with pytest.raises(AssertionError):
        check_near(replace(at_rest, z=moved))
