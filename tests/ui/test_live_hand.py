"""The live screen of the whole hand: which figures come from which angles and discs, what is said of hidden ones."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import Qt
from pytestqt.qtbot import QtBot

from carpus.core.model.hand.exercises import get_exercise
from carpus.core.model.hand.protocols import HAND21, PALM_MARKERS, joint_angle_names
from carpus.core.model.types import TrackedFrame, TrackStatus
from carpus.core.results.repetition_rows import RepetitionChoices
from carpus.core.results.session_results import compute_session_results
from carpus.core.session.values import Session
from carpus.ui.charts.history import History
from carpus.ui.screens.live.recording import RepetitionCounter
from carpus.ui.screens.live.status_light import hand_light
from carpus.ui.words.finger_angles import FINGER_ANGLES, FingerAngle, estimate_finger_angles, find_finger_angle
from tests.moments import with_moment
from tests.ui.conftest import Live
from tests.ui.fakes import FakeFeed
from tests.ui.hand_fakes import hand_session

MARKERS = HAND21.markers
CLOSED_S, OPEN_S = 3.0, 0.2


def feed_of(hidden: Sequence[tuple[float, float, str]] = (), lost: Sequence[tuple[float, float]] = ()) -> FakeFeed:
    return FakeFeed("fist", 8.0, hidden, lost, protocol="hand21")


def frames_of(session: Session) -> list[TrackedFrame]:
    """The frames that were live when the session was recorded."""
    usual = feed_of().frames[0]
    return [
        replace(
            with_moment(
                usual,
                joint_angles_rad=session.motion.joint_angles_rad[row],
                joint_angles_sd_rad=session.motion.joint_angles_sd_rad[row],
            ),
            index=row,
            timestamp_s=float(session.timestamp_s[row]),
            status=TrackStatus(int(session.status[row])),
            marker_measured_px=session.markers.measured_px[row],
        )
        for row in range(len(session))
    ]


def frame_at(time_s: float) -> TrackedFrame:
    return feed_of().frames[round(30 * time_s)]


def test_live_hand_values_match_joint_and_abduction_sign() -> None:
    frame = frame_at(CLOSED_S)
    names = joint_angle_names()
    angle = dict(zip(names, np.degrees(frame.kinematics.joint_angles_rad), strict=True))
    _, value, sd, _, _ = estimate_finger_angles(HAND21, [frame])
    shown = dict(zip((figure.joint for figure in FINGER_ANGLES), value[0], strict=True))
    for name in ("MCP1_flexion", "IP1_flexion", "CMC1_abduction", "CMC1_extension", "MCP4_flexion", "PIP5_flexion"):
        assert shown[name] == pytest.approx(angle[name])
    assert shown["MCP2_abduction"] == pytest.approx(angle["MCP2_abduction"])
    assert shown["MCP5_abduction"] == pytest.approx(-angle["MCP5_abduction"])
    assert shown["DIP3_flexion"] == pytest.approx(angle["PIP3_flexion"] * 2 / 3)
    assert shown["TAM3"] == pytest.approx(angle["MCP3_flexion"] + 5 / 3 * angle["PIP3_flexion"])
    assert shown["TAM1"] == pytest.approx(angle["MCP1_flexion"] + angle["IP1_flexion"])
    sds = dict(zip(names, np.degrees(frame.kinematics.joint_angles_sd_rad), strict=True))
    column = FINGER_ANGLES.index(find_finger_angle("TAM3"))
    assert sd[0, column] == pytest.approx(math.hypot(sds["MCP3_flexion"], 5 / 3 * sds["PIP3_flexion"]))


def test_joint_counts_as_measured_only_while_marker_beyond_it_is_seen() -> None:
    hidden = [(0.0, 9.0, name) for name in ("DIP4", "TIP4", "MCP1")]
    history = History(HAND21)
    history.append(feed_of(hidden).frames[:90])
    measured = {figure: history.angle_value(k)[2] for k, figure in enumerate(FINGER_ANGLES)}
    wrong = {FingerAngle(4, "middle"), FingerAngle(4, "end"), FingerAngle(4, "tam")}
    wrong |= {FingerAngle(1, row) for row in ("middle", "spread", "knuckle", "tam")}
    assert {figure for figure, on in measured.items() if not on} == wrong
    assert history.finger_series()[FINGER_ANGLES.index(FingerAngle(4, "middle"))].predicted.all()
    assert history.is_inferred(FINGER_ANGLES.index(FingerAngle(2, "end")))  # coupled: it follows the middle joint
    seen = history.marker_visibility()
    assert {name for name, state in seen.items() if state == "hidden"} == {"DIP4", "TIP4", "MCP1"}


@pytest.mark.parametrize(("every", "points_s"), [(1, 10.0), (2, 15.0)])
def test_hand_that_is_seen_has_whole_curves_at_every_rate(every: int, points_s: float) -> None:
    """Of 30 and of 15 pictures a second; one picture that is missing is no gap, half a second is."""
    frames = [
        replace(frame, index=k, timestamp_s=k * every / 30.0) for k, frame in enumerate(feed_of([]).frames[:300:every])
    ]
    history = History(HAND21)
    history.append([*frames[:31], *frames[32:]])
    series = history.finger_series()[FINGER_ANGLES.index(FingerAngle(4, "middle"))]
    assert 1.0 / np.median(np.diff(series.time_s)) == pytest.approx(points_s)
    assert series.gaps_s() == []
    last = frames[-1]
    history.append([replace(last, index=last.index + 19, timestamp_s=last.timestamp_s + 19 * every / 30.0)])
    assert len(history.finger_series()[0].gaps_s()) == 1


def test_live_hand_occluded_trained_joint_has_no_value(live: Live) -> None:
    tried = live(feed_of([(1.0, 9.0, "PIP3"), (1.0, 9.0, "DIP3")]))
    tried.record()
    tried.run(0.8)
    reading = tried.reading()
    assert reading.best_positive_deg < 10.0
    assert math.isfinite(reading.value_deg)
    tried.run(2.4)
    reading, screen = tried.reading(), tried.screen
    assert math.isnan(reading.value_deg)
    assert reading.best_positive_deg < 10.0  # by then the finger is bent by 75 degrees
    light = screen.controls.light_view.status_light
    assert (light.rank, light.state) == ("warn", "Middle finger occluded")
    assert not any(
        screen.history.angle_value(FINGER_ANGLES.index(FingerAngle(3, row)))[2] for row in ("knuckle", "tam")
    )
    screen.recording.counter.best_negative_deg = -4.0
    assert math.isnan(tried.reading().best_negative_deg), "no mark for a finger laid flat"
    assert screen.number_card.reading.is_best_lower_bound
    assert "no value" not in screen.number_card.movement_name()


def test_lost_hand_leaves_no_number_anywhere(live: Live) -> None:
    tried = live(feed_of(lost=[(1.0, 9.0)]), 2.0)
    assert math.isnan(tried.reading().value_deg)
    assert all(math.isnan(value) for value, _, _ in tried.screen.finger_curves._values.values())
    assert tried.screen.controls.light_view.status_light.rank == "bad"


@pytest.mark.parametrize(
    ("hidden", "state", "remedy"),
    [
        ((), "Hand tracked well", "All 21 markers visible"),
        (("TIP4",), "Ring fingertip occluded", "Raise the hand"),
        (("MCP1", "IP1", "TIP1"), "Thumb occluded", "Turn the thumb side up"),
        (("DIP2", "TIP2"), "Index finger occluded", "Turn the back of the fingers to the camera"),
        (("TIP2", "TIP3", "DIP3"), "Fingertips occluded", "Turn the back of the fingers to the camera"),
        (("MCP5",), "Little finger MCP occluded", "Turn the little-finger side up"),
        (("WRIST", "CMC1", "MCP2", "MCP3"), "Too few markers visible", "Turn the back of the hand to the camera"),
    ],
)
def test_status_light_names_the_occluded_marker_and_remedy(hidden: tuple[str, ...], state: str, remedy: str) -> None:
    frame = feed_of([(0.0, 9.0, name) for name in hidden]).frames[20]
    lamp = hand_light(frame, {name: "hidden" if name in hidden else "seen" for name in MARKERS})
    assert (lamp.state, lamp.remedy) == (state, remedy)
    assert lamp.rank == ("warn" if hidden else "good")


def test_status_light_of_the_wrist_names_marker_forearm_and_lost_hand() -> None:
    frame, seen = FakeFeed().frames[10], dict.fromkeys(PALM_MARKERS, "seen")
    assert hand_light(frame, seen | {"CMC1": "hidden"}).state == "Thumb CMC occluded"
    assert hand_light(frame, seen, has_forearm_moved=True).state == "Forearm moved"
    assert hand_light(frame, seen).remedy == "All 6 markers visible"
    assert hand_light(replace(frame, status=TrackStatus.LOST), seen).rank == "bad"


@pytest.mark.parametrize("exercise", ["FIST_COMPOSITE", "FIST_HOOK"])
def test_live_count_matches_review_with_occlusion(exercise: str) -> None:
    chosen = get_exercise(exercise)
    session = hand_session(exercise=exercise, motion="hook" if exercise == "FIST_HOOK" else "fist")
    count = RepetitionCounter(chosen)
    count.append(frames_of(session))
    found = compute_session_results(session, RepetitionChoices({}))
    assert count.update_count() == len(found.repetitions) >= 5
    row = found.find(chosen.joint, "flexion")
    assert count.best_positive_deg == pytest.approx(row.best, abs=3.0)
    assert count.is_best_lower_bound == row.is_lower_bound


def test_large_number_is_chosen_by_click_and_by_key(qtbot: QtBot, live: Live) -> None:
    tried = live(feed_of(), CLOSED_S)
    feed, screen = tried.feed, tried.screen
    assert screen.number_card.movement_name() == "Middle finger, MCP"
    assert screen.number_card.reading.target_positive_deg == 90.0
    spot = screen.finger_curves.cell(FingerAngle(4, "knuckle")).center().toPoint()
    qtbot.mouseClick(screen.finger_curves.mouse_target, Qt.MouseButton.LeftButton, pos=spot)
    assert screen.number_card.movement_name() == "Ring finger, MCP"
    assert math.isnan(screen.number_card.reading.target_positive_deg)  # the target is the trained joint's
    angle = feed.frames[feed.place].kinematics.joint_angles_rad[joint_angle_names().index("MCP4_flexion")]
    assert screen.number_card.reading.value_deg == pytest.approx(math.degrees(angle))
    screen.show_angle(screen.number_card.reading.with_next_angle())
    screen.show_angle(screen.number_card.reading.with_next_finger())
    assert screen.number_card.movement_name() == "Little finger, PIP"
    for _ in range(3):
        screen.show_angle(screen.number_card.reading.with_next_angle())
    assert screen.number_card.movement_name() == "Little finger, total active motion (TAM)"
