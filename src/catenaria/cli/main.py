"""The `catenaria` command."""

from __future__ import annotations

from typing import Annotated

import typer

from catenaria import __version__
from catenaria.cli.adjust import adjust
from catenaria.cli.batch import batch
from catenaria.cli.checks import checks
from catenaria.cli.compare import compare
from catenaria.cli.describe import check, schema
from catenaria.cli.elasticity import elasticity
from catenaria.cli.export import export
from catenaria.cli.load import load
from catenaria.cli.network import network
from catenaria.cli.new import new
from catenaria.cli.report import report
from catenaria.cli.rounding import rounding
from catenaria.cli.solve import solve
from catenaria.cli.studio import studio
from catenaria.cli.tolerance import tolerance
from catenaria.cli.validate import validate

app = typer.Typer(
    name="catenaria",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    add_completion=False,
    rich_markup_mode=None,
)
app.command()(solve)
app.command()(check)
app.command()(schema)
app.command()(new)
app.command()(validate)
app.command()(compare)
app.command()(batch)
app.command()(network)
app.command()(export)
app.command()(load)
app.command()(elasticity)
app.command()(rounding)
app.command()(tolerance)
app.command()(adjust)
app.command()(checks)
app.command()(report)
app.command()(studio)


def _show_version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"catenaria {__version__}")
        raise typer.Exit


@app.callback()
def describe(
    version: Annotated[
        bool,
        typer.Option("--version", callback=_show_version, is_eager=True, help="Show the version and exit."),
    ] = False,
) -> None:
    """Find the form of railway overhead contact lines.

    Given wires, tensions, supports, dropper positions and the wanted contact-wire heights, catenaria computes
    the equilibrium, the lengths to which droppers and wires are cut, and the forces in all of them.

    Example:

      catenaria solve examples/yang2017_three_span.yaml --method dynamic
    """


def main() -> None:
    """Run the command line; ends with `SystemExit`: 0, 1 (no result to trust) or 2 (bad input)."""
    app(prog_name="catenaria")
