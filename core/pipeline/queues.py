"""Channels between threads. Each has a bound and one policy for when it is reached; only one blocks who puts.

===================  ===========================  ================================================
channel              where                        policy at the bound
===================  ===========================  ================================================
:class:`BoundedQueue`   capture -> tracking          :class:`QueueFullError`: the new picture is left out and counted
                     tracking or capture -> disk  the same: the recording ends with a fault
                     screen -> tracking           the same, of what a person says: it is not taken in
:class:`BlockingQueue`       file -> tracking -> disk     who puts waits: a file has time, and nothing of it is lost
:class:`Mailbox`      anything -> screen           only the newest value is kept; who looks takes nothing away
===================  ===========================  ================================================
"""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Iterator
from typing import Generic, TypeVar

T = TypeVar("T")


class QueueFullError(Exception):
    """A channel that never drops has no room; internal, turned into a fault of the recording."""


class QueueClosedError(Exception):
    """Something was put into a channel after its end."""


class _BaseQueue(Generic[T]):
    """Room for ``capacity`` items, one or more threads putting, one taking."""

    def __init__(self, capacity: int) -> None:
        if capacity < 1:
            raise ValueError("a channel needs room for one item")
        self.capacity = capacity
        self._items: deque[T] = deque()
        self._condition = threading.Condition()
        self._closed = False

    def __len__(self) -> int:
        with self._condition:
            return len(self._items)

    def drain(self) -> list[T]:
        """Everything that waits now, oldest first, for who does not wait for more."""
        with self._condition:
            out = list(self._items)
            self._items.clear()
            self._condition.notify_all()
        return out

    def __iter__(self) -> Iterator[T]:
        """Items in order until the channel is closed and empty; waits for each."""
        while True:
            with self._condition:
                if not self._wait_for_item():
                    return
                item = self._items.popleft()
                self._condition.notify_all()
            yield item

    def close(self) -> None:
        """No more items come; those that wait can still be taken. May be called twice."""
        with self._condition:
            self._closed = True
            self._condition.notify_all()

    def _append(self, item: T) -> None:
        self._items.append(item)
        self._condition.notify_all()

    def _wait_for_item(self) -> bool:
        """Blocks until there is an item (True) or the channel is closed and empty (False)."""
        while not self._items:
            if self._closed:
                return False
            self._condition.wait()
        return True


class BoundedQueue(_BaseQueue[T]):
    """Every item that was taken in comes out; without room :class:`QueueFullError` is raised and nothing is lost."""

    def push(self, item: T) -> None:
        """Adds an item at once or raises."""
        with self._condition:
            if self._closed:
                raise QueueClosedError
            if len(self._items) == self.capacity:
                raise QueueFullError
            self._append(item)


class BlockingQueue(_BaseQueue[T]):
    """Nothing is lost: whoever puts waits for room. For sources that can wait, as files can."""

    def push(self, item: T) -> None:
        """Adds an item when there is room; raises :class:`QueueClosedError` after the end, also while waiting for
        it."""
        with self._condition:
            while len(self._items) >= self.capacity and not self._closed:
                self._condition.wait()
            if self._closed:
                raise QueueClosedError
            self._append(item)


class Mailbox(Generic[T]):
    """A mailbox for one value: putting replaces it, looking leaves it there.

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
