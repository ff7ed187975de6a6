"""What people use from Python: a few functions, and results as they are looked at.

These names are the stable ones. `catenaria` itself has them too, and imports them from here when they are
first used.
"""

from __future__ import annotations

from catenaria.api.cross_section import CrossSection
from catenaria.api.entry import METHODS, load, load_result, solve
from catenaria.api.result import Result
from catenaria.errors import (
    CatenariaError,
    Fault,
    InconsistentInputError,
    InfeasibleError,
    LineFileError,
    NotConvergedError,
    SingularError,
    UnsupportedError,
)
from catenaria.line import Line, Mesh
from catenaria.line.load_case import LoadCases
from catenaria.workflow.variation import vary

__all__ = [
    "METHODS",
    "CatenariaError",
    "CrossSection",
    "Fault",
    "InconsistentInputError",
    "InfeasibleError",
    "Line",
    "LineFileError",
    "LoadCases",
    "Mesh",
    "NotConvergedError",
    "Result",
    "SingularError",
    "UnsupportedError",
    "load",
    "load_result",
    "solve",
    "vary",
]
