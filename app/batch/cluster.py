"""Tasks on the workers of a Dask scheduler: other machines that see the same folders and have Carpus installed."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator, Sequence

from carpus.app.batch.processes import DIED
from carpus.app.batch.work import Outcome, Task, fault_of, work
from carpus.core.errors import ExtraMissing, SchedulerUnreachable

PATIENCE_S = 15.0
"""A scheduler that is there answers within this time."""


def outcomes_on(address: str, tasks: Sequence[Task]) -> Iterator[Outcome]:
    """Outcomes as they come. What a worker that died was at is done by another; what ends one after the other is a
    fault. Raises :class:`ExtraMissing` and :class:`SchedulerUnreachable`, both before anything is tracked."""
    try:
        from distributed import Client, as_completed
        from distributed.comm.core import connect
    except ImportError as cause:
        raise ExtraMissing("cluster", "distributed") from cause

    async def knock() -> None:
        await (await connect(address, timeout=PATIENCE_S)).close()

    try:
        asyncio.run(knock())  # a client that finds no scheduler would leave a thread behind
    except (OSError, ValueError) as cause:  # also an address that is none
        raise SchedulerUnreachable(address, str(cause).partition("\n")[0] or type(cause).__name__) from cause
    with Client(address, set_as_default=False) as client:
        futures = {client.submit(work, task, pure=False): task for task in tasks}
        try:
            for future in as_completed(list(futures), loop=client.loop):
                failed = future.status != "finished"
                yield fault_of(futures[future].place, DIED) if failed else future.result()
                future.release()
        finally:
            client.cancel([future for future in futures if not future.done()])
