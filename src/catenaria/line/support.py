"""Supports: places where wires are held."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Annotated, Final

from pydantic import Field, Strict, model_validator

from catenaria.errors import InconsistentInputError
from catenaria.line.base import LineModel, Problem, refuse
from catenaria.line.contact_support import ContactSupport
from catenaria.line.messenger_support import AuxiliarySupport, MessengerSupport
from catenaria.line.steady_arm import arm_problems
from catenaria.units import Length

_STAGGER: Final = 1.0  # m
_MESSENGER_STAGGER: Final = 1.5  # m


class Support(LineModel):
    """A place where wires are held.

    Examples
    --------
    >>> support = Support(
    ...     contact_wire=ContactSupport(height=5.5), messenger_wire=MessengerSupport(encumbrance=1.5)
    ... )
    >>> support.messenger_height
    7.0
    """

    name: str = Field(
        default="", description="What the support is called in the results; S1, S2, ... if left out."
    )
    contact_wire: ContactSupport | None = Field(
        default=None,
        description="How the contact wire is held; left out where it hangs freely past the support.",
    )
    messenger_wire: MessengerSupport = Field(description="How the messenger wire is held.")
    auxiliary_messenger: AuxiliarySupport | None = Field(
        default=None, description="How the auxiliary messenger is held, in a line that has one."
    )
    stagger: Length = Field(
        default=0.0,
        description="Sideways offset of the contact wire from the track axis, positive to the left.",
    )
    messenger_stagger: Length | None = Field(
        default=None,
        description="Sideways offset of the messenger wires, positive to the left; the stagger if left out.",
    )
    stitch_wire: Annotated[bool, Strict()] | None = Field(
        default=None,
        description=(
            "Whether there is a stitch wire, in a line that has them; if left out, at all supports but the "
            "first and the last one."
        ),
    )

    @property
    def messenger_height(self) -> float:
        """Height at which the messenger wire is held [m]."""
        messenger, contact = self.messenger_wire, self.contact_wire
        if messenger.height is not None:
            return messenger.height
        if messenger.encumbrance is None or contact is None:
            raise InconsistentInputError(
                "an encumbrance needs a contact wire that is held at the same support"
            )
        return contact.height + messenger.encumbrance

    @property
    def messenger_offset(self) -> float:
        """Sideways offset of the messenger wires, positive to the left [m]."""
        return self.stagger if self.messenger_stagger is None else self.messenger_stagger

    @model_validator(mode="after")
    def _consistent(self) -> Support:
        refuse("Support", self._problems())
        return self

    def _problems(self) -> Iterator[Problem]:
        yield from self._height_problems()
        for field, most in (("stagger", _STAGGER), ("messenger_stagger", _MESSENGER_STAGGER)):
            value: float | None = getattr(self, field)
            if value is not None and abs(value) > most:
                yield Problem((field,), value, f"within {most:g} m, as -200 mm")
        if self.contact_wire is not None and self.contact_wire.arm is not None:
            for problem in arm_problems(self.contact_wire.arm, self.stagger, self.contact_wire.height):
                path = ("contact_wire", "arm", *problem.path)
                yield Problem(path, problem.found, problem.allowed, problem.kind)

    def _height_problems(self) -> Iterator[Problem]:
        messenger, contact, auxiliary = self.messenger_wire, self.contact_wire, self.auxiliary_messenger
        if messenger.encumbrance is not None and contact is None:
            allowed = "a height instead: the contact wire is not held at this support"
            yield Problem(("messenger_wire", "encumbrance"), messenger.encumbrance, allowed)
        elif contact is not None and self.messenger_height <= contact.height:
            allowed = f"more than {contact.height:g} m, the height of the contact wire at this support"
            yield Problem(("messenger_wire", "height"), messenger.height, allowed)
        elif auxiliary is not None:
            low = -math.inf if contact is None else contact.height
            if auxiliary.height <= low or auxiliary.height >= self.messenger_height:
                allowed = f"between contact wire and messenger wire, {low:g} to {self.messenger_height:g} m"
                yield Problem(("auxiliary_messenger", "height"), auxiliary.height, allowed)
