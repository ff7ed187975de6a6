"""The one place that wires line, method and result together."""

from catenaria.formfinding.progress import Progress
from catenaria.workflow.batch import BatchProgress, solve_many
from catenaria.workflow.batch_table import BatchSummary, Row
from catenaria.workflow.compare import Compared, compare, write_comparison
from catenaria.workflow.elasticity import elasticity, write_elasticity
from catenaria.workflow.loads import under_loads, write_loads
from catenaria.workflow.methods import METHODS, NEGLECTS
from catenaria.workflow.rounding import rounding, write_rounding
from catenaria.workflow.solve import Rebuild, solve
from catenaria.workflow.solve_structure import solve_structure
from catenaria.workflow.tolerance import tolerances, write_tolerances
from catenaria.workflow.validate import CaseProgress, ValidatedCase, validate
from catenaria.workflow.write import write
from catenaria.workflow.write_network import write_network
from catenaria.workflow.write_validation import write_validation

__all__ = [
    "METHODS",
    "NEGLECTS",
    "BatchProgress",
    "BatchSummary",
    "CaseProgress",
    "Compared",
    "Progress",
    "Rebuild",
    "Row",
    "ValidatedCase",
    "compare",
    "elasticity",
    "rounding",
    "solve",
    "solve_many",
    "solve_structure",
    "tolerances",
    "under_loads",
    "validate",
    "write",
    "write_comparison",
    "write_elasticity",
    "write_loads",
    "write_network",
    "write_rounding",
    "write_tolerances",
    "write_validation",
]
