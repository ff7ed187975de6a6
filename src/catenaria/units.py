"""Quantities in files: ``15 kN``, ``120 mm^2`` or a bare SI number become a float in SI.

Inside catenaria everything is a float in SI; units exist only here, at the border. The annotated types of
this module (`Length`, `PositiveForce`, ...) are what models of input files are made of.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from fractions import Fraction
from functools import cache, lru_cache
from numbers import Real
from typing import TYPE_CHECKING, Annotated, Any, Final

from pydantic_core import CoreSchema, PydanticCustomError, core_schema

if TYPE_CHECKING:
    from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler
    from pydantic.json_schema import JsonSchemaValue


# pint's own table is not used: it knows physical constants ("15 k" is a Boltzmann constant) and temperatures
# with offsets; here a kelvin is a difference and a degree Celsius a temperature. These are the units in which
# overhead lines are described; they are read in 3 ms, not 200.
_UNITS: Final = """
giga- = 1e9 = G-
mega- = 1e6 = M-
kilo- = 1e3 = k-
deca- = 1e1 = da-
deci- = 1e-1 = d-
centi- = 1e-2 = c-
milli- = 1e-3 = m-
micro- = 1e-6 = µ- = μ- = u-
metre = [length] = m = meter
second = [time] = s
gram = [mass] = g
minute = 60 * second = min
hour = 3600 * second = h
tonne = 1000 * kilogram = t
newton = kilogram * metre / second ** 2 = N
pascal = newton / metre ** 2 = Pa
kilogram_force = 9.80665 * newton = kgf
kelvin = [temperature] = K
degree_Celsius = [celsius] = degC
degree = [angle] = deg
"""

_TERM: Final = r"[A-Za-zµμ_]+(?:(?:\^|\*\*)-?[1-9]|[²³⁴2-4])?"
_QUANTITY: Final = re.compile(
    r"(?P<number>[-+]?(?:\d{1,40}\.?\d{0,40}|\.\d{1,40})(?:[eE][-+]?\d{1,3})?)"
    rf"\s*(?P<unit>(?:1\s*/\s*)?{_TERM}(?:(?:\s*[*·/]\s*|\s+){_TERM}){{0,9}})?",
    re.ASCII,
)
_DECIMAL_COMMA: Final = re.compile(r"[-+]?\d*,\d.*", re.ASCII)
_BARE_POWER: Final = re.compile(r"(?<=[A-Za-zµμ])(?=[2-4])")
_MOMENT: Final = re.compile(r"([kM]?N)(?=m{1,2}(?![A-Za-z]))")

# The units that lines are built with, by lower case.
_SPELLED: Final = {
    unit.lower(): unit
    for unit in (
        *("m", "dm", "cm", "mm", "km", "um", "s", "ms", "min", "h", "g", "kg", "t"),
        *("N", "daN", "kN", "MN", "kgf", "Pa", "kPa", "MPa", "GPa", "K", "degC", "deg"),
    )
}


@dataclass(frozen=True)
class Dimension:
    """What kind of quantity a number is.

    Parameters
    ----------
    name : str
        With its article, for example ``a force``.
    unit : str
        The SI unit, for example ``N``; empty for a pure number.
    example : str
        What an engineer would write, for example ``15 kN``.
    """

    name: str
    unit: str
    example: str

    def __str__(self) -> str:
        return f'{self.name}, for example "{self.example}"'


class Unknown(float):
    """Stands for a value that could not be read and whose fault is known: a NaN that is let through.

    Comparisons with NaN are false, so a check written as ``if bad: complain`` is silent about it.
    """


UNKNOWN: Final = Unknown("nan")


@cache
def _registry() -> Any:
    import pint  # 0.16 s, which a file of bare SI numbers does not pay

    make: Any = pint.UnitRegistry  # whose annotations forget that it works without a table and in fractions
    registry = make(None, non_int_type=Fraction)
    registry.load_definitions(_UNITS.strip().splitlines())
    return registry


@lru_cache(maxsize=1024)
def _factor(unit: str, dimension: Dimension) -> Fraction:
    """Size of `unit` in SI, exactly, or a ValueError that says what is wrong with it."""
    from pint import DimensionalityError, UndefinedUnitError

    try:
        return _convert(unit, dimension)
    except UndefinedUnitError:
        pass
    except DimensionalityError:
        raise ValueError(str(dimension)) from None
    unknown = f'{dimension}; the unit "{unit}" is not known'
    meant = re.sub("[A-Za-z]+", lambda word: _SPELLED.get(word[0].lower(), word[0]), unit)
    try:
        _convert(meant, dimension)
    except (UndefinedUnitError, DimensionalityError):
        raise ValueError(unknown) from None
    raise ValueError(f"{unknown} (did you mean {meant}?)")


def _convert(unit: str, dimension: Dimension) -> Fraction:
    registry = _registry()
    source, target = (registry.parse_units(_plain(text)) for text in (unit, dimension.unit))
    return Fraction(registry.convert(Fraction(1), source, target))


def _plain(unit: str) -> str:
    """Write out what engineers leave out: ``Nm2`` is ``N*m^2``, and never the square of ``Nm``."""
    return _BARE_POWER.sub("^", _MOMENT.sub(r"\1*", unit.replace("·", "*"), count=1))


def to_si(value: object, dimension: Dimension) -> float:
    """Turn a number or a text with a unit into a float in SI.

    Parameters
    ----------
    value : object
        What stands in the file: a number in SI or a text such as ``15 kN``.
    dimension : Dimension
        What it must be.

    Returns
    -------
    float
        In SI, finite; the only exception is `UNKNOWN`, which is returned as it is.

    Raises
    ------
    ValueError
        If it is anything else, with what is allowed as the message.

    Notes
    -----
    Number and unit are multiplied as fractions and rounded once: ``0.2 mm/s`` is the same float as 0.0002.

    Examples
    --------
    >>> to_si("15 kN", FORCE), to_si("120 mm^2", AREA), to_si(1.5, LENGTH)
    (15000.0, 0.00012, 1.5)
    >>> to_si("15 m", FORCE)
    Traceback (most recent call last):
    ValueError: a force, for example "15 kN"
    """
    if value is UNKNOWN:
        return UNKNOWN
    try:
        number = float(
            _to_fraction(value, dimension) if isinstance(value, str) else _to_real(value, dimension)
        )
    except OverflowError:
        number = math.inf
    if not math.isfinite(number):
        raise ValueError(f"{dimension}, and finite")
    return number


def _to_real(value: object, dimension: Dimension) -> Real:
    if isinstance(value, bool) or not isinstance(value, Real):
        raise ValueError(str(dimension))
    return value


def _to_fraction(text: str, dimension: Dimension) -> Fraction:
    match = _QUANTITY.fullmatch(text.strip())
    if match is None:
        comma = "; decimals stand after a point: use a point, not a comma"
        raise ValueError(f"{dimension}{comma if _DECIMAL_COMMA.fullmatch(text.strip()) else ''}")
    number = Fraction(match["number"])
    if match["unit"] is None:
        return number
    return number * _factor(match["unit"], dimension)


@dataclass(frozen=True)
class QuantityType:
    """Annotation that makes pydantic read a quantity: ``Annotated[float, QuantityType(FORCE, "positive")]``.

    Parameters
    ----------
    dimension : Dimension
        What the number must be.
    sign : str
        ``any``, ``non-negative`` or ``positive``.
    """

    dimension: Dimension
    sign: str = "any"

    def read(self, value: object) -> float:
        """Return the value in SI or raise what pydantic turns into an error of type ``quantity``."""
        try:
            number = to_si(value, self.dimension)
        except ValueError as error:
            raise PydanticCustomError("quantity", "{allowed}", {"allowed": str(error)}) from None
        if (self.sign == "positive" and number <= 0.0) or (self.sign == "non-negative" and number < 0.0):
            bound = "greater than zero" if self.sign == "positive" else "not negative"
            raise PydanticCustomError("quantity", "{allowed}", {"allowed": f"{self.dimension}, {bound}"})
        return number

    def __get_pydantic_core_schema__(self, source: object, handler: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.no_info_plain_validator_function(
            self.read, serialization=core_schema.plain_serializer_function_ser_schema(float)
        )

    def __get_pydantic_json_schema__(
        self, core: CoreSchema, handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        bounds = {"any": {}, "non-negative": {"minimum": 0}, "positive": {"exclusiveMinimum": 0}}
        what = self.dimension.name
        unit = f"{what} in {self.dimension.unit} (SI)" if self.dimension.unit else what
        text = {
            "type": "string",
            "description": f"{what} with its unit",
            "examples": [self.dimension.example],
        }
        return {"anyOf": [{"type": "number", "description": unit, **bounds[self.sign]}, text]}


LENGTH: Final = Dimension("a length", "m", "65 m")
AREA: Final = Dimension("an area", "m^2", "120 mm^2")
FORCE: Final = Dimension("a force", "N", "15 kN")
PRESSURE: Final = Dimension("a pressure or modulus", "Pa", "130 GPa")
DENSITY: Final = Dimension("a density", "kg/m^3", "8900 kg/m^3")
MASS: Final = Dimension("a mass", "kg", "0.2 kg")
MASS_PER_LENGTH: Final = Dimension("a mass per length", "kg/m", "1.07 kg/m")
BENDING_STIFFNESS: Final = Dimension("a bending stiffness", "N*m^2", "400 N*m^2")
STIFFNESS: Final = Dimension("a spring stiffness", "N/m", "5 kN/m")
VELOCITY: Final = Dimension("a velocity", "m/s", "0.2 mm/s")
ACCELERATION: Final = Dimension("an acceleration", "m/s^2", "9.81 m/s^2")
TIME: Final = Dimension("a time", "s", "5 s")
FREQUENCY: Final = Dimension("a rate", "1/s", "0.02 1/s")
SLOPE: Final = Dimension("a slope", "", "5 mm/m")

Length = Annotated[float, QuantityType(LENGTH)]
NonNegativeLength = Annotated[float, QuantityType(LENGTH, "non-negative")]
PositiveLength = Annotated[float, QuantityType(LENGTH, "positive")]
PositiveArea = Annotated[float, QuantityType(AREA, "positive")]
PositiveForce = Annotated[float, QuantityType(FORCE, "positive")]
PositivePressure = Annotated[float, QuantityType(PRESSURE, "positive")]
PositiveDensity = Annotated[float, QuantityType(DENSITY, "positive")]
NonNegativeMass = Annotated[float, QuantityType(MASS, "non-negative")]
PositiveMassPerLength = Annotated[float, QuantityType(MASS_PER_LENGTH, "positive")]
BendingStiffness = Annotated[float, QuantityType(BENDING_STIFFNESS, "non-negative")]
PositiveStiffness = Annotated[float, QuantityType(STIFFNESS, "positive")]
PositiveVelocity = Annotated[float, QuantityType(VELOCITY, "positive")]
PositiveAcceleration = Annotated[float, QuantityType(ACCELERATION, "positive")]
NonNegativeTime = Annotated[float, QuantityType(TIME, "non-negative")]
PositiveTime = Annotated[float, QuantityType(TIME, "positive")]
NonNegativeFrequency = Annotated[float, QuantityType(FREQUENCY, "non-negative")]
Slope = Annotated[float, QuantityType(SLOPE)]
