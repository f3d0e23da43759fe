"""CPU and wall time of pieces of work, and how they are printed."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

import numpy as np


@dataclass(slots=True)
class Times:
    """CPU and wall milliseconds of one piece, one value for each time it was done."""

    cpu_ms: list[float] = field(default_factory=list)
    wall_ms: list[float] = field(default_factory=list)

    @contextmanager
    def measured(self) -> Iterator[None]:
        """Measure what is done inside, in this thread."""
        wall_s, cpu_s = time.perf_counter(), time.thread_time()
        try:
            yield
        finally:
            self.cpu_ms.append(1e3 * (time.thread_time() - cpu_s))
            self.wall_ms.append(1e3 * (time.perf_counter() - wall_s))


class Spy:
    """Measures calls of functions where they are used, until :meth:`leave`."""

    def __init__(self) -> None:
        self.times: dict[str, Times] = {}
        self._undo: list[tuple[Any, str, Any]] = []

    def watch(self, place: Any, name: str, *labels: str, choose: Callable[..., int] = lambda *_, **__: 0) -> None:
        """Measure every call of ``place.name``, under the label that ``choose`` picks from its arguments.

        A name that is not there is an error.
        """
        true: Callable[..., Any] = getattr(place, name)
        times = [self.times.setdefault(label, Times()) for label in labels]

        def timed(*arguments: Any, **named: Any) -> Any:
            with times[choose(*arguments, **named)].measured():
                return true(*arguments, **named)

        setattr(place, name, timed)
        self._undo.append((place, name, true))

    def calls(self, label: str) -> int:
        """How often a piece was done so far."""
        return len(self.times[label].cpu_ms)

    def cpu_since(self, label: str, count: int) -> float:
        """CPU milliseconds of a piece since its call of that number."""
        return sum(self.times[label].cpu_ms[count:])

    def leave(self) -> None:
        """Put the functions back."""
        for place, name, true in reversed(self._undo):
            setattr(place, name, true)
        self._undo.clear()


def line(name: str, cpu_ms: Sequence[float], reference_ms: float = float("nan"), note: str = "") -> str:
    """One row of the table: median and 95th percentile of CPU time, ratio to the reference."""
    if not len(cpu_ms):
        return f"| {name} | – | – | – | {note} |"
    median, p95 = np.percentile(cpu_ms, (50.0, 95.0))
    ratio = f"{median / reference_ms:.2f}" if reference_ms == reference_ms else "–"
    return f"| {name} | {median:.3f} | {p95:.3f} | {ratio} | {note} |"


HEAD = "| what | CPU ms, median | p95 | ratio | note |\n|---|---|---|---|---|"
