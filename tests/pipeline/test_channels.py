"""Each channel keeps its policy, also with threads on both ends."""

from __future__ import annotations

import threading
from collections.abc import Callable

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from carpus.core.pipeline.channels import ChannelClosed, ChannelFull, DropOldest, NeverDrop, Newest


def in_thread(work: Callable[[], None]) -> threading.Thread:
    thread = threading.Thread(target=work)
    thread.start()
    return thread


@settings(max_examples=50, deadline=None)
@given(capacity=st.integers(1, 10), count=st.integers(0, 40))
def test_drop_oldest_keeps_the_newest_and_tells_the_loss_once(capacity: int, count: int) -> None:
    channel: DropOldest[int] = DropOldest(capacity)
    for number in range(count):
        channel.put(number)
    channel.close()
    taken = list(channel)
    kept = list(range(max(0, count - capacity), count))
    assert [item for item, _ in taken] == kept
    assert [lost for _, lost in taken] == [max(0, count - capacity), *[0] * len(kept)][: len(kept)]
    assert channel.lost == max(0, count - capacity)
    assert channel.deepest == min(count, capacity)


def test_every_item_is_taken_or_counted_as_lost_with_a_slow_taker() -> None:
    channel: DropOldest[int] = DropOldest(4)
    taken: list[tuple[int, int]] = []
    turn = threading.Semaphore(0)

    def take() -> None:
        for item, lost in channel:
            taken.append((item, lost))
            turn.acquire()

    taker = in_thread(take)
    for number in range(500):
        channel.put(number)
        if number % 7 == 0:
            turn.release()
    channel.close()
    for _ in range(500):
        turn.release()
    taker.join()
    expected = 0
    for item, lost in taken:
        assert item == expected + lost
        expected = item + 1
    assert expected == 500
    assert len(taken) + channel.lost == 500
    assert channel.lost > 0


def test_weight_counts_what_an_item_stands_for() -> None:
    channel: DropOldest[int] = DropOldest(1, weight=lambda number: number)
    for number in (5, 7, 1):
        channel.put(number)
    channel.close()
    assert list(channel) == [(1, 12)]


def test_cleared_items_are_not_losses() -> None:
    channel: DropOldest[int] = DropOldest(2)
    for number in range(5):
        channel.put(number)
    channel.clear()
    channel.put(9)
    channel.close()
    assert list(channel) == [(9, 0)]


def test_never_drop_gives_back_everything_in_order_across_threads() -> None:
    channel: NeverDrop[int] = NeverDrop(16)
    taken: list[int] = []
    taker = in_thread(lambda: taken.extend(channel))
    number = 0
    while number < 2000:
        try:
            channel.put(number)
        except ChannelFull:
            continue
        number += 1
    channel.close()
    taker.join()
    assert taken == list(range(2000))
    assert channel.deepest <= 16


def test_never_drop_refuses_at_its_bound_and_loses_nothing() -> None:
    channel: NeverDrop[int] = NeverDrop(2)
    channel.put(1)
    channel.put(2)
    with pytest.raises(ChannelFull):
        channel.put(3)
    channel.close()
    assert list(channel) == [1, 2]


@pytest.mark.parametrize("kind", [DropOldest, NeverDrop])
def test_closing_lets_the_rest_out_and_wakes_a_waiting_taker(
    kind: type[DropOldest[int]] | type[NeverDrop[int]],
) -> None:
    channel = kind(3)
    ended = threading.Event()

    def take() -> None:
        for _ in channel:
            pass
        ended.set()

    taker = in_thread(take)
    channel.put(1)
    channel.close()
    channel.close()
    assert ended.wait(20.0)
    taker.join()
    with pytest.raises(ChannelClosed):
        channel.put(2)


def test_a_channel_has_room() -> None:
    with pytest.raises(ValueError, match="room"):
        NeverDrop(0)


def test_newest_is_what_was_put_last() -> None:
    box: Newest[int] = Newest()
    assert box.look() is None
    writer = in_thread(lambda: [box.put(number) for number in range(1000)] and None)
    seen = []
    while writer.is_alive():
        seen.append(box.look() or 0)
    writer.join()
    assert seen == sorted(seen)
    assert box.look() == 999
    assert box.look() == 999
    box.clear()
    assert box.look() is None
