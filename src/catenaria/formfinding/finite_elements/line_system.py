"""The equations of the whole line at rest for given dropper lengths: two wires, and bars between them."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from catenaria.formfinding.finite_elements.beam import Array
from catenaria.formfinding.finite_elements.dropper import Bars, bars
from catenaria.formfinding.finite_elements.sparse import Matrix, diagonal_blocks, matrix
from catenaria.formfinding.finite_elements.wire import contact_mesh, messenger_mesh
from catenaria.formfinding.finite_elements.wire_system import WireSystem
from catenaria.line import Line

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class LineSystem:
    """Unknowns and equations of a line; unknowns are those of the contact wire, then of the messenger.

    Parameters
    ----------
    contact, messenger : WireSystem
        The wires.
    bars : Bars
        The droppers.
    target : FloatArray, shape (n,)
        Wanted heights of the contact wire at the droppers [m].
    """

    contact: WireSystem
    messenger: WireSystem
    bars: Bars
    target: FloatArray

    @classmethod
    def of(cls, line: Line) -> LineSystem:
        """Return the system of a line, in which the tensions of its wires are held."""
        contact, messenger = WireSystem(contact_mesh(line)), WireSystem(messenger_mesh(line))
        return cls(contact, messenger, bars(line), np.array(line.dropper_target_height))

    def pulled(self, contact: float, messenger: float) -> LineSystem:
        """Return the system in which the travels of the wires' ends are given instead [m]."""
        wires = replace(self.contact, pull=contact), replace(self.messenger, pull=messenger)
        return LineSystem(*wires, self.bars, self.target)

    @property
    def size(self) -> int:
        """Number of unknowns."""
        return self.contact.size + self.messenger.size

    @cached_property
    def foot(self) -> NDArray[np.int64]:
        """Where the heights of the contact wire at the droppers are among the unknowns."""
        return self.contact.clamp_z

    @cached_property
    def top(self) -> NDArray[np.int64]:
        """Where the heights of the messenger at the droppers are."""
        return self.contact.size + self.messenger.clamp_z

    def parts(self, y: Array) -> tuple[Array, Array]:
        """Return the unknowns of the two wires."""
        return y[: self.contact.size], y[self.contact.size :]

    def residual(self, y: Array, unstressed: Array) -> Array:
        """Return what is missing to the equilibrium with droppers of these unstressed lengths."""
        below, above = self.bars.loads(y[self.top] - y[self.foot], unstressed)
        lower, upper = self.parts(y)
        return np.concatenate((self.contact.residual(lower, below), self.messenger.residual(upper, above)))

    def jacobian(self, y: FloatArray, unstressed: FloatArray) -> Matrix:
        """Return the derivative of the residual by the unknowns."""
        k, _ = self.bars.tension_by(y[self.top] - y[self.foot], unstressed)
        lower, upper = self.parts(y)
        wires = diagonal_blocks(self.contact.jacobian(lower), self.messenger.jacobian(upper))
        rows = np.concatenate((self.foot, self.foot, self.top, self.top))
        columns = np.concatenate((self.foot, self.top, self.foot, self.top))
        return wires + matrix(np.concatenate((k, -k, -k, k)), rows, columns, (self.size, self.size))

    def by_length(self, y: FloatArray, unstressed: FloatArray) -> FloatArray:
        """Return the derivative of the residual by the unstressed lengths, shape (size, n)."""
        _, N_l = self.bars.tension_by(y[self.top] - y[self.foot], unstressed)
        own, half = np.arange(unstressed.size), 0.5 * self.bars.weight
        full = np.zeros((self.size, unstressed.size))
        full[self.foot, own] = half - N_l
        full[self.top, own] = half + N_l
        return full
