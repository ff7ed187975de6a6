"""The constraints of a line at rest one by one: ends, supports, arms, ties, roots and rigid droppers."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.spatial.layout import across
from catenaria.export.resting import RestingLine

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

Joint = dict[str, Any]


def joints(rest: RestingLine) -> list[Joint]:
    """Return what ``model.json`` says of every constraint of a line.

    Each names its kind, its rows in C, the force that it takes from the line there, and what it holds: a
    wire at a material coordinate or a node of the table of nodes.
    """
    found = [*_ends(rest), *_holds(rest), *_ties(rest), *_roots(rest), *_rigid_droppers(rest)]
    return [joint | {"force": rest.constraint_force[joint["rows"]].tolist()} for joint in found]


def first_nodes(rest: RestingLine) -> IntArray:
    """Return the number of each strand's first node, and behind them that of all nodes."""
    return np.concatenate(([0], np.cumsum([chain.knots.size for chain in rest.strands])))


def _ends(rest: RestingLine) -> Iterator[Joint]:
    first = first_nodes(rest)
    for k, (laid, chain) in enumerate(zip(rest.model.layout.wires, rest.model.wires, strict=True)):
        for end in (0, 1):
            if laid.tied:
                continue
            yield {
                "kind": "end",
                "rows": _listed(rest.rows(rest.model.end_force[k, end])),
                "wire": k,
                "node": int(first[k + end] - end),
                "coordinate": float(chain.knots[-end]),
                "place": rest.z[chain.nodes[-end, :3]].tolist(),
                "outwards": laid.outwards[end].tolist(),
                "device": bool(laid.pulled[end]),
            }


def _holds(rest: RestingLine) -> Iterator[Joint]:
    model, holds = rest.model, rest.model.layout.holds
    names = [support.name or f"S{i + 1}" for i, support in enumerate(rest.line.supports)]
    rollers, brackets, arms = (iter(part.tolist()) for part in _force_rows(rest))
    sliding = iter(range(6 * int(first_nodes(rest)[-1]), rest.coordinates.size))
    tips = {part.hold: j for j, part in enumerate(model.layout.cantilevers)}
    left = across(holds.frame)
    place = model.hold_carrier.evaluate(rest.z, rest.z[model.hold_s]).r
    for i, kind in enumerate(holds.kind):
        joint: Joint = {
            "kind": kind,
            "support": names[int(holds.support[i])],
            "wire": int(holds.wire[i]),
            "coordinate": float(rest.z[model.hold_s[i]]),
            "place": place[i].tolist(),
            "along": holds.frame.along[i].tolist(),
        }
        if holds.hinged[i]:
            length = float(holds.arm_length[i])
            yield joint | {"rows": [next(arms)], "hinge": holds.hinge[i].tolist(), "length": length}
            continue
        if holds.guided[i]:
            yield joint | {"rows": next(brackets), "left": left[i].tolist()}
            continue
        joint["rows"] = next(rollers)
        if kind == "spring":
            joint |= {"unloaded": holds.X[i].tolist(), "compliance": holds.compliance[i].tolist()}
        if kind == "cantilever":
            joint["node"] = int(first_nodes(rest)[len(model.wires) + tips[i] + 1] - 1)
        yield joint | {
            "left": left[i].tolist(),
            "friction": float(holds.friction[i]),
            "sliding": next(sliding) if rest.running[i] else None,
        }


def _force_rows(rest: RestingLine) -> tuple[IntArray, IntArray, IntArray]:
    model = rest.model
    return rest.rows(model.roller_force), rest.rows(model.across_force), rest.rows(model.arm_density)


def _ties(rest: RestingLine) -> Iterator[Joint]:
    model, ties, first = rest.model, rest.model.layout.ties, first_nodes(rest)
    for i, rows in enumerate(rest.rows(model.tie_force)):
        k, end = int(ties.wire[i]), int(ties.end[i])
        yield {
            "kind": "tie",
            "rows": _listed(rows),
            "wire": k,
            "node": int(first[k + end] - end),
            "host": int(ties.host[i]),
            "coordinate": float(rest.z[model.tie_s[i]]),
        }


def _roots(rest: RestingLine) -> Iterator[Joint]:
    count, first = len(rest.model.wires), first_nodes(rest)
    for j, rows in enumerate(rest.rows(rest.model.root_force)):
        yield {"kind": "root", "rows": _listed(rows), "wire": count + j, "node": int(first[count + j])}


def _rigid_droppers(rest: RestingLine) -> Iterator[Joint]:
    for i in np.flatnonzero(rest.rigid).tolist():
        row = rest.rows(rest.model.density[[i]])
        yield {"kind": "rigid dropper", "rows": _listed(row), "dropper": i}


def _listed(rows: IntArray) -> list[int]:
    return [int(row) for row in rows]
