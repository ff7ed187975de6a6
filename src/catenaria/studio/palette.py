"""Colours of figures: those of the report's style sheet, light or dark, put into its drawings."""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import cache
from importlib.resources import files
from typing import Any, Final, cast

_RULE: Final = re.compile(r":root[^{]*\{([^}]*)\}")
_COLOUR: Final = re.compile(r"--([a-z-]+):\s*([^;]+);")
_NAMED: Final = re.compile(r"var\(--([a-z-]+)\)")


@cache
def palette(dark: bool) -> Mapping[str, str]:
    """Return all colours by name; the style sheet's first rule is the light one, its second the dark one.

    Examples
    --------
    >>> palette(False)["paper"]
    '#ffffff'
    """
    style = files("catenaria.report.html").joinpath("style.css").read_text(encoding="utf-8")
    return dict(_COLOUR.findall(_RULE.findall(style)[int(dark)]))


def coloured(value: Any, dark: bool) -> Any:
    """Return data for Plotly with colours in the places of their names.

    Examples
    --------
    >>> coloured({"line": {"color": "var(--paper)"}, "x": [1.0]}, False)
    {'line': {'color': '#ffffff'}, 'x': [1.0]}
    """
    if isinstance(value, str):
        return _NAMED.sub(lambda name: palette(dark)[name[1]], value)
    if isinstance(value, dict):
        return {key: coloured(item, dark) for key, item in cast("dict[str, Any]", value).items()}
    if isinstance(value, list):
        items = cast("list[Any]", value)
        return (
            [coloured(item, dark) for item in items] if isinstance(next(iter(items), None), dict) else items
        )
    return value
