"""What a session or a recording holds, as plain lines for ``carpus info``."""

from __future__ import annotations

import math
from collections import Counter
from dataclasses import replace
from pathlib import Path

import numpy as np

from carpus.core.calibration.result import finding_sentence
from carpus.core.camera import Camera
from carpus.core.capture.camera_info import CAMERA_FILE
from carpus.core.capture.files.tum import TumFolder
from carpus.core.capture.source import SourceInfo, is_simulated
from carpus.core.depth_sensor import ASSUMED, DepthSensor
from carpus.core.hand.exercises import PRONOSUPINATION, SIDES
from carpus.core.hand.forearm_rotation import as_read_rad, is_from_thumb_up
from carpus.core.hand.protocols import WRIST_ANGLES
from carpus.core.provenance import said_in
from carpus.core.results.camera_said import camera_said
from carpus.core.results.figures import SessionFigures, session_figures
from carpus.core.results.measure import is_total
from carpus.core.results.repetition_rows import RepetitionChoices
from carpus.core.rounding import written
from carpus.core.session.reader import has_raw
from carpus.core.session.values import Session
from carpus.core.types import FloatArray, TrackStatus

_USUAL_M = 0.7
"""Camera to hand."""
LIMITED = ", limited by the camera's view"
FREE_MOVEMENT = "FREE"


def session_summary(session: Session, choices: RepetitionChoices | None = None) -> list[str]:
    """Everything a person asks of a session file, the identity first and the settings last."""
    header, quality, figures = session.header, session.quality, session_figures(session, choices)
    lines = [
        _line("Session", str(session.path)),
        _line("Identity", f"{header.session_id}, written by Carpus {header.software_version}"),
        _line("Patient", f"{header.subject_id or 'not given'}, {header.hand} hand"),
        _line("Exercise", header.exercise or "not given"),
        _line("Recorded", header.recorded or "not known"),
        _line("Created", header.created),
        _line("Recording", header.recording_id),
        _line("Markers", f"{header.protocol.name}: {' '.join(header.protocol.markers)}"),
        *([_line("Source", "simulated: nobody's movement was measured")] if header.simulated else []),
        _line("Complete", _completeness(session)),
        *_frames(session.timestamp_s, np.maximum(quality.dropped_before, 0)),
        _line("Tracking", _shares(session)),
        "Range of motion",
        *range_lines(session, figures),
        *_joint_ranges(session, figures),
        *repetition_lines(figures),
        *_calibration(session),
        _line("Camera", camera_text(session.camera) + _calibrated(header.parameters)),
        _line("Sensor", sensor_text(session.camera.sensor)),
        _line("Smoothed", "yes" if session.smoothed is not None else "no"),
        _line("Pictures", "kept" if has_raw(session.path) else "not kept"),
        _line("Events", _events(session)),
        *_provenance(session),
        _line("Settings", "carpus info --json FILE shows them"),
    ]
    if header.origin:
        lines.append(_line("Origin", f"tracked again from {header.origin}"))
    return lines


def recording_summary(folder: Path, recording: TumFolder) -> list[str]:
    """Frames, gaps, depth and camera of a TUM folder, from its lists and its first picture."""
    times = np.array([stored.timestamp_s for stored in recording.stored])
    dropped = np.array([stored.dropped_before for stored in recording.stored])
    with_depth = sum(stored.depth is not None for stored in recording.stored)
    camera = recording.info.camera
    return [
        _line("Recording", f"{folder}, a TUM RGB-D folder"),
        *([_line("Source", "simulated")] if is_simulated(recording.info) else []),
        *_frames(times, dropped),
        _line("Depth", f"{with_depth} of {len(times)} frames have a depth picture"),
        _line("Camera", camera_text(camera, f"no {CAMERA_FILE}")),
        _line("Sensor", sensor_text(camera.sensor)),
    ]


def source_summary(path: Path, info: SourceInfo) -> list[str]:
    """What a recording says of itself without being played: frames, rate, depth, camera, settings."""
    count = "not known before it is played" if info.frame_count is None else str(info.frame_count)
    return [
        _line("Recording", str(path)),
        _line("Frames", f"{count}, {written(info.nominal_fps, 1)} a second"),
        _line("Depth", "yes" if info.has_depth else "no"),
        _line("Camera", camera_text(info.camera)),
        _line("Sensor", sensor_text(info.sensor)),
        *(_line(name.replace("_", " ").capitalize(), value) for name, value in sorted(info.settings.items())),
    ]


def duration_text(duration_s: float) -> str:
    """Minutes and seconds.

    >>> duration_text(83.24), duration_text(59.96), duration_text(6000.04)
    ('01:23.2', '01:00.0', '100:00.0')
    """
    minutes, seconds = divmod(round(duration_s, 1), 60.0)
    return f"{int(minutes):02d}:{seconds:04.1f}"


def camera_text(camera: Camera, without_file: str = "no camera file") -> str:
    """Size and intrinsics, and where they come from."""
    sources = {
        "file": "from a calibration",
        "calibration": "from the camera's own calibration",
        "driver": "from the driver's field of view",
        "factory": "from the maker's calibration",
    }
    source = sources.get(camera.origin, f"usual values, {without_file}")
    named = {"fx": camera.fx_px, "fy": camera.fy_px, "cx": camera.cx_px, "cy": camera.cy_px}
    numbers = ", ".join(f"{name} {written(value, 2)}" for name, value in named.items())
    distortion = ", distorted" if camera.is_distorted else ""
    return f"{camera.width_px} x {camera.height_px} pixels, {numbers}{distortion} ({source})"


def sensor_text(sensor: DepthSensor) -> str:
    """Which depth sensor, and how sure one of its readings is."""
    sd_mm = 1e3 * float(sensor.reading_sd_m(np.array(_USUAL_M)))
    assumed = ", assumed: nobody said which" if sensor.origin == ASSUMED else ""
    within = f"a reading at {written(_USUAL_M * 100)} cm within {written(sd_mm, 1)} mm"
    return f"{sensor.name}, {sensor.kind}, {within}{assumed}"


def _line(title: str, text: str) -> str:
    return f"{title:<12} {text}"


def _calibrated(parameters: str) -> str:
    """When the camera was calibrated with a board and how old that was, where the session was measured with it.

    >>> _calibrated('{"source": {"calibrated": "2026-11-20T08:00:00+00:00", "calibration_age_days": "2.0"}}')
    '; calibrated 2026-11-20, 2 days before'
    """
    camera = camera_said(parameters)
    known = camera.calibrated and math.isfinite(camera.age_days)
    return f"; calibrated {camera.calibrated[:10]}, {written(camera.age_days)} days before" if known else ""


def _completeness(session: Session) -> str:
    if session.recovered:
        return (
            f"cut short and recovered {session.recovered}; at most the last second is missing; more only where the"
            " figures came late"
        )
    return "yes"


def _frames(timestamp_s: FloatArray, dropped: np.ndarray) -> list[str]:
    count = len(timestamp_s)
    if count < 2:
        return [_line("Frames", str(count))]
    duration_s = float(timestamp_s[-1] - timestamp_s[0])
    rate = f"{written(1.0 / float(np.median(np.diff(timestamp_s))), 1)} a second"
    missing, places = int(dropped.sum()), int(np.count_nonzero(dropped))
    gaps = f"{_counted(missing, 'frame')} missing in {_counted(places, 'place')}" if missing else "none"
    return [_line("Frames", f"{count} in {duration_text(duration_s)}, {rate}"), _line("Gaps", gaps)]


def _counted(number: int, thing: str) -> str:
    return f"{number} {thing}" + ("" if number == 1 else "s")


def _shares(session: Session) -> str:
    count = max(len(session), 1)
    frames = {status: np.count_nonzero(session.status == status) for status in TrackStatus}
    if not frames[TrackStatus.DOUBTFUL]:
        del frames[TrackStatus.DOUBTFUL]
    return ", ".join(
        f"{status.name.lower()} {written(100.0 * number / count, 1)} %" for status, number in frames.items()
    )


def range_lines(session: Session, figures: SessionFigures) -> list[str]:
    """Range of each wrist angle, in the same figures as review, report and export: of the trained one the mean of its
    repetitions, else over the whole recording."""
    header = replace(session.header, exercise=FREE_MOVEMENT)
    whole = session_figures(replace(session, header=header)) if figures.exercise.counts else figures
    lines = []
    for angle, stored_name in enumerate(WRIST_ANGLES):
        only_arc = angle == PRONOSUPINATION and not is_from_thumb_up(figures.exercise)
        name = stored_name
        if angle == PRONOSUPINATION:  # whose 0 in the files is palm down
            name = "rotation" if only_arc else "forearm, thumb up"
        of = figures if figures.exercise.angle == angle else whole
        rows = {row.what: row for row in of.wrist_ranges if row.angle == angle}
        if "arc" not in rows:
            lines.append(f"  {name:<18} not measured")
            continue
        positive, negative = SIDES[angle]
        arc = rows["arc"].mean
        # Without repetitions a side that was never reached has no row: it lies as far back as the arc says.
        low = -rows[negative].mean if negative in rows else None
        high = rows[positive].mean if positive in rows else arc + (low or 0.0)
        low = high - arc if low is None else low
        text = f"arc {written(arc, 1)}°"
        if not only_arc:
            text = f"from {_side(angle, low)} to {_side(angle, high)}, {text}"
        if of.counted:
            text += ", of 1 repetition" if of.counted == 1 else f", mean of {of.counted} repetitions"
        lines.append(f"  {name:<18} {text}" + (LIMITED if rows["arc"].at_least else ""))
    return lines


def repetition_lines(figures: SessionFigures) -> list[str]:
    """One line for each repetition, as the review counts it; none where nothing is counted."""
    lines = []
    for number, one in enumerate(figures.repetitions, 1):
        if (row := one.row) is None:
            continue
        least = "at least " if row.at_least else ""
        start, end = (written(time_s, 2) if math.isfinite(time_s) else "?" for time_s in (row.start_s, row.end_s))
        parts = [f"{start} to {end} s"]
        if math.isfinite(row.arc_rad):
            parts.append(f"arc {least}{written(math.degrees(row.arc_rad), 1)} deg")
        if math.isfinite(row.peak_speed_rad_s):
            parts.append(f"peak {written(math.degrees(row.peak_speed_rad_s))} deg/s")
        if math.isfinite(row.sparc):
            parts.append(f"SPARC {written(row.sparc, 2)}")
        if row.pauses > 0:
            parts.append(f"{written(row.pauses)} stops of {written(row.pause_s, 1)} s in all")
        parts += [] if row.counted else [f"not counted: {row.reason.replace('_', ' ')}"]
        lines.append(_line("Repetition" if number == 1 else "", f"{number}: {', '.join(parts)}"))
    return lines


def _joint_ranges(session: Session, figures: SessionFigures) -> list[str]:
    """Of the whole hand: every joint over the frames in which it was seen, and the total of every finger."""
    if not session.header.joint_names:
        return []
    ends = {row.key: row.mean for row in figures.joint_ranges}
    over = "mean of the repetitions, " if figures.counted else ""
    lines = [f"Joints of the fingers, {over}while they were seen (TAM: total active motion)"]
    for row in figures.joint_ranges:
        if row.what != "arc":
            continue
        if not row.count:
            lines.append(f"  {row.of:<18} never seen")
            continue
        low, high = ends[row.of, "extension"], ends[row.of, "flexion"]
        text = f"arc {written(row.mean, 1)}°, seen {written(100.0 * row.seen_share)} %"
        if is_total(row.of):
            text = f"{written(row.mean, 1)}°: bending {written(high, 1)}° less {written(low, 1)}° to straight"
        else:
            text = f"from {written(low, 1)}° to {written(high, 1)}°, {text}"
        text += ", end joint not measured" if row.inferred else ""
        lines.append(f"  {row.of:<18} {text}" + (LIMITED if row.at_least else ""))
    return lines


def _side(angle: int, angle_deg: float) -> str:
    positive, negative = SIDES[angle]
    return f"{written(abs(angle_deg), 1)}° {positive if angle_deg >= 0.0 else negative}"


def _calibration(session: Session) -> list[str]:
    calibration = session.calibration
    verdict = calibration.verdict
    facts = [
        (verdict.hand_length_mm, f"hand {written(verdict.hand_length_mm)} mm"),
        (verdict.distance_m, f"{written(verdict.distance_m, 2)} m from the camera"),
        (verdict.tilt_deg, f"tilted {written(verdict.tilt_deg)}°"),
    ]
    residual_mm = verdict.residual_mm[np.isfinite(verdict.residual_mm)]
    if residual_mm.size:
        facts.append((0.0, f"markers within {written(residual_mm.max(), 1)} mm"))
    known = [text for value, text in facts if np.isfinite(value)]
    if verdict.frames_used:
        known.append(f"from {verdict.frames_used} still pictures")
    lines = [_line("Calibration", ", ".join(known) or "not described")]
    lines += [f"  doubtful: {finding_sentence(finding)}" for finding in verdict.findings]
    start_deg = np.degrees(calibration.start_angles_rad)
    if np.any(np.isfinite(start_deg) & (start_deg != 0.0)):
        read_rad = [as_read_rad(WRIST_ANGLES[k], angle) for k, angle in enumerate(calibration.start_angles_rad)]
        given = ", ".join(_side(angle, math.degrees(float(start))) for angle, start in enumerate(read_rad))
        lines.append(f"  Start angles as given by the therapist: {given}.")
    return lines


def _provenance(session: Session) -> list[str]:
    """By which revision, of which recording, with which settings; what an older session does not say is left out."""
    said, source = (said_in(session.header.parameters, part) for part in ("provenance", "source"))
    camera = camera_said(session.header.parameters)
    calibrated = camera.calibrated and f"{camera.calibrated}, {written(camera.age_days)} days before"
    facts = (
        ("Calibrated", calibrated or (camera.serial and "not with a board")),
        ("Revision", said.get("revision")),
        ("Of", source.get("sha256") and f"a recording with SHA-256 {source['sha256']}"),
        ("Set", said.get("settings_sha256") and f"by settings with SHA-256 {said['settings_sha256']}"),
    )
    return [_line(title, str(text)) for title, text in facts if text]


def _events(session: Session) -> str:
    counts = Counter(event.kind for event in session.events)
    return ", ".join(f"{count} {kind}" for kind, count in counts.items()) or "none"
