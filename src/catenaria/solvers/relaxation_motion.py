"""The fictitious motion of dynamic relaxation: leapfrog, the frequency it shows, two ways to damp it.

The time step is 1: a velocity is a displacement per step, a mass has the unit of a stiffness and a frequency
is in radians per step.
"""

from __future__ import annotations

from math import sqrt

import numpy as np

from catenaria.solvers.problem import FloatArray

STABILITY_LIMIT = 4.0  # omega^2 beyond which leapfrog amplifies (Courant, Friedrichs & Lewy 1928)
STRONGEST_DAMPING = 2.0  # beyond it a step would turn velocities round


class Motion:
    """Position and, half a step behind it, velocity: work arrays that every step overwrites.

    Parameters
    ----------
    y : FloatArray, shape (n,)
        Where it starts from rest; it is not changed.
    mass : FloatArray, shape (n,)
        Fictitious masses, positive.

    Attributes
    ----------
    y, velocity, mass : FloatArray, shape (n,)
        State.
    omega2 : float
        Square of the frequency that the last step showed, 0 after a rest.
    twice_energy : float
        v'Mv, 0 at rest.
    """

    def __init__(self, y: FloatArray, mass: FloatArray) -> None:
        self.y = np.array(y, dtype=np.float64)
        self.velocity, self._force, self._work, self._momentum = np.zeros((4, self.y.size))
        self.omega2 = self.twice_energy = 0.0
        self.change_mass(mass)

    def change_mass(self, mass: FloatArray) -> None:
        """Go on with other masses at the same velocity."""
        self.mass, self._inverse_mass = mass, 1.0 / mass
        self._update_energy()

    def observe(self, force: FloatArray) -> None:
        """Take note of f(y) and of the frequency that its change since the last step shows.

        Notes
        -----
        A step changes f by df = K v, with the mean stiffness K of its way, so that

            omega^2 = v'df / v'Mv

        is a Rayleigh quotient: never above the highest eigenvalue of M^{-1} K, and the lowest one when only
        the slowest mode still moves. Underwood 1983 forms it with displacements and the diagonal stiffness
        df_i / v_i; with velocities that matrix cancels and nothing is approximated.
        """
        np.subtract(force, self._force, out=self._work)
        np.copyto(self._force, force)
        self.omega2 = float(self.velocity.dot(self._work)) / self.twice_energy if self.twice_energy else 0.0

    def is_unstable(self, negligible: FloatArray) -> bool:
        """Say whether the last step showed a frequency that leapfrog amplifies.

        Parameters
        ----------
        negligible : FloatArray, shape (n,)
            Changes of force so small that they may be round-off and show nothing.
        """
        if self.omega2 <= STABILITY_LIMIT:
            return False
        excess = (self.omega2 - STABILITY_LIMIT) * self.twice_energy
        return excess > float(np.abs(self.velocity).dot(negligible))

    def kick(self, keep: float, gain: float) -> None:
        """Replace v by keep v - gain M^{-1} f; from rest by the half step -M^{-1} f / 2."""
        np.multiply(self._force, self._inverse_mass, out=self._work)
        self._work *= gain if self.twice_energy else 0.5
        self.velocity *= keep
        self.velocity -= self._work
        self._update_energy()

    def drift(self) -> None:
        """Move by one step."""
        self.y += self.velocity

    def stop_half_a_step_back(self) -> None:
        """After a kick that kept all velocity, undo it and rest in the middle of the step before."""
        self.velocity += self._work
        self.velocity *= 0.5
        self.y -= self.velocity
        self.stop()

    def stop(self) -> None:
        """Come to rest at y."""
        self.velocity[:] = 0.0
        self.omega2 = self.twice_energy = 0.0

    def _update_energy(self) -> None:
        np.multiply(self.velocity, self.mass, out=self._momentum)
        self.twice_energy = float(self.velocity.dot(self._momentum))


def advance_kinetically(motion: Motion) -> float | None:
    """Make an undamped step; where the kinetic energy has passed a peak, rest at the peak instead.

    Returns
    -------
    float or None
        Kinetic energy of the peak.

    Notes
    -----
    The energies belong to the middles of steps. If this one is below the last one, the last one is the peak
    and belongs half a step before y (Barnes 1999, who first makes this step too and goes back by
    3/2 dt v + dt^2 f/(2 m), to the same place).
    """
    before = motion.twice_energy
    motion.kick(1.0, 1.0)
    if motion.twice_energy >= before:
        motion.drift()
        return None
    motion.stop_half_a_step_back()
    return 0.5 * before


def advance_viscously(motion: Motion) -> None:
    """Make a step of M y'' + c M y' + f = 0 with the critical damping c = 2 omega of the observed frequency.

    Notes
    -----
    v+ = ((2 - c) v- - 2 f/m) / (2 + c), the central difference of Underwood 1983; stable for every c > 0
    where the undamped motion is. A quotient below zero, softening, asks for no damping.
    """
    c = min(2.0 * sqrt(max(motion.omega2, 0.0)), STRONGEST_DAMPING)
    motion.kick((2.0 - c) / (2.0 + c), 2.0 / (2.0 + c))
    motion.drift()
