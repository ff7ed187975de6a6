"""Libraries that only exports need, imported when they are needed."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from catenaria.errors import UnsupportedError


def library(module: str, name: str, purpose: str) -> Any:
    """Return a module of the extra ``export``.

    Parameters
    ----------
    module : str
        What is imported.
    name : str
        Of the library, as it is installed.
    purpose : str
        What needs it, for the message.

    Raises
    ------
    UnsupportedError
        If it is not installed.

    Examples
    --------
    >>> library("json", "json", "JSON").dumps([1])
    '[1]'
    >>> library("no_such_module", "Nothing", "XLSX")
    Traceback (most recent call last):
        ...
    catenaria.errors.UnsupportedError: XLSX needs Nothing. Install it: pip install 'catenaria[export]'
    """
    try:
        return import_module(module)
    except ModuleNotFoundError as error:
        raise UnsupportedError(
            f"{purpose} needs {name}. Install it: pip install 'catenaria[export]'"
        ) from error
