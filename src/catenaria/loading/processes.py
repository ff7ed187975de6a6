"""Processes that compute samples: they leave Ctrl-C to the one that asked, and do not outlive it."""

from __future__ import annotations

import os
import signal
import threading
from collections.abc import Generator
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from multiprocessing import get_context, parent_process
from multiprocessing.connection import wait


def process_pool(workers: int) -> ProcessPoolExecutor:
    """Return a pool of processes, which are started as work is submitted, within `deaf_start`.

    Notes
    -----
    Processes that are spawned inherit no threads of this one, which forked ones would.
    """
    return ProcessPoolExecutor(workers, mp_context=get_context("spawn"), initializer=end_with_parent)


@contextmanager
def deaf_start() -> Generator[None, None, None]:
    """Let processes that are started in the block ignore Ctrl-C, which a terminal sends to all of them.

    Notes
    -----
    One that is interrupted as it takes work would keep the lock of the queue, for which the others would wait
    without end. What is ignored is inherited, from the first instruction on. Only the main thread may say so.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


def end_with_parent() -> None:
    """End this process when the one that started it has ended, however that was."""
    parent = parent_process()
    if parent is not None:
        threading.Thread(target=_end_after, args=(parent.sentinel,), daemon=True).start()


def _end_after(sentinel: int) -> None:
    wait([sentinel])
    os._exit(1)
