"""Results of form-finding as values, and how they are kept on disk."""

from __future__ import annotations

from catenaria.results.audit import NOT_AUDITED, Audit
from catenaria.results.folder import (
    MANIFEST_NAME,
    clear_interrupted,
    files_of,
    has_manifest,
    is_intact,
    replace_folder,
    require_replaceable,
)
from catenaria.results.form import (
    NO_ARMS,
    NO_CANTILEVERS,
    NO_MASSES,
    NO_TIES,
    Arms,
    Cantilevers,
    Controls,
    Counters,
    Droppers,
    FormResult,
    History,
    Masses,
    Profile,
    Stage,
    Supports,
    Ties,
    WireForm,
)
from catenaria.results.rebuilt import NOT_REBUILT, Comeback, Rebuilt
from catenaria.results.store import load_result, save_result
from catenaria.results.structure import StructureForm

__all__ = [
    "MANIFEST_NAME",
    "NOT_AUDITED",
    "NOT_REBUILT",
    "NO_ARMS",
    "NO_CANTILEVERS",
    "NO_MASSES",
    "NO_TIES",
    "Arms",
    "Audit",
    "Cantilevers",
    "Comeback",
    "Controls",
    "Counters",
    "Droppers",
    "FormResult",
    "History",
    "Masses",
    "Profile",
    "Rebuilt",
    "Stage",
    "StructureForm",
    "Supports",
    "Ties",
    "WireForm",
    "clear_interrupted",
    "files_of",
    "has_manifest",
    "is_intact",
    "load_result",
    "replace_folder",
    "require_replaceable",
    "save_result",
]
