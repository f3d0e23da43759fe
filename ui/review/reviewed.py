"""One session as it is looked at: read and worked out in the background, and what is said of it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from datetime import datetime, timedelta
from typing import TYPE_CHECKING

import numpy as np

from carpus.core.hand.exercises import FLEXION, Exercise
from carpus.core.measures.by_hand import HandValue, of_session
from carpus.core.records.values import SessionEntry, unless_away
from carpus.core.results.figures import SessionFigures, session_figures
from carpus.core.results.motion_curves import MotionCurves, motion_curves
from carpus.core.results.progress import limits_of
from carpus.core.results.repetition_rows import PASSIVE, RepetitionChoices
from carpus.core.results.seen import JointCurves, ReportCurves, joint_curves, session_curves
from carpus.core.session.values import Session
from carpus.core.types import FloatArray, TrackStatus
from carpus.ui import numbers, terms
from carpus.ui.figures import figure_of
from carpus.ui.playback.pictures import modelled_px
from carpus.ui.plot.session import value_at, with_edge
from carpus.ui.translate import tr

if TYPE_CHECKING:  # it reads and writes files
    from carpus.core.records.library import Library


@dataclass(frozen=True, slots=True)
class Reviewed:
    """A session with the figures that a person's choices give; ``joints`` of the whole hand alone, and with them
    ``modelled_px``, where the model has every marker in every picture."""

    session: Session
    choices: RepetitionChoices
    history: Sequence[SessionFigures]
    results: Sequence[SessionEntry]
    by_hand: Sequence[HandValue]
    curves: ReportCurves
    joints: JointCurves | None
    motion: MotionCurves
    modelled_px: FloatArray | None
    figures: SessionFigures

    @classmethod
    def read(cls, store: Library, patient_id: str, session_id: str) -> Reviewed:
        """All of it, in the background."""
        session, choices = store.session(session_id), store.choices(session_id)
        history = unless_away(lambda: store.history(patient_id), ())
        values = unless_away(lambda: store.by_hand(patient_id), ())
        by_hand = of_session(values, session.header.hand, session.header.when.date())
        results = tuple(one for one in store.results_of(session_id) if store.owner(one.session_id) == patient_id)
        drawn = session_curves(session), joint_curves(session), motion_curves(session)
        modelled = None if drawn[1] is None else modelled_px(session.camera, session.markers.position_cam_m)
        figures = session_figures(session, choices, limits_of(history))
        return cls(session, choices, history, results, by_hand, *drawn, modelled, figures)

    def chosen(self, choices: RepetitionChoices) -> Reviewed:
        return replace(self, choices=choices, figures=session_figures(self.session, choices, limits_of(self.history)))

    @property
    def id(self) -> str:
        return self.session.header.session_id

    @property
    def is_older(self) -> bool:
        """Whether another result of the recording counts, which is newer."""
        return bool(self.results) and self.results[-1].session_id != self.id

    @property
    def is_hand(self) -> bool:
        return self.joints is not None

    @property
    def saved_at(self) -> datetime:
        return self.figures.when + timedelta(seconds=self.figures.duration_s)

    def under(self, time_s: float) -> list[int]:
        return [n for n, one in enumerate(self.figures.repetitions) if one.start_s - 1e-6 <= time_s <= one.end_s + 1e-6]

    # --- what is said of a moment -------------------------------------------------------------------------
    def angle_words(self, row: int) -> str:
        """``Flexion 24° ± 2°``: the trained angle of a row that was measured, else nothing."""
        if self.curves.status[row] != TrackStatus.TRACKED:
            return ""
        exercise, joints = self.figures.exercise, self.joints
        if joints is not None and exercise.joint in joints.names:
            column = joints.names.index(exercise.joint)
            value, sd = float(joints.angles_deg[row, column]), float(joints.sds_deg[row, column])
            return _said(figure_of(exercise.joint).long_name, value, sd)
        column = self._trained
        return _wrist_said(
            exercise, column, float(self.curves.angles_deg[row, column]), float(self.curves.sds_deg[row, column])
        )

    def measured_words(self, row: int, time_s: float) -> str:
        """Of the whole hand how many discs are hidden, of the wrist its angle at a time."""
        if self.is_hand:
            hidden = int((~np.isfinite(self.session.markers.measured_px[row, :, 0])).sum())
            return _hidden_words(hidden) if hidden else ""
        return _wrist_said(self.figures.exercise, self._trained, *value_at(self.curves, self._trained, time_s))

    @property
    def _trained(self) -> int:
        angle = self.figures.exercise.angle
        return FLEXION if angle is None else angle

    # --- what a person chooses ----------------------------------------------------------------------------
    def counting(self, number: int) -> RepetitionChoices:
        reasons = {n: words for n, words in self.choices.left_out.items() if n != number}
        if self.figures.repetitions[number].reason == PASSIVE:  # also where that was said while it was measured
            reasons[number] = ""
        return replace(self.choices, left_out=reasons)

    def left_out(self, number: int, reason: str, *, and_after: bool) -> RepetitionChoices:
        """A repetition, or all from it on, does not count for a reason, or counts as passive."""
        last = len(self.figures.repetitions) if and_after else number + 1
        reasons = {**self.choices.left_out, **dict.fromkeys(range(number, last), reason)}
        return replace(self.choices, left_out=reasons)

    def with_edges(self, number: int, start_s: float, end_s: float) -> RepetitionChoices:
        return replace(self.choices, edges_s={**self.choices.edges_s, number: (start_s, end_s)})

    def nudged(self, number: int, time_s: float, by_s: float) -> RepetitionChoices:
        one = self.figures.repetitions[number]
        at_start = abs(time_s - one.start_s) <= abs(time_s - one.end_s)
        edge, at_s = ("start", one.start_s) if at_start else ("end", one.end_s)
        moved = with_edge(one, edge, at_s + by_s)
        return self.with_edges(number, moved.start_s, moved.end_s)


def _hidden_words(count: int) -> str:
    return tr("1 marker hidden") if count == 1 else tr("{count} markers hidden").format(count=count)


def _wrist_said(exercise: Exercise, column: int, value: float, sd: float) -> str:
    return _said(terms.direction_name(column, value, exercise), value, sd)


def _said(name: str, value: float, sd: float) -> str:
    return f"{name} {numbers.with_spread(value, sd)}" if math.isfinite(value) else ""
