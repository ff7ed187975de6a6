"""What every method of this package ends with: the shapes of both wires and the lengths of everything."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from catenaria.formfinding.finite_elements import beam
from catenaria.formfinding.finite_elements.dropper import Bars
from catenaria.formfinding.finite_elements.rest import LineState
from catenaria.formfinding.finite_elements.wire import WireMesh

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class WireShape:
    """A wire in equilibrium.

    Attributes
    ----------
    mesh : WireMesh
        The wire.
    q : FloatArray, shape (n_nodes, 3)
        x, z [m] and angle [rad] of every node.
    unstressed : FloatArray, shape (n_nodes - 1,)
        Unstressed lengths of the elements [m].
    """

    mesh: WireMesh
    q: FloatArray
    unstressed: FloatArray

    @property
    def element_q(self) -> FloatArray:
        """Coordinates of every element, shape (n_nodes - 1, 6)."""
        return np.hstack((self.q[:-1], self.q[1:]))

    @property
    def s(self) -> FloatArray:
        """Material coordinates of the nodes [m]."""
        return np.concatenate(([0.0], np.cumsum(self.unstressed)))

    @property
    def nodal_force(self) -> FloatArray:
        """Forces and moments that hold the nodes, shape (n_nodes, 3): zero but at joints and ends."""
        f = beam.force(self.element_q, self.unstressed, self.mesh.section)
        total = np.zeros_like(self.q)
        total[:-1] += f[:, :3]
        total[1:] += f[:, 3:]
        return total


@dataclass(frozen=True)
class Found:
    """A line in the wanted form.

    Attributes
    ----------
    contact, messenger : WireShape
        The wires.
    bars : Bars
        What droppers are made of.
    unstressed : FloatArray, shape (n,)
        Their unstressed lengths [m].
    how : str
        In words, why the search ended.
    rounds, iterations, solves : int
        Steps of the method itself; Newton iterations in all; computed states of equilibrium.
    """

    contact: WireShape
    messenger: WireShape
    bars: Bars
    unstressed: FloatArray
    how: str
    rounds: int
    iterations: int
    solves: int

    @property
    def length(self) -> FloatArray:
        """Lengths of the droppers [m]."""
        return self.messenger.q[self.messenger.mesh.clamp, 1] - self.contact.q[self.contact.mesh.clamp, 1]

    @property
    def foot_force(self) -> FloatArray:
        """Forces with which droppers and their clamps lift the contact wire [N]."""
        return -self.bars.loads(self.length, self.unstressed)[0]

    @property
    def top_force(self) -> FloatArray:
        """Forces with which droppers and their clamps pull at the messenger [N]."""
        return self.bars.loads(self.length, self.unstressed)[1]


def found_state(state: LineState, how: str, rounds: int, solves: int) -> Found:
    """Return what a line at rest amounts to."""
    wires = state.system.contact, state.system.messenger
    parts = zip(wires, state.system.parts(state.y), strict=True)
    contact, messenger = (WireShape(wire.mesh, wire.coordinates(y), wire.unstressed(y)) for wire, y in parts)
    return Found(
        contact, messenger, state.system.bars, state.unstressed, how, rounds, state.iterations, solves
    )
