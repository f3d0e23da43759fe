"""What a person says of spots: it waits, holds, follows, and ends."""

from __future__ import annotations

import numpy as np
import pytest

from carpus.core.tracking.operator_hints import ANSWER_HOLDS_S, HOLDS_S, Hinted, OperatorHints
from carpus.core.types import Detections, FloatArray, SpotAnswer

MARKERS = ("WRIST", "MCP3")
EXPECTED_PX = np.array([[100.0, 100.0], [200.0, 100.0]])


def spots(*place_px: tuple[float, float]) -> Detections:
    count = len(place_px)
    return Detections(np.reshape(np.array(place_px), (count, 2)), *(np.ones(count),) * 4)


def shown(hints: OperatorHints, index: int, time_s: float, seen: Detections, at: FloatArray = EXPECTED_PX) -> Hinted:
    return hints.screened(index, time_s, seen, lambda: at)


def test_a_spot_that_is_named_is_followed_to_the_picture_that_hears_it() -> None:
    hints = OperatorHints(MARKERS)
    shown(hints, 0, 0.0, spots((50.0, 50.0), (199.0, 100.0)))
    hints.hear(SpotAnswer(0, "MCP3", (200.0, 101.0)))
    heard = shown(hints, 1, 0.1, spots((203.0, 104.0), (50.0, 50.0)))
    assert heard.named is not None
    assert (heard.named.marker, heard.named.blob, heard.named.answer.index) == (1, 0, 1)
    assert heard.named.answer.place_px == (203.0, 104.0)
    assert hints.taken_up() == [], "by the tracker, if it follows the hand"
    hints.take_up(heard.named)
    assert [one.marker for one in hints.taken_up()] == ["MCP3"]
    assert shown(hints, 2, 0.2, spots((203.0, 104.0))).named is None


@pytest.mark.parametrize(("after_s", "is_heard"), [(0.9, True), (1.1, False)])
def test_an_answer_waits_for_its_spot_and_no_longer(after_s: float, is_heard: bool) -> None:
    hints = OperatorHints(MARKERS)
    shown(hints, 0, 0.0, spots((200.0, 100.0)))
    hints.hear(SpotAnswer(0, "MCP3", (200.0, 100.0)))
    hints.hear(SpotAnswer(0, "NOBODY", (200.0, 100.0)))
    later_s = after_s * ANSWER_HOLDS_S
    for index, at_s in ((1, 0.0), (2, later_s)):
        assert shown(hints, index, at_s, spots((20.0, 20.0))).named is None
    assert (shown(hints, 3, later_s, spots((200.0, 100.0))).named is not None) == is_heard


@pytest.mark.parametrize(("after_s", "is_out"), [(0.99, True), (1.01, False)])
def test_a_spot_that_is_no_disc_stays_left_out_for_its_time(after_s: float, is_out: bool) -> None:
    hints = OperatorHints(MARKERS)
    both = spots((200.0, 100.0), (230.0, 100.0))
    shown(hints, 0, 0.0, both)
    hints.hear(SpotAnswer(0, "MCP3", None, ((230.0, 100.0),)))
    first = shown(hints, 1, 0.0, both)
    assert first.no_disc.tolist() == [False, True]
    assert first.detections.pixel.tolist() == [[200.0, 100.0]]
    assert len(hints.taken_up()) == 1
    assert shown(hints, 2, after_s * HOLDS_S, both).no_disc.tolist() == [False, is_out]


def test_a_marker_that_was_held_keeps_the_spot_nearer_to_it() -> None:
    """What was no disc went out of sight beside its marker; what comes back nearer to a held one is that one's."""
    for is_held in (False, True):
        hints = OperatorHints(MARKERS)
        near = EXPECTED_PX[0] + [10.0, 0.0]
        seen = spots((float(near[0]), float(near[1])))
        shown(hints, 0, 0.0, seen)
        hints.hear(SpotAnswer(0, "MCP3", None, ((float(near[0]), float(near[1])),)))
        assert shown(hints, 1, 0.1, seen).no_disc.all()
        hints.hold(EXPECTED_PX if is_held else np.full((2, 2), np.nan))
        back = EXPECTED_PX[0] + [4.0, 0.0]
        found = shown(hints, 2, 0.2, spots((float(back[0]), float(back[1]))))
        assert found.no_disc.tolist() == [not is_held]


def test_of_a_lost_hand_a_spot_is_known_by_its_place_alone() -> None:
    hints, nowhere = OperatorHints(MARKERS), np.full((2, 2), np.nan)
    seen = spots((230.0, 100.0))
    shown(hints, 0, 0.0, seen, nowhere)
    hints.hear(SpotAnswer(0, "MCP3", None, ((230.0, 100.0),)))
    assert shown(hints, 1, 0.1, seen, nowhere).no_disc.all()
    assert len(shown(hints, 2, 0.2, spots(), nowhere).no_disc) == 0
    assert shown(hints, 3, 0.3, spots((236.0, 100.0)), nowhere).no_disc.all()
    assert not shown(hints, 4, 0.4, spots((300.0, 100.0)), nowhere).no_disc.any()
