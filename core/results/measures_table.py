"""Measures of a session as rows of one long table."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass

from carpus.core.model.hand.protocols import WRIST_ANGLES
from carpus.core.results.measure import is_total_active_motion
from carpus.core.results.norms import grade_share
from carpus.core.results.session_results import SessionResults
from carpus.core.results.task_measures import QUANTITIES


@dataclass(frozen=True, slots=True)
class MeasureRow:
    """Row of the table of measures; its fields are the columns of the files.

    ``of``: what was measured; ``positive``: what a larger value means, in all columns; ``estimate``: filter or
    smoother; ``sd``: between repetitions; ``measurement_sd``: of one value; ``at_least``: a lower bound; ``inferred``:
    a DIP joint without a marker is part of it. Unknown is NaN.
    """

    session: str
    session_id: str
    recording_id: str
    subject_id: str
    recorded: str
    simulated: bool
    hand: str
    protocol: str
    exercise: str
    duration_s: float
    frames: int
    tracked_share: float
    repetitions: int
    measure: str
    of: str
    unit: str
    mean: float
    sd: float = math.nan
    best: float = math.nan
    measurement_sd: float = math.nan
    count: int = 1
    at_least: bool = False
    seen_share: float = math.nan
    inferred: bool = False
    positive: str = ""
    estimate: str = ""

    @property
    def key(self) -> str:
        """Name of the measure without spaces, the same in every session."""
        return "_".join(re.findall(r"[a-z0-9]+", f"{self.of} {self.measure.partition(',')[0]}".lower()))

    @property
    def label(self) -> str:
        """Name and unit, for the axis of a figure."""
        unit = "" if self.unit in ("1", "") else f" ({self.unit})"
        return f"{self.of.replace('_', ' ')}, {self.measure}{unit}"


def build_measure_rows(results: SessionResults, session: str) -> tuple[MeasureRow, ...]:
    """Return all measures of a session whose file is called ``session``."""
    quality, rows = results.quality, list[MeasureRow]()
    common = (
        session, results.session_id, results.recording_id, results.subject_id,
        results.when.isoformat(timespec="seconds"), results.is_simulated, results.side, results.protocol,
        results.exercise.id, results.duration_s, quality.frames, quality.measured_share, results.repetition_count,
    )  # fmt: skip
    for one in results.measures:
        if one.group == "still" or (one.group == "speed" and not one.count):
            continue
        name = one.quantity
        if one.group == "share":
            name = ", ".join(filter(None, (name, grade_share(one))))
        elif one.group == "range" and one.wrist_angle < 0:  # an end of a joint or a total is no movement
            name = (_TOTAL_MEASURES if is_total_active_motion(one.subject) else _JOINT_MEASURES).get(name, name)
        positive = QUANTITIES[name].positive if one.group == "task" else _POSITIVE.get(name, "more")
        if name in _JOINT_MEASURES.values():
            positive = positive_direction(one.subject)
        rows.append(
            MeasureRow(
                *common, name, f"{one.subject}, passive" if one.is_passive else one.subject, one.unit, one.mean, one.sd,
                one.best, one.measurement_sd, one.count, one.is_lower_bound, one.seen_share, one.is_inferred,
                positive=positive,
                estimate="smoother" if results.is_smoothed else "filter",
            )
        )  # fmt: skip
    return tuple(rows)


MEASURE_COLUMNS = {
    "measure": "what was measured. Of the wrist flexion, extension, radial, ulnar, supination, pronation each count "
    "in their own direction; below 0 neutral was not reached. Supination and pronation are of the forearm, from thumb "
    "up: a palm flat on the table is at 90 deg of pronation. Of a joint largest and smallest are angles with the sign "
    "of the joint. arc is a size; speeds, times, units, pauses and smoothness are of single strokes, one way, where "
    "the table of repetitions has both ways together; of a whole finger (TAM) total active motion, flexion and "
    "extension deficit",
    "of": 'of which angle, joint, disc or finger; with ", passive" of the repetitions in which somebody else moved the '
    "hand: they are in no other row",
    "positive": "what a larger figure means, the same for mean, best and every column of the row",
    "estimate": "filter or smoother: of whose angles; the smoother's where it ran",
    "mean sd best measurement_sd": "in the unit of the row; sd between repetitions, measurement_sd of one value",
    "count": "how many are in the mean",
    "at_least": "yes where the camera's view limits it: a lower bound",
    "seen_share": "share of the frames in which it was seen, of joints; empty for the wrist",
    "inferred": "yes where an end joint that no disc measures is part of it",
}

_JOINT_MEASURES = {"flexion": "largest", "extension": "smallest"}
_POSITIVE = {
    "flexion": "flexed", "extension": "extended", "radial": "radial", "ulnar": "ulnar",
    "supination": "supinated, 0 is thumb up", "pronation": "pronated, 0 is thumb up",
    "extension deficit": "further from straight", "smoothness": "smoother",
}  # fmt: skip
_TOTAL_MEASURES = {"arc": "total active motion", "extension": "extension deficit"}


def positive_direction(angle: str) -> str:
    """Return what a larger value of an angle of the wrist or of a joint means.

    >>> positive_direction("deviation"), positive_direction("MCP2_abduction"), positive_direction("CMC1_extension")
    ('radial', 'to the thumb', 'thumb away from the index finger in the plane of the palm')
    >>> positive_direction("pronosupination")
    'supinated, 0 is palm down'
    """
    if angle in WRIST_ANGLES:
        return ("radial", "flexed", "supinated, 0 is palm down")[WRIST_ANGLES.index(angle)]
    if angle == "CMC1_extension":
        return "thumb away from the index finger in the plane of the palm"
    if angle == "CMC1_abduction":
        return "thumb away from the palm"
    joint, _, kind = angle.partition("_")
    return {"flexion": "flexed", "abduction": "to the thumb" if joint[-1:] != "1" else "thumb abducted"}.get(kind, "")
