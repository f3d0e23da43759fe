"""Where depth readings are taken from picture to picture, and which when there are too many."""

from __future__ import annotations

import numpy as np
import pytest

from carpus.core.detection import surface_samples as surface_samples_module
from carpus.core.detection.surface_samples import SURFACE_SAMPLE_STEP_PX, sample_fingers, sample_surface
from carpus.core.model.types import FINGER_SAMPLE_STEP_PX, Frame

FULL = Frame(0, 0.0, np.zeros((480, 640, 3), np.uint8), np.full((480, 640), 700, np.uint16), 1e-3)


@pytest.mark.parametrize("shift_px", [0.0, 0.7])
def test_surface_lattice_is_fixed_in_the_image(shift_px: float) -> None:
    corners = np.array([[300.0, 200.0], [340.0, 205.0], [345.0, 260.0], [298.0, 255.0]]) + shift_px
    found = sample_surface(FULL, corners)
    assert found is not None
    assert not np.any(found.pixel % SURFACE_SAMPLE_STEP_PX)


def test_finger_samples_too_many_keeps_the_nearest(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    discs = np.array([[300.0, 200.0], [360.0, 210.0]])
    every = sample_fingers(FULL, discs)
    monkeypatch.setattr(surface_samples_module, "MAX_FINGER_READINGS", 20)
    some = sample_fingers(FULL, discs)
    assert every is not None
    assert some is not None
    assert not np.any(every.pixel % FINGER_SAMPLE_STEP_PX)
    assert len(every.pixel) > 40
    assert len(some.pixel) == 20

    def away_px(pixel: np.ndarray) -> np.ndarray:
        return np.asarray(np.abs(pixel[:, None] - discs).sum(axis=-1).min(axis=1))

    assert away_px(some.pixel).max() <= np.sort(away_px(every.pixel))[19]
