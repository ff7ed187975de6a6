"""All methods for finite elements by name."""

from __future__ import annotations

from functools import partial

from catenaria.formfinding.finite_elements.adjusted_lengths import adjust_lengths
from catenaria.formfinding.finite_elements.constrained_optimisation import optimise_under_constraints
from catenaria.formfinding.finite_elements.geometry_variation import vary_geometry
from catenaria.formfinding.finite_elements.least_distance import minimise_distance
from catenaria.formfinding.finite_elements.least_force_error import minimise_force_error
from catenaria.formfinding.finite_elements.method import ElementMethod, Search
from catenaria.formfinding.finite_elements.nonlinear_displacement import displace_nonlinearly
from catenaria.formfinding.finite_elements.trial_lengths import try_lengths
from catenaria.formfinding.finite_elements.weighted_residual import minimise_weighted_residual

NEGLECTS = "the third direction"

_SEARCHES: dict[str, Search] = {
    "adjusted lengths": adjust_lengths,
    "trial lengths": try_lengths,
    "nonlinear displacement": displace_nonlinearly,
    "geometry variation": vary_geometry,
    "least distance": minimise_distance,
    "least force error": minimise_force_error,
    "weighted residual": minimise_weighted_residual,
    "constrained optimisation": optimise_under_constraints,
}

ELEMENT_METHODS = {name: partial(ElementMethod, name, NEGLECTS, search) for name, search in _SEARCHES.items()}
