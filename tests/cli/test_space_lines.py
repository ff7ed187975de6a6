"""What is said of lines in space: wires, arms and droppers that need a look."""

from __future__ import annotations

from io import StringIO
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from rich.console import Console

from catenaria.cli.space_lines import space_lines
from catenaria.cli.summary import show_result
from catenaria.results import NO_ARMS, Arms

STITCHES = 3


def arms(radial: list[float], registration: str = "pull-off") -> Arms:
    force, one = np.array(radial), np.ones(len(radial))
    place = np.zeros((one.size, 3))
    names = tuple(f"S{i + 1}" for i in range(one.size))
    kinds = (registration,) * one.size
    wires = ("contact wire",) * one.size
    return Arms(names, wires, kinds, one, place, place, one, one, one, one, force, force, one, 80.0 * one)


def found(*, spatial: bool = True, force: float = 60.0, held: Arms = NO_ARMS) -> Any:
    roles = ["contact wire", "messenger wire", *["stitch wire"] * STITCHES]
    n = 12
    return SimpleNamespace(
        spatial=spatial,
        wires=[SimpleNamespace(role=role) for role in roles],
        arms=held,
        droppers=SimpleNamespace(
            x=np.arange(n),
            span=np.repeat([1, 2], 6),
            number=np.tile(np.arange(1, 7), 2),
            lower_wire=("contact wire",) * n,
            inclination=np.radians(np.linspace(0.0, 5.5, n)),
            slack=np.full(n, force <= 0.0),
        ),
    )


def test_a_plane_line_needs_no_more_lines() -> None:
    assert space_lines(found(spatial=False)) == []


def test_wires_and_inclinations_are_told() -> None:
    assert space_lines(found()) == [
        "5 wires: contact wire, messenger wire, 3 stitch wires.",
        "Largest inclination of a dropper: 5.50 degrees (span 2, dropper 6 of the contact wire).",
    ]


def test_the_weakest_arm_is_named() -> None:
    said = space_lines(found(held=arms([120.0, 95.5, 240.0])))
    assert said[1] == "3 steady arms: weakest radial force 95.5 N at S2 (contact wire, pull-off)."
    assert len(said) == 3


@pytest.mark.parametrize(
    ("radial", "named"), [(-30.0, "S2 -30.0 N (pull-off)"), (79.0, "S2 79.0 N (pull-off)")]
)
def test_arms_that_push_or_pull_too_little_are_a_caution(radial: float, named: str) -> None:
    caution = space_lines(found(held=arms([120.0, radial])))[2]
    assert caution.startswith("Caution: steady arms")
    assert caution.endswith(f": {named}.")


@pytest.mark.parametrize(("radial", "said"), [(-200.6, True), (200.6, False)])
def test_push_off_arms_in_compression_are_a_caution(radial: float, said: bool) -> None:
    lines = space_lines(found(held=arms([120.0, radial], "push-off")))
    cautions = [line for line in lines if "Caution" in line]
    assert [caution.endswith(": S2 -200.6 N (push-off).") for caution in cautions] == [True] * said
    assert all("in compression" in caution for caution in cautions)


def test_slack_droppers_are_a_caution_and_not_all_are_named() -> None:
    caution = space_lines(found(force=-1.0))[-1]
    assert caution.startswith("Caution: 12 slack droppers, which lift nothing: span 1, dropper 1 of")
    assert caution.endswith("span 2, dropper 2 of the contact wire; and 4 more.")


@pytest.mark.parametrize("several", [False, True])
def test_a_schedule_of_several_wires_says_which_one_a_dropper_holds(workflow: Any, several: bool) -> None:
    result = workflow.result
    n = result.droppers.x.size
    result.spatial, result.arms = True, NO_ARMS
    wires = ("contact wire", "second contact wire") if several else ("contact wire",) * 2
    result.droppers.lower_wire = tuple(wires[i % 2] for i in range(n))
    result.droppers.inclination, result.droppers.slack = np.zeros(n), np.zeros(n, dtype=np.bool_)
    for wire in result.wires:
        wire.role = wire.name
    console = Console(width=80, record=True, file=StringIO(), markup=False)
    show_result(result, console)
    lines = console.export_text().splitlines()
    heading = next(line for line in lines if "span" in line)
    assert ("holds" in heading) == several
    assert "…" not in heading
    second = next(line for line in lines if line.split()[:2] == ["1", "2"])
    assert second.rstrip().endswith("second" if several else "-0.011")
