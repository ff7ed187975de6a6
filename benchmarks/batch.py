"""Time batches of a synthetic network: lines per second, and memory, which must not grow with their number.

Run with: python benchmarks/batch.py [--lines 100 400] [--workers 2]
"""

from __future__ import annotations

import argparse
import os
import platform
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

from catenaria.workflow import BatchProgress, solve_many, write_network

WANTED = 3.0  # lines per second of two workers
_ONE = "--one"  # measures one batch in this process, whose peak of memory nothing else has touched


def measure(lines: int, workers: int) -> str:
    """Solve a network with audit and rebuild, results on disk, and say what it took."""
    told: list[BatchProgress] = []

    def keep(progress: BatchProgress) -> None:
        told[:] = [progress]

    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch) / "network"
        write_network(lines, 1, folder)
        before = _peak(resource.RUSAGE_SELF)
        summary = solve_many([folder], Path(scratch) / "out", workers=workers, progress=keep)
        if not summary.passed:
            raise SystemExit(f"{summary.count('failed')} lines failed")
    processor = resource.getrusage(resource.RUSAGE_CHILDREN)
    busy = (processor.ru_utime + processor.ru_stime) / lines
    return (
        f"{lines:6} lines {told[-1].elapsed:8.1f} s {told[-1].rate:6.2f}/s {summary.wall_time:9.1f} s "
        f"{busy:7.3f} s {before:16.0f} MB {_peak(resource.RUSAGE_SELF):4.0f} MB "
        f"{_peak(resource.RUSAGE_CHILDREN):5.0f} MB"
    )


def _peak(who: int) -> float:
    return resource.getrusage(who).ru_maxrss / 1024.0


def main() -> None:
    """Run the benchmark."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--lines", type=int, nargs="+", default=[100, 400], help="numbers of lines")
    parser.add_argument("--workers", type=int, default=2, help="worker processes")
    parser.add_argument(_ONE, action="store_true", help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.one:
        print(measure(arguments.lines[0], arguments.workers), flush=True)
        return
    print(f"{platform.machine()}, {os.cpu_count()} processors, Python {platform.python_version()}, ", end="")
    print(f"{arguments.workers} workers; load of the computer before: {os.getloadavg()[0]:.1f}", flush=True)
    heads = f"{'solving':>10} {'rate':>8} {'with start':>11} {'busy/line':>9}"
    print(f"{'':12} {heads}  peak memory: before   after   worker", flush=True)
    for lines in arguments.lines:
        command = [sys.executable, __file__, _ONE, "--lines", str(lines), "--workers", str(arguments.workers)]
        subprocess.run(command, check=True)
    print(f"wanted: more than {WANTED:g} lines per second of two workers on two quiet processors", flush=True)


if __name__ == "__main__":
    main()
