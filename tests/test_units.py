"""Quantities in files against decimal arithmetic, hand-made tables and a list of traps."""

from __future__ import annotations

import math
import subprocess
import sys
from decimal import Decimal
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import TypeAdapter, ValidationError

from catenaria.units import (
    ACCELERATION,
    AREA,
    BENDING_STIFFNESS,
    DENSITY,
    FORCE,
    FREQUENCY,
    LENGTH,
    MASS,
    MASS_PER_LENGTH,
    PRESSURE,
    SLOPE,
    STIFFNESS,
    TIME,
    UNKNOWN,
    VELOCITY,
    Dimension,
    Length,
    NonNegativeMass,
    PositiveForce,
    to_si,
)


@pytest.mark.parametrize(
    ("text", "dimension", "expected"),
    [
        ("15 kN", FORCE, 15000.0),
        ("15kN", FORCE, 15000.0),
        ("  -1.5e1 kN ", FORCE, -15000.0),
        ("1500 daN", FORCE, 15000.0),
        ("1 kgf", FORCE, 9.80665),
        ("15 kg*m/s^2", FORCE, 15.0),
        ("15 kg m s^-2", FORCE, 15.0),
        ("15", FORCE, 15.0),
        ("120 mm^2", AREA, 0.00012),
        ("120 mm²", AREA, 0.00012),
        ("120 mm**2", AREA, 0.00012),
        ("0.2 mm/s", VELOCITY, 0.0002),
        ("160 km/h", VELOCITY, 160 / 3.6),
        ("400 N*m^2", BENDING_STIFFNESS, 400.0),
        ("400 N·m²", BENDING_STIFFNESS, 400.0),
        ("400 N m^2", BENDING_STIFFNESS, 400.0),
        ("400 Nm^2", BENDING_STIFFNESS, 400.0),
        ("400 Nm2", BENDING_STIFFNESS, 400.0),
        ("400 Nm²", BENDING_STIFFNESS, 400.0),
        ("0.4 kNm2", BENDING_STIFFNESS, 400.0),
        ("4e8 Nmm2", BENDING_STIFFNESS, 400.0),
        ("120 mm2", AREA, 0.00012),
        ("1.2e-4 m2", AREA, 0.00012),
        ("8900 kg/m3", DENSITY, 8900.0),
        ("9.81 m/s2", ACCELERATION, 9.81),
        ("130 GPa", PRESSURE, 130e9),
        ("130 kN/mm^2", PRESSURE, 130e9),
        ("1.35 kg/m", MASS_PER_LENGTH, 1.35),
        ("1070 kg/km", MASS_PER_LENGTH, 1.07),
        ("8.9 g/cm^3", DENSITY, 8900.0),
        ("8.9 t/m^3", DENSITY, 8900.0),
        ("200 g", MASS, 0.2),
        ("5 min", TIME, 300.0),
        ("5 ms", TIME, 0.005),
        ("0.02 1/s", FREQUENCY, 0.02),
        ("0.02 s^-1", FREQUENCY, 0.02),
        ("5 kN/m", STIFFNESS, 5000.0),
        ("5 mm/m", SLOPE, 0.005),
        ("1 µm", LENGTH, 1e-6),
    ],
)
def test_a_text_with_unit_is_the_si_number(text: str, dimension: Dimension, expected: float) -> None:
    assert to_si(text, dimension) == pytest.approx(expected, rel=1e-15)


@given(
    st.decimals(-10_000, 10_000, places=4, allow_nan=False, allow_infinity=False),
    st.sampled_from([("um", "1e-6"), ("mm", "1e-3"), ("cm", "1e-2"), ("m", "1"), ("km", "1e3")]),
)
def test_conversion_rounds_only_once(number: Decimal, unit: tuple[str, str]) -> None:
    name, size = unit
    assert to_si(f"{number:f} {name}", LENGTH) == float(number * Decimal(size))


def test_naive_floating_point_would_round_twice() -> None:
    """Negative control: what the exact conversion is for."""
    tenths = range(1, 1000)
    naive = [i / 10 * 1e-6 for i in tenths]
    exact = [float(Fraction(i, 10) / 10**6) for i in tenths]
    assert any(a != b for a, b in zip(naive, exact, strict=True))
    assert [to_si(f"{i / 10} um", LENGTH) for i in tenths] == exact


@pytest.mark.parametrize("value", [1.5, 1, np.float64(1.5), np.int64(2), np.float32(0.5)])
def test_a_bare_number_is_si(value: Any) -> None:
    assert to_si(value, LENGTH) == float(value)
    assert type(to_si(value, LENGTH)) is float


@pytest.mark.parametrize(
    "value",
    [
        True,
        False,
        np.True_,
        None,
        "",
        "   ",
        "kN",
        "nan",
        "nan kN",
        "inf",
        "-inf kN",
        float("nan"),
        float("inf"),
        10**400,
        "1e999 kN",
        "1e99999999999 kN",
        "9" * 5000,
        "15 m",
        "15 kN/m",
        "15 kNN",
        "15 kn",
        "15 KN",
        "15 degC",
        "15 k",
        "15 percent",
        "15 kN + 1 kN",
        "10**10**10 N",
        "(15 kN)",
        "15,5 kN",
        "15 kN kN^-1",
        "15 N^99",
        "15 N //",
        "__import__('os').getcwd()",
        "١٥ kN",
        [15e3],
        {"force": 15e3},
        1 + 0j,
        b"15 kN",
        object(),
    ],
)
def test_anything_else_is_refused_and_the_message_shows_what_is_allowed(value: object) -> None:
    with pytest.raises(ValueError, match=r'^a force, for example "15 kN"'):
        to_si(value, FORCE)


@pytest.mark.parametrize(
    ("text", "dimension"),
    [
        ("15 N2", FORCE),
        ("400 Nm", BENDING_STIFFNESS),
        ("400 (Nm)^2", BENDING_STIFFNESS),
        ("120 m3", AREA),
        ("120 mm5", AREA),
    ],
)
def test_powers_without_a_sign_are_powers(text: str, dimension: Dimension) -> None:
    """Negative control of the short ways of writing: they do not let wrong dimensions pass."""
    with pytest.raises(ValueError, match=f"^{dimension.name}"):
        to_si(text, dimension)


@pytest.mark.parametrize("text", ["15,0", "15,0 kN", "-1,5e3 N", ",5 kN"])
def test_a_decimal_comma_is_named(text: str) -> None:
    with pytest.raises(ValueError, match="use a point, not a comma"):
        to_si(text, FORCE)


@pytest.mark.parametrize(
    ("text", "dimension", "meant"),
    [
        ("15 KN", FORCE, "kN"),
        ("130 GPA", PRESSURE, "GPa"),
        ("65 M", LENGTH, "m"),
        ("8900 Kg/m3", DENSITY, "kg/m3"),
        ("0.2 MM/S", VELOCITY, "mm/s"),
    ],
)
def test_capital_letters_are_put_right(text: str, dimension: Dimension, meant: str) -> None:
    with pytest.raises(ValueError, match=rf"is not known \(did you mean {meant}\?\)$"):
        to_si(text, dimension)


@pytest.mark.parametrize("text", ["15 kNN", "15 KG", "15 furlong", "15 m", "15;0 kN"])
def test_nothing_is_guessed_that_is_not_a_force(text: str) -> None:
    """Negative control of both tests above."""
    with pytest.raises(ValueError, match="a force") as caught:
        to_si(text, FORCE)
    assert "did you mean" not in str(caught.value)
    assert "comma" not in str(caught.value)


def test_an_unknown_unit_is_named() -> None:
    with pytest.raises(ValueError, match='the unit "kNN" is not known'):
        to_si("15 kNN", FORCE)


@pytest.mark.parametrize("dimension", [FORCE, LENGTH, AREA, PRESSURE, DENSITY, MASS, VELOCITY, SLOPE])
def test_every_example_is_itself_allowed(dimension: Dimension) -> None:
    assert math.isfinite(to_si(dimension.example, dimension))


def test_an_unknown_passes_and_compares_false() -> None:
    passed = TypeAdapter(PositiveForce).validate_python(UNKNOWN)
    assert math.isnan(passed)
    with pytest.raises(ValidationError):
        TypeAdapter(PositiveForce).validate_python(float("nan"))


@pytest.mark.parametrize(
    ("kind", "good", "bad"),
    [(PositiveForce, "1 mN", 0.0), (PositiveForce, 1, "-1 N"), (NonNegativeMass, 0, -1e-9)],
)
def test_signs(kind: Any, good: object, bad: object) -> None:
    adapter: TypeAdapter[float] = TypeAdapter(kind)
    assert isinstance(adapter.validate_python(good), float)
    with pytest.raises(ValidationError) as caught:
        adapter.validate_python(bad)
    assert [error["type"] for error in caught.value.errors()] == ["quantity"]


def test_json_schema_names_dimension_unit_and_example() -> None:
    number, text = TypeAdapter(PositiveForce).json_schema()["anyOf"]
    assert number == {"type": "number", "description": "a force in N (SI)", "exclusiveMinimum": 0}
    assert text == {"type": "string", "description": "a force with its unit", "examples": ["15 kN"]}
    assert "exclusiveMinimum" not in TypeAdapter(Length).json_schema()["anyOf"][0]


def _imports_pint(value: str) -> bool:
    code = (
        "import sys; from catenaria.units import FORCE, to_si; "
        f"to_si({value}, FORCE); raise SystemExit(7 if 'pint' in sys.modules else 0)"
    )
    status = subprocess.run([sys.executable, "-c", code], check=False).returncode
    assert status in (0, 7)
    return status == 7


def test_pint_is_imported_only_for_a_unit() -> None:
    assert not _imports_pint("15e3")
    assert not _imports_pint("'15000'")
    assert _imports_pint("'15 kN'")


def test_a_unit_of_very_many_factors_is_refused_like_any_other_wrong_one() -> None:
    assert to_si("3 kg*m/s^2", FORCE) == 3.0
    with pytest.raises(ValueError, match="a length"):
        to_si("1 " + "m " * 400, LENGTH)
