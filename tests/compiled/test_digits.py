"""Thumb and fingers, compiled, against NumPy."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from carpus.core.calibration.result import Calibration
from carpus.core.compiled import digit_images
from carpus.core.compiled import digits as compiled
from carpus.core.model.types import FloatArray
from carpus.core.simulation.spec import RecordingSpec
from carpus.core.tracking.association.palm_association import Measurements
from carpus.core.tracking.digits.digit_association import DigitAssignment, DigitScene, measurements_from_assignment
from carpus.core.tracking.digits.digit_readout import DigitBase, base_from_estimate
from carpus.core.tracking.filter.digit_filter import (
    OBSERVED,
    DigitLinearisation,
    DigitSigmaPoints,
    digit_sigma_weights,
    draw_sigma_points,
    linearise_digits,
)
from carpus.core.tracking.filter.hand_geometry import palm_calibration
from carpus.core.tracking.filter.joint_limits import _DIRECTION, LIMIT_GATE_SD, LIMIT_SD_RAD, slot_limits_rad
from carpus.core.tracking.filter.mixture_filter import ModeMixture
from carpus.core.tracking.filter.readout import Readout
from carpus.core.tracking.filter.settings import TrackerSettings
from carpus.core.tracking.filter.unscented import UnscentedParameters
from carpus.core.tracking.finger_filter import FingerFilter
from carpus.core.tracking.hand_filter import HandFilter
from tests.compiled.comparing import LAYOUTS, assert_same, laid_out
from tests.compiled.oracle import digit_images as seen_oracle
from tests.compiled.oracle import digits as oracle
from tests.compiled.test_mixture import covariances
from tests.simulation.measurements import MeasurementSequence, measurement_sequence
from tests.tracking.hands import CAMERA
from tests.tracking.sequences import calibrate_sequence
from tests.tracking.test_palm_filter import moving

SETTINGS = TrackerSettings()
Laid = Callable[[np.ndarray], np.ndarray]


@dataclass(frozen=True)
class Hand:
    """A calibrated hand whose palm sits somewhere, its digits bent at random."""

    fingers: FingerFilter
    base: DigitBase
    mean: FloatArray
    covariance: FloatArray

    @property
    def root_m(self) -> FloatArray:
        return self.base.palm.disc_m[1:]

    def points(self) -> DigitSigmaPoints:
        return draw_sigma_points(self.mean, self.covariance, self.root_m, UnscentedParameters())

    def linearised(self) -> DigitLinearisation:
        return linearise_digits(self.points(), self.base.view, UnscentedParameters())

    def limited(self, mixture: ModeMixture) -> tuple[Any, ...]:
        """What the limits are asked with."""
        return mixture, slot_limits_rad(mixture.mean[:, 0, :5]), _DIRECTION, LIMIT_SD_RAD, LIMIT_GATE_SD


@cache
def sequence(side: str) -> MeasurementSequence:
    return measurement_sequence(RecordingSpec(seed=61, protocol="hand21", motion="fist", seconds=1.5, hand=side))


@cache
def known(side: str) -> Calibration:
    return calibrate_sequence(sequence(side))


@cache
def hand(side: str = "right", seed: int = 1, is_lost: bool = False) -> Hand:
    """``is_lost``: its joints may be anywhere."""
    rng = np.random.default_rng(seed)
    fingers = FingerFilter(known(side), CAMERA, SETTINGS)
    view = HandFilter(known(side), CAMERA, SETTINGS).view
    estimate = replace(moving(seed), covariance=1e-2 * moving(seed).covariance)
    base = base_from_estimate(estimate, view, Readout(palm_calibration(known(side)), view.camera, 6e-3))
    mean, covariance = fingers.model.neutral_mixture().merge()
    if is_lost:
        return Hand(fingers, base, *fingers.model.diffuse_mixture(mean, covariance).merge())
    scale = np.sqrt(np.diagonal(covariance, axis1=1, axis2=2))
    mean = mean + scale * rng.normal(size=mean.shape)
    mean[:, :5] += rng.uniform(0.0, 1.2, size=(5, 5))
    return Hand(fingers, base, mean, covariances(rng, 5, 21) * scale[:, :, None] * scale[:, None])


HANDS = [("right", 0, False), ("right", 1, False), ("left", 1, False), ("right", 1, True)]


@pytest.mark.parametrize("which", HANDS)
def test_points_and_their_images_are_the_oracles(which: tuple[str, int, bool]) -> None:
    it = hand(*which)
    points = it.points()
    assert_same(points, oracle.compute_digit_sigma_points(it.mean, it.covariance, it.root_m, UnscentedParameters()))
    linearised = it.linearised()
    assert_same(linearised, seen_oracle.linearise_images(points, it.base.view, UnscentedParameters()))
    of = it.covariance, it.base, linearised, points.normal
    assert_same(digit_images.compute_inherited(*of), seen_oracle.compute_inherited(*of))


@pytest.mark.parametrize("blobs", [0, 9])
def test_labelled_blob_measurement_matches_oracle(blobs: int) -> None:
    it, rng = hand("right", 0), np.random.default_rng(3)
    linearised = it.linearised()
    value = rng.normal(size=(blobs, 3)) + [300.0, 200.0, 0.7]
    value[1::3, 2] = np.nan
    assigned = np.where(rng.uniform(size=(5, 3)) < 0.6, rng.integers(0, max(blobs, 1), (5, 3)), -1)
    assigned = assigned.astype(np.int64) if blobs else np.full((5, 3), -1)
    names = DigitAssignment(assigned, (assigned >= 0) & (rng.uniform(size=(5, 3)) < 0.7))
    whole_px = np.where(rng.uniform(size=(5, 3)) < 0.2, np.nan, 60.0)
    crowded = replace(linearised, value=np.where(np.arange(9) % 3 == 2, 0.7, linearised.value * 0.05))
    for seen in (linearised, crowded):
        scene = DigitScene(
            it.covariance, seen, seen.image_covariance, seen.image_covariance, rng.uniform(0.3, 0.98, size=(5, 3)),
            Measurements(value, rng.uniform(0.01, 0.1, size=(blobs, 3))), np.ones(blobs, dtype=bool),
            rng.uniform(10.0, 90.0, size=blobs), whole_px, whole_px * 1e-6, rng.uniform(0.6, 3.0, size=(5, 9)), 3e5,
            it.base.view, 0.2, np.arange(5) < 4,
        )  # fmt: skip
        expected = seen_oracle.measured_as_named(scene, names, SETTINGS)
        assert_same(measurements_from_assignment(scene, names, SETTINGS), expected)
        for layout in LAYOUTS:
            scene_so, names_so = laid_out(scene, layout), laid_out(names, layout)
            assert_same(measurements_from_assignment(scene_so, names_so, SETTINGS), expected)
        for wrong in (replace(names, assigned=assigned[:4]), replace(names, assigned=np.full((5, 3), blobs))):
            with pytest.raises(ValueError, match="names"):
                measurements_from_assignment(scene, wrong, SETTINGS)


def test_bones_joints_and_discs_are_the_oracles() -> None:
    it, pose = hand(), hand().mean[:, OBSERVED]
    bone, normal, joint_m, disc_m = compiled.place_digits(pose, it.root_m)
    frames = oracle.digit_frames(pose)
    expected_m = oracle.digit_discs_m(it.root_m, pose[:, None])
    assert_same((bone, normal), frames)
    assert_same((joint_m, disc_m), (oracle.digit_joints_m(it.root_m, pose, frames), expected_m[:, 0]))
    some = [0, 2]
    many = np.repeat(pose[some, None], 4, axis=1) + np.linspace(0.0, 0.3, 4)[:, None]
    assert_same(compiled.place_discs(many, it.root_m[some], some), oracle.digit_discs_m(it.root_m[some], many, some))


@pytest.mark.parametrize("modes", [1, 2])
@pytest.mark.parametrize("wide", [1e-6, 1.0, 30.0])
def test_limits_are_the_oracles(modes: int, wide: float) -> None:
    it, rng = hand(), np.random.default_rng(15)
    for bent_rad in (0.0, 0.7, -1.2, 2.5, 40.0):
        mean = np.repeat(it.mean[:, None], modes, axis=1) + 0.01 * rng.normal(size=(5, modes, 21))
        mean[:, :, :5] += bent_rad
        asked = it.limited(
            ModeMixture(mean, np.repeat(wide * it.covariance[:, None], modes, axis=1), np.ones((5, modes)))
        )
        found, expected = compiled.apply_limits(*asked), oracle.apply_limits(*asked)
        assert (found is None) == (expected is None)
        if found is not None:
            assert_same(found, expected)


def test_limits_far_from_all_angles_change_nothing() -> None:
    bent = np.where(np.isin(np.arange(21), (1, 2)), 0.6, 0.0)
    sure = ModeMixture(np.tile(bent, (5, 1, 1)), np.tile(1e-7 * np.eye(21), (5, 1, 1, 1)), np.ones((5, 1)))
    assert oracle.apply_limits(*hand().limited(sure)) is None
    assert compiled.apply_limits(*hand().limited(sure)) is None


@pytest.mark.parametrize("layout", LAYOUTS)
def test_arrays_stored_otherwise_give_the_same(layout: Laid) -> None:
    it, weights = hand(), digit_sigma_weights(UnscentedParameters())
    points, linearised, pose = it.points(), it.linearised(), it.mean[:, OBSERVED]
    mixture = ModeMixture.from_gaussian(it.mean, it.covariance, it.fingers.model.scales.size)
    steps: list[tuple[Callable[..., Any], tuple[Any, ...]]] = [
        (compiled.place_digits, (pose, it.root_m)),
        (compiled.place_discs, (pose[1:3, None], it.root_m[1:3], [1, 2])),
        (compiled.compute_digit_sigma_points, (it.mean, it.covariance, it.root_m, weights.scale)),
        (digit_images.linearise_images, (points, it.base.view, weights)),
        (digit_images.compute_inherited, (it.covariance, it.base, linearised, points.normal)),
        (compiled.apply_limits, it.limited(mixture)),
    ]
    for step, of in steps:
        assert_same(step(*(laid_out(one, layout) for one in of)), step(*of), 0.0)


def test_unknown_digit_leaves_others_known() -> None:
    it, others = hand(), [0, 1, 3, 4]
    mean = it.mean.copy()
    mean[2, 1] = np.nan
    points = draw_sigma_points(mean, it.covariance, it.root_m, UnscentedParameters())
    linearised = linearise_digits(points, it.base.view, UnscentedParameters())
    for found, whole in ((points, it.points()), (linearised, it.linearised())):
        assert_same(laid_out(found, lambda one: one[others]), laid_out(whole, lambda one: one[others]), 0.0)
    expected = oracle.compute_digit_sigma_points(mean, it.covariance, it.root_m, UnscentedParameters())
    assert_same((points.disc_m, points.normal), (expected.disc_m, expected.normal))
    assert_same(linearised.value, seen_oracle.linearise_images(expected, it.base.view, UnscentedParameters()).value)
    asked = it.limited(ModeMixture.from_gaussian(mean, it.covariance, it.fingers.model.scales.size))
    assert_same(compiled.apply_limits(*asked), oracle.apply_limits(*asked))


def test_digits_invalid_covariance_is_refused() -> None:
    it = hand()
    with pytest.raises(np.linalg.LinAlgError):
        draw_sigma_points(it.mean, -it.covariance, it.root_m, UnscentedParameters())
    with pytest.raises(np.linalg.LinAlgError):
        digit_images.compute_inherited(-it.covariance, it.base, it.linearised(), it.points().normal)


def test_sizes_that_do_not_fit_are_refused() -> None:
    it, weights = hand(), digit_sigma_weights(UnscentedParameters())
    points, linearised, pose, view = it.points(), it.linearised(), it.mean[:, OBSERVED], it.base.view
    mixture = ModeMixture.from_gaussian(it.mean, it.covariance, it.fingers.model.scales.size)
    _, limits, *rest = it.limited(mixture)
    wrong: list[tuple[Callable[..., Any], tuple[Any, ...]]] = [
        (compiled.place_digits, (it.mean, it.root_m)),
        (compiled.place_digits, (pose, it.root_m[:4])),
        (compiled.place_discs, (pose[1:3, None], it.root_m[1:3], [1])),
        (compiled.compute_digit_sigma_points, (pose, it.covariance, it.root_m, 1.0)),
        (compiled.compute_digit_sigma_points, (it.mean, it.covariance[:, :20], it.root_m, 1.0)),
        (compiled.compute_digit_sigma_points, (it.mean.astype(np.float32), it.covariance, it.root_m, 1.0)),
        (digit_images.linearise_images, (replace(points, along=points.along[..., :9]), view, weights)),
        (digit_images.linearise_images, (points, replace(view, rotation=view.rotation[:2]), weights)),
        (digit_images.compute_inherited, (it.covariance[:4], it.base, linearised, points.normal)),
        (
            digit_images.compute_inherited,
            (it.covariance, replace(it.base, turn_covariance=np.eye(6)), linearised, points.normal),
        ),
        (compiled.apply_limits, (mixture, limits[:, :4], *rest)),
        (compiled.apply_limits, (replace(mixture, covariance=mixture.covariance[..., :20]), limits, *rest)),
    ]
    for step, of in wrong:
        with pytest.raises(ValueError, match=r"is read|dtype|dimensions"):
            step(*of)
