"""``carpus track``: a stored recording, or an earlier session, to a session file."""

from __future__ import annotations

import argparse
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np

from app import __version__
from app.commands.progress import bar, tell
from core.calibration.clicks import read_clicks
from core.calibration.result import Verdict
from core.errors import IntrinsicsAssumed, RecordingMissing
from core.hand.protocols import MarkerProtocol
from core.pipeline.track import TrackReport, TrackSettings, fingers_as_tracked, retrack_session, track_recording
from core.session.reader import read_outline
from core.tracking.finger_settings import FingerSettings
from core.tracking.settings import PROFILES, TrackerSettings
from core.words import finding_sentence

LARGEST_START_DEG = 120.0


def an_angle_deg(text: str) -> float:
    """Degrees that a wrist may have; anything else is wrong usage."""
    angle = float(text)
    if not abs(angle) <= LARGEST_START_DEG:
        raise argparse.ArgumentTypeError(
            f"{text} is not between -{LARGEST_START_DEG:g} and {LARGEST_START_DEG:g} degrees"
        )
    return angle


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("recording", type=Path, help="TUM RGB-D folder, .oni file, raw recording, or a session (.h5)")
    parser.add_argument(
        "--calibration", type=Path, metavar="CLICKS.json", help="first-frame clicks (not for a session)"
    )
    parser.add_argument(
        "--output", type=Path, required=True, metavar="SESSION.h5", help="the file to write; never overwritten"
    )
    parser.add_argument(
        "--depth",
        action=argparse.BooleanOptionalAction,
        default=True,
        help="use each marker's depth (default) or colour only, as the papers do",
    )
    parser.add_argument(
        "--dip",
        choices=("coupled", "free"),
        help="end joints bound to the middle joints (default), or free; a session's own unless given",
    )
    parser.add_argument(
        "--discs",
        choices=("on-skin", "in-joints"),
        help="where the discs of the fingers are: on the skin over the joints (default), or in the joints, the papers' "
        "chain; a session's own unless given",
    )
    parser.add_argument(
        "--leave-out-damaged",
        action="store_true",
        help="go on without missing and damaged pictures of a folder, as frames that were lost; else they are a fault",
    )
    parser.add_argument("--profile", choices=tuple(PROFILES), default="standard", help="how lively the hand is")
    parser.add_argument(
        "--smooth",
        action=argparse.BooleanOptionalAction,
        default=True,
        help="add /smoothed, every frame in the light of those after it",
    )
    parser.add_argument(
        "--filter",
        choices=("reduced", "augmented"),
        default="reduced",
        help="the default filter, or the papers' augmented one",
    )
    parser.add_argument(
        "--motion",
        choices=("constant-rate", "paper"),
        default="constant-rate",
        help="motion model; paper: equation (1)",
    )
    parser.add_argument(
        "--start-angles",
        type=an_angle_deg,
        nargs=3,
        metavar=("DEVIATION", "FLEXION", "SUPINATION"),
        help="degrees at the first frame, for a hand that cannot lie neutral; added to all angles and marked as given",
    )
    parser.add_argument("--subject", default="", metavar="PSEUDONYM", help="stored in the session; never a name")
    parser.add_argument("--exercise", default="", help="stored in the session")


_INTRINSICS = {"default": "the usual values of the Xtion", "driver": "the driver's field of view"}
_OF_RECORDINGS = ("calibration", "start_angles", "subject", "exercise")
"""Options that a session answers itself."""
COLOR_ALONE = (
    "Without depth a palm tilted towards the camera looks almost like one tilted away, its mirror image; "
    "check the signs of flexion and pro/supination, or track with depth."
)
HAND_COLOR_ALONE = (
    "Tracking 21 markers without depth is experimental: the picture hardly shows how far a finger that is almost "
    "straight is bent, or to which side; do not rely on these joint angles."
)


def settings_from(arguments: argparse.Namespace, parameters: str = "") -> TrackSettings:
    """The settings that the options name, and for a session tracked with ``parameters`` what they leave to it."""
    own = fingers_as_tracked(TrackerSettings(), parameters)
    skin_offsets = own.fingers.skin_offsets if arguments.discs is None else arguments.discs == "on-skin"
    tracker = TrackerSettings(
        fingers=FingerSettings(skin_offsets=skin_offsets),
        form=arguments.filter,
        motion="paper" if arguments.motion == "paper" else "constant_rate",
        profile=arguments.profile,
        use_depth=arguments.depth,
        dip=arguments.dip or own.dip,
    )
    return replace(TrackSettings(), tracker=tracker, smooth=arguments.smooth)


def run(arguments: argparse.Namespace) -> int:
    settings = settings_from(arguments)
    if not settings.tracker.use_depth:
        print(f"carpus: {COLOR_ALONE}", file=sys.stderr)
    if not arguments.recording.exists():
        raise RecordingMissing(arguments.recording)
    if arguments.recording.suffix == ".h5" and arguments.recording.is_file():
        told = [f"--{name.replace('_', '-')}" for name in _OF_RECORDINGS if getattr(arguments, name)]
        if told:
            print(f"carpus track: a session brings its own; leave out {' and '.join(told)}.", file=sys.stderr)
            return 2
        header = read_outline(arguments.recording).header
        settings = settings_from(arguments, header.parameters)
        warn_of_experiment(settings, header.protocol)
        with bar("tracking again") as progress:
            report = retrack_session(
                arguments.recording,
                arguments.output,
                settings,
                software_version=__version__,
                progress=progress,
                on_verdict=warn,
            )
        print_report(report)
        return 0
    if arguments.calibration is None:
        print("carpus track: a recording needs --calibration CLICKS.json.", file=sys.stderr)
        return 2
    from app.sources import open_recording

    source = open_recording(arguments.recording, leave_out_damaged=arguments.leave_out_damaged, notice=tell)
    try:
        camera = source.info.camera
        if camera.origin in _INTRINSICS:
            tell(IntrinsicsAssumed(arguments.recording, _INTRINSICS[camera.origin]))
        clicks = read_clicks(arguments.calibration, camera.width_px, camera.height_px)
        warn_of_experiment(settings, clicks.protocol)
        start = None if arguments.start_angles is None else np.radians(arguments.start_angles)
        with bar("tracking") as progress:
            report = track_recording(
                source,
                clicks,
                arguments.output,
                settings,
                software_version=__version__,
                subject_id=arguments.subject,
                exercise=arguments.exercise,
                start_angles_rad=start,
                progress=progress,
                on_verdict=warn,
            )
    finally:
        source.close()
    print_report(report)
    return 0


def warn_of_experiment(settings: TrackSettings, protocol: MarkerProtocol) -> None:
    """Say on stderr that fingers by colour alone are an experiment."""
    if protocol.has_fingers and not settings.tracker.use_depth:
        print(f"carpus: {HAND_COLOR_ALONE}", file=sys.stderr)


def warn(verdict: Verdict) -> None:
    """Say on stderr what is doubtful about a calibration."""
    for finding in verdict.findings:
        if finding.blocks:
            continue  # this ends the command, and is said there
        print(f"carpus: warning: {finding_sentence(finding)}", file=sys.stderr)


def print_report(report: TrackReport) -> None:
    """Where the session is and its main figures."""
    degrees = np.degrees(report.angle_range_rad)
    print(f"Session: {report.output}")
    print(f"Frames: {report.frames}, tracked {report.tracked}, predicted {report.predicted}, lost {report.lost}")
    pairs = (
        ("Deviation", "ulnar", "radial"),
        ("Flexion", "extension", "flexion"),
        ("Pro/supination", "pronation", "supination"),
    )
    for (name, minus, plus), low, high in zip(pairs, degrees[0], degrees[1], strict=True):
        if np.isfinite(low):
            print(f"{name}: {minus} {max(-low, 0.0):.1f}°, {plus} {max(high, 0.0):.1f}°, arc {high - low:.1f}°")
