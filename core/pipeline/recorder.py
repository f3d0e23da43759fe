"""Recording in a thread of its own: every submitted item is stored, or the recording ends with a fault."""

from __future__ import annotations

import contextlib
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Generic, Protocol, TypeVar

from carpus.core.model.errors import DiskTooSlow
from carpus.core.model.phrase import phrase
from carpus.core.pipeline.queues import BoundedQueue, QueueClosedError, QueueFullError

Item = TypeVar("Item")
POLL_S = 0.2


class Sink(Protocol):
    """File being written by the recording thread."""

    @property
    def path(self) -> Path:
        """Path of the finished file."""
        ...

    def close(self) -> None:
        """Finish the file."""
        ...

    def abandon(self) -> None:
        """Stop after a fault; stored data are kept."""
        ...

    def discard(self) -> None:
        """Remove the file: nothing was recorded."""
        ...


SinkT = TypeVar("SinkT", bound=Sink)


class Recorder(Generic[SinkT, Item]):
    """Opens, fills and closes one sink in its own thread, so that a slow disk blocks nothing else.

    Parameters
    ----------
    write : callable
        Stores one item in the sink.
    capacity : int
        Items that may wait. If more come, :class:`DiskTooSlow` ends the recording: waiting items are still written and
        the file is closed.
    on_fault : callable
        Called once with the exception that ended the recording, from any thread.
    is_blocking : bool
        The producer waits for the disk instead.
    """

    def __init__(
        self,
        name: str,
        open_sink: Callable[[], SinkT],
        write: Callable[[SinkT, Item], None],
        capacity: int,
        on_fault: Callable[[Exception], None],
        *,
        is_blocking: bool = False,
    ) -> None:
        self._open_sink = open_sink
        self._write = write
        self._on_fault = on_fault
        self._queue: BoundedQueue[Item] = BoundedQueue(capacity)
        self._free_slots = threading.Semaphore(capacity) if is_blocking else None
        self._opened = threading.Event()
        self._lock = threading.Lock()
        self._fault: Exception | None = None
        self._path: Path | None = None
        self._write_count = 0
        self._is_discarded = False
        self._thread = threading.Thread(target=self._run, name=name, daemon=True)

    @property
    def queue_length(self) -> int:
        return len(self._queue)

    @property
    def write_count(self) -> int:
        return self._write_count

    @property
    def fault(self) -> Exception | None:
        """Exception that ended the recording early."""
        return self._fault

    @property
    def path(self) -> Path | None:
        """Path of the file, None until it is open."""
        return self._path

    def start(self) -> None:
        """Start the thread and wait until the file is open; raises its fault."""
        self._thread.start()
        self._opened.wait()
        if self._path is None and self._fault is not None:
            self._thread.join()
            raise self._fault

    def submit(self, item: Item) -> bool:
        """Queue one item without waiting; return False if the recording has ended."""
        if self._free_slots is not None:
            while not self._free_slots.acquire(timeout=POLL_S):
                if self._fault is not None:
                    return False
        try:
            self._queue.push(item)
        except QueueClosedError:
            return False
        except QueueFullError:
            self._queue.close()
            self._fail(
                DiskTooSlow(self._path or "", phrase("{capacity} rows not yet written", capacity=self._queue.capacity))
            )
            return False
        return True

    def finish(self) -> Path:
        """Wait until all items are stored and the file is closed; raises the fault that ended it early."""
        self._queue.close()
        self._thread.join()
        if self._fault is not None:
            raise self._fault
        assert self._path is not None
        return self._path

    def discard(self) -> None:
        """End a recording that never began and remove its file."""
        self._is_discarded = True
        self._queue.close()
        self._thread.join()

    def _run(self) -> None:
        sink: SinkT | None = None
        try:
            sink = self._open_sink()
            self._path = sink.path
            self._opened.set()
            for item in self._queue:
                self._write(sink, item)
                self._write_count += 1
                if self._free_slots is not None:
                    self._free_slots.release()
            if self._is_discarded:
                sink.discard()
            else:
                sink.close()
                self._path = sink.path
        except Exception as cause:  # the one catch at the top of this thread
            self._queue.close()
            if sink is None:
                self._fault = cause  # raised by start()
            else:
                self._fail(cause)
                with contextlib.suppress(Exception):  # the first fault is the one to tell
                    sink.abandon()
        finally:
            self._opened.set()

    def _fail(self, cause: Exception) -> None:
        with self._lock:
            first = self._fault is None
            if first:
                self._fault = cause
        if first:
            self._on_fault(cause)
