"""From a line of strings at rest to a result: the third step, tables and profiles."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from catenaria.catenary.green_bar import stretch
from catenaria.errors import InfeasibleError
from catenaria.formfinding.strings.at_rest import LineAtRest, StringAtRest
from catenaria.formfinding.strings.named import named
from catenaria.formfinding.strings.task import StringLine, StringWire
from catenaria.formfinding.versions import versions
from catenaria.line import Line
from catenaria.numerics.gauss import gauss_legendre
from catenaria.results.form import Controls, Counters, Droppers, FormResult, Profile, Supports, WireForm

FloatArray = NDArray[np.float64]

_SAMPLES = 8  # points between two given ones


def form_result(
    line: Line, task: StringLine, method: str, reason: str, found: LineAtRest, counters: tuple[Counters, ...]
) -> FormResult:
    """Return the result that strings at rest amount to.

    Parameters
    ----------
    line, task : Line, StringLine
        What was asked for.
    method, reason : str
        Name of the method, and why it stopped.
    found : LineAtRest
        What was found.
    counters : tuple of Counters
        Work.

    Raises
    ------
    InfeasibleError
        If droppers would be in compression, stand upside down, or be cut to nothing.
    """
    droppers = _schedule(line, task, found)
    refuse_impossible(droppers)
    pairs = (task.contact, found.contact), (task.messenger, found.messenger)
    wires = tuple(_wire_form(wire, string) for wire, string in pairs)
    return FormResult(
        name=line.name,
        method=method,
        stop_reason=reason,
        droppers=droppers,
        wires=wires,
        supports=_supports(line, pairs),
        controls=_controls(droppers, wires),
        histories=(),
        counters=counters,
        stages=(),
        inputs=line.model_dump(mode="json"),
        versions=versions(),
        physics="string",
    )


def refuse_impossible(droppers: Droppers) -> None:
    """Refuse a schedule that cannot be built, naming the droppers."""
    for wrong, what, advice in (
        (
            droppers.force_bottom < 0.0,
            "would be in compression",
            "a smaller pre-sag, less tension of the contact wire or other dropper positions would help",
        ),
        (
            droppers.messenger_height <= droppers.height,
            "would stand upside down",
            "more tension of the messenger wire or higher supports would help",
        ),
        (droppers.cut_length <= 0.0, "would be cut to nothing", "check the clamp heights"),
    ):
        if np.any(wrong):
            names = named(droppers.span, wrong)
            raise InfeasibleError(f"droppers {what}: {names}; {advice}")


def _schedule(line: Line, task: StringLine, found: LineAtRest) -> Droppers:
    contact, messenger = found.contact, found.messenger
    foot, top = contact.r[contact.clamp], messenger.r[messenger.clamp]
    on_contact, on_messenger = contact.force[contact.clamp], messenger.force[messenger.clamp]
    kind, span = line.dropper, np.array(line.dropper_span, dtype=np.int64)
    force_bottom, force_top = on_contact[:, 2], -on_messenger[:, 2]
    return Droppers(
        lower_wire=(task.contact.name,) * span.size,
        upper_wire=(task.messenger.name,) * span.size,
        span=span + 1,
        number=np.arange(span.size) - np.searchsorted(span, span) + 1,
        x=task.x,
        position_bottom=foot,
        position_top=top,
        stagger_bottom=foot[:, 1].copy(),
        stagger_top=top[:, 1].copy(),
        length=np.linalg.norm(top - foot, axis=1),
        unstressed_length=found.unstressed,
        cut_length=found.unstressed - kind.clamp_height_top - kind.clamp_height_bottom,
        force_top=force_top,
        force_bottom=force_bottom,
        height=foot[:, 2],
        target_height=task.height,
        height_error=foot[:, 2] - task.height,
        messenger_height=top[:, 2],
        force_error=force_top - task.load(found.unstressed, force_bottom),
        contact_coordinate=contact.s[contact.clamp],
        messenger_coordinate=messenger.s[messenger.clamp],
        on_contact=on_contact,
        on_messenger=on_messenger,
    )


class _Sampled(NamedTuple):
    """A string at many points, where a force makes it jump behind them; and the stretched lengths between."""

    s: FloatArray
    r: FloatArray
    F: FloatArray
    size: FloatArray
    stretch: FloatArray
    length: FloatArray


def _sample(wire: StringWire, string: StringAtRest) -> _Sampled:
    r"""Return a string at several points of every piece between given ones.

    Notes
    -----
    Force :math:`F(s) = -\sum_{s_i \le s} f_i + w\,(s - s_0)\,e_z`, position
    :math:`r(s) = r_i + \int x(T)\,F/T\,ds` with T = |F| and the stretch x. Where that does not end at the
    next given point, because the method divides a wire into elements, the gap is spread over the piece.
    """
    before = -np.cumsum(string.force, axis=0)[:-1]
    ds = np.diff(string.s) / _SAMPLES
    s = (string.s[:-1, None] + ds[:, None] * np.arange(_SAMPLES)).ravel()
    before, ds = np.repeat(before, _SAMPLES, axis=0), np.repeat(ds, _SAMPLES)
    points, weights = gauss_legendre(3)
    step, length = np.zeros((s.size, 3)), np.zeros(s.size)
    for point, weight in zip(points, weights, strict=True):
        inner = before.copy()
        inner[:, 2] += wire.w * (s + 0.5 * (point + 1.0) * ds - string.s[0])
        size = np.linalg.norm(inner, axis=1)
        part = 0.5 * weight * ds * stretch(size, wire.EA)
        length += part
        step += (part / size)[:, None] * inner
    step = step.reshape(-1, _SAMPLES, 3)
    step += ((np.diff(string.r, axis=0) - step.sum(axis=1)) / _SAMPLES)[:, None]
    r = (string.r[:-1, None] + np.cumsum(step, axis=1) - step).reshape(-1, 3)
    s, r = np.append(s, string.s[-1]), np.vstack((r, string.r[-1]))
    behind = np.vstack((before, string.force[-1]))
    behind[:-1, 2] += wire.w * (s[:-1] - string.s[0])
    size = np.linalg.norm(behind, axis=1)
    return _Sampled(s, r, behind, size, stretch(size, wire.EA), length)


def _wire_form(wire: StringWire, string: StringAtRest) -> WireForm:
    sampled = _sample(wire, string)
    first, last = (_SAMPLES * int(i) for i in string.support[[0, -1]])
    between = slice(first, last + 1)
    ds = np.diff(sampled.s[between])
    tensions = sampled.size[between]
    end_force = -string.force[[0, -1]]
    reaction = np.linalg.norm(end_force, axis=1)
    tension = float(reaction[-1 if wire.at_end else 0])
    hung = string.support
    if wire.name == "contact wire":
        hung = np.sort(np.concatenate((string.support, string.clamp)))
    x, _, z = sampled.r[between].T.copy()
    at, _, up = string.r[hung].T.copy()
    chord = np.asarray(np.interp(x, at, up), dtype=np.float64)
    return WireForm(
        name=wire.name,
        role=wire.name,
        unstressed_length=float(sampled.s[last] - sampled.s[first]),
        stretched_length=float(np.sum(sampled.length[first:last])),
        target_tension=wire.tension,
        tension=tension,
        tension_error=tension - wire.tension,
        measure="reaction",
        horizontal_start=abs(float(end_force[0, 0])),
        horizontal_end=abs(float(end_force[1, 0])),
        reaction_start=float(reaction[0]),
        reaction_end=float(reaction[1]),
        end_force=end_force,
        tension_min=float(tensions.min()),
        tension_max=float(tensions.max()),
        tension_mean=float(0.5 * ds @ (tensions[:-1] + tensions[1:]) / ds.sum()),
        travel=float(string.r[-1, 0] - wire.support_x[-1]) - wire.tail,
        sag=float(np.max(chord - z, initial=0.0)),
        profile=_profile(sampled),
        start_x=np.array([wire.support_x[0] - wire.tail, wire.support_x[-1] + wire.tail]),
        start_z=wire.support_z[[0, -1]],
    )


def _profile(sampled: _Sampled) -> Profile:
    x, y, z = sampled.r.T.copy()
    tension = sampled.size
    strain = tension / sampled.stretch
    horizontal, moment = sampled.F[:, 0].copy(), np.zeros_like(tension)
    return Profile(sampled.s, x, y, z, tension, strain, horizontal, moment, x, y, z)


def _supports(line: Line, pairs: tuple[tuple[StringWire, StringAtRest], ...]) -> Supports:
    names = tuple(support.name for support in line.supports)
    held = tuple(names[i] for i in line.contact_support_indices), names
    force = np.concatenate([-string.force[string.support] for _, string in pairs])
    x = np.concatenate([wire.support_x for wire, _ in pairs])
    z = np.concatenate([wire.support_z for wire, _ in pairs])
    return Supports(
        support=tuple(name for each in held for name in each),
        wire=tuple(wire.name for wire, string in pairs for _ in string.support),
        kind=("sliding",) * x.size,
        x=x,
        y=np.zeros_like(x),
        z=z,
        chainage=x,
        stagger=np.zeros_like(x),
        height=z,
        force_x=force[:, 0],
        force_y=force[:, 1],
        force_z=force[:, 2],
        force_lateral=force[:, 1],
        tension=np.concatenate([_strain_tension(*pair) for pair in pairs]),
        sliding_coordinate=np.concatenate([string.s[string.support] for _, string in pairs]),
    )


def _strain_tension(wire: StringWire, string: StringAtRest) -> FloatArray:
    """Return N = EA eps of eq. (11) at the supports [N]."""
    force = -np.cumsum(string.force, axis=0)[string.support]
    force[:, 2] += wire.w * (string.s[string.support] - string.s[0])
    size = np.linalg.norm(force, axis=1)
    return size / stretch(size, wire.EA)


def _controls(droppers: Droppers, wires: tuple[WireForm, ...]) -> Controls:
    """Return what was prescribed. Droppers have no ends that were moved: their parameters are zero."""
    n = droppers.x.size
    tension = np.array([[wire.target_tension, wire.tension_error, wire.travel] for wire in wires])
    none = np.zeros(n)
    columns = np.vstack(
        (
            tension[:1],
            np.column_stack((droppers.target_height, droppers.height_error, none)),
            tension[1:],
            np.column_stack((droppers.force_bottom, droppers.force_error, none)),
        )
    )
    target, error, parameter = columns.T.copy()
    heights = (f"height at dropper {i + 1}" for i in range(n))
    forces = (f"force of dropper {i + 1}" for i in range(n))
    return Controls(
        name=(f"{wires[0].name} tension", *heights, f"{wires[1].name} tension", *forces),
        unit=("N", *("m",) * n, "N", *("N",) * n),
        target=target,
        value=target + error,
        error=error,
        dead_band=np.zeros_like(error),
        parameter=parameter,
    )
