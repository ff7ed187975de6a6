"""Which fields of a line the forms and tables show."""

from __future__ import annotations

from typing import Final, cast, get_args

from catenaria.line.base import Path
from catenaria.line.dropper import DropperKind
from catenaria.line.faults import value_at
from catenaria.line.library import library
from catenaria.studio.documents import Tree
from catenaria.studio.fields import Field
from catenaria.studio.spans import span_count

_LONG_WIRES: Final = ("contact_wire", "auxiliary_messenger", "messenger_wire")
_TIED_WIRES: Final = ("stitch_wire", "mid_point")


def line_fields(tree: Tree) -> list[list[Field]]:
    """Return the fields of the line as a whole, in rows."""
    fields = [
        Field(("name",), "name", kind="text"),
        Field(("speed",), "speed", "km/h"),
    ]
    if "second_contact_wire" in tree:
        fields.append(Field(("second_contact_wire", "spacing"), "spacing of contact wires", "mm"))
    return [fields, [Field(("description",), "description", kind="text")]]


def wire_fields(tree: Tree) -> list[list[Field]]:
    """Return conductor and tension of every wire, and the droppers' make, a row for each."""
    names = conductor_names(tree)
    rows = [
        [
            Field((wire, "conductor"), f"{_said(wire)}: conductor", kind="choice", choices=names),
            Field((wire, "tension", "force"), f"{_said(wire)}: tension", "kN"),
        ]
        for wire in _LONG_WIRES
        if wire in tree or wire != "auxiliary_messenger"
    ]
    rows += [
        [
            Field((wire, "conductor"), f"{_said(wire)}: conductor", kind="choice", choices=names),
            Field((wire, "tension"), f"{_said(wire)}: tension", "kN"),
        ]
        for wire in _TIED_WIRES
        if wire in tree
    ]
    models = get_args(DropperKind.model_fields["model"].annotation)
    return [
        *rows,
        [
            Field(("dropper", "conductor"), "dropper: conductor", kind="choice", choices=names),
            Field(("dropper", "model"), "dropper: model", kind="choice", choices=models),
        ],
    ]


def span_fields(tree: Tree) -> list[list[Field]]:
    """Return length, sag, heights and droppers of every span, a row for each."""
    upper = any(value_at(tree, ("spans", i, "auxiliary")) is not None for i in range(span_count(tree)))
    return [_span(("spans", i), f"span {i + 1}", upper) for i in range(span_count(tree))]


def support_fields(tree: Tree) -> list[list[Field]]:
    """Return name, heights and stagger of every support, a row for each."""
    supports = tree.get("supports")
    count = len(cast("list[object]", supports)) if isinstance(supports, list) else 0
    compound = "auxiliary_messenger" in tree
    return [_support(("supports", i), f"support {i + 1}", compound) for i in range(count)]


def all_fields(tree: Tree) -> list[Field]:
    """Return the fields of all forms and tables."""
    rows = [*line_fields(tree), *wire_fields(tree), *span_fields(tree), *support_fields(tree)]
    return [field for row in rows for field in row]


def conductor_names(tree: Tree) -> tuple[str, ...]:
    """Return the names of the line's own conductors, then those of the library."""
    own = tree.get("conductors")
    names = map(str, cast("dict[object, object]", own)) if isinstance(own, dict) else ()
    return tuple(dict.fromkeys((*names, *library())))


def _span(path: Path, of: str, upper: bool) -> list[Field]:
    sag, per_mille = (*path, "pre_sag"), (*path, "pre_sag_per_mille")
    fields = [
        Field((*path, "length"), f"length, {of}", "m"),
        Field(sag, f"pre-sag, {of}", "mm", instead=per_mille),
        Field(per_mille, f"pre-sag, {of}", "‰", kind="number", instead=sag),
        Field((*path, "contact_wire_height"), f"wanted height, {of}", "m", kind="list"),
        Field((*path, "droppers"), f"droppers at, {of}", "m", kind="positions"),
    ]
    if upper:
        fields.append(Field((*path, "auxiliary", "droppers"), f"upper droppers, {of}", "m", kind="positions"))
    return fields


def _support(path: tuple[str, int], of: str, compound: bool) -> list[Field]:
    messenger = (*path, "messenger_wire")
    height, encumbrance = (*messenger, "height"), (*messenger, "encumbrance")
    fields = [
        Field((*path, "name"), f"name, {of}", kind="text", hint=f"S{path[-1] + 1}", alike=False),
        Field((*path, "contact_wire", "height"), f"contact wire, {of}", "m"),
        Field((*path, "stagger"), f"stagger, {of}", "mm", hint="0", alike=False),
        Field(height, f"messenger, {of}", "m", instead=encumbrance),
        Field(encumbrance, f"encumbrance, {of}", "m", instead=height),
        Field((*path, "messenger_stagger"), f"messenger stagger, {of}", "mm", alike=False),
    ]
    if compound:
        fields.append(Field((*path, "auxiliary_messenger", "height"), f"auxiliary, {of}", "m"))
    return fields


def _said(wire: str) -> str:
    return {"mid_point": "mid-point anchor"}.get(wire, wire.replace("_", " "))
