"""The count: as many targets as released parameters, each prescribed value in the row of what it releases."""

from __future__ import annotations

import numpy as np

from catenaria.errors import InconsistentInputError
from catenaria.formfinding.free_motion import Names, name_of
from catenaria.mechanics.controls.control import Controls
from catenaria.mechanics.controls.given import Given
from catenaria.mechanics.controls.target import Targets
from catenaria.mechanics.system import System
from catenaria.mechanics.unknowns import Kind


def check_count(system: System, names: Names = ()) -> None:
    """Refuse a system in which a parameter has no equation or more than one.

    Parameters
    ----------
    system : System
        With targets, controls or given values for its parameters.
    names : sequence
        Names of parts, each with the indices of its unknowns.

    Raises
    ------
    InconsistentInputError
        Saying what is released, what is prescribed, and which parameters do not fit.
    """
    owners = [part for part in system.contributions if isinstance(part, Targets | Given | Controls)]
    rows = np.concatenate([np.empty(0, np.int64), *(part.parameter for part in owners)])
    count = np.bincount(rows, minlength=system.size)
    released = system.unknowns.where(Kind.PARAMETER)
    wrong = np.flatnonzero(released & (count != 1))
    if wrong.size and not count[wrong].any():  # other contributions may have equations for parameters
        used = np.concatenate([part.pattern()[0] for part in system.contributions])
        wrong = np.setdiff1d(wrong, used)
    if wrong.size:
        told = "; ".join(_told(system, int(index), int(count[index]), names) for index in wrong[:5])
        count_text = f"{rows.size} prescribed values for {np.count_nonzero(released)} released parameters"
        raise InconsistentInputError(f"{count_text}: {told}")


def _told(system: System, index: int, count: int, names: Names) -> str:
    name = name_of(index, names)
    if count == 0:
        return f"{name} is released, but nothing is prescribed for it"
    found = [_kind(part) for part in system.contributions if _prescribes(part, index)]
    return f"{name} is released once, but {count} values are prescribed for it ({', '.join(found)})"


def _prescribes(part: object, index: int) -> bool:
    return isinstance(part, Targets | Given | Controls) and bool(np.any(part.parameter == index))


def _kind(part: object) -> str:
    return type(part.measure if isinstance(part, Targets | Controls) else part).__name__
