"""`catenaria network`: line files of a synthetic network."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from catenaria.cli.failures import BAD_INPUT, complain, failures_reported


def network(
    out: Annotated[Path, typer.Option(metavar="DIR", help="Folder for the line files.")],
    count: Annotated[int, typer.Option(min=1, help="Number of tension lengths.")] = 1000,
    seed: Annotated[int, typer.Option(min=0, help="The same seed gives the same network.")] = 1,
) -> None:
    """Write line files of a synthetic network, to try and to time batches.

    Example:

      catenaria network --count 100 --seed 1 --out network

    Tension lengths of 1.2 to 1.5 km with spans of 45 to 65 m: simple ones with steady arms, stitched ones,
    and ones with a curve. They resemble no real line.

    Exit codes: 0 written, 2 DIR holds something else or cannot be written.
    """
    from catenaria.workflow import write_network

    try:
        with failures_reported():
            files = write_network(count, seed, out)
    except OSError as error:
        complain(f"{out} cannot be written: {error.strerror}")
        raise typer.Exit(BAD_INPUT) from error
    typer.echo(
        f"Written to {out}: {len(files)} line files.\nTry: catenaria batch {out} --out results/{out.name}"
    )
