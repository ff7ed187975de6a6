"""What holds of every line and load: nothing does nothing, small loads superpose, mirrors mirror."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from catenaria.discretise.spatial.loaded import loaded_system
from catenaria.formfinding.static_problem import static_problem
from catenaria.line.load_case import LoadCase
from catenaria.loading.case import changed_model, loads_on
from catenaria.solvers.load_stepping import solve_by_steps

Make = Callable[..., Any]

CURVED = {
    "track": {
        "curves": [{"start": -200.0, "length": 900.0, "radius": 800.0, "transition": 50.0, "cant": 0.1}]
    },
    "stitch_wire": {"conductor": "dropper", "tension": 2.5e3, "length": 18.0},
}
ZERO: list[dict[str, Any]] = [
    {},
    {"temperature": {"change": 0.0}},
    {"wind": {"speed": 0.0}},
    {"ice": {"messenger_wire": 0.0}},
    {"ice": {"thickness": 0.0}, "wind": {"speed": 0.0}},
    {"moved_supports": [{"support": "S2"}]},
    {"push": [{"chainage": 90.0, "force": 0.0}]},
]


def difference(after: Any, before: Any) -> float:
    """Return by how much any point of any wire has moved [m]."""
    moved = [after.droppers.height - before.droppers.height, after.droppers.lateral - before.droppers.lateral]
    for a, b in zip(after.wires, before.wires, strict=True):
        if a.s.size == b.s.size:  # pushed wires have more nodes
            moved += [a.height - b.height, a.lateral - b.lateral]
    return max(float(np.abs(by).max()) for by in moved)


@pytest.mark.parametrize("case", ZERO, ids=lambda case: "+".join(case) or "nothing")
@pytest.mark.parametrize("change", [{}, CURVED], ids=["straight", "curved"])
def test_nothing_does_nothing(make: Make, change: dict[str, Any], case: dict[str, Any]) -> None:
    line = make(**change)
    loaded = line.under(**case)
    finer = 1e-6 if "push" in case else 1e-9  # nodes are added where a wire is pushed
    assert difference(loaded.state, line.before) < finer
    np.testing.assert_allclose(loaded.state.droppers.force, line.before.droppers.force, atol=1e4 * finer)
    np.testing.assert_allclose(line.before.droppers.height, line.result.droppers.height, atol=1e-9)
    assert difference(line.under(push=[{"chainage": 90.0, "force": 1.0}]).state, line.before) > 1e-5


def heights(line: Any, **case: Any) -> np.ndarray:
    return np.asarray(line.under(**case).state.droppers.height - line.before.droppers.height)


def misses(line: Any, size: float) -> float:
    """Return by what part two loads together differ from their sum."""
    first = {"push": [{"chainage": 75.0, "force": size}]}
    second = {"ice": {"messenger_wire": 0.01 * size}}
    both, apart = heights(line, **first, **second), heights(line, **first) + heights(line, **second)
    return float(np.abs(both - apart).max() / np.abs(both).max())


@pytest.mark.parametrize("change", [{}, CURVED], ids=["straight", "curved"])
def test_small_loads_superpose(make: Make, change: dict[str, Any]) -> None:
    line = make(**change)
    assert misses(line, 0.1) < 2e-4
    assert misses(line, 600.0) > 2e-3  # and large ones do not


SIDES = (0.2, -0.1, 0.3, -0.2)


def test_mirrored_sideways(make: Make) -> None:
    one, other = make(stagger=SIDES), make(stagger=tuple(-b for b in SIDES))
    wind = {"speed": 25.0, "direction": 60.0}
    left, right = one.under(wind=wind).state, other.under(wind=wind | {"direction": 300.0}).state
    for a, b in zip(left.wires, right.wires, strict=True):
        np.testing.assert_allclose(a.lateral, -b.lateral, atol=1e-8)
        np.testing.assert_allclose(a.height, b.height, atol=1e-8)
    same = other.under(wind=wind).state
    assert np.abs(left.wires[0].lateral + same.wires[0].lateral).max() > 0.1


def test_mirrored_along(make: Make) -> None:
    """Up to what meshes, which begin at the fixed points of wires, do not mirror."""
    spans = (60.0, 50.0, 65.0)
    ends = [
        {
            f"{name}_wire": {"conductor": name, "tension": {"force": force, "at": at}, "tail": 3.0}
            for name, force in (("contact", 15e3), ("messenger", 12e3))
        }
        for at in ("start", "end")
    ]
    one, other = make(spans, **ends[0]), make(spans[::-1], **ends[1])
    push = [{"chainage": 20.0, "force": 120.0}]
    hot = {"temperature": {"change": 30.0}, "broken_droppers": [{"span": 2, "number": 2}]}
    back = {"temperature": {"change": 30.0}, "broken_droppers": [{"span": 2, "number": 4}]}
    there = one.under(**hot, push=push)
    again = other.under(**back, push=[{"chainage": 155.0, "force": 120.0}])
    np.testing.assert_allclose(there.state.droppers.height, again.state.droppers.height[::-1], atol=5e-5)
    np.testing.assert_allclose(there.pushed.uplift, again.pushed.uplift, atol=5e-5)
    other_push = other.under(**back, push=push)
    assert np.abs(there.state.droppers.height - other_push.state.droppers.height[::-1]).max() > 1e-3


def test_loads_together_do_not_depend_on_steps(make: Make) -> None:
    """Load stepping, which serves where Newton's method fails, arrives at the same rest."""
    line = make()
    case = LoadCase.model_validate({"temperature": {"change": 35.0}, "wind": {"speed": 30.0}})
    model = changed_model(line.built, case, np.zeros(line.built.model.length.size, np.bool_))
    load = loads_on(line.built, model, case).on(model)
    z = model.unknowns.start
    stepped = solve_by_steps(static_problem(loaded_system(model, z, load, line.built.devices)), z)
    at_once = line.built.under(load, model)
    np.testing.assert_allclose(stepped.root.y, at_once.z, atol=1e-6)
    assert np.abs(at_once.z - z).max() > 0.1


def out_of_balance(line: Any, case: Any, *, loaded: bool = True) -> np.ndarray:
    """Return what is missing in the balance of all forces on the whole line [N].

    Supports and ends bear the weights of wires, droppers and masses, and what the case adds.
    """
    model, layout, state = line.built.model, line.built.model.layout, case.state
    wires = sum(
        chain.section.rhoA * model.natural_length(model.unknowns.start, k)
        for k, chain in enumerate(model.wires)
    )
    length = line.result.droppers.length  # half of each dropper's weight, as it hangs, is at either clamp
    moved = case.state.droppers.broken
    droppers = float(np.sum((layout.droppers.rhoA * length)[~moved]))
    weight = np.array([0.0, 0.0, -layout.g * (wires + droppers + layout.masses.mass.sum())])
    applied = case.load.sum(axis=0) + case.dropper_load if loaded else np.zeros(3)
    up = line.line.alignment.frames(case.pushed.chainage).up
    pushed = case.pushed.force @ up
    held = state.supports
    borne = np.array([held.force_x.sum(), held.force_y.sum(), held.force_z.sum()])
    borne += sum(wire.end_force.sum(axis=0) for wire in state.wires if wire.role in LONG)
    return np.asarray(borne - weight - applied - pushed)


LONG = ("contact wire", "messenger wire", "auxiliary messenger")


@pytest.mark.parametrize("change", [{}, CURVED], ids=["straight", "curved"])
def test_supports_and_ends_bear_everything(make: Make, change: dict[str, Any]) -> None:
    """Seen from outside, whatever happens within: all forces on the line are in balance."""
    line = make(stagger=(0.2, -0.2, 0.2, -0.2), **change)
    case = line.under(
        temperature={"change": -20.0},
        wind={"speed": 25.0, "direction": 60.0},
        ice={"thickness": 0.005},
        push=[{"chainage": 75.0, "force": 150.0}],
        broken_droppers=[{"span": 2, "number": 4}],
    )
    assert (
        np.abs(out_of_balance(line, case)).max() < 0.05
    )  # droppers have become longer or shorter by some mm
    assert np.abs(out_of_balance(line, line.under())).max() < 1e-3
    assert np.abs(out_of_balance(line, case, loaded=False)).min() > 1.0
