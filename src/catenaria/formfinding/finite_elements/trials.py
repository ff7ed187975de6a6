"""What an optimiser varies and sees: parameters of a line, and the state in which it rests with them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from catenaria.errors import NotConvergedError
from catenaria.formfinding.finite_elements.found import Found, found_state
from catenaria.formfinding.finite_elements.rest import LineState, come_to_rest

FloatArray = NDArray[np.float64]

_ENOUGH = 1e-7, 1e-3  # m of height and N of tension, within which an objective of zero counts as met


class Trials:
    """States of rest of a line for the parameters that an optimiser tries, each computed once.

    Parameters
    ----------
    first : LineState
        At rest with the first guess of the lengths; the next state begins from the last one.
    parameters : FloatArray
        Of that state: unstressed lengths of droppers, then travels of the wires' ends if these are given [m].

    Attributes
    ----------
    count : int
        States that were computed.
    """

    def __init__(self, first: LineState, parameters: FloatArray) -> None:
        self.count = 1
        self.first = parameters
        self._last = (parameters.copy(), first)

    def at(self, parameters: FloatArray) -> LineState:
        """Return the state of rest for these parameters."""
        known, state = self._last
        if np.array_equal(parameters, known):
            return state
        n = state.unstressed.size
        system = state.system if parameters.size == n else state.system.pulled(*parameters[n:].tolist())
        guess = state.y + state.by_parameter @ (parameters - known)
        state = come_to_rest(system, parameters[:n], guess, state.iterations)
        self._last = (parameters.copy(), state)
        self.count += 1
        return state

    def found(self, parameters: FloatArray, rounds: int, what: str) -> Found:
        """Return the state for the final parameters, which must meet all heights and tensions.

        Raises
        ------
        NotConvergedError
            If the optimiser ended elsewhere.
        """
        state = self.at(parameters)
        height = float(np.max(np.abs(state.height - state.system.target)))
        meshes = state.system.contact.mesh, state.system.messenger.mesh
        tension = float(np.max(np.abs(state.tension - [mesh.tension for mesh in meshes])))
        if height > _ENOUGH[0] or tension > _ENOUGH[1]:
            raise NotConvergedError(
                f"{what} ended {height:.3g} m off a height and {tension:.3g} N off a tension",
                "--method 'adjusted lengths', or direct",
            )
        how = f"{what} in {rounds} iterations with {self.count} states of rest"
        return found_state(state, how, rounds, self.count)
