"""Verdicts: what passes, what fails when something is wrong, and what is not judged."""

from __future__ import annotations

import csv
import io
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from catenaria.line.load_case import LoadCases
from catenaria.report.checks import Check, Rules, judge, load_rules, write_checks
from catenaria.results import FormResult
from catenaria.workflow import elasticity, under_loads

RULES = load_rules()
AT_200 = 200 / 3.6


def checked(result: FormResult, name: str, speed: float | None = AT_200) -> Check:
    return next(check for check in judge(result, RULES, speed) if check.name == name)


def test_the_papers_line(paper: FormResult) -> None:
    verdicts = {check.name: check.verdict for check in judge(paper, RULES, AT_200)}
    assert verdicts["gradient of the contact wire"] == "passes"
    assert verdicts["change of gradient"] == "not judged"  # two supports hold the contact wire
    assert verdicts["radial pull of steady arms"] == "not judged"
    assert verdicts["speed by wave speed"] == "passes"
    assert verdicts["non-uniformity of elasticity"] == "not judged"
    assert "fails" not in verdicts.values()


def test_wave_speed_by_hand(paper: FormResult) -> None:
    # 15 kN and 7,710 kg/m^3 x 120 mm^2 = 0.9252 kg/m: 127.33 m/s, of which 320 km/h are 69.8 %
    check = checked(paper, "speed by wave speed", 320 / 3.6)
    assert check.value == pytest.approx(100 * (320 / 3.6) / 127.33, abs=0.01)
    assert check.verdict == "passes"
    assert checked(paper, "speed by wave speed", 325 / 3.6).verdict == "fails"


def test_wear_makes_waves_faster(paper: FormResult) -> None:
    worn = replace(
        paper, inputs=paper.inputs | {"contact_wire": paper.inputs["contact_wire"] | {"wear": 0.19}}
    )
    new, old = (checked(one, "speed by wave speed").value for one in (worn, paper))
    assert new is not None
    assert old is not None
    assert new == pytest.approx(0.9 * old)


def test_without_speed_limits_by_speed_are_not_judged(paper: FormResult) -> None:
    for name in ("gradient of the contact wire", "shortest dropper", "speed by wave speed"):
        check = checked(paper, name, None)
        assert check.verdict == "not judged"
        assert "--speed" in check.why


def test_the_speed_of_the_line_file_counts(paper: FormResult) -> None:
    fast = replace(paper, inputs=paper.inputs | {"speed": 100.0})
    assert checked(fast, "speed by wave speed", None).verdict == "fails"
    assert checked(fast, "speed by wave speed", 50.0).verdict == "passes"  # what is asked for goes first


def test_gradient_and_change_by_hand(curve: FormResult) -> None:
    supports = curve.supports
    height = supports.height.copy()
    held = [i for i, wire in enumerate(supports.wire) if wire == "contact wire"]
    third = held[2]
    height[third] += 0.11  # on bays of 50 m: 2.2 per mille up, then down
    raised = replace(curve, supports=replace(supports, height=height))
    gradient, change = (
        checked(raised, name) for name in ("gradient of the contact wire", "change of gradient")
    )
    assert gradient.value == pytest.approx(2.2)
    assert (gradient.limit, gradient.verdict, gradient.place) == (pytest.approx(2.0), "fails", "S2 to S3")
    assert change.value == pytest.approx(4.4)
    assert (change.verdict, change.place) == ("fails", "S3")
    assert checked(raised, "gradient of the contact wire", 160 / 3.6).verdict == "passes"


def test_a_limit_of_zero_can_be_kept(curve: FormResult) -> None:
    assert checked(curve, "gradient of the contact wire", 300 / 3.6).verdict == "passes"


def test_a_weak_arm_fails(curve: FormResult) -> None:
    radial = curve.arms.radial.copy()
    radial[3] = 79.0
    weak = replace(curve, arms=replace(curve.arms, radial=radial))
    check = checked(weak, "radial pull of steady arms")
    assert (check.value, check.limit, check.verdict) == (79.0, 80.0, "fails")
    assert check.place == curve.arms.support[3]
    assert checked(curve, "radial pull of steady arms").verdict == "passes"


def test_a_higher_pull_of_the_line_file_counts(curve: FormResult) -> None:
    strict = replace(curve, arms=replace(curve.arms, minimum_radial=np.full(curve.arms.radial.size, 1e4)))
    check = checked(strict, "radial pull of steady arms")
    assert (check.limit, check.verdict) == (1e4, "fails")
    assert "line file" in check.why


@pytest.mark.parametrize(
    ("name", "field", "value"),
    [
        ("shortest dropper", "length", 0.4999),
        ("slack droppers", "force_bottom", 0.0),
        ("heights at droppers", "height_error", -0.0051),
    ],
)
def test_one_bad_dropper_fails(curve: FormResult, name: str, field: str, value: float) -> None:
    values = getattr(curve.droppers, field).copy()
    values[10] = value
    bad = replace(curve, droppers=replace(curve.droppers, **{field: values}))
    assert checked(curve, name).verdict == "passes"
    check = checked(bad, name)
    assert check.verdict == "fails"
    assert check.place == f"span {curve.droppers.span[10]}, dropper {curve.droppers.number[10]}"


def test_spacing_is_that_within_a_span(paper: FormResult) -> None:
    check = checked(paper, "dropper spacing")
    assert check.value == pytest.approx(9.5)  # 8 m across supports, 9.5 m within spans
    x = paper.droppers.x.copy()
    x[3] += 2.0
    wide = replace(paper, droppers=replace(paper.droppers, x=x))
    assert (checked(wide, "dropper spacing").value, checked(wide, "dropper spacing").verdict) == (
        pytest.approx(11.5),
        "fails",
    )


def test_lateral_position_between_supports(curve: FormResult) -> None:
    contact = curve.wires[0]
    lateral = contact.profile.lateral.copy()
    i = int(np.searchsorted(contact.profile.chainage, 175.0))
    lateral[i] = -0.41
    blown = replace(contact, profile=replace(contact.profile, lateral=lateral))
    check = checked(replace(curve, wires=(blown, *curve.wires[1:])), "lateral position of the contact wire")
    assert (check.value, check.verdict) == (pytest.approx(410.0), "fails")
    assert float(check.place.removesuffix(" m")) == pytest.approx(175.0, abs=1.0)
    assert checked(curve, "lateral position of the contact wire").verdict == "passes"


@pytest.mark.parametrize(
    "name",
    [
        "bridge",
        "compound",
        "curve_800m",
        "overlap",
        "simple_55m",
        "simple_60m",
        "stitched_re250",
        "two_contact_wires_3kv",
    ],
)
def test_examples_pass_at_the_speed_they_give(solved: Callable[[str], FormResult], name: str) -> None:
    checks = judge(solved(name), RULES)
    assert [check.name for check in checks if check.verdict == "fails"] == []
    judged = {check.name for check in checks if check.verdict == "passes"}
    assert {"speed by wave speed", "gradient of the contact wire", "shortest dropper"} <= judged
    too_fast = judge(solved(name), RULES, 350 / 3.6)
    assert "fails" in {check.verdict for check in too_fast}


def test_gradients_between_droppers_by_hand(solved: Callable[[str], FormResult]) -> None:
    line = solved("simple_55m")
    # parabola of 55 mm over 46 m: 55 mm (1 - (1 - 5.75/23)^2) = 24.06 mm on the first 5.75 m, 4.18 per mille
    gradient = checked(line, "gradient between droppers")
    assert gradient.value == pytest.approx(1e3 * 0.055 * (1 - 0.75**2) / 5.75, abs=1e-3)
    change = checked(line, "change of gradient at droppers")  # from level across the support to the pre-sag
    assert change.value == pytest.approx(gradient.value, abs=1e-3)
    assert (gradient.verdict, change.verdict) == ("not judged", "not judged")


def test_gradients_between_droppers_have_limits_if_wanted(curve: FormResult) -> None:
    given = {"gradient_at_droppers": {"id": "ours", "limit": 1e-3}}
    rules = Rules.model_validate({"format": 1, **given})
    height = curve.droppers.height.copy()
    level = judge(curve, rules)[0]
    height[10] += 0.02  # on 7.5 m: 2.7 per mille
    bumpy = replace(curve, droppers=replace(curve.droppers, height=height))
    assert (level.name, level.verdict) == ("gradient between droppers", "passes")
    assert judge(bumpy, rules)[0].verdict == "fails"
    assert judge(bumpy, rules)[0].value == pytest.approx(1e3 * 0.02 / 7.5, rel=1e-3)


def test_hangers_are_not_droppers(solved: Callable[[str], FormResult]) -> None:
    line = solved("compound")
    hung = np.array([name == "auxiliary messenger" for name in line.droppers.upper_wire])
    dropper, hanger = checked(line, "shortest dropper"), checked(line, "shortest hanger")
    assert dropper.value == pytest.approx(line.droppers.length[~hung].min())
    assert hanger.value == pytest.approx(line.droppers.length[hung].min())
    assert line.droppers.length[hung].max() < 0.5 < line.droppers.length[~hung].min()
    assert hanger.place.startswith("span 2, hanger ")
    assert (hanger.verdict, dropper.verdict) == ("not judged", "passes")


def test_waves_of_the_line_go_by_mean_tensions(solved: Callable[[str], FormResult]) -> None:
    line = solved("stitched_re250")  # stitch wires take 2.8 kN off the messenger beside supports
    whole = next(check for check in judge(line, RULES) if check.place == "whole line")
    # 15,000 N + 14,260 N on 1.067 kg/m + 0.596 kg/m
    assert whole.value == pytest.approx(3.6 * np.sqrt(29_260 / 1.663), rel=1e-4)
    assert line.wires[1].tension_min < 12_500


def test_the_place_of_the_largest_offset_is_a_support(curve: FormResult, paper: FormResult) -> None:
    assert checked(curve, "lateral position of the contact wire").place == "S6"
    assert checked(paper, "lateral position of the contact wire").place == "everywhere"


def test_lifted_spans_do_not_count_for_elasticity(solved: Callable[[str], FormResult]) -> None:
    line = solved("overlap")
    check = next(c for c in judge(line, RULES, elasticity=elasticity(line)) if c.name.startswith("non-unif"))
    assert check.value == pytest.approx(51.45, abs=0.01)
    assert "from S3 to S19" in check.why


def test_all_inner_spans_count_elsewhere(paper: FormResult) -> None:
    study = elasticity(paper, spacing=10.0)
    check = next(c for c in judge(paper, RULES, elasticity=study) if c.name.startswith("non-uniformity"))
    assert check.value == pytest.approx(100 * study.nonuniformity)
    assert "from S" not in check.why


def test_other_methods_have_no_elasticity(
    solved: Callable[[str, str], FormResult], paper: FormResult
) -> None:
    strings = solved("yang2017_three_span", "force density")
    assert checked(strings, "non-uniformity of elasticity").why.startswith("results of this method have no")
    assert "catenaria elasticity" in checked(paper, "non-uniformity of elasticity").why


def test_wind_takes_the_contact_wire_aside(curve: FormResult) -> None:
    speeds = {"calm": 5.0, "storm": 40.0}
    cases = {name: {"wind": {"speed": speed}} for name, speed in speeds.items()}
    loads = under_loads(curve, LoadCases.model_validate({"format": 1, "cases": cases}))
    check = next(c for c in judge(curve, RULES, loads=loads) if c.name == "lateral position under load cases")
    wire = loads.cases[1].state.wires[0]
    inside = (wire.chainage >= 0.0) & (wire.chainage <= 902.0)
    assert check.value == pytest.approx(1e3 * np.abs(wire.lateral[inside]).max())
    assert check.place.startswith("storm: ")
    assert check.verdict == ("passes" if np.abs(wire.lateral[inside]).max() <= 0.4 else "fails")
    assert not any("load cases" in c.name for c in judge(curve, RULES))


def test_lifted_ends_are_not_in_use(solved: Callable[[str], FormResult]) -> None:
    check = checked(solved("overlap"), "gradient of the contact wire")
    assert check.verdict == "passes"
    assert "from S3 to S19" in check.why


def test_rows_are_written_whole(paper: FormResult, tmp_path: Path) -> None:
    checks = judge(paper, RULES, AT_200)
    file = write_checks(checks, tmp_path / "new" / "checks.csv")
    rows = list(csv.DictReader(io.StringIO(file.read_text(encoding="utf-8"))))
    assert len(rows) == len(checks)
    assert rows[0]["rule"] == "EN 50119:2001, Table 8"
    assert {row["verdict"] for row in rows} == {"passes", "not judged"}
    assert [path.name for path in file.parent.iterdir()] == ["checks.csv"]
