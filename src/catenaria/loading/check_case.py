"""Whether a load case names what a line has."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from catenaria.errors import Fault, InconsistentInputError, LineFileError
from catenaria.line.base import Problem, closest
from catenaria.line.load_case import BrokenDropper, LoadCase, LoadCases, MovedSupport, Push
from catenaria.line.source import format_path
from catenaria.results.form import FormResult


def check_cases(cases: LoadCases, result: FormResult) -> None:
    """Refuse cases that name droppers, supports, wires or chainages that a line does not have.

    Raises
    ------
    LineFileError
        If they were read from a file, with its lines.
    InconsistentInputError
        Else.
    """
    source, faults = cases.source, list[Fault]()
    for name, case in cases.cases.items():
        for problem in case_problems(case, result):
            path = ("cases", name, *problem.path)
            place = source.mark(path)
            faults.append(Fault(source.file, *place, format_path(path), str(problem.found), problem.allowed))
    if faults and not source.file:
        raise InconsistentInputError(
            "; ".join(f"{fault.field}: found {fault.found}; allowed: {fault.allowed}" for fault in faults)
        )
    if faults:
        raise LineFileError(tuple(faults))


def case_problems(case: LoadCase, result: FormResult) -> Iterator[Problem]:
    """Yield what a case names and a line does not have."""
    for i, broken in enumerate(case.broken_droppers):
        yield from _dropper(broken, result, i)
    for i, moved in enumerate(case.moved_supports):
        yield from _support(moved, result, i)
    for i, push in enumerate(case.push):
        yield from _push(push, result, i)


def _dropper(broken: BrokenDropper, result: FormResult, i: int) -> Iterator[Problem]:
    droppers, place = result.droppers, ("broken_droppers", i)
    in_span = droppers.span == broken.span
    known = in_span & (droppers.number == broken.number)
    if not in_span.any():
        spans = f"a span with droppers: {_listed(np.unique(droppers.span).tolist())}"
        yield Problem((*place, "span"), broken.span, spans)
    elif not known.any():
        numbers = _listed(np.unique(droppers.number[in_span]).tolist())
        yield Problem((*place, "number"), broken.number, f"a dropper of span {broken.span}: {numbers}")
    elif broken.wire is not None:
        wires = {droppers.lower_wire[k] for k in np.flatnonzero(known)}
        if broken.wire not in wires:
            yield Problem(
                (*place, "wire"), broken.wire, f"what this dropper carries: {', '.join(sorted(wires))}"
            )


def _support(moved: MovedSupport, result: FormResult, i: int) -> Iterator[Problem]:
    supports, place = result.supports, ("moved_supports", i)
    held = [wire for name, wire in zip(supports.support, supports.wire, strict=True) if name == moved.support]
    if not held:
        order: list[int] = np.argsort(supports.chainage, kind="stable").tolist()
        names = list(dict.fromkeys(supports.support[i] for i in order))
        yield Problem((*place, "support"), moved.support, f"{_listed(names)}{closest(moved.support, names)}")
    elif moved.wire is not None and moved.wire not in held:
        yield Problem((*place, "wire"), moved.wire, f"a wire that it holds: {', '.join(held)}")


def _push(push: Push, result: FormResult, i: int) -> Iterator[Problem]:
    wires = {wire.name: wire for wire in result.wires}
    if push.wire not in wires:
        yield Problem(("push", i, "wire"), push.wire, f"{_listed(list(wires))}{closest(push.wire, wires)}")
        return
    chainage = wires[push.wire].profile.chainage
    if not chainage[0] <= push.chainage <= chainage[-1]:
        reach = f"on the {push.wire}: {chainage[0]:.6g} m to {chainage[-1]:.6g} m"
        yield Problem(("push", i, "chainage"), push.chainage, reach)


def _listed(names: list[str] | list[int]) -> str:
    """Join names, of many the first and the last ones."""
    texts = [str(name) for name in names]
    return ", ".join(texts if len(texts) <= 8 else [*texts[:3], "...", *texts[-2:]])
