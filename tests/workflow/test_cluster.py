"""Worker processes: alone with themselves, in a sliding window, and when they die."""

from __future__ import annotations

import socket
import sys
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import distributed
import psutil
import pytest

from catenaria.errors import InconsistentInputError, NotConvergedError, UnsupportedError
from catenaria.workflow import cluster
from catenaria.workflow.cluster import Cluster, Failed, local_cluster, remote_cluster

pytestmark = pytest.mark.slow

Job = tuple[str, int]


def worker_function() -> Callable[[Job], Any]:
    """Return what workers do; they cannot import this file, so that it goes to them by value."""

    def work(job: Job) -> Any:
        import os

        kind, number = job
        if kind == "die":
            os._exit(1)
        if kind == "environment":
            return {name: os.environ.get(name) for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS")}
        return 100 // number

    return work


@pytest.fixture(scope="module")
def workers() -> Iterator[Cluster[Job, Any]]:
    with local_cluster(worker_function(), 2) as cluster:
        yield cluster


def test_jobs_come_back_with_their_outcomes(workers: Cluster[Job, Any]) -> None:
    jobs = [("divide", number) for number in range(1, 30)]
    assert sorted(workers.each(jobs, 4)) == sorted((job, 100 // job[1]) for job in jobs)
    assert workers.slots() == 2


def test_an_unforeseen_error_is_an_outcome(workers: Cluster[Job, Any]) -> None:
    outcomes = dict(workers.each([("divide", 5), ("divide", 0), ("divide", 4)], 4))
    failed = outcomes.pop(("divide", 0))
    assert (failed.died, failed.why[:17]) == (False, "ZeroDivisionError")
    assert set(outcomes.values()) == {20, 25}


def test_only_a_window_of_jobs_exists_at_any_time(workers: Cluster[Job, Any]) -> None:
    drawn = 0

    def jobs() -> Iterator[Job]:
        nonlocal drawn
        for number in range(1, 101):
            drawn += 1
            yield "divide", number

    back = 0
    for _ in workers.each(jobs(), 3):
        back += 1
        assert drawn <= back + 2 * 3
    assert back == 100


def test_a_job_that_kills_its_worker_does_not_stop_the_others(workers: Cluster[Job, Any]) -> None:
    jobs = [*(("divide", number) for number in range(1, 9)), ("die", 0)]
    outcomes = dict(workers.each(jobs, 4))
    died = {job for job, outcome in outcomes.items() if isinstance(outcome, Failed)}
    assert ("die", 0) in died  # with others, perhaps, that waited for the same worker
    assert all(outcomes[job].died for job in died)
    again = dict(workers.each(sorted(died), 0))
    assert isinstance(again.pop(("die", 0)), Failed)
    assert all(outcome == 100 // number for (_, number), outcome in again.items())


def test_linear_algebra_in_workers_has_one_thread(workers: Cluster[Job, Any]) -> None:
    environment = dict(workers.each([("environment", 0)], 4))[("environment", 0)]
    assert isinstance(environment, dict)
    assert set(environment.values()) == {"1"}


def test_processes_listen_on_the_loopback_interface_only(workers: Cluster[Job, Any]) -> None:
    own = psutil.Process()
    listening = {
        connection.laddr.ip
        for process in (own, *own.children(recursive=True))
        for connection in process.net_connections()
        if connection.status == psutil.CONN_LISTEN
    }
    assert listening == {"127.0.0.1"}


def test_no_workers_are_refused() -> None:
    with (
        pytest.raises(InconsistentInputError, match="at least one"),
        local_cluster(worker_function(), 0),
    ):
        pass


@pytest.mark.parametrize(("scheme", "listens"), [("tcp://", False), ("tcp://", True), ("nonsense://", True)])
def test_a_scheduler_that_does_not_answer_is_refused_in_time(
    scheme: str, listens: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(cluster, "CONNECT", 1.0)
    begin = time.perf_counter()
    with socket.socket() as server:  # says nothing
        server.bind(("127.0.0.1", 0))
        if listens:
            server.listen()
        address = f"{scheme}127.0.0.1:{server.getsockname()[1]}"
        with (
            pytest.raises(InconsistentInputError, match=f"the scheduler {address} does not answer"),
            remote_cluster(worker_function(), address, tmp_path),
        ):
            pass
    assert time.perf_counter() - begin < 4.0


def test_another_service_at_the_address_is_refused(tmp_path: Path) -> None:
    with socket.socket() as server:
        server.bind(("127.0.0.1", 0))
        server.listen()
        server.settimeout(20.0)
        address = f"tcp://127.0.0.1:{server.getsockname()[1]}"

        def answer() -> None:
            connection, _ = server.accept()
            with connection:
                connection.sendall(b"HTTP/1.1 400 Bad Request\r\n\r\n")
                while connection.recv(4096):
                    pass

        with ThreadPoolExecutor(1) as aside:
            aside.submit(answer)
            with (
                pytest.raises(InconsistentInputError, match="what answers there speaks another protocol"),
                remote_cluster(worker_function(), address, tmp_path),
            ):
                pass


def test_without_dask_the_error_names_the_extra(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    with (
        pytest.raises(UnsupportedError, match=r"pip install 'catenaria\[batch\]'"),
        local_cluster(worker_function(), 1),
    ):
        pass


def test_workers_that_do_not_start_are_a_failure_by_name(monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(**options: object) -> None:
        raise RuntimeError("Nanny failed to start.") from OSError("no processes left")

    monkeypatch.setattr(distributed, "LocalCluster", fail)
    with (
        pytest.raises(NotConvergedError, match=r"did not start \(no processes left\)"),
        local_cluster(worker_function(), 1),
    ):
        pass
