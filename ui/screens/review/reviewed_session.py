"""Session as shown in the review: read and analysed in the background."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from datetime import datetime, timedelta
from typing import TYPE_CHECKING

import numpy as np

from carpus.core.measures.manual_measurements import ManualValue, session_values
from carpus.core.model.hand.exercises import FLEXION, Exercise
from carpus.core.model.types import FloatArray, TrackStatus
from carpus.core.records.values import SessionEntry, read_or_default
from carpus.core.results.progress import error_limits
from carpus.core.results.repetition_rows import PASSIVE, RepetitionChoices
from carpus.core.results.session_results import SessionResults, compute_session_results
from carpus.core.results.valid_data import JointCurves, WristCurves, joint_curves, wrist_curves
from carpus.core.session.values import Session
from carpus.ui.charts.session import move_edge, wrist_series
from carpus.ui.kit import numbers
from carpus.ui.kit.translate import tr
from carpus.ui.picture.session_frames import project_markers
from carpus.ui.words import terms
from carpus.ui.words.finger_angles import find_finger_angle

if TYPE_CHECKING:  # it reads and writes files
    from carpus.core.records.data_folder import DataFolder


@dataclass(frozen=True, slots=True)
class ReviewedSession:
    """Session with the results of the person's choices.

    ``joints`` and ``modelled_px`` (markers as modelled, in every frame) exist for a whole hand only.
    """

    session: Session
    choices: RepetitionChoices
    history: Sequence[SessionResults]
    versions: Sequence[SessionEntry]
    manual_values: Sequence[ManualValue]
    curves: WristCurves
    joints: JointCurves | None
    modelled_px: FloatArray | None
    results: SessionResults

    @classmethod
    def load(cls, store: DataFolder, patient_id: str, session_id: str) -> ReviewedSession:
        """Read and analyse a session; call it in the background."""
        session, choices = store.session(session_id), store.choices(session_id)
        history = read_or_default(lambda: store.history(patient_id), ())
        values = read_or_default(lambda: store.manual_measurements(patient_id), ())
        by_hand = session_values(values, session.header.hand, session.header.recording_time.date())
        results = tuple(
            one for one in store.result_versions(session_id) if store.owner_id(one.session_id) == patient_id
        )
        drawn = wrist_curves(session), joint_curves(session)
        modelled = None if drawn[1] is None else project_markers(session.camera, session.markers.position_cam_m)
        figures = compute_session_results(session, choices, error_limits(history))
        return cls(session, choices, history, results, by_hand, *drawn, modelled, figures)

    def apply_choices(self, choices: RepetitionChoices) -> ReviewedSession:
        return replace(
            self, choices=choices, results=compute_session_results(self.session, choices, error_limits(self.history))
        )

    @property
    def id(self) -> str:
        return self.session.header.session_id

    @property
    def is_older(self) -> bool:
        """Whether a newer result version of the recording exists."""
        return bool(self.versions) and self.versions[-1].session_id != self.id

    @property
    def is_hand(self) -> bool:
        return self.joints is not None

    @property
    def end_time(self) -> datetime:
        return self.results.when + timedelta(seconds=self.results.duration_s)

    def find_repetitions(self, time_s: float) -> list[int]:
        return [n for n, one in enumerate(self.results.repetitions) if one.start_s - 1e-6 <= time_s <= one.end_s + 1e-6]

    # --- what is said of a moment -------------------------------------------------------------------------
    def angle_words(self, row: int) -> str:
        """Return the trained angle of a row, such as ``Flexion 24° ± 2°``; empty if not measured."""
        if self.curves.status[row] != TrackStatus.TRACKED:
            return ""
        exercise, joints = self.results.exercise, self.joints
        if joints is not None and exercise.joint in joints.names:
            column = joints.names.index(exercise.joint)
            value, sd = float(joints.angles_deg[row, column]), float(joints.sds_deg[row, column])
            return _angle_text(find_finger_angle(exercise.joint).long_name, value, sd)
        column = self._main_column
        return _wrist_text(
            exercise, column, float(self.curves.angles_deg[row, column]), float(self.curves.sds_deg[row, column])
        )

    def status_words(self, row: int, time_s: float) -> str:
        """Return how many markers are occluded, or for the wrist its angle."""
        if self.is_hand:
            hidden = int((~np.isfinite(self.session.markers.measured_px[row, :, 0])).sum())
            return _occlusion_words(hidden) if hidden else ""
        value, sd, _ = wrist_series(self.curves, self._main_column).read_value(time_s)
        return _wrist_text(self.results.exercise, self._main_column, value, sd)

    @property
    def _main_column(self) -> int:
        angle = self.results.exercise.angle
        return FLEXION if angle is None else angle

    # --- what a person chooses ----------------------------------------------------------------------------
    def include_repetition(self, number: int) -> RepetitionChoices:
        reasons = {n: words for n, words in self.choices.excluded.items() if n != number}
        if self.results.repetitions[number].exclusion_reason == PASSIVE:  # also if noted during the recording
            reasons[number] = ""
        return replace(self.choices, excluded=reasons)

    def exclude_repetition(self, number: int, reason: str, *, and_after: bool) -> RepetitionChoices:
        """Return the choices with a repetition, or all from it on, excluded or passive."""
        last = len(self.results.repetitions) if and_after else number + 1
        reasons = {**self.choices.excluded, **dict.fromkeys(range(number, last), reason)}
        return replace(self.choices, excluded=reasons)

    def set_edges(self, number: int, start_s: float, end_s: float) -> RepetitionChoices:
        return replace(self.choices, edges_s={**self.choices.edges_s, number: (start_s, end_s)})

    def nudge_edge(self, number: int, time_s: float, by_s: float) -> RepetitionChoices:
        one = self.results.repetitions[number]
        at_start = abs(time_s - one.start_s) <= abs(time_s - one.end_s)
        edge, at_s = ("start", one.start_s) if at_start else ("end", one.end_s)
        moved = move_edge(self.results.repetitions, number, edge, at_s + by_s)
        return self.set_edges(number, moved.start_s, moved.end_s)


def _occlusion_words(count: int) -> str:
    return tr("1 marker occluded") if count == 1 else tr("{count} markers occluded").format(count=count)


def _wrist_text(exercise: Exercise, column: int, value: float, sd: float) -> str:
    return _angle_text(terms.direction_name(column, value, exercise), value, sd)


def _angle_text(name: str, value: float, sd: float) -> str:
    return f"{name} {numbers.format_with_sd(value, sd)}" if math.isfinite(value) else ""
