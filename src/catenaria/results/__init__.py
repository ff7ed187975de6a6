"""Results of form-finding as values, and how they are kept on disk."""

from __future__ import annotations

from catenaria.results.audit import NOT_AUDITED, Audit
from catenaria.results.folder import replace_folder, require_replaceable
from catenaria.results.form import (
    Controls,
    Counters,
    Droppers,
    FormResult,
    History,
    Profile,
    Stage,
    Supports,
    WireForm,
)
from catenaria.results.rebuilt import NOT_REBUILT, Comeback, Rebuilt
from catenaria.results.store import load_result, save_result
from catenaria.results.structure import StructureForm

__all__ = [
    "NOT_AUDITED",
    "NOT_REBUILT",
    "Audit",
    "Comeback",
    "Controls",
    "Counters",
    "Droppers",
    "FormResult",
    "History",
    "Profile",
    "Rebuilt",
    "Stage",
    "StructureForm",
    "Supports",
    "WireForm",
    "load_result",
    "replace_folder",
    "require_replaceable",
    "save_result",
]
