"""The fictitious motion of dynamic relaxation: leapfrog, its natural frequency, two ways to damp it.

The time step is 1, so that a velocity is a displacement per step, a mass has the unit of a stiffness and a
frequency is in radians per step.
"""

from __future__ import annotations

from math import sqrt

import numpy as np

from catenaria.solvers.problem import FloatArray

STABILITY_LIMIT = 4.0  # square of the highest frequency of a stable leapfrog motion (Courant et al. 1928)
STRONGEST_DAMPING = 2.0  # beyond this damping would turn velocities round


class Motion:
    """Position and, half a step behind it, velocity; both are work arrays that each step overwrites.

    Parameters
    ----------
    y : FloatArray, shape (n,)
        Where it starts from rest; it is not changed.
    mass : FloatArray, shape (n,)
        Fictitious masses, all positive.

    Attributes
    ----------
    omega2 : float
        Square of the frequency that the last step showed, 0 after a rest.
    twice_energy : float
        v'Mv; 0 at rest.
    """

    def __init__(self, y: FloatArray, mass: FloatArray) -> None:
        self.y = np.array(y, dtype=np.float64)
        self.velocity = np.zeros_like(self.y)
        self.mass, self._inverse_mass = mass, 1.0 / mass
        self.omega2 = self.twice_energy = 0.0
        self._force, self._work, self._momentum = np.zeros((3, self.y.size))

    def observe(self, force: FloatArray) -> None:
        """Take note of the force at y and of the frequency that its change shows.

        Notes
        -----
        A step changes the force by df = K v with the mean stiffness K on its way, so that

            omega^2 = v'df / v'Mv

        is a Rayleigh quotient of K: never above the highest eigenvalue of M^{-1} K, and near the lowest one
        when only the slowest mode still moves. Underwood 1983, eq. (5.27) forms it with the diagonal local
        stiffness df_i / v_i and the displacements; with the velocities it needs no approximation.
        """
        np.subtract(force, self._force, out=self._work)
        np.copyto(self._force, force)
        self.omega2 = float(self.velocity.dot(self._work)) / self.twice_energy if self.twice_energy else 0.0

    def is_unstable(self, negligible: FloatArray) -> bool:
        """Say whether the last step showed a frequency that leapfrog amplifies.

        Parameters
        ----------
        negligible : FloatArray, shape (n,)
            Changes of force that may be round-off and show nothing.
        """
        if self.omega2 <= STABILITY_LIMIT:
            return False
        excess = (self.omega2 - STABILITY_LIMIT) * self.twice_energy
        return excess > float(np.abs(self.velocity).dot(negligible))

    def kick(self, keep: float, gain: float) -> None:
        """Replace v by keep v - gain M^{-1} f; from rest by half a step's worth of that."""
        np.multiply(self._force, self._inverse_mass, out=self._work)
        self._work *= gain if self.twice_energy else 0.5
        self.velocity *= keep
        self.velocity -= self._work
        self._update_energy()

    def drift(self) -> None:
        """Move by one step."""
        self.y += self.velocity

    def stop_half_a_step_back(self) -> None:
        """Come to rest where the motion was half a step before y, at the velocity before the last kick."""
        self.velocity += self._work
        self.velocity *= 0.5
        self.y -= self.velocity
        self.stop()

    def stop(self) -> None:
        """Come to rest at y."""
        self.velocity[:] = 0.0
        self.omega2 = self.twice_energy = 0.0

    def change_mass(self, mass: FloatArray) -> None:
        """Go on with other masses at the same velocity."""
        self.mass, self._inverse_mass = mass, 1.0 / mass
        self._update_energy()

    def _update_energy(self) -> None:
        np.multiply(self.velocity, self.mass, out=self._momentum)
        self.twice_energy = float(self.velocity.dot(self._momentum))


def advance_with_kinetic_damping(motion: Motion) -> float | None:
    """Make a step; where the kinetic energy has passed a peak, stop at the peak instead.

    Returns
    -------
    float or None
        Kinetic energy of a peak.

    Notes
    -----
    The energies belong to the middles of steps. If the present one is below the last one, the peak is taken
    to be where the last one belongs, half a step before y (Barnes 1999: x - 3/2 dt v + dt^2 f/(2 m) from the
    end of the present step, which is not made here).
    """
    before = motion.twice_energy
    motion.kick(1.0, 1.0)
    if motion.twice_energy < before:
        motion.stop_half_a_step_back()
        return 0.5 * before
    motion.drift()
    return None


def advance_with_viscous_damping(motion: Motion) -> None:
    """Make a step of M y'' + c M y' = -f with the critical damping c = 2 omega of the observed frequency.

    Notes
    -----
    v+ = ((2 - c) v- - 2 f/m) / (2 + c) (Underwood 1983, eq. 5.6), stable for every c > 0 where the undamped
    motion is.
    """
    c = min(2.0 * sqrt(max(motion.omega2, 0.0)), STRONGEST_DAMPING)
    motion.kick((2.0 - c) / (2.0 + c), 2.0 / (2.0 + c))
    motion.drift()
