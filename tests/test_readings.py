"""The columns that a therapist reads say what their names say, on errors made for the purpose."""

from __future__ import annotations

import numpy as np
import pytest

from carpus.core.model.types import FloatArray
from carpus.core.simulation.scene import Scene
from carpus.core.simulation.spec import RecordingSpec
from carpus.core.simulation.truth import Truth, compute_truth
from tests.accuracy.readings import Reading, compute_reading, find_moves_rad, find_strokes, read_figures


@pytest.fixture(scope="module")
def truth() -> Truth:
    return compute_truth(Scene(RecordingSpec(seed=4, motion="flexion", speed_hz=0.4, seconds=12.0)))


def read(truth: Truth, error_deg: FloatArray, sd_deg: float = 1.0) -> Reading:
    every = np.ones(len(truth.time_s), dtype=bool)
    sd = np.full(error_deg.shape, sd_deg)
    return compute_reading(
        truth.time_s, find_moves_rad(truth, truth.time_s), truth.angles_rad, every, error_deg, sd, unused=3, shown=60
    )


def test_range_read_tenth_too_large_is_reported_by_repetition_and_at_ends(truth: Truth) -> None:
    error = 0.1 * np.degrees(truth.angles_rad)
    error[:, [0, 2]] = 0.0
    reading = read(truth, error)
    windows, ends = find_strokes(truth.time_s, find_moves_rad(truth, truth.time_s))
    assert len(windows) >= 3
    assert len(ends) == 2 * len(windows)
    found = read_figures([reading], (1,))
    assert 8.0 < found.range_mean < found.range_worst < 10.5  # a tenth of two times 50, less what a person falls short
    assert 4.0 < found.end_rms <= found.end_worst < 5.2
    assert abs(found.zero_rms) < 0.3
    assert read_figures([reading], (0,)).range_worst == 0.0


def test_wrong_zero_is_no_wrong_range(truth: Truth) -> None:
    found = read_figures([read(truth, np.full(truth.angles_rad.shape, 2.0))], (0, 1, 2))
    assert found.zero_rms == pytest.approx(2.0)
    assert found.end_worst == pytest.approx(2.0)
    assert found.range_worst == pytest.approx(0.0, abs=1e-9)
    assert found.rmse == found.p95 == pytest.approx(2.0)
    assert found.inside == 1.0


def test_longest_time_outside_three_sd_is_that_of_one_angle(truth: Truth) -> None:
    error = np.zeros(truth.angles_rad.shape)
    error[30:91, 2] = 3.1
    error[200:221, 2] = error[100:110, 0] = -9.0
    error[120:300, 1] = 2.9
    reading = read(truth, error)
    np.testing.assert_allclose(reading.outside_s, [0.3, 0.0, 2.0], atol=0.02)
    assert read_figures([reading], (0, 1)).outside_s == pytest.approx(0.3, abs=0.02)
