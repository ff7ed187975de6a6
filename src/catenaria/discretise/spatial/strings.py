"""All wires of a line as strings with small slopes: where they are, and what they and droppers exert."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from catenaria.catenary.green_bar import stretch
from catenaria.discretise.spatial.layout import Layout
from catenaria.discretise.spatial.network import Network
from catenaria.errors import InconsistentInputError

FloatArray = NDArray[np.float64]

UP = np.array([0.0, 0.0, 1.0])
_SHARE = 0.25  # of the next bay, at most, in which the rounding of a kink decays
_SHORTEST = 1e-3  # of bays [m]


@dataclass(frozen=True)
class Strings:
    r"""A state of all wires; what is derived from it is derived once.

    Attributes
    ----------
    net, layout : Network, Layout
        What hangs.
    loaded : bool
        Whether there are weights, prescribed lifts, and droppers that hold wires at wanted heights.
    r : FloatArray, shape (n_knots, 3)
        Where knots are [m].
    H : FloatArray, shape (n_bays,)
        Horizontal tensions [N].
    raising : FloatArray, shape (n_droppers,)
        Vertical forces of droppers on lower wires, weights not counted [N].
    arm : FloatArray, shape (n_holds,)
        Force densities of arms with given hinges, positive in tension, NaN while they are not known [N/m].
    rounding : FloatArray, shape (n_stations, 3)
        Where wires are, beside the kinks of their strings [m].

    Notes
    -----
    With the length :math:`\sigma` in plan, a bay of weight w per such length is the parabola

    .. math:: r = r_k + \frac{r_{k+1} - r_k}{b}\,\sigma - \frac{w}{2 H}\,\sigma\,(b - \sigma)\, e_z .

    A jump J of dr/dsigma at a kink is rounded by bending within l = sqrt(EJ/H), where the wire is J l/2
    beside the kink (see `TautWire`). Wires are hinged at their ends.
    """

    net: Network
    layout: Layout
    loaded: bool
    r: FloatArray
    H: FloatArray
    raising: FloatArray
    arm: FloatArray
    rounding: FloatArray

    @property
    def g(self) -> float:
        """Gravity [m/s^2]."""
        return self.layout.g if self.loaded else 0.0

    @cached_property
    def at(self) -> FloatArray:
        """Where strings have their stations [m], shape (n_stations, 3); tied ends are on the host itself."""
        at = self.r[self.net.knot]
        at[self.net.tied] += self.rounding[self.net.tie]
        return at

    @cached_property
    def chord(self) -> FloatArray:
        """From the start to the end of each bay [m], shape (n_bays, 3)."""
        return self.at[self.net.bay + 1] - self.at[self.net.bay]

    @cached_property
    def b(self) -> FloatArray:
        """Lengths of the bays in plan [m], shape (n_bays,)."""
        b = np.hypot(self.chord[:, 0], self.chord[:, 1])
        short = np.flatnonzero(b < _SHORTEST)
        if short.size:
            name = self.layout.wires[self.net.bay_wire[short[0]]].name
            near = self.at[self.net.bay[short[0]]]
            raise InconsistentInputError(
                f"{name}: two clamps, supports or ends are at the same place, near x = {near[0]:.6g} m, "
                f"y = {near[1]:.6g} m"
            )
        return b

    @cached_property
    def w(self) -> FloatArray:
        """Weights per length in plan [N/m], shape (n_bays,)."""
        weight = np.array([wire.section.rhoA for wire in self.layout.wires])[self.net.bay_wire] * self.g
        return weight / stretch(self.H / self.EA, 1.0) * np.hypot(1.0, self.chord[:, 2] / self.b)

    @cached_property
    def EA(self) -> FloatArray:  # noqa: N802, the symbol of the field
        """Axial stiffness of every bay [N], shape (n_bays,)."""
        return np.array([wire.section.EA for wire in self.layout.wires])[self.net.bay_wire]

    @cached_property
    def slopes(self) -> tuple[FloatArray, FloatArray]:
        """dr/dsigma where bays begin and where they end, shape (n_bays, 3) each."""
        chord, half = self.chord / self.b[:, None], (0.5 * self.w * self.b / self.H)[:, None] * UP
        return chord - half, chord + half

    @cached_property
    def force(self) -> FloatArray:
        """Forces of strings on their stations [N], shape (n_stations, 3)."""
        (start, end), force = self.slopes, np.zeros_like(self.at)
        force[self.net.bay] += self.H[:, None] * start
        force[self.net.bay + 1] -= self.H[:, None] * end
        return force

    @cached_property
    def jump(self) -> FloatArray:
        """Jumps of dr/dsigma at the stations, none at ends, shape (n_stations, 3)."""
        (start, end), jump = self.slopes, np.zeros_like(self.at)
        jump[self.net.bay] += start
        jump[self.net.bay + 1] -= end
        jump[self.net.first[:-1]] = jump[self.net.first[1:] - 1] = 0.0
        return jump

    @cached_property
    def layer(self) -> FloatArray:
        """The l of every station [m], cut where the next one is too near for a layer of its own."""
        EJ = np.array([wire.section.EJ for wire in self.layout.wires])[self.net.bay_wire]
        length = np.minimum(np.sqrt(EJ / self.H), _SHARE * self.b)
        layer = np.full(self.net.knot.size, np.inf)
        layer[self.net.bay] = length
        layer[self.net.bay + 1] = np.minimum(layer[self.net.bay + 1], length)
        return layer

    @cached_property
    def wire_at(self) -> FloatArray:
        """Where wires are at the stations [m], shape (n_stations, 3)."""
        return self.at + self.rounding

    @cached_property
    def dropper(self) -> FloatArray:
        """From lower to upper clamps [m], shape (n_droppers, 3)."""
        return self.wire_at[self.net.upper] - self.wire_at[self.net.lower]

    @cached_property
    def dropper_density(self) -> FloatArray:
        """Force densities of droppers [N/m], none where a dropper has no height."""
        rise = self.dropper[:, 2]
        return np.divide(self.raising, rise, out=np.zeros_like(rise), where=rise > 0.0)

    @cached_property
    def weights(self) -> FloatArray:
        """Weights of droppers and masses on the knots [N], shape (n_knots,)."""
        droppers, masses, knot = self.layout.droppers, self.layout.masses, self.net.knot
        half = 0.5 * droppers.rhoA * np.linalg.norm(self.dropper, axis=1)
        mass = np.concatenate((half + droppers.mass_bottom, half + droppers.mass_top, masses.mass))
        station = np.concatenate((self.net.lower, self.net.upper, self.net.mass))
        return np.asarray(self.g * np.bincount(knot[station], mass, self.r.shape[0]), dtype=np.float64)

    @cached_property
    def hold_force(self) -> FloatArray:
        """Forces of wires, with all that hangs at the place, on supports [N], shape (n_holds, 3)."""
        net, pull = self.net, self.dropper_density[:, None] * self.dropper
        total = net.sum_at_knots(np.arange(net.knot.size), self.force)
        total += net.sum_at_knots(net.lower, pull) - net.sum_at_knots(net.upper, pull)
        total[:, 2] -= self.weights
        return total[net.knot[net.hold]]
