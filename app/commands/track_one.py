"""Tracking of one recording, or of a session again, as ``carpus track`` asks for it."""

from __future__ import annotations

import argparse
from contextlib import closing
from dataclasses import replace

import numpy as np

from carpus.app.command_line import (
    describe_wrong_suffix,
    print_fault,
    print_message,
    progress_bar,
    report_usage_error,
)
from carpus.app.session_commands import log_session_action
from carpus.app.settings import load_settings
from carpus.app.sources import (
    SESSION_SUFFIX,
    find_clicks_file,
    is_batch,
    is_recording,
    open_recording,
    warn_assumed_intrinsics,
)
from carpus.core.calibration.clicks_file import read_clicks
from carpus.core.calibration.result import Clicks, Verdict, finding_sentence
from carpus.core.capture.playback_sources import PacedSource
from carpus.core.capture.source import RecordingDate
from carpus.core.model.errors import RecordingMissing
from carpus.core.model.hand.protocols import MarkerProtocol
from carpus.core.pipeline.live import Listener
from carpus.core.pipeline.stored_settings import StoredSettings, list_differences
from carpus.core.pipeline.track import LIVE_LABEL, TrackReport, TrackSettings, retrack_session, track_recording
from carpus.core.platform.version import __version__
from carpus.core.research.papers.hand_model import PaperSettings
from carpus.core.research.papers.tracker import PaperTrackSettings, settings_from_json
from carpus.core.session.reader import read_outline, read_session

LISTENER_TIMEOUT_S = 20.0
_RECORDING_OPTIONS = ("calibration", "start_angles", "subject", "exercise", "recorded")
"""Options whose values a session contains already."""
COLOR_ONLY_WARNING = (
    "Without depth a palm tilted towards the camera looks almost like one tilted away, its mirror image; "
    "check the signs of flexion and pro/supination, or track with depth."
)
HAND_COLOR_ONLY_WARNING = (
    "Tracking 21 markers without depth is experimental: the image hardly shows how far a finger that is almost "
    "straight is bent, or to which side; do not rely on these joint angles."
)
_OPTIONS_WITHOUT_PAPER_FILTER = {
    "--depth": ("depth", True),
    "--dip free": ("dip", "free"),
    "--discs on-skin": ("discs", "on-skin"),
    "--smooth": ("smooth", True),
}
"""Options that the papers' method does not have."""


def apply_options(arguments: argparse.Namespace, base: TrackSettings) -> TrackSettings:
    """Return the settings ``base`` changed by the given options."""
    tracker = base.tracker
    told = {"profile": arguments.profile, "use_depth": arguments.depth, "dip": arguments.dip}
    tracker = replace(tracker, **{name: value for name, value in told.items() if value is not None})
    if arguments.discs is not None:
        tracker = replace(tracker, fingers=replace(tracker.fingers, skin_offsets=arguments.discs == "on-skin"))
    smooth = base.smooth if arguments.smooth is None else arguments.smooth
    paper = base.paper if isinstance(base, PaperTrackSettings) and arguments.filter is None else None
    if arguments.filter == "paper" or (paper is not None and arguments.profile is not None):
        paper = PaperSettings.from_profile(arguments.profile or "standard")
    chosen = TrackSettings(base.detection, base.calibration, tracker, smooth)
    return chosen if paper is None else PaperTrackSettings.from_base(chosen, paper)


def find_options_without_paper_filter(arguments: argparse.Namespace) -> list[str]:
    """List given options that the papers' method would ignore."""
    return [
        option for option, (name, value) in _OPTIONS_WITHOUT_PAPER_FILTER.items() if getattr(arguments, name) == value
    ]


def _has_conflict(arguments: argparse.Namespace, settings: TrackSettings) -> bool:
    """Tell whether options contradict each other, with a message on stderr."""
    told = find_options_without_paper_filter(arguments) if isinstance(settings, PaperTrackSettings) else []
    if told:
        report_usage_error(
            "track",
            f"the papers' method works by colour alone on the papers' chain and does not look back; "
            f"leave out {' and '.join(told)}.",
        )
    return bool(told)


def run(arguments: argparse.Namespace) -> int:
    """Track one recording, a session again, or many, and return the exit code."""
    named = arguments.recording
    if bool(named) == (arguments.manifest is not None):
        return report_usage_error("track", "give recordings, or a list of them with --manifest STUDY.csv.")
    if arguments.manifest is not None or is_batch(named, arguments.output):
        if arguments.stream:
            return report_usage_error("track", "--stream is for one recording; leave it out.")
        usual = load_settings().track
        chosen = apply_options(arguments, usual)
        if _has_conflict(arguments, chosen):
            return 2
        if not chosen.uses_depth:
            print_message(COLOR_ONLY_WARNING)
        from carpus.app.commands.track_many import run_many

        return run_many(named, arguments.output, arguments, usual, lambda base: apply_options(arguments, base))
    of_many = [name for name in ("jobs", "scheduler", "table", "time_limit") if getattr(arguments, name) is not None]
    if of_many:
        return report_usage_error("track", f"--{of_many[0].replace('_', '-')} is for many recordings; leave it out.")
    if wrong := describe_wrong_suffix(arguments.output, (SESSION_SUFFIX,)):
        return report_usage_error("track", f"{wrong}.")
    arguments.recording = named[0]
    is_session = arguments.recording.suffix == ".h5" and arguments.recording.is_file()
    settings = apply_options(arguments, TrackSettings() if is_session else load_settings().track)
    if not settings.uses_depth:
        print_message(COLOR_ONLY_WARNING)
    if not arguments.recording.exists():
        raise RecordingMissing(arguments.recording)
    if arguments.recording.is_dir() and not is_recording(arguments.recording):
        raise RecordingMissing(arguments.recording, "no recording in this folder; many need a folder as --output")
    if is_session:
        return _retrack_session(arguments, was_warned=not settings.uses_depth)
    beside = find_clicks_file(arguments.recording)
    if arguments.calibration is None and not (beside and beside.exists()):
        return report_usage_error(
            "track",
            f"no clicks on the first frame: there is no {beside}; --calibration CLICKS.json names them "
            "(carpus.propose_clicks makes them in Python).",
        )
    arguments.calibration = arguments.calibration or beside
    return 2 if _has_conflict(arguments, settings) else _track_recording(arguments, settings)


def _track_recording(arguments: argparse.Namespace, settings: TrackSettings) -> int:
    source = open_recording(
        arguments.recording,
        leave_out_damaged=arguments.leave_out_damaged,
        data_folder=load_settings().data_folder,
        notice=print_fault,
    )
    with closing(PacedSource(source) if arguments.stream else source) as source:
        camera = source.info.camera
        warn_assumed_intrinsics(source, arguments.recording, print_fault)
        clicks = read_clicks(arguments.calibration, camera.width_px, camera.height_px)
        warn_of_experiment(settings, clicks.protocol)
        listener = _open_stream(clicks, source.info.nominal_fps, settings) if arguments.stream else None
        start = None if arguments.start_angles is None else np.radians(arguments.start_angles)
        with progress_bar("tracking") as progress:
            report = track_recording(
                source,
                clicks,
                arguments.output,
                settings,
                subject_id=arguments.subject or "",
                exercise=arguments.exercise or clicks.exercise,
                start_angles_rad=start,
                progress=progress,
                on_verdict=warn_of_findings,
                recorded=RecordingDate(arguments.recorded, "asked") if arguments.recorded else None,
                path=arguments.recording,
                on_date=warn_of_date,
                listener=listener,
            )
    for sentence in print_report(report):
        print_message(f"warning: {sentence}")
    return 0


def _open_stream(clicks: Clicks, rate_hz: float, settings: TrackSettings) -> Listener:
    """Open the stream of a hand; wait a limited time for a listener."""
    from carpus.core.pipeline.lsl_stream import SampleStream, import_pylsl

    begun_s: list[float] = []
    stream = SampleStream(clicks, rate_hz, dip_free=settings.dip_free, clock=lambda: begun_s[0])
    if not stream.has_listener(LISTENER_TIMEOUT_S):
        print_message("no program receives the stream; tracking continues.")
    begun_s.append(import_pylsl().local_clock())
    return stream


def _retrack_session(arguments: argparse.Namespace, *, was_warned: bool) -> int:
    """Track a session again with its own settings, and print the differences."""
    given = [f"--{name.replace('_', '-')}" for name in _RECORDING_OPTIONS if getattr(arguments, name)]
    if given:
        return report_usage_error("track", f"a session brings its own; leave out {' and '.join(given)}.")
    header = read_outline(arguments.recording).header
    before = settings_from_json(header.parameters)
    settings = apply_options(arguments, before.settings if before else load_settings().track)
    if _has_conflict(arguments, settings):
        return 2
    if not settings.uses_depth and not was_warned:
        print_message(COLOR_ONLY_WARNING)
    warn_of_experiment(settings, header.protocol)
    with progress_bar("tracking again") as progress:
        report = retrack_session(
            arguments.recording,
            arguments.output,
            settings,
            progress=progress,
            on_verdict=warn_of_findings,
        )
    log_session_action("tracked_again", arguments.recording, header.session_id)
    print_report(report)
    print(f"Origin: session {header.session_id}, of recording {header.recording_id}")
    for line in _describe_differences(before, settings, header.software_version):
        print(line)
    if labels := sum(event.kind == LIVE_LABEL for event in read_session(arguments.recording).events):
        print_message(
            f"labels given while measuring ({labels}) are not applied again; check the markers in the window."
        )
    return 0


def _describe_differences(before: StoredSettings | None, settings: TrackSettings, version: str) -> list[str]:
    if before is None:
        return ["Settings: the session does not say with which it was tracked; your own were used"]
    changed = list_differences(before.settings, settings)
    if version != __version__:
        changed.append(f"software {__version__} (was {version})")
    if before.unknown:
        changed.append(f"no settings any more: {', '.join(before.unknown)}")
    return [f"Differs: {change}" for change in changed] or ["Differs: nothing, same settings as before"]


def warn_of_date(recorded: RecordingDate | None) -> None:
    """Print a warning if a session's date is only that of a file."""
    if recorded is None or recorded.source == "file":
        day = "unknown" if recorded is None else f"taken from its file ({recorded.time[:10]})"
        print_message(f"the recording does not say when the hand moved: {day}; --recorded DATE says it.")


def warn_of_experiment(settings: TrackSettings, protocol: MarkerProtocol) -> None:
    """Print a warning that tracking fingers by colour only is experimental."""
    if protocol.has_fingers and not settings.uses_depth:
        print_message(HAND_COLOR_ONLY_WARNING)


def warn_of_findings(verdict: Verdict) -> None:
    """Print the findings of a calibration that do not block it."""
    for finding in verdict.findings:
        if finding.blocks:
            continue  # this ends the command, and is said there
        print_message(f"warning: {finding_sentence(finding)}")


def print_report(report: TrackReport) -> list[str]:
    """Print the session file and its main results; return what is doubtful about its exercise."""
    # All measures: nobody waits for them at the start.
    from carpus.core.results.session_results import compute_session_results
    from carpus.core.results.session_summary import exercise_warnings, range_lines

    print(f"Session: {report.output}")
    doubtful = f", doubtful {report.doubtful}" if report.doubtful else ""
    print(
        f"Frames: {report.frames}, tracked {report.tracked}, predicted {report.predicted}, lost {report.lost}{doubtful}"
    )
    session = read_session(report.output)
    results = compute_session_results(session)
    for line in range_lines(results):
        print(line.strip())
    return exercise_warnings(session, results)
