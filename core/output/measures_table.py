"""The measures of a session as rows of one long table: every figure with what it is of, its unit and its session."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

from carpus.core.hand.sites import WRIST_ANGLES
from carpus.core.output.report_content import SessionFigures, Spread


@dataclass(frozen=True, slots=True)
class MeasureRow:
    """One figure of one session. ``measure`` and ``of``: the arc of flexion, the peak speed of the trained angle;
    ``mean``, ``sd`` between repetitions, ``best``, ``measurement_sd`` of one value, over ``count`` of them;
    ``at_least`` where the camera's view limits it; ``seen_share`` of the frames; ``inferred`` where an end joint that
    no disc measures is part of it. ``camera_not_sure``: ``lengths``, ``angles`` or both where a check of the camera
    near the session was out. Unknown is NaN."""

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
    sd: float
    best: float
    measurement_sd: float
    count: int
    at_least: bool
    seen_share: float
    inferred: bool
    camera_not_sure: str = ""


def measure_rows(figures: SessionFigures, session: str) -> tuple[MeasureRow, ...]:
    """All measures of a session whose file is called ``session``."""
    return tuple(replace(row, camera_not_sure=figures.camera.not_sure) for row in _rows(figures, session))


def _rows(figures: SessionFigures, session: str) -> Iterator[MeasureRow]:
    quality = figures.quality
    common = (
        session, figures.session_id, figures.recording_id, figures.subject_id,
        figures.when.isoformat(timespec="seconds"), figures.simulated, figures.side, figures.protocol,
        figures.exercise.id, figures.duration_s, quality.frames, quality.measured_share, figures.counted,
    )  # fmt: skip
    for row in (*figures.rows, *figures.joint_rows):
        yield MeasureRow(
            *common, row.movement, row.joint or WRIST_ANGLES[row.angle], "deg", row.mean_deg, row.sd_deg, row.best_deg,
            row.measurement_sd_deg, row.count, row.limited, row.seen_share, row.inferred,
        )  # fmt: skip
    trained: tuple[tuple[str, str, Spread], ...] = (
        ("peak speed", "deg/s", figures.peak_speed), ("smoothness", "SPARC", figures.smoothness),
        *(
            () if figures.speed is None else (
                ("mean speed", "deg/s", figures.speed.mean_speed), ("movement time", "s", figures.speed.movement_time),
                ("time to peak", "share", figures.speed.time_to_peak), ("movement units", "1", figures.speed.peaks),
                ("jerk", "LDLJ", figures.speed.ldlj),
            )
        ),
    )  # fmt: skip
    for item in figures.further:
        yield MeasureRow(
            *common, item.name, item.of, item.unit, item.mean, item.sd, math.nan, math.nan, item.count,
            False, math.nan, False,
        )  # fmt: skip
    for grade in figures.grades:
        yield MeasureRow(
            *common, f"share of the usual TAM{f', {grade.grade}' if grade.grade else ''}", f"TAM{grade.finger}",
            "share", grade.share, math.nan, math.nan, math.nan, 1, grade.grade is None, math.nan, False,
        )  # fmt: skip
    for measure, unit, spread in trained:
        if spread.count:
            yield MeasureRow(
                *common, measure, "trained angle", unit, spread.mean, spread.sd, spread.best, spread.measurement_sd,
                spread.count,
                False, math.nan, False,
            )  # fmt: skip
