"""The elastic catenary against MoorPy, a program that is not ours; collected where that is installed."""

from __future__ import annotations

from importlib import import_module

import numpy as np
import pytest

from catenaria.formfinding.strings.catenary_equations import elastic_catenary

ONE = np.ones(1)


@pytest.mark.parametrize(
    ("H", "V", "L"), [(14990.0, -196.0, 64.9), (14990.0, 30.0, 30.0), (2e3, -300.0, 80.0)]
)
def test_forces_of_an_elastic_catenary_are_those_of_moorpy(H: float, V: float, L: float) -> None:
    """A bay of the paper's messenger, one end of it, a slack cable; Hooke's law in both."""
    w, EA = 6.03, 12.5e6
    reach = elastic_catenary(H * ONE, V * ONE, L * ONE, w, (1.0, EA))
    catenary = import_module("moorpy.Catenary").catenary

    def forces(weight: float) -> tuple[float, float]:
        along, up = catenary(
            float(reach.dx[0]), float(reach.dz[0]), L, EA, weight, CB=-100.0, Tol=1e-12, MaxIter=200
        )[:2]
        return float(along), float(up)

    assert forces(w) == pytest.approx((H, V), rel=1e-9)
    assert forces(1.001 * w) != pytest.approx((H, V), rel=1e-9)
