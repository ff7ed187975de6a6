"""Time the direct method on the paper's three-span line, warm, beside Exudyn if that is installed.

Run with: python benchmarks/direct_method.py [--runs 15] [--line FILE]
"""

from __future__ import annotations

import argparse
import os
import platform
import statistics
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.from_line import contact_wire_setup, messenger_wire_setup
from catenaria.discretise.mesh import Grading
from catenaria.formfinding.coupled import find_coupled_form
from catenaria.formfinding.find_wire import find_wire
from catenaria.formfinding.refusals import dropper_names
from catenaria.formfinding.third_step import dropper_schedule
from catenaria.line import Line, load_line
from catenaria.workflow import solve

FloatArray = NDArray[np.float64]

EXAMPLE = Path(__file__).parents[1] / "examples" / "yang2017_three_span.yaml"
LIMIT = 25.0  # ms, form-finding core
CONVERGED = 0.005e-3  # m, change of lengths that ends the refinement
ACCURACY = 0.05e-3  # m, wanted of the lengths
GRADED, UNIFORM = 3.0, 8.0  # times faster than Exudyn on the same mesh, and on a uniform one
UNIFORM_MESH = Grading((), 0.25)


@dataclass(frozen=True)
class Found:
    """Unstressed dropper lengths [m], unknowns, and Newton iterations as text."""

    length: FloatArray
    unknowns: int
    iterations: str


def core(line: Line) -> Found:
    """Find the lengths and nothing else: models, guesses and Newton's method for both wires, third step."""
    names = dropper_names(line)
    contact = find_wire(contact_wire_setup(line), names)
    below = contact.clamped
    messenger = find_wire(messenger_wire_setup(line, below.lift, below.height), names)
    length = dropper_schedule(line, below, messenger.clamped).unstressed_length
    iterations = f"{contact.work.steps} + {messenger.work.steps}"
    return Found(length, contact.z.size + messenger.z.size, iterations)


def coupled(line: Line) -> Found:
    """Find the whole line at once."""
    form = find_coupled_form(line)
    return Found(form.unstressed_length, form.z.size, str(form.iterations))


def complete(line: Line) -> Found:
    """Find the form as users do: with tables and audit."""
    result = solve(line, method="direct", rebuild="none")
    unknowns = sum(work.unknowns for work in result.counters)
    steps = " + ".join(str(work.steps) for work in result.counters)
    return Found(result.droppers.unstressed_length, unknowns, steps)


def peer(line: Line, grading: Grading) -> Found:
    """Find the lengths by Exudyn."""
    from exudyn_line import find_peer_form  # only where Exudyn is installed

    form = find_peer_form(line, grading)
    return Found(form.unstressed_length, form.unknowns, f"{form.newton} in {form.solves} solves")


def refined(line: Line, factor: int) -> Line:
    """Return the line with every element divided."""
    mesh = line.solver.mesh.model_copy(update={"refine": factor})
    return line.model_copy(update={"solver": line.solver.model_copy(update={"mesh": mesh})})


def grading_of(line: Line, refine: int = 1) -> Grading:
    """Return the line's own mesh."""
    return Grading(tuple(line.solver.mesh.fine), line.solver.mesh.largest_element, refine)


def converged(find: Callable[[int], Found]) -> tuple[FloatArray, int]:
    """Return the lengths on a mesh so fine that halving its elements changes nothing, and its factor."""
    factor, length = 1, find(1).length
    while factor < 32:
        factor, previous = 2 * factor, length
        length = find(factor).length
        if np.abs(length - previous).max() < CONVERGED:
            return length, factor
    raise RuntimeError("the lengths do not settle as the mesh is refined")


def alternate(ways: dict[str, Callable[[], Found]], runs: int) -> dict[str, tuple[list[float], Found]]:
    """Return wall times [ms] and the last finding of each way; they run in turns, after a first round."""
    found = {name: way() for name, way in ways.items()}
    walls: dict[str, list[float]] = {name: [] for name in ways}
    for _ in range(runs):
        for name, way in ways.items():
            begin = perf_counter()
            found[name] = way()
            walls[name].append(1e3 * (perf_counter() - begin))
    return {name: (walls[name], found[name]) for name in ways}


def report(line: Line, runs: int) -> Iterator[str]:
    """Yield what is measured, line by line."""
    processor = f"{platform.machine()}, {os.cpu_count()} processors, Python {platform.python_version()}"
    yield f"{processor}; {line.name}: {runs} warm runs in turns"
    own, fine = converged(lambda factor: core(refined(line, factor)))
    ways: dict[str, Callable[[], Found]] = {
        "core": lambda: core(line),
        "whole line at once": lambda: coupled(line),
        "with tables and audit": lambda: complete(line),
    }
    if find_spec("exudyn") is None:
        yield "Exudyn is not installed: pip install 'catenaria[bench]' to compare with it"
        yield from _table(alternate(ways, runs), {name: own for name in ways})
    else:
        theirs, _ = converged(lambda factor: peer(line, grading_of(line, factor)))
        references = dict.fromkeys(ways, own) | {"Exudyn, same mesh": theirs, "Exudyn, uniform mesh": theirs}
        ways["Exudyn, same mesh"] = lambda: peer(line, grading_of(line))
        ways["Exudyn, uniform mesh"] = lambda: peer(line, UNIFORM_MESH)
        measured = alternate(ways, runs)
        yield from _table(measured, references)
        yield from _ratios({name: statistics.median(walls) for name, (walls, _) in measured.items()})
        apart = 1e3 * np.abs(theirs - own).max()
        yield f"converged lengths of Exudyn and ours differ by up to {apart:.3f} mm"
    yield (
        f"error: largest of all droppers against the same tool on a mesh {fine} times finer (ours), "
        f"where halving changes less than {1e3 * CONVERGED:g} mm; limit {1e3 * ACCURACY:g} mm"
    )


def _table(
    measured: dict[str, tuple[list[float], Found]], references: dict[str, FloatArray]
) -> Iterator[str]:
    heads = f"{'median':>8} {'fastest':>8} {'slowest':>8}{'unknowns':>10}{'error':>11}"
    yield f"{'':24}{heads}  Newton iterations"
    for name, (walls, found) in measured.items():
        error = 1e3 * np.abs(found.length - references[name]).max()
        times = f"{statistics.median(walls):5.1f} ms {min(walls):5.1f} ms {max(walls):5.1f} ms"
        yield f"{name:24}{times}{found.unknowns:10}{error:8.4f} mm  {found.iterations}"
    yield f"core: limit {LIMIT:g} ms"


def _ratios(median: dict[str, float]) -> Iterator[str]:
    for name, wanted in (("Exudyn, same mesh", GRADED), ("Exudyn, uniform mesh", UNIFORM)):
        yield f"{name}: {median[name] / median['core']:.2f} times the time of the core (wanted: {wanted:g})"


def main() -> None:
    """Run the benchmark."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--runs", type=int, default=15, help="number of timed runs of each way")
    parser.add_argument("--line", type=Path, default=EXAMPLE, help="line file")
    arguments = parser.parse_args()
    for row in report(load_line(arguments.line), arguments.runs):
        print(row)


if __name__ == "__main__":
    main()
