"""A line across the track at one chainage: where its wires are there, and the nearest dropper."""

from __future__ import annotations

from dataclasses import dataclass
from numbers import Real

import numpy as np

from catenaria.errors import InconsistentInputError
from catenaria.results import FormResult, Profile, WireForm


@dataclass(frozen=True)
class WirePoint:
    """A wire where it crosses the plane across the track.

    Attributes
    ----------
    wire : str
        Its name.
    height, lateral : float
        In the track frame: above the track and to the left of its middle [m].
    tension : float
        Axial force [N].
    """

    wire: str
    height: float
    lateral: float
    tension: float

    def __str__(self) -> str:
        height, lateral = (round(value, 4) + 0.0 for value in (self.height, self.lateral))  # no -0.0000
        return f"{height:.4f} m high, {lateral:.4f} m to the left, {self.tension:.1f} N"


@dataclass(frozen=True)
class NearestDropper:
    """The dropper that is nearest along the track.

    Attributes
    ----------
    span, number : int
        Span, and number in it, from 1.
    chainage : float
        Where it hangs [m].
    length, cut_length : float
        Between the axes of its wires, and to be cut [m].
    force : float
        With which it lifts its lower wire [N].
    lower_wire, upper_wire : str
        What it lifts, and from what it hangs.
    """

    span: int
    number: int
    chainage: float
    length: float
    cut_length: float
    force: float
    lower_wire: str
    upper_wire: str

    def __str__(self) -> str:
        return (
            f"{self.number} of span {self.span} at {self.chainage:.3f} m, {self.length:.4f} m long, "
            f"lifts the {self.lower_wire} with {self.force:.2f} N"
        )


@dataclass(frozen=True, repr=False)
class CrossSection:
    """What there is at a chainage.

    Attributes
    ----------
    chainage : float
        Where it is [m].
    wires : tuple of WirePoint
        All wires that cross it.
    dropper : NearestDropper or None
        The nearest dropper; None if the line has none.
    """

    chainage: float
    wires: tuple[WirePoint, ...]
    dropper: NearestDropper | None

    def wire(self, name: str) -> WirePoint:
        """Return one wire.

        Raises
        ------
        InconsistentInputError
            If no wire of that name is here.
        """
        for wire in self.wires:
            if wire.wire == name:
                return wire
        names = ", ".join(wire.wire for wire in self.wires)
        raise InconsistentInputError(f"there is no wire {name!r} at {self.chainage:.3f} m; there is {names}")

    def __repr__(self) -> str:
        rows = {wire.wire: str(wire) for wire in self.wires}
        if self.dropper is not None:
            rows["nearest dropper"] = str(self.dropper)
        width = max(map(len, rows))
        lines = (f"  {name:{width}}  {text}" for name, text in rows.items())
        return "\n".join((f"CrossSection at {self.chainage:.3f} m", *lines))


def cross_section(form: FormResult, chainage: float) -> CrossSection:
    """Return what a result says of a chainage, by straight lines between the points of its profiles.

    Raises
    ------
    InconsistentInputError
        If no wire is there, or it is no number.
    """
    if not isinstance(chainage, Real):
        raise InconsistentInputError(f"a chainage is a number of metres, not {chainage!r}")
    wires = tuple(_point(wire, chainage) for wire in form.wires if _crosses(wire.profile, chainage))
    if not wires:
        starts, ends = zip(*(_reach(wire.profile) for wire in form.wires), strict=True)
        where = f"the line goes from {min(starts):.3f} to {max(ends):.3f} m"
        raise InconsistentInputError(f"no wire is at chainage {chainage:g} m; {where}")
    return CrossSection(float(chainage), wires, _nearest(form, chainage))


def _reach(profile: Profile) -> tuple[float, float]:
    return float(profile.chainage[0]), float(profile.chainage[-1])


def _crosses(profile: Profile, chainage: float) -> bool:
    start, end = _reach(profile)
    return start <= chainage <= end


def _point(wire: WireForm, chainage: float) -> WirePoint:
    shape = wire.profile
    fields = (shape.height, shape.lateral, shape.tension)
    height, lateral, tension = (float(np.interp(chainage, shape.chainage, field)) for field in fields)
    return WirePoint(wire.name, height, lateral, tension)


def _nearest(form: FormResult, chainage: float) -> NearestDropper | None:
    droppers = form.droppers
    if not droppers.x.size:
        return None
    i = int(np.argmin(np.abs(droppers.x - chainage)))
    return NearestDropper(
        int(droppers.span[i]),
        int(droppers.number[i]),
        float(droppers.x[i]),
        float(droppers.length[i]),
        float(droppers.cut_length[i]),
        float(droppers.force_bottom[i]),
        droppers.lower_wire[i],
        droppers.upper_wire[i],
    )
