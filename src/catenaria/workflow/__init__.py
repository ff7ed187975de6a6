"""The one place that wires line, method and result together."""

from catenaria.formfinding.progress import Progress
from catenaria.workflow.compare import Compared, compare, write_comparison
from catenaria.workflow.methods import METHODS, NEGLECTS
from catenaria.workflow.solve import Rebuild, solve
from catenaria.workflow.solve_structure import solve_structure
from catenaria.workflow.validate import CaseProgress, ValidatedCase, validate
from catenaria.workflow.write import write
from catenaria.workflow.write_validation import write_validation

__all__ = [
    "METHODS",
    "NEGLECTS",
    "CaseProgress",
    "Compared",
    "Progress",
    "Rebuild",
    "ValidatedCase",
    "compare",
    "solve",
    "solve_structure",
    "validate",
    "write",
    "write_comparison",
    "write_validation",
]
