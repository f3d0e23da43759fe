"""One recording of many: tracked, or left as it is where that was done before, and measured.

Runs in a process of its own, here or on another machine: what goes in and comes out are plain values.
"""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass
from typing import Literal

from threadpoolctl import threadpool_limits

from carpus.app.settings import load_settings
from carpus.app.sources import TrackingInput, open_recording, tell_assumed
from carpus.core.calibration.clicks import read_clicks
from carpus.core.calibration.result import Verdict, finding_sentence
from carpus.core.capture.source import Recorded
from carpus.core.durable import write_fault
from carpus.core.errors import CarpusFault, OutputExists
from carpus.core.pipeline.told_settings import differences
from carpus.core.pipeline.track import TrackSettings, retrack_session, track_recording
from carpus.core.research.papers.track import settings_told
from carpus.core.results.figures import session_figures
from carpus.core.results.measures_table import SessionFigure, measure_rows
from carpus.core.session.reader import read_session
from carpus.core.types import TrackStatus
from carpus.core.version import __version__
from carpus.core.words import one_sentence

Result = Literal["tracked", "kept", "fault"]


@dataclass(frozen=True, slots=True)
class Task:
    """What is to be done with one recording."""

    place: TrackingInput
    settings: TrackSettings
    subject_id: str = ""
    exercise: str = ""
    leave_out_damaged: bool = False
    software_version: str = __version__
    """Whoever tracks it has the same, or the numbers of one table would not be of one program."""


@dataclass(frozen=True, slots=True)
class Outcome:
    """What came of it: shares 0 to 1 of ``frames``, NaN after a fault; ``said`` the fault, or what is doubtful;
    ``measures`` of the session."""

    place: TrackingInput
    result: Result
    said: tuple[str, ...] = ()
    frames: int = 0
    tracked: float = float("nan")
    lost: float = float("nan")
    measures: tuple[SessionFigure, ...] = ()
    may_pass: bool = False
    """Of a fault: whether it may be gone when tried again."""


def work(task: Task) -> Outcome:
    """Do one task; whatever goes wrong is part of the outcome."""
    if task.software_version != __version__:
        return fault_of(task.place, f"the worker has Carpus {__version__}, and {task.software_version} was asked for")
    try:
        with threadpool_limits(1):  # the same numbers wherever it runs
            return _worked(task)
    except CarpusFault as fault:
        return fault_of(task.place, one_sentence(fault))
    except OSError as cause:
        sentence = f"the system refuses {cause.filename or ''} ({cause.strerror or cause})"
        return fault_of(task.place, sentence, may_pass=True)
    except Exception as cause:
        return fault_of(task.place, f"something unforeseen happened ({type(cause).__name__}: {cause})")


def fault_of(place: TrackingInput, sentence: str, *, may_pass: bool = False) -> Outcome:
    """The outcome of a recording that could not be tracked."""
    return Outcome(place, "fault", (sentence,), may_pass=may_pass)


def _worked(task: Task) -> Outcome:
    place, said = task.place, list[str]()
    result: Result = "kept"
    try:
        place.session.parent.mkdir(parents=True, exist_ok=True)
    except OSError as cause:
        raise write_fault(place.session.parent, cause) from cause
    if not place.session.exists():
        with suppress(OutputExists):  # another run of the same batch was faster
            _tracked(task, said)
            result = "tracked"
    session = read_session(place.session)
    told = settings_told(session.header.parameters)
    if result == "kept" and (told is None or differences(told.settings, task.settings)):
        said.append("tracked before with other settings, left as it is")
    shares = [float((session.status == status).mean()) if len(session) else float("nan") for status in TrackStatus]
    return Outcome(
        place,
        result,
        tuple(said),
        len(session),
        shares[TrackStatus.TRACKED],
        shares[TrackStatus.LOST],
        measure_rows(session_figures(session), place.name),
    )


def _tracked(task: Task, said: list[str]) -> None:
    place = task.place

    def doubt(verdict: Verdict) -> None:
        said.extend(finding_sentence(finding) for finding in verdict.findings if not finding.blocks)

    def doubtful_date(recorded: Recorded | None) -> None:
        if recorded is None or recorded.said_by == "file":
            said.append("the recording does not say when the hand moved")

    if place.clicks is None:
        retrack_session(place.recording, place.session, task.settings, on_verdict=doubt)
        return

    def tell(fault: CarpusFault) -> None:
        said.append(one_sentence(fault))

    source = open_recording(
        place.recording,
        leave_out_damaged=task.leave_out_damaged,
        data_folder=load_settings().data_folder,
        notice=tell,
    )
    try:
        camera = source.info.camera
        tell_assumed(source, place.recording, tell)
        track_recording(
            source,
            read_clicks(place.clicks, camera.width_px, camera.height_px),
            place.session,
            task.settings,
            subject_id=task.subject_id,
            exercise=task.exercise,
            on_verdict=doubt,
            path=place.recording,
            on_date=doubtful_date,
        )
    finally:
        source.close()
