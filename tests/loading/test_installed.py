"""Errors of installation in a built line: each of them against the same line made in another way."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from catenaria.discretise.spatial.loaded import (
    material_at,
    point_load,
    with_dropper_lengths,
    with_moved_supports,
)
from catenaria.formfinding.direct import Direct
from catenaria.line import Line, load_line
from catenaria.line.installation import Installation, usual_installation
from catenaria.loading.built_line import BuiltLine
from catenaria.loading.errors_of_installation import GROUPS, error_sources
from catenaria.loading.installed import InstalledLine
from catenaria.loading.sensitivity import linearise
from catenaria.solvers.linear import factorise

FloatArray = NDArray[np.float64]
EXAMPLES = Path(__file__).parents[2] / "examples"
FEW = 30  # of the errors of a line that are tried one by one
HELD = {"anchor_start": {"height": 5.5, "stagger": 0.0}, "anchor_end": {"height": 5.5, "stagger": 0.0}}


def shortened(name: str, **changes: Any) -> Line:
    """An example cut down to its first three spans."""
    tree = load_line(EXAMPLES / f"{name}.yaml").model_dump(mode="json")
    tree["spans"], tree["supports"] = tree["spans"][:3], tree["supports"][:4]
    tree["mid_point"], tree["point_masses"] = None, []
    return Line.model_validate(tree | changes)


def made(line: Line, errors: Installation) -> InstalledLine:
    built = BuiltLine.of(line, Direct().find_form(line))
    return InstalledLine.of(built, error_sources(built, errors))


LINES = ["yang2017_three_span", "simple_60m", "stitched_re250", "curve_800m", "bridge"]


@pytest.fixture(scope="module", params=LINES)
def installed(request: pytest.FixtureRequest) -> InstalledLine:
    return made(shortened(request.param), usual_installation())


def error(installed: InstalledLine, group: str, part: int, size: float) -> FloatArray:
    """Return the errors of which one is not zero."""
    own = installed.sources.of(group) & (installed.sources.part == part)
    return np.where(own, size, 0.0)


def heights(installed: InstalledLine, p: FloatArray) -> FloatArray:
    return installed.outputs(installed.rest(p), p)[: installed.model.length.size]


def test_there_are_errors_of_every_group(installed: InstalledLine) -> None:
    model, sources = installed.model, installed.sources
    assert sources.groups == GROUPS
    assert sources.of("dropper length").sum() == sources.of("dropper position").sum() == model.length.size
    assert sources.of("contact height", "messenger height").sum() == model.hold_s.size
    assert sources.of("tension").sum() == sum(installed.built.devices.moves)
    assert len(set(zip(sources.group, sources.name, strict=True))) == sources.count


def test_no_errors_are_the_line_that_was_found(installed: InstalledLine) -> None:
    nothing = np.zeros(installed.sources.count)
    outputs = installed.outputs(installed.rest(nothing), nothing)
    found = installed.built.result.droppers
    assert outputs[: found.height.size] == pytest.approx(found.height, abs=1e-9)
    z = installed.built.at_rest
    assert outputs[found.height.size :][: found.height.size] == pytest.approx(z.dropper_pull, abs=1e-5)


def test_the_section_without_errors_has_none(installed: InstalledLine) -> None:
    assert error_sources(installed.built, Installation()).count == 0


def test_lengths_are_those_of_a_line_with_other_droppers(installed: InstalledLine) -> None:
    model, built = installed.model, installed.built
    change = np.random.default_rng(1).normal(0.0, 2e-3, model.length.size)
    p = np.zeros(installed.sources.count)
    p[installed.sources.of("dropper length")] = change
    length = model.unknowns.start[model.length] + change
    other = built.under(model=with_dropper_lengths(model, length))
    assert heights(installed, p) == pytest.approx(other.height, abs=2e-8)
    assert np.abs(other.height - built.at_rest.height).max() > 1e-3


def test_supports_are_those_of_a_line_on_moved_supports(installed: InstalledLine) -> None:
    model, frame = installed.model, installed.model.layout.holds.frame
    on, inner = model.layout.holds.wire, model.layout.holds.support
    rigid = np.array(model.layout.holds.kind) != "cantilever"
    between = (inner > 0) & (inner < inner.max()) & rigid  # wires' ends do not move with these
    rng = np.random.default_rng(2)
    up, left = (np.where(between, rng.normal(0.0, 5e-3, on.size), 0.0) for _ in range(2))
    p = np.zeros(installed.sources.count)
    for groups, size in (
        (("contact height", "messenger height"), up),
        (("contact stagger", "messenger stagger"), left),
    ):
        own = installed.sources.of(*groups)
        p[own] = size[installed.sources.part[own]]
    shift = up[:, None] * frame.up + left[:, None] * frame.left
    other = installed.built.under(model=with_moved_supports(model, shift))
    assert heights(installed, p) == pytest.approx(other.height, abs=2e-8)
    assert np.abs(other.height - installed.built.at_rest.height).max() > 1e-4


def test_a_cantilever_moves_with_its_root() -> None:
    installed = made(shortened("simple_60m"), usual_installation())
    holds = installed.model.layout.holds
    i = holds.kind.index("cantilever", 1)
    z = installed.rest(error(installed, "messenger height", i, 3e-3))
    tip = [installed.model.hold_carrier.evaluate(x, x[installed.model.hold_s]).r[i] for x in (installed.z, z)]
    assert (tip[1] - tip[0])[2] == pytest.approx(3e-3, rel=0.05)


def test_the_ends_of_wires_move_with_their_last_support_unless_they_are_given() -> None:
    plain = shortened("yang2017_three_span")
    given = plain.contact_wire.model_copy(
        update={"anchor_start": {"height": plain.supports[0].contact_wire.height}}  # type: ignore[union-attr]
    )
    held = Line.model_validate(
        plain.model_dump(mode="json") | {"contact_wire": given.model_dump(mode="json", warnings=False)}
    )
    for line, moves in ((plain, True), (held, False)):
        installed = made(line, usual_installation())
        z = installed.rest(error(installed, "contact height", 0, 4e-3))
        start = installed.model.wires[0].nodes[0, :3]
        assert (z - installed.z)[start[2]] == pytest.approx(4e-3 if moves else 0.0, abs=1e-9)


def test_clamps_sit_where_they_should_not(installed: InstalledLine) -> None:
    model, size = installed.model, 0.02
    i = model.length.size // 2
    z = installed.rest(error(installed, "dropper position", i, size))
    on, at = model.lower_carrier, model.layout.droppers.frame.along[i]
    before, behind = (on.evaluate(x, x[model.lower_s]).r[i] for x in (installed.z, z))
    assert (behind - before) @ at == pytest.approx(size, rel=0.01)
    assert z[model.upper_s[i]] - installed.z[model.upper_s[i]] == pytest.approx(size, rel=0.05)
    others = np.arange(model.length.size) != i
    assert np.array_equal(z[model.lower_s][others], model.unknowns.start[model.lower_s][others])


def test_tensions_are_what_devices_give(installed: InstalledLine) -> None:
    p = error(installed, "tension", 0, 120.0)
    n = installed.model.length.size
    less, more = (installed.outputs(installed.rest(x), x)[2 * n :] for x in (0.0 * p, p))
    at_end = int(installed.model.layout.wires[0].tension.at_end)
    if installed.built.devices.stiffness[0] > 0.0:  # a spring gives way
        assert 60.0 < more[at_end] - less[at_end] < 120.0
    else:
        assert more[at_end] - less[at_end] == pytest.approx(120.0, abs=1e-3)


def test_sensitivities_are_differences_of_lines_at_rest(installed: InstalledLine) -> None:
    linear, n = linearise(installed), installed.model.length.size
    rng = np.random.default_rng(3)
    few = rng.choice(installed.sources.count, FEW, replace=False)
    for k in few.tolist():
        step = 10.0 if installed.sources.unit[k] == "N" else 1e-4
        p = np.where(np.arange(installed.sources.count) == k, step, 0.0)
        above, below = (installed.outputs(installed.rest(way * p), way * p) for way in (1.0, -1.0))
        slope = (above - below) / (2.0 * step)
        for part, rest in ((slice(0, n), 5e-9), (slice(n, None), 4e-5)):  # m and N to which lines rest
            near = 2e-3 * np.abs(slope[part]).max() + rest / step
            assert linear.slope[part, k] == pytest.approx(slope[part], abs=near)
    assert np.abs(linear.slope[:n, few]).max() > 0.1


def test_elasticities_change_as_those_of_samples_at_rest(installed: InstalledLine) -> None:
    line, linear = installed.built.line, linearise(installed)
    x = np.array(line.support_x)
    middle = material_at(installed.model, 0, line.alignment, 0.5 * (x[:-1] + x[1:]))
    b = point_load(installed.model, 0, middle, np.tile([0.0, 0.0, 1.0], (middle.size, 1)))
    errors = installed.sources.distribution.draw(4, 0, 3)
    for p in errors:
        factors = factorise(installed.problem_with(p).jacobian(installed.rest(p)))
        e = np.array([row @ factors.solve(row) for row in b])
        change = np.abs(e - linear.elasticity).max()
        assert linear.elasticities(p) == pytest.approx(e, abs=0.1 * change)
        assert change > 1e-8


def test_the_linearised_line_is_off_by_squares_of_errors(installed: InstalledLine) -> None:
    linear, n = linearise(installed), installed.model.length.size
    [p] = installed.sources.distribution.draw(6, 0, 1)
    off = [np.abs(heights(installed, x) - linear.outputs(x)[:n]).max() for x in (p, 0.5 * p, 0.25 * p)]
    assert 3.0 < off[0] / off[1] < 5.0
    assert 3.0 < off[1] / off[2] < 5.0


def test_a_mirrored_line_has_mirrored_sensitivities() -> None:
    installed = made(shortened("yang2017_three_span"), usual_installation())
    slope = linearise(installed).slope[: installed.model.length.size]
    for group in ("dropper length", "contact height", "messenger height"):
        own = slope[:, installed.sources.of(group)]
        assert own[::-1, ::-1] == pytest.approx(own, abs=2e-3)  # tensions are measured at one end
        assert np.abs(own[:, ::-1] - own).max() > 0.1
    clamps = slope[:, installed.sources.of("dropper position")]
    assert clamps[::-1, ::-1] == pytest.approx(-clamps, abs=2e-3)
    assert np.abs(clamps).max() > 0.02


def string(x: FloatArray, tension: float) -> FloatArray:
    """Return the stiffness of a string with nodes at x."""
    k = tension / np.diff(x)
    K = np.diag(np.append(k, 0.0) + np.append(0.0, k))
    return K - np.diag(k, 1) - np.diag(k, -1)


def condensed(
    K: FloatArray, kept: NDArray[np.bool_], held: NDArray[np.bool_]
) -> tuple[FloatArray, FloatArray]:
    """Return what nodes that are kept feel of each other and of those that are held."""
    free = ~kept & ~held
    through = np.linalg.solve(K[np.ix_(free, free)], K[free]) if free.any() else np.zeros((0, kept.size))
    K = K - K[:, free] @ through
    return K[np.ix_(kept, kept)], K[np.ix_(kept, held)]


@pytest.mark.parametrize("wrong", [1.0, 1.1])
def test_two_taut_strings_have_the_same_sensitivities(wrong: float) -> None:
    """Kc h = f and Km (h + l) + Bm H = -f, by which one longer dropper changes all heights."""
    line = shortened("yang2017_three_span")
    installed = made(line, usual_installation())
    slope = linearise(installed).slope[: installed.model.length.size]
    supports, droppers = np.array(line.support_x), np.array(line.dropper_x)
    x = np.sort(np.concatenate((supports, droppers)))
    kept, held = np.isin(x, droppers), np.isin(x, supports)
    Kc, Bc = condensed(wrong * string(x, 15e3), kept, np.isin(x, supports[[0, -1]]))
    Km, Bm = condensed(string(x, 15e3), kept, held)
    closed = {
        "dropper length": -np.linalg.solve(Kc + Km, Km),
        "messenger height": -np.linalg.solve(Kc + Km, Bm),
        "contact height": -np.linalg.solve(Kc + Km, Bc),
    }
    off = [np.abs(slope[:, installed.sources.of(group)] - value).max() for group, value in closed.items()]
    if wrong == 1.0:
        assert max(off) < 6e-3  # of 0.7; bending, and droppers that stretch
    else:
        assert min(off) > 1e-2


def test_known_errors_hold_in_every_sample() -> None:
    tree = {"droppers": [{"span": 1, "dropper": 4, "length": "-4 mm"}]}
    installed = made(shortened("yang2017_three_span"), Installation.model_validate({"known": tree}))
    assert installed.sources.name == ("1/4",)
    errors = installed.sources.distribution.draw(1, 0, 3)
    assert np.array_equal(errors, np.full((3, 1), -4e-3))
    higher = heights(installed, errors[0]) - heights(installed, 0.0 * errors[0])
    assert np.argmax(higher) == 3
    assert 1e-3 < higher[3] < 4e-3


def test_factors_that_do_not_serve_are_made_anew() -> None:
    installed = made(shortened("yang2017_three_span"), usual_installation())
    p = 40.0 * installed.sources.distribution.draw(1, 0, 1)[0] * ~installed.sources.of("tension")
    coarse = installed.rest(p)
    fine = installed.built.under(
        installed.constants @ p,
        model=replace(installed.model),
    )
    assert coarse == pytest.approx(fine.z, abs=1e-4)
