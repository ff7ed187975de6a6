"""Time the methods for strings on the paper's three-span line, warm, beside compas_fd if that is installed.

Run with: python benchmarks/string_methods.py [--runs 50] [--line FILE]
"""

from __future__ import annotations

import argparse
import statistics
from collections.abc import Callable
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from time import perf_counter

import numpy as np

from catenaria.formfinding.strings.registry import STRING_METHODS
from catenaria.line import load_line

EXAMPLE = Path(__file__).parents[1] / "examples" / "yang2017_three_span.yaml"
LIMITS = {"catenary equations": 5.0, "force density": 3.0}  # ms
SLOW, FEW = 100.0, 5  # ms, and how often what takes longer is run


def main() -> None:
    """Print the median time of every method, with all tables of its result."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=int, default=50)
    parser.add_argument("--line", type=Path, default=EXAMPLE)
    options = parser.parse_args()
    line = load_line(options.line)
    for name, make in STRING_METHODS.items():
        method = make(None)
        iterations = method.find_form(line).counters[0].steps
        time, limit = median(lambda method=method: method.find_form(line), options.runs), LIMITS.get(name)
        wanted = "" if limit is None else f"   wanted: below {limit:g} ms, {_verdict(time < limit)}"
        print(f"{name:28s}{time:8.2f} ms{iterations:7d} iterations{wanted}")
    if find_spec("compas_fd"):
        print(f"{'compas_fd, one linear solve':28s}{median(compas_fd, options.runs):8.2f} ms")


def median(run: Callable[[], object], runs: int) -> float:
    """Return the median time of some runs [ms]."""
    times: list[float] = []
    for _ in range(runs):
        begin = perf_counter()
        run()
        times.append(1e3 * (perf_counter() - begin))
        if times[0] > SLOW and len(times) == FEW:
            break
    return statistics.median(times)


def compas_fd() -> None:
    """Solve two chains of 100 nodes once, as many as the wires are divided into, without any iteration."""
    n = 100
    nodes = np.zeros((2 * n, 3))
    nodes[:, 0] = np.tile(np.linspace(0.0, 195.0, n), 2)
    loads = np.zeros_like(nodes)
    loads[:, 2] = -18.0
    import_module("compas_fd.solvers").fd_numpy(
        vertices=nodes,
        fixed=[0, n - 1, n, 2 * n - 1],
        edges=[(i, i + 1) for i in range(2 * n - 1) if i != n - 1],
        forcedensities=[7.6e3] * (2 * n - 2),
        loads=loads,
    )


def _verdict(reached: bool) -> str:
    return "reached" if reached else "MISSED"


if __name__ == "__main__":
    main()
