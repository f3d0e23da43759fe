"""Tasks in processes of their own, here or beside the workers of a Dask scheduler (other machines that see the same
folders and have Carpus installed): one that dies, hangs or grows takes nothing along."""

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

from carpus.app.batch.work import Outcome, Task, fault_of, work
from carpus.app.command_line import say
from carpus.core.child_process import ChildProcess, end_with_owner
from carpus.core.errors import ExtraMissing, SchedulerUnreachable
from carpus.core.session.disk import remove_leftovers

Work = Callable[[Task], Outcome]
TRIES = 3
"""Of what may pass: another run's file, a share that stutters, a process that died."""
LIMIT_S = 120.0 * 60.0
DIED = "the process that tracked it ended without a word (memory, or someone ended it); track it again"
LATE = "it was not done after {minutes:g} minutes and was given up; look at the recording, or set a longer --time-limit"
_MOST_TASKS = 25
"""Of one process, so that what a library forgets to free does not add up."""
_GRACE_S = 15.0


def cores() -> int:
    """Processes that this one may use at a time."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def outcomes(tasks: Sequence[Task], count: int, do: Work = work, limit_s: float = LIMIT_S) -> Iterator[Outcome]:
    """Outcomes as they come, of ``count`` processes at a time. What may pass is tried :data:`TRIES` times."""
    children, pool = Children(), ThreadPoolExecutor(count, "batch")

    def tried(task: Task) -> Outcome:
        outcome = children.outcome(task, limit_s, do)
        for _ in range(TRIES - 1):
            if not outcome.may_pass or children.ended:
                break
            outcome = children.outcome(task, limit_s, do)
        return outcome

    try:
        for future in as_completed([pool.submit(tried, task) for task in tasks]):
            yield future.result()
    finally:
        pool.shutdown(wait=False, cancel_futures=True)
        children.end()
        pool.shutdown(wait=True)


class Children:
    """Processes that take one task after the other; for any number of threads."""

    def __init__(self) -> None:
        self._idle: list[_Child] = []
        self._busy: set[_Child] = set()
        self.ended = False

    def outcome(self, task: Task, limit_s: float, do: Work = work) -> Outcome:
        """One task done in an idle process, or in a new one; a process that died or took too long is a fault."""
        try:
            child = self._idle.pop()
        except IndexError:
            child = _Child()
        self._busy.add(child)
        if self.ended:
            child.terminate()
        outcome = child.ask(task, do, limit_s)
        self._busy.discard(child)
        if outcome is not None and child.tasks < _MOST_TASKS and not self.ended:
            self._idle.append(child)
            return outcome
        child.end()
        if outcome is not None:
            return outcome
        remove_leftovers(task.place.session, after_s=0.0)
        if child.was_late:
            return fault_of(task.place, LATE.format(minutes=limit_s / 60.0))
        return fault_of(task.place, DIED, may_pass=True)

    def end(self) -> None:
        """All of them stop."""
        self.ended = True
        all_of_them = [*self._idle, *self._busy]
        for child in all_of_them:
            child.terminate()
        for child in all_of_them:
            child.kill(_GRACE_S)


class _Child(ChildProcess):
    """One process, and how many tasks it was given."""

    def __init__(self) -> None:
        super().__init__(serve, name="batch")
        self.tasks = 0
        self.was_late = False

    def ask(self, task: Task, do: Work, limit_s: float) -> Outcome | None:
        """What came of a task; None where the process ended before it answered, or was late."""
        self.tasks += 1
        with contextlib.suppress(EOFError, OSError):
            self.link.send((do, task))
            self.was_late = not self.link.poll(limit_s)
            if not self.was_late:
                outcome: Outcome = self.link.recv()
                return outcome
        return None


def serve(link: Connection) -> NoReturn:
    """Take tasks and answer, in the child, until the owner hangs up or asks it to end; what is under way is tidied."""
    os.umask(0o077)  # whatever is written is about a patient: for its owner only
    os.dup2(2, 1)  # what a library prints is none of the command's output
    signal.signal(signal.SIGTERM, _interrupt)
    end_with_owner()
    with contextlib.suppress(KeyboardInterrupt, EOFError, OSError):
        while True:
            do, task = link.recv()
            link.send(do(task))
    os._exit(0)


def _interrupt(*_: object) -> NoReturn:
    raise KeyboardInterrupt


PATIENCE_S = 15.0
"""A scheduler that is there answers within this time."""
_CHILDREN = Children()
"""Of this worker; they end with it."""


class MayPass(Exception):
    """A fault that may be gone when tried again: what Dask retries."""


def on_worker(task: Task, limit_s: float) -> Outcome:
    """What a worker does with one task, in a process beside it."""
    outcome = _CHILDREN.outcome(task, limit_s)
    if outcome.may_pass:
        raise MayPass(" ".join(outcome.said))
    return outcome


def outcomes_on(address: str, tasks: Sequence[Task], limit_s: float = LIMIT_S) -> Iterator[Outcome]:
    """Outcomes as they come. What a worker that died was at is done by another; what ends one after the other, or may
    pass and does not, is a fault. A task that an earlier run left under way is not begun twice.

    Raises :class:`ExtraMissing` and :class:`SchedulerUnreachable`, both before anything is tracked.
    """
    try:
        from distributed import Client, Security, as_completed
        from distributed.comm.core import connect
    except ImportError as cause:
        raise ExtraMissing("distributed") from cause

    async def knock() -> None:
        await (await connect(address, timeout=PATIENCE_S, **Security().get_connection_args("client"))).close()

    try:
        asyncio.run(knock())  # a client that finds no scheduler would leave a thread behind
    except (OSError, ValueError, TypeError, RuntimeError) as cause:  # also an address that is none
        raise SchedulerUnreachable(address, str(cause).partition("\n")[0] or type(cause).__name__) from cause
    with Client(address, set_as_default=False) as client:
        if not client.nthreads():
            say("the scheduler has no workers yet; they are waited for.")
        futures = {client.submit(on_worker, task, limit_s, key=_key(task), retries=TRIES - 1): task for task in tasks}
        try:
            for future in as_completed(list(futures), loop=client.loop):
                task = futures.pop(future)
                yield future.result() if future.status == "finished" else fault_of(task.place, _why(future))
                future.release()
        finally:
            client.cancel(list(futures))


def _key(task: Task) -> str:
    return f"carpus-{hashlib.sha256(pickle.dumps(task)).hexdigest()}"


def _why(future: Any) -> str:
    from distributed import KilledWorker

    cause = None if future.status in ("cancelled", "lost") else future.exception()
    if isinstance(cause, MayPass):
        return str(cause)
    if isinstance(cause, KilledWorker):
        return DIED
    if cause is None:
        return "the scheduler ended or gave it up; track it again"
    return f"something unforeseen happened on a worker ({type(cause).__name__}: {cause})"
