"""Cost of one tracked wrist frame and of its parts, beside the plain filter in the same run."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path

import numpy as np

from carpus.core.calibration.calibrate import calibrate_hand
from carpus.core.calibration.clicks_file import read_clicks
from carpus.core.capture.files.tum import TumFolder
from carpus.core.model.types import Frame, TrackStatus
from carpus.core.pipeline import track
from carpus.core.pipeline.track import FramePipeline, TrackSettings, build_pipeline, noise_from_neutral
from carpus.core.simulation.recording import CLICKS_FILE, render_cached
from carpus.core.simulation.spec import RecordingSpec
from carpus.core.tracking import hand_filter
from carpus.core.tracking.association import palm_association
from tests.bench import reference
from tests.bench.timing import HEAD, Spy, Times, line

ORDINARY = RecordingSpec(
    seed=11, motion="mixed", seconds=6.0, hidden_share=0.03, false_blobs=1.0, distance_m=0.66, light="normal"
)
LEAVING = RecordingSpec(
    seed=12, motion="flexion", seconds=4.0, leaves_picture=True, false_blobs=1.0, distance_m=0.66, light="normal"
)
"""A hand that is lost and found again."""
MOST_MEDIAN_MS = 1.3


WRIST_PARTS = (
    (hand_filter, "associate_and_update", "association"),
    (palm_association, "associate_jointly", "joint"),
    (hand_filter, "predict_measurement_ahead", "filter"),
    (hand_filter, "fit_surface", "surface"),
    (track, "sample_surface", "surface"),
    (hand_filter, "find_palm", "find"),
)
"""Where the parts of a frame are called, and what they are part of; within others: ``joint`` and ``find``."""


@dataclass(slots=True)
class Costs:
    """CPU milliseconds for each frame: ``whole`` with nothing measured inside; of its ``part``s when the same frames
    are tracked once more, *rest* what these leave of the whole; ``with_part`` of whole frames that had one; the plain
    filter's step as ``reference``."""

    whole: list[float] = field(default_factory=list)
    part: defaultdict[str, list[float]] = field(default_factory=lambda: defaultdict(list))
    with_part: defaultdict[str, list[float]] = field(default_factory=lambda: defaultdict(list))
    reference: list[float] = field(default_factory=list)
    tracked: int = 0

    @property
    def in_words(self) -> str:
        return f"640 x 480, {len(self.whole)} frames, {100.0 * self.tracked / len(self.whole):.1f} % tracked"


def read_frames(folder: Path) -> list[Frame]:
    """All frames, decoded."""
    return list(TumFolder(folder).frames())


def make_pipeline(folder: Path, frames: list[Frame]) -> tuple[FramePipeline, float]:
    """A calibrated pipeline at its start, and until when the hand was still."""
    camera, settings = TumFolder(folder).info.camera, TrackSettings()
    opening = [frame for frame in frames if frame.timestamp_s - frames[0].timestamp_s <= settings.calibration.still_s]
    outcome = calibrate_hand(
        read_clicks(folder / CLICKS_FILE), opening, camera, settings.calibration, settings.detection, None
    )
    ends_s = opening[max(outcome.capture_frames, 1) - 1].timestamp_s
    learnt = noise_from_neutral(outcome.noise, ends_s, settings.tracker)
    return build_pipeline(outcome, camera, settings, learnt, keep_history=False), ends_s


def plain_step(plain: reference.ReferenceFilter, time_s: float, rng: np.random.Generator) -> float:
    """One step of the yardstick on its own motion; CPU milliseconds."""
    pixel = reference.project_markers(reference.motion(time_s)[None])[0] + rng.normal(0.0, 1.0, 2 * reference.MARKERS)
    times = Times()
    with times.measured():
        plain.step(pixel, 1.0 / 30.0)
    return times.cpu_ms[0]


def measure(folder: Path, costs: Costs, rounds: int, parts: Sequence[tuple[object, str, str]] = WRIST_PARTS) -> None:
    """Track the recording so often: once as a whole, and once with its parts measured, whose measuring costs itself."""
    frames = read_frames(folder)
    for _ in range(rounds):
        whole_ms = whole_frames(folder, frames, costs)
        pipeline, ends_s = make_pipeline(folder, frames)
        with spy_on_parts(pipeline, parts) as spy:
            for (frame, step_ms), whole in zip(beside_the_plain(frames, ends_s), whole_ms, strict=True):
                _parts(pipeline, frame, spy, whole, costs)
                step_ms()


def whole_frames(folder: Path, frames: list[Frame], costs: Costs) -> list[float]:
    """Track the recording once, nothing measured inside a frame; CPU milliseconds of each frame."""
    pipeline, ends_s = make_pipeline(folder, frames)
    times = Times()
    for frame, step_ms in beside_the_plain(frames, ends_s):
        with times.measured():
            tracked = pipeline(frame)
        costs.tracked += tracked.status is TrackStatus.TRACKED
        costs.reference.append(step_ms())
    costs.whole += times.cpu_ms
    return times.cpu_ms


def beside_the_plain(frames: list[Frame], ends_s: float) -> Iterator[tuple[Frame, Callable[[], float]]]:
    """The frames after the hand was still, each with the plain filter's step to be taken after it; CPU milliseconds.

    Between two frames other work is done here as at the bedside: no frame finds the processor's memory as it left it.
    """
    plain, rng = reference.ReferenceFilter(), np.random.default_rng(0)
    for frame in frames:
        if frame.timestamp_s > ends_s:
            yield frame, partial(plain_step, plain, frame.timestamp_s - ends_s, rng)


@contextmanager
def spy_on_parts(pipeline: FramePipeline, parts: Sequence[tuple[object, str, str]] = WRIST_PARTS) -> Iterator[Spy]:
    """The pipeline with its parts measured."""
    spy = Spy()
    spy.watch(pipeline.detector, "detect", "narrow", "wide", choose=lambda _, region=None: int(region is None))
    try:
        for place, name, label in parts:
            spy.watch(place, name, label)
        yield spy
    finally:
        spy.leave()


def _parts(pipeline: FramePipeline, frame: Frame, spy: Spy, whole: float, costs: Costs) -> None:
    """Track a frame that costs ``whole`` once more, its parts measured."""
    before = {label: spy.calls(label) for label in spy.times}
    pipeline(frame)
    part = {label: spy.cpu_since(label, before[label]) for label in spy.times}
    part["detection"] = part.pop("narrow") + part.pop("wide")
    for label in ("joint", "find"):
        if label in part and part.pop(label) and spy.calls(label) > before[label]:
            costs.with_part[label].append(whole)
    part["rest"] = whole - sum(part.values())
    for label, ms in part.items():
        costs.part[label].append(ms)
    for label in ("narrow", "wide"):
        costs.part[label] += spy.times[label].cpu_ms[before[label] :]


def report(rounds: int) -> Iterator[str]:
    """Measure and tell, line by line."""
    costs, leaving = Costs(), Costs()
    measure(render_cached(ORDINARY, workers=2), costs, rounds)
    measure(render_cached(LEAVING, workers=2), leaving, rounds)
    plain, part = float(np.median(costs.reference)), costs.part
    yield f"Wrist, {costs.in_words}"
    yield HEAD
    yield line("plain augmented UKF, 49/99", costs.reference, plain, "the yardstick: 21 markers, filter only")
    promised = f"nothing measured inside; promised: {MOST_MEDIAN_MS} ms"
    yield line("whole frame", costs.whole, plain, promised)
    for label, note in {
        "detection": "the parts: the same frames tracked once more",
        "association": "with the update by the discs",
        "filter": "predict, and what the camera should see, all motion modes",
        "surface": "readings taken, error reset, fitted, and the update by it",
        "rest": "what is left of the whole: angles, standard deviations, bookkeeping",
    }.items():
        yield line(f"- {label}", part[label], plain, note)
    yield line("search where expected", part["narrow"], plain)
    yield line("search of the whole picture", part["wide"] + leaving.part["wide"], plain)
    joint, again = (costs.with_part[label] + leaving.with_part[label] for label in ("joint", "find"))
    seldom = f"{len(costs.with_part['joint'])} of {len(costs.whole)} frames"
    yield line("frame with joint association", joint, plain, seldom)
    yield line("frame that looks for the lost hand", again, plain)
    yield line("hand that leaves and returns, whole frame", leaving.whole, plain)
