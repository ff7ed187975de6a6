"""Distributions of many independent errors at once, drawn from uniform random numbers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.special import ndtr, ndtri  # pyright: ignore[reportMissingTypeStubs, reportUnknownVariableType]

from catenaria.line.installation import DistributionKind

FloatArray = NDArray[np.float64]

_CHUNK = 64  # samples that share a stream of random numbers
_LEAST = 2.0**-54  # numpy's uniform numbers are multiples of 2^-53, 0 among them, 1 not
_SQRT_TWO_PI = np.sqrt(2.0 * np.pi)


@dataclass(frozen=True)
class Distributions:
    """One distribution for each error.

    Attributes
    ----------
    kind : tuple of str, length m
        ``normal``, ``uniform`` or ``triangular``.
    mean, scale : FloatArray, shape (m,)
        Mean, and standard deviation (normal) or half of the width (others).
    clip : FloatArray, shape (m,)
        Where the tails of normal distributions are cut off, in standard deviations; infinite if nowhere.
    """

    kind: tuple[DistributionKind, ...]
    mean: FloatArray
    scale: FloatArray
    clip: FloatArray

    def of(self, kind: str) -> NDArray[np.bool_]:
        """Return the mask of the distributions of one kind."""
        return np.array([own == kind for own in self.kind], dtype=np.bool_)

    def value(self, u: FloatArray) -> FloatArray:
        """Return the quantiles of uniform numbers in (0, 1), shape (..., m).

        Notes
        -----
        A normal distribution that is cut at c standard deviations has the quantile Phi^-1(Phi(-c) + u (1 - 2
        Phi(-c))); a symmetric triangular one -1 + sqrt(2 u) in its lower half.
        """
        x = np.empty_like(u)
        normal, uniform, triangular = (self.of(kind) for kind in ("normal", "uniform", "triangular"))
        tail = _Phi(-self.clip[normal])
        x[..., normal] = _quantile(tail + u[..., normal] * (1.0 - 2.0 * tail))
        x[..., uniform] = 2.0 * u[..., uniform] - 1.0
        half = np.minimum(u[..., triangular], 1.0 - u[..., triangular])
        x[..., triangular] = np.copysign(1.0 - np.sqrt(2.0 * half), u[..., triangular] - 0.5)
        return self.mean + self.scale * x

    @property
    def deviation(self) -> FloatArray:
        """Standard deviations, shape (m,).

        Notes
        -----
        a/sqrt(3) and a/sqrt(6) for half widths a; of the cut normal distribution sigma sqrt(1 - 2 c phi(c)/(1
        - 2 Phi(-c))) (Johnson, Kotz & Balakrishnan 1994, section 13.10.1).
        """
        c = np.where(np.isfinite(self.clip), self.clip, 0.0)
        lost = 2.0 * c * np.exp(-0.5 * c**2) / _SQRT_TWO_PI / (1.0 - 2.0 * _Phi(-self.clip))
        share = np.select([self.of("uniform"), self.of("triangular")], [1.0 / 3.0, 1.0 / 6.0], 1.0 - lost)
        return self.scale * np.sqrt(share)

    def draw(self, seed: int, first: int, count: int) -> FloatArray:
        """Return samples of all errors, shape (count, m).

        Parameters
        ----------
        seed : int
            Seed of the whole study.
        first, count : int
            Number of the first sample, from 0, and how many. Each sample is the same however many are drawn
            at once, and before or after it.
        """
        chunks = range(first // _CHUNK, -(-(first + count) // _CHUNK))
        drawn = [self._chunk(seed, chunk) for chunk in chunks]
        start = first - chunks.start * _CHUNK
        return np.concatenate([np.empty((0, len(self.kind))), *drawn])[start : start + count]

    def _chunk(self, seed: int, chunk: int) -> FloatArray:
        rng = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(chunk,)))
        return self.value(np.maximum(rng.random((_CHUNK, len(self.kind))), _LEAST))

    @classmethod
    def concatenate(cls, parts: Sequence[Distributions]) -> Distributions:
        """Return all distributions of some parts, one after the other."""
        return cls(
            tuple(kind for part in parts for kind in part.kind),
            *(
                np.concatenate([np.empty(0), *(getattr(part, name) for part in parts)])
                for name in ("mean", "scale", "clip")
            ),
        )


def _Phi(x: FloatArray) -> FloatArray:  # noqa: N802, the symbol of the field
    return np.asarray(ndtr(x))  # pyright: ignore[reportUnknownArgumentType]


def _quantile(u: FloatArray) -> FloatArray:
    return np.asarray(ndtri(u))  # pyright: ignore[reportUnknownArgumentType]
