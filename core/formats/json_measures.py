"""JSON of the measures: every figure of a session with its unit, repetitions, quality and provenance."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import Any

from carpus.core.formats.csv_tables import repetition_table
from carpus.core.formats.new_output import new_json
from carpus.core.formats.take import ANGLES_MEAN, Take
from carpus.core.hand.exercises import SIDES, Movement
from carpus.core.measures.by_hand import COLUMNS, rows_of
from carpus.core.results.figures import SessionFigures
from carpus.core.results.measures_table import measure_rows
from carpus.core.results.norms import Norm, total_norm, wrist_norm

_OF_THE_SESSION = (
    "session", "session_id", "recording_id", "subject_id", "recorded", "simulated", "hand", "protocol", "exercise",
    "duration_s", "frames", "tracked_share", "repetitions",
)  # fmt: skip


def write(take: Take, folder: Path) -> list[Path]:
    """Write ``NAME.measures.json``; the file."""
    return [new_json(folder / f"{take.name}.measures.json", content(take))]


def content(take: Take) -> dict[str, Any]:
    """All of it as plain values; numbers that are not known are null in the file."""
    figures, header = take.figures, take.session.header
    rows = [asdict(row) for row in measure_rows(figures, take.name)]
    quality, columns = figures.quality, repetition_table(take.session, figures)
    return {
        "session": {
            "name": take.name,
            "session_id": header.session_id,
            "recording_id": header.recording_id,
            "subject_id": header.subject_id,
            "recorded": take.provenance.get("recorded", ""),
            "simulated": header.simulated,
            "hand": header.hand,
            "protocol": header.protocol.name,
            "exercise": header.exercise,
            "duration_s": figures.duration_s,
            "frames": quality.frames,
            "tracked_share": quality.measured_share,
            "hidden_share": quality.hidden_share,
            "dropped_frames": quality.dropped,
            "smoothed": figures.smoothed,
            "counted": not figures.not_counted,
        },
        "angles": ANGLES_MEAN,
        "measures": [{name: row[name] for name in row if name not in _OF_THE_SESSION} for row in rows],
        "norms": norms_of(figures),
        "repetitions": [
            dict(zip(columns, row, strict=True))
            for row in zip(*(values.tolist() for values in columns.values()), strict=True)
        ],
        "pain": [
            {"since_start_s": at, "score": score} for at, score in zip(figures.pain_s, figures.pain, strict=False)
        ],
        "entered_by_hand": [dict(zip(COLUMNS, row, strict=True)) for row in rows_of(take.by_hand)],
        "doubtful_at_calibration": [finding.kind for finding in figures.findings],
        "provenance": take.provenance,
    }


def norms_of(figures: SessionFigures) -> list[dict[str, Any]]:
    """Usual values that stand beside figures of this session, each with its source, ages and sexes."""
    angle = figures.exercise.angle
    wrist: list[tuple[str, Norm | None]] = []
    if angle is not None:
        ways: tuple[Movement, ...] = ("arc", *SIDES[angle])
        wrist = [(movement, wrist_norm(movement, angle, figures.exercise)) for movement in ways]
    totals = sorted({share.of for share in figures.group("share")})
    both = [*wrist, *((of, total_norm(int(of[3:]), figures.exercise)) for of in totals)]
    return [{"of": of} | asdict(norm) for of, norm in both if norm is not None]
