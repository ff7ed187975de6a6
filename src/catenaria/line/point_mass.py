"""Masses at points of wires."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from catenaria.line.base import LineModel
from catenaria.units import Length, NonNegativeMass

WireName = Literal["contact wire", "second contact wire", "auxiliary messenger", "messenger wire"]


class PointMass(LineModel):
    """An insulator, a clamp, a section insulator: a mass that hangs on one wire."""

    name: str = Field(default="", description="What it is called in the results.")
    wire: WireName = Field(description="The wire on which it hangs.")
    chainage: Length = Field(description="Where it hangs, between the first and the last support.")
    mass: NonNegativeMass = Field(description="Its mass.")
