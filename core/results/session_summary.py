"""Summary of a session or recording as plain lines for ``carpus info``."""

from __future__ import annotations

import math
from collections import Counter
from pathlib import Path

import numpy as np

from carpus.core.calibration.result import finding_sentence
from carpus.core.capture.camera_info import CAMERA_FILE
from carpus.core.capture.files.tum import TumFolder
from carpus.core.capture.source import SourceInfo, is_simulated
from carpus.core.model.camera import Camera
from carpus.core.model.depth_sensor import ASSUMED, DepthSensor
from carpus.core.model.hand.exercises import DIRECTIONS, EXERCISES
from carpus.core.model.hand.forearm_rotation import to_clinical_rad
from carpus.core.model.hand.protocols import WRIST_ANGLES
from carpus.core.model.rounding import format_rounded
from carpus.core.model.types import FloatArray, TrackStatus
from carpus.core.platform.provenance import parameter_section
from carpus.core.results.repetition_rows import RepetitionChoices
from carpus.core.results.session_results import SessionResults, compute_session_results, parse_camera
from carpus.core.session.reader import has_raw
from carpus.core.session.values import Session

_TYPICAL_DISTANCE_M = 0.7
"""Camera to hand."""


def session_summary(session: Session, choices: RepetitionChoices | None = None) -> list[str]:
    """Return all lines of a session file, identity first and settings last."""
    header, figures = session.header, compute_session_results(session, choices)
    events = Counter(event.kind for event in session.events)
    lines = [
        *identity_lines(session),
        "Range of motion (TAM: total active motion; >=, <=: limited by the camera's view)",
        *range_lines(figures),
        *repetition_lines(figures),
        *_calibration_lines(session),
        _line("Camera", camera_text(session.camera) + _calibration_age(header.parameters)),
        _line("Sensor", sensor_text(session.camera.sensor)),
        _line("Smoothed", "yes" if session.smoothed is not None else "no"),
        _line("Video", "saved" if has_raw(session.path) else "not saved"),
        _line("Events", ", ".join(f"{count} {kind}" for kind, count in events.items()) or "none"),
        *_provenance_lines(session),
        _line("Settings", "carpus info --json FILE shows them"),
    ]
    if header.origin:
        lines.append(_line("Origin", f"tracked again from {header.origin}"))
    return lines


def identity_lines(session: Session) -> list[str]:
    """Return what a session is of, how long it is and how it was tracked."""
    header, completeness = session.header, "yes"
    if session.recovered:
        completeness = f"cut short and recovered {session.recovered}; at most the last second is missing; more only "
        completeness += "where the figures came late"
    return [
        _line("Session", str(session.path)),
        _line("Identity", f"{header.session_id}, written by Carpus {header.software_version}"),
        _line("Patient", f"{header.subject_id or 'not given'}, {header.hand} hand"),
        _line("Exercise", header.exercise or "not given"),
        _line("Recorded", header.recorded or "not known"),
        _line("Created", header.created),
        _line("Recording", header.recording_id),
        _line("Markers", f"{header.protocol.name}: {' '.join(header.protocol.markers)}"),
        *([_line("Source", "simulated: nobody's movement was measured")] if header.is_simulated else []),
        _line("Complete", completeness),
        *_frame_lines(session.timestamp_s, np.maximum(session.quality.dropped_before, 0)),
        _line("Tracking", _status_shares(session)),
    ]


def recording_summary(folder: Path, recording: TumFolder) -> list[str]:
    """Return frames, gaps, depth and camera of a TUM folder."""
    times = np.array([stored.timestamp_s for stored in recording.stored_frames])
    dropped = np.array([stored.dropped_before for stored in recording.stored_frames])
    with_depth = sum(stored.depth is not None for stored in recording.stored_frames)
    camera = recording.info.camera
    return [
        _line("Recording", f"{folder}, a TUM RGB-D folder"),
        *([_line("Source", "simulated")] if is_simulated(recording.info) else []),
        *_frame_lines(times, dropped),
        _line("Depth", f"{with_depth} of {len(times)} frames have a depth picture"),
        _line("Camera", camera_text(camera, f"no {CAMERA_FILE}")),
        _line("Sensor", sensor_text(camera.sensor)),
    ]


def source_summary(path: Path, info: SourceInfo) -> list[str]:
    """Return what is known of a recording without playing it."""
    count = "not known before it is played" if info.frame_count is None else str(info.frame_count)
    return [
        _line("Recording", str(path)),
        _line("Frames", f"{count}, {format_rounded(info.nominal_fps, 1)} a second"),
        _line("Depth", "yes" if info.has_depth else "no"),
        _line("Camera", camera_text(info.camera)),
        _line("Sensor", sensor_text(info.camera.sensor)),
        *(_line(name.replace("_", " ").capitalize(), value) for name, value in sorted(info.settings.items())),
    ]


def duration_text(duration_s: float) -> str:
    """Format minutes and seconds.

    >>> duration_text(83.24), duration_text(59.96), duration_text(6000.04)
    ('01:23.2', '01:00.0', '100:00.0')
    """
    minutes, seconds = divmod(round(duration_s, 1), 60.0)
    return f"{int(minutes):02d}:{seconds:04.1f}"


def camera_text(camera: Camera, without_file: str = "no camera file") -> str:
    """Format size and intrinsics of a camera, and where they come from."""
    sources = {
        "file": "from a calibration",
        "calibration": "from the camera's own calibration",
        "driver": "from the driver's field of view",
        "factory": "from the maker's calibration",
    }
    source = sources.get(camera.origin, f"usual values, {without_file}")
    named = {"fx": camera.fx_px, "fy": camera.fy_px, "cx": camera.cx_px, "cy": camera.cy_px}
    numbers = ", ".join(f"{name} {format_rounded(value, 2)}" for name, value in named.items())
    distortion = ", distorted" if camera.is_distorted else ""
    return f"{camera.width_px} x {camera.height_px} pixels, {numbers}{distortion} ({source})"


def sensor_text(sensor: DepthSensor) -> str:
    """Format the depth sensor and the standard deviation of its readings."""
    sd_mm = 1e3 * float(sensor.reading_sd_m(np.array(_TYPICAL_DISTANCE_M)))
    assumed = ", assumed: nobody said which" if sensor.origin == ASSUMED else ""
    within = f"a reading at {format_rounded(_TYPICAL_DISTANCE_M * 100)} cm within {format_rounded(sd_mm, 1)} mm"
    return f"{sensor.name}, {sensor.kind}, {within}{assumed}"


def _line(title: str, text: str) -> str:
    return f"{title:<12} {text}"


def _calibration_age(parameters: str) -> str:
    """Format the day and age of the calibration with a board, empty without one.

    >>> _calibration_age('{"source": {"calibrated": "2026-11-20T08:00:00+00:00", "calibration_age_days": "2.0"}}')
    '; calibrated 2026-11-20, 2 days before'
    """
    camera = parse_camera(parameters)
    known = camera.calibrated_at and math.isfinite(camera.age_days)
    return f"; calibrated {camera.calibrated_at[:10]}, {format_rounded(camera.age_days)} days before" if known else ""


def _frame_lines(timestamp_s: FloatArray, dropped: np.ndarray) -> list[str]:
    count = len(timestamp_s)
    if count < 2:
        return [_line("Frames", str(count))]
    duration_s = float(timestamp_s[-1] - timestamp_s[0])
    rate = f"{format_rounded(1.0 / float(np.median(np.diff(timestamp_s))), 1)} a second"
    missing, places = int(dropped.sum()), int(np.count_nonzero(dropped))
    gaps = f"{_count_text(missing, 'frame')} missing in {_count_text(places, 'place')}" if missing else "none"
    return [_line("Frames", f"{count} in {duration_text(duration_s)}, {rate}"), _line("Gaps", gaps)]


def _count_text(number: int, thing: str) -> str:
    return f"{number} {thing}" + ("" if number == 1 else "s")


def _status_shares(session: Session) -> str:
    count = max(len(session), 1)
    frames = {status: np.count_nonzero(session.status == status) for status in TrackStatus}
    if not frames[TrackStatus.DOUBTFUL]:
        del frames[TrackStatus.DOUBTFUL]
    return ", ".join(
        f"{status.name.lower()} {format_rounded(100.0 * number / count, 1)} %" for status, number in frames.items()
    )


def range_lines(results: SessionResults) -> list[str]:
    """Return the ranges of wrist angles, joints and fingers as the table of results has them."""
    lines, rows = [], (*results.wrist_ranges, *results.joint_ranges)
    for subject in dict.fromkeys(row.subject for row in rows):
        known = [row for row in rows if row.subject == subject and row.count]
        parts = [f"{row.quantity} {row.comparator}{format_rounded(row.mean, 1)}°" for row in known]
        if known and results.repetition_count:
            parts.append(f"mean of {_count_text(known[0].count, 'repetition')}")
        if known and math.isfinite(known[0].seen_share):
            parts.append(f"visible {format_rounded(100.0 * known[0].seen_share)} %")
        if any(row.is_inferred for row in known):
            parts.append("DIP not measured")
        lines.append(f"  {subject:<18} {', '.join(parts) or 'not measured'}")
    return lines or ["  not measured"]


MIN_ARC_DEG, MAIN_ARC_RATIO = 15.0, 3.0
"""An angle that moved this far, and so many times as far as the trained one, is what the hand did."""


def exercise_warnings(session: Session, figures: SessionResults) -> list[str]:
    """Return sentences about an exercise that is unknown, or that the hand did not do."""
    exercise = session.header.exercise
    if not exercise:
        lacking = "no exercise is known, so repetitions, speed and smoothness are not measured"
        return [f"{lacking}; --exercise names it, or “exercise” in the file of clicks."]
    out, trained = [], figures.exercise.angle
    known = session.motion.angles_rad[np.isfinite(session.motion.angles_rad).all(axis=1)]
    if trained is not None and len(known):
        arcs_deg = np.degrees(np.subtract(*np.percentile(known, (99.0, 1.0), axis=0)))
        main = int(np.argmax(arcs_deg))
        if arcs_deg[main] > max(MIN_ARC_DEG, MAIN_ARC_RATIO * arcs_deg[trained]):
            meant = next(one.id for one in EXERCISES if one.angle == main)
            arcs = [format_rounded(arcs_deg[k]) for k in (main, trained)]
            out.append(
                f"the hand moved {arcs[0]}° in {WRIST_ANGLES[main]} and {arcs[1]}° in {WRIST_ANGLES[trained]}, which "
                f"{exercise} trains; if the exercise was another, track again with --exercise {meant}."
            )
    if figures.exercise.has_repetitions and not figures.repetition_count:
        out.append(f"no repetition of {exercise} is counted.")
    return out


def repetition_lines(figures: SessionResults) -> list[str]:
    """Return a line for each repetition."""
    lines = []
    for number, one in enumerate(figures.repetitions, 1):
        row = one.row
        least = "at least " if row.at_least else ""
        start, end = (
            format_rounded(time_s, 2) if math.isfinite(time_s) else "?" for time_s in (row.start_s, row.end_s)
        )
        parts = [f"{start} to {end} s"]
        if math.isfinite(row.arc_rad):
            parts.append(f"arc {least}{format_rounded(math.degrees(row.arc_rad), 1)} deg")
        if math.isfinite(row.peak_speed_rad_s):
            parts.append(f"peak {format_rounded(math.degrees(row.peak_speed_rad_s))} deg/s")
        if math.isfinite(row.sparc):
            parts.append(f"SPARC {format_rounded(row.sparc, 2)}")
        if row.pauses > 0:
            parts.append(f"{format_rounded(row.pauses)} stops of {format_rounded(row.pause_s, 1)} s in all")
        parts += [] if row.counted else [f"not counted: {row.reason.replace('_', ' ')}"]
        lines.append(_line("Repetition" if number == 1 else "", f"{number}: {', '.join(parts)}"))
    return lines


def _angle_text(angle: int, angle_deg: float) -> str:
    positive, negative = DIRECTIONS[angle]
    return f"{format_rounded(abs(angle_deg), 1)}° {positive if angle_deg >= 0.0 else negative}"


def _calibration_lines(session: Session) -> list[str]:
    calibration = session.calibration
    verdict = calibration.verdict
    facts = [
        (verdict.hand_length_mm, f"hand {format_rounded(verdict.hand_length_mm)} mm"),
        (verdict.distance_m, f"{format_rounded(verdict.distance_m, 2)} m from the camera"),
        (verdict.tilt_deg, f"tilted {format_rounded(verdict.tilt_deg)}°"),
    ]
    residual_mm = verdict.residual_mm[np.isfinite(verdict.residual_mm)]
    if residual_mm.size:
        facts.append((0.0, f"markers within {format_rounded(residual_mm.max(), 1)} mm"))
    known = [text for value, text in facts if np.isfinite(value)]
    if verdict.frames_used:
        known.append(f"from {verdict.frames_used} still pictures")
    lines = [_line("Calibration", ", ".join(known) or "not described")]
    lines += [f"  doubtful: {finding_sentence(finding)}" for finding in verdict.findings]
    start_deg = np.degrees(calibration.start_angles_rad)
    if np.any(np.isfinite(start_deg) & (start_deg != 0.0)):
        read_rad = [to_clinical_rad(WRIST_ANGLES[k], angle) for k, angle in enumerate(calibration.start_angles_rad)]
        given = ", ".join(_angle_text(angle, math.degrees(float(start))) for angle, start in enumerate(read_rad))
        lines.append(f"  Start angles as given by the therapist: {given}.")
    return lines


def _provenance_lines(session: Session) -> list[str]:
    """Return revision, recording and settings, as far as the session states them."""
    provenance, source = (parameter_section(session.header.parameters, part) for part in ("provenance", "source"))
    camera = parse_camera(session.header.parameters)
    calibrated = camera.calibrated_at and f"{camera.calibrated_at}, {format_rounded(camera.age_days)} days before"
    facts = (
        ("Calibrated", calibrated or (camera.serial and "not with a board")),
        ("Revision", provenance.get("revision")),
        ("Of", source.get("sha256") and f"a recording with SHA-256 {source['sha256']}"),
        ("Set", provenance.get("settings_sha256") and f"by settings with SHA-256 {provenance['settings_sha256']}"),
    )
    return [_line(title, str(text)) for title, text in facts if text]
