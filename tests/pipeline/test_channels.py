"""Each channel keeps its policy, also with threads on both ends."""

from __future__ import annotations

import threading
from collections.abc import Callable

import pytest

from carpus.core.pipeline.channels import ChannelClosed, ChannelFull, NeverDrop, Newest, Waits


def in_thread(work: Callable[[], None]) -> threading.Thread:
    thread = threading.Thread(target=work)
    thread.start()
    return thread


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
        assert len(channel) <= 16
    channel.close()
    taker.join()
    assert taken == list(range(2000))


def test_never_drop_refuses_at_its_bound_and_loses_nothing() -> None:
    channel: NeverDrop[int] = NeverDrop(2)
    channel.put(1)
    channel.put(2)
    with pytest.raises(ChannelFull):
        channel.put(3)
    channel.close()
    assert list(channel) == [1, 2]


@pytest.mark.parametrize("kind", [NeverDrop, Waits])
def test_closing_lets_the_rest_out_and_wakes_a_waiting_taker(kind: type[NeverDrop[int]] | type[Waits[int]]) -> None:
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
