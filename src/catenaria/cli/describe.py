"""`catenaria check` and `catenaria schema`: what a line file describes, and what it may describe."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.table import Table

from catenaria.cli.failures import failures_reported


def check(line: Annotated[Path, typer.Argument(metavar="LINE", help="Line file, YAML or JSON.")]) -> None:
    """Check a line file and say in a short table what it describes.

    Example:

      catenaria check examples/yang2017_three_span.yaml

    Each fault is one line on stderr: file, line and column, field, what was found and what is allowed.

    Exit codes: 0 no faults, 2 bad input, or something in it that is not solved yet.
    """
    from catenaria.line import load_line, refuse_unsupported, summarise

    with failures_reported():
        described = load_line(line)
        refuse_unsupported(described)
    console = Console(markup=False, highlight=False, emoji=False)
    sections = summarise(described)
    widest = max(len(label) for _, rows in sections for label, _ in rows)
    for title, rows in sections:
        table = Table.grid(padding=(0, 2), pad_edge=True)
        table.add_column(min_width=widest, no_wrap=True)
        table.add_column(overflow="fold")
        for label, value in rows:
            table.add_row(label, value)
        console.print(title, style="bold")
        console.print(table)
    console.print(f"{line}: no faults found.", soft_wrap=True)


def schema(
    result: Annotated[
        bool, typer.Option("--result", help="Of the tables that `catenaria export --format json` writes.")
    ] = False,
) -> None:
    """Print the JSON Schema of line files, which explains every field.

    Example:

    \b
      catenaria schema > line.schema.json
      catenaria schema --result > tables.schema.json

    Editors that are given the schema complete and check line files while they are written.
    """  # noqa: D301 (\b keeps the rows of the example apart)
    if result:
        from catenaria import workflow

        printed = workflow.tables_schema()
    else:
        from catenaria import line

        printed = line.schema()
    typer.echo(json.dumps(printed, indent=2, ensure_ascii=False))
