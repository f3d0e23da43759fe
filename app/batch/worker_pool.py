"""Worker processes for batch tracking, local or on a Dask cluster.

A recording that crashes, hangs or fills the memory ends its own process only. Cluster workers are machines that see
the same folders and have Carpus installed.
"""

from __future__ import annotations

import asyncio
import contextlib
import hashlib
import os
import pickle
import signal
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from multiprocessing.connection import Connection
from typing import Any, NoReturn

from carpus.app.batch.tracking_task import TrackingOutcome, TrackingTask, execute_task, fault_outcome
from carpus.app.command_line import print_message
from carpus.core.model.errors import ExtraMissing, SchedulerUnreachable
from carpus.core.platform.child_process import ChildProcess, end_with_owner
from carpus.core.platform.durable import remove_leftovers

Work = Callable[[TrackingTask], TrackingOutcome]
MAX_TRIES = 3
"""Tries of a task whose fault is retryable: a file in use, a slow network share, a dead process."""
TIME_LIMIT_S = 120.0 * 60.0
DIED_TEXT = "the process that tracked it ended without a word (memory, or someone ended it); track it again"
LATE_TEXT = (
    "it was not done after {minutes:g} minutes and was given up; look at the recording, or set a longer --time-limit"
)
_MAX_TASKS = 25
"""Tasks after which a process is replaced, so that leaks of libraries do not add up."""
_GRACE_S = 15.0


def count_cores() -> int:
    """Return the number of cores that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def run_tasks(
    tasks: Sequence[TrackingTask], process_count: int, run: Work = execute_task, limit_s: float = TIME_LIMIT_S
) -> Iterator[TrackingOutcome]:
    """Yield outcomes as they come, from ``process_count`` processes; retryable faults are retried."""
    children, pool = WorkerPool(), ThreadPoolExecutor(process_count, "batch")

    def run_with_retries(task: TrackingTask) -> TrackingOutcome:
        outcome = children.run_task(task, limit_s, run)
        for _ in range(MAX_TRIES - 1):
            if not outcome.is_retryable or children.is_closed:
                break
            outcome = children.run_task(task, limit_s, run)
        return outcome

    try:
        for future in as_completed([pool.submit(run_with_retries, task) for task in tasks]):
            yield future.result()
    finally:
        pool.shutdown(wait=False, cancel_futures=True)
        children.close()
        pool.shutdown(wait=True)


class WorkerPool:
    """Processes that each run one task after the other; may be used by several threads."""

    def __init__(self) -> None:
        self._idle: list[_Worker] = []
        self._busy: set[_Worker] = set()
        self.is_closed = False

    def run_task(self, task: TrackingTask, limit_s: float, run: Work = execute_task) -> TrackingOutcome:
        """Run one task in an idle or new process; a dead or late process is a fault."""
        try:
            child = self._idle.pop()
        except IndexError:
            child = _Worker()
        self._busy.add(child)
        if self.is_closed:
            child.terminate()
        outcome = child.run_task(task, run, limit_s)
        self._busy.discard(child)
        if outcome is not None and child.task_count < _MAX_TASKS and not self.is_closed:
            self._idle.append(child)
            return outcome
        child.end()
        if outcome is not None:
            return outcome
        remove_leftovers(task.tracking_input.session, min_age_s=0.0)
        if child.timed_out:
            return fault_outcome(task.tracking_input, LATE_TEXT.format(minutes=limit_s / 60.0))
        return fault_outcome(task.tracking_input, DIED_TEXT, is_retryable=True)

    def close(self) -> None:
        """End all processes."""
        self.is_closed = True
        all_of_them = [*self._idle, *self._busy]
        for child in all_of_them:
            child.terminate()
        for child in all_of_them:
            child.kill(_GRACE_S)


class _Worker(ChildProcess):
    """One worker process and the number of its tasks."""

    def __init__(self) -> None:
        super().__init__(serve, name="batch")
        self.task_count = 0
        self.timed_out = False

    def run_task(self, task: TrackingTask, run: Work, limit_s: float) -> TrackingOutcome | None:
        """Return the outcome of a task, None if the process ended or was late."""
        self.task_count += 1
        with contextlib.suppress(EOFError, OSError):
            self.link.send((run, task))
            self.timed_out = not self.link.poll(limit_s)
            if not self.timed_out:
                outcome: TrackingOutcome = self.link.recv()
                return outcome
        return None


def serve(link: Connection) -> NoReturn:
    """Run tasks in the child process until the owner closes the link or asks it to end."""
    os.umask(0o077)  # whatever is written is about a patient: for its owner only
    os.dup2(2, 1)  # what a library prints is none of the command's output
    signal.signal(signal.SIGTERM, _raise_interrupt)
    end_with_owner()
    with contextlib.suppress(KeyboardInterrupt, EOFError, OSError):
        while True:
            do, task = link.recv()
            link.send(do(task))
    os._exit(0)


def _raise_interrupt(*_: object) -> NoReturn:
    raise KeyboardInterrupt


CONNECT_TIMEOUT_S = 15.0
"""Time that a scheduler has to answer."""
_WORKERS = WorkerPool()
"""The processes of this Dask worker; they end with it."""


class RetryableError(Exception):
    """A fault that Dask retries."""


def run_on_worker(task: TrackingTask, limit_s: float) -> TrackingOutcome:
    """Run one task in a process beside a Dask worker."""
    outcome = _WORKERS.run_task(task, limit_s)
    if outcome.is_retryable:
        raise RetryableError(" ".join(outcome.messages))
    return outcome


def run_tasks_on_scheduler(
    address: str, tasks: Sequence[TrackingTask], limit_s: float = TIME_LIMIT_S
) -> Iterator[TrackingOutcome]:
    """Yield outcomes as they come from the workers of a Dask scheduler.

    A task whose worker died is done by another one. Tasks that an earlier run left on the scheduler are not started
    twice.

    Raises
    ------
    ExtraMissing
        The Python package distributed is not installed.
    SchedulerUnreachable
        The scheduler does not answer; nothing has been tracked.
    """
    try:
        from distributed import Client, Security, as_completed
        from distributed.comm.core import connect
    except ImportError as cause:
        raise ExtraMissing("distributed") from cause

    async def knock() -> None:
        await (await connect(address, timeout=CONNECT_TIMEOUT_S, **Security().get_connection_args("client"))).close()

    try:
        asyncio.run(knock())  # a client that finds no scheduler would leave a thread behind
    except (OSError, ValueError, TypeError, RuntimeError) as cause:  # also an address that is none
        raise SchedulerUnreachable(address, str(cause).partition("\n")[0] or type(cause).__name__) from cause
    with Client(address, set_as_default=False) as client:
        if not client.nthreads():
            print_message("the scheduler has no workers yet; they are waited for.")
        futures = {
            client.submit(run_on_worker, task, limit_s, key=_key(task), retries=MAX_TRIES - 1): task for task in tasks
        }
        try:
            for future in as_completed(list(futures), loop=client.loop):
                task = futures.pop(future)
                yield (
                    future.result()
                    if future.status == "finished"
                    else fault_outcome(task.tracking_input, _describe_failure(future))
                )
                future.release()
        finally:
            client.cancel(list(futures))


def _key(task: TrackingTask) -> str:
    return f"carpus-{hashlib.sha256(pickle.dumps(task)).hexdigest()}"


def _describe_failure(future: Any) -> str:
    from distributed import KilledWorker

    cause = None if future.status in ("cancelled", "lost") else future.exception()
    if isinstance(cause, RetryableError):
        return str(cause)
    if isinstance(cause, KilledWorker):
        return DIED_TEXT
    if cause is None:
        return "the scheduler ended or gave it up; track it again"
    return f"something unforeseen happened on a worker ({type(cause).__name__}: {cause})"
