"""All form-finding methods by name, and what each of them neglects."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from catenaria.formfinding.direct import Direct
from catenaria.formfinding.dynamic_equilibrium import DynamicEquilibrium
from catenaria.formfinding.finite_elements.registry import ELEMENT_METHODS
from catenaria.formfinding.progress import Listener
from catenaria.formfinding.strings.registry import STRING_METHODS
from catenaria.line import Line
from catenaria.results.form import FormResult


class Method(Protocol):
    """What a form-finding method can do."""

    def find_form(self, line: Line, start: FormResult | None = None) -> FormResult:
        """Find the form of a line, beginning from an earlier result if there is one."""
        ...


Make = Callable[[Listener | None], Method]

METHODS: dict[str, Make] = {
    "direct": Direct,
    "dynamic": DynamicEquilibrium,
    **STRING_METHODS,
    **ELEMENT_METHODS,
}

SPATIAL = ("direct", "dynamic")  # the others know plane lines of two wires only

NEGLECTS = {
    "direct": "nothing that the line describes",
    "dynamic": "what is left of targets within its dead bands",
    **{name: make(None).neglects for name, make in (STRING_METHODS | ELEMENT_METHODS).items()},
}
