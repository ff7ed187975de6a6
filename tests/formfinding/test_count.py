"""As many targets as released parameters: too few and too many are refused by name."""

from __future__ import annotations

import numpy as np
import pytest

from catenaria.errors import InconsistentInputError, SingularError
from catenaria.formfinding.count import check_count
from catenaria.mechanics.contribution import Contribution
from catenaria.mechanics.controls.given import Given
from catenaria.mechanics.controls.measures import Height, ReactionTension
from catenaria.mechanics.controls.target import Targets
from catenaria.mechanics.system import System
from catenaria.mechanics.unknowns import Kind, UnknownsBuilder

builder = UnknownsBuilder()
NODE = builder.add(Kind.POSITION, [0.0, 0.0, 0.0])
FORCE = builder.add(Kind.MULTIPLIER, np.zeros((1, 3)))
PULL, TRAVEL = builder.add(Kind.PARAMETER, [0.0]), builder.add(Kind.PARAMETER, [0.0])
TABLE = builder.build()
NAMES = [("the pull", PULL), ("the travel", TRAVEL)]

TENSION = Targets(PULL, ReactionTension(FORCE, np.array([[1.0, 0.0, 0.0]])), np.array([1e3]))
HEIGHT = Targets(TRAVEL, Height(NODE[2:]), np.array([1.0]))


def check(*parts: Contribution) -> None:
    check_count(System(TABLE, parts), NAMES)


def test_one_target_for_each_parameter_passes() -> None:
    check(TENSION, HEIGHT)
    check(TENSION, Given(TRAVEL, np.array([0.1])))


def test_a_released_parameter_without_target_is_named() -> None:
    with pytest.raises(
        InconsistentInputError, match=r"1 prescribed values for 2 .*: the travel is released, but"
    ):
        check(TENSION)


def test_a_target_too_many_is_named_with_what_is_prescribed() -> None:
    wanted = r"3 prescribed values for 2 .*: the pull is released once, .*\(ReactionTension, Height\)"
    with pytest.raises(InconsistentInputError, match=wanted):
        check(TENSION, HEIGHT, Targets(PULL, Height(NODE[2:]), np.array([1.0])))


def test_two_targets_on_one_parameter_and_none_on_the_other_are_both_named() -> None:
    with pytest.raises(
        InconsistentInputError, match=r"the pull is released once.*; the travel is released, but"
    ):
        check(TENSION, Targets(PULL, Height(NODE[2:]), np.array([1.0])))


def test_an_equation_of_another_kind_counts() -> None:
    class Own:
        """A contribution with an equation for the travel."""

        def add_residual(self, state, f) -> None: ...

        def pattern(self):
            return TRAVEL, TRAVEL

        def jacobian(self, state, c1, c2):
            return np.ones(1)

    check(TENSION, Own())


def test_the_count_alone_does_not_call_it_singular() -> None:
    with pytest.raises(InconsistentInputError) as caught:
        check(TENSION)
    assert not isinstance(caught.value, SingularError)
