"""Drawings, read back: what is on which layer, and where."""

from __future__ import annotations

from collections import Counter
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from catenaria.export.dxf import EXAGGERATION, LAYERS, write_plan_dxf, write_profile_dxf
from catenaria.line import Line
from catenaria.results import FormResult

ezdxf: Any = import_module("ezdxf")
units: Any = import_module("ezdxf.units")


def read(file: Path) -> Any:
    """Return a drawing that has no faults."""
    document = ezdxf.readfile(file)
    auditor = document.audit()
    assert (auditor.errors, auditor.fixes) == ([], [])
    assert document.units == units.M
    assert set(LAYERS) <= {layer.dxf.name for layer in document.layers}
    return document.modelspace()


def lines(space: Any, layer: str) -> NDArray[np.float64]:
    """Return start and end of all lines of a layer, shape (n, 2, 3)."""
    found = [(tuple(e.dxf.start), tuple(e.dxf.end)) for e in space.query(f'LINE[layer=="{layer}"]')]
    return np.array(found).reshape(-1, 2, 3)


def paths(space: Any, layer: str) -> list[NDArray[np.float64]]:
    """Return the points of all polylines of a layer."""
    return [np.array([tuple(p) for p in e.points()]) for e in space.query(f'POLYLINE[layer=="{layer}"]')]


def layers(result: FormResult) -> Counter[str]:
    return Counter(form.role.upper().replace(" ", "_").replace("-", "_") for form in result.wires)


def test_profile(every: FormResult, tmp_path: Path) -> None:
    file = tmp_path / "profile.dxf"
    write_profile_dxf(every, file, 1e-3)
    space, droppers = read(file), every.droppers
    for layer, count in layers(every).items():
        assert len(paths(space, layer)) == count
    profile = every.wires[0].profile
    wanted = np.column_stack((profile.chainage, EXAGGERATION * profile.height, np.zeros(profile.s.size)))
    np.testing.assert_allclose(paths(space, "CONTACT_WIRE")[0], wanted, rtol=0.0, atol=1e-9)
    found = lines(space, "DROPPERS")
    np.testing.assert_allclose(found[:, 0, 0], droppers.x, rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(found[:, 0, 1], EXAGGERATION * droppers.height, rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(found[:, 1, 1], EXAGGERATION * droppers.messenger_height, rtol=0.0, atol=1e-9)
    assert lines(space, "ARMS").shape[0] == len(every.arms.support)
    assert lines(space, "SUPPORTS").shape[0] == len(set(every.supports.support))


def test_plan(every: FormResult, tmp_path: Path) -> None:
    file = tmp_path / "plan.dxf"
    write_plan_dxf(every, file)
    space, droppers = read(file), every.droppers
    profile = every.wires[0].profile
    wanted = np.column_stack((profile.x, profile.y, profile.z))
    np.testing.assert_allclose(paths(space, "CONTACT_WIRE")[0], wanted, rtol=0.0, atol=1e-9)
    found = lines(space, "DROPPERS")
    np.testing.assert_allclose(found[:, 0], droppers.position_bottom, rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(found[:, 1], droppers.position_top, rtol=0.0, atol=1e-9)
    arms = lines(space, "ARMS")
    np.testing.assert_allclose(arms[:, 0], every.arms.hinge, rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(arms[:, 1], every.arms.tip, rtol=0.0, atol=1e-9)
    track = paths(space, "TRACK")[0]
    alignment = Line.model_validate(every.inputs).alignment
    at = alignment.locate(track, np.linspace(profile.chainage[0], profile.chainage[-1], len(track)))
    np.testing.assert_allclose(alignment.frames(at).lateral(track), 0.0, rtol=0.0, atol=1e-6)


def test_labels_give_numbers_and_rounded_lengths(plane: FormResult, tmp_path: Path) -> None:
    write_profile_dxf(plane, tmp_path / "profile.dxf", 5e-3)
    texts = [e.dxf.text for e in read(tmp_path / "profile.dxf").query('TEXT[layer=="LABELS"]')]
    assert "1.1 1.380 m" in texts
    assert "S4" in texts
    assert any("10 times exaggerated" in text and "metres" in text for text in texts)


def test_a_curve_is_curved(curve: FormResult, tmp_path: Path) -> None:
    write_plan_dxf(curve, tmp_path / "plan.dxf")
    track = paths(read(tmp_path / "plan.dxf"), "TRACK")[0]
    assert np.ptp(track[:, 1]) > 10.0


@pytest.mark.parametrize("writer", [lambda r, f: write_profile_dxf(r, f, 1e-3), write_plan_dxf])
def test_equal_results_give_equal_files(plane: FormResult, tmp_path: Path, writer: Any) -> None:
    for name in ("one", "other"):
        writer(plane, tmp_path / name)
    assert (tmp_path / "one").read_bytes() == (tmp_path / "other").read_bytes()
    assert ezdxf.options.write_fixed_meta_data_for_testing is False
