"""Where a wire came to rest in one step of the method, and what the other steps need of it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.wire_alone import WireAlone
from catenaria.discretise.wire_model import WireModel
from catenaria.discretise.wire_setup import WireSetup
from catenaria.mechanics.controls.control import Controls as ControlBatch

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class Clamped:
    """A wire at rest at its droppers.

    Attributes
    ----------
    setup : WireSetup
        The wire.
    z : FloatArray
        All unknowns of the system that was solved.
    position : FloatArray, shape (n, 3)
        Where the droppers are clamped to the wire [m].
    force : FloatArray, shape (n, 3)
        Forces of the wire on droppers, clamps and guides [N].
    s : FloatArray, shape (n,)
        Material coordinates of the clamps [m].
    error : FloatArray, shape (n,)
        By how much heights [m] or forces [N] miss their targets.
    """

    setup: WireSetup
    z: FloatArray
    position: FloatArray
    force: FloatArray
    s: FloatArray
    error: FloatArray

    @classmethod
    def of_wire_alone(cls, model: WireAlone, z: FloatArray) -> Clamped:
        """Return what a wire alone is at rest with."""
        hung = model.hung
        s = z[hung.clamp_s]
        force = np.zeros((s.size, 3))
        force[:, 2] = z[model.clamp_force]
        return cls(hung.setup, z, hung.wire.evaluate(z, s).r, force, s, model.dropper_error(z))

    @property
    def height(self) -> FloatArray:
        """Heights of the wire at the droppers [m]."""
        return self.position[:, 2]

    @property
    def lift(self) -> FloatArray:
        """Forces of droppers and clamps on the wire, upwards [N]; T_cd on the contact wire."""
        return -self.force[:, 2]

    @property
    def on_wire(self) -> FloatArray:
        """Forces of droppers and clamps on the wire, shape (n, 3), without those of guides [N]."""
        along = 0.0 if self.setup.droppers.guided else 1.0
        return -self.force * np.array([along, 1.0, 1.0])


@dataclass(frozen=True)
class Rest:
    """Where one step ended.

    Attributes
    ----------
    model : WireModel
        What was brought to rest.
    t : float
        Time, after all ramps [s].
    z : FloatArray
        Unknowns.
    bands : tuple of float
        Within what the tension control and the dropper controls meet their targets [N or m].
    """

    model: WireModel
    t: float
    z: FloatArray
    bands: tuple[float, float]

    @property
    def controls(self) -> tuple[ControlBatch, ControlBatch]:
        """The tension control and the dropper controls in the elements that fit z."""
        tension, droppers = self.model.controls(self.model.system)
        return tension.relocate(self.z) or tension, droppers.relocate(self.z) or droppers

    @property
    def clamped(self) -> Clamped:
        """The wire at its droppers."""
        model, z = self.model, self.z
        error = self.controls[1].error(self.t, z)
        force = z[model.droppers.clamp_force]
        return Clamped(model.setup, z, z[model.droppers.inner], force, z[model.clamp_s], error)
