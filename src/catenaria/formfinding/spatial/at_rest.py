"""A whole line in space at rest with its targets met, by one Newton iteration on one square system."""

from __future__ import annotations

from dataclasses import dataclass
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.spatial.demands import to_find
from catenaria.discretise.spatial.layout import Layout
from catenaria.discretise.spatial.model import SpatialModel, guessed_model
from catenaria.discretise.spatial.numbering import NONE
from catenaria.discretise.spatial.restart import start_from
from catenaria.errors import InfeasibleError, NotConvergedError
from catenaria.formfinding.free_motion import Names
from catenaria.formfinding.spatial.slack import with_slack
from catenaria.formfinding.static_problem import find_rest, static_problem
from catenaria.results.form import Counters, FormResult
from catenaria.solvers.load_stepping import SteppingOptions, solve_by_steps
from catenaria.solvers.newton import NewtonOptions

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

_ITERATIONS = 30
_LEVEL = 1e-9  # m by which the wire of a slack dropper may be too low
_STEPS = SteppingOptions(newton=NewtonOptions(max_iterations=12, permc_spec="NATURAL"))


@dataclass(frozen=True)
class LineAtRest:
    """A line in space at rest.

    Attributes
    ----------
    model : SpatialModel
        The line.
    z : FloatArray
        Its unknowns.
    work : Counters
        How much work it was.
    how : str
        Empty if Newton's method found it at once.
    """

    model: SpatialModel
    z: FloatArray
    work: Counters
    how: str


def find_line_at_rest(layout: Layout, start: FormResult | None = None) -> LineAtRest:
    """Find a line in space at rest with all targets met.

    Parameters
    ----------
    layout : Layout
        What is modelled.
    start : FormResult, optional
        An earlier result to begin from instead of taut strings.

    Raises
    ------
    NotConvergedError, InfeasibleError, SingularError
        If no rest is found, if it cannot be, or if what is prescribed leaves a motion free.
    """
    begin = perf_counter()
    model = guessed_model(layout)
    if start is not None:
        model = start_from(model, start)
    way = _find(model)
    wall, residuals = perf_counter() - begin, way.iterations + way.factorisations
    counted = (way.iterations, 0, 0, residuals, way.factorisations, way.factorisations)
    return LineAtRest(model, way.z, Counters("line", 0.0, wall, *counted, way.z.size), way.how)


@dataclass(frozen=True)
class _Way:
    """Where a line is at rest, the work, and how it was found."""

    z: FloatArray
    iterations: int
    factorisations: int
    how: str = ""


def _find(model: SpatialModel) -> _Way:
    """Find the rest, with droppers that hang slack where they may."""

    def find(slack: NDArray[np.bool_], before: _Way | None) -> _Way:
        return _find_with(model, model.unknowns.start if before is None else before.z, slack)

    ways = with_slack(model, find, lambda way: way.z, _LEVEL)
    last, more = ways[-1], len(ways) > 1
    return _Way(
        last.z,
        sum(way.iterations for way in ways),
        sum(way.factorisations for way in ways),
        "".join(way.how for way in ways)
        + (f", in {len(ways)} rests to decide on slack droppers" if more else ""),
    )


def _find_with(model: SpatialModel, z: FloatArray, slack: NDArray[np.bool_]) -> _Way:
    """Find the rest in which some droppers carry nothing, by Newton's method or else by load steps."""
    names, system = parts_of(model), to_find(model, z, slack)
    try:
        root = find_rest(system, z, _ITERATIONS, names)
        return _Way(root.y, root.iterations, root.corrections.size)
    except (NotConvergedError, InfeasibleError) as plain:
        try:
            held = solve_by_steps(static_problem(system), z, _STEPS)
        except (NotConvergedError, InfeasibleError):
            raise plain from None
    root = find_rest(to_find(model, held.root.y, slack), held.root.y, _ITERATIONS, names)
    iterations = held.iterations + root.iterations
    how = f" (released from the first guess in {held.parts.size} load steps)"
    return _Way(root.y, iterations, iterations, how)


def parts_of(model: SpatialModel) -> Names:
    """Return the names of the line's parts, each with the indices of its unknowns, for messages."""
    layout = model.layout
    parts: list[tuple[str, IntArray]] = []
    for k, (wire, chain) in enumerate(zip(layout.wires, model.wires, strict=True)):
        parts.append((f"the {wire.name}", chain.nodes))
        how = ("the length", model.piece) if wire.tied else ("the pull at the ends", model.pull)
        parts.append((f"{how[0]} of the {wire.name}", how[1][[k]]))
        held = model.hold_s[layout.holds.wire == k]
        parts.append((f"a support of the {wire.name}", held))
        ends = model.end_force[k].ravel()
        parts.append((f"an end of the {wire.name}", ends[ends != NONE]))
    supports = (model.roller_force, model.across_force, model.arm_density)
    parts.append(("a support", np.concatenate([force.ravel() for force in supports])))
    clamps = (model.lower_s, model.upper_s, model.density)
    for name, length, *others in zip(dropper_names(model), model.length, *clamps, strict=True):
        parts += [(f"the length of {name}", np.array([length])), (name, np.array(others))]
    ties = np.concatenate((model.tie_s, model.tie_force.ravel()))
    return [*parts, ("a tie", ties), ("a point mass", model.mass_s), ("a cantilever", model.root_force)]


def dropper_names(model: SpatialModel) -> tuple[str, ...]:
    """Return the names of all droppers: numbers within spans, and from which wire those above others hang."""
    droppers = model.layout.droppers
    roles = [wire.role for wire in model.layout.wires]
    return tuple(
        f"dropper {number} in span {span}"
        + ("" if roles[lower] == "contact wire" else f" of the {roles[upper]}")
        for number, span, lower, upper in zip(
            droppers.number, droppers.span, droppers.lower, droppers.upper, strict=True
        )
    )
