"""Supports and how they hold the wires."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal

from pydantic import ConfigDict, Field, model_validator

from catenaria.errors import InconsistentInputError
from catenaria.line.base import LineModel, Problem, exactly_one, refuse
from catenaria.units import Length, NonNegativeMass, PositiveLength, PositiveStiffness


class SteadyArm(LineModel):
    """A registration arm that holds the contact wire sideways. It can be described; it is not solved yet."""

    length: PositiveLength = Field(description="From the hinge to the contact-wire clamp.")
    mass: NonNegativeMass = Field(default=0.0, description="Mass of the arm with its clamp.")
    registration: Literal["pull-off", "push-off"] = Field(
        default="pull-off", description="Whether the arm pulls the wire towards the mast or pushes it away."
    )


class ContactSupport(LineModel):
    """How a support holds the contact wire."""

    height: Length = Field(description="Height at which the contact wire is held.")
    kind: Literal["sliding", "steady arm"] = Field(
        default="sliding",
        description="sliding: the wire runs through a fixed point, frictionless. steady arm: not solved yet.",
    )
    arm: SteadyArm | None = Field(default=None, description="The steady arm, if that is what holds the wire.")

    @model_validator(mode="after")
    def _arm_where_there_is_one(self) -> ContactSupport:
        if self.kind == "sliding" and self.arm is not None:
            refuse("ContactSupport", [Problem(("arm",), self.arm, "an arm only where kind is steady arm")])
        return self


class MessengerSupport(LineModel):
    """How a support holds the messenger wire."""

    model_config = ConfigDict(json_schema_extra=exactly_one("height", "encumbrance"))

    height: Length | None = Field(
        default=None, description="Height at which the messenger wire is held. Give this or encumbrance."
    )
    encumbrance: PositiveLength | None = Field(
        default=None, description="Height above the contact wire of the same support. Give this or height."
    )
    kind: Literal["sliding", "clamped", "spring", "cantilever"] = Field(
        default="sliding",
        description="sliding: the wire runs over a fixed point, frictionless. The others are not solved yet.",
    )
    stiffness: PositiveStiffness | None = Field(
        default=None, description="Vertical stiffness of a spring or cantilever."
    )

    @model_validator(mode="after")
    def _one_height(self) -> MessengerSupport:
        refuse("MessengerSupport", self._problems())
        return self

    def _problems(self) -> Iterator[Problem]:
        if self.height is None and self.encumbrance is None:
            yield Problem(("height",), None, "a value: one of height and encumbrance is needed", "missing")
        if self.height is not None and self.encumbrance is not None:
            yield Problem(("encumbrance",), self.encumbrance, "this or height, not both")
        if self.stiffness is not None and self.kind not in ("spring", "cantilever"):
            yield Problem(
                ("stiffness",), self.stiffness, "a stiffness only where kind is spring or cantilever"
            )


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
    stagger: Length = Field(
        default=0.0,
        description="Sideways offset of the contact wire, positive to the left. Only 0 is solved yet.",
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

    @model_validator(mode="after")
    def _messenger_above_contact_wire(self) -> Support:
        refuse("Support", self._problems())
        return self

    def _problems(self) -> Iterator[Problem]:
        messenger, contact = self.messenger_wire, self.contact_wire
        if messenger.encumbrance is not None and contact is None:
            allowed = "a height instead: the contact wire is not held at this support"
            yield Problem(("messenger_wire", "encumbrance"), messenger.encumbrance, allowed)
        elif contact is not None and self.messenger_height <= contact.height:
            allowed = f"more than {contact.height:g} m, the height of the contact wire at this support"
            yield Problem(("messenger_wire", "height"), messenger.height, allowed)
