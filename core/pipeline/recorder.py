"""One recording with a thread of its own: all that is put comes to the disk, or the recording ends with a fault."""

from __future__ import annotations

import contextlib
import threading
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Generic, Protocol, TypeVar

from carpus.core.errors import CarpusFault, DiskStalled, DiskTooSlow
from carpus.core.phrase import phrase
from carpus.core.pipeline.channels import ChannelClosed, ChannelFull, NeverDrop

Item = TypeVar("Item")
LOOK_EVERY_S = 0.2


class Sink(Protocol):
    """What the recording thread owns while it runs: a file in the making."""

    @property
    def path(self) -> Path:
        """Where the finished file will be."""
        ...

    def close(self) -> None:
        """Finish the file."""
        ...

    def abandon(self) -> None:
        """Stop after a fault; what is on the disk stays."""
        ...

    def discard(self) -> None:
        """Remove the file again: nothing was recorded."""
        ...


SinkT = TypeVar("SinkT", bound=Sink)


@dataclass(frozen=True, slots=True)
class Patience(Generic[SinkT, Item]):
    """How long a disk may hang in one write. ``told`` hears of :class:`DiskStalled` after ``told_after_s``; after
    ``moved_after_s`` another thread goes on with ``elsewhere(sink, item)``, made of the sink that hangs and the item
    that it is at. Finishing a file may take ``close_more_s`` longer, and ``close_item_s`` for each item in it: they are
    read back and their repetitions counted, half a minute of a slow processor for an hour, and that may be busy."""

    told: Callable[[CarpusFault], None]
    elsewhere: Callable[[SinkT, Item | None], SinkT]
    told_after_s: float = 3.0
    moved_after_s: float = 8.0
    close_more_s: float = 12.0
    close_item_s: float = 2e-3


class Recorder(Generic[SinkT, Item]):
    """Opens, fills and closes one sink, all in its own thread, so that a slow disk holds up nobody else.

    ``write(sink, item)`` stores one item; ``on_fault(exception)`` is called once, from whichever thread met it.
    When items come faster than they are stored until ``capacity`` of them wait, :class:`DiskTooSlow` ends the
    recording: what waits is still written and the file is closed in good order. With ``waits`` whoever puts waits for
    the disk instead. With ``patience`` a disk that neither answers nor fails is told, and at last left alone.
    """

    def __init__(
        self,
        name: str,
        open_sink: Callable[[], SinkT],
        write: Callable[[SinkT, Item], None],
        capacity: int,
        on_fault: Callable[[Exception], None],
        *,
        waits: bool = False,
        patience: Patience[SinkT, Item] | None = None,
    ) -> None:
        self._open_sink = open_sink
        self._write = write
        self._on_fault = on_fault
        self._channel: NeverDrop[Item] = NeverDrop(capacity)
        self._patience = patience
        self._sink: SinkT | None = None
        self._turn = 0
        """Which thread writes: one that hung in the disk and was replaced finds another number when it comes back."""
        self._busy_since: float | None = None
        self._closing = False
        self._current: Item | None = None
        self._told_stall = False
        self._room = threading.Semaphore(capacity) if waits else None
        self._opened = threading.Event()
        self._lock = threading.Lock()
        self._fault: Exception | None = None
        self._path: Path | None = None
        self._written = 0
        self._unwanted = False
        self._name = name
        self._thread = threading.Thread(target=self._run, args=(0,), name=name, daemon=True)

    @property
    def waiting(self) -> int:
        return len(self._channel)

    @property
    def written(self) -> int:
        return self._written

    @property
    def fault(self) -> Exception | None:
        """What ended the recording early."""
        return self._fault

    @property
    def path(self) -> Path | None:
        """Where the file is or will be, None until it is open."""
        return self._path

    def start(self) -> None:
        """Starts the thread and waits until the file is open; raises what kept it from opening."""
        self._thread.start()
        self._opened.wait()
        if self._path is None and self._fault is not None:
            self._thread.join()
            raise self._fault

    def put(self, item: Item) -> bool:
        """Hands over one item without waiting; False when the recording has ended."""
        self._look()
        if self._room is not None:
            while not self._room.acquire(timeout=LOOK_EVERY_S):
                self._look()
                if self._fault is not None:
                    return False
        try:
            self._channel.put(item)
        except ChannelClosed:
            return False
        except ChannelFull:
            self._channel.close()
            self._fail(
                DiskTooSlow(self._path or "", phrase("{capacity} rows waiting", capacity=self._channel.capacity))
            )
            return False
        return True

    def finish(self) -> Path:
        """Waits until everything handed over is stored and the file is closed; raises the fault that ended it early."""
        self._channel.close()
        while True:
            thread = self._thread
            thread.join(LOOK_EVERY_S)
            self._look()
            if not thread.is_alive() and thread is self._thread:
                break
        if self._fault is not None:
            raise self._fault
        assert self._path is not None
        return self._path

    def discard(self) -> None:
        """Ends a recording that never began and removes its file."""
        self._unwanted = True
        self._channel.close()
        self._thread.join()

    def _look(self) -> None:
        """Whether the disk answers: that it does not is told after some seconds; later it goes on elsewhere."""
        patience, since = self._patience, self._busy_since
        if patience is None or since is None:
            return
        waited_s, more_s = time.monotonic() - since, 0.0
        if self._closing:
            more_s = patience.close_more_s + patience.close_item_s * self._written
        if waited_s < patience.told_after_s + more_s:
            return
        with self._lock:
            if self._busy_since != since or self._sink is None:
                return
            sink = self._sink
            if not self._told_stall:
                self._told_stall = True
                patience.told(DiskStalled(sink.path.parent, f"{waited_s:.0f} s"))
            if waited_s < patience.moved_after_s + more_s:
                return
            self._turn += 1
            self._busy_since = None
            self._thread = threading.Thread(
                target=self._run, args=(self._turn, sink, self._current), name=self._name, daemon=True
            )
            self._thread.start()

    def _run(self, turn: int, stuck: SinkT | None = None, item: Item | None = None) -> None:
        sink: SinkT | None = None
        try:
            if stuck is None:
                sink = self._open_sink()
            else:
                assert self._patience is not None
                sink = self._patience.elsewhere(stuck, item)
            self._sink, self._path = sink, sink.path
            self._opened.set()
            if not self._fill(sink, turn):
                return
            if self._unwanted:
                sink.discard()
            else:
                with self._at_the_disk(None):
                    self._closing = True
                    sink.close()
                if self._turn != turn:
                    return
                self._path = sink.path  # it may have had to go on in another place
        except Exception as cause:  # the one catch at the top of this thread
            if self._turn != turn:  # it was replaced; what it wrote is finished at the next start
                with contextlib.suppress(Exception):
                    if sink is not None:
                        sink.abandon()
                return
            self._channel.close()
            if sink is None:
                self._fault = cause  # told to who waits in start()
            else:
                self._fail(cause)
                with contextlib.suppress(Exception):  # the first fault is the one to tell
                    sink.abandon()
        finally:
            self._opened.set()

    def _fill(self, sink: SinkT, turn: int) -> bool:
        """Everything that comes; False where another thread has taken over meanwhile."""
        for item in self._channel:
            with self._at_the_disk(item):
                self._write(sink, item)
            if self._turn != turn:
                with contextlib.suppress(Exception):
                    sink.abandon()
                return False
            self._written += 1
            if self._room is not None:
                self._room.release()
        return True

    @contextlib.contextmanager
    def _at_the_disk(self, item: Item | None) -> Iterator[None]:
        self._current, self._busy_since = item, time.monotonic()
        turn = self._turn
        try:
            yield
        finally:
            with self._lock:
                if self._turn == turn:
                    self._busy_since = None

    def _fail(self, cause: Exception) -> None:
        with self._lock:
            first = self._fault is None
            if first:
                self._fault = cause
        if first:
            self._on_fault(cause)
