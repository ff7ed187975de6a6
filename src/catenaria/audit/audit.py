"""The audit of a result: every number that a fitter or a researcher relies on, checked by other means."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from catenaria.audit import equilibrium, internal_forces, lengths, strings
from catenaria.audit.allowance import allowance
from catenaria.audit.beams import FreeBeam
from catenaria.audit.free_wire import FreeWire, free_bodies, free_wires
from catenaria.audit.spatial.checks import checks_in_space
from catenaria.audit.stated import Stated, read_inputs
from catenaria.audit.targets import target_checks
from catenaria.audit.verdict import Check, conclude
from catenaria.errors import InconsistentInputError
from catenaria.results.audit import Audit
from catenaria.results.form import FormResult

_BENT = {"bending": FreeWire, "beam": FreeBeam}
_TRACK = np.array([1.0, 0.0, 0.0])  # of plane lines


def audit_result(result: FormResult) -> Audit:
    r"""Check the geometry, lengths and forces of a result by themselves.

    Parameters
    ----------
    result : FormResult
        Of any method. What the line file asked for is taken from the echo in `result.inputs`.

    Returns
    -------
    Audit
        `passed`, the `findings` in words, and one row for each check.

    Raises
    ------
    InconsistentInputError
        If the result lacks an entry for one of the wires, supports or droppers of its line, or, in space, one
        of its arms, ties, masses or cantilevers.

    Notes
    -----
    Nothing is shared with what found the result: wires are cubics in other terms, energy (8) is integrated by
    Clenshaw-Curtis quadrature and differentiated by complex step. Equilibrium must hold to 1e-6 of the
    largest tension, lengths to 1e-7 m, targets to the bands that the result states.

    The stated physics is the only parameter: wires whose `physics` is ``string`` must run in the direction
    of the force that the sum of all forces and weights before a point leaves there. Those whose `physics` is
    ``beam`` have one strain in every element and nodes that only turn.

    Results in space, whose wires were found all at once, are checked against a track, supports and joints
    that are read anew from the echo of the line file; see `catenaria.audit.spatial`.

    Not looked at: sags, smallest, largest and mean tensions, what the result keeps for a restart besides the
    wires' nodes, histories, counters.

    References
    ----------
    Yang et al. 2017, Multibody Syst Dyn 39, 221-247, eqs. (1)-(10), (17), (23). W. Squire, G. Trapp, Using
    complex variables to estimate derivatives of real functions, SIAM Review 40 (1998) 110-112.
    """
    return conclude(tuple(_checks(result)))


def _checks(result: FormResult) -> Iterator[Check]:
    if result.spatial:
        return checks_in_space(result)
    stated = read_inputs(result.inputs)
    if result.physics == "string":
        return _checks_of_strings(result, stated)
    if result.physics in _BENT:
        return _checks_of_wires(result, stated, _BENT[result.physics])
    kinds = "', '".join(("string", *_BENT))
    raise InconsistentInputError(f"wires are one of '{kinds}', not {result.physics!r}")


def _checks_of_strings(result: FormResult, stated: Stated) -> Iterator[Check]:
    wires = free_bodies(result, stated)
    allowed = allowance(result, wires)
    for wire in wires:
        yield from strings.wire_checks(wire, result.supports)
    yield from equilibrium.dropper_checks(
        result.droppers, stated.droppers, stated.gravity, allowed.force, wires[0].force_tolerance
    )
    yield from lengths.dropper_checks(wires, result.droppers, stated)
    yield from target_checks(result, stated, wires, allowed)


def _checks_of_wires(result: FormResult, stated: Stated, kind: type[FreeWire]) -> Iterator[Check]:
    wires = free_wires(result, stated, kind)
    allowed = allowance(result, wires)
    tolerance = max(wire.force_tolerance for wire in wires)
    yield equilibrium.node_check(wires)
    for wire in wires:
        yield from equilibrium.wire_checks(wire, stated.droppers.guided)
        yield from internal_forces.profile_checks(wire, wire.curve.at(wire.form.profile.s), _TRACK)
        yield internal_forces.support_check(wire, result.supports)
        yield from lengths.wire_checks(wire, result.supports)
    yield from equilibrium.dropper_checks(
        result.droppers, stated.droppers, stated.gravity, allowed.force, tolerance
    )
    yield equilibrium.line_check(wires, result.droppers, stated, allowed.force)
    yield from lengths.dropper_checks(wires, result.droppers, stated)
    yield from target_checks(result, stated, wires, allowed)
