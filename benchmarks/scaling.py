"""Time the direct method on lines of more and more spans: time and memory should be proportional to them.

Run with: python benchmarks/scaling.py [--spans 3 30 300 3000] [--plot scaling.svg]
"""

from __future__ import annotations

import argparse
import resource
import statistics
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from catenaria.discretise.from_line import contact_wire_setup, messenger_wire_setup
from catenaria.errors import CatenariaError
from catenaria.formfinding.coupled import find_coupled_form
from catenaria.formfinding.find_wire import find_wire
from catenaria.formfinding.refusals import dropper_names
from catenaria.formfinding.third_step import dropper_schedule
from catenaria.line import Line, Support, load_line
from catenaria.workflow import solve


def find_lengths(line: Line) -> object:
    """Find the dropper lengths and nothing else: both wires and the third step."""
    names = dropper_names(line)
    contact = find_wire(contact_wire_setup(line), names).clamped
    messenger = find_wire(messenger_wire_setup(line, contact.lift, contact.height), names).clamped
    return dropper_schedule(line, contact, messenger).unstressed_length


EXAMPLE = Path(__file__).parents[1] / "examples" / "yang2017_three_span.yaml"
METHODS: dict[str, Callable[[Line], object]] = {
    "lengths": find_lengths,
    "whole line at once": find_coupled_form,
    "with audit and rebuild": solve,
}
LONGEST, USUAL = 300, 30  # spans of one tension length that is tried, and of a long one that is built
_ENOUGH = 1.0  # s that repeated runs of one method may take
_MOST = 9  # runs


def lines_of(spans: int, pattern: Line) -> list[Line]:
    """Return one tension length with all spans, or as many usual ones as so many spans are built in."""
    if spans <= LONGEST:
        return [line_of(spans, pattern)]
    return [line_of(USUAL, pattern)] * (spans // USUAL)


@dataclass(frozen=True)
class Measured:
    """Median wall times of all methods [s], None of one that failed, and the peak of memory so far [MB]."""

    spans: int
    walls: tuple[float | None, ...]
    memory: float


def line_of(spans: int, pattern: Line) -> Line:
    """Return a line with many spans, all like the first one of the pattern.

    The contact wire is held at the two ends only, as in the pattern.
    """
    first, inner, last = pattern.supports[0], pattern.supports[1], pattern.supports[-1]
    fields = pattern.model_dump() | {
        "name": f"{spans} spans",
        "supports": [_unnamed(support) for support in (first, *[inner] * (spans - 1), last)],
        "spans": [pattern.spans[0].model_dump(exclude_unset=True)] * spans,
    }
    return Line.model_validate(fields)


def _unnamed(support: Support) -> dict[str, object]:
    return support.model_dump(exclude={"name"})


def measure(spans: int, pattern: Line) -> Measured:
    """Time all methods on a line, warm."""
    lines = lines_of(spans, pattern)
    walls = tuple(_median(lambda find=find: [find(line) for line in lines]) for find in METHODS.values())
    return Measured(spans, walls, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0)


def _median(run: Callable[[], object]) -> float | None:
    walls: list[float] = []
    while len(walls) < _MOST and sum(walls) < _ENOUGH:
        begin = perf_counter()
        try:
            run()
        except CatenariaError:
            return None
        walls.append(perf_counter() - begin)
    return statistics.median(walls)


def table(measured: list[Measured]) -> Iterator[str]:
    """Yield the rows of the table."""
    yield f"{'spans':>6}" + "".join(f"{name:>24} {'per span':>10}" for name in METHODS) + f"{'memory':>10}"
    for m in measured:
        times = "".join(
            f"{wall:22.4f} s {1e3 * wall / m.spans:7.3f} ms" if wall else f"{'fails':>35}" for wall in m.walls
        )
        yield f"{m.spans:6}{times}{m.memory:7.0f} MB"


def figure(measured: list[Measured]) -> Figure:
    """Return time and memory over the number of spans, and what a proportional cost would be."""
    picture = Figure(figsize=(9.0, 4.0), layout="constrained")
    FigureCanvasAgg(picture)
    times, memory = picture.subplots(1, 2)
    spans = [m.spans for m in measured]
    for i, name in enumerate(METHODS):
        done = [(m.spans, wall) for m in measured if (wall := m.walls[i]) is not None]
        times.loglog([n for n, _ in done], [wall for _, wall in done], "o-", label=name)
        if i == 0 and done:
            n, wall = done[0]
            times.loglog(spans, [wall * m / n for m in spans], "k:", label="proportional")
    times.set(xlabel="spans", ylabel="wall time [s]")
    times.legend()
    memory.loglog(spans, [m.memory for m in measured], "o-")
    memory.set(xlabel="spans", ylabel="largest memory of the process [MB]")
    return picture


def main() -> None:
    """Run the benchmark."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--spans", type=int, nargs="+", default=[3, 30, 300, 3000], help="numbers of spans")
    parser.add_argument("--plot", type=Path, help="file for the plot")
    arguments = parser.parse_args()
    pattern = load_line(EXAMPLE)
    for find in METHODS.values():
        find(pattern)  # compiles or loads the kernels
    measured = [measure(spans, pattern) for spans in sorted(arguments.spans)]  # memory counts its peak
    for row in table(measured):
        print(row)
    if arguments.plot is not None:
        figure(measured).savefig(arguments.plot)


if __name__ == "__main__":
    main()
