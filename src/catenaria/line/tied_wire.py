"""Wires whose ends are clamped to other wires: stitch wires and mid-point anchors."""

from __future__ import annotations

from pydantic import Field

from catenaria.line.base import LineModel
from catenaria.units import PositiveForce, PositiveLength


class StitchWire(LineModel):
    """Stitch (Y) wires: from one place of the messenger wire to another, past a support between them.

    Droppers that stand within half the length of a support hang from its stitch wire instead of the
    messenger wire.
    """

    conductor: str = Field(description="Name of one of the conductors, or of one of the library.")
    tension: PositiveForce = Field(
        description="The wanted tension: the force at the clamps on the messenger wire."
    )
    length: PositiveLength = Field(
        description=(
            "Distance along the track between the two clamps on the messenger wire, in whose middle is the "
            "support."
        )
    )


class MidPoint(LineModel):
    """Mid-point anchors (Z wires): two wires from the messenger down to the contact wire beside a support.

    One runs from the messenger wire, `reach` before the support, to the contact wire, `clearance` before it;
    the other is its mirror image beyond the support. Of two contact wires they hold the first one.
    """

    support: str = Field(
        description="Name of the inner support, which must hold the contact wire, between the two wires."
    )
    conductor: str = Field(description="Name of one of the conductors, or of one of the library.")
    tension: PositiveForce = Field(description="The wanted tension of either wire: the force at its clamps.")
    reach: PositiveLength = Field(
        description="Distance along the track from the support to the clamps on the messenger wire."
    )
    clearance: PositiveLength = Field(
        default=0.5,
        description="Distance along the track from the support to the clamps on the contact wire.",
    )
