r"""The equations of one wire at rest: equilibrium of its nodes, joints that slide, one prescribed tension.

Clamps and supports stay where they are along the track while the wire runs through them. Therefore the
unstressed length of every segment between two joints is unknown, and the row of its partner says that the
joint takes no force along the track (clamp) or along the wire (support).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from catenaria.formfinding.finite_elements import beam
from catenaria.formfinding.finite_elements.sparse import Matrix, matrix
from catenaria.formfinding.finite_elements.wire import WireMesh

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]
BoolArray = NDArray[np.bool_]
Array = beam.Array


@dataclass(frozen=True)
class WireSystem:
    """Unknowns and equations of a wire.

    Parameters
    ----------
    mesh : WireMesh
        The wire.
    feet : FloatArray, shape (n,), optional
        Heights at which the clamps are held [m]; without, they carry given forces.
    pull : float, optional
        Travel of the ends [m], if it is given instead of the tension.

    Notes
    -----
    Unknowns, in this order: x of nodes between joints, z of nodes that are not held, all angles, unstressed
    lengths of the segments, travel of the ends.
    """

    mesh: WireMesh
    feet: FloatArray | None = None
    pull: float | None = None

    @cached_property
    def free(self) -> IntArray:
        """Coordinates that are unknown, as indices into (x, z, theta) of all nodes, which are interleaved."""
        n = self.mesh.x.size
        fixed = np.zeros((n, 3), dtype=np.bool_)
        fixed[self.mesh.knots, 0] = True
        fixed[self.mesh.support, 1] = True
        fixed[[0, -1], 1] = True
        if self.feet is not None:
            fixed[self.mesh.clamp, 1] = True
        return np.concatenate([np.flatnonzero(~fixed[:, k]) * 3 + k for k in range(3)])

    @property
    def size(self) -> int:
        """Number of unknowns."""
        return self.free.size + self.mesh.joint.size + 2

    @property
    def lengths(self) -> slice:
        """Where the unstressed lengths of the segments are among the unknowns."""
        return slice(self.free.size, self.size - 1)

    @cached_property
    def clamp_z(self) -> IntArray:
        """Where the heights of the clamps are among the unknowns; only if they are not held."""
        place = np.full(3 * self.mesh.x.size, -1)
        place[self.free] = np.arange(self.free.size)
        return place[3 * self.mesh.clamp + 1]

    def coordinates(self, y: Array) -> Array:
        """Return x, z, theta of every node, shape (n_nodes, 3)."""
        mesh = self.mesh
        q = np.zeros((mesh.x.size, 3), dtype=y.dtype)
        q[:, 0] = mesh.x
        q[[0, -1], 0] += y[-1] * np.array([-1.0, 1.0])
        q[mesh.support, 1] = mesh.height
        q[[0, -1], 1] = mesh.height
        if self.feet is not None:
            q[mesh.clamp, 1] = self.feet
        q.reshape(-1)[self.free] = y[: self.free.size]
        return q

    def unstressed(self, y: Array) -> Array:
        """Return the unstressed length of every element [m]."""
        return self.mesh.fraction * y[self.lengths][self.mesh.segment]

    def nodal_forces(self, y: Array) -> Array:
        """Return the forces and moments that hold the nodes in this shape, shape (n_nodes, 3)."""
        q = self.coordinates(y)
        f = beam.force(np.hstack((q[:-1], q[1:])), self.unstressed(y), self.mesh.section)
        total = np.zeros_like(q)
        total[:-1] += f[:, :3]
        total[1:] += f[:, 3:]
        return total

    def tension(self, y: Array) -> Array:
        """Return the force with which the measured end's device reacts [N]."""
        f = self.nodal_forces(y)[-1 if self.mesh.at_end else 0]
        return np.sqrt(f[0] ** 2 + f[1] ** 2)

    def residual(self, y: Array, load: Array) -> Array:
        """Return what is missing to the equilibrium.

        Parameters
        ----------
        y : array, shape (size,)
            Unknowns.
        load : array, shape (n,)
            Forces of the droppers on the wire, positive downwards [N]; idle where clamps are held.
        """
        mesh, f = self.mesh, self.nodal_forces(y)
        f[mesh.clamp, 1] += load
        theta = self.coordinates(y)[mesh.support, 2]
        along = f[mesh.joint, 0]
        along[mesh.is_support] = f[mesh.support, 0] * np.cos(theta) + f[mesh.support, 1] * np.sin(theta)
        whole = np.sum(y[self.lengths]) - mesh.laid
        last = self.tension(y) - mesh.tension if self.pull is None else y[-1] - self.pull
        return np.concatenate((f.reshape(-1)[self.free], along, [whole, last]))

    def tension_gradient(self, y: FloatArray) -> FloatArray:
        """Return the derivative of the tension by the unknowns, shape (size,)."""
        free = replace(self, pull=None)
        return free.jacobian(y)[[free.size - 1]].toarray()[0]

    def jacobian(self, y: FloatArray) -> Matrix:
        """Return the derivative of the residual by the unknowns."""
        f = self.nodal_forces(y)
        return self._rows(y, f) @ self._stiffness(y) @ self._columns + self._turning(y, f)

    @cached_property
    def _elements(self) -> tuple[IntArray, IntArray, IntArray, IntArray]:
        """Rows and columns of every entry of the element matrices, by coordinates and by lengths."""
        count = self.mesh.x.size - 1
        own = 3 * np.arange(count)[:, None] + np.arange(6)
        rows, columns = np.repeat(own[:, :, None], 6, axis=2), np.repeat(own[:, None, :], 6, axis=1)
        lengths = np.repeat(3 * (count + 1) + np.arange(count)[:, None], 6, axis=1)
        return rows.ravel(), columns.ravel(), own.ravel(), lengths.ravel()

    def _stiffness(self, y: FloatArray) -> Matrix:
        """Return the derivatives of all nodal forces by all coordinates and element lengths."""
        q, count = self.coordinates(y), self.mesh.x.size - 1
        K, f_L = beam.tangent(np.hstack((q[:-1], q[1:])), self.unstressed(y), self.mesh.section)
        rows, columns, length_rows, lengths = self._elements
        return matrix(
            np.concatenate((K.ravel(), f_L.ravel())),
            np.concatenate((rows, length_rows)),
            np.concatenate((columns, lengths)),
            (3 * (count + 1), 3 * (count + 1) + count),
        )

    @cached_property
    def _columns(self) -> Matrix:
        """Derivatives of coordinates and element lengths by the unknowns."""
        n, count = 3 * self.mesh.x.size, self.mesh.x.size - 1
        own = np.arange(self.free.size)
        rows = np.concatenate((self.free, [0, n - 3], n + np.arange(count)))
        columns = np.concatenate((own, [self.size - 1] * 2, self.free.size + self.mesh.segment))
        values = np.concatenate((np.ones(own.size), [-1.0, 1.0], self.mesh.fraction))
        return matrix(values, rows, columns, (n + count, self.size))

    def _rows(self, y: FloatArray, f: FloatArray) -> Matrix:
        """Return the derivatives of the rows by the nodal forces."""
        mesh, first = self.mesh, self.free.size
        theta = self.coordinates(y)[mesh.joint, 2] * mesh.is_support
        joint_rows, own = first + np.arange(mesh.joint.size), np.arange(first)
        end = mesh.x.size - 1 if mesh.at_end else 0
        direction = f[end, :2] / np.linalg.norm(f[end, :2]) * (self.pull is None)
        values = np.concatenate((np.ones(first), np.cos(theta), np.sin(theta), direction))
        rows = np.concatenate((own, joint_rows, joint_rows, [self.size - 1] * 2))
        columns = np.concatenate((self.free, 3 * mesh.joint, 3 * mesh.joint + 1, [3 * end, 3 * end + 1]))
        return matrix(values, rows, columns, (self.size, 3 * mesh.x.size))

    def _turning(self, y: FloatArray, f: FloatArray) -> Matrix:
        """Return what rows depend on beside nodal forces: directions of supports, lengths, a given pull."""
        mesh = self.mesh
        theta = self.coordinates(y)[mesh.support, 2]
        turned = f[mesh.support, 1] * np.cos(theta) - f[mesh.support, 0] * np.sin(theta)
        angle = self.free.size - mesh.x.size + mesh.support  # all angles are unknown, after x and z
        rows = self.free.size + np.flatnonzero(mesh.is_support)
        segments = np.arange(self.free.size, self.size - 1)
        whole = np.full(segments.size, self.size - 2)
        return matrix(
            np.concatenate((turned, np.ones(segments.size), [float(self.pull is not None)])),
            np.concatenate((rows, whole, [self.size - 1])),
            np.concatenate((angle, segments, [self.size - 1])),
            (self.size, self.size),
        )
