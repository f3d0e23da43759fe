"""Names proposed for the discs of simulated hands: right for both sides, all sizes and directions, or not given."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from carpus.core.calibration.label_proposal import LabelProposal, propose_labels
from carpus.core.model.camera import DEFAULT_CAMERA
from carpus.core.model.hand.protocols import HAND21, WRIST6
from carpus.core.model.types import Detections, FloatArray, Side
from carpus.core.simulation.spec import RecordingSpec
from tests.simulation.measurements import measurement_sequence

IntArray = NDArray[np.int64]
SEEDS = range(200, 203)


def hand(seed: int, side: Side, protocol: str = "hand21", false_blobs: float = 0.0) -> tuple[Detections, IntArray]:
    """Blobs of a picture of a still hand that lies in any direction, and the true blob of every marker, -1 for none."""
    rng = np.random.default_rng(seed)
    spec = RecordingSpec(
        seed=seed,
        hand=side,
        protocol=protocol,
        motion="rest",
        seconds=0.1,
        false_blobs=false_blobs,
        yaw_deg=float(rng.uniform(-180.0, 180.0)),
        hand_length_mm=float(rng.uniform(125.0, 210.0)),
    )
    sequence = measurement_sequence(spec)
    return sequence.detections[1], sequence.marker[1]


def find_blob(marker: IntArray, count: int) -> IntArray:
    true = np.full(count, -1)
    true[marker[marker >= 0]] = np.flatnonzero(marker >= 0)
    return true


def is_complete(proposal: LabelProposal) -> bool:
    return bool((proposal.blob >= 0).all())


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("side", ["right", "left"])
def test_propose_labels_among_false_blobs_labels_all(side: Side, seed: int) -> None:
    blobs, marker = hand(seed, side, false_blobs=3.0)
    proposal = propose_labels(blobs, DEFAULT_CAMERA, side, HAND21)
    assert np.array_equal(proposal.blob, find_blob(marker, 21))
    assert proposal.is_sure.sum() >= 20
    assert np.nanmax(proposal.misfit_m) < 0.01


@pytest.mark.parametrize("seed", SEEDS)
def test_propose_labels_of_the_palm_labels_six(seed: int) -> None:
    blobs, marker = hand(seed, "left", "wrist6", false_blobs=2.0)
    proposal = propose_labels(blobs, DEFAULT_CAMERA, "left", WRIST6)
    assert np.array_equal(proposal.blob, find_blob(marker, 6))
    assert proposal.is_sure.all(), "six right names are confirmed at once"
    other = propose_labels(blobs, DEFAULT_CAMERA, "right", WRIST6)
    assert not (is_complete(other) and other.is_sure.any()), "the other hand's names are looked at one by one"


@pytest.mark.parametrize(("seed", "gone"), [(1076, "CMC1"), (1101, "CMC1"), (1163, "MCP4"), (1046, "MCP4")])
def test_propose_labels_missing_palm_marker_is_not_replaced(seed: int, gone: str) -> None:
    side: Side = "left" if seed % 2 else "right"
    blobs, marker = hand(seed, side, "wrist6", false_blobs=4.0)
    there = np.arange(len(blobs)) != find_blob(marker, 6)[WRIST6.markers.index(gone)]
    assert is_complete(propose_labels(blobs, DEFAULT_CAMERA, side, WRIST6))
    assert not is_complete(propose_labels(blobs.subset(there), DEFAULT_CAMERA, side, WRIST6))


def test_propose_labels_keeps_given_labels() -> None:
    blobs, marker = hand(201, "right")
    true = find_blob(marker, 21)
    given = {row: int(true[row]) for row in (0, 1, 5, 9, 17)}
    assert np.array_equal(propose_labels(blobs, DEFAULT_CAMERA, "right", HAND21, given_labels=given).blob, true)
    tip, other = HAND21.markers.index("TIP2"), HAND21.markers.index("TIP3")
    turned_round = given | {tip: int(true[other]), other: int(true[tip])}
    kept = propose_labels(blobs, DEFAULT_CAMERA, "right", HAND21, given_labels=turned_round)
    assert all(kept.blob[row] == blob for row, blob in turned_round.items())
    assert len(set(kept.blob[kept.blob >= 0])) == np.count_nonzero(kept.blob >= 0)


def test_propose_labels_without_hand_labels_none() -> None:
    rng = np.random.default_rng(3)
    for count in (0, 1, 5, 24):
        pixel = rng.uniform((0.0, 0.0), (640.0, 480.0), (count, 2))
        many: FloatArray = np.full(count, 0.7)
        blobs = Detections(pixel, many, 0.001 * many, 80.0 * many, many)
        proposal = propose_labels(blobs, DEFAULT_CAMERA, "right", HAND21)
        assert not is_complete(proposal)
        assert proposal.is_sure.sum() <= 4
