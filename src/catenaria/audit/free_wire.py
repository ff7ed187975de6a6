"""A wire cut free: its curve, and the forces of supports, droppers and tensioning devices on it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from catenaria.audit.curve import INTERVALS, Curve
from catenaria.audit.energy import nodal_residual
from catenaria.audit.quadrature import clenshaw_curtis
from catenaria.audit.stated import Stated, StatedWire
from catenaria.errors import InconsistentInputError
from catenaria.results.form import FormResult, Stage, WireForm

FloatArray = NDArray[np.float64]

_RELATIVE = 1e-6  # of the largest tension: 0.015 N of 15 kN, a tenth of what forces are wanted to
_AT_JOINT = 0.02  # m: nodes are put where joints will be, to millimetres
_ROUNDING = 8.0  # units in the last place that the two positions of an element may be off together


@dataclass(frozen=True)
class FreeBody:
    """A wire of a result as a free body, whatever it is made of.

    Attributes
    ----------
    stated : StatedWire
        What the line file says of it.
    form : WireForm
        What the result says of it.
    support_s, clamp_s : FloatArray, shape (m,), (n,)
        Material coordinates at supports and droppers [m].
    support_force, clamp_force : FloatArray, shape (m, 3), (n, 3)
        Forces on the wire there [N].
    gravity : float
        Acceleration [m/s^2].
    largest_tension : float
        Of the whole line, as prescribed [N].
    """

    stated: StatedWire
    form: WireForm
    support_s: FloatArray
    support_force: FloatArray
    clamp_s: FloatArray
    clamp_force: FloatArray
    gravity: float
    largest_tension: float

    @property
    def end_s(self) -> FloatArray:
        """Material coordinates of start and end [m]."""
        return self.form.profile.s[[0, -1]]

    @cached_property
    def joint_s(self) -> FloatArray:
        """Material coordinates of supports, droppers, start and end [m]."""
        return np.concatenate((self.support_s, self.clamp_s, self.end_s))

    @cached_property
    def joint_force(self) -> FloatArray:
        """Their forces on the wire, shape (m + n + 2, 3) [N]."""
        return np.concatenate((self.support_force, self.clamp_force, -self.form.end_force))

    @cached_property
    def joint_name(self) -> tuple[str, ...]:
        """Their names."""
        supports = (f"support {name}" for name in self.stated.support_name)
        droppers = (f"dropper {i + 1}" for i in range(self.clamp_s.size))
        return (*supports, *droppers, "its start", "its end")

    @property
    def force_tolerance(self) -> float:
        """Force that may be missing to a balance [N]."""
        return _RELATIVE * self.largest_tension

    def position(self, s: FloatArray) -> FloatArray:
        """Return where the points with the given material coordinates are, shape (n, 3) [m]."""
        shape = self.form.profile
        return np.column_stack([np.interp(s, shape.s, part) for part in (shape.x, shape.y, shape.z)])

    def strain_tension(self, s: FloatArray) -> FloatArray:
        """Return N = EA eps of eq. (11) at material coordinates, as the profile states it [N]."""
        return np.interp(s, self.form.profile.s, self.form.profile.strain_tension)

    def place(self, s: float) -> str:
        """Say between or at which joints a material coordinate is."""
        away = (self.joint_s - s).tolist()
        nearest = min(range(len(away)), key=lambda i: abs(away[i]))
        if abs(away[nearest]) < _AT_JOINT:
            return self.joint_name[nearest]
        before = max((i for i, d in enumerate(away) if d < 0.0), key=away.__getitem__)
        after = min((i for i, d in enumerate(away) if d > 0.0), key=away.__getitem__)
        return f"s = {s:.3f} m, between {self.joint_name[before]} and {self.joint_name[after]}"


@dataclass(frozen=True)
class FreeWire(FreeBody):
    """A wire that bends, with the curve that its nodes describe.

    Attributes
    ----------
    curve : Curve
        Its configuration.
    """

    curve: Curve

    @property
    def end_s(self) -> FloatArray:
        """Material coordinates of start and end [m]."""
        return self.curve.s[[0, -1]]

    @property
    def force_tolerance(self) -> float:
        """Force that may be missing to a balance [N]."""
        return super().force_tolerance + self._rounding

    @cached_property
    def _rounding(self) -> float:
        """Force that rounding of positions leaves [N].

        Notes
        -----
        Positions are known to half a unit in the last place, which a short stiff element turns into EA u/L:
        some micronewtons near the origin of the chainage, 10 mN at 100 km of it.
        """
        unit = float(np.finfo(np.float64).eps * np.max(np.abs(self.curve.r)))
        stiffest = float(self.stated.conductor.EA / self.curve.L.min())
        return _ROUNDING * unit * stiffest

    @cached_property
    def residual(self) -> FloatArray:
        """Residual of every node: forces [N] and moments per slope [N m], shape (n, 2, 3)."""
        return nodal_residual(self.curve, self.stated.conductor, self.gravity, self.joint_s, self.joint_force)

    @cached_property
    def mean_tension(self) -> FloatArray:
        """The mean over each element of the true axial force EA eps |r'| [N]."""
        _, weights = clenshaw_curtis(INTERVALS)
        size = self.curve.stretch
        return (0.5 * self.stated.conductor.EA * (size**2 - 1.0) * size) @ weights

    def position(self, s: FloatArray) -> FloatArray:
        """Return where the points with the given material coordinates are, shape (n, 3) [m]."""
        return self.curve.at(s).r

    def strain_tension(self, s: FloatArray) -> FloatArray:
        """Return N = EA eps of eq. (11) at material coordinates [N]."""
        r1 = self.curve.at(s).r1
        return 0.5 * self.stated.conductor.EA * (np.einsum("ni,ni->n", r1, r1) - 1.0)


@dataclass(frozen=True)
class Along:
    """Names of places along wires, made up when asked for.

    Attributes
    ----------
    wires : sequence of FreeBody
        The wires.
    s : sequence of FloatArray
        Material coordinates of the places on each of them [m].
    """

    wires: Sequence[FreeBody]
    s: Sequence[FloatArray]

    def __getitem__(self, i: int, /) -> str:
        """Return the name of one place, counted along all wires."""
        for wire, s in zip(self.wires, self.s, strict=True):
            if i < s.size:
                return f"{wire.stated.name}, {wire.place(float(s[i]))}"
            i -= s.size
        raise IndexError(i)


def free_wires(
    result: FormResult, stated: Stated, kind: type[FreeWire] = FreeWire
) -> tuple[FreeWire, FreeWire]:
    """Cut the two wires of a result free.

    Parameters
    ----------
    result, stated
        What was found and what was asked for.
    kind : type
        What the wires are made of.

    Raises
    ------
    InconsistentInputError
        If the result does not have one entry for each wire, support and dropper of its line.
    """
    bodies = free_bodies(result, stated)
    if len(result.stages) != len(bodies):
        raise InconsistentInputError("the result does not hold the nodes of its two wires")
    contact, messenger = (
        kind(**vars(body), curve=_curve(stage)) for body, stage in zip(bodies, result.stages, strict=True)
    )
    return contact, messenger


def _curve(stage: Stage) -> Curve:
    nodes = slice(0, int(stage.node_count[0]))  # the other chains are dropper cables of the model
    return Curve(stage.s[nodes], stage.position[nodes], stage.slope[nodes])


def free_bodies(result: FormResult, stated: Stated) -> tuple[FreeBody, FreeBody]:
    """Cut the two wires of a result free, whatever they are made of; see `free_wires`."""
    droppers = result.droppers
    if len(result.wires) != 2 or droppers.x.size != stated.droppers.x.size:
        raise InconsistentInputError("the result does not hold the two wires and the droppers of its line")
    coordinates = (droppers.contact_coordinate, droppers.messenger_coordinate)
    forces = (droppers.on_contact, droppers.on_messenger)
    contact, messenger = (
        _free_body(result, stated, i, coordinates[i], forces[i]) for i in range(len(stated.wires))
    )
    return contact, messenger


def _free_body(
    result: FormResult, stated: Stated, i: int, clamp_s: FloatArray, clamp_force: FloatArray
) -> FreeBody:
    wire, table = stated.wires[i], result.supports
    held = [k for k, name in enumerate(table.wire) if name == wire.name]
    if tuple(table.support[k] for k in held) != wire.support_name or result.wires[i].name != wire.name:
        raise InconsistentInputError(f"the result does not have the supports of the {wire.name} in order")
    force = np.column_stack((table.force_x, table.force_y, table.force_z))[held]
    return FreeBody(
        stated=wire,
        form=result.wires[i],
        support_s=table.sliding_coordinate[held],
        support_force=-force,
        clamp_s=clamp_s,
        clamp_force=clamp_force,
        gravity=stated.gravity,
        largest_tension=max(other.tension for other in stated.wires),
    )
