"""What a model needs to know of where one wire lies at the start, whether that is guessed or was found."""

from __future__ import annotations

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


class Laid(Protocol):
    """One wire at the start."""

    @property
    def length(self) -> float:
        """Unstressed length that is meshed, end to end [m]."""
        ...

    @property
    def pull(self) -> float:
        """How far pulled ends are outwards of their anchors; of a tied wire, how much longer it is [m]."""
        ...

    def place(self, s: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return r and r' at material coordinates, shape (n, 3) each."""
        ...
