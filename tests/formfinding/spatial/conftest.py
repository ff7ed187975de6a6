"""Small lines in space, and ways to change them."""

from __future__ import annotations

import copy
from collections.abc import Callable
from importlib.util import find_spec
from typing import Any

import numpy as np
import pytest

from catenaria.formfinding.spatial.direct import find_directly
from catenaria.formfinding.spatial.dynamic import find_by_motion
from catenaria.line import Line
from catenaria.results import FormResult
from catenaria.results.film import Film

PEERS = ("exudyn",)  # extra: bench

collect_ignore = [f"test_{name}_in_space.py" for name in PEERS if find_spec(name) is None]

Change = dict[str, Any]
Make = Callable[..., Line]

BASE: Change = {
    "format": 1,
    "conductors": {
        "contact": {
            "youngs_modulus": 120e9,
            "area": 120e-6,
            "mass_per_length": 1.07,
            "bending_stiffness": 131.0,
        },
        "messenger": {
            "youngs_modulus": 113e9,
            "area": 65.8e-6,
            "mass_per_length": 0.596,
            "bending_stiffness": 20.0,
        },
        "dropper": {
            "youngs_modulus": 119e9,
            "area": 10e-6,
            "mass_per_length": 0.089,
            "bending_stiffness": 0.0,
        },
    },
    "contact_wire": {"conductor": "contact", "tension": {"force": 15e3}, "tail": 3.0},
    "messenger_wire": {"conductor": "messenger", "tension": {"force": 12e3}, "tail": 3.0},
    "dropper": {"conductor": "dropper", "model": "bar"},
    "solver": {"mesh": {}},
}
SUPPORT: Change = {"contact_wire": {"height": 5.3}, "messenger_wire": {"height": 6.7}}
SPAN: Change = {"length": 60.0, "droppers": {"positions": [5.0, 17.5, 30.0, 42.5, 55.0]}}

# Layers of sqrt(EJ/T) = 0.3 mm, which the nodes resolve: wires are strings to some micrometres.
STRINGS: Change = {
    "conductors.contact.bending_stiffness": 1e-3,
    "conductors.messenger.bending_stiffness": 1e-3,
    "solver.mesh.fine": [0.0003, 0.0006, 0.001, 0.0015, 0.0025, 0.005, 0.015, 0.05, 0.3],
}
ARM: Change = {
    "height": 5.3,
    "kind": "steady arm",
    "arm": {"length": 1.2, "mass": 0.0, "registration": "pull-off"},
}

# A curve on a gradient with nearly everything that a line can have.
EVERYTHING: Change = {
    "track": {
        "curves": [{"start": 20.0, "length": 600.0, "radius": 800.0, "transition": 60.0, "cant": 0.1}],
        "gradients": [{"start": -50.0, "slope": 0.004}, {"start": 130.0, "slope": -0.003}],
    },
    "contact_wire.wear": 0.1,
    "contact_wire.anchor_end": {"distance": 9.0, "height": 5.0, "stagger": 0.5},
    "messenger_wire.tension.device": {"kind": "weight", "efficiency": 0.98},
    "second_contact_wire": {"spacing": 0.04, "droppers": "alternate"},
    "stitch_wire": {"conductor": "dropper", "tension": 2.5e3, "length": 18.0},
    "mid_point": {"support": "middle", "conductor": "messenger", "tension": 2e3, "reach": 14.0},
    "point_masses": [{"name": "insulator", "wire": "contact wire", "chainage": 144.0, "mass": 5.0}],
    "dropper.clamp_mass_bottom": 0.2,
    "dropper.clamp_mass_top": 0.1,
    "supports.*.contact_wire": ARM,
    "supports.*.contact_wire.arm.side": "left",
    "supports.*.contact_wire.arm.mass": 2.0,
    "supports.0.stagger": -0.2,
    "supports.1.contact_wire.arm.clamp_mass": 0.4,
    "supports.1.messenger_stagger": -0.1,
    "supports.1.messenger_wire": {"height": 6.8, "kind": "spring", "stiffness": 100e3},
    "supports.2.name": "middle",
    "supports.2.stitch_wire": False,
    "supports.2.messenger_wire.kind": "clamped",
    "supports.3.contact_wire.arm.lift": 40.0,
    "supports.3.messenger_wire.kind": "bracket",
    "supports.4.messenger_wire.friction": 0.03,
    "spans.*.pre_sag": 0.02,
    "spans.1.length": 52.0,
    "spans.1.droppers.positions": [4.0, 15.0, 26.0, 37.0, 47.0],
    "spans.*.contact_wire_height": 5.3,
}

# Three stitched spans in a curve with arms, and bands of 0.1 N and 1 um for the dynamic method.
CURVED: Change = {
    "track": {
        "curves": [{"start": -100.0, "length": 600.0, "radius": 800.0, "transition": 50.0, "cant": 0.1}]
    },
    "stitch_wire": {"conductor": "dropper", "tension": 2.5e3, "length": 18.0},
    "supports.*.contact_wire": ARM,
    "supports.*.contact_wire.arm.side": "left",
    "supports.*.contact_wire.arm.mass": 2.0,
    "supports.*.stagger": -0.2,
    "supports.1.stagger": 0.1,
    "spans.*.pre_sag": 0.02,
    "solver.dynamic.contact_tension": {"dead_band": 0.1, "saturation": 2.5},
    "solver.dynamic.messenger_tension": {"dead_band": 0.1, "saturation": 2.5},
    "solver.dynamic.height": {"dead_band": 1e-6, "saturation": 5e-4},
    "solver.dynamic.settle": {"remaining_travel": 1e-9},
}


def _put(place: Any, path: list[str], value: object) -> None:
    """Set what is at a path; ``*`` stands for every entry of a list."""
    key, *rest = path
    keys: list[Any] = list(range(len(place))) if key == "*" else [int(key) if key.isdigit() else key]
    for name in keys:
        if rest:
            _put(place.setdefault(name, {}) if isinstance(place, dict) else place[name], rest, value)
        else:
            place[name] = copy.deepcopy(value)


def _made(spans: int, *changes: Change) -> Line:
    data = copy.deepcopy(BASE)
    data["supports"] = [copy.deepcopy(SUPPORT) for _ in range(spans + 1)]
    data["spans"] = [copy.deepcopy(SPAN) for _ in range(spans)]
    for change in changes:
        for path, value in change.items():
            _put(data, path.split("."), value)
    return Line.model_validate(data)


@pytest.fixture(scope="session")
def make() -> Make:
    """Return a line of equal spans with the given changes; keys are dotted paths, ``*`` is every entry."""
    return _made


@pytest.fixture(scope="session")
def find() -> Callable[[Line], FormResult]:
    """Find the form of a line by the direct method in space, plane or not."""
    return lambda line: find_directly(line, None)


@pytest.fixture(scope="session")
def strings() -> Change:
    """Return the change that makes wires strings."""
    return STRINGS


@pytest.fixture(scope="session")
def arm() -> Change:
    """Return a contact support with a steady arm without weight."""
    return ARM


def _hung(
    x: np.ndarray, w: float | np.ndarray, H: float, held: dict[int, float], load: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return heights of a string's nodes [m], and the forces that hold those of given height [N].

    Between nodes at x the string weighs w per length in plan, which may differ from bay to bay; H is its
    horizontal tension, loads act downwards.
    """
    b, n = np.diff(x), x.size
    K, down = np.zeros((n, n)), load.astype(float).copy()
    for i, (length, weight) in enumerate(zip(b, w * b, strict=True)):
        K[i : i + 2, i : i + 2] += H / length * np.array([[1.0, -1.0], [-1.0, 1.0]])
        down[i : i + 2] += 0.5 * weight
    fixed = np.array(sorted(held))
    free = np.setdiff1d(np.arange(n), fixed)
    z = np.zeros(n)
    z[fixed] = [held[i] for i in fixed.tolist()]
    z[free] = np.linalg.solve(K[np.ix_(free, free)], -down[free] - K[np.ix_(free, fixed)] @ z[fixed])
    return z, K @ z + down


@pytest.fixture(scope="session")
def hung() -> Callable[..., tuple[np.ndarray, np.ndarray]]:
    """Give `_hung` to tests: the closed form of a string."""
    return _hung


@pytest.fixture(scope="session")
def everything() -> Line:
    """Return four spans with nearly everything that a line can have."""
    return _made(4, EVERYTHING)


@pytest.fixture(scope="session")
def curved(make: Make) -> Callable[..., Line]:
    """Return three stitched spans in a curve, with further changes."""
    return lambda *changes: make(3, CURVED, *changes)


@pytest.fixture(scope="session")
def filmed(curved: Callable[..., Line]) -> tuple[FormResult, list[Film]]:
    """Find the form of the stitched spans in the curve by the dynamic method, filmed; once for all tests."""
    films: list[Film] = []
    return find_by_motion(curved(), None, None, films.append, 9), films


@pytest.fixture(scope="session")
def moved(filmed: tuple[FormResult, list[Film]]) -> FormResult:
    """Return the form in which that motion ended."""
    return filmed[0]
