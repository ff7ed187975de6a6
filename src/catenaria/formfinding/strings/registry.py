"""All methods for strings by name."""

from __future__ import annotations

from functools import partial

from catenaria.formfinding.strings import (
    adaptive_force_density,
    catenary_equations,
    extended_force_density,
    force_density,
    negative_sag,
    separated,
    spatial_catenary_equations,
)
from catenaria.formfinding.strings.method import StringMethod

STRING_METHODS = {
    "separated": partial(StringMethod, "separated", separated.NEGLECTS, separated.find_rest),
    "force density": partial(StringMethod, "force density", force_density.NEGLECTS, force_density.find_rest),
    "extended force density": partial(
        StringMethod,
        "extended force density",
        extended_force_density.NEGLECTS,
        extended_force_density.find_rest,
    ),
    "adaptive force density": partial(
        StringMethod,
        "adaptive force density",
        adaptive_force_density.NEGLECTS,
        adaptive_force_density.find_rest,
    ),
    "catenary equations": partial(
        StringMethod, "catenary equations", catenary_equations.NEGLECTS, catenary_equations.find_rest
    ),
    "spatial catenary equations": partial(
        StringMethod,
        "spatial catenary equations",
        spatial_catenary_equations.NEGLECTS,
        spatial_catenary_equations.find_rest,
    ),
    "negative sag": partial(StringMethod, "negative sag", negative_sag.NEGLECTS, negative_sag.find_rest),
}
