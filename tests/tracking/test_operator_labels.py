"""What a person says of spots: it waits, holds, follows, and ends."""

from __future__ import annotations

import numpy as np
import pytest

from carpus.core.model.types import Detections, FloatArray
from carpus.core.tracking.association.operator_labels import (
    LABEL_TIMEOUT_S,
    LabelledDetections,
    OperatorLabels,
)

EXPECTED_PX = np.array([[100.0, 100.0], [200.0, 100.0]])


def spots(*place_px: tuple[float, float]) -> Detections:
    count = len(place_px)
    return Detections(np.reshape(np.array(place_px), (count, 2)), *(np.ones(count),) * 4)


def apply_frame(
    hints: OperatorLabels, time_s: float, seen: Detections, at: FloatArray = EXPECTED_PX
) -> LabelledDetections:
    return hints.apply_labels(time_s, seen, lambda: at)


def test_labels_of_one_frame_have_their_turns_and_are_followed() -> None:
    hints = OperatorLabels(2)
    hints.add(1, np.array([200.0, 101.0]))
    hints.add(0, np.array([50.0, 50.0]))
    assert apply_frame(hints, 0.1, spots((203.0, 104.0), (54.0, 50.0))).marker == 1
    assert apply_frame(hints, 0.2, spots((203.0, 104.0), (60.0, 50.0))).marker == 0
    assert apply_frame(hints, 0.3, spots((203.0, 104.0), (60.0, 50.0))).marker is None


@pytest.mark.parametrize(("after_s", "is_heard"), [(0.9, True), (1.1, False)])
def test_operator_label_waits_for_its_blob_until_timeout(after_s: float, is_heard: bool) -> None:
    hints = OperatorLabels(2)
    hints.add(1, np.array([200.0, 100.0]))
    later_s = after_s * LABEL_TIMEOUT_S
    for at_s in (0.0, later_s):
        assert apply_frame(hints, at_s, spots((20.0, 20.0))).marker is None
    assert (apply_frame(hints, later_s, spots((200.0, 100.0))).marker is not None) == is_heard


def test_rejected_blob_yields_to_a_measured_marker() -> None:
    """What was no disc went out of sight beside its marker; what comes back nearer to a held one is that one's."""
    for is_held in (False, True):
        hints = OperatorLabels(2)
        near = EXPECTED_PX[0] + [10.0, 0.0]
        seen = spots((float(near[0]), float(near[1])))
        hints.reject(1, near)
        assert apply_frame(hints, 0.1, seen).is_rejected.all()
        hints.follow(EXPECTED_PX if is_held else np.full((2, 2), np.nan))
        back = EXPECTED_PX[0] + [4.0, 0.0]
        found = apply_frame(hints, 0.2, spots((float(back[0]), float(back[1]))))
        assert found.is_rejected.tolist() == [not is_held]


def test_rejected_blob_of_a_lost_hand_is_found_by_position() -> None:
    hints, nowhere = OperatorLabels(2), np.full((2, 2), np.nan)
    seen = spots((230.0, 100.0))
    hints.reject(1, np.array([230.0, 100.0]))
    assert apply_frame(hints, 0.1, seen, nowhere).is_rejected.all()
    assert len(apply_frame(hints, 0.2, spots(), nowhere).is_rejected) == 0
    assert apply_frame(hints, 0.3, spots((236.0, 100.0)), nowhere).is_rejected.all()
    assert not apply_frame(hints, 0.4, spots((300.0, 100.0)), nowhere).is_rejected.any()
