"""Compile all kernels at once, so that whoever waits can be told."""

from __future__ import annotations

from pathlib import Path
from typing import Any, cast

import numpy as np

from catenaria.mechanics.kernels.cable import add_cable_forces, cable_energies, cable_stiffness
from catenaria.mechanics.kernels.compress import compress, merge
from catenaria.mechanics.kernels.points import chain_points, elements_of
from catenaria.mechanics.kernels.scatter import sum_into

_KERNELS = (
    add_cable_forces,
    cable_energies,
    cable_stiffness,
    chain_points,
    elements_of,
    compress,
    merge,
    sum_into,
)


def need_compiling() -> bool:
    """Return whether a kernel has not been compiled on this machine yet, as far as files on disk tell."""
    return not all(_has_index(cast(Any, kernel)) for kernel in _KERNELS)


def _has_index(kernel: Any) -> bool:
    folder = Path(str(kernel.stats.cache_path))
    module = Path(kernel.py_func.__code__.co_filename).stem
    return any(folder.glob(f"{module}.{kernel.py_func.__name__}-*.nbi"))


def warm_up() -> None:
    """Run every kernel once on one straight element of unit length."""
    z = np.array([0.0, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0])
    dofs, one = np.arange(12, dtype=np.int64)[None, :], np.ones(1)
    B = np.zeros((1, 4))
    B[0, 1] = 1.0
    add_cable_forces(z, dofs, one, one, one, B, B, one, np.zeros(12))
    cable_stiffness(z, dofs, one, one, one, B, B, one)
    cable_energies(z, dofs, one, one, one, B, B, one)
    first = np.zeros(1, dtype=np.int64)
    elements_of(np.array([0.0, 1.0]), 0.5 * one, first, 0.0)
    chain_points(z, dofs.reshape(2, 6), np.array([0.0, 1.0]), 0.5 * one, first)
    _, indices, indptr = compress(first.astype(np.int32), first.astype(np.int32), 1)
    merge(indices, indptr, indices, indptr)
    sum_into(one, first, 1)
