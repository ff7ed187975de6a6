"""Worker processes, on this computer or on a Dask cluster, and jobs for them in a sliding window."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Callable, Generator, Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, contextmanager
from itertools import islice
from pathlib import Path
from queue import Empty, Queue
from time import monotonic
from typing import Any, Generic, TypeVar

from catenaria import __version__
from catenaria.errors import InconsistentInputError, NotConvergedError, UnsupportedError
from catenaria.workflow import deaf

T = TypeVar("T")
R = TypeVar("R")

CONNECT = 5.0  # s within which a scheduler and a worker must answer
PATIENCE = 30.0  # s without any worker after which nothing more is expected
_STARTS = 3  # of worker processes on this computer
_TICK = 1.0  # s between two looks at the cluster while nothing comes back

_EMBEDDED: dict[str, object] = {
    "distributed.scheduler.allowed-failures": 0,  # a job that kills its worker shall not kill three more
    "distributed.admin.low-level-log-length": 1000,  # logs grow with every job
    "distributed.admin.log-length": 100,
    "distributed.worker.profile.enabled": False,
    # Workers keep the memory that they free: with Dask's default, a line takes half as much time again.
    "distributed.nanny.pre-spawn-environ": {
        "MALLOC_MMAP_THRESHOLD_": 64_000_000,
        "MALLOC_TRIM_THRESHOLD_": 256_000_000,
        "OMP_NUM_THREADS": 1,
        "MKL_NUM_THREADS": 1,
        "OPENBLAS_NUM_THREADS": 1,
    },
}


class Failed:
    """A job that has no outcome: `why` in words, `died` if its worker ended without one."""

    def __init__(self, error: BaseException, died: bool) -> None:
        self.died = died
        self.why = "its worker process died: out of memory, or killed" if died else f"{_name(error)}: {error}"


class Cluster(Generic[T, R]):
    """A connection to worker processes that call one function."""

    def __init__(self, client: Any, function: Callable[[T], R]) -> None:
        self._client = client
        self._function = function

    def each(self, jobs: Iterable[T], per_worker: int) -> Iterator[tuple[T, R | Failed]]:
        """Yield jobs with their outcomes as they come; only a window of them exists at any time.

        Parameters
        ----------
        jobs : iterable
            Arguments of the function.
        per_worker : int
            How many jobs are handed out for each thread of the workers; 0 for one at a time in all.

        Raises
        ------
        NotConvergedError
            If the scheduler is lost, or no worker is left.
        """
        left = iter(jobs)
        waiting: dict[Any, T] = {}
        back: Queue[Any] = Queue()
        while True:
            room = max(per_worker * self.slots(), 1) - len(waiting)
            for job in islice(left, max(room, 0)):
                future = self._client.submit(self._function, job, pure=False)
                waiting[future] = job
                future.add_done_callback(back.put)
            if not waiting:
                return
            future = self._next(back)
            yield waiting.pop(future), _outcome(future)
            future.release()

    def slots(self) -> int:
        """Return how many threads all workers have."""
        try:
            return sum(self._client.nthreads().values())
        except (OSError, ValueError) as error:  # the latter from a client that has closed itself
            raise _lost("the scheduler does not answer any more") from error

    def _next(self, back: Queue[Any]) -> Any:
        """Wait for a job to end, and look at the cluster meanwhile."""
        seen = monotonic()
        while True:
            try:
                return back.get(timeout=_TICK)
            except Empty:
                if self._client.status != "running":
                    raise _lost("the connection to the scheduler is lost") from None
                if self.slots():
                    seen = monotonic()
                elif monotonic() - seen > PATIENCE:
                    raise _lost("the cluster has no workers any more") from None


@contextmanager
def local_cluster(function: Callable[[T], R], workers: int | None) -> Generator[Cluster[T, R]]:
    """Start worker processes on this computer for as long as the block runs.

    Parameters
    ----------
    function : callable
        What they call.
    workers : int, optional
        How many; one for each processor if left out. Each has one thread, in BLAS too, and listens on the
        loopback interface only.
    """
    dask, distributed = _libraries()
    if workers is not None and workers < 1:
        raise InconsistentInputError(f"{workers} workers: at least one is needed")
    with ExitStack() as stack:
        stack.enter_context(dask.config.set(_EMBEDDED))
        cluster = _started(distributed, workers)
        stack.enter_context(cluster)
        client = stack.enter_context(distributed.Client(cluster, set_as_default=False))
        yield Cluster(client, function)


def _started(distributed: Any, workers: int | None) -> Any:
    """Return a running cluster of this computer; on a busy one, worker processes may need a second start."""
    left = _STARTS
    while True:
        left -= 1
        try:
            return distributed.LocalCluster(
                n_workers=workers,
                threads_per_worker=1,
                host="127.0.0.1",
                scheduler_kwargs={"dashboard": False, "dashboard_address": "127.0.0.1:0"},
                preload=[deaf.__name__],
                silence_logs=logging.CRITICAL,
            )
        except (OSError, RuntimeError) as error:
            if not left:
                reason = f"worker processes did not start ({error.__cause__ or error})"
                raise NotConvergedError(reason, "the same command again, or with fewer workers") from error


@contextmanager
def remote_cluster(function: Callable[[T], R], scheduler: str, shared: Path) -> Generator[Cluster[T, R]]:
    """Connect to a running Dask scheduler for as long as the block runs.

    Parameters
    ----------
    function : callable
        What its workers call.
    scheduler : str
        Its address, such as ``tcp://127.0.0.1:8786``.
    shared : Path
        A file that workers must see under the same path as this process.

    Raises
    ------
    InconsistentInputError
        If the scheduler does not answer within `CONNECT`, has no workers, or has workers with another
        catenaria or without a view of the file.
    """
    _, distributed = _libraries()
    with _quiet():
        try:
            with ThreadPoolExecutor(1) as aside:  # for the caller may have an event loop of its own
                aside.submit(asyncio.run, _greet(distributed, scheduler)).result()
            client = distributed.Client(scheduler, timeout=CONNECT, set_as_default=False)
        except (OSError, ValueError, TypeError, MemoryError) as error:
            reason = str(error) or "it is silent"
            if isinstance(error, MemoryError):  # the first bytes are read as the length of a message
                reason = "what answers there speaks another protocol"
            raise InconsistentInputError(
                f"the scheduler {scheduler} does not answer: {reason}. Nothing was solved. Try: "
                "tcp://HOST:PORT as `dask scheduler` prints it when it starts"
            ) from error
        with client:
            _require_fit(client, scheduler, shared)
            yield Cluster(client, function)


async def _greet(distributed: Any, scheduler: str) -> None:
    """Exchange greetings with a scheduler, for which the client would wait without end."""
    arguments = distributed.Security().get_connection_args("client")
    greeting = distributed.comm.connect(scheduler, timeout=CONNECT, **arguments)
    comm = await asyncio.wait_for(greeting, CONNECT + 1.0)
    await comm.close()


def look(shared: str) -> tuple[str, bool]:
    """Return the version of catenaria and whether a file is seen; runs on workers."""
    return __version__, Path(shared).is_file()


def _require_fit(client: Any, scheduler: str, shared: Path) -> None:
    """Refuse workers that could not do the work."""
    try:
        client.wait_for_workers(1, timeout=CONNECT)
    except TimeoutError as error:
        raise InconsistentInputError(
            f"the scheduler {scheduler} has no workers. Try: dask worker {scheduler} --nthreads 1"
        ) from error
    try:
        seen: dict[str, tuple[str, bool]] = client.run(look, str(shared))
    except ImportError as error:
        raise InconsistentInputError(f"workers of {scheduler} cannot import catenaria: {error}") from error
    for worker, (version, sees) in seen.items():
        if version != __version__:
            raise InconsistentInputError(f"worker {worker} has catenaria {version}, not {__version__}")
        if not sees:
            raise InconsistentInputError(
                f"worker {worker} does not see {shared.parent}. Lines and results must be on a file system "
                "that all workers reach under the same path"
            )


def _outcome(future: Any) -> Any:
    """Return the value of an ended job, or how it failed."""
    if future.status == "finished":
        return future.result()
    if future.status != "error":
        raise _lost("the scheduler has dropped jobs")
    error: BaseException = future.exception()
    return Failed(error, died=_name(error) == "KilledWorker")


def _name(error: BaseException) -> str:
    return type(error).__name__


def _lost(reason: str) -> NotConvergedError:
    advice = "the same command again, once the cluster runs: lines that are done are not solved again"
    return NotConvergedError(reason, advice)


def _libraries() -> tuple[Any, Any]:
    """Import Dask, which is optional and slow to import."""
    try:
        import dask
        import distributed
    except ImportError as error:
        raise UnsupportedError(
            f"batches need dask.distributed ({error}). Install it: pip install 'catenaria[batch]'"
        ) from error
    return dask, distributed


@contextmanager
def _quiet() -> Generator[None]:
    """Keep what the client logs off the console; what goes wrong is raised."""
    logger = logging.getLogger("distributed")
    levels = [(handler, handler.level) for handler in logger.handlers]
    for handler, _ in levels:
        handler.setLevel(logging.CRITICAL)
    try:
        yield
    finally:
        for handler, level in levels:
            handler.setLevel(level)
