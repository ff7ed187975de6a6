"""`catenaria new`: a commented line file to start from."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from catenaria.cli.failures import BAD_INPUT, complain, failures_reported


class Kind(StrEnum):
    """Kinds of lines; each is the name of an example that comes with the package."""

    SIMPLE_55M = "simple_55m"
    SIMPLE_60M = "simple_60m"
    STITCHED_RE250 = "stitched_re250"
    COMPOUND = "compound"
    CURVE_800M = "curve_800m"
    OVERLAP = "overlap"
    BRIDGE = "bridge"
    TWO_CONTACT_WIRES_3KV = "two_contact_wires_3kv"


def new(
    kind: Annotated[Kind, typer.Option("--type", help="What kind of line it describes.")],
    out: Annotated[
        Path | None, typer.Option(metavar="FILE", help="File to write.", show_default="the type with .yaml")
    ] = None,
    force: Annotated[bool, typer.Option("--force", help="Replace FILE if it exists.")] = False,
) -> None:
    """Write a commented line file to start from. It solves as it stands.

    Example:

      catenaria new --type simple_55m --out my_line.yaml

    \b
    simple_55m             AC line, 55 m spans, pre-sag, 22 and 16 kN
    simple_60m             AC line, 60 m spans, 20 and 16 kN, cantilevers
    stitched_re250         stitch wires at the supports, 65 m spans, 15 and 15 kN
    compound               auxiliary messenger between messenger and contact wire
    curve_800m             curve of 800 m radius with transitions, cant and stagger
    overlap                end spans with a lifted run without droppers, anchors aside
    bridge                 unequal spans on a gradient, low under a bridge
    two_contact_wires_3kv  DC line with two contact wires and mid-point anchors

    Exit codes: 0 written, 2 FILE exists or cannot be written.
    """  # noqa: D301 (\b keeps the rows of the table apart)
    from catenaria.validation import example_file

    path = Path(f"{kind}.yaml") if out is None else out
    with failures_reported():
        text = example_file(f"{kind}.yaml").read_text(encoding="utf-8")
    try:
        with path.open("w" if force else "x", encoding="utf-8") as file:
            file.write(text)
    except FileExistsError as error:
        complain(f"{path} exists and is left as it is. Try: another --out, or --force to replace it")
        raise typer.Exit(BAD_INPUT) from error
    except OSError as error:
        complain(f"{path} cannot be written: {error.strerror}. Try: another --out")
        raise typer.Exit(BAD_INPUT) from error
    typer.echo(f"Written: {path}\nTry: catenaria check {path}\n     catenaria solve {path}")
