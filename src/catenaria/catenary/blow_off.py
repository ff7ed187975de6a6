"""The textbook's lateral position of a wire under wind: a parabola over a span, in straights and curves."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class BlownSpan:
    """A span whose wire the wind blows to the side.

    Attributes
    ----------
    length : float
        Distance a of the supports [m].
    stagger_start, stagger_end : float
        Lateral positions b1 and b2 there, positive to the left [m].
    load : float
        Wind q' to the left [N/m].
    tension : float
        Horizontal tension H [N].
    curvature : float
        1/R of the track, positive to the left [1/m].

    References
    ----------
    Kiessling, Puschmann, Schmieder and Schneider 2018, Contact Lines for Electric Railways, section 4.8; its
    simplification sums wind and tension of contact and messenger wire.
    """

    length: float
    stagger_start: float
    stagger_end: float
    load: float
    tension: float
    curvature: float = 0.0

    @property
    def bend(self) -> float:
        """q'/H + 1/R [1/m]: how strongly the wire is bent to the right relative to the track."""
        return self.load / self.tension + self.curvature

    def lateral(self, x: ArrayLike) -> FloatArray:
        """Return y(x) = b1 + (b2 - b1) x/a + (q'/H + 1/R) x (a - x)/2, to the left of the track [m].

        Parameters
        ----------
        x : array_like
            Distance from the first support [m].
        """
        u = np.asarray(x, dtype=np.float64)
        chord = self.stagger_start + (self.stagger_end - self.stagger_start) * u / self.length
        return chord + 0.5 * self.bend * u * (self.length - u)

    @property
    def furthest(self) -> tuple[float, float]:
        """Where the wire deviates most from the middle of the track and how far [m].

        Notes
        -----
        Within the span that is q' a^2/(8 H) + (b1 + b2)/2 + H (b1 - b2)^2/(2 q' a^2) in a straight, as long
        as |b2 - b1| < q' a^2/(2 H); else a support.

        Examples
        --------
        >>> x, y = BlownSpan(60.0, 0.2, 0.2, 8.0, 12e3).furthest
        >>> round(x, 6), round(y, 6)
        (30.0, 0.5)
        """
        places = [0.0, self.length]
        if self.bend != 0.0:
            rise = (self.stagger_end - self.stagger_start) / self.length
            vertex = 0.5 * self.length + rise / self.bend
            places += [vertex] if 0.0 < vertex < self.length else []
        lateral = self.lateral(places)
        i = int(np.argmax(np.abs(lateral)))
        return places[i], float(lateral[i])
