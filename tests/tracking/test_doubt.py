"""What is seen and not used, or surprises for too long, makes a frame doubtful."""

from __future__ import annotations

import numpy as np

from carpus.core.tracking.doubt import DoubtSettings, DoubtWatch, passed_over

DT_S = 1.0 / 30.0
NONE = np.zeros(3, dtype=bool)


def test_a_disc_passed_over_for_long_is_doubted_by_name() -> None:
    watch = DoubtWatch(3, DoubtSettings(unused_s=0.3))
    over = np.array([False, True, False])
    said = [watch.watch(DT_S, over, 10.0, 10, 0) for _ in range(12)]
    assert not any(doubt.is_any for doubt in said[:9])
    assert said[-1].doubted.tolist() == [False, True, False]
    assert said[-1].widens > 1.0
    assert not watch.watch(DT_S, NONE, 10.0, 10, 0).is_any, "and no longer, once it is used"


def test_innovations_outside_their_bounds_widen_what_is_stated() -> None:
    watch = DoubtWatch(3, DoubtSettings())
    one = watch.watch(DT_S, NONE, 200.0, 10, 2)
    assert not one.is_any or one.widens < 3.0, "one surprise is not enough"
    for _ in range(30):
        last = watch.watch(DT_S, NONE, 90.0, 10, 2)
    assert last.doubted.tolist() == [False, False, True]
    assert 2.5 < last.widens < 3.1, "to what the innovations say, 9 times the variance"
    watch.forget()
    assert not watch.watch(DT_S, NONE, 10.0, 10, 0).is_any


def test_nothing_measured_is_no_contradiction() -> None:
    watch = DoubtWatch(3, DoubtSettings())
    for _ in range(60):
        doubt = watch.watch(DT_S, NONE, float("nan"), 0, 0)
    assert not doubt.is_any


def test_only_a_free_blob_at_the_place_and_depth_is_passed_over() -> None:
    disc_px, depth = np.array([[100.0, 100.0], [200.0, 100.0]]), np.array([0.7, 0.7])
    settings = DoubtSettings()

    def over(taken: list[int], blob_px: list[list[float]], blob_m: list[float]) -> list[bool]:
        return passed_over(
            disc_px, depth, np.array(taken), np.array(blob_px).reshape(-1, 2), np.array(blob_m), 525.0, settings
        ).tolist()

    assert over([-1, 0], [[200.0, 100.0], [103.0, 101.0]], [0.7, 0.7]) == [True, False]
    assert over([-1, 0], [[200.0, 100.0]], [0.7]) == [False, False]
    assert over([-1, 0], [[200.0, 100.0], [130.0, 100.0]], [0.7, 0.7]) == [False, False]
    assert over([-1, 0], [[200.0, 100.0], [103.0, 101.0]], [0.7, 0.6]) == [False, False]
    assert over([-1, 0], [[200.0, 100.0], [103.0, 101.0]], [0.7, np.nan]) == [True, False]
