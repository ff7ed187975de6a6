"""What can move although nothing drives it: the free motion of a system that is square but singular."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import diags_array  # pyright: ignore[reportUnknownVariableType]

from catenaria.errors import SingularError
from catenaria.formfinding.springs import Springs
from catenaria.mechanics.state import State
from catenaria.mechanics.system import System
from catenaria.mechanics.unknowns import Kind
from catenaria.solvers.linear import Factorisation, Scaling, factorise
from catenaria.solvers.problem import SparseMatrix
from catenaria.solvers.rank import resisted, softest

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]
Names = Sequence[tuple[str, IntArray]]

LOOSE = 2.0  # sizes of the structure by which its largest force would move a parameter; strings: 0.25
SOFT = 1e9  # times as soft as the stiffest spring; lines stay below 1e8
_SHIFT = 1e-13  # of the stiffest spring: makes an exactly singular matrix regular
_TAKES_PART = 0.1


@dataclass(frozen=True)
class FreeMotion:
    """A motion that next to nothing resists.

    Attributes
    ----------
    give : float
        By how much a force of 1 N moves it [m/N]; infinite if it is not finite.
    stiffest : float
        Stiffest spring of the system [N/m].
    moved : int
        The unknown that moves most.
    motion : FloatArray, shape (n,)
        The motion; the largest unknown moves by 1 m or 1 rad.
    driven_by : FloatArray, shape (n,)
        How well a unit load in each equation drives it, at most 1: the equations that do not hold it.
    """

    give: float
    stiffest: float
    moved: int
    motion: FloatArray
    driven_by: FloatArray


def softest_motion(system: System, z: FloatArray) -> FreeMotion:
    """Return the softest motion of a system at z, which may be singular.

    Parameters
    ----------
    system : System
        With the discrete state that fits z.
    z : FloatArray, shape (n,)
        Where to linearise.

    Raises
    ------
    numpy.linalg.LinAlgError
        If the Jacobian is not finite.

    Notes
    -----
    The scaled matrix is shifted by 1e-13 of the stiffest spring, so that it has factors; a free motion then
    has this stiffness.
    """
    rest = np.zeros(system.size)
    matrix = system.jacobian(State(0.0, z, rest, rest))
    springs = Springs.of(system.unknowns.kind, matrix)
    shift = diags_array(_SHIFT * springs.stiffest * springs.unit_load * springs.looked_at)
    scaling = Scaling(1.0 / springs.unit_load, 1.0 / springs.looked_at)
    lu = factorise(cast("Any", matrix + shift).tocsc(), scaling)
    return _motion(lu, springs, springs.looked_at)


def refuse_free_motion(system: System, states: Sequence[FloatArray], names: Names = ()) -> None:
    """Refuse a system that is singular in all of the given states.

    Parameters
    ----------
    system : System
        The system.
    states : sequence of FloatArray, shape (n,)
        Where it is linearised: a motion that is free by what is prescribed is free everywhere, while a matrix
        may also be singular in one state only, where a straight cable has no tension yet or a load is at its
        limit.
    names : sequence
        Names of parts, each with the indices of its unknowns.

    Raises
    ------
    SingularError
        Naming the motion.
    """
    motions: list[FreeMotion] = []
    for z in states:
        try:
            motions.append(softest_motion(system.relocate(z) or system, z))
        except np.linalg.LinAlgError:
            return
    if all(motion.give * motion.stiffest > SOFT for motion in motions):
        raise _error(system, states[-1], motions[-1], names)


@dataclass(frozen=True)
class ParameterCheck:
    """Refuses the factors of a Jacobian whose targets do not determine the control parameters.

    Parameters
    ----------
    system : System
        With the discrete state that fits z.
    z : FloatArray, shape (n,)
        Where it is linearised.
    names : sequence
        Names of parts, each with the indices of its unknowns.

    Notes
    -----
    Two triangular solves on factors that are there. What a unit load makes of the parameters is compared with
    the size of the structure, for a load as large as the largest force in it; a state without forces says
    nothing and passes.
    """

    system: System
    z: FloatArray
    names: Names = ()

    def __call__(self, matrix: SparseMatrix, factorisation: Factorisation) -> None:
        """Raise `SingularError` if a control parameter is free."""
        kind = self.system.unknowns.kind
        parameters = kind == Kind.PARAMETER
        if not parameters.any():
            return
        springs = Springs.of(kind, matrix)
        looked_at = np.where(parameters, springs.looked_at, 0.0)
        if self.looseness(softest(factorisation, springs.unit_load, looked_at, rounds=0).give) > LOOSE:
            motion = _motion(factorisation, springs, looked_at)
            raise _error(self.system, self.z, motion, self.names)

    def looseness(self, give: float) -> float:
        """Return how far the largest force moves what gives by `give` [m/N], in sizes of the structure."""
        kind = self.system.unknowns.kind
        force = float(np.max(np.abs(self.z), where=kind == Kind.MULTIPLIER, initial=0.0))
        return force * give / _extent(kind, self.z) if force > 0.0 else 0.0


def _motion(lu: Factorisation, springs: Springs, looked_at: FloatArray) -> FreeMotion:
    soft = softest(lu, springs.unit_load, looked_at)
    left = np.abs(resisted(lu, springs.unit_load, looked_at, soft.moved))
    largest = float(left.max())
    driven_by = left / largest if 0.0 < largest < np.inf else np.zeros(left.size)
    scaled = np.abs(springs.looked_at * soft.motion)
    moved = int(np.argmax(scaled))
    motion = soft.motion / scaled[moved] if scaled[moved] > 0.0 else soft.motion
    return FreeMotion(soft.give, springs.stiffest, moved, motion, driven_by)


def _extent(kind: IntArray, z: FloatArray) -> float:
    """Return the largest extent of the structure along an axis [m]."""
    positions = z[kind == Kind.POSITION]
    extents = [float(np.ptp(positions[axis::3])) for axis in range(min(3, positions.size))]
    return max(extents, default=0.0) or 1.0


def _error(system: System, z: FloatArray, motion: FreeMotion, names: Names) -> SingularError:
    kind = system.unknowns.kind
    moves = np.abs(motion.motion) > _TAKES_PART
    parameters = np.flatnonzero(moves & (kind == Kind.PARAMETER))
    loose = np.flatnonzero((motion.driven_by > _TAKES_PART) & (kind == Kind.PARAMETER))
    reason = f"what is prescribed leaves a motion free: {_what(kind, z, motion, names)}"
    if parameters.size:
        reason += f"; parameters that go with it: {_listed(parameters, names)}"
    if loose.size:
        reason += f"; targets that do not hold it: those of {_listed(loose, names)}"
    sliding = "one tension for each wire that slides" if parameters.size else "a joint that holds this motion"
    advice = (
        f"{sliding}, a mesh with an element or more between any two joints, or a start in which tension "
        "holds what has no stiffness of its own"
    )
    return SingularError(reason, advice, motion)


def _what(kind: IntArray, z: FloatArray, motion: FreeMotion, names: Names) -> str:
    """Return what moves, how, and how softly."""
    scaled = np.abs(motion.motion)
    moved = motion.moved
    if kind[moved] == Kind.MULTIPLIER:
        return f"the force of {name_of(moved, names)} may have any size, because something is held twice"
    positions = np.flatnonzero(kind == Kind.POSITION)
    if not np.any(scaled[positions] > _TAKES_PART):
        return f"nothing balances {name_of(moved, names)}"
    axes = [float(scaled[positions[axis::3]].max(initial=0.0)) for axis in range(3)]
    most = positions[int(np.argmax(scaled[positions]))]
    slides = np.any(scaled[kind == Kind.SLIDING] > _TAKES_PART)
    how = f"moves along {'xyz'[int(np.argmax(axes))]}" + (" and slides through its joints" if slides else "")
    return f"{name_of(int(most), names)}{_place(positions, most, z)} {how}, 1 N by {motion.give:.2g} m"


def _place(positions: IntArray, index: np.int64, z: FloatArray) -> str:
    first = int(np.searchsorted(positions, index)) // 3 * 3
    at = ", ".join(f"{value:.4g}" for value in z[positions[first : first + 3]])
    return f" at ({at})"


def _listed(indices: IntArray, names: Names) -> str:
    found = list(dict.fromkeys(name_of(int(index), names) for index in indices))
    more = f" and {len(found) - 4} more" if len(found) > 5 else ""
    return ", ".join(found[: 4 if more else 5]) + more


def name_of(index: int, names: Names) -> str:
    """Return the name of the first part that has an unknown."""
    return next((name for name, indices in names if np.any(indices == index)), f"unknown {index}")
