"""The equations of the elastic catenary for all bays of a wire, solved together by Newton's method."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import solve_banded  # pyright: ignore[reportUnknownVariableType]

from catenaria.catenary.green_bar import stretch
from catenaria.errors import NotConvergedError
from catenaria.formfinding.strings.at_rest import LineAtRest
from catenaria.formfinding.strings.axial_law import tangent_law
from catenaria.formfinding.strings.bays import Bays, with_tails
from catenaria.formfinding.strings.method import Solved
from catenaria.formfinding.strings.task import Joints, StringLine, StringWire

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]
_Put = Callable[[IntArray, IntArray, FloatArray | float], None]

NEGLECTS = "bending; the axial law is linear about the prescribed tension, which costs less than 0.1 um"

_BAND = 7  # unknowns of a bay and its neighbours
_ENOUGH = 1e-11  # Newton's last correction in metres, and of forces in parts of the tension
_MOST = 50


def find_rest(task: StringLine) -> Solved:
    r"""Find both strings at rest.

    Parameters
    ----------
    task : StringLine
        What was asked for.

    Notes
    -----
    The unknowns of bay k are H and V behind its start, its unstressed length L and the height z at its end,
    the equations that it reaches its end, that H (past a dropper) or the tension (past a support without
    friction) goes on, and that the joint has its height or, on the messenger, the dropper's force:

    .. math:: \Delta x(H,V,L) = h,\quad \Delta z(H,V,L) = z_{k} - z_{k-1},\quad
              V_{k+1} = V_k + wL_k + P_k(z_k).

    P is linear in the dropper's length but for its stretch, so that Newton's matrix is banded and exact. The
    tension is prescribed at one end.

    References
    ----------
    H.M. Irvine, Cable Structures (1981), section 1.4. The method is that of Lopez-Garcia et al., [21] of Yang
    et al. 2017, in our reconstruction: the original was not available.
    """
    joints = task.contact.joints(task.x)
    z = np.empty_like(joints.x)
    z[joints.support], z[joints.clamp] = task.contact.support_z, task.height
    below, first = _newton(_Equations(task.contact, joints, z, None))
    contact = with_tails(task.contact, joints, below)
    force = contact.force[contact.clamp, 2]

    joints = task.messenger.joints(task.x)
    z = np.interp(joints.x, task.messenger.support_x, task.messenger.support_z)
    above, second = _newton(_Equations(task.messenger, joints, z, (task, force)))
    messenger = with_tails(task.messenger, joints, above)
    unstressed = task.unstressed(above.z[joints.clamp] - task.height, force)
    unknowns = 8 * (joints.x.size - 1)
    return Solved(LineAtRest(contact, messenger, unstressed), first + second, unknowns)


class Catenary(NamedTuple):
    """Reaches dx, dz of an elastic catenary, and their derivatives by H, V, L."""

    dx: FloatArray
    dz: FloatArray
    dx_u: tuple[FloatArray, FloatArray, FloatArray]
    dz_u: tuple[FloatArray, FloatArray, FloatArray]


def elastic_catenary(
    H: FloatArray, V: FloatArray, L: FloatArray, w: float, law: tuple[float, float]
) -> Catenary:
    r"""Return how far elastic catenaries reach.

    Parameters
    ----------
    H, V : FloatArray, shape (n,)
        Force along the track, and upwards at the start, of what follows on what comes before [N].
    L : FloatArray, shape (n,)
        Unstressed lengths [m].
    w : float
        Weight per unstressed length [N/m].
    law : tuple of float
        c and E of the stretch c + T/E; (1, EA) is Hooke's law.

    Notes
    -----
    With V_j = V + w L and :math:`T=\sqrt{H^2+V^2}` at both ends,

    .. math:: \Delta x = H\left(\frac cw\left(\operatorname{arsinh}\frac{V_j}H
              -\operatorname{arsinh}\frac VH\right)+\frac LE\right),\quad
              \Delta z = \frac cw(T_j-T_i)+\frac{L(V+V_j)}{2E}.

    Examples
    --------
    A level span of 65 m under 15 kN and 15 N/m without stretch: L = 2 (H/w) sinh(w h/(2 H)).

    >>> one = np.ones(1)
    >>> L = 2e3 * np.sinh(65.0 / 2e3) * one
    >>> reach = elastic_catenary(15e3 * one, -7.5 * L, L, 15.0, (1.0, np.inf))
    >>> round(float(reach.dx[0]), 9), round(float(reach.dz[0]), 9)
    (65.0, 0.0)
    """
    c, E = law
    V_j = V + w * L
    T_i, T_j = np.hypot(H, V), np.hypot(H, V_j)
    dx = H * (c / w * (np.arcsinh(V_j / H) - np.arcsinh(V / H)) + L / E)
    dz = c * L * (V + V_j) / (T_i + T_j) + 0.5 * L * (V + V_j) / E
    sine, cosine = V_j / T_j - V / T_i, H / T_j - H / T_i
    dx_u = dx / H - c / w * sine, c / w * cosine, H * (c / T_j + 1.0 / E)
    dz_u = c / w * cosine, c / w * sine + L / E, V_j * (c / T_j + 1.0 / E)
    return Catenary(dx, dz, dx_u, dz_u)


class _Equations:
    """Residual and banded matrix of one wire; unknowns and equations stand bay by bay in fours."""

    def __init__(
        self,
        wire: StringWire,
        joints: Joints,
        z: FloatArray,
        hanging: tuple[StringLine, FloatArray] | None,
    ) -> None:
        self.wire, self.z, self.hanging = wire, z, hanging
        self.h, self.law = np.diff(joints.x), tangent_law(wire.tension, wire.EA)
        n = self.h.size
        self.clamp = joints.clamp - 1  # numbers of the bays that end at droppers
        self.is_support = np.zeros(n, dtype=np.bool_)
        self.is_support[joints.support[1:] - 1] = True
        self.bay = 4 * np.arange(n)

    def start(self) -> FloatArray:
        """Return a straight wire."""
        u = np.zeros((self.h.size, 4))
        u[:, 0] = self.wire.tension
        u[:, 2] = self.h / float(stretch(self.wire.tension, self.wire.EA))
        u[:, 3] = self.z[1:]
        return u

    def evaluate(self, u: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the residual, shape (n, 4), and the matrix in the layout of `solve_banded`."""
        H, V, L, z = u.T
        w, bay = self.wire.w, self.bay
        reach = elastic_catenary(H, V, L, w, self.law)
        f, band = np.zeros_like(u), np.zeros((2 * _BAND + 1, u.size))

        def put(row: IntArray, column: IntArray, value: FloatArray | float) -> None:
            band[_BAND + row - column, column] = value

        f[:, 0], f[:, 1] = reach.dx - self.h, reach.dz - z
        f[0, 1] += self.z[0]
        f[1:, 1] += z[:-1]
        for i in range(3):
            put(bay, bay + i, reach.dx_u[i])
            put(bay + 1, bay + i, reach.dz_u[i])
        put(bay + 1, bay + 3, -1.0)
        put(bay[1:] + 1, bay[1:] - 1, 1.0)
        self._go_on(u, f, put)
        f[:, 3] = z - self.z[1:]
        put(bay + 3, bay + 3, 1.0)
        if self.hanging:
            task, force = self.hanging
            at = bay[self.clamp] + 3
            unstressed = task.unstressed(z[self.clamp] - task.height, force)
            load = task.load(unstressed, force)
            f[self.clamp, 3] = V[self.clamp + 1] - V[self.clamp] - w * L[self.clamp] - load
            put(at, at, -task.w * unstressed / (z[self.clamp] - task.height))
            put(at, at - 2, -1.0)
            put(at, at - 1, -w)
            put(at, at + 2, 1.0)
        return f, band

    def _go_on(self, u: FloatArray, f: FloatArray, put: _Put) -> None:
        """Fill in that H or the tension goes on from bay to bay, and the tension at the prescribed end."""
        H, V, L, _ = u.T
        w, bay, at_end = self.wire.w, self.bay, self.wire.at_end
        V_j = V + w * L
        T_i, T_j = np.hypot(H, V), np.hypot(H, V_j)
        passed = self.is_support[:-1]
        row = (bay[:-1] if at_end else bay[1:]) + 2
        inner = slice(0, -1) if at_end else slice(1, None)
        f[inner, 2] = np.where(passed, T_i[1:] - T_j[:-1], H[1:] - H[:-1])
        put(row, bay[1:], np.where(passed, H[1:] / T_i[1:], 1.0))
        put(row, bay[1:] + 1, np.where(passed, V[1:] / T_i[1:], 0.0))
        put(row, bay[:-1], -np.where(passed, H[:-1] / T_j[:-1], 1.0))
        put(row, bay[:-1] + 1, -np.where(passed, V_j[:-1] / T_j[:-1], 0.0))
        put(row, bay[:-1] + 2, -np.where(passed, w * V_j[:-1] / T_j[:-1], 0.0))
        last, up, size = (bay[-1:], V_j[-1:], T_j[-1:]) if at_end else (bay[:1], V[:1], T_i[:1])
        end = slice(-1, None) if at_end else slice(0, 1)
        f[end, 2] = size - self.wire.tension
        put(last + 2, last, H[end] / size)
        put(last + 2, last + 1, up / size)
        put(last + 2, last + 2, w * up / size if at_end else 0.0)


def _newton(equations: _Equations) -> tuple[Bays, int]:
    """Solve the equations of one wire; return its bays and the iterations."""
    u = equations.start()
    scale = np.array([equations.wire.tension, equations.wire.tension, 1.0, 1.0])
    for count in range(1, _MOST):
        f, band = equations.evaluate(u)
        step = np.asarray(solve_banded((_BAND, _BAND), band, f.ravel(), check_finite=False), dtype=np.float64)
        u = u - step.reshape(u.shape)
        if np.max(np.abs(step.reshape(u.shape)) / scale) < _ENOUGH:
            H, V, L, z = u.T.copy()
            return Bays(np.concatenate((equations.z[:1], z)), H, V, L), count
        if not np.all(np.isfinite(u)):
            break
    raise NotConvergedError(f"Newton's method did not find the {equations.wire.name} at rest", "more tension")
