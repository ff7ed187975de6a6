"""A synthetic result that looks like a form-finding run of equal 65 m spans, from closed forms alone.

The wires are taut strings with point loads, whose kinks are rounded as in a tensioned beam: a point load F
bends it over the length l = sqrt(EJ/T), with the moment F l / 2 exp(-|x| / l).
"""

from __future__ import annotations

import shutil
from collections.abc import Callable
from dataclasses import dataclass, replace
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from catenaria import workflow
from catenaria.line import load_line
from catenaria.report.checks import load_rules
from catenaria.report.html.page import Contents, page
from catenaria.results import (
    Arms,
    Cantilevers,
    Controls,
    Counters,
    Droppers,
    FormResult,
    History,
    Masses,
    Profile,
    Stage,
    Supports,
    Ties,
    WireForm,
)

FloatArray = NDArray[np.float64]

EXAMPLES = Path(__file__).parents[2] / "examples"
BROWSER = any(shutil.which(name) for name in ("chromium", "google-chrome"))
NEEDED = {"test_html_printed.py": BROWSER, "test_html_browser.py": BROWSER and find_spec("playwright")}

collect_ignore = [file for file, installed in NEEDED.items() if not installed]  # extra: browser

SPAN = 65.0
PLACES = np.array([4.0, 13.5, 23.0, 32.5, 42.0, 51.5, 61.0])
T = 15_000.0
TAIL = 0.5


@dataclass(frozen=True)
class Beam:
    """A tensioned beam under upward point forces, which rests without slope at its two tail ends."""

    at: FloatArray
    force: FloatArray
    load: float
    EJ: float
    line: FloatArray

    def height(self, x: FloatArray) -> FloatArray:
        return columns(x, self.at, self.load, self.EJ) @ np.concatenate((self.force, self.line, [1.0]))

    def moment(self, x: FloatArray) -> FloatArray:
        length = np.sqrt(self.EJ / T)
        peaks = np.exp(-np.abs(x[:, None] - self.at) / length) @ self.force
        return np.abs(0.5 * length * peaks - self.load * length**2)


def columns(x: FloatArray, at: FloatArray, load: float, EJ: float) -> FloatArray:
    """Return the height at x for unit forces, a unit straight line and the wire's weight."""
    length = np.sqrt(EJ / T)
    distance = np.abs(x[:, None] - at)
    kinks = -0.5 / T * (distance + length * np.exp(-distance / length))
    return np.column_stack((kinks, np.ones_like(x), x, 0.5 * load * x**2 / T))


def solve_beam(
    held: FloatArray, height: float, loads_at: FloatArray, loads: FloatArray, load: float, EJ: float
) -> Beam:
    """Find the forces that hold a beam at one height at the points `held`."""
    at = np.concatenate((held, loads_at))
    ends = np.array([held[0] - TAIL, held[0] - TAIL + 1e-4, held[-1] + TAIL - 1e-4, held[-1] + TAIL])
    rows = columns(np.concatenate((held, ends)), at, load, EJ)
    n = len(held)
    rows = np.vstack((rows[:n], rows[n + 1] - rows[n], rows[n + 3] - rows[n + 2]))
    unknown = np.concatenate((np.arange(n), [len(at), len(at) + 1]))
    wanted = np.concatenate((np.full(n, height), [0.0, 0.0]))
    known = rows[:, n : len(at)] @ loads + rows[:, -1]
    found: FloatArray = np.linalg.solve(rows[:, unknown], wanted - known).astype(np.float64)
    return Beam(at, np.concatenate((found[:n], loads)), load, EJ, found[n:])


def wire(name: str, beam: Beam, EA: float, top: float) -> WireForm:
    """Build a wire's form; `top` is its height in the starting configuration."""
    at = np.sort(beam.at)
    near = (at[:, None] + np.array([-0.6, -0.3, -0.15, -0.05, 0.0, 0.05, 0.15, 0.3, 0.6])).ravel()
    x = np.unique(np.concatenate((np.linspace(-TAIL, at[-1] + TAIL, 1200), near)))
    x = x[(x >= -TAIL) & (x <= at[-1] + TAIL)]
    z, moment = beam.height(x), beam.moment(x)
    tension = T * np.sqrt(1.0 + np.gradient(z, x) ** 2)
    strain = tension * (1.0 - T / EA) + moment**2 / beam.EJ
    zero = np.zeros_like(x)
    profile = Profile(x * (1.0 - T / EA), x, zero, z, tension, strain, zero + T, moment, x, zero, z)
    start = np.linspace(-TAIL, at[-1] + TAIL, 60)
    return WireForm(
        name=name,
        role=name,
        unstressed_length=at[-1] * (1.0 - T / EA),
        stretched_length=at[-1] + 0.01,
        target_tension=T,
        tension=T - 5.3,
        tension_error=-5.3,
        measure="reaction",
        horizontal_start=T - 5.4,
        horizontal_end=T - 5.4,
        reaction_start=T - 5.3,
        reaction_end=T - 5.3,
        end_force=np.array([[T - 5.3, 0.0, 0.0], [5.3 - T, 0.0, 0.0]]),
        tension_min=float(tension.min()),
        tension_max=float(tension.max()),
        tension_mean=float(tension.mean()),
        travel=0.0942,
        sag=0.00641,
        profile=profile,
        start_x=start,
        start_z=np.full_like(start, top),
    )


def history(
    step: str, joints: tuple[str, ...], control: str, unit: str, droppers: int, end: float
) -> History:
    """Build a run that approaches its dead bands like 1/t."""
    t = np.concatenate(([0.0], np.geomspace(1e-3, end, 420)))
    arrive = 0.7 * end
    tension = np.where(t < arrive, -T * (1.0 - t / arrive), -5.0 - 100.0 / (1.0 + (t - arrive)))
    decay = np.exp(-t[:, None] / (10.0 + 1.5 * np.arange(droppers)))
    size, floor = (2e-3, 1e-5) if unit == "m" else (60.0, 0.02)
    rest = size * decay * np.cos(t[:, None] / 9.0) + floor
    error = np.column_stack((tension, rest))
    velocity = np.column_stack(
        (2e-4 * np.clip(-tension / 100.0, 0.0, 1.0), -2e-4 * np.tanh(rest / size * 5.0))
    )
    joint = T + tension[:, None] + 40.0 * np.arange(len(joints)) * np.exp(-t[:, None] / end)
    growth = np.clip(1.0 + tension / T, 1e-9, None)
    return History(
        step=step,
        time=t,
        step_size=np.gradient(t),
        order=np.where(t > 1.0, 2, 1),
        control_name=(f"{step} tension", *(f"{control} of dropper {i + 1}" for i in range(droppers))),
        control_unit=("N", *([unit] * droppers)),
        error=error,
        parameter=np.cumsum(velocity * np.gradient(t)[:, None], axis=0),
        velocity=velocity,
        joint_name=joints,
        joint_tension=joint,
        reaction=np.repeat((T + tension)[:, None], 2, axis=1),
        kinetic=0.02 * np.exp(-t / 30.0) * np.sin(t) ** 2,
        axial=1300.0 * growth**2,
        bending=0.8 * growth,
    )


def stage(step: str) -> Stage:
    """Build the state of a model of two nodes."""
    zero = np.zeros((2, 3))
    return Stage(step, (step,), np.array([2]), np.arange(2.0), zero, zero, np.ones(2), np.ones(2), np.ones(3))


def counters(step: str, end: float) -> Counters:
    """Build plausible counters."""
    return Counters(step, end, 0.84, 420, 17, 3, 1607, 61, 72, 1452)


def build(spans: int) -> FormResult:
    """Build the result of a line of that many spans."""
    supports = np.linspace(0.0, SPAN * spans, spans + 1)
    x = (supports[:-1, None] + PLACES).ravel()
    n = x.size
    ends = np.array([0.0, SPAN * spans])
    held = np.concatenate((ends[:1], x, ends[1:]))
    lower = solve_beam(held, 0.0, x[:0], x[:0], 9.07, 400.0)
    force = lower.force[1:-1]
    upper = solve_beam(supports, 1.5, x, -force - 1.0, 6.03, 311.0)
    contact = wire("contact wire", lower, 15.6e6, 0.0)
    messenger = wire("messenger wire", upper, 12.5e6, 1.5)
    lowered = np.full_like(x, -1e-5)
    height = np.interp(x, messenger.profile.x, messenger.profile.z)
    names = tuple(f"S{i + 1}" for i in range(spans + 1))
    zero = np.zeros(n)
    controls = (
        *(f"height of dropper {i + 1}" for i in range(n)),
        *(f"force of dropper {i + 1}" for i in range(n)),
    )
    both = (
        history("contact wire", (names[0], names[-1]), "height", "m", n, 492.0),
        history("messenger wire", names, "force", "N", n, 730.0),
    )
    return FormResult(
        name=f"Synthetic line of {spans} spans",
        method="dynamic",
        stop_reason="every control is at rest within 1.1 dead bands",
        droppers=Droppers(
            lower_wire=("contact wire",) * n,
            upper_wire=("messenger wire",) * n,
            span=np.repeat(np.arange(1, spans + 1), 7),
            number=np.tile(np.arange(1, 8), spans),
            x=x,
            position_bottom=np.column_stack((x, zero, lowered)),
            position_top=np.column_stack((x, zero, height)),
            stagger_bottom=zero,
            stagger_top=zero,
            length=height - lowered,
            unstressed_length=(height - lowered) * (1.0 - 7e-5),
            cut_length=(height - lowered) * (1.0 - 7e-5),
            force_top=force + 0.87 * (height - lowered),
            force_bottom=force,
            height=lowered,
            target_height=zero,
            height_error=lowered,
            messenger_height=height,
            force_error=zero + 0.021,
            contact_coordinate=zero + 1.0,
            messenger_coordinate=zero + 1.0,
            on_contact=np.zeros((zero.size, 3)),
            on_messenger=np.zeros((zero.size, 3)),
        ),
        wires=(contact, messenger),
        supports=Supports(
            support=(names[0], names[-1], *names),
            wire=("contact wire", "contact wire", *(["messenger wire"] * (spans + 1))),
            kind=("sliding",) * (spans + 3),
            x=np.concatenate((ends, supports)),
            y=np.zeros(spans + 3),
            z=np.concatenate((ends * 0.0, supports * 0.0 + 1.5)),
            chainage=np.concatenate((ends, supports)),
            stagger=np.zeros(spans + 3),
            height=np.concatenate((ends * 0.0, supports * 0.0 + 1.5)),
            force_x=np.zeros(spans + 3),
            force_y=np.zeros(spans + 3),
            force_z=np.full(spans + 3, -950.0),
            force_lateral=np.zeros(spans + 3),
            tension=np.full(spans + 3, 14_990.0),
            sliding_coordinate=np.concatenate((ends, supports)) + TAIL,
        ),
        controls=Controls(
            name=("contact wire tension", "messenger wire tension", *controls),
            unit=("N", "N", *(["m"] * n), *(["N"] * n)),
            target=np.concatenate(([T, T], zero, force)),
            value=np.concatenate(([T - 5.3, T - 21.0], lowered, force + 0.021)),
            error=np.concatenate(([-5.3, -21.0], lowered, zero + 0.021)),
            dead_band=np.concatenate(([5.0, 20.0], zero + 1e-5, zero + 0.02)),
            parameter=np.concatenate(([0.094, 0.11], zero, zero)),
        ),
        histories=both,
        counters=(counters("contact wire", 492.0), counters("messenger wire", 730.0)),
        stages=(stage("contact wire"), stage("messenger wire")),
        inputs={"gravity": 9.8, "reference_temperature": 15.0},
        versions={"catenaria": "0.1.0"},
    )


def sides(n: int) -> FloatArray:
    """Return 1 and -1 in turn: to the left, to the right."""
    return np.where(np.arange(n) % 2 == 0, 1.0, -1.0)


def staggered(form: WireForm, supports: FloatArray) -> WireForm:
    """Move a wire sideways to the left and right of supports."""
    lateral = np.interp(form.profile.chainage, supports, 0.2 * sides(supports.size))
    return replace(form, profile=replace(form.profile, y=lateral, lateral=lateral))


def stitch(form: WireForm, at: float, name: str) -> WireForm:
    """Cut a stitch wire out of a messenger wire."""
    shape = form.profile
    inside = np.abs(shape.chainage - at) < 9.0
    cut = {field: getattr(shape, field)[inside] for field in shape.__dataclass_fields__}
    below = replace(Profile(**cut), height=cut["height"] - 0.4, z=cut["z"] - 0.4)
    return replace(form, name=name, role="stitch wire", profile=below)


def build_in_space(spans: int) -> FormResult:
    """Build the result of a line with stagger, steady arms, stitch wires and a slack dropper."""
    plane = build(spans)
    chainage = np.linspace(0.0, SPAN * spans, spans + 1)
    names, n = tuple(f"S{i + 1}" for i in range(spans + 1)), spans + 1
    contact, messenger = (staggered(form, chainage) for form in plane.wires)
    stitches = tuple(stitch(messenger, SPAN * i, f"stitch wire S{i + 1}") for i in range(1, spans))
    side = sides(n)
    tip = np.column_stack((chainage, 0.2 * side, 0.0 * side))
    hinge = tip + np.column_stack((0.0 * side, 1.2 * side, 0.3 + 0.0 * side))
    radial = np.where(np.arange(n) == 1, -30.0, 218.0)
    one = np.ones(n)
    droppers, slack = plane.droppers, plane.droppers.force_bottom.copy()
    slack[2] = -1.5
    leaning = np.interp(droppers.x, chainage, 0.2 * side)
    return replace(
        plane,
        name=f"Synthetic line of {spans} spans in space",
        droppers=replace(droppers, force_bottom=slack, stagger_bottom=leaning, stagger_top=0.5 * leaning),
        wires=(contact, messenger, *stitches),
        supports=Supports(
            support=names * 2,
            wire=("contact wire",) * n + ("messenger wire",) * n,
            kind=("arm",) * n + ("sliding",) * n,
            x=np.tile(chainage, 2),
            y=np.tile(0.2 * side, 2),
            z=np.repeat([0.0, 1.5], n),
            chainage=np.tile(chainage, 2),
            stagger=np.tile(0.2 * side, 2),
            height=np.repeat([0.0, 1.5], n),
            force_x=np.zeros(2 * n),
            force_y=np.tile(-218.0 * side, 2),
            force_z=np.full(2 * n, -950.0),
            force_lateral=np.tile(-218.0 * side, 2),
            tension=np.full(2 * n, 14_990.0),
            sliding_coordinate=np.tile(chainage, 2),
        ),
        arms=Arms(
            names, ("contact wire",) * n, ("pull-off",) * n, chainage, hinge, tip, 1.4 * side, 0.3 * one,
            1.24 * one, -0.25 * one, radial * 1.1, radial, 40.0 * one, 80.0 * one,
        ),
        ties=Ties(("stitch wire S2",) * 2, ("messenger wire",) * 2, np.array([0, 1]), np.array([56.0, 74.0]),
                  np.array([56.0, 74.0]), np.array([[2e3, 0.0, -90.0], [-2e3, 0.0, -90.0]])),
        masses=Masses(("section insulator",), ("contact wire",), one[:1], one[:1], 12.5 * one[:1]),
        cantilevers=Cantilevers(("S2",), tip[1:2], hinge[1:2], np.array([[0.0, 30.0, -700.0]])),
        controls=controls_in_space(plane, stitches),
        histories=(history_in_space(plane, stitches),),
        counters=(counters("line", 492.0),),
        stages=(stage("line"),),
    )  # fmt: skip


def controls_in_space(plane: FormResult, stitches: tuple[WireForm, ...]) -> Controls:
    """Add the tensions of stitch wires to the controls."""
    controls, more = plane.controls, np.full(len(stitches), 2_000.0)
    return Controls(
        name=(*controls.name, *(f"{form.name} tension" for form in stitches)),
        unit=(*controls.unit, *("N",) * more.size),
        target=np.append(controls.target, more),
        value=np.append(controls.value, more),
        error=np.append(controls.error, 0.0 * more),
        dead_band=np.append(controls.dead_band, 0.0 * more + 5.0),
        parameter=np.append(controls.parameter, 0.0 * more),
    )


def history_in_space(plane: FormResult, stitches: tuple[WireForm, ...]) -> History:
    """Turn the first controls of the first step into those of all tensions."""
    tensions = tuple(f"{form.name} tension" for form in (*plane.wires, *stitches))
    first, n = plane.histories[0], len(tensions)
    return replace(
        first,
        step="line",
        control_name=(*tensions, *first.control_name[n:]),
        control_unit=("N",) * n + first.control_unit[n:],
    )


@pytest.fixture(scope="session")
def make_in_space() -> Callable[[int], FormResult]:
    return build_in_space


@pytest.fixture(scope="session")
def in_space() -> FormResult:
    return build_in_space(3)


@pytest.fixture(scope="session")
def make_result() -> Callable[[int], FormResult]:
    return build


@pytest.fixture(scope="session")
def result() -> FormResult:
    return build(3)


@pytest.fixture(scope="session")
def solved() -> Callable[[str], FormResult]:
    """Return the form of an example by the name of its file, found once."""
    found: dict[str, FormResult] = {}

    def find(name: str, method: str = "direct") -> FormResult:
        key = f"{name} {method}"
        if key not in found:
            found[key] = workflow.solve(load_line(EXAMPLES / f"{name}.yaml"), method, rebuild="none")
        return found[key]

    return find


@pytest.fixture(scope="session")
def paper(solved: Callable[[str], FormResult]) -> FormResult:
    """Return the form of the paper's line."""
    return solved("yang2017_three_span")


@pytest.fixture(scope="session")
def curve(solved: Callable[[str], FormResult]) -> FormResult:
    """Return the form of a line in space."""
    return solved("curve_800m")


@pytest.fixture(scope="session")
def curve_page(curve: FormResult) -> str:
    """Return the report of a line in space."""
    return page(Contents(curve, load_rules(), speed=200 / 3.6))
