"""Cost of one tracked frame of the whole hand, 21 discs, and of its parts, beside the plain filter in the same run."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from carpus.core.pipeline import track
from carpus.core.simulation.recording import render_cached
from carpus.core.simulation.spec import RecordingSpec
from carpus.core.tracking import hand_filter
from carpus.core.tracking.digits import digit_association
from tests.bench.timing import HEAD, line
from tests.bench.tracking import Costs, measure

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


PARTS = (
    (hand_filter, "associate_and_update", "association"),
    (digit_association, "_associate_digit_jointly", "association"),
    (hand_filter, "fit_surface", "surface"),
    (track, "sample_surface", "surface"),
)


def report(rounds: int) -> Iterator[str]:
    """Measure and tell, line by line."""
    costs = Costs()
    for spec in (FIST, FINGERS):
        measure(render_cached(spec, workers=2), costs, rounds, PARTS)
    plain = float(np.median(costs.reference))
    yield f"Whole hand, {costs.in_words}"
    yield HEAD
    yield line("plain augmented UKF, 49/99", costs.reference, plain, "the yardstick: 21 markers, filter only")
    promised = f"promised: {MOST_MEDIAN_MS} ms, p95 {MOST_P95_MS} ms"
    yield line("whole frame", costs.whole, plain, f"nothing measured inside; {promised}")
    for label, part, note in (
        ("detection", "detection", "the parts: the same frames tracked once more"),
        ("association", "association", "of the palm with the update by the discs, of fingers what is joint"),
        ("surface", "surface", "depth on the back of the hand: readings taken, and fitted"),
        ("filter", "rest", "what is left: predict, update, all motion modes, angles, their sd"),
    ):
        yield line(f"- {label}", costs.part[part], plain, note)
