"""Time the methods for strings on the paper's three-span line, warm.

Run with: python benchmarks/string_methods.py [--runs 50] [--line FILE]
"""

from __future__ import annotations

import argparse
import statistics
from pathlib import Path
from time import perf_counter

from catenaria.formfinding.strings.registry import STRING_METHODS
from catenaria.line import load_line

EXAMPLE = Path(__file__).parents[1] / "examples" / "yang2017_three_span.yaml"
LIMITS = {"catenary equations": 5.0, "force density": 3.0}  # ms
SLOW = 0.1  # s: what takes longer runs a few times only


def main() -> None:
    """Print the median time of every method, with all tables of its result."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=int, default=50)
    parser.add_argument("--line", type=Path, default=EXAMPLE)
    options = parser.parse_args()
    line = load_line(options.line)
    for name, make in STRING_METHODS.items():
        method = make(None)
        begin = perf_counter()
        result = method.find_form(line)
        runs = options.runs if perf_counter() - begin < SLOW else 5
        times: list[float] = []
        for _ in range(runs):
            begin = perf_counter()
            method.find_form(line)
            times.append(1e3 * (perf_counter() - begin))
        time, limit = statistics.median(times), LIMITS.get(name)
        wanted = "" if limit is None else f"   wanted: below {limit:g} ms, {_verdict(time < limit)}"
        print(f"{name:28s}{time:8.2f} ms{result.counters[0].steps:7d} iterations{wanted}")


def _verdict(reached: bool) -> str:
    return "reached" if reached else "MISSED"


if __name__ == "__main__":
    main()
