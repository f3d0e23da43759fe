"""Each channel keeps its policy, also with threads on both ends."""

from __future__ import annotations

import threading
from collections.abc import Callable

import pytest

from carpus.core.pipeline.queues import BlockingQueue, BoundedQueue, Mailbox, QueueClosedError, QueueFullError


def in_thread(work: Callable[[], None]) -> threading.Thread:
    thread = threading.Thread(target=work)
    thread.start()
    return thread


def test_bounded_queue_keeps_order_across_threads() -> None:
    channel: BoundedQueue[int] = BoundedQueue(16)
    taken: list[int] = []
    taker = in_thread(lambda: taken.extend(channel))
    number = 0
    while number < 2000:
        try:
            channel.push(number)
        except QueueFullError:
            continue
        number += 1
        assert len(channel) <= 16
    channel.close()
    taker.join()
    assert taken == list(range(2000))


def test_bounded_queue_full_raises_and_loses_nothing() -> None:
    channel: BoundedQueue[int] = BoundedQueue(2)
    channel.push(1)
    channel.push(2)
    with pytest.raises(QueueFullError):
        channel.push(3)
    channel.close()
    assert list(channel) == [1, 2]


@pytest.mark.parametrize("kind", [BoundedQueue, BlockingQueue])
def test_bounded_queue_close_releases_items_and_consumer(
    kind: type[BoundedQueue[int]] | type[BlockingQueue[int]],
) -> None:
    channel = kind(3)
    ended = threading.Event()

    def take() -> None:
        for _ in channel:
            pass
        ended.set()

    taker = in_thread(take)
    channel.push(1)
    channel.close()
    channel.close()
    assert ended.wait(20.0)
    taker.join()
    with pytest.raises(QueueClosedError):
        channel.push(2)


def test_bounded_queue_zero_capacity_raises() -> None:
    with pytest.raises(ValueError, match="room"):
        BoundedQueue(0)


def test_mailbox_peek_returns_last_value() -> None:
    box: Mailbox[int] = Mailbox()
    assert box.peek() is None
    writer = in_thread(lambda: [box.post(number) for number in range(1000)] and None)
    seen = []
    while writer.is_alive():
        seen.append(box.peek() or 0)
    writer.join()
    assert seen == sorted(seen)
    assert box.peek() == 999
    assert box.peek() == 999
    box.clear()
    assert box.peek() is None
