"""The paper's line as text and as plain data in SI, to be spoilt in one place by each test."""

from __future__ import annotations

import copy
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

EXAMPLE = Path(__file__).parents[2] / "examples" / "yang2017_three_span.yaml"


@pytest.fixture(scope="session")
def example_path() -> Path:
    return EXAMPLE


@pytest.fixture(scope="session")
def example_text() -> str:
    return EXAMPLE.read_text(encoding="utf-8")


_SPAN: dict[str, Any] = {
    "length": 65.0,
    "droppers": {"positions": [4.0, 13.5, 23.0, 32.5, 42.0, 51.5, 61.0]},
    "contact_wire_height": 0.0,
}


def _conductor(youngs_modulus: float, area: float, density: float, stiffness: float) -> dict[str, Any]:
    return {
        "youngs_modulus": youngs_modulus,
        "area": area,
        "density": density,
        "bending_stiffness": stiffness,
    }


_TREE: dict[str, Any] = {
    "format": 1,
    "gravity": 9.8,
    "conductors": {
        "contact": _conductor(130e9, 120e-6, 7710.0, 400.0),
        "messenger": _conductor(81.7e9, 153e-6, 4020.0, 311.0),
        "dropper": _conductor(119e9, 10e-6, 8900.0, 4.0),
    },
    "contact_wire": {"conductor": "contact", "tension": {"force": 15e3}},
    "messenger_wire": {"conductor": "messenger", "tension": {"force": 15e3}},
    "dropper": {"conductor": "dropper"},
    "supports": [
        {"contact_wire": {"height": 0.0}, "messenger_wire": {"height": 1.5}},
        {"messenger_wire": {"height": 1.5}},
        {"messenger_wire": {"height": 1.5}},
        {"contact_wire": {"height": 0.0}, "messenger_wire": {"height": 1.5}},
    ],
    "spans": [_SPAN, _SPAN, _SPAN],
    "solver": {"dynamic": {"settle": {"remaining_travel": 0.5e-6}}},
}


@pytest.fixture
def tree() -> dict[str, Any]:
    """The paper's line in SI; every part may be changed without changing another."""
    fresh = copy.deepcopy(_TREE)
    fresh["spans"] = [copy.deepcopy(_SPAN) for _ in range(3)]
    return fresh


@pytest.fixture
def write(tmp_path: Path) -> Callable[[str, str], Path]:
    """Write a text to a file with the given name."""

    def write_text(text: str, name: str = "line.yaml") -> Path:
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        return path

    return write_text


_STRAND: dict[str, Any] = {
    "youngs_modulus": 113e9,
    "area": 65.8e-6,
    "mass_per_length": 0.596,
    "bending_stiffness": 20.0,
}


def _arm(**more: Any) -> dict[str, Any]:
    return {
        "height": 5.5,
        "kind": "steady arm",
        "arm": {"length": 1.2, "mass": 2.0, "clamp_mass": 0.4, "minimum_pull": 80.0, **more},
    }


@pytest.fixture
def stitched() -> dict[str, Any]:
    """Five spans in a canted curve that have everything that goes together with stitch wires."""
    messenger: list[dict[str, Any]] = [
        {"encumbrance": 1.8, "kind": "sliding", "friction": 0.02},
        {"encumbrance": 1.8, "kind": "spring", "stiffness": 1e5, "lateral_stiffness": 2e5},
        {"encumbrance": 1.8, "kind": "clamped"},
        {
            "encumbrance": 1.8,
            "kind": "cantilever",
            "cantilever": {
                **_STRAND,
                "bending_stiffness": 7e4,
                "length": 2.5,
                "side": "right",
                "elements": 3,
            },
        },
        {"encumbrance": 1.8, "kind": "bracket"},
        {"height": 7.5},
    ]
    contact: list[dict[str, Any]] = [
        {"height": 5.5},
        _arm(hinge={"stagger": 1.3, "height": 6.0}),
        _arm(lift=60.0),
        _arm(registration="push-off", side="right"),
        _arm(side="right"),
        {"height": 6.0},
    ]
    stagger = (0.0, 0.2, -0.2, 0.2, -0.2, 0.0)
    span = {
        "length": 60.0,
        "droppers": {"first": 5.0, "spacing": 10.0, "count": 6},
        "pre_sag_per_mille": 0.5,
    }
    return {
        "format": 1,
        "name": "stitched",
        "conductors": {"strand": _STRAND, "dropper": _TREE["conductors"]["dropper"]},
        "contact_wire": {
            "conductor": "AC-120 CuETP",
            "tension": {"force": 15e3, "pulled": "end", "device": {"kind": "weight", "efficiency": 0.97}},
            "anchor_end": {"distance": 30.0, "height": 6.5, "stagger": 1.5},
            "wear": 0.1,
        },
        "second_contact_wire": {"spacing": 0.04, "droppers": "both"},
        "messenger_wire": {
            "conductor": "strand",
            "tension": {"force": 15e3, "device": {"kind": "spring", "stiffness": 2e4}},
        },
        "stitch_wire": {"conductor": "BzII 35", "tension": 2.8e3, "length": 14.0},
        "mid_point": {"support": "mid", "conductor": "BzII 35", "tension": 4e3, "reach": 12.0},
        "point_masses": [
            {"name": "insulator", "wire": "contact wire", "chainage": 1012.0, "mass": 5.0},
            {"wire": "messenger wire", "chainage": 1290.0, "mass": 4.0},
        ],
        "dropper": {"conductor": "dropper", "model": "rigid"},
        "start_chainage": 1000.0,
        "supports": [
            {"name": name, "stagger": b, "messenger_stagger": 0.0, "contact_wire": c, "messenger_wire": m}
            for name, b, c, m in zip(
                ["A", "B", "mid", "D", "E", "F"], stagger, contact, messenger, strict=True
            )
        ],
        "spans": [
            *(copy.deepcopy(span) for _ in range(3)),
            copy.deepcopy(span) | {"pre_sag_per_mille": None, "pre_sag": 0.03},
            {"length": 60.0},
        ],
        "track": {
            "curves": [{"start": 1050.0, "length": 150.0, "radius": -800.0, "transition": 40.0, "cant": 0.1}],
            "gradients": [{"start": 1000.0, "slope": 0.005}],
            "rail_spacing": 1.5,
        },
    }


@pytest.fixture
def compound(tree: dict[str, Any]) -> dict[str, Any]:
    """The paper's line with an auxiliary messenger."""
    tree["conductors"]["strand"] = dict(_STRAND)
    tree["auxiliary_messenger"] = {"conductor": "strand", "tension": {"force": 8e3}}
    for support in tree["supports"]:
        support["auxiliary_messenger"] = {"height": 0.9}
    for span in tree["spans"]:
        span["auxiliary"] = {"droppers": {"positions": [10.0, 32.0, 54.0]}, "height": [0.85, 0.8, 0.85]}
    return tree
