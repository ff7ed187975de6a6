"""Quantities of load cases as they stand in files."""

from __future__ import annotations

from typing import Annotated, Final

from catenaria.units import Dimension, QuantityType

WARMING: Final = Dimension("a difference of temperatures", "K", "40 K")
SPEED: Final = Dimension("a speed", "m/s", "26 m/s")
ANGLE: Final = Dimension("an angle", "deg", "90 deg")
LOAD_PER_LENGTH: Final = Dimension("a load per length", "N/m", "3.5 N/m")
FORCE: Final = Dimension("a force", "N", "200 N")

Warming = Annotated[float, QuantityType(WARMING)]
Speed = Annotated[float, QuantityType(SPEED, "non-negative")]
Angle = Annotated[float, QuantityType(ANGLE)]
LoadPerLength = Annotated[float, QuantityType(LOAD_PER_LENGTH, "non-negative")]
Force = Annotated[float, QuantityType(FORCE)]
