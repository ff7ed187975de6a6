"""Form-finding of railway overhead contact lines.

The names in `__all__` are the stable ones, those of `catenaria.api`; docs/guide/python.md explains them. They
are imported when they are first used, so that ``import catenaria`` costs next to nothing, and type checkers
see them in ``__init__.pyi``.

Examples
--------
>>> import catenaria
>>> result = catenaria.solve("examples/yang2017_three_span.yaml")
>>> result.droppers["cut_length_m"].round(4).head(3).tolist()
[1.3789, 1.1501, 1.0128]
"""

# pyright: reportUnsupportedDunderAll=false
# The names come from __getattr__.

from __future__ import annotations

from importlib import import_module

__version__ = "0.1.0"

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


def __getattr__(name: str) -> object:
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = globals()[name] = getattr(import_module("catenaria.api"), name)
    return value


def __dir__() -> list[str]:
    return [*__all__, "__version__"]
