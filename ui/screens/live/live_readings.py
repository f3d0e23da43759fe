"""Present values for the large number card and for the patient's view."""

from __future__ import annotations

import math
import time
from dataclasses import replace

import numpy as np

from carpus.core.measures.signals import MAX_ANGLE_SD_RAD
from carpus.core.model.hand.exercises import PRONOSUPINATION
from carpus.core.model.hand.forearm_rotation import pronosupination_from_palm_down
from carpus.core.model.types import TrackStatus
from carpus.ui.charts.history import History
from carpus.ui.picture.movement_guide import ExerciseSnapshot
from carpus.ui.screens.live.number_card import Reading
from carpus.ui.screens.live.recording import RecordingController
from carpus.ui.words.finger_angles import FINGER_ANGLES, FINGERS, FingerAngle, find_finger_angle

TIMED_PARTS = 10
"""Marks of progress for an exercise that goes by time."""


class LiveReadings:
    """Reads present values from the history and the recording."""

    def __init__(self, history: History, recording: RecordingController) -> None:
        self._history, self._recording = history, recording

    def current_reading(self, shown: Reading) -> Reading:
        history, recording, figure = self._history, self._recording, shown.figure
        count, lost = recording.counter, recording.camera_lost
        if figure is not None:
            column = FINGER_ANGLES.index(figure)
            value, sd, measured = history.angle_value(column)
            inferred = history.is_inferred(column)
            known, own = (measured or inferred) and not lost, count is not None and count.joint == figure.joint
            reading = Reading(figure=figure, is_predicted=known and inferred)
        else:
            angle, status = shown.angle, history.status
            value, sd = float(history.angles_deg[angle]), float(history.sds_deg[angle])
            known, own = not lost, count is not None and count.angle == angle
            doubtful = known and status == TrackStatus.DOUBTFUL
            reading = Reading(angle=angle, is_predicted=known and status == TrackStatus.PREDICTED, is_doubtful=doubtful)
        asked = recording.set_up.repetitions if recording.set_up else 0
        reading = replace(
            reading, value_deg=value if known else math.nan, sd_deg=sd if known else math.nan,
            repetitions_done=recording.repetitions, repetitions_asked=asked,
            is_repetition_running=recording.state == "recording" and recording.repetitions < asked,
        )  # fmt: skip
        if count is not None and own:
            backwards_deg = count.best_negative_deg if figure is None else math.nan  # no joint trains beyond straight
            reading = replace(
                reading, best_positive_deg=count.best_positive_deg, best_negative_deg=backwards_deg,
                is_best_lower_bound=count.is_best_lower_bound,
            )  # fmt: skip
        return self.with_targets(reading)

    def with_targets(self, reading: Reading) -> Reading:
        """Return a reading with the goals of the exercise, if it trains the angle shown."""
        set_up = self._recording.set_up
        if set_up is None:
            return reading
        figure, exercise = reading.figure, set_up.exercise
        if figure.joint != exercise.joint if figure is not None else reading.angle != exercise.angle:
            return reading
        return replace(
            reading, target_positive_deg=set_up.target_positive_deg, target_negative_deg=set_up.target_negative_deg
        )

    def exercise_snapshot(self, *, is_current: bool) -> ExerciseSnapshot:
        """Return the present state of the trained angle, whichever angle is shown.

        ``is_current`` is False if the last tracked frame is old.
        """
        recording, history = self._recording, self._history
        count, set_up, state, now_s = recording.counter, recording.set_up, recording.state, time.monotonic()
        done, asked = recording.repetitions, set_up.repetitions if set_up else 0
        if set_up is not None and set_up.set_run is not None and set_up.set_run.part.seconds:
            done, asked = int(TIMED_PARTS * recording.duration_s / set_up.set_run.part.seconds), TIMED_PARTS
        if set_up is None or recording.camera_lost or not is_current:
            return ExerciseSnapshot(now_s, state=state, done=done, asked=asked, is_late=True)
        deviation, flexion, turned = (float(value) for value in history.angles_deg)
        seen = history.status == TrackStatus.TRACKED
        angle, whole_hand = set_up.exercise.angle, set_up.protocol.has_fingers
        value, sd, measured = math.nan, math.nan, seen
        if whole_hand and set_up.exercise.joint:
            value, sd, measured = history.angle_value(FINGER_ANGLES.index(find_finger_angle(set_up.exercise.joint)))
        elif angle is not None:
            value, sd = float(history.angles_deg[angle]), float(history.sds_deg[angle])
            if angle == PRONOSUPINATION:  # the patient's hand is drawn from where it lies, palm down
                value = math.degrees(float(pronosupination_from_palm_down(np.radians(value))))
        sure = measured and seen and math.isfinite(value) and sd <= math.degrees(MAX_ANGLE_SD_RAD)
        bent = [history.angle_value(FINGER_ANGLES.index(FingerAngle(finger, "middle"))) for finger in FINGERS[1:]]
        bent_deg = [one for one, _, known in bent if known] if whole_hand else []
        return ExerciseSnapshot(
            now_s,
            value,
            sure,
            seen,
            (deviation, flexion, turned),
            sum(bent_deg) / len(bent_deg) if bent_deg else math.nan,
            state,
            done,
            asked,
            count.found_count if count else 0,
            recording.countdown_s,
        )
