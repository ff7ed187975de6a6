"""Texts of a page that are not HTML: the echo of the line, strings of the style sheet, data of scripts."""

from __future__ import annotations

import io
import json
from typing import Any, cast

from ruamel.yaml import YAML

from catenaria.line import Line

_DIGITS = 12


def echo(line: Line) -> str:
    """Return the line as YAML in SI, short where it can be, to twelve digits."""
    writer: Any = YAML(typ="safe", pure=True)
    writer.default_flow_style = None
    writer.sort_base_mapping_type_on_output = False
    writer.width = 110
    stream = io.StringIO()
    writer.dump(shortened(line.model_dump(mode="json", exclude_none=True)), stream)
    return stream.getvalue()


def shortened(value: Any) -> Any:
    """Return data without the digits that the conversion of units leaves behind.

    Examples
    --------
    >>> shortened({"area": [1.5800000000000002e-05, 1]})
    {'area': [1.58e-05, 1]}
    """
    if isinstance(value, float):
        return float(f"{value:.{_DIGITS}g}")
    if isinstance(value, dict):
        return {key: shortened(item) for key, item in cast("dict[str, Any]", value).items()}
    if isinstance(value, list):
        return [shortened(item) for item in cast("list[Any]", value)]
    return value


def style_text(text: str) -> str:
    r"""Return a text as a string of a style sheet, whatever is in it.

    Examples
    --------
    >>> print(style_text('"S1"</style>'))
    "\22 S1\22 \3c \2f style\3e "
    """
    plain = (c if c.isalnum() or c in " ,.:-" else f"\\{ord(c):x} " for c in text)
    return f'"{"".join(plain)}"'


def script_data(value: Any) -> str:
    r"""Return JSON that may stand within a script element, whatever texts are in it.

    Examples
    --------
    >>> script_data(["</script>"])
    '["\\u003c/script\\u003e"]'
    """
    text = json.dumps(value, separators=(",", ":"), ensure_ascii=False, allow_nan=False)
    return text.replace("<", "\\u003c").replace(">", "\\u003e").replace("&", "\\u0026")
