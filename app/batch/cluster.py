"""Tasks on the workers of a Dask scheduler: other machines that see the same folders and have Carpus installed."""

from __future__ import annotations

import asyncio
import hashlib
import pickle
import sys
from collections.abc import Iterator, Sequence
from typing import Any

from carpus.app.batch.processes import DIED, LIMIT_S, TRIES, Children
from carpus.app.batch.work import Outcome, Task, fault_of
from carpus.core.errors import ExtraMissing, SchedulerUnreachable

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
            print("carpus: the scheduler has no workers yet; they are waited for.", file=sys.stderr)
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
