"""Drawings, read back: what is on which layer, and where."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from catenaria.export.drawing import LAYERS, TEXT, Drawing, text_length
from catenaria.export.dxf import EXAGGERATION, write_plan_dxf, write_profile_dxf
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
    """Return the points of all polylines of a layer, which are flat in profiles and in space in plans."""
    flat = [np.array(e.get_points("xy")) for e in space.query(f'LWPOLYLINE[layer=="{layer}"]')]
    return flat + [
        np.array([tuple(p) for p in e.points()]) for e in space.query(f'POLYLINE[layer=="{layer}"]')
    ]


def boxes(space: Any) -> tuple[list[str], NDArray[np.float64]]:
    """Return all labels, and boxes [x0, x1, y0, y1] between opposite corners of them."""
    texts, found = [], []
    for entity in space.query('TEXT[layer=="LABELS"]'):
        name, place = entity.get_align_enum().name, np.array(entity.get_placement()[1])[:2]
        angle = np.radians(entity.dxf.rotation)
        along, up = np.array([np.cos(angle), np.sin(angle)]), np.array([-np.sin(angle), np.cos(angle)])
        back = 0.5 if "CENTER" in name else float("RIGHT" in name)
        down = 0.5 if "MIDDLE" in name else float("TOP" in name)
        corner = place - back * text_length(entity.dxf.text) * along - down * TEXT * up
        other = corner + text_length(entity.dxf.text) * along + TEXT * up
        ends = np.sort(np.stack((corner, other)), axis=0)
        texts.append(entity.dxf.text)
        found.append([ends[0, 0], ends[1, 0], ends[0, 1], ends[1, 1]])
    return texts, np.array(found)


def overlaps(box: NDArray[np.float64]) -> list[tuple[int, int]]:
    """Return the pairs of boxes that overlap."""
    low, high = box[:, None, ::2], box[:, None, 1::2]
    pairs = np.all((low < high.swapaxes(0, 1)) & (low.swapaxes(0, 1) < high), axis=2)
    return [(int(i), int(j)) for i, j in np.argwhere(pairs) if i < j]


def layers(result: FormResult) -> Counter[str]:
    return Counter(form.role.upper().replace(" ", "_").replace("-", "_") for form in result.wires)


def test_profile(every: FormResult, tmp_path: Path) -> None:
    file = tmp_path / "profile.dxf"
    write_profile_dxf(every, file, 1e-3)
    space, droppers = read(file), every.droppers
    for layer, count in layers(every).items():
        assert len(paths(space, layer)) == count
    profile = every.wires[0].profile
    wanted = np.column_stack((profile.chainage, EXAGGERATION * profile.height))
    np.testing.assert_allclose(paths(space, "CONTACT_WIRE")[0], wanted, rtol=0.0, atol=1e-9)
    found = lines(space, "DROPPERS")
    np.testing.assert_allclose(found[:, 0, 0], droppers.x, rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(found[:, 0, 1], EXAGGERATION * droppers.height, rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(found[:, 1, 1], EXAGGERATION * droppers.messenger_height, rtol=0.0, atol=1e-9)
    assert lines(space, "ARMS").shape[0] == len(every.arms.support)
    assert lines(space, "SUPPORTS").shape[0] == len(set(every.supports.support))
    ticks = lines(space, "SCALE")
    np.testing.assert_allclose(ticks[1:, 0, 1], EXAGGERATION * np.arange(len(ticks) - 1), rtol=0.0, atol=1e-9)
    texts, box = boxes(space)
    assert [(texts[i], texts[j]) for i, j in overlaps(box)] == []
    for x, low, high in zip(found[:, 0, 0], found[:, 0, 1], found[:, 1, 1], strict=True):
        inside = (box[:, 0] < x) & (x < box[:, 1]) & (box[:, 2] < high) & (low < box[:, 3])
        assert not inside.any()


def test_labels_of_droppers_at_one_place_stand_below_each_other(plane: FormResult, tmp_path: Path) -> None:
    droppers = plane.droppers
    twins = replace(plane, droppers=replace(droppers, x=np.repeat(droppers.x[::3], 3)))
    write_profile_dxf(twins, tmp_path / "profile.dxf", 1e-3)
    assert overlaps(boxes(read(tmp_path / "profile.dxf"))[1]) == []


def test_labels_that_overlap_are_noticed(tmp_path: Path) -> None:
    drawing = Drawing()
    for x in (0.0, 0.5 * TEXT, 10.0):
        drawing.text("1.1 1.234 m", (x, 0.0), "MIDDLE_RIGHT", rotation=90.0)
    drawing.write(tmp_path / "twins.dxf")
    assert overlaps(boxes(read(tmp_path / "twins.dxf"))[1]) == [(0, 1)]


def test_a_drawing_opens_with_all_of_it_in_view(curve: FormResult, tmp_path: Path) -> None:
    write_plan_dxf(curve, tmp_path / "plan.dxf")
    document = ezdxf.readfile(tmp_path / "plan.dxf")
    low, high = (np.array(document.header[name]) for name in ("$EXTMIN", "$EXTMAX"))
    points = np.concatenate(paths(document.modelspace(), "MESSENGER_WIRE"))
    assert (low <= points.min(axis=0)).all()
    assert (points.max(axis=0) <= high).all()
    view = document.viewports.get("*Active")[0].dxf
    np.testing.assert_allclose(tuple(view.center)[:2], 0.5 * (low + high)[:2])
    assert view.height >= (high - low)[1]


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
    texts, box = boxes(space)
    assert [(texts[i], texts[j]) for i, j in overlaps(box)] == []
    track = paths(space, "TRACK")[0]
    alignment = Line.model_validate(every.inputs).alignment
    at = alignment.locate(track, np.linspace(profile.chainage[0], profile.chainage[-1], len(track)))
    np.testing.assert_allclose(alignment.frames(at).lateral(track), 0.0, rtol=0.0, atol=1e-6)


def test_labels_give_numbers_and_rounded_lengths(plane: FormResult, tmp_path: Path) -> None:
    write_profile_dxf(plane, tmp_path / "profile.dxf", 5e-3)
    texts = [e.dxf.text for e in read(tmp_path / "profile.dxf").query('TEXT[layer=="LABELS"]')]
    assert "1.1 1.380 m" in texts
    assert "S4 195.00 m" in texts
    assert texts.count("65.00 m") == 3
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
