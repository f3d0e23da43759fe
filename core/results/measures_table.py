"""Measures of a session as rows of one long table."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

from carpus.core.model.hand.protocols import WRIST_ANGLES
from carpus.core.results.measure import Measure, is_total_active_motion
from carpus.core.results.norms import grade_share
from carpus.core.results.session_results import SessionResults


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


def build_measure_rows(figures: SessionResults, session: str) -> tuple[MeasureRow, ...]:
    """Return all measures of a session whose file is called ``session``."""
    estimate = "smoother" if figures.is_smoothed else "filter"
    return tuple(replace(row, estimate=estimate, positive=_row_direction(row)) for row in _rows(figures, session))


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


def _row_direction(row: MeasureRow) -> str:
    if row.measure in ("largest", "smallest"):
        return positive_direction(row.of.partition(",")[0])
    words = {
        "flexion": "flexed", "extension": "extended", "radial": "radial", "ulnar": "ulnar",
        "supination": "supinated, 0 is thumb up", "pronation": "pronated, 0 is thumb up",
        "extension deficit": "further from straight", "smoothness": "smoother",
        "jerk": "smoother",
    }  # fmt: skip
    return words.get(row.measure, "more")


def _table_name(row: Measure) -> str:
    """Return a measure's name in the table; ends of joints and totals are not movements."""
    if row.group == "share":
        return ", ".join(filter(None, (row.quantity, grade_share(row))))
    if row.group != "range" or row.wrist_angle >= 0:
        return row.quantity
    return (_TOTAL_MEASURES if is_total_active_motion(row.subject) else _JOINT_MEASURES).get(row.quantity, row.quantity)


def _rows(figures: SessionResults, session: str) -> Iterator[MeasureRow]:
    quality = figures.quality
    common = (
        session, figures.session_id, figures.recording_id, figures.subject_id,
        figures.when.isoformat(timespec="seconds"), figures.is_simulated, figures.side, figures.protocol,
        figures.exercise.id, figures.duration_s, quality.frames, quality.measured_share, figures.repetition_count,
    )  # fmt: skip
    for row in figures.measures:
        if row.group == "still" or (row.group == "speed" and not row.count):
            continue
        yield MeasureRow(
            *common,
            _table_name(row),
            f"{row.subject}, passive" if row.is_passive else row.subject,
            row.unit,
            row.mean,
            row.sd,
            row.best,
            row.measurement_sd,
            row.count,
            row.is_lower_bound,
            row.seen_share,
            row.is_inferred,
        )
