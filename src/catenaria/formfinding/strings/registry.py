"""All methods for strings by name."""

from __future__ import annotations

from functools import partial

from catenaria.formfinding.strings import separated
from catenaria.formfinding.strings.method import StringMethod

STRING_METHODS = {
    "separated": partial(StringMethod, "separated", separated.NEGLECTS, separated.find_rest),
}
