"""What the digits sit on, and what is told of them, in C against NumPy."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from carpus.core.kernels import choice
from carpus.core.tracking.hand_filter import HandFilter
from carpus.core.tracking.hand_geometry import palm_of
from carpus.core.tracking.palm_state import SHAPE, SIZE, PalmEstimate
from carpus.core.tracking.readout import Readout
from carpus.core.tracking.settings import TrackerSettings
from carpus.core.tracking.tracker import FrameResults
from tests.compiled.test_digits import known, sequence
from tests.kernels.pairs import both
from tests.tracking.hands import CAMERA
from tests.tracking.test_palm_filter import moving

SETTINGS = TrackerSettings()


@pytest.mark.parametrize("side", ["right", "left"])
def test_the_seat_of_the_digits(side: str) -> None:
    view, own = HandFilter(known(side), CAMERA, SETTINGS).view, palm_of(known(side))
    for seed in range(3):
        estimate = moving(seed)
        further = replace(estimate, value=estimate.value + np.where(np.arange(SIZE) == SHAPE.start, 1e-4, 0.0))
        unknown = replace(estimate, value=np.full(SIZE, np.nan))

        def seats(estimates: tuple[PalmEstimate, ...] = (estimate, further, unknown)) -> list[object]:
            readout = Readout(own, CAMERA, 6e-3)
            return [readout.seat(one, view) for one in estimates]

        both(seats)


@pytest.mark.parametrize("blobs", [0, 7, 30])
def test_what_a_row_tells_of_every_marker(blobs: int) -> None:
    seen, protocol = sequence("right"), known("right").clicks.protocol
    own = HandFilter(known("right"), CAMERA, SETTINGS)
    assert own.fingers is not None
    results = FrameResults(protocol, own.order, own.fingers.model, own.readout, SETTINGS)
    some = seen.detections[0].only(np.arange(len(seen.detections[0])) < blobs)
    with choice.forced(choice.NUMPY):
        predicted = own.predict(0.0)
        scan = own.scan(predicted, some, 0.0, 0.0)
        posterior = own.update(predicted, scan)
        own.accept(posterior, scan, is_seen=True, linked=False)
        joints = own.joints(posterior)
    both(lambda: results._by_marker(posterior, joints, some))
