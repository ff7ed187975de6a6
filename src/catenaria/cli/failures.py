"""From errors to messages on stderr and exit codes."""

from __future__ import annotations

from collections.abc import Generator
from contextlib import contextmanager

import typer

from catenaria.errors import (
    CatenariaError,
    InconsistentInputError,
    InfeasibleError,
    LineFileError,
    UnsupportedError,
)

NOT_CONVERGED = 1
BAD_INPUT = 2
INTERRUPTED = 130  # as shells report a program that Ctrl-C ended


@contextmanager
def failures_reported() -> Generator[None, None, None]:
    """End the command with a message and an exit code when the block fails in a known way.

    Raises
    ------
    typer.Exit
        With `BAD_INPUT` if the user must change the input, with `NOT_CONVERGED` for every other failure by
        name. Errors that catenaria did not foresee pass through with their traceback.
    """
    try:
        yield
    except LineFileError as error:
        for fault in error.faults:
            complain(str(fault))
        raise typer.Exit(BAD_INPUT) from error
    except (InconsistentInputError, InfeasibleError, UnsupportedError) as error:
        complain(str(error))
        raise typer.Exit(BAD_INPUT) from error
    except CatenariaError as error:
        complain(str(error))
        raise typer.Exit(NOT_CONVERGED) from error
    except MemoryError as error:
        complain("There is not enough memory for this. Try: fewer elements, see solver.mesh")
        raise typer.Exit(NOT_CONVERGED) from error


def complain(message: str) -> None:
    """Write one message to stderr, unwrapped, so that editors recognise file, line and column."""
    typer.echo(message, err=True)
