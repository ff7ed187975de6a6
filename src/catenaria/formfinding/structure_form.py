"""The form of a free structure, statically or as the rest of a controlled motion."""

from __future__ import annotations

from time import perf_counter
from typing import Literal

from catenaria.errors import UnsupportedError
from catenaria.formfinding.progress import Listener
from catenaria.formfinding.structure_motion import move_structure
from catenaria.formfinding.structure_read_back import structure_form, structure_history
from catenaria.formfinding.structure_statics import find_static_form
from catenaria.results.form import Counters
from catenaria.results.structure import StructureForm
from catenaria.structure.model import build_structure
from catenaria.structure.structure import Structure

Method = Literal["direct", "dynamic"]


def find_structure(
    structure: Structure, method: Method = "direct", listener: Listener | None = None
) -> StructureForm:
    """Find the form of a structure in which all its targets are met.

    Parameters
    ----------
    structure : Structure
        Cables, joints and what is prescribed.
    method : str
        ``direct``: statics, targets as equations. ``dynamic``: the motion (18) under the controls (19)-(23)
        until it is at rest, targets within dead bands.
    listener : callable, optional
        Receives a `Progress` after every time step.

    Returns
    -------
    StructureForm

    Raises
    ------
    UnsupportedError
        If there is no such method.
    SingularError
        If what is prescribed leaves a motion free.
    NotConvergedError, InfeasibleError
        If no equilibrium is found.
    """
    if method == "direct":
        return _find_directly(structure)
    if method == "dynamic":
        return _find_dynamically(structure, listener)
    raise UnsupportedError(f"there is no method {method!r} for structures; there is direct, dynamic")


def _find_directly(structure: Structure) -> StructureForm:
    begin = perf_counter()
    model = build_structure(structure)
    found = find_static_form(model)
    wall, count, factors = perf_counter() - begin, found.iterations, found.factorisations
    counters = Counters("statics", 0.0, wall, count, 0, 0, count + factors, factors, factors, found.z.size)
    after = f" after {found.steps} steps from standstill" if found.steps else ""
    reason = f"Newton's method converged in {count} iterations{after}"
    return structure_form(model, "direct", reason, (0.0, found.z), counters)


def _find_dynamically(structure: Structure, listener: Listener | None) -> StructureForm:
    model = build_structure(structure, structure.solver.ramp_time)
    motion = move_structure(model, listener)
    work = motion.solution.counters
    counters = Counters(
        step="motion",
        simulated_time=motion.t,
        wall_time=motion.wall_time,
        steps=work.steps,
        rejected=work.rejected,
        newton_failures=work.newton_failures,
        residuals=work.residuals,
        jacobians=work.jacobians,
        factorisations=work.factorisations,
        unknowns=motion.system.size,
    )
    course = (structure_history(model, motion.solution),)
    return structure_form(model, "dynamic", motion.solution.reason, (motion.t, motion.z), counters, course)
