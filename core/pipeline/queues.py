"""Bounded queues between threads, each with one policy when it is full.

====================  ===========================  ===============================================
queue                 where                        policy when full
====================  ===========================  ===============================================
BoundedQueue          capture -> tracking          QueueFullError: the frame is dropped and counted
                      tracking or capture -> disk  the same: the recording ends with a fault
                      screen -> tracking           the same: the operator's label is dropped
                      file -> tracking -> disk     is_blocking: the producer waits, nothing of a file is lost
Mailbox               anything -> screen           only the newest value is kept
====================  ===========================  ===============================================
"""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Iterator
from typing import Generic, TypeVar

T = TypeVar("T")


class QueueFullError(Exception):
    """Raised when a bounded queue has no room."""


class QueueClosedError(Exception):
    """Raised when an item is pushed into a closed queue."""


class BoundedQueue(Generic[T]):
    """Queue of ``capacity`` items for several producers and one consumer, that never drops an accepted item.

    When it is full, :class:`QueueFullError` is raised; with ``is_blocking`` the producer waits for room, for sources
    that can wait, such as files.
    """

    def __init__(self, capacity: int, *, is_blocking: bool = False) -> None:
        self.capacity, self.is_blocking = capacity, is_blocking
        self._items: deque[T] = deque()
        self._condition = threading.Condition()
        self._closed = False

    def __len__(self) -> int:
        with self._condition:
            return len(self._items)

    def drain(self) -> list[T]:
        """Remove and return all queued items, oldest first, without waiting."""
        with self._condition:
            items = list(self._items)
            self._items.clear()
            self._condition.notify_all()
        return items

    def __iter__(self) -> Iterator[T]:
        """Yield items in order, waiting for each, until the queue is closed and empty."""
        while True:
            with self._condition:
                while not self._items and not self._closed:
                    self._condition.wait()
                if not self._items:
                    return
                item = self._items.popleft()
                self._condition.notify_all()
            yield item

    def push(self, item: T) -> None:
        """Add an item; raises :class:`QueueClosedError` after the end."""
        with self._condition:
            while self.is_blocking and len(self._items) >= self.capacity and not self._closed:
                self._condition.wait()
            if self._closed:
                raise QueueClosedError
            if len(self._items) >= self.capacity:
                raise QueueFullError
            self._items.append(item)
            self._condition.notify_all()

    def close(self) -> None:
        """Accept no more items; queued ones can still be taken. May be called twice."""
        with self._condition:
            self._closed = True
            self._condition.notify_all()


class Mailbox(Generic[T]):
    """Holder of one value: posting replaces it, peeking leaves it.

    >>> box = Mailbox()
    >>> box.post(1); box.post(2)
    >>> box.peek()
    2
    """

    def __init__(self) -> None:
        self._value: T | None = None  # one reference, replaced whole: no lock needed

    def post(self, value: T) -> None:
        self._value = value

    def peek(self) -> T | None:
        return self._value

    def clear(self) -> None:
        self._value = None
