"""Files of rules: limits by speed, and what is refused."""

from __future__ import annotations

from pathlib import Path

import pytest

from catenaria.errors import LineFileError
from catenaria.report.checks import load_rules
from catenaria.report.checks.rules import Rules

# Table 8 of EN 50119:2001: speed up to [km/h], gradient and change of gradient [per mille]
TABLE_8 = [
    (10, 60, 30), (30, 40, 20), (60, 20, 10), (100, 6, 3), (120, 4, 2), (160, 3.3, 1.7), (200, 2, 1),
    (250, 1, 0.5), (300, 0, 0),
]  # fmt: skip


@pytest.mark.parametrize(("speed", "gradient", "change"), TABLE_8)
def test_table_8(speed: float, gradient: float, change: float) -> None:
    rules = load_rules()
    assert rules.gradient is not None
    assert rules.gradient_change is not None
    assert rules.gradient.at(speed / 3.6) == pytest.approx(1e-3 * gradient)
    assert rules.gradient_change.at(speed / 3.6) == pytest.approx(1e-3 * change)
    if speed <= 250:
        assert rules.gradient.at((speed + 0.1) / 3.6) != pytest.approx(1e-3 * gradient)


def test_every_rule_says_where_it_is_from() -> None:
    rules = load_rules()
    for name in set(Rules.model_fields) - {"format", "name"}:
        rule = getattr(rules, name)
        assert rule is not None, name
        assert rule.id, name
        assert rule.source, name


def test_what_was_not_read_is_marked() -> None:
    rules = load_rules()
    assert rules.wave_speed is not None
    assert rules.wave_speed.status == "recalled"


def test_a_rule_without_limit_says_so() -> None:
    rules = load_rules()
    assert rules.tension_variation is not None
    assert rules.tension_variation.at(50.0) == "these rules name no limit"


@pytest.mark.parametrize(
    ("text", "place"),
    [
        ("radial_pull: {id: pull, limit: 80 m}", "radial_pull.limit"),
        ("radial_pul: {id: pull}", "radial_pul"),
        ("radial_pull: {limit: 80 N}", "radial_pull.id"),
        ("radial_pull: {id: p, limit: 80 N, by_speed: [{limit: 80 N}]}", "radial_pull.limit"),
        ("radial_pull: {id: p, by_speed: [{limit: 8 N}, {limit: 9 N}]}", "radial_pull.by_speed[1]"),
        (
            "radial_pull: {id: p, by_speed: [{up_to: 50 km/h, limit: 8 N}, {up_to: 40 km/h, limit: 9 N}]}",
            "radial_pull.by_speed[1].up_to",
        ),
    ],
)
def test_faults_are_named_by_place(tmp_path: Path, text: str, place: str) -> None:
    file = tmp_path / "rules.yaml"
    file.write_text(f"format: 1\n{text}\n")
    with pytest.raises(LineFileError) as error:
        load_rules(file)
    assert [fault.field for fault in error.value.faults] == [place]
    assert error.value.faults[0].line == 2


def test_a_file_with_one_rule_is_enough(tmp_path: Path) -> None:
    file = tmp_path / "rules.yaml"
    file.write_text("format: 1\nradial_pull: {id: pull, limit: 0.1 kN}\n")
    rules = load_rules(file)
    assert rules.gradient is None
    assert rules.radial_pull is not None
    assert rules.radial_pull.at(None) == 100.0
