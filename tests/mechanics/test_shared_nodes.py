"""Several joints of one batch may share a node: their forces add up, as their Jacobians do."""

from __future__ import annotations

import numpy as np
import pytest

from catenaria.mechanics.chain import Chain, Section
from catenaria.mechanics.contribution import Contribution
from catenaria.mechanics.joints.guided import GuidedJoints
from catenaria.mechanics.joints.held_point import HeldPoints
from catenaria.mechanics.joints.sliding import SlidingJoints
from catenaria.mechanics.state import State

WIRE = Chain(np.arange(18).reshape(3, 6), np.array([0.0, 1.0, 2.0]), Section(1.0, 1.0, 1.0))
HUB = np.array([[18, 19, 20], [18, 19, 20]])
S, LA, SIZE = np.array([21, 22]), np.arange(23, 29).reshape(2, 3), 29
ELEMENT = np.array([0, 1])

PARTS: dict[str, Contribution] = {
    "sliding": SlidingJoints(WIRE, S, LA, ELEMENT, np.zeros((2, 3)), HUB),
    "guided": GuidedJoints(WIRE, S, LA, ELEMENT, np.zeros(2), HUB),
    "held": HeldPoints(HUB, LA, np.zeros((2, 3)), np.zeros((2, 3)), np.array([-1, -1])),
}


def check_hub(part: Contribution, doubled: Contribution) -> None:
    """The force on the hub changes with the multipliers as the Jacobian of the part says."""
    z = np.random.default_rng(5).normal(size=SIZE)
    z[S] = [0.4, 1.3]
    f = np.zeros(SIZE)
    doubled.add_residual(State.at_rest(z), f)
    rows, columns = part.pattern()
    entries = part.jacobian(State.at_rest(z), 0.0, 0.0)
    of_hub = np.isin(rows, HUB)
    linear = np.zeros(SIZE)
    np.add.at(linear, rows[of_hub], entries[of_hub] * z[columns[of_hub]])
    np.testing.assert_allclose(f[HUB[0]], linear[HUB[0]], rtol=1e-13)


@pytest.mark.parametrize("part", PARTS.values(), ids=PARTS)
def test_forces_on_a_shared_node_add_up(part: Contribution) -> None:
    check_hub(part, part)


def test_a_joint_left_out_is_noticed() -> None:
    single = SlidingJoints(WIRE, S[:1], LA[:1], ELEMENT[:1], np.zeros((1, 3)), HUB[:1])
    with pytest.raises(AssertionError):
        check_hub(PARTS["sliding"], single)
