"""JSON of the measures: every measure of a session with unit, repetitions, quality and provenance."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import Any

from carpus.core.formats.csv_tables import build_repetition_table
from carpus.core.formats.export_item import ANGLE_DEFINITIONS, ExportItem
from carpus.core.formats.measures_table import build_measure_rows
from carpus.core.formats.output_files import write_new_json
from carpus.core.measures.manual_measurements import COLUMNS, to_rows
from carpus.core.model.hand.exercises import DIRECTIONS, Movement
from carpus.core.results.norms import Norm, total_norm, wrist_norm
from carpus.core.results.session_results import SessionResults

_SESSION_COLUMNS = (
    "session", "session_id", "recording_id", "subject_id", "recorded", "simulated", "hand", "protocol", "exercise",
    "duration_s", "frames", "tracked_share", "repetitions",
)  # fmt: skip


def write(take: ExportItem, folder: Path) -> list[Path]:
    """Write ``NAME.measures.json``; return its path."""
    return [write_new_json(folder / f"{take.name}.measures.json", measures_content(take))]


def measures_content(take: ExportItem) -> dict[str, Any]:
    """Return the content as plain values; unknown numbers become null."""
    figures, header = take.results, take.session.header
    rows = [asdict(row) for row in build_measure_rows(figures, take.name)]
    quality, columns = figures.quality, build_repetition_table(take.session, figures)
    return {
        "session": {
            "name": take.name,
            "session_id": header.session_id,
            "recording_id": header.recording_id,
            "subject_id": header.subject_id,
            "recorded": take.provenance.get("recorded", ""),
            "simulated": header.is_simulated,
            "hand": header.hand,
            "protocol": header.protocol.name,
            "exercise": header.exercise,
            "duration_s": figures.duration_s,
            "frames": quality.frames,
            "tracked_share": quality.measured_share,
            "hidden_share": quality.hidden_share,
            "dropped_frames": quality.dropped_frames,
            "smoothed": figures.is_smoothed,
            "counted": not figures.is_excluded,
        },
        "angles": ANGLE_DEFINITIONS,
        "measures": [{name: row[name] for name in row if name not in _SESSION_COLUMNS} for row in rows],
        "norms": list_norms(figures),
        "repetitions": [
            dict(zip(columns, row, strict=True))
            for row in zip(*(values.tolist() for values in columns.values()), strict=True)
        ],
        "pain": [
            {"since_start_s": at, "score": score}
            for at, score in zip(figures.pain_times_s, figures.pain_scores, strict=False)
        ],
        "entered_by_hand": [dict(zip(COLUMNS, row, strict=True)) for row in to_rows(take.manual_measurements)],
        "doubtful_at_calibration": [finding.kind for finding in figures.findings],
        "provenance": take.provenance,
    }


def list_norms(figures: SessionResults) -> list[dict[str, Any]]:
    """Return the reference ranges shown with this session, with source, ages and sexes."""
    angle = figures.exercise.angle
    wrist: list[tuple[str, Norm | None]] = []
    if angle is not None:
        ways: tuple[Movement, ...] = ("arc", *DIRECTIONS[angle])
        wrist = [(movement, wrist_norm(movement, angle, figures.exercise)) for movement in ways]
    totals = sorted({share.subject for share in figures.measures_in_group("share")})
    both = [*wrist, *((of, total_norm(int(of[3:]), figures.exercise)) for of in totals)]
    return [{"of": of} | asdict(norm) for of, norm in both if norm is not None]
