"""Quantities of load cases and of trains as they stand in files."""

from __future__ import annotations

from typing import Annotated, Final

from pydantic import AfterValidator
from pydantic_core import PydanticCustomError

from catenaria.units import Dimension, QuantityType

CELSIUS: Final = Dimension("a temperature", "degC", "15 degC")
WARMING: Final = Dimension("a difference of temperatures", "K", "40 K")
SPEED: Final = Dimension("a speed", "m/s", "26 m/s")
TRAIN_SPEED: Final = Dimension("a speed of trains", "m/s", "200 km/h")
ANGLE: Final = Dimension("an angle", "deg", "90 deg")
LOAD_PER_LENGTH: Final = Dimension("a load per length", "N/m", "3.5 N/m")
FORCE: Final = Dimension("a force", "N", "200 N")


def _within(low: float, high: float, unit: str) -> AfterValidator:
    """Return a validator that refuses numbers outside of bounds; an unknown is let through."""

    def check(number: float) -> float:
        if number < low or number > high:
            allowed = f"{low:g} to {high:g} {unit}"
            raise PydanticCustomError("value", "{allowed}", {"allowed": allowed})
        return number

    return AfterValidator(check)


CelsiusTemperature = Annotated[float, QuantityType(CELSIUS), _within(-100.0, 200.0, CELSIUS.unit)]
Warming = Annotated[float, QuantityType(WARMING), _within(-200.0, 200.0, WARMING.unit)]
Speed = Annotated[float, QuantityType(SPEED), _within(0.0, 150.0, SPEED.unit)]
TrainSpeed = Annotated[float, QuantityType(TRAIN_SPEED, "positive"), _within(0.0, 150.0, TRAIN_SPEED.unit)]
Angle = Annotated[float, QuantityType(ANGLE), _within(-360.0, 360.0, ANGLE.unit)]
LoadPerLength = Annotated[float, QuantityType(LOAD_PER_LENGTH), _within(0.0, 1e3, LOAD_PER_LENGTH.unit)]
Force = Annotated[float, QuantityType(FORCE), _within(-1e5, 1e5, FORCE.unit)]
