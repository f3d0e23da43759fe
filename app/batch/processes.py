"""Tasks in processes of their own, here or beside the workers of a Dask scheduler (other machines that see the same
folders and have Carpus installed): one that dies, hangs or grows takes nothing along.

Not by :mod:`multiprocessing`: the workers of a cluster are often daemons, which it lets have no children, and those
that track have some.
"""

from __future__ import annotations

import asyncio
import contextlib
import hashlib
import os
import pickle
import queue
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from typing import Any, BinaryIO, NoReturn

from carpus.app.batch.work import Outcome, Task, clear_leftovers, fault_of, work
from carpus.app.command_line import say
from carpus.core.errors import CarpusFault, ExtraMissing, OutputBusy, SchedulerUnreachable
from carpus.core.installing import is_packed
from carpus.core.words import one_sentence

Work = Callable[[Task], Outcome]
TRIES = 3
"""Of what may pass: another run's file, a share that stutters, a process that died."""
LIMIT_S = 120.0 * 60.0
DIED = "the process that tracked it ended without a word (memory, or someone ended it); track it again"
LATE = "it was not done after {minutes:g} minutes and was given up; look at the recording, or set a longer --time-limit"
FROZEN_WORD = "--batch-process"
"""How the packaged program, which has no Python, is told to be one of these processes."""
_MOST_TASKS = 25
"""Of one process, so that what a library forgets to free does not add up."""
_GRACE_S = 15.0
_ONE_THREAD = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS")


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
            child.hang_up()
        outcome = child.asked(task, do, limit_s)
        self._busy.discard(child)
        if outcome is not None and child.tasks < _MOST_TASKS and not (self.ended or child.was_late):
            self._idle.append(child)
            return outcome
        child.end()
        if outcome is not None:
            return outcome
        try:
            with contextlib.suppress(OSError):
                clear_leftovers(task.place.session)
        except CarpusFault as fault:  # of this recording alone
            return fault_of(task.place, one_sentence(fault), may_pass=isinstance(fault, OutputBusy))
        if child.was_late:
            return fault_of(task.place, LATE.format(minutes=limit_s / 60.0))
        return fault_of(task.place, DIED, may_pass=True)

    def end(self) -> None:
        """All of them stop; what they are at is tidied."""
        self.ended = True
        all_of_them = [*self._idle, *self._busy]
        for child in all_of_them:
            child.hang_up()
        for child in all_of_them:
            child.end()


class _Child:
    """The owner's side of one process. It hears by the end of its input that its owner is gone."""

    def __init__(self) -> None:
        words = [sys.executable, FROZEN_WORD] if is_packed() else [sys.executable, "-m", __name__]
        self._process = subprocess.Popen(
            words,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            env=dict.fromkeys(_ONE_THREAD, "1") | dict(os.environ),
            process_group=None if sys.platform == "win32" else 0,
        )
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        self._to, self._from = self._process.stdin, self._process.stdout
        self.tasks = 0
        self.was_late = False

    def asked(self, task: Task, do: Work, limit_s: float) -> Outcome | None:
        """What came of a task; None where the process ended before it answered."""
        self.tasks += 1
        timer = threading.Timer(limit_s, self._give_up)
        timer.daemon = True
        timer.start()
        try:
            pickle.dump((do, task), self._to)
            self._to.flush()
            outcome: Outcome = pickle.load(self._from)
        except (EOFError, OSError, ValueError, pickle.UnpicklingError):
            return None
        else:
            return outcome
        finally:
            timer.cancel()
            timer.join()  # it may be giving up at this moment

    def _give_up(self) -> None:
        self.was_late = True
        self._kill()

    def _kill(self) -> None:
        """With what it began itself, which may be what hangs."""
        with contextlib.suppress(OSError):
            if sys.platform != "win32":
                os.killpg(self._process.pid, signal.SIGKILL)
        self._process.kill()

    def hang_up(self) -> None:
        with contextlib.suppress(OSError):
            self._to.close()

    def end(self) -> None:
        self.hang_up()
        try:
            self._process.wait(_GRACE_S)
        except subprocess.TimeoutExpired:
            self._kill()
            self._process.wait()
        self._from.close()


# --- in the process itself --------------------------------------------------------------------------------------
def serve() -> NoReturn:
    """Take tasks from the input and answer, until the owner hangs up."""
    os.umask(0o077)  # whatever is written is about a patient: for its owner only
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # what a library prints is no answer
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the owner hears it and decides
    signal.signal(signal.SIGTERM, _interrupt)
    waiting: queue.SimpleQueue[tuple[Work, Task] | None] = queue.SimpleQueue()
    threading.Thread(target=_listen, args=(sys.stdin.buffer, waiting), daemon=True).start()
    with contextlib.suppress(KeyboardInterrupt, BrokenPipeError):
        while (asked := waiting.get()) is not None:
            do, task = asked
            pickle.dump(do(task), answers)
            answers.flush()
    os._exit(0)


def _listen(questions: BinaryIO, waiting: queue.SimpleQueue) -> None:  # type: ignore[type-arg]
    with contextlib.suppress(EOFError, OSError, pickle.UnpicklingError):
        while True:
            waiting.put(pickle.load(questions))
    waiting.put(None)
    os.kill(os.getpid(), signal.SIGTERM)  # whatever is under way is tidied
    time.sleep(_GRACE_S / 2.0)
    os._exit(1)


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


if __name__ == "__main__":
    from carpus.app.batch.processes import serve as serve_by_name

    serve_by_name()  # not from __main__: what is pickled names its module
