"""The VTK file, read back."""

from __future__ import annotations

from pathlib import Path

import meshio
import numpy as np

from catenaria.export.vtk import ARM, CANTILEVER, DROPPER, WIRE, write_vtu
from catenaria.line import Line
from catenaria.results import FormResult


def test_wires_droppers_and_arms(every: FormResult, tmp_path: Path) -> None:
    file = tmp_path / "line.vtu"
    write_vtu(every, file)
    mesh = meshio.read(file)
    cells, kind = mesh.cells_dict["line"], mesh.cell_data["kind"][0]
    wire, force = mesh.cell_data["wire"][0], mesh.cell_data["force_N"][0]
    for k, form in enumerate(every.wires):
        own = (kind == WIRE) & (wire == k)
        points = np.append(cells[own, 0], cells[own, 1][-1])
        profile = form.profile
        np.testing.assert_array_equal(mesh.points[points], np.column_stack((profile.x, profile.y, profile.z)))
        np.testing.assert_array_equal(mesh.point_data["tension_N"][points], profile.tension)
        np.testing.assert_array_equal(mesh.point_data["moment_Nm"][points], profile.moment)
    droppers = every.droppers
    np.testing.assert_array_equal(force[kind == DROPPER], droppers.force_bottom)
    np.testing.assert_array_equal(mesh.points[cells[kind == DROPPER, 0]], droppers.position_bottom)
    np.testing.assert_array_equal(mesh.points[cells[kind == DROPPER, 1]], droppers.position_top)
    np.testing.assert_array_equal(mesh.point_data["tension_N"][cells[kind == DROPPER, 1]], droppers.force_top)
    np.testing.assert_array_equal(force[kind == ARM], every.arms.axial)
    assert np.count_nonzero(kind == CANTILEVER) == len(every.cantilevers.support)


def test_every_value_is_there_but_forces_along_cantilevers(space: FormResult, tmp_path: Path) -> None:
    write_vtu(space, tmp_path / "line.vtu")
    mesh = meshio.read(tmp_path / "line.vtu")
    cells, kind = mesh.cells_dict["line"], mesh.cell_data["kind"][0]
    beams = cells[kind == CANTILEVER].ravel()
    for name, values in mesh.point_data.items():
        known = np.isfinite(values)
        unknown = name in ("tension_N", "moment_Nm", "curvature_per_m")
        assert set(np.flatnonzero(~known)) == (set(beams) if unknown else set())


def test_places_in_the_canted_track_frame(curve: FormResult, tmp_path: Path) -> None:
    write_vtu(curve, tmp_path / "line.vtu")
    mesh = meshio.read(tmp_path / "line.vtu")
    cells, kind = mesh.cells_dict["line"], mesh.cell_data["kind"][0]
    droppers, arms, data = curve.droppers, curve.arms, mesh.point_data
    for end, lateral, height in (
        (cells[kind == DROPPER, 0], droppers.stagger_bottom, droppers.height),
        (cells[kind == DROPPER, 1], droppers.stagger_top, droppers.messenger_height),
        (cells[kind == ARM, 0], arms.hinge_stagger, arms.hinge_height),
    ):
        np.testing.assert_allclose(data["lateral_m"][end], lateral, rtol=0.0, atol=1e-6)
        np.testing.assert_allclose(data["height_m"][end], height, rtol=0.0, atol=1e-6)
        assert np.abs(mesh.points[end, 2] - height).max() > 1e-3  # which is another one


def test_curvature_between_droppers_is_weight_by_tension(plane: FormResult, tmp_path: Path) -> None:
    write_vtu(plane, tmp_path / "line.vtu")
    mesh, line = meshio.read(tmp_path / "line.vtu"), Line.model_validate(plane.inputs)
    form, wire = plane.wires[0], line.conductor(line.contact_wire.conductor)
    middle = (plane.droppers.x[1:] + plane.droppers.x[:-1]) / 2.0
    bays = np.diff(plane.droppers.x) > 9.0
    n = form.profile.s.size
    curvature = mesh.point_data["curvature_per_m"][:n]
    found = np.interp(middle[bays], form.profile.x, curvature)
    weight = wire.rhoA * line.gravity / form.tension
    np.testing.assert_allclose(found, weight, rtol=0.05)  # by elements of 2 m
    np.testing.assert_allclose(curvature * wire.EJ, form.profile.moment, rtol=1e-12)


def test_strings_too(strings: FormResult, tmp_path: Path) -> None:
    write_vtu(strings, tmp_path / "line.vtu")
    mesh = meshio.read(tmp_path / "line.vtu")
    assert np.count_nonzero(mesh.cell_data["kind"][0] == DROPPER) == 21
