"""Controls of the dynamic equilibrium method: velocity laws with a dead band and a saturation.

The law of eqs. (19) and (21) of Yang et al. 2017 is zero within the dead band and has its largest speed
beyond the saturation; between the two it is a smooth step.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Protocol, Self

from pydantic import Field, model_validator

from catenaria.line.base import LineModel, Problem, refuse
from catenaria.units import PositiveForce, PositiveLength, PositiveVelocity


class _Banded(Protocol):
    @property
    def dead_band(self) -> float: ...
    @property
    def saturation(self) -> float: ...


def _band_problems(control: _Banded, unit: str) -> Iterator[Problem]:
    if control.saturation <= control.dead_band:
        allowed = f"more than the dead band, {control.dead_band:g} {unit}"
        yield Problem(("saturation",), control.saturation, allowed)


class TensionControl(LineModel):
    """Velocity law of a wire's ends, eqs. (19) and (20)."""

    velocity: PositiveVelocity = Field(description="v_s: largest speed of a wire end.")
    dead_band: PositiveForce = Field(description="T0: no motion while the tension is off by less than this.")
    saturation: PositiveForce = Field(
        description="T1: full speed while the tension is off by more than this."
    )

    @model_validator(mode="after")
    def _band(self) -> Self:
        refuse("TensionControl", _band_problems(self, "N"))
        return self


class ContactTensionControl(TensionControl):
    """Velocity law of the contact wire's ends, with the values of section 5.1 of Yang et al. 2017."""

    velocity: PositiveVelocity = Field(default=0.2e-3, description="v_s: largest speed of a wire end.")
    dead_band: PositiveForce = Field(
        default=5.0, description="T0: no motion while the tension is off by less."
    )
    saturation: PositiveForce = Field(default=100.0, description="T1: full speed while it is off by more.")


class MessengerTensionControl(TensionControl):
    """Velocity law of the messenger wire's ends, with the values of section 5.1 of Yang et al. 2017."""

    velocity: PositiveVelocity = Field(default=0.4e-3, description="v_s: largest speed of a wire end.")
    dead_band: PositiveForce = Field(
        default=20.0, description="T0: no motion while the tension is off by less."
    )
    saturation: PositiveForce = Field(default=500.0, description="T1: full speed while it is off by more.")


class HeightControl(LineModel):
    """Velocity law of a dropper's top that brings the contact wire to its height, eqs. (21) and (22)."""

    velocity: PositiveVelocity = Field(default=0.2e-3, description="v_s: largest speed of a dropper's top.")
    dead_band: PositiveLength = Field(
        default=1e-5, description="h0: no motion while the height is off by less than this."
    )
    saturation: PositiveLength = Field(
        default=1e-3, description="h1: full speed while the height is off by more than this."
    )

    @model_validator(mode="after")
    def _band(self) -> Self:
        refuse("HeightControl", _band_problems(self, "m"))
        return self


class DropperForceControl(LineModel):
    """Velocity law of a dropper's bottom that balances its two halves, eq. (23)."""

    velocity: PositiveVelocity = Field(default=1.0, description="v_s: largest speed of a dropper's bottom.")
    dead_band: PositiveForce = Field(
        default=0.02, description="No motion while the force is off by less than this."
    )
    saturation: PositiveForce = Field(
        default=20.0, description="Full speed while the force is off by more than this."
    )

    @model_validator(mode="after")
    def _band(self) -> Self:
        refuse("DropperForceControl", _band_problems(self, "N"))
        return self
