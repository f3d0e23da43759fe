"""Many recordings side by side."""

from __future__ import annotations

import multiprocessing
import sys
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor
from typing import TypeVar

from tqdm import tqdm

_Job = TypeVar("_Job")
_Done = TypeVar("_Done")


def side_by_side(work: Callable[[_Job], _Done], jobs: Sequence[_Job], processes: int) -> list[_Done]:
    """What becomes of all jobs, in their order; progress goes to stderr."""
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(processes, mp_context=context) as pool:
        return list(tqdm(pool.map(work, jobs), total=len(jobs), file=sys.stderr))
