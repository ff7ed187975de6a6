"""The result of a form-finding computation: named arrays in SI units, frozen.

Every array is read-only and one-dimensional unless its comment says otherwise. Column names of tables that
are written to files carry the unit as suffix (`length_m`, `tension_N`); attributes here do not, they are SI.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final

from catenaria.errors import InconsistentInputError
from catenaria.results.arms import NO_ARMS, Arms
from catenaria.results.attached import NO_MASSES, NO_TIES, Masses, Ties
from catenaria.results.audit import NOT_AUDITED, Audit
from catenaria.results.droppers import Droppers
from catenaria.results.history import Controls, Counters, History, Stage
from catenaria.results.rebuilt import NOT_REBUILT, Rebuilt
from catenaria.results.supports import NO_CANTILEVERS, Cantilevers, Supports
from catenaria.results.wires import Profile, WireForm

__all__ = [
    "LINE_STEP",
    "NO_ARMS",
    "NO_CANTILEVERS",
    "NO_MASSES",
    "NO_TIES",
    "Arms",
    "Cantilevers",
    "Controls",
    "Counters",
    "Droppers",
    "FormResult",
    "History",
    "Masses",
    "Profile",
    "Stage",
    "Supports",
    "Ties",
    "WireForm",
]

LINE_STEP: Final = "line"  # the one step in which all wires of a line in space are found


@dataclass(frozen=True)
class FormResult:
    """Everything that a form-finding run found.

    Attributes
    ----------
    name, method : str
        Name of the line and of the method.
    stop_reason : str
        In words, why the computation ended.
    droppers, wires, supports, controls
        The tables; `wires` holds the contact wire, then the messenger wire, or all wires of a line in space:
        contact wires, auxiliary messenger, messenger wire, stitch wires, mid-point anchors.
    histories, counters, stages
        One entry for each step: contact wire and messenger wire, or all wires of a line in space at once.
    inputs : dict
        Echo of the line file, all values in SI.
    versions : dict
        Versions of catenaria, Python, NumPy, SciPy and Numba.
    audit : Audit
        What an audit of the other fields found; empty until there was one.
    rebuilt : Rebuilt
        Where a line built from the found lengths came to rest; empty until there was one.
    arms, ties, masses, cantilevers
        Further tables, of lines in space; empty for others.
    physics : str
        What the wires are, which an audit must know: ``bending`` (eqs. (7)-(10), with `stages`), ``beam``
        (bending too, but with one strain in every element; `stages` hold the nodes) or ``string``
        (no bending stiffness, no `stages`; profiles are given behind joints, where forces jump).
    """

    name: str
    method: str
    stop_reason: str
    droppers: Droppers
    wires: tuple[WireForm, ...]
    supports: Supports
    controls: Controls
    histories: tuple[History, ...]
    counters: tuple[Counters, ...]
    stages: tuple[Stage, ...]
    inputs: dict[str, Any]
    versions: dict[str, str]
    arms: Arms = NO_ARMS
    ties: Ties = NO_TIES
    masses: Masses = NO_MASSES
    cantilevers: Cantilevers = NO_CANTILEVERS
    audit: Audit = NOT_AUDITED
    rebuilt: Rebuilt = NOT_REBUILT
    physics: str = "bending"

    @property
    def spatial(self) -> bool:
        """Whether all wires were found at once, as those of a line in space are."""
        return any(stage.step == LINE_STEP for stage in self.stages)

    def wire(self, name: str) -> WireForm:
        """Return what was found for a wire.

        Raises
        ------
        InconsistentInputError
            If there is no wire of that name.
        """
        for wire in self.wires:
            if wire.name == name:
                return wire
        names = ", ".join(wire.name for wire in self.wires)
        raise InconsistentInputError(f"there is no wire {name!r}; there is {names}")
