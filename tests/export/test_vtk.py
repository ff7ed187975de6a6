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
    np.testing.assert_array_equal(force[kind == ARM], every.arms.axial)
    assert np.count_nonzero(kind == CANTILEVER) == len(every.cantilevers.support)


def test_curvature_is_that_of_the_points(plane: FormResult, tmp_path: Path) -> None:
    """Against second differences of the points themselves, where a wire hangs between its droppers."""
    write_vtu(plane, tmp_path / "line.vtu")
    mesh = meshio.read(tmp_path / "line.vtu")
    n = plane.wires[0].profile.s.size
    x, z = mesh.points[:n, 0], mesh.points[:n, 2]
    curvature = mesh.point_data["curvature_per_m"][:n]
    measured = np.abs(np.gradient(np.gradient(z, x), x))
    near = np.abs(x[:, None] - plane.droppers.x).min(axis=1)
    between = (near > 2.0) & (np.abs(x % 65.0) > 6.0) & (np.abs(x % 65.0) < 59.0)
    np.testing.assert_allclose(curvature[between], measured[between], rtol=0.05)
    EJ = Line.model_validate(plane.inputs).conductor(Line.model_validate(plane.inputs).contact_wire.conductor).EJ
    np.testing.assert_allclose(curvature * EJ, plane.wires[0].profile.moment, rtol=1e-12)


def test_strings_too(strings: FormResult, tmp_path: Path) -> None:
    write_vtu(strings, tmp_path / "line.vtu")
    mesh = meshio.read(tmp_path / "line.vtu")
    assert np.count_nonzero(mesh.cell_data["kind"][0] == DROPPER) == 21
