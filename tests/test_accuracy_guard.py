"""A small part of ``make accuracy`` that fails when the wrist is tracked worse than it was.

The limits are a quarter above what was measured when they were set, and a promise that is kept stays kept. One that is
not is marked in ``NOT_KEPT`` or ``TIMID``, and the guard fails once it is kept again: then the mark goes.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest
from threadpoolctl import threadpool_limits

from tests.accuracy.carpus import run_on_pictures
from tests.accuracy.jobs import run_job
from tests.accuracy.scenarios import FAST, SLOW, WRIST
from tests.accuracy.scores import CARPUS, SIMPLEST, Run, score
from tests.rendered import REPEATED_FLEXION, Rendered

MOST_RMSE_DEG: dict[str, tuple[float, float, float]] = {SLOW: (0.3, 1.0, 1.2), FAST: (0.4, 1.0, 1.3)}
LEAST_INSIDE_OF_ANY, MOST_SD_OVER_RMSE, MOST_WRONG = 0.70, 1.5, 0.002
"""What was promised."""
SEEDS = 3
COLUMNS = WRIST[0].columns


@dataclass(frozen=True)
class Measured:
    """RMSE of deviation, flexion and pro/supination, degrees, live and looking back; mean live sd over the RMSE."""

    live_deg: tuple[float, float, float]
    back_deg: tuple[float, float, float]
    sd_over_rmse: tuple[float, float, float]


MEASURED = {
    SLOW: Measured((0.46, 0.55, 1.41), (0.44, 0.48, 1.29), (1.20, 1.49, 1.79)),
    FAST: Measured((0.19, 0.78, 1.19), (0.22, 0.44, 1.06), (2.11, 1.13, 1.92)),
}
MARGIN, MARGIN_OF_ONE, TIMID_MARGIN = 1.25, 1.6, 1.1
# The hands of these rows are rigid, and the filter does not know it: where a disc moved, skin may have glided or the
# arch closed. That is made for soft hands and costs rigid ones: the filter of rigid hands had 0.24, 0.39 and 0.59
# degrees live in the slow rows, its standard deviation 1.0 to 1.1 times that. Depths stay rounded to one step while
# a hand is still, and the calibration's part of the standard deviation says so. These measurements have no readings of
# the back of the hand, which tell a turn of the hand from gliding skin. The deviation is that of one recording (the
# first of flexion, 1.36 degrees); the other 14 together have 0.31.
NOT_KEPT: dict[str, tuple[bool, bool, bool]] = {SLOW: (True, False, True), FAST: (False, False, False)}
"""RMSE of deviation, flexion and pro/supination above what was promised."""
TIMID: dict[str, tuple[bool, bool, bool]] = {SLOW: (False, False, True), FAST: (True, False, True)}
"""Their mean standard deviation above what was promised."""
PICTURE_LIMIT_DEG = (0.10, 0.55, 0.40)
"""A quarter above 0.44 of flexion; more above the small 0.04 and 0.24 of the others."""
LEAST_INSIDE = 0.92
"""Share of frames with the truth within 2 sd."""


@pytest.fixture(scope="module")
def runs() -> dict[str, list[Run]]:
    """Runs of both pools, and of the simplest thing, on the first seeds of the table."""
    out: dict[str, list[Run]] = {SLOW: [], FAST: []}
    for scenario in WRIST:
        if scenario.pool is not None:
            for seed in scenario.seeds(SEEDS)[:SEEDS]:
                out[scenario.pool] += run_job((scenario, seed, "blobs"))
    return out


@pytest.mark.parametrize(("name", "pool"), [("mixed axes", SLOW), ("deviation 1.7 Hz", FAST)])
def test_accuracy_of_single_recording_has_not_fallen(name: str, pool: str) -> None:
    """The short form of what follows."""
    scenario = next(one for one in WRIST if one.name == name)
    one, simplest = run_job((scenario, scenario.seeds(1)[0], "blobs"))
    carpus, back, plain = score([one], COLUMNS), score([one], COLUMNS, smoothed=True), score([simplest], COLUMNS)
    measured = MEASURED[pool]
    assert (carpus.rmse <= MARGIN_OF_ONE * np.array(measured.live_deg)).all(), carpus.rmse
    assert (back.rmse <= MARGIN_OF_ONE * np.array(measured.back_deg)).all(), back.rmse
    assert (carpus.sd_over_rmse <= MARGIN_OF_ONE * np.array(measured.sd_over_rmse)).all(), carpus.sd_over_rmse
    assert (carpus.rmse < 0.5 * plain.rmse).all(), "the simplest thing is no rival"
    assert (carpus.inside >= LEAST_INSIDE).all(), carpus.inside
    assert carpus.wrong < MOST_WRONG
    assert carpus.tracked > 0.995


@pytest.mark.thorough
@pytest.mark.parametrize("pool", MEASURED)
def test_wrist_is_tracked_as_well_as_it_was(pool: str, runs: dict[str, list[Run]]) -> None:
    carpus = [run for run in runs[pool] if run.method == CARPUS]
    live, back = score(carpus, COLUMNS), score(carpus, COLUMNS, smoothed=True)
    plain = score([run for run in runs[pool] if run.method == SIMPLEST], COLUMNS)
    measured, promised_deg = MEASURED[pool], np.array(MOST_RMSE_DEG[pool])
    not_kept, timid = np.array(NOT_KEPT[pool]), np.array(TIMID[pool])
    assert ((live.rmse > promised_deg) == not_kept).all(), live.rmse
    assert ((live.sd_over_rmse > MOST_SD_OVER_RMSE) == timid).all(), live.sd_over_rmse
    assert (live.rmse <= MARGIN * np.array(measured.live_deg)).all(), live.rmse
    assert (back.rmse <= MARGIN * np.array(measured.back_deg)).all(), back.rmse
    assert (live.sd_over_rmse <= TIMID_MARGIN * np.array(measured.sd_over_rmse)).all(), live.sd_over_rmse
    assert (live.rmse < 0.5 * plain.rmse).all(), "the simplest thing is no rival"
    assert (live.inside >= LEAST_INSIDE).all(), live.inside
    assert live.worst_inside >= LEAST_INSIDE_OF_ANY
    assert live.wrong < MOST_WRONG
    assert live.tracked > 0.995
    assert live.longest_untracked_s < 0.1
    assert live.ends_lost == 0


def test_rendered_hand_is_tracked_as_well_as_it_was(rendered: Rendered) -> None:
    """From pictures through the whole of Carpus: also the detector's part."""
    with threadpool_limits(1):
        run, _, _ = run_on_pictures("flexion", REPEATED_FLEXION, rendered(REPEATED_FLEXION))
    found = score([run], COLUMNS)
    assert (found.rmse <= PICTURE_LIMIT_DEG).all(), found.rmse
    assert found.tracked > 0.98
    assert found.wrong < MOST_WRONG
