"""What a result was computed with."""

from __future__ import annotations

import platform
from importlib.metadata import version

from catenaria import __version__


def versions() -> dict[str, str]:
    """Return the versions of catenaria, Python and the numerical libraries."""
    libraries = {name: version(name) for name in ("numpy", "scipy", "numba")}
    return {"catenaria": __version__, "python": platform.python_version(), **libraries}
