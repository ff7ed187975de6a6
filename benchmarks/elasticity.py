"""Time the elasticity of a line of 25 spans, and say how far it is from the line with all nonlinearities.

Run with: python benchmarks/elasticity.py [--force 100] [--spans 25] [--every 100] [--line FILE ...]
"""

from __future__ import annotations

import argparse
import os
import platform
from collections.abc import Sequence
from pathlib import Path
from time import perf_counter, process_time

import numpy as np

from catenaria.formfinding.direct import Direct
from catenaria.line import Line, load_line
from catenaria.loading.built_line import BuiltLine
from catenaria.loading.elasticity import Wanted, elasticity_of
from catenaria.loading.nonlinear_pushes import NonlinearPushes
from catenaria.loading.push_points import push_points
from catenaria.loading.reduced import ReducedLine, push

EXAMPLES = Path(__file__).parents[1] / "examples"
LONG = EXAMPLES / "simple_60m.yaml"
OTHERS = ("yang2017_three_span", "stitched_re250", "two_contact_wires_3kv", "curve_800m", "bridge")
SPACING, LIMIT = 0.5, 10.0  # m, and s for 25 spans on two processors


def lengthened(line: Line, spans: int) -> Line:
    """Return a line of equal spans with its second one repeated, on supports that go on alternating."""
    data = line.model_dump(mode="json")
    *supports, last = data["supports"]
    while len(supports) < spans:
        supports.append(dict(supports[-2], name=f"S{len(supports) + 1}"))
    data["supports"] = [*supports, dict(last, name=f"S{spans + 1}")]
    data["spans"] = (data["spans"] + [data["spans"][1]] * spans)[:spans]
    return Line.model_validate(data)


def whole(name: str, line: Line, force: float) -> tuple[str, float]:
    """Return what a whole study takes, and its processor time [s].

    One thread computes: that is the wall time on a machine with nothing else to do.
    """
    built = BuiltLine.of(line, Direct().find_form(line))
    begin, busy = perf_counter(), process_time()
    study = elasticity_of(built, Wanted(force, SPACING))
    wall, busy = perf_counter() - begin, process_time() - busy
    count = study.points.chainage.size
    return (
        f"{name:22}{len(line.spans):6}{built.model.unknowns.size:9}{count:8}{wall:8.2f} s{busy:8.2f} s"
        f"{count / busy:8.0f}{100.0 * study.nonuniformity:8.1f} %"
    ), busy


def errors(name: str, line: Line, force: float, every: int) -> str:
    """Return how far the linearised line is from the nonlinear one, at some points."""
    built = BuiltLine.of(line, Direct().find_form(line))
    reduced = ReducedLine.of(built)
    points = push_points(line, reduced.model, SPACING)
    pushes = push(reduced, reduced.respond(points.forces), force)
    some = np.arange(every // 2, points.chainage.size, every)
    begin = process_time()
    pushed = NonlinearPushes(built, reduced, points.forces, np.zeros(points.chainage.size), pushes, force)
    elasticity, slack = pushed.at(some)
    each = 1e3 * (process_time() - begin) / some.size
    linear = pushes.elasticity[some]
    error = np.abs(linear - elasticity)
    same = np.all(slack == pushes.slack[some], axis=1)
    return (
        f"{name:22}{some.size:8}{1e3 * np.median(error):13.5f}{1e3 * error.max():10.5f} mm/N"
        f"{100.0 * error.max() / elasticity.max():8.2f} %{np.count_nonzero(same):6} of {some.size}"
        f"{pushes.slack.sum(axis=1).max():6}{each:10.1f} ms"
    )


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the benchmark."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--force", type=float, nargs="+", default=[100.0, 200.0], help="N")
    parser.add_argument("--spans", type=int, default=25, help="of the long line")
    parser.add_argument("--every", type=int, default=40, help="of how many points one is compared")
    parser.add_argument("--line", type=Path, nargs="+", help="line files instead of the examples")
    given = parser.parse_args(arguments)
    files: list[Path] = given.line or [EXAMPLES / f"{name}.yaml" for name in OTHERS]
    load = os.getloadavg()[0]
    machine = f"{platform.machine()}, {os.cpu_count()} processors, Python {platform.python_version()}"
    print(f"{machine}, load {load:.1f}")
    print(f"\n{'':22}{'spans':>6}{'unknowns':>9}{'points':>8}{'wall':>10}{'busy':>10}{'per s':>8}{'u':>10}")
    long = lengthened(load_line(LONG), given.spans)
    lines = {f"{LONG.stem}, {given.spans} spans": long} | {file.stem: load_line(file) for file in files}
    times: list[float] = []
    for name, line in lines.items():
        text, busy = whole(name, line, given.force[0])
        times.append(busy)
        print(text)
    verdict = "reached" if times[0] < LIMIT else "MISSED"
    print(f"wanted: {given.spans} spans in below {LIMIT:g} s: {times[0]:.1f} s, {verdict}")
    heads = f"{'points':>8}{'median':>13}{'largest':>10}{'':5}{'of max':>10}{'same slack':>11}{'most':>6}"
    for force in given.force:
        print(f"\nlinearised beside nonlinear, {force:g} N\n{'':22}{heads}{'nonlinear':>13}")
        for name, line in lines.items():
            print(errors(name, line, force, given.every))


if __name__ == "__main__":
    main()
