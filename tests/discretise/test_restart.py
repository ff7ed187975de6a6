"""Starting from an earlier result: what is kept on another mesh, and what is refused."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from catenaria.discretise.from_line import contact_wire_setup
from catenaria.discretise.read_back import stage
from catenaria.discretise.restart import start_from, with_full_gravity
from catenaria.discretise.wire_model import WireModel, build_wire_model
from catenaria.errors import InconsistentInputError
from catenaria.line import Line
from catenaria.results import FormResult
from catenaria.results.form import Stage
from catenaria.workflow import solve

FloatArray = NDArray[np.float64]
Vary = Callable[[dict[str, Any]], Line]

SPAN = {
    "length": 65.0,
    "droppers": {"positions": (4, 13.5, 23, 32.5, 42, 51.5, 61)},
    "contact_wire_height": 0.0,
}


def model_of(line: Line) -> WireModel:
    return build_wire_model(contact_wire_setup(line))


def cubic(s: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return position and slope of a wire along a cubic that keeps its supports and droppers in place."""
    u = s / 196.0
    position = np.column_stack((s - 0.5, 0.3 * u * (1.0 - u), 0.2 * u * (1.0 - u) * (u - 0.4)))
    slope = np.column_stack((0.0 * s + 1.0, 0.3 * (1.0 - 2.0 * u), 0.2 * (-3.0 * u**2 + 2.8 * u - 0.4)))
    slope[:, 1:] /= 196.0
    return position, slope


def along_cubic(model: WireModel) -> FloatArray:
    z = model.system.unknowns.start.copy()
    position, slope = cubic(model.wire.knots)
    z[model.wire.nodes[:, :3]], z[model.wire.nodes[:, 3:]] = position, slope
    for s, x in (
        (model.support_s, model.setup.support_x),
        (model.clamp_s, model.setup.droppers.x),
    ):
        z[s] = x + 0.5
    return z


def check_cubic(model: WireModel) -> None:
    z = model.system.unknowns.start
    position, slope = cubic(model.wire.knots)
    np.testing.assert_allclose(z[model.wire.nodes[:, :3]], position, atol=1e-12)
    np.testing.assert_allclose(z[model.wire.nodes[:, 3:]], slope, atol=1e-12)


@pytest.mark.parametrize(
    "mesh",
    [
        {},
        {"solver.mesh.refine": 3},
        {"solver.mesh.fine": (0.2,), "solver.mesh.largest_element": 1.7},
        {"dropper.elements": 5},
    ],
    ids=["same", "refined", "other nodes", "other droppers"],
)
def test_a_cubic_is_kept_exactly_on_any_mesh(variant: Vary, mesh: dict[str, Any]) -> None:
    coarse = model_of(variant({"solver.mesh.largest_element": 4.0}))
    moved = start_from(model_of(variant(mesh)), stage(coarse, along_cubic(coarse)))
    check_cubic(moved)


def test_another_curve_is_noticed(variant: Vary) -> None:
    model = model_of(variant({}))
    z = along_cubic(model)
    z[model.wire.nodes[:, 2]] += 1e-6
    with pytest.raises(AssertionError):
        check_cubic(start_from(model, stage(model, z)))


def test_the_same_mesh_gives_the_same_unknowns(contact: WireModel) -> None:
    z = along_cubic(contact)
    z[contact.multipliers] = np.arange(contact.multipliers.size)
    z[contact.pull], z[contact.droppers.travel] = 0.1, 0.01 * np.arange(21)
    again = start_from(contact, stage(contact, z))
    np.testing.assert_allclose(again.system.unknowns.start, z, atol=1e-12)
    np.testing.assert_array_equal(again.system.unknowns.kind, contact.system.unknowns.kind)


def test_joints_stand_in_the_elements_of_the_new_start(contact: WireModel) -> None:
    """A system that starts elsewhere has its sliding joints there: there is nothing left to relocate."""
    z = along_cubic(contact)
    shifted = z.copy()
    shifted[contact.clamp_s] -= 5e-4  # over the node of each clamp into the element before it
    again = start_from(contact, stage(contact, shifted))
    assert contact.system.relocate(shifted) is not None
    assert again.system.relocate(shifted) is None


def test_full_gravity_from_the_start(contact: WireModel) -> None:
    assert contact.setup.gravity_ramp(0.0) == 0.0
    assert with_full_gravity(contact.setup).gravity_ramp(0.0) == 1.0
    assert with_full_gravity(contact.setup).control_ramp == contact.setup.control_ramp


def refused(model: WireModel, earlier: Stage, message: str) -> None:
    with pytest.raises(InconsistentInputError, match=message):
        start_from(model, earlier)


@pytest.fixture
def earlier(contact: WireModel) -> Stage:
    return stage(contact, along_cubic(contact))


def test_what_fits_is_not_refused(contact: WireModel, earlier: Stage) -> None:
    """Negative control of all refusals below."""
    check_cubic(start_from(contact, earlier))


def test_another_number_of_droppers_is_refused(variant: Vary, earlier: Stage) -> None:
    fewer = SPAN | {"droppers": {"positions": (4, 13.5, 32.5, 51.5, 61)}}
    model = model_of(variant({"spans": (SPAN, fewer, SPAN)}))
    refused(model, earlier, "has 21 droppers, the line has 19")


def test_another_length_is_refused(variant: Vary, earlier: Stage) -> None:
    longer = SPAN | {"length": 65.1}
    model = model_of(variant({"spans": (SPAN, SPAN, longer)}))
    refused(model, earlier, r"contact wire is 196 m long in the earlier result, 196.1 m in the line")
    refused(model_of(variant({"dropper.guessed_length": 1.6})), earlier, "dropper 1 is 1.5 m long")
    refused(model_of(variant({"contact_wire.tail": 0.6})), earlier, "contact wire is 196 m long")


def test_other_dropper_positions_are_refused(variant: Vary, earlier: Stage) -> None:
    moved = SPAN | {"droppers": {"positions": (4, 13.5, 23, 32.6, 42, 51.5, 61)}}
    refused(model_of(variant({"spans": (SPAN, moved, SPAN)})), earlier, "droppers .* up to 0.1 m")


def test_frictionless_droppers_may_be_elsewhere(variant: Vary, earlier: Stage) -> None:
    """They have slid along the wire; nothing says where they must be."""
    moved = SPAN | {"droppers": {"positions": (4, 13.5, 23, 32.6, 42, 51.5, 61)}}
    model = model_of(variant({"spans": (SPAN, moved, SPAN), "dropper.joint": "frictionless"}))
    again = start_from(model, earlier)
    np.testing.assert_array_equal(again.system.unknowns.start[model.clamp_s], earlier.sliding_coordinate[2:])


def test_another_place_along_the_track_is_refused(variant: Vary, earlier: Stage) -> None:
    refused(model_of(variant({"start_chainage": 10.0})), earlier, "supports .* up to 10 m")


@pytest.mark.parametrize("method", ["direct", "dynamic"])
def test_supports_that_hold_another_number_of_wires_are_refused(
    line: Line, variant: Vary, result: FormResult, method: str
) -> None:
    """Both ways: held where it was free before, and free where it was held."""
    held = variant({"supports": [s.model_dump() | {"contact_wire": {"height": 0.0}} for s in line.supports]})
    with pytest.raises(InconsistentInputError):
        solve(held, method=method, start=result)
    with pytest.raises(InconsistentInputError):
        solve(line, method=method, start=solve(held))


HIGHER = {"contact": (0.1, 1.5), "messenger": (0.0, 1.6)}


@pytest.fixture(params=HIGHER.values(), ids=list(HIGHER))
def higher(request: pytest.FixtureRequest, variant: Vary) -> Line:
    """The example with one of its wires 0.1 m higher."""
    low, high = request.param
    free = {"messenger_wire": {"height": high}}
    both = free | {"contact_wire": {"height": low}}
    return variant(
        {"supports": (both, free, free, both), "spans": (SPAN | {"contact_wire_height": low},) * 3}
    )


def test_other_heights_are_found_anew_by_the_direct_method(higher: Line, result: FormResult) -> None:
    again, alone = solve(higher, start=result), solve(higher)
    np.testing.assert_allclose(again.droppers.length, alone.droppers.length, atol=1e-9)
    np.testing.assert_allclose(again.droppers.height, alone.droppers.height, atol=1e-9)
    assert np.abs(alone.droppers.length - result.droppers.length).min() > 0.09


def test_other_heights_are_refused_by_the_dynamic_method(higher: Line, result: FormResult) -> None:
    """A motion cannot begin where its wire is not."""
    with pytest.raises(InconsistentInputError, match=r"0\.1 m"):
        solve(higher, method="dynamic", start=result)


@pytest.mark.parametrize("method", ["direct", "dynamic"])
def test_a_result_without_the_step_is_refused(line: Line, result: FormResult, method: str) -> None:
    with pytest.raises(InconsistentInputError, match="no step"):
        solve(line, method=method, start=replace(result, stages=result.stages[1:]))


@pytest.mark.parametrize("method", ["direct", "dynamic"])
def test_a_result_with_other_wires_is_refused(line: Line, result: FormResult, method: str) -> None:
    with pytest.raises(InconsistentInputError, match="wires are of another kind"):
        solve(line, method=method, start=replace(result, physics="string"))
