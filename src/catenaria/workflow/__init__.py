"""The one place that wires line, method and result together."""

from catenaria.formfinding.progress import Progress
from catenaria.workflow.adjust import adjust, write_adjustment
from catenaria.workflow.batch import BatchProgress, solve_many
from catenaria.workflow.batch_table import BatchSummary, Row
from catenaria.workflow.compare import Compared, compare, write_comparison
from catenaria.workflow.elasticity import elasticity, elasticity_as, write_elasticity
from catenaria.workflow.export import (
    FORMATS,
    ExportFormat,
    ExportOptions,
    export,
    formats_of,
    tables_schema,
)
from catenaria.workflow.loads import under_loads, write_loads
from catenaria.workflow.methods import METHODS, NEGLECTS
from catenaria.workflow.replay import replay
from catenaria.workflow.report import check_result, report, write_report
from catenaria.workflow.rounding import rounding, write_rounding
from catenaria.workflow.solve import Rebuild, audited, find, solve
from catenaria.workflow.solve_structure import solve_structure
from catenaria.workflow.tolerance import tolerances, write_tolerances
from catenaria.workflow.validate import CaseProgress, ValidatedCase, validate
from catenaria.workflow.write import write
from catenaria.workflow.write_network import write_network
from catenaria.workflow.write_validation import write_validation

__all__ = [
    "FORMATS",
    "METHODS",
    "NEGLECTS",
    "BatchProgress",
    "BatchSummary",
    "CaseProgress",
    "Compared",
    "ExportFormat",
    "ExportOptions",
    "Progress",
    "Rebuild",
    "Row",
    "ValidatedCase",
    "adjust",
    "audited",
    "check_result",
    "compare",
    "elasticity",
    "elasticity_as",
    "export",
    "find",
    "formats_of",
    "replay",
    "report",
    "rounding",
    "solve",
    "solve_many",
    "solve_structure",
    "tables_schema",
    "tolerances",
    "under_loads",
    "validate",
    "write",
    "write_adjustment",
    "write_comparison",
    "write_elasticity",
    "write_loads",
    "write_network",
    "write_report",
    "write_rounding",
    "write_tolerances",
    "write_validation",
]
