"""From chainage to space: the axis of the track, and the planes across it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from catenaria.errors import NotConvergedError
from catenaria.line.axis import Elevation, Plan
from catenaria.line.track import Track

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

LOCATE_STEPS: Final = 50  # of Newton's method; three or four are needed


@dataclass(frozen=True)
class Frames:
    """Axes of the track at given chainages; what is across the track lies in the plane of `left` and `up`.

    Attributes
    ----------
    chainage : FloatArray, shape (n,)
        Length along the track axis in plan [m].
    origin : FloatArray, shape (n, 3)
        Points P of the track axis, in the middle between the rail heads [m].
    along : FloatArray, shape (n, 3)
        Horizontal unit tangents t; the vertical plane across the track is t.(r - P) = 0.
    left, up : FloatArray, shape (n, 3)
        Unit vectors l in and u normal to the canted track plane, both normal to t; (t, l, u) is right-handed.
    """

    chainage: FloatArray
    origin: FloatArray
    along: FloatArray
    left: FloatArray
    up: FloatArray

    def point(self, lateral: ArrayLike, height: ArrayLike) -> FloatArray:
        """Return the points with given offsets from the track axis, P + b l + h u.

        Parameters
        ----------
        lateral, height : array_like, shape (n,) or scalar
            Offset b to the left and height h normal to the canted track plane [m].

        Returns
        -------
        FloatArray, shape (n, 3)
            Positions [m].
        """
        b = np.asarray(lateral, dtype=np.float64)[..., np.newaxis]
        h = np.asarray(height, dtype=np.float64)[..., np.newaxis]
        return self.origin + b * self.left + h * self.up

    def lateral(self, r: FloatArray) -> FloatArray:
        """Return the offsets to the left of points of shape (n, 3), l.(r - P) [m]."""
        return np.sum(self.left * (r - self.origin), axis=1)

    def height(self, r: FloatArray) -> FloatArray:
        """Return the heights above the canted track plane of points of shape (n, 3), u.(r - P) [m]."""
        return np.sum(self.up * (r - self.origin), axis=1)

    def take(self, index: IntArray | NDArray[np.bool_] | slice) -> Frames:
        """Return the frames that indices, a mask or a slice choose."""
        return Frames(
            self.chainage[index], self.origin[index], self.along[index], self.left[index], self.up[index]
        )

    @staticmethod
    def concatenate(parts: Sequence[Frames]) -> Frames:
        """Return the frames of all parts, at least one, one after the other."""
        return Frames(
            np.concatenate([part.chainage for part in parts]),
            np.concatenate([part.origin for part in parts]),
            np.concatenate([part.along for part in parts]),
            np.concatenate([part.left for part in parts]),
            np.concatenate([part.up for part in parts]),
        )


@dataclass(frozen=True)
class Alignment:
    """The track axis in space; outside of what is described it runs straight on.

    Attributes
    ----------
    plan : Plan
        The axis seen from above.
    elevation : Elevation
        Its height.
    rail_spacing : float
        Distance between the middles of the rail heads [m], which turns cant into an angle.

    Examples
    --------
    >>> track = Track(curves=[{"start": 0, "length": 200, "radius": 500, "transition": 0, "cant": 0.15}])
    >>> frames = Alignment.of(track, 0.0).frames([0.0, 200.0, 300.0])
    >>> frames.origin.round(3).tolist()
    [[0.0, 0.0, 0.0], [194.709, 39.47, 0.0], [286.815, 78.411, 0.0]]
    """

    plan: Plan
    elevation: Elevation
    rail_spacing: float

    @classmethod
    def of(cls, track: Track, start_chainage: float) -> Alignment:
        """Return the alignment of a track.

        Parameters
        ----------
        track : Track
            Curves and gradients by chainage.
        start_chainage : float
            Chainage of the first support [m]. There x is the chainage, y and z are 0, and the tangent is the
            x axis.

        Returns
        -------
        Alignment
            The track axis in space.
        """
        return cls(
            plan=Plan.of(track.curves, start_chainage),
            elevation=Elevation.of(track.gradients, start_chainage),
            rail_spacing=track.rail_spacing,
        )

    def frames(self, chainage: ArrayLike) -> Frames:
        """Return the frames at chainages.

        Parameters
        ----------
        chainage : array_like, shape (n,) or scalar
            Length along the axis in plan [m].

        Returns
        -------
        Frames
            One frame for each chainage.

        Notes
        -----
        psi is the heading, and sin phi = cant / rail spacing, positive in a canted curve to the left, where
        the right rail is raised and u leans to the left::

            t = (cos psi, sin psi, 0),  n = (-sin psi, cos psi, 0),
            l = n cos phi - ez sin phi,  u = ez cos phi + n sin phi.
        """
        c = np.atleast_1d(np.asarray(chainage, dtype=np.float64))
        heading, drift = self.plan.at(c)
        sin_phi = self.plan.bend(c)[1][:, np.newaxis] / self.rail_spacing
        cos_phi = np.sqrt(1.0 - sin_phi**2)
        cos, sin, zero = np.cos(heading), np.sin(heading), np.zeros_like(c)
        across = np.stack([zero - sin, cos, zero], axis=1)  # 0 - sin, because -sin may be -0
        vertical = np.array([0.0, 0.0, 1.0])
        return Frames(
            chainage=c,
            origin=np.stack([c + drift[:, 0], drift[:, 1], self.elevation.at(c)], axis=1),
            along=np.stack([cos, sin, zero], axis=1),
            left=cos_phi * across - sin_phi * vertical,
            up=cos_phi * vertical + sin_phi * across,
        )

    def locate(self, r: FloatArray, guess: ArrayLike) -> FloatArray:
        """Return the chainages whose vertical planes across the track hold the points.

        Parameters
        ----------
        r : FloatArray, shape (n, 3)
            Points [m], nearer to the axis than the centre of its curvature is.
        guess : array_like, shape (n,) or scalar
            Chainages from where to search [m].

        Returns
        -------
        FloatArray, shape (n,)
            Chainages c with t(c).(r - P(c)) = 0 [m].

        Raises
        ------
        NotConvergedError
            If there is no such plane near the guess, beyond the centre of a curve for example.

        Notes
        -----
        Newton's method: the derivative of t.(r - P) by the chainage is k y - 1, where k is the curvature and
        y the horizontal offset to the left.
        """
        c = np.broadcast_to(np.asarray(guess, dtype=np.float64), r.shape[:1]).copy()
        for _ in range(LOCATE_STEPS):
            heading, drift = self.plan.at(c)
            cos, sin = np.cos(heading), np.sin(heading)
            x, y = r[:, 0] - c - drift[:, 0], r[:, 1] - drift[:, 1]  # t is level: heights do not count
            slope = 1.0 - self.plan.bend(c)[0] * (cos * y - sin * x)
            step = (cos * x + sin * y) / np.where(slope > 0.0, slope, np.nan)
            c = c + step
            if np.all(np.abs(step) <= 1e-12 + 4.0 * np.spacing(np.abs(c))):
                return c
        raise NotConvergedError(
            "no plane across the track was found that holds the point",
            "points nearer to the track, and a chainage nearby to search from",
        )
