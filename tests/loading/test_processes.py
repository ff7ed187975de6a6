"""Processes that compute samples: they end with the one that asked, and leave Ctrl-C to it."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import psutil
import pytest

pytestmark = pytest.mark.slow

# A shell that begins the tests in its background lets them ignore the signal of Ctrl-C.
SCRIPT = """
import signal
import time
from catenaria.loading.processes import deaf_start, process_pool
if __name__ == "__main__":
    signal.signal(signal.SIGINT, signal.default_int_handler)
    pool = process_pool(2)
    try:
        with deaf_start():
            futures = [pool.submit(time.sleep, 0.5) for _ in range(400)]
        futures[1].result()
        print("working", flush=True)
        futures[-1].result()
    except KeyboardInterrupt:
        print("interrupted", flush=True)
    finally:
        pool.shutdown(cancel_futures=True)
"""


@pytest.fixture
def working(tmp_path: Path) -> tuple[subprocess.Popen[str], list[psutil.Process]]:
    """Return a process, a group of its own, whose two workers are at work, and these."""
    script = tmp_path / "work.py"
    script.write_text(SCRIPT)
    begun = subprocess.Popen(
        [sys.executable, str(script)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    assert begun.stdout is not None
    assert begun.stdout.readline() == "working\n"
    children = psutil.Process(begun.pid).children()
    return begun, [child for child in children if "spawn_main" in " ".join(child.cmdline())]


Working = tuple[subprocess.Popen[str], list[psutil.Process]]


def test_workers_end_with_a_parent_that_is_killed(working: Working) -> None:
    begun, workers = working
    assert len(workers) == 2
    begun.kill()
    begun.communicate()
    assert psutil.wait_procs(workers, timeout=20.0)[1] == []


def test_ctrl_c_ends_all_at_once_and_workers_say_nothing(working: Working) -> None:
    begun, workers = working
    began = time.perf_counter()
    os.killpg(begun.pid, signal.SIGINT)
    out, err = begun.communicate(timeout=60.0)
    assert (out, err, begun.returncode) == ("interrupted\n", "", 0)
    assert time.perf_counter() - began < 30.0  # of 100 s for all that was submitted
    assert psutil.wait_procs(workers, timeout=20.0)[1] == []
