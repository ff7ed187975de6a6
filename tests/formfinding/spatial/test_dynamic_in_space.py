"""The dynamic equilibrium method in space against the direct method, its start, its end and its restart."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from catenaria.discretise.spatial.lay_out import lay_out
from catenaria.errors import InconsistentInputError
from catenaria.formfinding.spatial.direct import find_directly
from catenaria.formfinding.spatial.dynamic import find_by_motion
from catenaria.formfinding.spatial.motion import MovingLine, at_start
from catenaria.line import Line
from catenaria.mechanics.state import State
from catenaria.results import FormResult

Curved = Callable[..., Line]
Find = Callable[[Line], FormResult]


def check_agrees(moved: FormResult, direct: FormResult) -> None:
    """0.1 N of a tension of 12 kN are 8e-6 of a sag of 1.5 m, and 0.1 N of 2.5 kN in stitch wires as much."""
    np.testing.assert_allclose(moved.droppers.length, direct.droppers.length, rtol=0.0, atol=0.05e-3)
    np.testing.assert_allclose(
        moved.droppers.position_top, direct.droppers.position_top, rtol=0.0, atol=0.05e-3
    )
    np.testing.assert_allclose(moved.droppers.on_contact, direct.droppers.on_contact, rtol=0.0, atol=0.02)
    np.testing.assert_allclose(moved.arms.radial, direct.arms.radial, rtol=0.0, atol=0.05)


def test_motion_ends_where_the_direct_method_is(curved: Curved, find: Find, moved: FormResult) -> None:
    assert moved.method == "dynamic"
    assert moved.spatial
    check_agrees(moved, find(curved()))


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("messenger_wire.tension.force", 12.001e3),
        ("stitch_wire.tension", 2.51e3),
        ("spans.1.pre_sag", 0.0201),
    ],
)
def test_other_targets_are_noticed(
    curved: Curved, find: Find, moved: FormResult, field: str, value: float
) -> None:
    with pytest.raises(AssertionError):
        check_agrees(moved, find(curved({field: value})))


def check_settled(result: FormResult) -> None:
    controls = result.controls
    assert np.all(controls.dead_band > 0.0)
    assert np.all(np.abs(controls.error) <= 1.1 * controls.dead_band)


def test_all_errors_are_within_their_bands(curved: Curved, find: Find, moved: FormResult) -> None:
    check_settled(moved)
    assert "1.1 dead bands" in moved.stop_reason
    assert moved.controls.name == moved.histories[0].control_name
    with pytest.raises(AssertionError):
        check_settled(find(curved()))  # whose bands are zero


def check_at_rest(moving: MovingLine) -> None:
    """Without gravity, at t = 0, nothing is out of balance but the controls, and droppers bear nothing."""
    z, model = moving.model.unknowns.start, moving.model
    f = moving.system.residual(State.at_rest(z, 0.0))
    unmoved = np.ones(z.size, dtype=bool)
    unmoved[np.concatenate([control.parameter for control in moving.controls(moving.system)])] = False
    assert np.abs(f[unmoved]).max() < 1e-4  # N and m: 1e-8 of the tension
    np.testing.assert_allclose(z[model.density], 0.0, atol=1e-9)


def test_motion_begins_weightless_and_at_rest(curved: Curved, moved: FormResult) -> None:
    moving = at_start(lay_out(curved()))
    check_at_rest(moving)
    history = moved.histories[0]
    assert history.time[0] == 0.0
    assert history.kinetic[0] == 0.0
    tension = np.array(history.control_unit) == "N"
    assert np.abs(history.error[0, tension]).max() < 1e-6
    assert np.abs(history.error[0, ~tension]).max() > 0.01


def test_a_start_with_weight_is_noticed(curved: Curved) -> None:
    moving = at_start(lay_out(curved()))
    with pytest.raises(AssertionError):
        check_at_rest(MovingLine.of(moving.model, 0.0))


def test_gravity_grows_and_motion_dies_out(moved: FormResult) -> None:
    history = moved.histories[0]
    assert history.kinetic.max() > 1e-3
    assert history.kinetic[-1] < 1e-9
    assert np.abs(history.velocity[-1]).max() < 1e-6
    assert moved.counters[0].steps == history.time.size - 1


def test_motion_starts_from_an_earlier_result(curved: Curved, moved: FormResult) -> None:
    """Where everything is within its bands, nothing moves."""
    again = find_by_motion(curved(), None, moved)
    assert again.counters[0].steps <= 2
    np.testing.assert_allclose(again.droppers.length, moved.droppers.length, rtol=0.0, atol=1e-9)


def test_newtons_method_starts_from_a_motion(curved: Curved, find: Find, moved: FormResult) -> None:
    again, fresh = find_directly(curved(), None, moved), find(curved())
    assert again.counters[0].steps < fresh.counters[0].steps
    np.testing.assert_allclose(again.droppers.length, fresh.droppers.length, rtol=0.0, atol=1e-9)


def test_a_result_of_another_line_is_refused(make: Callable[..., Line], moved: FormResult) -> None:
    with pytest.raises(InconsistentInputError, match="does not fit"):
        find_by_motion(make(2), None, moved)
