"""How the supports of a line in space hold a wire: rollers, springs, brackets, arms, cantilevers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from catenaria.audit.spatial.stations import CONTACT, LONG, MESSENGER, SECOND, Stations
from catenaria.audit.stated import Conductor, conductor_of
from catenaria.audit.track import Across

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

_LEFT: Final = {"left": 1.0, "right": -1.0}
_NOWHERE: Final = (np.nan, np.nan)


@dataclass(frozen=True)
class StatedArm:
    """A steady arm.

    Attributes
    ----------
    length, mass : float
        From hinge to wire [m]; with its weight half on either end [kg].
    registration : str
        ``pull-off`` or ``push-off``.
    side : float
        Where the hinge is, seen from the wire: 1 to the left, -1 to the right.
    hinge : tuple of float
        Its offset to the left and its height [m]; NaN where it is found.
    minimum_pull : float
        Wanted horizontal force [N].
    """

    length: float
    mass: float
    registration: str
    side: float
    hinge: tuple[float, float]
    minimum_pull: float

    @property
    def hinged(self) -> bool:
        """Whether the hinge is given, and the place of the wire is found."""
        return bool(np.isfinite(self.hinge[0]))


@dataclass(frozen=True)
class StatedCantilever:
    """A flexible cantilever: cross-section, length [m], and the side of its root, 1 to the left."""

    conductor: Conductor
    length: float
    side: float


@dataclass(frozen=True)
class StatedHolds:
    """The m places where supports hold one wire.

    Attributes
    ----------
    support : IntArray, shape (m,)
        Numbers of the supports, from 0.
    name : tuple of str
        Their names.
    chainage : FloatArray, shape (m,)
        Where they stand [m].
    across : Across
        The planes across the track there.
    place : FloatArray, shape (m, 3)
        Where the wire is held, by springs and cantilevers when they are free of load [m].
    kind : tuple of str
        As in the line file; ``arm`` for steady arms.
    friction : FloatArray, shape (m,)
        By which share of its force on the support the tension grows along the line.
    compliance : FloatArray, shape (m, 2)
        Of springs, sideways and vertically [m/N].
    lift : FloatArray, shape (m,)
        Prescribed vertical force on the wire [N]; NaN where the height is prescribed.
    arm : tuple of StatedArm or None
        The steady arms.
    cantilever : tuple of StatedCantilever or None
        The cantilevers.
    """

    support: IntArray
    name: tuple[str, ...]
    chainage: FloatArray
    across: Across
    place: FloatArray
    kind: tuple[str, ...]
    friction: FloatArray
    compliance: FloatArray
    lift: FloatArray
    arm: tuple[StatedArm | None, ...]
    cantilever: tuple[StatedCantilever | None, ...]

    @property
    def rolls(self) -> NDArray[np.bool_]:
        """Mask of the supports over which the wire runs; the others take it along with them."""
        return np.array([kind not in ("arm", "bracket") for kind in self.kind], dtype=np.bool_)


def read_holds(stations: Stations, wire: str, pulled: str) -> StatedHolds:
    """Return how all supports hold a wire of which `pulled` says which ends are pulled."""
    places = [(i, at) for i in range(len(stations.supports)) if (at := _held(stations, wire, i)) is not None]
    support = np.array([i for i, _ in places], dtype=np.int64)
    lateral, height = np.array([at for _, at in places], dtype=np.float64).reshape(-1, 2).T
    across = stations.across.take(support)
    own = [stations.supports[i] for i, _ in places]
    carried = [data["messenger_wire"] if wire == MESSENGER else None for data in own]
    arms = [_arm(data, stations.beside(wire)) if wire in (CONTACT, SECOND) else None for data in own]
    friction = np.array([0.0 if data is None else data["friction"] for data in carried])
    return StatedHolds(
        support=support,
        name=tuple(data["name"] for data in own),
        chainage=stations.chainage[support],
        across=across,
        place=across.point(lateral, height),
        kind=tuple(_kind(data, arm) for data, arm in zip(carried, arms, strict=True)),
        friction=friction * _growth(stations.chainage, pulled)[support],
        compliance=np.array([_compliance(data) for data in carried]).reshape(-1, 2),
        lift=np.array([_lift(data, arm) for data, arm in zip(own, arms, strict=True)]),
        arm=tuple(arms),
        cantilever=tuple(_cantilever(data) for data in carried),
    )


def _held(stations: Stations, wire: str, i: int) -> tuple[float, float] | None:
    return stations.held(wire, i) if wire in LONG else None


def _kind(carried: dict[str, Any] | None, arm: StatedArm | None) -> str:
    if arm is not None:
        return "arm"
    return "sliding" if carried is None else str(carried["kind"])


def _growth(chainage: FloatArray, pulled: str) -> FloatArray:
    """Return 1 where friction lets tension grow along the line and -1 where it lets it fall.

    It falls from a pulled end to the fixed one, or from two pulled ends to the middle between the supports.
    """
    if pulled == "both":
        return np.sign(chainage - 0.5 * (chainage[0] + chainage[-1]))
    return np.full(chainage.size, 1.0 if pulled == "end" else -1.0)


def _compliance(carried: dict[str, Any] | None) -> tuple[float, float]:
    if carried is None or carried["kind"] != "spring":
        return 0.0, 0.0
    sideways, vertical = carried["lateral_stiffness"], carried["stiffness"]
    return 0.0 if sideways is None else 1.0 / sideways, 0.0 if vertical is None else 1.0 / vertical


def _lift(support: dict[str, Any], arm: StatedArm | None) -> float:
    lift = None if arm is None else support["contact_wire"]["arm"]["lift"]
    return np.nan if lift is None else float(lift)


def _arm(support: dict[str, Any], beside: float) -> StatedArm | None:
    """Return the arm of a contact wire that runs `beside` the stagger, and whose hinge is as far beside."""
    arm = support["contact_wire"]["arm"]
    if arm is None:
        return None
    hinge, stagger = arm["hinge"], support["stagger"]
    if arm["side"] is not None:
        side = _LEFT[arm["side"]]
    elif hinge is not None:
        side = float(np.sign(hinge["stagger"] - stagger))
    else:
        side = float(np.sign(stagger))
    place = _NOWHERE if hinge is None else (hinge["stagger"] + beside, hinge["height"])
    wanted = 0.0 if arm["minimum_pull"] is None else arm["minimum_pull"]
    return StatedArm(arm["length"], arm["mass"], arm["registration"], side, place, wanted)


def _cantilever(carried: dict[str, Any] | None) -> StatedCantilever | None:
    if carried is None or carried["kind"] != "cantilever":
        return None
    data = carried["cantilever"]
    return StatedCantilever(conductor_of("cantilever", data), data["length"], _LEFT[data["side"]])
