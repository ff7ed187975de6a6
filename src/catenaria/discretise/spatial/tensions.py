"""How the horizontal tension of a string changes along the line, from the end where it is prescribed."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.spatial.strings import Strings
from catenaria.errors import InfeasibleError

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


def horizontal_tensions(strings: Strings) -> FloatArray:
    r"""Return the horizontal tensions of all bays [N].

    Raises
    ------
    InfeasibleError
        If nothing of a wire's tension is left somewhere.

    Notes
    -----
    A roller lets the tension T = H sqrt(1 + z'^2) pass but for its friction, f times the force on it; a guide
    lets the component along the track pass but for what a tied wire pulls there. Changes are those of the
    given state, so that errors of H shrink with the squares of slopes.
    """
    net, layout = strings.net, strings.layout
    change = np.zeros(net.knot.size)
    change[net.inner] = _changes(strings)
    grown = np.cumsum(change)[net.bay]
    known, tension = _prescribed(strings)
    H = (tension - grown[known])[net.bay_wire] + grown
    slack = np.flatnonzero(~(H > 0.0))
    if slack.size:
        wire = layout.wires[net.bay_wire[slack[0]]]
        raise InfeasibleError(
            f"the {wire.name} is slack: nothing is left of its {wire.tension.force / 1e3:.4g} kN near "
            f"x = {strings.at[net.bay[slack[0]], 0]:.6g} m; more tension, shorter spans, lighter droppers, "
            "less friction or less tension of what is tied to it would help"
        )
    return H


def _changes(strings: Strings) -> FloatArray:
    """Return by how much H changes at the stations that are not ends [N]."""
    net, holds = strings.net, strings.layout.holds
    start, end = strings.slopes
    S0, S1, H0 = end[net.after - 1], start[net.after], strings.H[net.after - 1]
    t = net.along[net.knot]
    taken, lost = np.zeros(net.knot.size), np.zeros(net.knot.size)
    np.add.at(taken, net.tie, _along(strings.force[net.tied], t[net.tie]))
    lost[net.hold] = holds.friction * np.linalg.norm(strings.hold_force, axis=1)
    roller = np.zeros(net.knot.size, dtype=np.bool_)
    roller[net.hold[~holds.guided]] = True
    rolled = (H0 * _size(S0) + (lost - taken)[net.inner]) / _size(S1)
    guided = (H0 * _along(S0, t[net.inner]) - taken[net.inner]) / _along(S1, t[net.inner])
    return np.where(roller[net.inner], rolled, guided) - H0


def _size(slope: FloatArray) -> FloatArray:
    return np.sqrt(np.einsum("ni,ni->n", slope, slope))


def _along(vector: FloatArray, t: FloatArray) -> FloatArray:
    return np.einsum("ni,ni->n", vector, t)


def _prescribed(strings: Strings) -> tuple[IntArray, FloatArray]:
    """Return the bay of every wire at whose outer end the tension is prescribed, and its H [N]."""
    wires, (start, end) = strings.layout.wires, strings.slopes
    at_end = np.array([wire.tension.at_end for wire in wires])
    force = np.array([wire.tension.force for wire in wires])
    bays = strings.net.bays
    bay = np.array([bays(k).stop - 1 if last else bays(k).start for k, last in enumerate(at_end)])
    slope = np.where(at_end[:, None], end[bay], start[bay])
    return bay, force / np.linalg.norm(slope, axis=1)
