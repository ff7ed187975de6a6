"""Conductors: what wires and droppers are made of."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Annotated, Final

from annotated_types import Ge, Le
from pydantic import ConfigDict, Field, Strict, model_validator

from catenaria.errors import InconsistentInputError
from catenaria.line.base import LineModel, Problem, exactly_one, refuse
from catenaria.units import (
    BendingStiffness,
    PositiveArea,
    PositiveDensity,
    PositiveLength,
    PositiveMassPerLength,
    PositivePressure,
)

_STRANDED: Final = 1.15  # outer diameter of a strand by that of a solid wire of the same area


class Conductor(LineModel):
    """Cross-section and material of a wire or dropper.

    Examples
    --------
    >>> wire = Conductor(youngs_modulus=130e9, area=120e-6, density=7710, bending_stiffness=400)
    >>> wire.EA, round(wire.rhoA, 4)
    (15600000.0, 0.9252)
    """

    model_config = ConfigDict(json_schema_extra=exactly_one("density", "mass_per_length"))

    youngs_modulus: PositivePressure = Field(
        description="Young's modulus E of the whole section; for stranded wires the effective one."
    )
    area: PositiveArea = Field(description="Cross-sectional area A of the metal.")
    density: PositiveDensity | None = Field(
        default=None, description="Mass per volume of metal. Give this or mass_per_length."
    )
    mass_per_length: PositiveMassPerLength | None = Field(
        default=None, description="Mass per unstressed length. Give this or density."
    )
    bending_stiffness: BendingStiffness = Field(
        description="Bending stiffness EJ; 0 for a perfectly flexible cable."
    )
    thermal_expansion: Annotated[float, Strict(), Ge(0.0), Le(1e-4)] = Field(
        default=17e-6, description="Coefficient of linear thermal expansion in 1/K, for load cases."
    )
    diameter: PositiveLength | None = Field(
        default=None,
        description=(
            "Outer diameter, for wind and ice; if left out, 1.15 times that of a solid round wire of the "
            "same area."
        ),
    )

    @property
    def outer_diameter(self) -> float:
        """Outer diameter [m], see `diameter`.

        Notes
        -----
        A strand of 7, 19 or 37 wires is 3, 5 or 7 of them wide, which is 1.134, 1.147 and 1.151 times the
        diameter of a solid wire of the same metal section; contact wires with their grooves are 1.05 to 1.07
        times as wide.
        """
        if self.diameter is not None:
            return self.diameter
        return _STRANDED * math.sqrt(4.0 * self.area / math.pi)

    @property
    def EA(self) -> float:  # noqa: N802 (the field's symbol)
        """Axial stiffness [N]."""
        return self.youngs_modulus * self.area

    @property
    def EJ(self) -> float:  # noqa: N802 (the field's symbol)
        """Bending stiffness [N m^2]."""
        return self.bending_stiffness

    @property
    def rhoA(self) -> float:  # noqa: N802 (the field's symbol)
        """Mass per unstressed length [kg/m]."""
        if self.mass_per_length is not None:
            return self.mass_per_length
        if self.density is None:
            raise InconsistentInputError("a conductor needs a density or a mass per length")
        return self.density * self.area

    @model_validator(mode="after")
    def _one_mass(self) -> Conductor:
        refuse("Conductor", self._mass_problems())
        return self

    def _mass_problems(self) -> Iterator[Problem]:
        if self.density is None and self.mass_per_length is None:
            yield Problem(
                ("density",), None, "a value: one of density and mass_per_length is needed", "missing"
            )
        if self.density is not None and self.mass_per_length is not None:
            yield Problem(("mass_per_length",), self.mass_per_length, "this or density, not both")
