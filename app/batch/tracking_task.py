"""One recording of a batch: track it unless a session exists, then measure it.

Runs in a process of its own, here or on another machine, so tasks and outcomes are plain values.
"""

from __future__ import annotations

from contextlib import closing, suppress
from dataclasses import dataclass
from typing import Literal

from threadpoolctl import threadpool_limits

from carpus.app.settings import load_settings
from carpus.app.sources import TrackingInput, open_recording, warn_assumed_intrinsics
from carpus.core.calibration.clicks_file import read_clicks
from carpus.core.calibration.result import Verdict, finding_sentence
from carpus.core.capture.source import RecordingDate
from carpus.core.formats.measures_table import MeasureRow, build_measure_rows
from carpus.core.model.errors import CarpusFault, OutputExists
from carpus.core.model.fault_text import format_fault_line
from carpus.core.model.types import TrackStatus
from carpus.core.pipeline.stored_settings import list_differences
from carpus.core.pipeline.track import TrackSettings, retrack_session, track_recording
from carpus.core.platform.durable import write_fault
from carpus.core.platform.version import __version__
from carpus.core.research.papers.tracker import settings_from_json
from carpus.core.results.session_results import compute_session_results
from carpus.core.results.session_summary import exercise_warnings
from carpus.core.session.reader import read_session

Result = Literal["tracked", "kept", "fault"]


@dataclass(frozen=True, slots=True)
class TrackingTask:
    """Everything a worker needs to track one recording."""

    tracking_input: TrackingInput
    settings: TrackSettings
    subject_id: str = ""
    exercise: str = ""
    leave_out_damaged: bool = False
    software_version: str = __version__
    """Workers must have the same version: one table must not mix the results of two programs."""


@dataclass(frozen=True, slots=True)
class TrackingOutcome:
    """Result of one task.

    Attributes
    ----------
    messages : tuple of str
        The fault, or what is uncertain about the session.
    tracked, lost : float
        Share of frames, 0 to 1; NaN after a fault.
    is_retryable : bool
        True if the fault may be gone at the next try.
    """

    tracking_input: TrackingInput
    result: Result
    messages: tuple[str, ...] = ()
    frames: int = 0
    tracked: float = float("nan")
    lost: float = float("nan")
    measures: tuple[MeasureRow, ...] = ()
    is_retryable: bool = False


def execute_task(task: TrackingTask) -> TrackingOutcome:
    """Run one task; every failure becomes part of the outcome."""
    if task.software_version != __version__:
        return fault_outcome(
            task.tracking_input, f"the worker has Carpus {__version__}, and {task.software_version} was asked for"
        )
    try:
        with threadpool_limits(1):  # the same numbers wherever it runs
            return _track_and_measure(task)
    except CarpusFault as fault:
        return fault_outcome(task.tracking_input, format_fault_line(fault))
    except OSError as cause:
        sentence = f"the system refuses {cause.filename or ''} ({cause.strerror or cause})"
        return fault_outcome(task.tracking_input, sentence, is_retryable=True)
    except Exception as cause:
        return fault_outcome(task.tracking_input, f"something unforeseen happened ({type(cause).__name__}: {cause})")


def fault_outcome(tracking_input: TrackingInput, sentence: str, *, is_retryable: bool = False) -> TrackingOutcome:
    """Return the outcome of a recording that could not be tracked."""
    return TrackingOutcome(tracking_input, "fault", (sentence,), is_retryable=is_retryable)


def _track_and_measure(task: TrackingTask) -> TrackingOutcome:
    place, said = task.tracking_input, list[str]()
    result: Result = "kept"
    try:
        place.session.parent.mkdir(parents=True, exist_ok=True)
    except OSError as cause:
        raise write_fault(place.session.parent, cause) from cause
    if not place.session.exists():
        with suppress(OutputExists):  # another run of the same batch was faster
            _track(task, said)
            result = "tracked"
    session = read_session(place.session)
    told = settings_from_json(session.header.parameters)
    if result == "kept" and (told is None or list_differences(told.settings, task.settings)):
        said.append("tracked before with other settings, left as it is")
    header = session.header
    told_again = (task.subject_id or header.subject_id, task.exercise or header.exercise)
    if result == "kept" and told_again != (header.subject_id, header.exercise):
        said.append("tracked before of another patient or exercise, left as it is")
    results = compute_session_results(session)
    if place.clicks is not None:
        said += exercise_warnings(session, results)
    shares = [float((session.status == status).mean()) if len(session) else float("nan") for status in TrackStatus]
    return TrackingOutcome(
        place,
        result,
        tuple(said),
        len(session),
        shares[TrackStatus.TRACKED],
        shares[TrackStatus.LOST],
        build_measure_rows(results, place.name),
    )


def _track(task: TrackingTask, messages: list[str]) -> None:
    place = task.tracking_input

    def add_findings(verdict: Verdict) -> None:
        messages.extend(finding_sentence(finding) for finding in verdict.findings if not finding.blocks)

    def add_date_message(recorded: RecordingDate | None) -> None:
        if recorded is None or recorded.source == "file":
            messages.append("the recording does not say when the hand moved")

    if place.clicks is None:
        retrack_session(place.recording, place.session, task.settings, on_verdict=add_findings)
        return

    def add_fault(fault: CarpusFault) -> None:
        messages.append(format_fault_line(fault))

    with closing(
        open_recording(
            place.recording,
            leave_out_damaged=task.leave_out_damaged,
            data_folder=load_settings().data_folder,
            notice=add_fault,
        )
    ) as source:
        camera = source.info.camera
        warn_assumed_intrinsics(source, place.recording, add_fault)
        clicks = read_clicks(place.clicks, camera.width_px, camera.height_px)
        track_recording(
            source,
            clicks,
            place.session,
            task.settings,
            subject_id=task.subject_id,
            exercise=task.exercise or clicks.exercise,
            on_verdict=add_findings,
            path=place.recording,
            on_date=add_date_message,
        )
