"""Studies that were written beside a result, if they are of this very result."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from catenaria.errors import CatenariaError
from catenaria.results import FormResult, load_result
from catenaria.results.case import LoadStudy
from catenaria.results.elasticity import ElasticityStudy
from catenaria.results.rounding import RoundingStudy
from catenaria.results.store import JSON_NAME
from catenaria.results.tolerance import ToleranceStudy
from catenaria.workflow.elasticity import ElasticityListener, elasticity

Study = TypeVar("Study", ElasticityStudy, LoadStudy, RoundingStudy, ToleranceStudy)
FloatArray = NDArray[np.float64]

_OTHER = "another state of the line, or of another method"
_LENGTH = 1e-6  # m: what files and round-off may change
_FORCE = 1e-3  # N


@dataclass(frozen=True)
class Studies:
    """Studies of a result, and notes about those beside it that do not belong to it."""

    elasticity: ElasticityStudy | None = None
    loads: LoadStudy | None = None
    rounding: RoundingStudy | None = None
    tolerances: ToleranceStudy | None = None
    notes: tuple[str, ...] = ()

    def with_elasticity(self, result: FormResult, progress: ElasticityListener | None = None) -> Studies:
        """Add the elasticity of the result as `elasticity` finds it by default, or a note why there is none.

        Parameters
        ----------
        result : FormResult
            What the studies are of.
        progress : callable, optional
            Receives what is done, how many points of it are done, and of how many.
        """
        if self.elasticity is not None:
            return self
        try:
            return replace(self, elasticity=elasticity(result, progress=progress))
        except CatenariaError as error:
            return replace(self, notes=(*self.notes, f"Elasticity is left out: {error}."))

    def without_elasticity(self) -> Studies:
        """Leave elasticity out."""
        return replace(self, elasticity=None)


def studies_beside(source: Path, result: FormResult) -> Studies:
    """Return the studies of a result in folders beside its own, named like it with what they are behind.

    Raises
    ------
    InconsistentInputError
        If one of them is damaged.

    Notes
    -----
    Studies of elasticity and of load cases hold the line that they are of; those of rounded lengths and of
    tolerances are known by its lengths, heights and tensions.
    """
    folder = (source if source.is_dir() else source.parent).resolve()
    elasticity = _read(folder, "elasticity", ElasticityStudy)
    loads = _read(folder, "loads", LoadStudy)
    rounding = _read(folder, "rounding", RoundingStudy)
    tolerances = _read(folder, "tolerance", ToleranceStudy)
    own = {
        "elasticity": elasticity is None or _of_line(elasticity, result),
        "loads": loads is None or _of_line(loads, result),
        "rounding": rounding is None or _near(rounding.cut_length, result.droppers.cut_length, _LENGTH),
        "tolerance": tolerances is None or _same_state(tolerances, result),
    }
    return Studies(
        elasticity if own["elasticity"] else None,
        loads if own["loads"] else None,
        rounding if own["rounding"] else None,
        tolerances if own["tolerance"] else None,
        tuple(
            f"{folder.name}-{what} is left out: it is of {_OTHER}." for what, yes in own.items() if not yes
        ),
    )


def _read(folder: Path, what: str, kind: type[Study]) -> Study | None:
    beside = folder.with_name(f"{folder.name}-{what}")
    return load_result(beside, kind) if (beside / JSON_NAME).exists() else None


def _of_line(study: ElasticityStudy | LoadStudy, result: FormResult) -> bool:
    return study.inputs == result.inputs and study.method == result.method


def _same_state(study: ToleranceStudy, result: FormResult) -> bool:
    tension = np.array([(wire.reaction_start, wire.reaction_end) for wire in result.wires]).ravel()
    return (
        _near(study.chainage, result.droppers.x, _LENGTH)
        and _near(study.height.nominal, result.droppers.height, _LENGTH)
        and _near(study.tension.nominal, tension, _FORCE)
    )


def _near(a: FloatArray, b: FloatArray, most: float) -> bool:
    return a.shape == b.shape and bool(np.all(np.abs(a - b) <= most))
