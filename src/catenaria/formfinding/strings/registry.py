"""All methods for strings by name."""

from __future__ import annotations

from functools import partial

from catenaria.formfinding.strings import catenary_equations, force_density, separated
from catenaria.formfinding.strings.method import StringMethod

STRING_METHODS = {
    "separated": partial(StringMethod, "separated", separated.NEGLECTS, separated.find_rest),
    "force density": partial(StringMethod, "force density", force_density.NEGLECTS, force_density.find_rest),
    "catenary equations": partial(
        StringMethod, "catenary equations", catenary_equations.NEGLECTS, catenary_equations.find_rest
    ),
}
