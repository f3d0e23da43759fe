"""Cost of one tracked frame of wrist and whole hand, and of its parts, beside the plain filter in the same run."""

from __future__ import annotations

import time
from collections import defaultdict
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from carpus.core.calibration.calibrate import calibrate_hand
from carpus.core.calibration.clicks_file import read_clicks
from carpus.core.capture.files.tum import TumFolder
from carpus.core.model.types import Frame, TrackStatus
from carpus.core.pipeline import track
from carpus.core.pipeline.track import FramePipeline, TrackSettings, build_pipeline, noise_from_neutral
from carpus.core.simulation.recording import CLICKS_FILE, render_cached
from carpus.core.simulation.spec import RecordingSpec
from carpus.core.tracking import hand_filter
from tests.bench import reference

USUAL: dict[str, Any] = {"hidden_share": 0.03, "false_blobs": 1.0, "distance_m": 0.66, "light": "normal"}
WRIST = (RecordingSpec(seed=11, motion="mixed", seconds=6.0, **USUAL),)
HAND = tuple(
    RecordingSpec(seed=seed, protocol="hand21", motion=motion, seconds=5.0, **USUAL)
    for seed, motion in ((21, "fist"), (24, "fingers"))
)
PARTS = (
    (hand_filter, "associate_and_update", "association"),
    (hand_filter, "predict_measurement_ahead", "prediction"),
    (hand_filter, "fit_surface", "surface"),
    (track, "sample_surface", "surface"),
)
"""Where the parts of a frame are called, and what they are part of."""
NOTES = {
    "detection": "the parts: the same frames tracked once more",
    "association": "of the palm, with the update by its discs",
    "prediction": "predict, and what the camera should see, all motion modes",
    "surface": "readings on the back of the hand, and the fit to them",
    "rest": "what is left of the whole: fingers, angles, standard deviations, bookkeeping",
}


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


@contextmanager
def spy_on_parts(pipeline: FramePipeline) -> Iterator[dict[str, float]]:
    """CPU milliseconds that each part has taken so far, while this lasts."""
    spent: dict[str, float] = defaultdict(float)
    with pytest.MonkeyPatch.context() as patch:
        for place, name, label in ((pipeline.detector, "detect", "detection"), *PARTS):

            def timed(*arguments: Any, true: Any, label: str) -> Any:
                begin_s = time.thread_time()
                try:
                    return true(*arguments)
                finally:
                    spent[label] += 1e3 * (time.thread_time() - begin_s)

            patch.setattr(place, name, partial(timed, true=getattr(place, name), label=label))
        yield spent


def measure(specs: Sequence[RecordingSpec], rounds: int) -> tuple[dict[str, list[float]], int]:
    """CPU milliseconds of each frame, of the plain filter's step and of the parts, and how many frames were tracked.

    Every recording is tracked once as a whole and once with its parts measured, whose measuring costs itself. Between
    two frames other work is done, as at the bedside: no frame finds the processor's memory as it left it.
    """
    costs: dict[str, list[float]] = defaultdict(list)
    tracked, rng = 0, np.random.default_rng(0)
    for folder in [render_cached(spec, workers=2) for spec in specs for _ in range(rounds)]:
        frames, plain = list(TumFolder(folder).frames()), reference.ReferenceFilter()
        pipeline, ends_s = make_pipeline(folder, frames)
        moving, whole_ms = [frame for frame in frames if frame.timestamp_s > ends_s], []
        for frame in moving:
            truth = reference.motion(frame.timestamp_s - ends_s)
            pixel = reference.project_markers(truth[None])[0] + rng.normal(0.0, 1.0, 2 * reference.MARKERS)
            at_s = [time.thread_time()]
            tracked += pipeline(frame).status is TrackStatus.TRACKED
            at_s.append(time.thread_time())
            plain.step(pixel, 1.0 / 30.0)
            at_s.append(time.thread_time())
            whole_ms.append(1e3 * (at_s[1] - at_s[0]))
            costs["plain"].append(1e3 * (at_s[2] - at_s[1]))
        costs["whole"] += whole_ms
        pipeline, _ = make_pipeline(folder, frames)
        with spy_on_parts(pipeline) as spent:
            for frame, ms in zip(moving, whole_ms, strict=True):
                spent.clear()
                pipeline(frame)
                for label in NOTES:
                    costs[label].append(spent[label] if label != "rest" else ms - sum(spent.values()))
    return costs, tracked


def report(rounds: int) -> Iterator[str]:
    """Measure and tell, line by line."""
    for name, specs, goal in (
        ("Wrist", WRIST, "promised: 1.3 ms"),
        ("Whole hand", HAND, "promised: 3.0 ms, p95 6.0 ms"),
    ):
        costs, tracked = measure(specs, rounds)
        yield f"{name}, 640 x 480, {len(costs['whole'])} frames, {100.0 * tracked / len(costs['whole']):.1f} % tracked"
        yield "| what | CPU ms, median | p95 | ratio | note |\n|---|---|---|---|---|"
        for label, note in {"plain": "the yardstick: augmented UKF, 49/99", "whole": goal, **NOTES}.items():
            median, p95 = np.percentile(costs[label], (50.0, 95.0))
            yield f"| {label} | {median:.3f} | {p95:.3f} | {median / np.median(costs['plain']):.2f} | {note} |"
