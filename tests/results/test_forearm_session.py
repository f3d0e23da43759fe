"""A session of pronation and supination as a clinician reads it, and as its file has it."""

from __future__ import annotations

import json
import math
from dataclasses import replace

import numpy as np
import pytest

from carpus.core.formats.measures_table import build_measure_rows
from carpus.core.model.hand.exercises import get_exercise
from carpus.core.results.motion_curves import visible_angle_deg
from carpus.core.results.ranges import LARGEST_SIZE
from carpus.core.results.repetition_rows import compute_repetitions
from carpus.core.results.session_results import compute_session_results
from carpus.core.results.valid_data import wrist_curves
from carpus.core.session.values import Session
from tests.ui.fakes import figures_once, session


def turned(side: str) -> Session:
    return session(seconds=30.0, exercise="FOREARM_PS", motion="palm_up", side=side)


@pytest.mark.parametrize("side", ["right", "left"])
def test_forearm_ranges_count_from_thumb_up(side: str) -> None:
    stored = turned(side)
    lowest, highest = np.degrees([stored.motion.angles_rad[:, 2].min(), stored.motion.angles_rad[:, 2].max()])
    rows = {row.quantity: row for row in figures_once(stored).wrist_ranges}
    assert rows["pronation"].mean == pytest.approx(90.0 - lowest, abs=4.0)
    assert rows["supination"].mean == pytest.approx(highest - 90.0, abs=4.0)
    assert rows["arc"].mean == pytest.approx(highest - lowest, abs=4.0)
    assert 90.0 < rows["pronation"].mean < 100.0
    drawn = wrist_curves(stored).angles_deg[:, 2]
    assert drawn == pytest.approx(np.degrees(stored.motion.angles_rad[:, 2]) - 90.0)
    assert np.nanmax(visible_angle_deg(stored, "pronosupination")) == pytest.approx(highest - 90.0, abs=4.0)


def test_repetition_table_keeps_angle_of_file() -> None:
    stored = turned("right")
    found = compute_repetitions(stored)
    assert found.angle == "pronosupination"
    highest = float(stored.motion.angles_rad[:, 2].max())
    assert [row.angle_rad for row in found.rows if row.counted] == pytest.approx(
        [highest] * sum(row.counted for row in found.rows), abs=math.radians(4)
    )
    said = {row.measure: row.positive for row in build_measure_rows(figures_once(stored), "x")}
    assert said["supination"] == "supinated, 0 is thumb up"


def test_rotation_beside_another_movement_is_arc_only() -> None:
    """A wrist whose forearm began 20 degrees short of palm down has turned by nothing, and has no pronation."""
    stored = session(seconds=30.0)
    start = np.radians([0.0, 0.0, 20.0])
    angles = stored.motion.angles_rad + start
    began = replace(
        stored, motion=replace(stored.motion, angles_rad=angles),
        calibration=replace(stored.calibration, start_angles_rad=start),
    )  # fmt: skip
    still, other = (
        one.find("pronosupination", LARGEST_SIZE) for one in (compute_session_results(began), figures_once(stored))
    )
    assert still.mean == pytest.approx(other.mean)
    free = replace(stored, header=replace(stored.header, exercise="FIST_COMPOSITE"))
    assert {row.quantity for row in compute_session_results(free).wrist_ranges if row.wrist_angle == 2} == {"arc"}


def test_targets_of_older_session_are_converted() -> None:
    stored = turned("right")
    parameters = json.dumps({"set_up": {"targets_deg": [60.0, None]}})
    aimed = compute_session_results(replace(stored, header=replace(stored.header, parameters=parameters)))
    assert aimed.targets_deg[0] == -30.0
    assert get_exercise("FOREARM_PS") == aimed.exercise
