"""What a worker process of this computer loads first: Ctrl-C is for the process that started it alone."""

from __future__ import annotations

import signal


def dask_setup(worker: object) -> None:
    """Ignore interrupts, which a terminal sends to all processes; Dask calls this when the worker starts."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
