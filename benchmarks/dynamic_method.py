"""Time the dynamic equilibrium method on the paper's three-span line, both wires, warm, with its counters.

Run with: python benchmarks/dynamic_method.py [--runs 5] [--line FILE]
"""

from __future__ import annotations

import argparse
import os
import platform
import resource
import statistics
from collections.abc import Sequence
from pathlib import Path
from time import perf_counter

from catenaria.line import Line, load_line
from catenaria.results import FormResult
from catenaria.workflow import solve

EXAMPLE = Path(__file__).parents[1] / "examples" / "yang2017_three_span.yaml"
LIMIT = 2.0  # s, both wires, paper's control values
MEMORY_LIMIT = 500.0  # MB


def timed(line: Line) -> tuple[float, FormResult]:
    """Return the wall time of one run and its result."""
    begin = perf_counter()
    result = solve(line, method="dynamic")
    return perf_counter() - begin, result


def report(walls: Sequence[float], result: FormResult) -> str:
    """Return what was measured as text."""
    rows = [
        f"{platform.machine()}, {os.cpu_count()} processors, Python {platform.python_version()}",
        f"{result.name}: {len(walls)} warm runs, both wires: median {statistics.median(walls):.3f} s, "
        f"{min(walls):.3f} to {max(walls):.3f} s (limit {LIMIT:g} s)",
    ]
    for work in result.counters:
        rows.append(
            f"  {work.step}: {work.unknowns} unknowns, {work.simulated_time:.0f} s simulated, "
            f"{work.wall_time:.3f} s wall; "
            f"{work.steps} steps, {work.rejected} rejected, {work.newton_failures} Newton failures, "
            f"{work.residuals} residuals, {work.jacobians} Jacobians, {work.factorisations} factorisations"
        )
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0
    rows.append(f"  largest memory of the process: {memory:.0f} MB (limit {MEMORY_LIMIT:g} MB)")
    return "\n".join(rows)


def main() -> None:
    """Run the benchmark."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--runs", type=int, default=5, help="number of timed runs")
    parser.add_argument("--line", type=Path, default=EXAMPLE, help="line file")
    arguments = parser.parse_args()
    line = load_line(arguments.line)
    solve(line, method="dynamic")  # compiles or loads the kernels
    measured = [timed(line) for _ in range(arguments.runs)]
    print(report([wall for wall, _ in measured], measured[-1][1]))


if __name__ == "__main__":
    main()
