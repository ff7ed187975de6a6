"""Time tolerance studies: what a sample takes, and 10,000 of the paper's line on two processors.

Run with: python benchmarks/tolerance.py [--samples 10000] [--workers 1 2] [--line FILE ...]
"""

from __future__ import annotations

import argparse
import os
import platform
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from time import perf_counter, process_time

import numpy as np

from catenaria.line import load_line
from catenaria.line.installation import usual_installation
from catenaria.loading.built_line import BuiltLine
from catenaria.loading.errors_of_installation import error_sources
from catenaria.loading.installed import InstalledLine
from catenaria.loading.sensitivity import linearise
from catenaria.loading.tolerance import Options, study_tolerances
from catenaria.results.tolerance import ToleranceStudy
from catenaria.workflow import solve

EXAMPLES = Path(__file__).parents[1] / "examples"
LINES = ("yang2017_three_span", "simple_60m", "stitched_re250", "compound")
LIMIT = 60.0  # s for 10,000 samples of the paper's line on two processors
FEW = 100


def parts(file: Path) -> str:
    """Return what the parts of a study of a line take, of the processor."""
    line = load_line(file)
    built = BuiltLine.of(line, solve(line))
    sources = error_sources(built, usual_installation())
    begin = process_time()
    installed = InstalledLine.of(built, sources)
    _ = installed.factors, installed.constants
    ready = process_time()
    linearise(installed)
    linear = process_time()
    errors = sources.distribution.draw(1, 0, FEW)
    _ = [installed.outputs(installed.rest(p), p) for p in errors]
    sample = 1e3 * (process_time() - linear) / FEW
    return (
        f"{file.stem:22}{installed.z.size:9}{sources.count:8}{1e3 * (ready - begin):10.0f} ms"
        f"{1e3 * (linear - ready):10.0f} ms{sample:10.2f} ms"
    )


def study(file: Path, options: Options) -> tuple[ToleranceStudy, str]:
    """Return a study and what it took."""
    line = load_line(file)
    result = solve(line)
    begin = perf_counter()
    found = study_tolerances(line, result, usual_installation(), options)
    wall = perf_counter() - begin
    share = 100.0 * found.event("leaving")[0]
    rate = f"{options.samples / wall:8.0f} samples/s"
    return (
        found,
        f"{options.model:10}{options.workers:3} workers{wall:8.1f} s {rate}   leaving: {share:.2f} %",
    )


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the benchmark."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--samples", type=int, default=10_000, help="number of samples")
    parser.add_argument("--workers", type=int, nargs="+", default=[1, 2], help="numbers of processes")
    parser.add_argument("--line", type=Path, nargs="+", help="line files instead of the examples")
    given = parser.parse_args(arguments)
    files: list[Path] = given.line or [EXAMPLES / f"{name}.yaml" for name in LINES]
    machine = f"{platform.machine()}, {os.cpu_count()} processors, Python {platform.python_version()}"
    print(f"{machine}, load {os.getloadavg()[0]:.1f}")
    head = f"{'unknowns':>9}{'errors':>8}{'set up':>13}{'linearise':>13}{'sample':>13}"
    print(f"{'processor time of':22}{head}")
    for file in files:
        print(parts(file))
    print(f"\n{files[0].stem}, {given.samples} samples, wall time with the linearised line and statistics:")
    _, text = study(files[0], Options(given.samples, "linear"))
    print(text)
    studies: list[ToleranceStudy] = []
    for workers in given.workers:
        options = replace(Options(given.samples), workers=workers)
        found, text = study(files[0], options)
        studies.append(found)
        print(text)
    same = all(np.array_equal(found.worst, studies[0].worst) for found in studies)
    print(f"bit for bit the same: {same}; limit: 10,000 samples on two processors in {LIMIT:g} s")
    print(f"load {os.getloadavg()[0]:.1f}")


if __name__ == "__main__":
    main()
