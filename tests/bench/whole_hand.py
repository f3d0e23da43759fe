"""Cost of one tracked frame of the whole hand, 21 discs, and of its parts, beside the plain filter in the same run."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from carpus.core.pipeline import track
from carpus.core.pipeline.track import FramePipeline
from carpus.core.simulation.recording import cached_recording
from carpus.core.simulation.spec import RecordingSpec
from carpus.core.tracking import digit_association, hand_filter
from carpus.core.types import Frame
from tests.bench.timing import HEAD, Spy, line
from tests.bench.tracking import Costs, beside_the_plain, frames_of, pipeline_of, whole_frames

FIST, FINGERS = (
    RecordingSpec(
        seed=seed,
        protocol="hand21",
        motion=motion,
        seconds=5.0,
        hidden_share=0.03,
        false_blobs=1.0,
        distance_m=0.66,
        light="normal",
    )
    for seed, motion in ((21, "fist"), (24, "fingers"))
)
MOST_MEDIAN_MS, MOST_P95_MS = 3.0, 6.0


def measure(folder: Path, costs: Costs, rounds: int) -> None:
    """Track the recording so often: once as a whole, and once with its parts measured, whose measuring costs itself."""
    frames = frames_of(folder)
    for _ in range(rounds):
        whole_ms = whole_frames(folder, frames, costs)
        pipeline, ends_s = pipeline_of(folder, frames)
        spy = Spy()
        spy.watch(pipeline.detector, "detect", "detect")
        spy.watch(hand_filter, "associate_and_update", "names")
        spy.watch(digit_association, "_digit_jointly", "names")
        spy.watch(hand_filter, "reset_and_levelled", "surface")
        spy.watch(track, "surface_samples", "surface")
        try:
            for (frame, step_ms), whole in zip(beside_the_plain(frames, ends_s), whole_ms, strict=True):
                _parts(pipeline, frame, spy, whole, costs)
                step_ms()
        finally:
            spy.leave()


def _parts(pipeline: FramePipeline, frame: Frame, spy: Spy, whole: float, costs: Costs) -> None:
    """Track a frame that costs ``whole`` once more, its parts measured."""
    before = {label: spy.calls(label) for label in spy.times}
    pipeline(frame)
    detection, association, surface = (spy.cpu_since(part, before[part]) for part in ("detect", "names", "surface"))
    costs.detection.append(detection)
    costs.association.append(association)
    costs.surface.append(surface)
    costs.filter.append(whole - detection - association - surface)


def measured(rounds: int) -> Costs:
    """A fist and single fingers, pooled."""
    costs = Costs()
    for spec in (FIST, FINGERS):
        measure(cached_recording(spec, workers=2), costs, rounds)
    return costs


def report(rounds: int, *, compare: bool = False) -> Iterator[str]:
    """Measure and tell, line by line; ``compare`` with other people's work too."""
    costs = measured(rounds)
    plain = float(np.median(costs.reference))
    yield f"Whole hand, 640 x 480, {len(costs.whole)} frames, {100.0 * costs.tracked / len(costs.whole):.1f} % tracked"
    yield HEAD
    yield line("plain augmented UKF, 49/99", costs.reference, plain, "the yardstick: 21 markers, filter only")
    promised = f"promised: {MOST_MEDIAN_MS} ms, p95 {MOST_P95_MS} ms"
    yield line("whole frame", costs.whole, plain, f"nothing measured inside; {promised}")
    yield line("- detection", costs.detection, plain, "the parts: the same frames tracked once more")
    yield line(
        "- association", costs.association, plain, "of the palm with the update by the discs, of fingers what is joint"
    )
    yield line("- surface", costs.surface, plain, "depth on the back of the hand: readings taken, and fitted")
    yield line("- filter", costs.filter, plain, "what is left: predict, update, all motion modes, angles, their sd")
    if compare:
        from tests.bench import peers

        yield ""
        yield from peers.report(float(np.median(costs.whole)) / plain)
