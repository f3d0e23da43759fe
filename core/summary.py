"""What a session or a recording holds, as plain lines for ``carpus info``."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

import numpy as np

from core.camera import Camera
from core.capture.camera_info import CAMERA_FILE
from core.capture.source import SourceInfo, is_simulated
from core.capture.tum import TumFolder
from core.hand.protocols import WRIST_ANGLES
from core.output.exercises import exercise_named
from core.output.joint_content import joint_rows, joint_tracks
from core.output.range_rows import is_total
from core.session.reader import has_raw
from core.session.values import Session
from core.types import FloatArray, TrackStatus
from core.words import finding_sentence

_WRIST_DIRECTIONS = {
    "deviation": ("ulnar", "radial"),
    "flexion": ("extension", "flexion"),
    "pronosupination": ("pronation", "supination"),
}
"""Words for the negative and the positive side of each wrist angle."""


def session_summary(session: Session) -> list[str]:
    """Everything a person asks of a session file, the identity first and the settings last."""
    header, quality = session.header, session.quality
    lines = [
        _line("Session", str(session.path)),
        _line("Identity", f"{header.session_id}, written by Carpus {header.software_version}"),
        _line("Patient", f"{header.subject_id or 'not given'}, {header.hand} hand"),
        _line("Exercise", header.exercise or "not given"),
        _line("Created", header.created),
        _line("Markers", f"{header.protocol.name}: {' '.join(header.protocol.markers)}"),
        *([_line("Source", "simulated: nobody's movement was measured")] if header.simulated else []),
        _line("Complete", _completeness(session)),
        *_frames(session.timestamp_s, np.maximum(quality.dropped_before, 0)),
        _line("Tracking", _shares(session)),
        *_ranges(session),
        *_calibration(session),
        _line("Camera", camera_text(session.camera)),
        _line("Smoothed", "yes" if session.smoothed is not None else "no"),
        _line("Pictures", "kept" if has_raw(session.path) else "not kept"),
        _line("Events", _events(session)),
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
    ]


def source_summary(path: Path, info: SourceInfo) -> list[str]:
    """What a recording says of itself without being played: frames, rate, depth, camera, settings."""
    count = "not known before it is played" if info.frame_count is None else str(info.frame_count)
    return [
        _line("Recording", str(path)),
        _line("Frames", f"{count}, {info.nominal_fps:.1f} a second"),
        _line("Depth", "yes" if info.has_depth else "no"),
        _line("Camera", camera_text(info.camera)),
        *(_line(name.replace("_", " ").capitalize(), value) for name, value in sorted(info.settings.items())),
    ]


def duration_text(duration_s: float) -> str:
    """Minutes and seconds.

    >>> duration_text(83.24)
    '01:23.2'
    """
    minutes, seconds = divmod(round(duration_s, 1), 60.0)
    return f"{int(minutes):02d}:{seconds:04.1f}"


def camera_text(camera: Camera, without_file: str = "no camera file") -> str:
    """Size and intrinsics, and where they come from."""
    sources = {"file": "from a calibration", "driver": "from the driver's field of view"}
    source = sources.get(camera.origin, f"usual values, {without_file}")
    numbers = f"fx {camera.fx_px:.2f}, fy {camera.fy_px:.2f}, cx {camera.cx_px:.2f}, cy {camera.cy_px:.2f}"
    distortion = ", distorted" if camera.is_distorted else ""
    return f"{camera.width_px} x {camera.height_px} pixels, {numbers}{distortion} ({source})"


def _line(title: str, text: str) -> str:
    return f"{title:<12} {text}"


def _completeness(session: Session) -> str:
    if not session.complete:
        return "no: still being recorded or cut short (carpus recover finishes it)"
    if session.recovered:
        return f"cut short and recovered {session.recovered}; at most the last second is missing"
    return "yes"


def _frames(timestamp_s: FloatArray, dropped: np.ndarray) -> list[str]:
    count = len(timestamp_s)
    if count < 2:
        return [_line("Frames", str(count))]
    duration_s = float(timestamp_s[-1] - timestamp_s[0])
    rate = f"{1.0 / float(np.median(np.diff(timestamp_s))):.1f} a second"
    missing, places = int(dropped.sum()), int(np.count_nonzero(dropped))
    gaps = f"{_counted(missing, 'frame')} missing in {_counted(places, 'place')}" if missing else "none"
    return [_line("Frames", f"{count} in {duration_text(duration_s)}, {rate}"), _line("Gaps", gaps)]


def _counted(number: int, thing: str) -> str:
    return f"{number} {thing}" + ("" if number == 1 else "s")


def _shares(session: Session) -> str:
    count = max(len(session), 1)
    shares = (
        f"{status.name.lower()} {100.0 * np.count_nonzero(session.status == status) / count:.1f} %"
        for status in TrackStatus
    )
    return ", ".join(shares)


def _ranges(session: Session) -> list[str]:
    """Lowest, highest and arc of the wrist over the tracked frames, then the joints."""
    tracked = session.status == TrackStatus.TRACKED
    lines = ["Range of motion over the tracked frames"]
    columns = [*zip(WRIST_ANGLES, session.motion.angles_rad.T, strict=True)]
    for name, values_rad in columns:
        known = np.degrees(values_rad[tracked & np.isfinite(values_rad)])
        if not known.size:
            lines.append(f"  {name:<18} not measured")
            continue
        low, high = float(known.min()), float(known.max())
        ends = f"from {_side(name, low)} to {_side(name, high)}"
        lines.append(f"  {name:<18} {ends}, arc {high - low:.1f}°")
    return lines + _joint_ranges(session)


def _joint_ranges(session: Session) -> list[str]:
    """Of the whole hand: every joint over the frames in which it was seen, and the total of every finger."""
    tracks = joint_tracks(session)
    if not tracks:
        return []
    rows = joint_rows(tracks, (), exercise_named(session.header.exercise))
    ends = {(row.joint, row.movement): row.mean_deg for row in rows}
    lines = ["Joints of the fingers over the frames in which they were seen (TAM: total active motion)"]
    for row in rows:
        if row.movement != "arc":
            continue
        if not row.count:
            lines.append(f"  {row.joint:<18} never seen")
            continue
        low, high = ends[row.joint, "extension"], ends[row.joint, "flexion"]
        text = f"arc {row.mean_deg:.1f}°, seen {100.0 * row.seen_share:.0f} %"
        if is_total(row.joint):
            text = f"{row.mean_deg:.1f}°: bending {high:.1f}° less {low:.1f}° to straight"
        else:
            text = f"from {low:.1f}° to {high:.1f}°, {text}"
        text += ", end joint not measured" if row.inferred else ""
        lines.append(f"  {row.joint:<18} {text}" + (", limited by the camera's view" if row.limited else ""))
    return lines


def _side(name: str, angle_deg: float) -> str:
    negative, positive = _WRIST_DIRECTIONS[name]
    return f"{abs(angle_deg):.1f}° {positive if angle_deg >= 0.0 else negative}"


def _calibration(session: Session) -> list[str]:
    calibration = session.calibration
    verdict = calibration.verdict
    facts = [
        (verdict.hand_length_mm, f"hand {verdict.hand_length_mm:.0f} mm"),
        (verdict.distance_m, f"{verdict.distance_m:.2f} m from the camera"),
        (verdict.tilt_deg, f"tilted {verdict.tilt_deg:.0f}°"),
    ]
    residual_mm = verdict.residual_mm[np.isfinite(verdict.residual_mm)]
    if residual_mm.size:
        facts.append((0.0, f"markers within {residual_mm.max():.1f} mm"))
    known = [text for value, text in facts if np.isfinite(value)]
    if verdict.frames_used:
        known.append(f"from {verdict.frames_used} still pictures")
    lines = [_line("Calibration", ", ".join(known) or "not described")]
    lines += [f"  doubtful: {finding_sentence(finding)}" for finding in verdict.findings]
    start_deg = np.degrees(calibration.start_angles_rad)
    if np.any(np.isfinite(start_deg) & (start_deg != 0.0)):
        given = ", ".join(_side(name, float(angle)) for name, angle in zip(WRIST_ANGLES, start_deg, strict=True))
        lines.append(f"  Start angles as given by the therapist: {given}.")
    return lines


def _events(session: Session) -> str:
    counts = Counter(event.kind for event in session.events)
    return ", ".join(f"{count} {kind}" for kind, count in counts.items()) or "none"
