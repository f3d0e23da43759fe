"""The forearm while it is measured: live values, best values and curves count from thumb up."""

from __future__ import annotations

import numpy as np
import pytest

from carpus.core.model.hand.exercises import get_exercise
from carpus.core.model.hand.protocols import WRIST6
from carpus.ui.charts.history import History
from carpus.ui.screens.live.recording import RepetitionCounter
from tests.ui.fakes import simulated, tracked_frames


@pytest.mark.parametrize("side", ["right", "left"])
def test_live_values_and_bests_of_the_forearm_count_from_thumb_up(side: str) -> None:
    frames = tracked_frames(simulated("palm_up", 12.0, 0.25, side))
    stored_deg = np.degrees([frame.kinematics.angles_rad[2] for frame in frames])
    exercise = get_exercise("FOREARM_PS")
    history, count = History(WRIST6), RepetitionCounter(exercise)
    history.clear(WRIST6, exercise)
    for frame in frames:
        history.append([frame])
        count.append([frame])
    assert history.angles_deg[2] == pytest.approx(stored_deg[-1] - 90.0)
    assert history.angle_series(2).value[-1] == pytest.approx(stored_deg[-1] - 90.0)
    assert count.best_positive_deg == pytest.approx(stored_deg.max() - 90.0, abs=0.5)
    assert count.best_negative_deg == pytest.approx(stored_deg.min() - 90.0, abs=0.5)
    assert count.update_count() >= 2
