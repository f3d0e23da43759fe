"""Tasks on this machine's cores, each in a process that may die without taking the others with it."""

from __future__ import annotations

import multiprocessing
import os
import signal
import threading
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Future, ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from pathlib import Path
from typing import NoReturn

from carpus.app.batch.work import Outcome, Task, fault_of, work
from carpus.core.encryption import keys

Work = Callable[[Task], Outcome]
_DEATHS = 2
DIED = "the process that tracked it ended without a word (memory, or someone ended it); track it again"


def cores() -> int:
    """Processes that this one may use at a time."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def outcomes(tasks: Sequence[Task], count: int, do: Work = work) -> Iterator[Outcome]:
    """Outcomes as they come, of ``count`` processes at a time.

    When a process dies, all that it shared a pool with are done again, those that may have killed it alone: only what
    ends its process twice when it has it for itself is a fault.
    """
    waiting, alone, deaths = list(tasks), list[Task](), Counter[str]()
    while waiting or alone:
        together = waiting or [alone.pop()]
        begun: list[Task] = []
        left = list(together)
        for task, outcome in _pooled(together, min(count, len(together)), begun, do):
            left.remove(task)
            yield outcome
        if waiting:
            alone += [task for task in left if task in begun]
            waiting = [task for task in left if task not in begun]
            continue
        for task in left:
            deaths[task.place.name] += 1
            if deaths[task.place.name] < _DEATHS:
                alone.append(task)
            else:
                yield fault_of(task.place, DIED)


def _pooled(tasks: Sequence[Task], count: int, begun: list[Task], do: Work) -> Iterator[tuple[Task, Outcome]]:
    """Tasks done in one pool; of those that the death of one of its processes left, ``begun`` takes the ones that may
    have been running then."""
    pool = ProcessPoolExecutor(
        count, mp_context=multiprocessing.get_context("spawn"), initializer=_begin, initargs=(keys.known(),)
    )
    broken: list[Task] = []
    is_over = False
    try:
        futures: dict[Future[Outcome], Task] = {pool.submit(_busy_with, do, task): task for task in tasks}
        for future in as_completed(futures):
            try:
                outcome = future.result()
            except BrokenProcessPool:
                broken.append(futures[future])
            else:
                yield futures[future], outcome
        is_over = True
        # Which of them ran is not known; they are begun in the order in which they were given, some ahead of time.
        begun += [task for task in tasks if task in broken][: 2 * count + 1]
    finally:
        if not is_over:
            for process in tuple((pool._processes or {}).values()):
                process.terminate()
        pool.shutdown(wait=True, cancel_futures=True)


_busy = False


def _begin(known: dict[Path, bytes]) -> None:
    """In a new process: it stops when it is told to or its owner is gone, and tidies what it was at."""
    for folder, key in known.items():
        keys.remember(folder, key)
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the owner hears it and decides
    signal.signal(signal.SIGTERM, _stop)
    threading.Thread(target=_end_with_owner, daemon=True).start()


def _busy_with(do: Work, task: Task) -> Outcome:
    global _busy
    _busy = True
    try:
        return do(task)
    except KeyboardInterrupt:
        os._exit(0)  # what it was at is tidied; no other task is begun
    finally:
        _busy = False


def _stop(*_: object) -> NoReturn:
    if _busy:
        raise KeyboardInterrupt
    os._exit(0)


def _end_with_owner() -> None:
    owner = multiprocessing.parent_process()
    if owner is not None:
        owner.join()
        os._exit(1)
