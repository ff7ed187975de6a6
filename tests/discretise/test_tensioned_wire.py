"""Material points of a tensioned wire against its solved equilibrium, and the two maps against each other."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from catenaria.discretise.from_line import contact_wire_setup, messenger_wire_setup
from catenaria.discretise.tensioned_wire import TensionedWire
from catenaria.discretise.wire_setup import WireSetup
from catenaria.line import Line
from catenaria.workflow import solve


@pytest.fixture(scope="module")
def solved(variant: Callable[..., Line]) -> tuple[tuple[WireSetup, np.ndarray, np.ndarray, float], ...]:
    """Setups of both wires, their solved sliding coordinates at supports and droppers, and pulls."""
    line = variant({})
    form = solve(line)
    droppers, held = form.droppers, form.supports
    setups = contact_wire_setup(line), messenger_wire_setup(line, droppers.force_bottom, droppers.height)
    coordinates = droppers.contact_coordinate, droppers.messenger_coordinate
    return tuple(
        (
            setup,
            np.array(
                [s for s, wire in zip(held.sliding_coordinate, held.wire, strict=True) if wire == form_.name]
            ),
            s_droppers,
            form_.travel,
        )
        for setup, s_droppers, form_ in zip(setups, coordinates, form.wires, strict=True)
    )


def check(tensioned: TensionedWire, found: tuple[WireSetup, np.ndarray, np.ndarray, float]) -> None:
    setup, s_supports, s_droppers, pull = found
    np.testing.assert_allclose(tensioned.material(setup.support_x), s_supports, atol=2e-4)
    np.testing.assert_allclose(tensioned.material(setup.droppers.x), s_droppers, atol=2e-4)
    assert tensioned.pull == pytest.approx(pull, abs=2e-4)


def test_material_points_are_where_the_solution_has_them(
    solved: tuple[tuple[WireSetup, np.ndarray, np.ndarray, float], ...],
) -> None:
    for found in solved:
        check(TensionedWire.of(found[0]), found)


def test_arc_as_long_as_its_chord_is_noticed(
    solved: tuple[tuple[WireSetup, np.ndarray, np.ndarray, float], ...],
) -> None:
    """The messenger's arc is 12 mm a span longer than its chord; the contact wire's is not."""
    tensioned = TensionedWire.of(solved[1][0])
    straight = replace(tensioned, shape=replace(tensioned.shape, z=0.0 * tensioned.shape.z, w=0.0))
    with pytest.raises(AssertionError):
        check(straight, solved[1])


def test_place_inverts_material(solved: tuple[tuple[WireSetup, np.ndarray, np.ndarray, float], ...]) -> None:
    for setup, *_ in solved:
        tensioned = TensionedWire.of(setup)
        x = np.linspace(setup.support_x[0], setup.support_x[-1], 77)
        np.testing.assert_allclose(tensioned.place(tensioned.material(x)), x, atol=1e-7)


def test_ends_are_pulled_alike(solved: tuple[tuple[WireSetup, np.ndarray, np.ndarray, float], ...]) -> None:
    for setup, *_ in solved:
        tensioned = TensionedWire.of(setup)
        length = setup.support_x[-1] - setup.support_x[0] + 2.0 * setup.tail
        end = setup.support_x[-1] + setup.tail + tensioned.pull
        assert float(tensioned.place(np.array([length]))[0]) == pytest.approx(end, abs=1e-6)
