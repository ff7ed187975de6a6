"""What must fit together in a structure although every part is right in itself."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from math import dist
from typing import TYPE_CHECKING

import numpy as np

from catenaria.line.base import Path, Problem, closest
from catenaria.structure.joint import Attachment, Joint
from catenaria.structure.layout import lay_out

if TYPE_CHECKING:
    from catenaria.structure.structure import Structure

_OPEN = 1e-6  # m by which a joint may be open at the start


def structure_problems(structure: Structure) -> Iterator[Problem]:
    """Find everything that contradicts something else in the structure.

    Yields
    ------
    Problem
        One for each contradiction, at the place where it would be mended.
    """
    for name, cable in structure.cables.items():
        yield from _unknown("section", ("cables", name, "section"), cable.section, structure.sections)
    for name, mass in structure.masses.items():
        yield from _wrong_point(structure, ("masses", name, "on"), mass.on)
    wrong = [problem for name in structure.joints for problem in _wrong_joint(structure, name)]
    yield from wrong
    yield from _names_given_twice(structure)
    yield from _wrong_moves(structure)
    yield from _wrong_measures(structure)
    if not wrong:
        yield from _wrong_halves(structure)


def _unknown(what: str, path: Path, name: str, names: Iterable[str]) -> Iterator[Problem]:
    known = list(names)
    if name not in known:
        list_ = ", ".join(known) or "none"
        yield Problem(path, name, f"the name of a {what}: {list_}{closest(str(name), known)}")


def _wrong_point(structure: Structure, path: Path, point: Attachment) -> Iterator[Problem]:
    yield from _unknown("cable", (*path, "cable"), point.cable, structure.cables)
    cable = structure.cables.get(point.cable)
    if cable is not None and point.coordinate(cable.length) > cable.length:
        allowed = f"start, end, or a coordinate on the cable, 0 to {cable.length:g} m"
        yield Problem((*path, "point"), point.point, allowed)


def _wrong_joint(structure: Structure, name: str) -> Iterator[Problem]:
    joint, path = structure.joints[name], ("joints", name)
    wrong = list(_wrong_point(structure, (*path, "on"), joint.on))
    if joint.to is not None:
        wrong += _wrong_point(structure, (*path, "to"), joint.to)
    if joint.type == "guided" and joint.to is None:
        wrong.append(Problem((*path, "to"), None, "a point of the cable that is guided", "missing"))
    yield from wrong
    if not wrong:
        yield from _held_twice(structure, name)
        yield from _open(structure, joint, path)


def _held_twice(structure: Structure, name: str) -> Iterator[Problem]:
    """Find sliding joints where another joint has the same point of the same cable: constrained twice."""
    joint = structure.joints[name]
    if not joint.slides or joint.on.cable not in structure.cables:
        return
    length = structure.cables[joint.on.cable].length
    for other_name, other in structure.joints.items():
        ends = (other.on, *((other.to,) if other.to else ()))
        places = [end.coordinate(length) for end in ends if end.cable == joint.on.cable]
        if other_name != name and joint.on.coordinate(length) in places:
            allowed = (
                f"a point that is not also in joint {other_name}: let the cable run on beyond this joint"
            )
            yield Problem(("joints", name, "on"), joint.on, allowed)


def _open(structure: Structure, joint: Joint, path: Path) -> Iterator[Problem]:
    if joint.to is None:
        return
    ends = ((structure.cables[point.cable], point) for point in (joint.on, joint.to))
    a, b = (lay_out(cable, np.array([point.coordinate(cable.length)]))[0][0] for cable, point in ends)
    gap = dist(a, b)
    if gap > _OPEN:
        yield Problem(
            (*path, "to"), joint.to, f"a point where cable {joint.on.cable} is: it is {gap:.4g} m away"
        )


def _names_given_twice(structure: Structure) -> Iterator[Problem]:
    seen: set[str] = set()
    for group in ("tensions", "heights", "balances"):
        for name in getattr(structure, group):
            if name in seen:
                yield Problem((group, name), name, "a name that no other control has")
            seen.add(name)


def _controls(structure: Structure) -> Iterator[tuple[Path, str]]:
    for group in ("tensions", "heights", "balances"):
        for name, control in getattr(structure, group).items():
            yield from (((group, name, "move", joint), joint) for joint in control.move)


def _wrong_moves(structure: Structure) -> Iterator[Problem]:
    """Each target needs held points of its own that are released to meet it."""
    moved: set[str] = set()
    for path, name in _controls(structure):
        yield from _unknown("joint", path, name, structure.joints)
        joint = structure.joints.get(name)
        if joint is not None and not joint.is_held_point:
            yield Problem(path, name, "a held point: a spherical joint to the ground")
        if name in moved:
            yield Problem(
                path, name, "a held point that no other control moves: each target releases its own"
            )
        moved.add(name)


def _wrong_measures(structure: Structure) -> Iterator[Problem]:
    moved = {name for _, name in _controls(structure)}
    for name, target in structure.tensions.items():
        path = ("tensions", name, "joint")
        yield from _unknown("joint", path, target.joint, structure.joints)
        joint = structure.joints.get(target.joint)
        if joint is None:
            continue
        if target.measure == "strain" and not joint.slides:
            yield Problem(path, target.joint, "a sliding or guided joint, where the strain is measured")
        if target.measure == "pull" and target.joint not in target.move:
            yield Problem(path, target.joint, "one of the joints that this control moves")
        if target.measure == "reaction" and not (joint.is_held_point and joint.on.point in ("start", "end")):
            yield Problem(path, target.joint, "a spherical joint of a cable's start or end with the ground")
    for name, target in structure.heights.items():
        path = ("heights", name, "joint")
        yield from _unknown("joint", path, target.joint, structure.joints)
        joint = structure.joints.get(target.joint)
        if joint is not None and joint.to is None and target.joint not in moved:
            yield Problem(path, target.joint, "a joint between two cables: this one is fixed to the ground")


def _wrong_halves(structure: Structure) -> Iterator[Problem]:
    for name, balance in structure.balances.items():
        for i, half in enumerate(balance.halves):
            path: Path = ("balances", name, "halves", i)
            unknown = list(_unknown("cable", path, half, structure.cables))
            yield from unknown
            if not unknown and len(list(joints_with_other_cables(structure, half))) != 1:
                yield Problem(path, half, "a cable with exactly one joint to another cable")


def joints_with_other_cables(structure: Structure, cable: str) -> Iterator[tuple[str, Attachment, float]]:
    """Yield the joints of a cable with others: name, its own point, sign of the joint's force on it."""
    for name, joint in structure.joints.items():
        if joint.to is not None and joint.on.cable != joint.to.cable:
            if joint.on.cable == cable:
                yield name, joint.on, -1.0
            elif joint.to.cable == cable:
                yield name, joint.to, 1.0
