"""Time the direct method on all examples that are lines in space, warm, and hold them to what is wanted.

Run with: python benchmarks/lines_in_space.py [--runs 15] [--line FILE ...] [--orderings] [--dynamic bridge]
"""

from __future__ import annotations

import argparse
import os
import platform
import statistics
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter, process_time
from typing import get_args

import numpy as np

from catenaria.discretise.spatial.demands import to_find
from catenaria.discretise.spatial.lay_out import lay_out
from catenaria.discretise.spatial.model import guessed_model
from catenaria.errors import LineFileError, UnsupportedError
from catenaria.formfinding.spatial.direct import find_directly
from catenaria.formfinding.static_problem import find_root, static_problem
from catenaria.line import Line, load_line
from catenaria.solvers.linear import ColumnOrdering
from catenaria.solvers.newton import NewtonOptions
from catenaria.workflow import solve

EXAMPLES = Path(__file__).parents[1] / "examples"
UNIT = 65.0  # m, a usual span
RESIDUAL = "residual of nodes over the largest tension"  # row of the audit
ITERATIONS, TIME, SHARE, CHANGE = 12, 20.0, 1e-6, 0.05e-3  # limits: Newton, ms for 65 m, N/N, m


@dataclass(frozen=True)
class Times:
    """Median wall time and median processor time [ms].

    One thread computes, so that the second is what the first would be on a machine with nothing else to do.
    """

    wall: float
    processor: float


@dataclass(frozen=True)
class Measured:
    """What a line took: unknowns, Newton iterations, times [ms], residual over tension, change [m].

    And whether audit and rebuild passed.
    """

    unknowns: int
    iterations: int
    direct: Times
    complete: Times
    residual: float
    change: float
    passed: bool


def lines_in_space(files: Sequence[Path]) -> dict[str, Line]:
    """Return the lines of these files that are not plane, by the names of the files."""
    lines: dict[str, Line] = {}
    for file in files:
        try:
            line = load_line(file)
        except (LineFileError, UnsupportedError):  # load cases, errors, structures: no lines
            continue
        if not line.plane:
            lines[file.stem] = line
    return lines


def measure(line: Line, runs: int) -> Measured:
    """Time a line with and without audit and rebuild."""
    result = solve(line, method="direct")
    work, audit, rebuilt = result.counters[0], result.audit, result.rebuilt
    heights = (rebuilt.height, rebuilt.messenger_height)
    return Measured(
        work.unknowns,
        work.steps,
        median(lambda: find_directly(line, None), runs),
        median(lambda: solve(line, method="direct"), runs),
        float(audit.deviation[audit.name.index(RESIDUAL)]),
        max(float(np.abs(comeback.change).max()) for comeback in heights),
        audit.passed and rebuilt.passed,
    )


def median(run: Callable[[], object], runs: int) -> Times:
    """Return the median times of some runs."""
    walls: list[float] = []
    processor: list[float] = []
    for _ in range(runs):
        begin, busy = perf_counter(), process_time()
        run()
        walls.append(1e3 * (perf_counter() - begin))
        processor.append(1e3 * (process_time() - busy))
    return Times(statistics.median(walls), statistics.median(processor))


def table(lines: dict[str, Line], runs: int) -> Iterator[str]:
    """Yield what is measured, line by line, and what misses its limit."""
    times = f"{'wall':>10} {'processor':>10} {f'of {UNIT:g} m':>10}"
    yield f"{'':52}{'direct':<32}with audit and rebuild"
    heads = f"{'spans':>5}{'m':>6}{'unknowns':>9}{'Newton':>7}"
    yield f"{'':22}{heads}{times}{times}{'residual':>10}{'rebuild':>12}"
    for name, line in lines.items():
        m, share = measure(line, runs), UNIT / line.length
        yield (
            f"{name:22}{len(line.spans):5}{line.length:6.0f}{m.unknowns:9}{m.iterations:7}"
            f"{_row(m.direct, share)}{_row(m.complete, share)}{m.residual:10.0e}{1e3 * m.change:9.0e} mm"
            f"{'' if _fits(m, share) else '  MISSED'}"
        )
    yield (
        f"limits: {ITERATIONS} iterations, direct method {TIME:g} ms of the processor for {UNIT:g} m, "
        f"residual {SHARE:g} of the largest tension, rebuild {1e3 * CHANGE:g} mm"
    )


def _row(times: Times, share: float) -> str:
    return f"{times.wall:7.1f} ms {times.processor:7.1f} ms {times.processor * share:7.2f} ms"


def _fits(m: Measured, share: float) -> bool:
    quick = m.iterations <= ITERATIONS and m.direct.processor * share < TIME
    return m.passed and quick and m.residual < SHARE and m.change < CHANGE


def orderings(line: Line, runs: int) -> Iterator[str]:
    """Yield the time of Newton's method on a line by the column ordering of the sparse LU."""
    model = guessed_model(lay_out(line))
    z = model.unknowns.start
    system = to_find(model, z)
    for ordering in get_args(ColumnOrdering):
        options = NewtonOptions(permc_spec=ordering)
        time = median(lambda options=options: find_root(static_problem(system), z, options), runs)
        yield f"  {ordering:16}{time.wall:8.1f} ms, {time.processor:.1f} ms of processor"


def dynamic(line: Line) -> str:
    """Return what one run of the dynamic method took."""
    begin, busy = perf_counter(), process_time()
    work = solve(line, method="dynamic", rebuild="none").counters[0]
    wall, processor = perf_counter() - begin, process_time() - busy
    return (
        f"{wall:.1f} s, {processor:.1f} s of processor; {work.unknowns} unknowns, "
        f"{work.simulated_time:.0f} s simulated; {work.steps} steps, {work.rejected} rejected, "
        f"{work.newton_failures} Newton failures, {work.residuals} residuals, "
        f"{work.factorisations} factorisations"
    )


def main() -> None:
    """Run the benchmark."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--runs", type=int, default=15, help="number of timed runs")
    parser.add_argument("--line", type=Path, nargs="+", help="line files instead of the examples")
    parser.add_argument("--orderings", action="store_true", help="compare column orderings of the sparse LU")
    parser.add_argument("--dynamic", nargs="*", default=[], help="names of lines for the dynamic method too")
    arguments = parser.parse_args()
    lines = lines_in_space(arguments.line or sorted(EXAMPLES.glob("*.yaml")))
    print(f"{platform.machine()}, {os.cpu_count()} processors, Python {platform.python_version()}; ", end="")
    print(f"medians of {arguments.runs} warm runs")
    for row in table(lines, arguments.runs):
        print(row)
    if arguments.orderings:
        for name, line in lines.items():
            print(f"{name}, Newton's method by ordering:")
            for row in orderings(line, arguments.runs):
                print(row)
    for name in arguments.dynamic:
        print(f"{name}, dynamic method: {dynamic(lines[name])}")


if __name__ == "__main__":
    main()
