"""Elasticity against closed forms, reciprocity, symmetry, and the line with all nonlinearities."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from catenaria.catenary.pressed_wire import pressed_wire
from catenaria.discretise.spatial.loaded import Devices, with_dropper_lengths
from catenaria.errors import InconsistentInputError
from catenaria.formfinding.direct import Direct
from catenaria.line import Line, load_line
from catenaria.loading import elasticity as module
from catenaria.loading.between_nodes import between_nodes
from catenaria.loading.built_line import BuiltLine
from catenaria.loading.elasticity import Wanted, elasticity_of
from catenaria.loading.nonlinear_pushes import NonlinearPushes
from catenaria.loading.push_points import push_points, stretches
from catenaria.loading.reduced import ReducedLine, push
from catenaria.results.elasticity import ElasticityStudy

FloatArray = NDArray[np.float64]
EXAMPLES = Path(__file__).parents[2] / "examples"
Change = Callable[[dict[str, Any]], None]


def built_from(name: str, *changes: Change) -> BuiltLine:
    data = load_line(EXAMPLES / f"{name}.yaml").model_dump()
    for change in changes:
        change(data)
    line = Line.model_validate(data)
    return BuiltLine.of(line, Direct().find_form(line))


def first_spans(count: int) -> Change:
    def cut(data: dict[str, Any]) -> None:
        data["spans"], data["supports"] = data["spans"][:count], data["supports"][: count + 1]
        data["point_masses"], data["mid_point"] = [], None

    return cut


def bare_at_the_end(data: dict[str, Any]) -> None:
    """Leave the second of two spans without droppers, between supports that hold the contact wire."""
    data["spans"] = [data["spans"][0], {"length": 65.0}]
    for support in data["supports"]:
        support["contact_wire"] = data["supports"][0]["contact_wire"]


def limp(data: dict[str, Any]) -> None:
    """Make the contact wire bend at supports within 16 mm, and the mesh fit for it."""
    data["conductors"]["contact"]["bending_stiffness"] = 4.0
    data["solver"]["mesh"]["fine"] = [0.01, 0.03, 0.1, 0.3]


@pytest.fixture(scope="module")
def paper() -> BuiltLine:
    return built_from("yang2017_three_span")


@pytest.fixture(scope="module")
def study(paper: BuiltLine) -> ElasticityStudy:
    return elasticity_of(paper, Wanted(force=200.0))


@pytest.fixture(scope="module")
def bare() -> BuiltLine:
    """The paper's wires with one span without droppers, from 65 to 130 m."""
    return built_from("yang2017_three_span", first_spans(2), bare_at_the_end, limp)


def check_is_a_pressed_wire(study: ElasticityStudy, T: float, EJ: float) -> None:
    x = study.points.chainage - 65.0
    inside = (x > 8.0) & (x < 57.0)
    closed = pressed_wire(x[inside], 65.0, T, EJ)
    np.testing.assert_allclose(study.points.elasticity[inside], closed, rtol=7e-4)


def test_of_a_wire_alone_is_the_closed_form(bare: BuiltLine) -> None:
    """Which is x (L - x)/(T L) less the rounding of the kink; sag and stiff ends are what is left over."""
    study = elasticity_of(bare, Wanted(force=0.0, spacing=1.0, start=65.0, end=130.0))
    T, EJ = bare.line.contact_wire.tension.force, bare.model.wires[0].section.EJ
    check_is_a_pressed_wire(study, T, EJ)
    for wrong in ((1.005 * T, EJ), (T, 0.0)):
        with pytest.raises(AssertionError):
            check_is_a_pressed_wire(study, *wrong)


def test_a_force_on_a_wire_alone_is_nearly_linear(bare: BuiltLine) -> None:
    """The devices keep the tension: without droppers hardly anything depends on the force."""
    wanted = Wanted(force=100.0, spacing=10.0, nonlinear=True, start=65.0, end=130.0)
    pushed = elasticity_of(bare, wanted)
    check_is_a_pressed_wire(pushed, bare.line.contact_wire.tension.force, bare.model.wires[0].section.EJ)
    linear = elasticity_of(bare, replace(wanted, force=0.0, nonlinear=False)).points.elasticity
    np.testing.assert_allclose(pushed.points.elasticity[1:-1], linear[1:-1], rtol=5e-4)


def check_is_mirrored(study: ElasticityStudy, rtol: float) -> None:
    points = study.points
    np.testing.assert_allclose(points.chainage + points.chainage[::-1], points.chainage[-1], atol=1e-9)
    np.testing.assert_allclose(points.elasticity, points.elasticity[::-1], rtol=rtol, atol=1e-12)
    np.testing.assert_array_equal(points.slack, points.slack[::-1])


def test_of_a_symmetric_line_is_symmetric(study: ElasticityStudy) -> None:
    check_is_mirrored(study, 1e-3)

    def shifted(data: dict[str, Any]) -> None:
        positions = {"positions": [4.0, 15.5, 23.0, 32.5, 42.0, 51.5, 61.0]}
        data["spans"] = [{"length": 65.0, "droppers": positions}, *data["spans"][1:]]

    with pytest.raises(AssertionError):
        check_is_mirrored(elasticity_of(built_from("yang2017_three_span", shifted), Wanted(200.0)), 1e-3)


def compliance(built: BuiltLine) -> FloatArray:
    """Return how far each of some points moves when another one is pushed [m/N]."""
    reduced = ReducedLine.of(built)
    forces = push_points(built.line, reduced.model, 7.0).forces
    moved = np.column_stack([reduced.factors.solve(row) for row in forces.toarray()])
    result: FloatArray = forces @ moved
    return result


def asymmetry(G: FloatArray) -> float:
    return float(np.abs(G - G.T).max() / np.abs(G).max())


def test_linear_responses_are_reciprocal(paper: BuiltLine) -> None:
    """By Maxwell and Betti, if ends are fixed; devices keep the size of a force that turns with them."""
    fixed = replace(paper, devices=Devices((False, False), paper.devices.stiffness))
    assert asymmetry(compliance(fixed)) < 1e-6
    assert 1e-5 < asymmetry(compliance(paper)) < 1e-3

    def rough(data: dict[str, Any]) -> None:
        for support in data["supports"]:
            support["messenger_wire"]["friction"] = 0.05

    assert asymmetry(compliance(built_from("yang2017_three_span", rough))) > 1e-3


def test_the_reduced_stiffness_is_symmetric_and_definite(paper: BuiltLine) -> None:
    reduced = ReducedLine.of(paper)
    M = reduced.stiffness
    assert np.abs(M - M.T).max() < 1e-3 * np.abs(M).max()
    assert np.linalg.eigvalsh(M + M.T).min() > 0.0
    responses = reduced.respond(push_points(paper.line, reduced.model, 5.0).forces)
    np.testing.assert_allclose(responses.pull, responses.opening, atol=2e-3)
    assert np.abs(responses.pull + responses.opening).max() > 0.1


def test_the_same_droppers_are_slack_and_the_elasticity_agrees(paper: BuiltLine) -> None:
    """At 300 N, where up to three are slack, at every tenth point; the line that does not slacken is off."""
    reduced = ReducedLine.of(paper)
    points = push_points(paper.line, reduced.model, 5.0)
    responses = reduced.respond(points.forces)
    pushes = push(reduced, responses, 300.0)
    pushed = NonlinearPushes(paper, reduced, points.forces, np.zeros(points.chainage.size), pushes, 300.0)
    elasticity, slack = pushed.at(np.arange(points.chainage.size))
    assert pushes.slack.sum(axis=1).max() >= 3
    np.testing.assert_array_equal(pushes.slack, slack)
    inner = elasticity > 1e-5
    np.testing.assert_allclose(pushes.elasticity[inner], elasticity[inner], rtol=0.04)
    with pytest.raises(AssertionError):
        np.testing.assert_allclose(responses.own[inner], elasticity[inner], rtol=0.04)


def test_the_nonlinear_line_tends_to_the_linear_one(paper: BuiltLine) -> None:
    """The difference is of first order in the force."""
    linear = elasticity_of(paper, Wanted(force=0.0, spacing=13.0)).points.elasticity
    off = []
    for force in (40.0, 10.0, 2.5):
        pushed = elasticity_of(paper, Wanted(force=force, spacing=13.0, nonlinear=True)).points.elasticity
        off.append(float(np.abs(pushed - linear).max()))
    assert off[0] > 3.0 * off[1] > 9.0 * off[2]
    assert off[2] < 1e-4 * linear.max()


def test_the_limit_of_a_small_force_is_the_elasticity_under_one(paper: BuiltLine) -> None:
    limit = elasticity_of(paper, Wanted(force=0.0, spacing=2.0)).points.elasticity
    small = elasticity_of(paper, Wanted(force=1e-3, spacing=2.0)).points.elasticity
    np.testing.assert_allclose(limit, small, rtol=1e-9, atol=1e-15)
    large = elasticity_of(paper, Wanted(force=300.0, spacing=2.0)).points.elasticity
    with pytest.raises(AssertionError):
        np.testing.assert_allclose(limit, large, rtol=1e-2)


def with_a_slack_dropper(built: BuiltLine) -> BuiltLine:
    length = built.model.unknowns.start[built.model.length].copy()
    length[10] += 0.06
    return built.with_model(with_dropper_lengths(built.model, length))


def test_a_dropper_that_is_slack_at_rest_may_stay_so_or_take_hold(paper: BuiltLine) -> None:
    """One that is 60 mm too long: the limit of a small force is without it, and a push changes others."""
    slack = with_a_slack_dropper(paper)
    limit = elasticity_of(slack, Wanted(force=0.0, spacing=9.0))
    assert limit.slack_at_rest == 1
    assert (limit.points.slack == 1).all()
    tiny = elasticity_of(slack, Wanted(force=0.01, spacing=9.0, nonlinear=True))
    np.testing.assert_allclose(limit.points.elasticity, tiny.points.elasticity, rtol=1e-4, atol=1e-12)
    study = elasticity_of(slack, Wanted(force=250.0, spacing=9.0))
    assert study.compared.same_slack.all()
    assert np.abs(study.compared.error).max() < 0.04
    other = elasticity_of(paper, Wanted(force=0.0, spacing=9.0))
    assert np.abs(other.points.elasticity - limit.points.elasticity).max() > 1e-5


def mid_span(*changes: Change) -> float:
    built = built_from("yang2017_three_span", *changes)
    return float(elasticity_of(built, Wanted(force=0.0, spacing=20.0)).spans.at_middle[1])


def test_is_lower_with_more_tension_and_stiffer_droppers() -> None:
    def tighter(data: dict[str, Any]) -> None:
        data["contact_wire"]["tension"]["force"] *= 1.2

    def softer(data: dict[str, Any]) -> None:
        data["conductors"][data["dropper"]["conductor"]]["youngs_modulus"] *= 0.01

    usual = mid_span()
    assert mid_span(tighter) < 0.95 * usual
    assert mid_span(softer) > 1.001 * usual


@pytest.mark.parametrize("name", ["yang2017_three_span", "simple_60m"])
def test_the_hand_formula_is_near(name: str) -> None:
    """L/(k sum T) with k from 3.5 to 4 holds within 15 % at mid span; k = 2.5 does not."""
    study = elasticity_of(built_from(name, first_spans(3)), Wanted(force=100.0, spacing=5.0))
    low, high, wrong = (study.spans.textbook(k) for k in (4.0, 3.5, 2.5))
    e = study.spans.at_middle
    assert ((e > 0.85 * low) & (e < 1.15 * high)).all()
    assert (e < 0.85 * wrong).all()


def test_hardly_depends_on_the_mesh() -> None:
    """Elements of 2.4 m and of 0.5 m; without what elements lack, ten times more."""

    def finer(data: dict[str, Any]) -> None:
        data["solver"]["mesh"]["largest_element"] = 0.5

    off: list[FloatArray] = []
    for lacks in (1.0, 0.0):
        found: list[FloatArray] = []
        for change in ((), (finer,)):
            built = built_from("yang2017_three_span", *change)
            reduced = ReducedLine.of(built)
            points = push_points(built.line, reduced.model, 1.0, 65.0, 130.0)
            lacking = between_nodes(reduced.model, points.wires, points.s)
            found.append(reduced.respond(points.forces).own + lacks * lacking)
        off.append(np.abs(found[0] - found[1]))
    assert off[0].max() < 5e-7
    assert off[1].max() > 10.0 * off[0].max()


def test_spans_and_places(paper: BuiltLine, study: ElasticityStudy) -> None:
    points, spans = study.points, study.spans
    assert len(stretches(paper.line, paper.model)) == 3
    assert spans.inner.tolist() == [False, True, False]
    assert study.held == ("S1", "S4")
    assert study.largest == spans.largest[1]
    u = (spans.largest - spans.smallest) / (spans.largest + spans.smallest)
    np.testing.assert_allclose(spans.nonuniformity, u)
    places = dict(zip(points.chainage.round(6).tolist(), points.place, strict=True))
    assert (places[0.0], places[65.0], places[97.5]) == ("support S1", "support S2", "dropper 4, mid span")
    assert {points.span[0], points.span[-1]} == {1, 3}
    assert (np.diff(points.chainage) > 1e-6).all()
    assert np.diff(points.chainage).max() <= 0.5 + 1e-9


def twin(data: dict[str, Any]) -> None:
    data["second_contact_wire"] = {"spacing": 0.04}


def curved(data: dict[str, Any]) -> None:
    curve = {"start": 100.0, "length": 200.0, "radius": 3000.0, "transition": 40.0}
    data["track"] = {"curves": [curve]}


@pytest.mark.parametrize("changes", [(), (twin,), (curved,)], ids=["straight", "two wires", "curve"])
def test_spans_count_in_which_the_contact_wire_is_in_use(
    changes: tuple[Change, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    """At S2 the lifted wire is held: with the span behind it the non-uniformity would be 100 %."""
    built = built_from("overlap", first_spans(6), *changes)
    study = elasticity_of(built, Wanted(spacing=10.0))
    assert study.spans.inner.tolist() == [False, False, True, True, True, False]
    assert study.in_use.startswith("from S3 to S6: ")
    used = (study.points.chainage >= study.supports[2]) & (study.points.chainage <= study.supports[5])
    e = study.points.elasticity[used]
    assert (study.largest, study.smallest) == (e.max(), e.min())
    assert study.nonuniformity == pytest.approx((e.max() - e.min()) / (e.max() + e.min()))
    assert study.nonuniformity < 0.6
    monkeypatch.setattr(module, "used_contact_wires", lambda result: ())
    assert elasticity_of(built, Wanted(spacing=10.0)).nonuniformity == pytest.approx(1.0)


def test_where_the_contact_wire_is_nowhere_in_use_all_that_was_pushed_counts() -> None:
    built = built_from("overlap", first_spans(6))
    study = elasticity_of(built, Wanted(spacing=10.0, end=110.0))  # the first two spans
    assert study.spans.inner.tolist() == [False, True]
    assert study.in_use == ""
    assert study.largest == study.spans.largest[1]


def test_two_contact_wires_share_the_force() -> None:
    """Each alone would give way nearly twice as far as both together between droppers."""
    built = built_from("two_contact_wires_3kv", first_spans(3))
    study = elasticity_of(built, Wanted(force=200.0, spacing=5.0))
    low, high = study.spans.textbook(4.0), study.spans.textbook(3.5)
    assert ((study.spans.at_middle > 0.85 * low) & (study.spans.at_middle < 1.15 * high)).all()
    assert np.abs(study.compared.error).max() < 0.04


@pytest.mark.parametrize(
    ("wanted", "message"),
    [
        (Wanted(force=-1.0), "the force is -1 N"),
        (Wanted(force=0.0, nonlinear=True), "the limit of a small force is linear"),
        (Wanted(spacing=0.0), "the spacing is 0 m"),
        (Wanted(start=50.0, end=40.0), "nothing to push from 50 to 40 m"),
        (Wanted(end=300.0), "from 0 to 195 m"),
    ],
)
def test_what_makes_no_sense_is_refused(paper: BuiltLine, wanted: Wanted, message: str) -> None:
    with pytest.raises(InconsistentInputError, match=message):
        elasticity_of(paper, wanted)


def test_a_part_of_a_span_has_no_extremes_of_spans(paper: BuiltLine) -> None:
    study = elasticity_of(paper, Wanted(start=70.0, end=90.0))
    assert study.spans.span.size == 0
    assert study.largest == study.points.elasticity.max()
