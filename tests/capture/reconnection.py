"""A camera is taken away and plugged in again, whoever made it."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path

import pytest

from carpus.core.capture.devices.process_camera import ProcessCamera
from carpus.core.model.errors import CameraLost, CameraReturned, CarpusFault
from carpus.core.model.types import Frame


def assert_reconnects(
    camera: ProcessCamera, frames: Iterator[Frame], first: list[Frame], notices: list[CarpusFault], *signs: Path
) -> None:
    """``first`` of its ``frames`` are there; the files ``signs`` have its stand-in go, and its loss being told, return.

    Times go on all the while, by the camera's own clock, and the pictures that are missing are counted.
    """
    for earlier, later in pairwise(first):
        periods = (later.timestamp_s - earlier.timestamp_s) * 30.0
        assert periods == pytest.approx(later.dropped_before + 1, abs=0.01)
    for sign in signs:
        sign.touch()

    def plug_in_again(fault: CarpusFault) -> None:
        notices.append(fault)
        signs[0].unlink(missing_ok=True)

    camera._notice = plug_in_again
    rest = []
    for frame in frames:
        rest.append(frame)
        if notices and isinstance(notices[-1], CameraReturned):
            break
    assert [type(fault) for fault in notices] == [CameraLost, CameraReturned]
    times_s = [frame.timestamp_s for frame in [*first, *rest]]
    assert all(later > earlier for earlier, later in pairwise(times_s))
    assert sum(frame.dropped_before for frame in rest) > 0
