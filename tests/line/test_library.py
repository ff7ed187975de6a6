"""The conductor library: printed data sheets, geometry, and the page that lists it."""

from __future__ import annotations

import json
from math import pi, sin, sqrt
from pathlib import Path

import pytest

from catenaria.errors import InconsistentInputError
from catenaria.line.conductor import Conductor
from catenaria.line.library import Entry, catalogue, conductor_named, library

ROOT = Path(__file__).parents[2]
FILE = ROOT / "src" / "catenaria" / "line" / "library.json"
PAGE = ROOT / "docs" / "guide" / "conductors.md"
COPPER = 8.9e-3  # kg per metre and mm2, the density with which DIN 48201-1 computes
WIRE_GPA = 120.0  # Young's modulus of the drawn wire

ALLOYS = ("CuETP", "CuAg0.1", "CuSn0.2", "CuMg0.2", "CuMg0.5")
NAMES = [
    *(f"AC-{area} {alloy}" for alloy in ALLOYS for area in (80, 100, 107, 120, 150)),
    *(
        f"{metal} {area}"
        for metal in ("BzII", "BzI", "Cu")
        for area in (10, 16, 25, 35, 50, 70, 95, 120, 150)
    ),
]

CONTACT_WIRES = {  # EN 50149, normal Cu-ETP: mass from, to [kg/km], breaking load [kN], strength [N/mm2]
    80: (690, 733, 27.5, 355),
    100: (862, 916, 34.5, 355),
    107: (923, 980, 36.3, 350),
    120: (1035, 1099, 38.4, 330),
    150: (1293, 1374, 45.1, 310),
}
STRENGTH = {  # N/mm2, EN 50149
    "CuMg0.2": {80: 460, 100: 450, 107: 440, 120: 430, 150: 420},
    "CuMg0.5": {80: 520, 100: 510, 107: 500, 120: 490, 150: 470},
}
STRANDS = {  # DIN 48201-1: section [mm2], wires, their diameter [mm], mass [kg/km], breaking load [kN]
    10: (10.02, 7, 1.35, 90, 4.02),
    25: (24.25, 7, 2.10, 218, 9.72),
    50: (49.48, 7, 3.00, 446, 19.84),
    70: (65.81, 19, 2.10, 596, 26.38),
    120: (116.99, 19, 2.80, 1060, 46.90),
    150: (147.11, 37, 2.25, 1337, 58.98),
}
ENTRIES = sorted(catalogue().items())
STRANDED = [(name, entry) for name, entry in ENTRIES if entry.wires > 1]


def lay(entry: Entry) -> float:
    """Return by which fraction a strand is heavier than its section, because its wires are helices."""
    return entry.mass_kg_per_km / 1e3 / (entry.area_mm2 * COPPER) - 1.0


def wire_places(wires: int) -> list[tuple[float, float]]:
    """Return radius [diameters] and angle [turns] of all wires: one in the middle, 6 k in ring k."""
    rings = {7: 1, 19: 2, 37: 3}[wires]
    return [(0.0, 0.0), *((float(k), i / (6 * k)) for k in range(1, rings + 1) for i in range(6 * k))]


def second_moment_without_slip(entry: Entry) -> float:
    """Return the second moment of area of a strand whose wires do not slip [m4], wire by wire."""
    assert entry.wire_diameter_mm is not None
    d = entry.wire_diameter_mm * 1e-3
    heights = [ring * d * sin(2.0 * pi * turn) for ring, turn in wire_places(entry.wires)]
    return sum(pi * d**4 / 64.0 + pi * d**2 / 4.0 * height**2 for height in heights)


def duplicates(text: str) -> list[str]:
    """Return the names that stand more than once in an object of a JSON text."""
    found: list[str] = []

    def note(pairs: list[tuple[str, object]]) -> dict[str, object]:
        names = [name for name, _ in pairs]
        found.extend(name for name in set(names) if names.count(name) > 1)
        return dict(pairs)

    json.loads(text, object_pairs_hook=note)
    return found


def rows(page: str) -> list[list[str]]:
    """Return the cells of all rows of a page's tables."""
    return [
        [cell.strip() for cell in line.strip("| ").split("|")] for line in page.splitlines() if "|" in line
    ]


def row(name: str, entry: Entry) -> list[str]:
    """Return the row in which the guide lists a conductor."""
    load = "-" if entry.breaking_load_kN is None else f"{entry.breaking_load_kN:g}"
    strand = [] if entry.wires == 1 else [f"{entry.wires} x {entry.wire_diameter_mm:.2f}"]
    stiffness = [
        f"{entry.youngs_modulus_GPa:g}",
        f"{entry.mass_kg_per_km:g}",
        f"{entry.bending_stiffness_N_m2:g}",
    ]
    return [f"`{name}`", *strand, f"{entry.area_mm2:g}", *stiffness, load]


def test_the_library_has_the_promised_conductors() -> None:
    assert list(library()) == NAMES
    assert list(catalogue()) == NAMES


def test_no_name_stands_twice() -> None:
    text = FILE.read_text(encoding="utf-8")
    assert duplicates(text) == []
    assert duplicates(text.replace('"BzI 70"', '"BzII 70"')) == ["BzII 70"]


def test_every_source_is_used_and_every_entry_has_one() -> None:
    book = json.loads(FILE.read_text(encoding="utf-8"))
    assert {entry["source"] for entry in book["conductors"].values()} == set(book["sources"])
    assert all(len(entry.source) > 200 for entry in catalogue().values())


@pytest.mark.parametrize(("name", "entry"), ENTRIES)
def test_an_entry_is_a_conductor_in_si_units(name: str, entry: Entry) -> None:
    conductor = conductor_named(name)
    assert conductor == Conductor(**conductor.model_dump(exclude_none=True))
    stiffness = entry.youngs_modulus_GPa * 1e3 * entry.area_mm2
    assert conductor.EA == pytest.approx(stiffness, rel=1e-14)  # noqa: SIM300 (EA is no constant)
    assert conductor.rhoA == pytest.approx(entry.mass_kg_per_km * 1e-3, rel=1e-14)
    assert conductor.bending_stiffness == entry.bending_stiffness_N_m2
    assert conductor.thermal_expansion == 17e-6


@pytest.mark.parametrize("area", CONTACT_WIRES)
@pytest.mark.parametrize("material", ALLOYS)
def test_contact_wires_have_the_mass_of_the_standard(area: int, material: str) -> None:
    least, largest, _, _ = CONTACT_WIRES[area]
    entry = catalogue()[f"AC-{area} {material}"]
    assert entry.area_mm2 == area
    assert entry.mass_kg_per_km == (least + largest) / 2.0
    assert entry.mass_kg_per_km == pytest.approx(8.89 * area, abs=0.5)


@pytest.mark.parametrize("area", CONTACT_WIRES)
def test_breaking_loads_of_copper_contact_wires_are_the_printed_ones(area: int) -> None:
    _, _, load, strength = CONTACT_WIRES[area]
    assert catalogue()[f"AC-{area} CuETP"].breaking_load_kN == load
    assert load == pytest.approx(0.97e-3 * area * strength, abs=0.07)
    assert load != pytest.approx(0.95e-3 * area * strength, abs=0.07)


@pytest.mark.parametrize(("material", "area"), [(m, a) for m, areas in STRENGTH.items() for a in areas])
def test_breaking_loads_of_alloys_follow_from_strength_like_those_of_copper(material: str, area: int) -> None:
    load = catalogue()[f"AC-{area} {material}"].breaking_load_kN
    assert load == pytest.approx(0.97e-3 * area * STRENGTH[material][area], abs=0.051)


@pytest.mark.parametrize(("name", "entry"), [item for item in ENTRIES if item[1].wires == 1])
def test_a_contact_wire_bends_like_a_round_wire_of_its_area(name: str, entry: Entry) -> None:
    radius = sqrt(entry.area_mm2 * 1e-6 / pi)
    assert entry.bending_stiffness_N_m2 == pytest.approx(WIRE_GPA * 1e9 * pi * radius**4 / 4.0, rel=5e-4), (
        name
    )


@pytest.mark.parametrize("nominal", STRANDS)
@pytest.mark.parametrize("material", ["Cu", "BzII", "BzI"])
def test_strands_are_those_of_the_standard(nominal: int, material: str) -> None:
    area, wires, diameter, mass, load = STRANDS[nominal]
    entry = catalogue()[f"{material} {nominal}"]
    assert (entry.area_mm2, entry.wires, entry.wire_diameter_mm) == (area, wires, diameter)
    assert entry.mass_kg_per_km == mass
    assert entry.breaking_load_kN == (load if material == "Cu" else None)


@pytest.mark.parametrize(("name", "entry"), STRANDED)
def test_area_and_mass_of_a_strand_are_those_of_its_wires(name: str, entry: Entry) -> None:
    assert entry.wire_diameter_mm is not None
    assert entry.area_mm2 == pytest.approx(entry.wires * pi * entry.wire_diameter_mm**2 / 4.0, rel=1e-3), name
    assert 0.009 < lay(entry) < 0.022, name


def test_a_wrong_mass_is_noticed() -> None:
    entry = catalogue()["BzII 70"]
    for factor in (0.98, 1.02):
        wrong = entry.model_copy(update={"mass_kg_per_km": factor * entry.mass_kg_per_km})
        assert not 0.009 < lay(wrong) < 0.022


@pytest.mark.parametrize(("name", "entry"), STRANDED)
def test_a_strand_is_softer_than_its_wires_and_stiffer_than_aluminium_strands_in_proportion(
    name: str, entry: Entry
) -> None:
    helices = WIRE_GPA * (1.0 - 3.0 * lay(entry))  # mean cos^3 of the angle of lay, to first order
    proportion = {7: 60.0, 19: 57.0, 37: 57.0}[entry.wires] / 70.0
    assert WIRE_GPA * proportion < entry.youngs_modulus_GPa < helices, name


@pytest.mark.parametrize(("name", "entry"), STRANDED)
def test_a_strand_bends_half_as_stiffly_as_without_slip(name: str, entry: Entry) -> None:
    without_slip = WIRE_GPA * 1e9 * second_moment_without_slip(entry)
    assert entry.bending_stiffness_N_m2 == pytest.approx(without_slip / 2.0, rel=5e-4), name
    assert entry.wire_diameter_mm is not None
    wires_alone = WIRE_GPA * 1e9 * entry.wires * pi * (entry.wire_diameter_mm * 1e-3) ** 4 / 64.0
    assert 3.0 * wires_alone < entry.bending_stiffness_N_m2


def test_a_solid_wire_of_120_mm2_is_less_stiff_than_that_of_the_paper() -> None:
    assert 130e9 * (120e-6) ** 2 / (4.0 * pi) == pytest.approx(149.0, abs=0.1)
    assert conductor_named("AC-120 CuETP").EJ < 149.0 < 400.0


def test_an_unknown_name_is_refused_with_a_similar_one() -> None:
    with pytest.raises(InconsistentInputError, match=r"did you mean AC-120 CuMg0\.5"):
        conductor_named("AC-120 CuMg 0,5")
    with pytest.raises(InconsistentInputError, match="has no rope;"):
        conductor_named("rope")


def test_the_library_cannot_be_changed() -> None:
    with pytest.raises(TypeError):
        library()["rope"] = conductor_named("Cu 50")  # pyright: ignore[reportIndexIssue]
    assert "rope" not in library()


def test_the_guide_lists_every_conductor() -> None:
    listed = rows(PAGE.read_text(encoding="utf-8"))
    assert [name for name, entry in ENTRIES if row(name, entry) not in listed] == []
    heavier = catalogue()["Cu 50"].model_copy(update={"mass_kg_per_km": 447.0})
    assert row("Cu 50", heavier) not in listed


def test_the_guide_lists_nothing_else() -> None:
    listed = [
        cells[0].strip("`") for cells in rows(PAGE.read_text(encoding="utf-8")) if cells[0].startswith("`")
    ]
    assert sorted(listed) == sorted(NAMES)


@pytest.mark.parametrize("source", sorted({entry.source for entry in catalogue().values()}))
def test_sources_say_what_is_computed_and_what_is_assumed(source: str) -> None:
    assert "computed" in source
    assert "Young's modulus" in source
    assert "Thermal expansion" in source


@pytest.mark.parametrize(("name", "entry"), STRANDED)
def test_strands_are_as_wide_as_their_outermost_wires(name: str, entry: Entry) -> None:
    assert entry.wire_diameter_mm is not None
    outermost = max(radius for radius, _ in wire_places(entry.wires))
    across = (2.0 * outermost + 1.0) * entry.wire_diameter_mm * 1e-3
    assert conductor_named(name).outer_diameter == pytest.approx(across, rel=1e-14)
    unstated = conductor_named(name).model_copy(update={"diameter": None})
    assert unstated.outer_diameter == pytest.approx(across, rel=0.02)  # what is taken if none is given


@pytest.mark.parametrize(
    ("area", "diameter"), [(80, 10.6), (100, 12.0), (107, 12.3), (120, 13.2), (150, 14.8)]
)
def test_contact_wires_have_the_diameter_of_the_standard(area: int, diameter: float) -> None:
    for material in ALLOYS:
        assert conductor_named(f"AC-{area} {material}").outer_diameter == pytest.approx(1e-3 * diameter)
    solid = 2.0 * sqrt(area * 1e-6 / pi)
    assert 1.0 < 1e-3 * diameter / solid < 1.08  # wider than without grooves
