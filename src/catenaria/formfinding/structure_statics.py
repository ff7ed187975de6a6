"""The rest of a free structure with all its targets met exactly: the direct method for structures."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from catenaria.errors import InfeasibleError, NotConvergedError
from catenaria.formfinding.count import check_count
from catenaria.formfinding.free_motion import Names, ParameterCheck, refuse_free_motion
from catenaria.formfinding.pseudo_transient import rest_by_steps
from catenaria.formfinding.static_problem import StaticProblem, statics
from catenaria.mechanics.contribution import Contribution
from catenaria.mechanics.controls.control import Controls
from catenaria.mechanics.controls.given import Given
from catenaria.mechanics.controls.measures import ReactionTension, StrainTension
from catenaria.mechanics.controls.pull import Pull
from catenaria.mechanics.loads.gravity import Gravity
from catenaria.mechanics.system import System
from catenaria.solvers.linear import factorise
from catenaria.solvers.newton import Root, solve_newton
from catenaria.structure.model import StructureModel

FloatArray = NDArray[np.float64]

_CORRECTION, _FORCE = 1e-9, 1e-5  # m and N: Newton corrections that count as none
_ADVICE = "method dynamic, or cables, held points and targets that are nearer to the form that is looked for"

ROUNDING = 16.0 * float(np.finfo(np.float64).eps)  # part of EA by which rounding disturbs a force


@dataclass(frozen=True)
class Found:
    """Where a structure is at rest.

    Attributes
    ----------
    z : FloatArray
        Its unknowns.
    iterations, factorisations : int
        Newton's corrections and factorisations, without those of `steps`.
    steps : int
        Steps from standstill that were needed because Newton's method alone did not get there.
    """

    z: FloatArray
    iterations: int
    factorisations: int
    steps: int


def find_static_form(model: StructureModel) -> Found:
    """Return the rest in which all targets are met.

    Parameters
    ----------
    model : StructureModel
        The structure at its start, with full gravity.

    Raises
    ------
    InconsistentInputError
        If there are more or fewer targets than parameters.
    NotConvergedError
        If no way from the start to a state of rest is found.
    SingularError
        If what is prescribed leaves a motion free.

    Notes
    -----
    Without tension a straight cable has next to no stiffness against its weight, with it it is a taut string.
    So the weightless structure is brought to its tensions first, and then everything at once. Where that
    leads nowhere, `rest_by_steps` does.
    """
    names = names_of(model)
    check_count(statics(model.system, model.start), names)
    weightless = _weightless(model)
    try:
        z, count, factorisations = model.start, 0, 0
        if weightless is not None:
            root, _ = _rest(model, weightless, z)
            z, count, factorisations = root.y, root.iterations, root.corrections.size
        system = statics(model.system, z)
        root, steps = _rest(model, system, z)
    except (NotConvergedError, InfeasibleError) as error:
        last = (error.partial.y,) if isinstance(error.partial, Root) else ()
        refuse_free_motion(statics(model.system, model.start), (model.start, *last), names)
        reason = f"{model.name}: {getattr(error, 'reason', error)}"
        raise NotConvergedError(reason, _ADVICE, error.partial) from error
    _refuse_loose_parameters(root, names)
    return Found(root.y, count + root.iterations, factorisations + root.corrections.size, steps)


def names_of(model: StructureModel) -> Names:
    """Return the names of controls, cables and joints with their unknowns, for messages."""
    return [
        *((f"control {name}", np.array([index])) for name, index in model.parameter.items()),
        *((f"cable {name}", chain.nodes.ravel()) for name, chain in model.chains.items()),
        *((f"joint {at.name}", np.concatenate((at.force, at.moment, at.s))) for at in model.joints),
    ]


def _is_tension(part: Contribution) -> bool:
    return isinstance(part, Controls) and isinstance(part.measure, ReactionTension | StrainTension | Pull)


def _weightless(model: StructureModel) -> System | None:
    """Return the structure without weight and with no targets but tensions, or None if there are none."""
    parts = model.system.contributions
    if not any(_is_tension(part) for part in parts):
        return None
    light = tuple(_without_weight(part, model.start) for part in parts)
    return statics(System(model.system.unknowns, light), model.start)


def _without_weight(part: Contribution, z: FloatArray) -> Contribution:
    if isinstance(part, Gravity):
        return replace(part, g=0.0)
    if isinstance(part, Controls) and not _is_tension(part):
        return Given(part.parameter, z[part.parameter])
    return part


def _rest(model: StructureModel, system: System, z: FloatArray) -> tuple[Root, int]:
    """Return where a system is at rest, and the number of steps if Newton's method alone leads nowhere."""
    problem = StaticProblem(system, _CORRECTION, force_scale(model, _FORCE))
    try:
        return solve_newton(problem, z), 0
    except (NotConvergedError, InfeasibleError):
        return rest_by_steps(problem, z)


def force_scale(model: StructureModel, least: float) -> FloatArray:
    """Return the negligible correction of every unknown that is a force, at least `least` [N], shape (n,).

    In a rod that is as good as rigid, strain is known to the last bit only: 0.1 N for EA = 7e14 N.
    """
    scale = np.full(model.system.size, least)
    for at in model.joints:
        other = at.wire if at.joint.to is None else model.chains[at.joint.to.cable]
        noise = ROUNDING * min(at.wire.section.EA, other.section.EA)
        scale[at.force] = scale[at.moment] = max(least, noise)
    return scale


def _refuse_loose_parameters(root: Root, names: Names) -> None:
    """Refuse a root in which targets do not determine what is released for them."""
    problem = root.problem
    if not isinstance(problem, StaticProblem):
        raise TypeError("the root does not belong to a StaticProblem")
    jacobian = problem.jacobian(root.y)
    try:
        factors = factorise(jacobian)
    except np.linalg.LinAlgError:
        refuse_free_motion(problem.system, (root.y,), names)
    else:
        ParameterCheck(problem.system, root.y, names)(jacobian, factors)
