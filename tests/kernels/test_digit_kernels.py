"""Thumb and fingers in C against NumPy."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from carpus.core.calibration.result import Calibration
from carpus.core.kernels import choice
from carpus.core.simulation.spec import RecordingSpec
from carpus.core.tracking.digit_filter import DigitPoints, DigitsLinearisation, digits_linearised, spread_points
from carpus.core.tracking.digit_naming import DigitPicture, FingerTrial
from carpus.core.tracking.digit_readout import Seat, seat_of
from carpus.core.tracking.finger_depth import knuckle_bends
from carpus.core.tracking.finger_model import FingerModel
from carpus.core.tracking.fingers import Fingers
from carpus.core.tracking.hand_filter import HandFilter
from carpus.core.tracking.hand_geometry import palm_of
from carpus.core.tracking.joint_limits import settled
from carpus.core.tracking.kernel import ModeMixture
from carpus.core.tracking.palm_association import Measurements
from carpus.core.tracking.palm_state import SHAPE, SIZE, PalmEstimate
from carpus.core.tracking.readout import Readout
from carpus.core.tracking.settings import TrackerSettings
from carpus.core.tracking.tracker import FrameResults
from carpus.core.tracking.unscented import Spread
from carpus.core.types import FloatArray, SurfaceSamples
from tests.kernels.pairs import both
from tests.kernels.test_filter_kernels import covariances
from tests.simulation.measurements import MeasurementSequence, measurement_sequence
from tests.suites import few
from tests.tracking.hands import CAMERA, RIGHT_PALM_M
from tests.tracking.sequences import calibrated
from tests.tracking.test_finger_depth import VIEW, readings, states
from tests.tracking.test_palm_filter import moving

SETTINGS = TrackerSettings()


@dataclass(frozen=True)
class Hand:
    """A calibrated hand whose palm sits somewhere, its digits bent at random."""

    fingers: Fingers
    seat: Seat
    mean: FloatArray
    covariance: FloatArray

    def points(self) -> DigitPoints:
        return spread_points(self.mean, self.covariance, self.seat.palm.disc_m[1:], Spread())

    def linearised(self) -> DigitsLinearisation:
        return digits_linearised(self.points(), self.seat.view, Spread())


@cache
def sequence(side: str) -> MeasurementSequence:
    return measurement_sequence(RecordingSpec(seed=61, protocol="hand21", motion="fist", seconds=1.5, hand=side))


@cache
def known(side: str) -> Calibration:
    return calibrated(sequence(side))


@cache
def hand(side: str, seed: int, dip: str = "coupled") -> Hand:
    rng = np.random.default_rng(seed)
    settings = replace(SETTINGS, dip=dip)
    fingers = Fingers(known(side), CAMERA, settings)
    view = HandFilter(known(side), CAMERA, settings).view
    estimate = replace(moving(seed), covariance=1e-2 * moving(seed).covariance)
    seat = seat_of(estimate, view, Readout(palm_of(known(side)), view.camera, 6e-3))
    mean, covariance = fingers.model.at_neutral().merged()
    scale = np.sqrt(np.diagonal(covariance, axis1=1, axis2=2))
    mean = mean + scale * rng.normal(size=mean.shape)
    mean[:, :5] += rng.uniform(0.0, 1.2, size=(5, 5))
    return Hand(fingers, seat, mean, covariances(rng, 5, 21) * scale[:, :, None] * scale[:, None])


@pytest.mark.parametrize("side", ["right", "left"])
@pytest.mark.parametrize("seed", few(range(3)))
def test_points_and_what_the_camera_sees_of_them(side: str, seed: int) -> None:
    it = hand(side, seed)
    points = both(it.points)
    both(lambda: digits_linearised(points, it.seat.view, Spread()))


@pytest.mark.parametrize("side", ["right", "left"])
def test_the_seat_of_the_digits(side: str) -> None:
    view, own = HandFilter(known(side), CAMERA, SETTINGS).view, palm_of(known(side))
    for seed in range(3):
        estimate = moving(seed)
        further = replace(estimate, value=estimate.value + np.where(np.arange(SIZE) == SHAPE.start, 1e-4, 0.0))
        unknown = replace(estimate, value=np.full(SIZE, np.nan))

        def seats(estimates: tuple[PalmEstimate, ...] = (estimate, further, unknown)) -> list[object]:
            readout = Readout(own, CAMERA, 6e-3)
            return [readout.seat(one, view) for one in estimates]

        both(seats)


@pytest.mark.parametrize("blobs", [0, 7, 30])
def test_what_a_row_tells_of_every_marker(blobs: int) -> None:
    seen, protocol = sequence("right"), known("right").clicks.protocol
    own = HandFilter(known("right"), CAMERA, SETTINGS)
    assert own.fingers is not None
    results = FrameResults(protocol, own.order, own.fingers.model, own.readout, SETTINGS)
    some = seen.detections[0].only(np.arange(len(seen.detections[0])) < blobs)
    with choice.forced(choice.NUMPY):
        predicted = own.predict(0.0)
        scan = own.scan(predicted, some, 0.0, 0.0)
        posterior = own.update(predicted, scan)
        own.accept(posterior, scan, is_seen=True, linked=False)
        joints = own.joints(posterior)
    both(lambda: results._by_marker(posterior, joints, some))


@pytest.mark.parametrize("dip", ["coupled", "free"])
@pytest.mark.parametrize("modes", [1, 2])
def test_digits_ahead(dip: str, modes: int) -> None:
    it, rng = hand("right", 1, dip), np.random.default_rng(21)
    model = (
        it.fingers.model if modes == 2 else FingerModel(known("right"), CAMERA, replace(SETTINGS, mode_scales=(1.0,)))
    )
    mixture = model.alike(it.mean, it.covariance)
    mixture.mean[:] += 0.01 * rng.normal(size=mixture.mean.shape)
    some = np.where(rng.uniform(size=(5, 5)) < 0.5, 0.0, rng.uniform(0.0, 1.0, size=(5, 5)))
    for unseen_s in (np.zeros((5, 5)), some):
        for dt_s in (0.0, 0.033, 0.2, 2.0):
            both(lambda u=unseen_s, dt=dt_s: ahead_of(model, mixture, u, dt, it.seat.palm.disc_m[1:]))
            both(lambda u=unseen_s, dt=dt_s: model.predicted(mixture, u, dt))


def ahead_of(model: FingerModel, *of: Any) -> tuple[object, ...]:
    """What is held to NumPy's: the inverse of a root of what hardly varies amplifies the last digits, and is held to it
    where both have the same covariance."""
    later, points = model.ahead(*of)
    return later, points.mean, points.covariance, points.disc_m, points.by_constants, points.normal


@pytest.mark.parametrize("side", ["right", "left"])
@pytest.mark.parametrize("seed", few(range(2)))
@pytest.mark.parametrize("wide", [0.1, 1.0])
def test_digits_named_and_updated(side: str, seed: int, wide: float) -> None:
    """``wide``: several discs would have the same blob."""
    it, rng = hand(side, seed), np.random.default_rng(seed)
    fingers = it.fingers
    mixture = fingers.model.alike(it.mean, wide * it.covariance)
    points = spread_points(it.mean, wide * it.covariance, it.seat.palm.disc_m[1:], Spread())
    seen = digits_linearised(points, it.seat.view, Spread()).value.reshape(15, 3)
    seen = seen + rng.normal(size=seen.shape) * [0.2, 0.2, 1e-3]
    no_depth, lone, covered = seen.copy(), seen[[2, 5, 8]], seen.copy()
    no_depth[::2, 2] = np.nan
    covered[3::4, 2] -= 0.2
    fingers.memory.disc_m2 = np.where(rng.uniform(size=(5, 3)) < 0.5, np.nan, 3e-5)
    fingers.memory.visible = rng.uniform(0.02, 0.98, size=(5, 3))
    for blobs in (seen, seen[::-1], seen[3:9], lone, no_depth, covered, np.repeat(seen, 2, axis=0), seen[:0]):
        measured = Measurements(blobs, np.broadcast_to([0.05, 0.05, 1e-6], blobs.shape).copy())
        area_px, free = rng.uniform(10.0, 90.0, size=len(blobs)), rng.uniform(size=len(blobs)) < 0.9
        picture = DigitPicture(0.033, it.seat, measured, area_px, free)
        both(lambda p=picture: told(fingers.naming._tried(mixture, points, p)))
    fingers.begin_at_neutral()


def told(trial: FingerTrial) -> tuple[object, ...]:
    """What a kernel tells of it."""
    scene = trial.scene
    return (
        scene.linearised, scene.spread, scene.palm_part, scene.visible, scene.whole_px, trial.named, trial.disc_m2,
    )  # fmt: skip


def test_rays_that_are_not_known_at_all_are_no_covariance() -> None:
    it = hand("right", 0)
    for how in ("numpy", "plain", "wide"):
        with choice.forced(how), pytest.raises(np.linalg.LinAlgError):
            spread_points(it.mean, -it.covariance, it.seat.palm.disc_m[1:], Spread())


@pytest.mark.parametrize("side", ["right", "left"])
@pytest.mark.parametrize("dip", ["coupled", "free"])
def test_joints_as_they_are_read(side: str, dip: str) -> None:
    it = hand(side, 1, dip)
    linearised = it.linearised()
    both(lambda: it.fingers.model.readout.read(it.mean, it.covariance, it.seat, linearised))


@pytest.mark.parametrize("modes", [1, 2])
def test_limits_of_joints(modes: int) -> None:
    it, rng = hand("right", 1), np.random.default_rng(15)
    misread = []
    for bent_rad in (0.0, 0.7, -1.2, 2.5, 40.0):
        mean = np.repeat(it.mean[:, None], modes, axis=1) + 0.01 * rng.normal(size=(5, modes, 21))
        mean[:, :, :5] += bent_rad
        for wide in (1e-6, 1.0, 30.0):
            covariance = np.repeat(wide * it.covariance[:, None], modes, axis=1)
            mixture = ModeMixture(mean, covariance, np.full((5, modes), 1.0 / modes))
            misread.append(both(lambda of=mixture: settled(of, 0.5))[2])
    assert np.any(misread)
    assert not np.all(misread)
    narrow = ModeMixture(0.3 + 0.0 * mean, 1e-9 * covariance, mixture.probability)
    both(lambda: settled(narrow, 0.5))


@pytest.mark.parametrize("flexion_deg", [10.0, 70.0])
def test_bends_told_by_depth(flexion_deg: float) -> None:
    samples, root, asked = readings(flexion_deg), RIGHT_PALM_M[1:], [1, 2, 3, 4]
    found = both(lambda: knuckle_bends(asked, states(), root, VIEW, samples))
    assert found.is_any
    both(lambda: knuckle_bends(asked, states() + 0.3, root, VIEW, samples))
    one = SurfaceSamples(samples.pixel[:1], samples.depth_m[:1])
    both(lambda: knuckle_bends([2], states(), root, VIEW, one))
