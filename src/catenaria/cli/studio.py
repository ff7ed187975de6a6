"""`catenaria studio`: edit a line in the browser and see its form at once."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path
from typing import Annotated

import typer

from catenaria.cli.failures import complain, failures_reported


def studio(
    line: Annotated[
        Path | None,
        typer.Argument(metavar="[LINE]", help="Line file to begin with.", show_default="the paper's line"),
    ] = None,
    host: Annotated[str, typer.Option(help="Name or address to listen on.")] = "127.0.0.1",
    port: Annotated[int, typer.Option(help="Port to listen on; 0 for one that is free.")] = 0,
    no_browser: Annotated[bool, typer.Option("--no-browser", help="Do not open a browser.")] = False,
    expose: Annotated[
        bool, typer.Option("--expose", help="Allow a --host that others can reach. There are no passwords.")
    ] = False,
) -> None:
    """Edit a line in the browser and see its form at once.

    Wires, tensions, spans, supports in tables with units; profile, plan, tensions, dropper schedule and
    checks follow every edit. LINE itself is never written: download what you want to keep.

    Example:

      catenaria studio
      catenaria studio my_line.yaml --port 8080 --no-browser

    Only this computer reaches the studio, unless --host names an address that others reach, which needs
    --expose. Whoever opens it has a session of their own and sees nothing of others.

    Exit codes: 0 ended with Ctrl-C, 2 LINE cannot be read, a bad host or port, or NiceGUI is missing.
    """
    with failures_reported():
        from catenaria.studio.app import address, is_loopback, require_studio_libraries, serve
        from catenaria.studio.documents import example, open_document

        require_studio_libraries()
        where = address(host, port, expose)
        document = example("yang2017_three_span") if line is None else open_document(line)
        typer.echo(f"Studio: {where.url} (Ctrl-C ends it)")
        if not is_loopback(host):
            complain(
                f"Everybody who reaches {where.url} over the network can use this studio: it has no "
                "passwords and does not encrypt. They can make this computer compute; they see neither its "
                "files nor each other's lines."
            )
        with suppress(KeyboardInterrupt):
            serve(document, where, not no_browser)
