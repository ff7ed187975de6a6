"""Lines of which no first guess can be made are refused by name."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from catenaria.discretise.spatial.balance import Demands, Holding, Links, balance
from catenaria.discretise.spatial.guess import guess, weightless
from catenaria.discretise.spatial.layout import Layout
from catenaria.errors import CatenariaError, InconsistentInputError, InfeasibleError

Made = Callable[[SimpleNamespace], Layout]


def pair(drawn: SimpleNamespace, force: float = 10e3, top: float = 6.5, **parts: object) -> Layout:
    """A contact wire below a messenger wire, 60 m, with a dropper at 20 m."""
    ropes = [
        drawn.rope(((0.0, 0.0, 5.0), (60.0, 0.0, 5.0)), 10e3, name="contact wire", role="contact wire"),
        drawn.rope(((0.0, 0.0, top), (60.0, 0.0, top)), force),
    ]
    return drawn.lay(ropes, **({"hung": [drawn.dropper(0, 1, 20.0, 5.0)]} | parts))


def over_arm(drawn: SimpleNamespace, length: float) -> Layout:
    arm = drawn.hold(
        0, 30.0, 5.0, kind="arm", hinge=(30.0, 0.9, 5.4), arm_length=length, arm_mass=1.0, side=1.0
    )
    return pair(drawn, held=[arm])


def tied(drawn: SimpleNamespace, *ends: int) -> Layout:
    ropes = [
        drawn.rope(((0.0, 0.0, 7.0), (60.0, 0.0, 7.0))),
        drawn.rope(None, 2e3, name="stitch wire S2", role="stitch wire"),
    ]
    return drawn.lay(ropes, tied=[drawn.tie(1, end, 0, 20.0 + 10.0 * i) for i, end in enumerate(ends)])


def braked(drawn: SimpleNamespace, friction: float) -> Layout:
    held = [drawn.hold(1, x, 6.5, friction=friction) for x in (20.0, 40.0)]
    return pair(drawn, held=held, hung=[])


CASES: dict[str, tuple[Made, Made, type[CatenariaError], str]] = {
    "slack": (
        lambda drawn: pair(drawn, 90.0, top=30.0),
        lambda drawn: pair(drawn, 1e3, top=30.0),
        InfeasibleError,
        "the messenger wire would be steeper than 45 degrees near x = .* m under its 0.09 kN; more tension",
    ),
    "friction": (
        lambda drawn: braked(drawn, 30.0),
        lambda drawn: braked(drawn, 0.3),
        InfeasibleError,
        "the messenger wire is slack: nothing is left of its 10 kN near x = ",
    ),
    "low": (
        lambda drawn: pair(drawn, top=5.1),
        lambda drawn: pair(drawn, top=6.0),
        InfeasibleError,
        "dropper 1 in span 1 would have no length: the messenger wire hangs .* mm below the contact wire",
    ),
    "short arm": (
        lambda drawn: over_arm(drawn, 0.3),
        lambda drawn: over_arm(drawn, 1.0),
        InfeasibleError,
        "the steady arm at support 1 does not reach from its hinge to the contact wire",
    ),
    "dropper at a support": (
        lambda drawn: pair(drawn, held=[drawn.hold(0, 20.0, 5.0)]),
        lambda drawn: pair(drawn, held=[drawn.hold(0, 20.1, 5.0)]),
        InconsistentInputError,
        "dropper 1 in span 1 would hold the contact wire where a support",
    ),
    "two droppers at one place": (
        lambda drawn: pair(drawn, hung=[drawn.dropper(0, 1, 20.0, 5.0)] * 2),
        lambda drawn: pair(drawn, hung=[drawn.dropper(0, 1, x, 5.0) for x in (20.0, 20.1)]),
        InconsistentInputError,
        "dropper 1 in span 1 would hold the contact wire where a support or another dropper",
    ),
    "support at the end": (
        lambda drawn: pair(drawn, held=[drawn.hold(0, 60.0, 5.0)]),
        lambda drawn: pair(drawn, held=[drawn.hold(0, 59.0, 5.0)]),
        InconsistentInputError,
        "contact wire: two clamps, supports or ends are at the same place, near x = 60 m",
    ),
    "one end tied twice": (
        lambda drawn: tied(drawn, 0, 0),
        lambda drawn: tied(drawn, 0, 1),
        InconsistentInputError,
        "the stitch wire S2 must have each of its ends tied once",
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_is_refused_by_name(drawn: SimpleNamespace, name: str) -> None:
    bad, good, error, message = CASES[name]
    with pytest.raises(error, match=message):
        guess(bad(drawn))
    found = guess(good(drawn))
    assert all(np.isfinite(course.length) for course in found.courses)


def test_pushing_dropper_is_guessed(drawn: SimpleNamespace) -> None:
    """Whether a dropper may push is the method's business: the guess says with what force."""
    raised = pair(drawn, hung=[drawn.dropper(0, 1, 20.0, 4.5)])
    found = guess(raised)
    assert found.density[0] < 0.0
    assert np.all(weightless(raised, found).density == 0.0)


def test_guess_leaves_the_layout_as_it_is(drawn: SimpleNamespace) -> None:
    layout = over_arm(drawn, 1.0)
    before = replace(layout.holds, X=layout.holds.X.copy(), hinge=layout.holds.hinge.copy())
    weightless(layout, guess(layout))
    np.testing.assert_array_equal(layout.holds.X, before.X)
    np.testing.assert_array_equal(layout.holds.hinge, before.hinge)


def test_net_that_nothing_holds_is_refused() -> None:
    """Two knots on a string without an end can move together; one spring is enough."""
    string = Links(np.array([0]), np.array([1]), np.full(1, 200.0), np.array([[5.0, 0.0, 0.0]]))
    up, load = np.tile([0.0, 0.0, 1.0], (2, 1)), np.array([0.0, -8.0])
    with pytest.raises(InconsistentInputError, match="their forces cannot balance"):
        balance(string, up, Holding(np.zeros(2), np.zeros(2), load), Demands.none())
    move, _ = balance(string, up, Holding(np.array([100.0, 0.0]), np.zeros(2), load), Demands.none())
    np.testing.assert_allclose(move, [-0.08, -0.12])
