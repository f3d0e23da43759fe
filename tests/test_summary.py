"""What ``carpus info`` tells of a session and of a recording."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
import pytest

from carpus.core.model.hand.protocols import HAND21
from carpus.core.model.types import TrackStatus
from carpus.core.results.session_results import compute_session_results
from carpus.core.results.session_summary import _calibration_lines, range_lines, session_summary
from carpus.core.session.reader import read_session
from carpus.core.session.values import stack_states
from tests.moments import with_moment
from tests.session.samples import begin_session, compute_time, make_frame, make_header
from tests.ui import fakes


def values(lines: list[str]) -> dict[str, str]:
    return {line.split()[0]: line.split(maxsplit=1)[1] for line in lines if not line.startswith("  ")}


def write(path: Path) -> Path:
    """Six frames: 3 tracked with known angles, 2 predicted and 1 lost with larger ones that must not count."""
    angles_deg = [(0, 10, -5), (0, -20, 5), (1, 42, 0), (9, 90, 90), (-9, -90, -90), (0, 0, 0)]
    status = [TrackStatus.TRACKED] * 3 + [TrackStatus.PREDICTED] * 2 + [TrackStatus.LOST]
    session = begin_session(path)
    for row in range(6):
        frame = dataclasses.replace(
            with_moment(make_frame(row), angles_rad=np.radians(angles_deg[row])),
            status=status[row],
            dropped_before=2 * (row == 3),
        )
        session.append(frame)
    session.add_event(compute_time(1), "note", "x")
    session.add_event(compute_time(2), "note", "y")
    session.write_motion(stack_states([make_frame(row) for row in range(6)]))
    session.close()
    return path


def test_session_summary_has_plain_lines(tmp_path: Path) -> None:
    path = write(tmp_path / "s.h5")
    lines = session_summary(read_session(path))
    facts = values(lines)
    assert facts["Session"] == str(path)
    assert facts["Patient"] == "Linden 42, left hand"
    assert facts["Complete"] == "yes"
    assert facts["Frames"] == "6 in 00:00.2, 30.0 a second"
    assert facts["Gaps"] == "2 frames missing in 1 place"
    assert facts["Tracking"] == "tracked 50.0 %, predicted 33.3 %, lost 16.7 %"
    assert facts["Events"] == "2 note"
    assert facts["Smoothed"] == "yes"
    assert facts["Video"] == "not saved"
    assert "--json" in facts["Settings"]
    assert not any(line.startswith("{") or " {" in line for line in lines)
    assert facts["Origin"] == "tracked again from earlier.h5"
    assert "hand 183 mm, 0.70 m from the camera, tilted 13°" in facts["Calibration"]
    assert "fx 570.25" in facts["Camera"]
    assert "  not measured" in lines, "three frames are no range"
    text = "\n".join(lines)
    assert "The labels of index and middle finger MCP seem to be swapped; swap the two labels" in text
    assert "Start angles as given by the therapist" in text
    assert "nan" not in text


@pytest.mark.parametrize("exercise", ["WRIST_FE", "FREE"])
def test_range_lines_equal_the_table_of_results(exercise: str) -> None:
    results = compute_session_results(fakes.session(seconds=20.0, exercise=exercise))
    lines = {line.split()[0]: line.split(maxsplit=1)[1] for line in range_lines(results)}
    flexion, extension, arc = (results.find("flexion", name) for name in ("flexion", "extension", "arc"))
    ends = f"arc {arc.mean:.1f}°, flexion {flexion.mean:.1f}°, extension {extension.mean:.1f}°"
    counted = f", mean of {results.repetition_count} repetitions" if exercise == "WRIST_FE" else ""
    assert lines["flexion"] == ends + counted
    assert results.repetition_count >= 2 or exercise == "FREE"


def test_summary_gives_each_joint_its_visible_range(tmp_path: Path) -> None:
    path = tmp_path / "s.h5"
    hidden = HAND21.markers.index("DIP4")
    with begin_session(path, make_header(HAND21)) as session:
        for row in range(8):
            measured = np.full((21, 2), 100.0)
            measured[hidden] = np.nan
            angles = np.full(17, 0.0 if row % 2 else 0.5)
            frame = with_moment(make_frame(row, HAND21), joint_angles_rad=angles, joint_angles_sd_rad=np.full(17, 0.01))
            session.append(dataclasses.replace(frame, status=TrackStatus.TRACKED, marker_measured_px=measured))
    lines = {line.split()[0]: line for line in session_summary(read_session(path)) if line.startswith("  ")}
    assert "visible 100 %" in lines["PIP3_flexion"]
    assert "arc" in lines["MCP4_flexion"]
    assert "not measured" in lines["PIP4_flexion"]
    assert "not measured" in lines["TAM4"]
    assert "DIP not measured" in lines["TAM3"]


def test_session_summary_states_simulated_or_doubtful(tmp_path: Path) -> None:
    stored = read_session(write(tmp_path / "s.h5"))
    assert "Source" not in values(session_summary(stored))
    assert any(line.startswith("  doubtful: The hand is tilted 22°") for line in session_summary(stored))
    header = dataclasses.replace(stored.header, parameters='{"source": {"simulated": "yes"}}')
    facts = values(session_summary(dataclasses.replace(stored, header=header)))
    assert facts["Source"] == "simulated: nobody's movement was measured"


def test_session_summary_forearm_start_counts_from_thumb_up() -> None:
    made = fakes.session(seconds=20.0, exercise="FOREARM_PS", motion="palm_up")
    start = np.radians([0.0, 0.0, 30.0])
    began = dataclasses.replace(made, calibration=dataclasses.replace(made.calibration, start_angles_rad=start))
    assert any("60.0° pronation" in one for one in _calibration_lines(began))
