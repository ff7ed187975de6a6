"""What controls measure: tension at a wire's end or in it, height of a point, force in a dropper."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from catenaria.mechanics.chain import Chain
from catenaria.mechanics.loads.gravity import Ramp

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


@dataclass(frozen=True)
class ReactionTension:
    """The force with which the tensioning device reacts, |la| at a held wire end; negative if it pushes.

    Parameters
    ----------
    multipliers : IntArray, shape (n, 3)
        Indices of the forces of the wire ends on the devices.
    direction : FloatArray, shape (n, 3)
        Unit vectors in which the devices pull.
    """

    multipliers: IntArray
    direction: FloatArray

    def value(self, t: float, z: FloatArray) -> FloatArray:
        """Return |la|, with the sign of the pull -la . n."""
        la = z[self.multipliers]
        return self._sign(la) * np.linalg.norm(la, axis=1)

    def columns(self) -> IntArray:
        """Return the multipliers."""
        return self.multipliers

    def gradient(self, t: float, z: FloatArray) -> FloatArray:
        """Return la/|la| with that sign; -n where there is no force."""
        la = z[self.multipliers]
        size = np.linalg.norm(la, axis=1)
        safe = np.where(size > 0.0, size, 1.0)
        return np.where(size[:, None] > 0.0, (self._sign(la) / safe)[:, None] * la, -self.direction)

    def _sign(self, la: FloatArray) -> FloatArray:
        return np.copysign(1.0, -np.einsum("ni,ni->n", la, self.direction))

    def relocate(self, z: FloatArray) -> None:
        """Return None: there is no discrete state."""
        return


@dataclass(frozen=True)
class StrainTension:
    """N = EA eps of eq. (11) at sliding points of a wire, the paper's own measure.

    Parameters
    ----------
    wire : Chain
        The wire.
    s : IntArray, shape (n,)
        Indices of the sliding coordinates.
    element : IntArray, shape (n,)
        Element in which each point is: discrete state.

    Notes
    -----
    One point of one element: where the wire bends within sqrt(EJ/T) and the mesh does not resolve it, the
    value is off by hundreds of newtons. `ReactionTension` is right on any mesh.
    """

    wire: Chain
    s: IntArray
    element: IntArray

    def value(self, t: float, z: FloatArray) -> FloatArray:
        """Return EA (r' . r' - 1)/2."""
        r1 = self.wire.evaluate(z, z[self.s], self.element).r1
        return 0.5 * self.wire.section.EA * (np.einsum("ni,ni->n", r1, r1) - 1.0)

    def columns(self) -> IntArray:
        """Return the element's coordinates, then the sliding coordinate."""
        ends = (self.wire.nodes[self.element], self.wire.nodes[self.element + 1])
        return np.concatenate((*ends, self.s[:, None]), axis=1)

    def gradient(self, t: float, z: FloatArray) -> FloatArray:
        """Return EA N' r' and EA r' . r''."""
        point = self.wire.evaluate(z, z[self.s], self.element)
        by_q = (point.N1[:, :, None] * point.r1[:, None, :]).reshape(-1, 12)
        by_s = np.einsum("ni,ni->n", point.r1, point.r2)[:, None]
        return self.wire.section.EA * np.concatenate((by_q, by_s), axis=1)

    def relocate(self, z: FloatArray) -> StrainTension | None:
        """Return the measure in the elements that fit z, or None."""
        element = self.wire.relocate(z[self.s], self.element)
        return None if np.array_equal(element, self.element) else replace(self, element=element)


@dataclass(frozen=True)
class Height:
    """The height of nodes, eq. (21).

    Parameters
    ----------
    z_index : IntArray, shape (n,)
        Indices of the nodes' vertical coordinates.
    """

    z_index: IntArray

    def value(self, t: float, z: FloatArray) -> FloatArray:
        """Return the heights [m]."""
        return z[self.z_index]

    def columns(self) -> IntArray:
        """Return the vertical coordinates."""
        return self.z_index[:, None]

    def gradient(self, t: float, z: FloatArray) -> FloatArray:
        """Return 1."""
        return np.ones((self.z_index.size, 1))

    def relocate(self, z: FloatArray) -> None:
        """Return None: there is no discrete state."""
        return


@dataclass(frozen=True)
class WireHeight:
    """The height of a wire where a dropper is clamped to it.

    Parameters
    ----------
    wire : Chain
        The wire.
    s : IntArray, shape (n,)
        Indices of the clamps' sliding coordinates.
    element : IntArray, shape (n,)
        Element in which each clamp is: discrete state.
    """

    wire: Chain
    s: IntArray
    element: IntArray

    def value(self, t: float, z: FloatArray) -> FloatArray:
        """Return the heights [m]."""
        return self.wire.evaluate(z, z[self.s], self.element).r[:, 2]

    def columns(self) -> IntArray:
        """Return the vertical coordinates of the element, then the sliding coordinate."""
        ends = np.concatenate((self.wire.nodes[self.element], self.wire.nodes[self.element + 1]), axis=1)
        return np.concatenate((ends[:, 2::3], self.s[:, None]), axis=1)

    def gradient(self, t: float, z: FloatArray) -> FloatArray:
        """Return N and the slope."""
        point = self.wire.evaluate(z, z[self.s], self.element)
        return np.concatenate((point.N, point.r1[:, 2:]), axis=1)

    def relocate(self, z: FloatArray) -> WireHeight | None:
        """Return the measure in the elements that fit z, or None."""
        element = self.wire.relocate(z[self.s], self.element)
        return None if np.array_equal(element, self.element) else replace(self, element=element)


@dataclass(frozen=True)
class DropperForce:
    """T_md - G of eq. (23): what an upper cable carries besides the dropper that will hang there.

    Parameters
    ----------
    force : IntArray, shape (n,)
        Indices of the vertical multipliers at the messenger: the pull of the wire on the dropper, T_md [N].
    top : IntArray, shape (n, 3)
        Indices of the coordinates of P_md.
    bottom : FloatArray, shape (n, 3)
        Coordinates of P_cd found in the first step [m].
    rhoA : float
        Mass of the dropper per length [kg/m].
    mass : FloatArray, shape (n,)
        Mass of the clamps [kg].
    g, ramp
        Gravity [m/s^2] and its ramp.

    Notes
    -----
    The weight G = g (rhoA |r_md - r_cd| + mass) varies with the distance of the two points; that of a guided
    dropper is its height, a frictionless one leans.
    """

    force: IntArray
    top: IntArray
    bottom: FloatArray
    rhoA: float
    mass: FloatArray
    g: float
    ramp: Ramp

    def value(self, t: float, z: FloatArray) -> FloatArray:
        """Return T_md - G [N]."""
        length = np.linalg.norm(z[self.top] - self.bottom, axis=1)
        return z[self.force] - self.g * self.ramp(t) * (self.rhoA * length + self.mass)

    def columns(self) -> IntArray:
        """Return force and upper end."""
        return np.concatenate((self.force[:, None], self.top), axis=1)

    def gradient(self, t: float, z: FloatArray) -> FloatArray:
        """Return 1 and -g rhoA times the dropper's direction."""
        d = z[self.top] - self.bottom
        along = d / np.linalg.norm(d, axis=1)[:, None]
        by_top = -self.g * self.ramp(t) * self.rhoA * along
        return np.concatenate((np.ones((self.force.size, 1)), by_top), axis=1)

    def relocate(self, z: FloatArray) -> None:
        """Return None: there is no discrete state."""
        return


@dataclass(frozen=True)
class HungForce:
    """T_md - G of eq. (23) where the dropper is nothing but a force; see `DropperForce`.

    Parameters
    ----------
    force : IntArray, shape (n,)
        Indices of the vertical forces of the wire on what hangs there, T_md [N].
    top : WireHeight
        The height of the wire there.
    bottom, rhoA, mass, g
        As in `DropperForce`.
    """

    force: IntArray
    top: WireHeight
    bottom: FloatArray
    rhoA: float
    mass: FloatArray
    g: float

    def value(self, t: float, z: FloatArray) -> FloatArray:
        """Return T_md - G [N]."""
        return z[self.force] - self.g * (self.rhoA * (self.top.value(t, z) - self.bottom) + self.mass)

    def columns(self) -> IntArray:
        """Return force, then what the height depends on."""
        return np.concatenate((self.force[:, None], self.top.columns()), axis=1)

    def gradient(self, t: float, z: FloatArray) -> FloatArray:
        """Return 1 and -g rhoA times the gradient of the height."""
        by_height = -self.g * self.rhoA * self.top.gradient(t, z)
        return np.concatenate((np.ones((self.force.size, 1)), by_height), axis=1)

    def relocate(self, z: FloatArray) -> HungForce | None:
        """Return the measure in the elements that fit z, or None."""
        top = self.top.relocate(z)
        return None if top is None else replace(self, top=top)
