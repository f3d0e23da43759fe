"""Cost of one tracked frame of the whole hand, 21 discs, and of its parts, beside the plain filter in the same run."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from core.pipeline.frame_walk import FrameWalk
from core.simulation.recording import cached_recording
from core.simulation.spec import RecordingSpec
from core.tracking import finger_naming, naming
from core.types import Frame, TrackStatus
from tests.bench import reference
from tests.bench.timing import HEAD, Spy, Times, line
from tests.bench.tracking import Costs, frames_of, plain_step, walk_of

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
MOST_MEDIAN_MS, MOST_P95_MS = 1.5, 3.0


def measure(folder: Path, costs: Costs, rounds: int) -> None:
    """Track the recording so often, the plain filter stepped once after every frame."""
    frames = frames_of(folder)
    for _ in range(rounds):
        walk, ends_s = walk_of(folder, frames)
        plain, rng = reference.ReferenceFilter(), np.random.default_rng(0)
        spy = Spy()
        spy.watch(walk.detector, "detect", "detect")
        spy.watch(naming.association, "log_odds", "names")
        spy.watch(naming.association, "resolve", "names")
        spy.watch(naming, "associate_jointly", "names")
        spy.watch(finger_naming, "_ray_jointly", "names")
        try:
            for frame in frames:
                if frame.timestamp_s > ends_s:
                    _one_frame(walk, frame, spy, costs)
                    costs.reference.append(plain_step(plain, frame.timestamp_s - ends_s, rng))
        finally:
            spy.leave()


def _one_frame(walk: FrameWalk, frame: Frame, spy: Spy, costs: Costs) -> None:
    before = {label: spy.calls(label) for label in spy.times}
    times = Times()
    with times.measured():
        tracked = walk(frame)
    whole, detection, association = (
        times.cpu_ms[0],
        *(spy.cpu_since(part, before[part]) for part in ("detect", "names")),
    )
    costs.whole.append(whole)
    costs.detection.append(detection)
    costs.association.append(association)
    costs.filter.append(whole - detection - association)
    costs.tracked += tracked.status is TrackStatus.TRACKED


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
    yield line("whole frame", costs.whole, plain, f"promised: {MOST_MEDIAN_MS} ms, p95 {MOST_P95_MS} ms")
    yield line("- detection", costs.detection, plain)
    yield line("- association", costs.association, plain, "of palm and fingers")
    yield line("- filter", costs.filter, plain, "predict and update, all motion modes, angles, standard deviations")
    if compare:
        from tests.bench import peers

        yield ""
        yield from peers.report(float(np.median(costs.whole)) / plain)
