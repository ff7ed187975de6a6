"""What a result was computed with."""

from __future__ import annotations

import platform
from functools import cache
from importlib.metadata import version

from catenaria import __version__

_version = cache(version)  # reads and parses a file of each library


def versions() -> dict[str, str]:
    """Return the versions of catenaria, Python and the numerical libraries."""
    libraries = {name: _version(name) for name in ("numpy", "scipy", "numba")}
    return {"catenaria": __version__, "python": platform.python_version(), **libraries}
