"""The conductor library: wires that are common in overhead contact lines, to be used by name.

The numbers stand in ``library.json`` in the units of data sheets, each entry with what they are based on.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from importlib.resources import files
from types import MappingProxyType
from typing import Final

from pydantic import BaseModel, ConfigDict

from catenaria.errors import InconsistentInputError
from catenaria.line.base import closest
from catenaria.line.conductor import Conductor

_ACROSS: Final = {7: 3, 19: 5, 37: 7}  # wires of a strand beside each other, by their number


class Entry(BaseModel):
    """A conductor of the library, in the units of data sheets.

    Attributes
    ----------
    wires : int
        Number of wires of a strand; 1 for a contact wire.
    wire_diameter_mm : float or None
        Diameter of the wires of a strand [mm].
    diameter_mm : float or None
        Outer diameter of a contact wire [mm]; that of a strand follows from its wires.
    area_mm2, youngs_modulus_GPa, mass_kg_per_km, bending_stiffness_N_m2, thermal_expansion_per_K : float
        What a line is computed with; Young's modulus is that of the whole section.
    breaking_load_kN : float or None
        Least or computed breaking load [kN], where a source is known; for information, nothing uses it.
    source : str
        Where the numbers come from, and which are computed or assumed.
    """

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    wires: int
    wire_diameter_mm: float | None = None
    diameter_mm: float | None = None
    area_mm2: float
    youngs_modulus_GPa: float
    mass_kg_per_km: float
    bending_stiffness_N_m2: float
    thermal_expansion_per_K: float
    breaking_load_kN: float | None = None
    source: str

    @property
    def outer_diameter(self) -> float | None:
        """Outer diameter [m]: of strands that of a middle wire with one, two or three layers around it."""
        if self.wire_diameter_mm is None:
            return None if self.diameter_mm is None else self.diameter_mm / 1e3
        return _ACROSS[self.wires] * self.wire_diameter_mm / 1e3

    @property
    def conductor(self) -> Conductor:
        """The conductor in SI units, as if it stood in the line file."""
        return Conductor(
            youngs_modulus=self.youngs_modulus_GPa * 1e9,
            area=self.area_mm2 / 1e6,
            mass_per_length=self.mass_kg_per_km / 1e3,
            bending_stiffness=self.bending_stiffness_N_m2,
            thermal_expansion=self.thermal_expansion_per_K,
            diameter=self.outer_diameter,
        )


class _Book(BaseModel):
    """The file: entries name one of the sources."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    sources: dict[str, str]
    conductors: dict[str, Entry]


@cache
def catalogue() -> Mapping[str, Entry]:
    """Return all entries of the library by name, with everything that is known of them.

    Returns
    -------
    Mapping of str to Entry
        Read-only.

    Examples
    --------
    >>> entry = catalogue()["BzII 70"]
    >>> entry.wires, entry.wire_diameter_mm, entry.mass_kg_per_km
    (19, 2.1, 596.0)
    """
    text = files("catenaria.line").joinpath("library.json").read_text(encoding="utf-8")
    book = _Book.model_validate_json(text)
    return MappingProxyType(
        {
            name: entry.model_copy(update={"source": book.sources[entry.source]})
            for name, entry in book.conductors.items()
        }
    )


@cache
def library() -> Mapping[str, Conductor]:
    """Return all conductors of the library by name, read-only."""
    return MappingProxyType({name: entry.conductor for name, entry in catalogue().items()})


def conductor_named(name: str) -> Conductor:
    """Return a conductor of the library.

    Parameters
    ----------
    name : str
        For example ``AC-120 CuMg0.5`` or ``BzII 70``; there are no other spellings.

    Returns
    -------
    Conductor
        Section and material in SI units.

    Raises
    ------
    InconsistentInputError
        If the library has no conductor of that name; the message proposes a similar one.

    Examples
    --------
    >>> conductor_named("AC-120 CuMg0.5").EA
    14400000.0
    """
    try:
        return library()[name]
    except KeyError:
        raise InconsistentInputError(
            f"the conductor library has no {name}{closest(name, library())}; its names stand in the guide"
        ) from None
