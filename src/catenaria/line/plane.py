"""What takes a line out of the plane of two wires that run freely through level supports."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Final

from catenaria.line.base import Path

if TYPE_CHECKING:
    from catenaria.line.line import Line
    from catenaria.line.support import Support
    from catenaria.line.wire import Wire

_SAME_HEIGHT: Final = 1e-9  # m: rounding of a height and an encumbrance that are added


def beyond_plane(line: Line) -> Iterator[tuple[Path, str]]:
    """Find what the plane line of Yang et al. 2017 does not have.

    Yields
    ------
    tuple of path and str
        Where it stands in the file, and what it is.
    """
    for field, wire in (("contact_wire", line.contact_wire), ("messenger_wire", line.messenger_wire)):
        for path, what in _wire(wire):
            yield (field, *path), what
    yield from _more_wires(line)
    if line.dropper.model != "cables":
        yield ("dropper", "model"), f"a dropper modelled as {line.dropper.model}"
    if line.dropper.slack != "refused":
        yield ("dropper", "slack"), "a dropper that may hang slack"
    for i, support in enumerate(line.supports):
        for path, what in _support(support):
            yield ("supports", i, *path), what
    yield from _heights(line)
    if line.track.curves:
        yield ("track", "curves"), "a curved track"
    if line.track.gradients:
        yield ("track", "gradients"), "a track with gradients"


def _wire(wire: Wire) -> Iterator[tuple[Path, str]]:
    if wire.tension.pulled != "both":
        yield ("tension", "pulled"), f"a wire that is pulled at its {wire.tension.pulled} only"
    if wire.tension.device.efficiency != 1.0:
        yield ("tension", "device", "efficiency"), "a device with losses"
    for field in ("anchor_start", "anchor_end"):
        if getattr(wire, field) is not None:
            yield (field,), "an anchor away from the end support"
    if wire.wear != 0.0:
        yield ("wear",), "a worn wire"


def _more_wires(line: Line) -> Iterator[tuple[Path, str]]:
    if line.second_contact_wire is not None:
        yield ("second_contact_wire",), "a second contact wire"
    if line.auxiliary_messenger is not None:
        yield ("auxiliary_messenger",), "an auxiliary messenger"
    if line.stitched_supports:
        yield ("stitch_wire",), "a line with stitch wires"
    if line.mid_point is not None:
        yield ("mid_point",), "a mid-point anchor"
    if line.point_masses:
        yield ("point_masses",), "a point mass on a wire"


def _support(support: Support) -> Iterator[tuple[Path, str]]:
    messenger = support.messenger_wire
    if support.contact_wire is not None and support.contact_wire.kind != "sliding":
        yield ("contact_wire", "kind"), f"a {support.contact_wire.kind}"
    if messenger.kind != "sliding":
        yield ("messenger_wire", "kind"), f"a {messenger.kind} messenger support"
    if messenger.friction != 0.0:
        yield ("messenger_wire", "friction"), "a messenger support with friction"
    if support.stagger != 0.0:
        yield ("stagger",), "a stagger other than 0"
    if support.messenger_stagger:
        yield ("messenger_stagger",), "a stagger other than 0"


def _heights(line: Line) -> Iterator[tuple[Path, str]]:
    """Yield supports that do not hold a wire as high as its first one."""
    contact, first = line.contact_support_indices[0], line.supports[0]
    level = line.supports[contact].contact_wire
    for i, support in enumerate(line.supports):
        held = support.contact_wire
        if held and level and abs(held.height - level.height) > _SAME_HEIGHT:
            yield ("supports", i, "contact_wire", "height"), "a contact wire held at different heights"
        if abs(support.messenger_height - first.messenger_height) > _SAME_HEIGHT:
            yield ("supports", i, "messenger_wire"), "a messenger wire held at different heights"
