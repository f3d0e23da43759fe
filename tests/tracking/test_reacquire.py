"""Finding the palm among shuffled blobs without any prediction, and not finding one that is not there."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest

from carpus.core.model import so3
from carpus.core.model.types import Detections, Side
from carpus.core.tracking.association.reacquire import FoundPalm, TurnLimits, find_palm, is_other_hand
from carpus.core.tracking.filter.palm_state import SKIN, PalmView
from carpus.core.tracking.filter.soft_tissue import SoftTissue, stationary_covariance
from tests.suites import few
from tests.tracking.hands import (
    CAMERA,
    FROM_ABOVE,
    MCP5,
    MIDDLE_M,
    WRIST,
    Pose,
    blobs,
    build_rotation,
    combine_motions,
    palm,
)

ANYHOW = TurnLimits(np.eye(3), np.pi, np.pi)
STRAYS = stationary_covariance(SoftTissue())[SKIN, SKIN] + 4e-4**2 * np.eye(18)
SIDES: tuple[Side, Side] = ("right", "left")


def view(side: Side) -> PalmView:
    return PalmView(CAMERA, FROM_ABOVE, MIDDLE_M, palm(side), np.zeros((6, 18)))


def some_pose(rng: np.random.Generator) -> Pose:
    return Pose(rng.uniform(-1.0, 1.0, 3) * [30.0, 50.0, 40.0], rng.uniform(-0.06, 0.06, 3))


def clutter(rng: np.random.Generator, count: int) -> list[tuple[float, float]]:
    return [(float(rng.uniform(20, 620)), float(rng.uniform(20, 460))) for _ in range(count)]


def search_palm(seen: Detections, side: Side = "right", about: TurnLimits = ANYHOW) -> FoundPalm | None:
    """What is found among blobs of a palm of which nothing else is known."""
    return find_palm(seen, view(side), STRAYS, about)


@pytest.mark.parametrize("side", SIDES)
@pytest.mark.parametrize("seed", few(range(12), 3))
def test_find_palm_among_shuffled_blobs_and_clutter(side: Side, seed: int) -> None:
    rng = np.random.default_rng(seed)
    pose = some_pose(rng)
    found = search_palm(blobs(pose, rng, side=side, false_px=clutter(rng, 8)), side)
    assert found is not None
    position, rotation = found.position_m, found.rotation_w2_w0
    true = build_rotation(*pose.angles_deg, side=side)
    discs, there = palm(side) @ rotation.T + position, palm(side) @ true.T + pose.position_m
    assert np.linalg.norm(discs - there, axis=1).max() < 0.004
    assert found.count == 6


@pytest.mark.parametrize("side", SIDES)
@pytest.mark.parametrize("hidden", [(0,), (3,), (1, 5), (0, 3), (2, 4)])
def test_find_palm_four_or_five_markers_are_enough(side: Side, hidden: tuple[int, ...]) -> None:
    rng = np.random.default_rng(20)
    found_right = 0
    for _ in range(10):
        pose = some_pose(rng)
        found = search_palm(blobs(pose, rng, side=side, hidden=hidden), side)
        if found is None:
            continue  # two poses explain the four discs: then none is taken
        assert found.count >= 6 - len(hidden)
        there = palm(side) @ build_rotation(*pose.angles_deg, side=side).T + pose.position_m
        shown = np.setdiff1d(np.arange(6), hidden)
        discs = palm(side) @ found.rotation_w2_w0.T + found.position_m
        assert np.linalg.norm((discs - there)[shown], axis=1).max() < 0.006
        found_right += 1
    assert found_right >= 8


@pytest.mark.parametrize("hidden", [(), (WRIST,), (MCP5,)])
def test_is_other_hand_separates_the_hands(hidden: tuple[int, ...]) -> None:
    """By whichever of its blobs were named, and however the hand lies; nothing of this palm is said to be the other."""
    rng = np.random.default_rng(46)
    told = {"right": 0, "left": 0}
    for _ in range(20):
        pose = some_pose(rng)
        for side in SIDES:
            seen = blobs(pose, rng, side=side, hidden=hidden)
            is_named = np.zeros(len(seen), dtype=bool)
            is_named[rng.choice(len(seen), 3, replace=False)] = True
            told[side] += is_other_hand(seen, is_named, view("right"))
    assert told["left"] == 20
    assert told["right"] == 0


def test_find_palm_four_markers_are_labelled_right_or_not_at_all() -> None:
    """Knuckles in a row look much like others, more so where skin has glided: what fits two ways is not taken."""
    rng = np.random.default_rng(44)
    glide = np.linalg.cholesky(stationary_covariance(SoftTissue())[SKIN, SKIN])
    right, wrong = 0, 0
    for hidden in combinations(range(6), 2):
        for _ in range(8):
            worn = palm("right") + (glide @ rng.normal(size=18)).reshape(6, 3)
            strange = PalmView(CAMERA, FROM_ABOVE, MIDDLE_M, worn, np.zeros((6, 18)))
            found = find_palm(blobs(some_pose(rng), rng, hidden=hidden), strange, STRAYS, ANYHOW)
            if found is not None:
                is_right = np.array_equal(np.flatnonzero(found.matched), np.setdiff1d(np.arange(6), hidden))
                right, wrong = right + is_right, wrong + (not is_right)
    assert wrong <= 1
    assert right > 50


def test_find_palm_palmar_side_gives_none() -> None:
    """The same discs turned over: the back of the hand must face the camera."""
    rng = np.random.default_rng(41)
    for _ in range(10):
        pose = Pose(np.array([rng.uniform(-40, 40), 0.0, 180.0]))
        assert search_palm(blobs(pose, rng)) is None


def test_find_palm_without_depth_gives_none() -> None:
    assert search_palm(blobs(Pose(), np.random.default_rng(1), with_depth=False)) is None
    assert search_palm(Detections.none()) is None


def test_find_palm_two_palms_give_none() -> None:
    """Two equal constellations far apart: neither is taken."""
    one, other = blobs(Pose()), blobs(Pose(position_m=np.array([0.0, 0.12, 0.0])))
    assert search_palm(combine_motions(one, other)) is None
    assert search_palm(one) is not None


def test_find_palm_many_blobs_searches_the_most_similar() -> None:
    rng = np.random.default_rng(42)
    seen = blobs(Pose(), rng, false_px=clutter(rng, 60))
    likeness = np.where(
        np.linalg.norm(seen.pixel[:, None] - blobs(Pose()).pixel[None], axis=-1).min(axis=1) < 1.0, 0.95, 0.6
    )
    found = search_palm(replace(seen, similarity=likeness))
    assert found is not None
    assert found.count == 6


@pytest.mark.parametrize("hidden", few([[], [0, 1], [0], [1, 3]], 2))
def test_found_palm_covariance_covers_its_error(hidden: list[int]) -> None:
    """Its errors are as large as stated, also about the line of the knuckles when only those show."""
    rng = np.random.default_rng(43)
    shown = np.setdiff1d(np.arange(6), hidden)
    squared = []
    for _ in range(40):
        pose = Pose(rng.uniform(-1.0, 1.0, 3) * 15.0)
        found = search_palm(blobs(pose, rng, hidden=hidden))
        if found is None:
            continue
        true = build_rotation(*pose.angles_deg)
        error = np.concatenate((pose.position_m - found.position_m, so3.log(found.rotation_w2_w0.T @ true)))
        covariance = found.pose_covariance(palm("right"))
        assert np.linalg.eigvalsh(covariance)[0] > 0.0
        squared.append(float(error @ np.linalg.solve(covariance, error)))
        assert np.array_equal(np.flatnonzero(found.matched), shown)
    assert len(squared) >= 27
    assert np.mean(np.array(squared) < 16.8) > 0.95  # 99 % of chi squared with six degrees of freedom
