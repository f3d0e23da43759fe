"""Thumb and fingers of one hand, tracked on the palm that the tracker has just corrected."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from carpus.core.calibration.result import Calibration
from carpus.core.camera import Camera
from carpus.core.kernels.choice import Kernels, in_c
from carpus.core.tracking.adaptive_noise import adapted_factor
from carpus.core.tracking.association import IMPOSSIBLE, AssociationSettings, log_densities
from carpus.core.tracking.digit_association import (
    BENDS,
    DigitAssignment,
    DigitScene,
    UpdatedDigits,
    associate_digits,
    beyond_reach,
    far_digits,
    jointly_checked,
    seen_chance,
    tilt_to,
    tilt_variance,
    updated_as_associated,
    without,
)
from carpus.core.tracking.digit_filter import (
    DIGIT_SIZE,
    RATES,
    SEEN,
    DigitPoints,
    DigitsLinearisation,
    bent_weights,
    digits_linearised,
    spread_points,
)
from carpus.core.tracking.digit_search import in_reach, search_digits
from carpus.core.tracking.finger_depth import FLEXION, KnuckleBends, knuckle_bends, with_bends
from carpus.core.tracking.finger_model import FingerModel, Seat
from carpus.core.tracking.finger_settings import FingerSettings
from carpus.core.tracking.finger_smoother import FingerStart, FingerStep
from carpus.core.tracking.hand_geometry import CHAINS, DISCS, SHOWS, SLOTS, JointMoment
from carpus.core.tracking.joint_association import is_jointly_compatible, most_chi2_row
from carpus.core.tracking.kernel import ModeMixture, Update, like
from carpus.core.tracking.palm_association import Measurements
from carpus.core.tracking.predicted_measurement import PredictedDigits
from carpus.core.tracking.settings import TrackerSettings
from carpus.core.tracking.soft_tissue import DigitSpeeds
from carpus.core.types import FloatArray, SurfaceSamples

_RATE, _THUMB_BASE = np.arange(DIGIT_SIZE)[RATES], slice(0, 2)
_UV = 3 * np.arange(DISCS)[:, None] + np.arange(2)


@dataclass(frozen=True, slots=True)
class FingerTrial:
    """What one frame would tell of thumb and fingers on the palm at ``seat``.

    ``disc_m2`` (5, 3) areas of the discs as seen, NaN where not or too tilted; ``postures`` slots (5,) of digits found
    anew, by digit.
    """

    seat: Seat
    scene: DigitScene
    named: UpdatedDigits
    disc_m2: FloatArray
    postures: dict[int, FloatArray]
    bends: KnuckleBends = field(default_factory=KnuckleBends.none)

    @property
    def predicted_px(self) -> FloatArray:
        """Where each disc was expected, (5, 3, 2), given the palm."""
        return self.scene.linearised.value.reshape(CHAINS, DISCS, 3)[..., :2]

    @property
    def predicted_cov_px2(self) -> FloatArray:
        """Covariance (5, 3, 2, 2) of that."""
        return self.scene.spread[:, _UV[:, :, None], _UV[:, None, :]]

    @property
    def surprise(self) -> FloatArray:
        """Sum of squared residuals (5, 3) of each disc."""
        return np.asarray((self.named.update.residual**2).reshape(CHAINS, DISCS, 3).sum(axis=-1))

    @property
    def nis(self) -> float:
        """Normalised innovation squared of all digits together."""
        return float(sum(self.named.update.nis.tolist()))

    @property
    def dof(self) -> int:
        """Its degrees of freedom."""
        return int(sum(self.named.update.dof.tolist()))

    def is_jointly_compatible(self, chains: NDArray[np.int64], settings: AssociationSettings) -> bool:
        """Whether what was measured of those digits is what was foreseen."""
        update = self.named.update
        return all(
            is_jointly_compatible(float(update.nis[chain]), int(update.dof[chain]), settings) for chain in chains
        )

    @property
    def blob(self) -> NDArray[np.int64]:
        """Blob (5, 3) taken for every disc or -1."""
        return self.named.names.assigned


class Fingers:
    """Remembers the digits' estimates from frame to frame."""

    def __init__(self, calibration: Calibration, camera: Camera, settings: TrackerSettings) -> None:
        self.model = FingerModel(calibration, camera, settings)
        self._settings = settings
        self.begin_at_neutral()

    def begin_at_neutral(self) -> None:
        """Start (again) from the neutral pose, at rest."""
        self._palm = self.model.calibrated_palm
        self._visible = np.full((CHAINS, DISCS), self._settings.fingers.most_seen)
        self._missing = np.zeros(CHAINS, dtype=np.int64)
        self._unseen_s = np.zeros((CHAINS, SLOTS))
        self._noise_factor = np.ones((CHAINS, 3 * DISCS))
        self._disc_m2 = np.full((CHAINS, DISCS), np.nan)
        self._begins = True
        neutral = self.model.at_neutral()
        self._take(neutral, neutral.merged())

    def reach(self, point_m: FloatArray) -> NDArray[np.bool_]:
        """Whether points (..., 3) in the tracked body may be discs of these fingers."""
        palm = self._palm
        on_palm = (point_m - palm.origin_m) @ palm.axes
        return in_reach(on_palm, palm.disc_m[1:], self._mean[:, SEEN], self._settings.fingers.search)

    def begin_anywhere(self) -> None:
        """Start again after the hand was lost: the anatomy is known, the joints may be anywhere."""
        self._visible = np.full((CHAINS, DISCS), self._settings.fingers.seen_anew)
        self._missing = np.full(CHAINS, self._settings.fingers.patience_frames)
        self._unseen_s = np.full((CHAINS, SLOTS), self._settings.fingers.range_after_s)
        anywhere = self.model.anywhere(self._mean, self._covariance)
        self._take(anywhere, anywhere.merged())

    def look_anew(self, chain: int) -> None:
        """A person shows a disc of a digit where it was not believed: its joints may be anywhere."""
        estimates = self.model.begun_anew(self._estimates, np.arange(CHAINS) == chain, self._estimates)
        self._visible[chain] = self._settings.fingers.seen_anew
        self._missing[chain] = self._settings.fingers.patience_frames
        self._unseen_s[chain] = self._settings.fingers.range_after_s
        self._take(estimates, estimates.merged())

    def _take(self, estimates: ModeMixture, merged: tuple[FloatArray, FloatArray]) -> None:
        self._estimates, (self._mean, self._covariance) = estimates, merged
        self._speeds: DigitSpeeds | None = None

    @property
    def speeds(self) -> DigitSpeeds:
        """How fast the thumb turns at its base and the fingers at their knuckles, root mean square; a joint that
        nothing shows may turn as fast as its rate is unsure."""
        if self._speeds is None:
            unsure = np.where(self._unseen_s > 0.0, self._covariance[:, _RATE, _RATE], 0.0)
            square = self._mean[:, _RATE] ** 2 + unsure
            thumb, fingers = (
                float(np.add.reduce(of)) / of.size for of in (square[0, _THUMB_BASE], square[1:, FLEXION])
            )
            fastest = self._settings.tissue.fastest_rad_s
            self._speeds = DigitSpeeds(min(math.sqrt(thumb), fastest), min(math.sqrt(fingers), fastest))
        return self._speeds

    @property
    def known(self) -> ModeMixture:
        """What is believed of the digits; another object whenever anything of them has changed."""
        return self._estimates

    def ahead(self, dt_s: float) -> PredictedDigits:
        """The digits ``dt_s`` later, and their discs on the palm as it was known last."""
        estimates, points = self.model.ahead(self._estimates, self._unseen_s, dt_s, self._palm.disc_m[1:])
        return PredictedDigits(estimates, points, self._palm)

    def weigh(
        self,
        ahead: PredictedDigits,
        dt_s: float,
        seat: Seat,
        blobs: Measurements,
        area_px: FloatArray,
        free: NDArray[np.bool_],
        samples: SurfaceSamples | None = None,
    ) -> FingerTrial:
        """Name the blobs that are ``free`` (D,), not the palm's, as if the palm were there; nothing is remembered.

        ``ahead`` the digits ``dt_s`` after the last frame.
        ``area_px`` (D,) of the blobs; ``samples`` depth readings about the fingers.
        """
        return self._bent(self._named(ahead, dt_s, seat, blobs, area_px, free), samples)

    def _bent(self, trial: FingerTrial, samples: SurfaceSamples | None) -> FingerTrial:
        """The trial with what depth says of knuckles whose fingers' discs are hidden."""
        unseen = self.model.has_discs & (trial.blob[:, 0] < 0) & (self._unseen_s[:, FLEXION] > 0.0)
        hidden = [chain for chain in range(1, CHAINS) if unseen[chain]]
        if samples is None or not hidden:
            return trial
        mean = trial.named.update.mixture.merged()[0]
        own = self._settings.fingers.depth
        bends = knuckle_bends(hidden, mean, self._palm.disc_m[1:], trial.seat.view, samples, own)
        if not bends.is_any:
            return trial
        update = replace(trial.named.update, mixture=with_bends(trial.named.update.mixture, bends))
        return replace(trial, named=replace(trial.named, update=update), bends=bends)

    def _named(
        self,
        ahead: PredictedDigits,
        dt_s: float,
        seat: Seat,
        blobs: Measurements,
        area_px: FloatArray,
        free: NDArray[np.bool_],
    ) -> FingerTrial:
        estimates, points = ahead.estimates, ahead.points
        trial, given_up = self._found_far(estimates, self._tried(estimates, points, dt_s, seat, blobs, area_px, free))
        anew = self._searched(trial, points, seat, blobs, free, given_up)
        if not anew:
            return trial
        chains = np.array(list(anew))
        restarted = self.model.at_postures(estimates, anew)
        points = spread_points(*restarted.merged(), self._palm.disc_m[1:], self._settings.spread)
        other = self._pinned(restarted, self._tried(restarted, points, dt_s, seat, blobs, area_px, free))
        better = np.count_nonzero(other.blob[chains] >= 0) > np.count_nonzero(trial.blob[chains] >= 0)
        believed = better and other.is_jointly_compatible(chains, self._settings.association)
        return replace(other, postures=anew) if believed else trial

    def _found_far(self, estimates: ModeMixture, trial: FingerTrial) -> tuple[FingerTrial, NDArray[np.bool_]]:
        """The trial, linearised anew where joints may be far from where they were expected (iterated posterior
        linearisation, Garcia-Fernandez 2015), and digits (5,) given up because they would be where they cannot be."""
        far = far_digits(trial.scene.covariance, trial.blob >= 0, self._settings.fingers)
        if not far.any():
            return trial, far
        pinned = self._pinned(estimates, trial)
        wrong = far & beyond_reach(*pinned.named.update.mixture.merged(), self._settings.fingers)
        names = self._settings.association
        wrong |= far & np.array([not pinned.is_jointly_compatible(np.array([chain]), names) for chain in range(CHAINS)])
        if not wrong.any():
            return pinned, wrong
        discs = np.repeat(wrong[:, None], DISCS, axis=1)
        return replace(pinned, named=without(discs, pinned.named, estimates, pinned.scene, self._settings)), wrong

    def _pinned(self, estimates: ModeMixture, trial: FingerTrial) -> FingerTrial:
        """The same names, h linearised anew about what they say: what was expected is some way off."""
        for _ in range(self._settings.fingers.pinnings):
            nearer = spread_points(*trial.named.update.mixture.merged(), self._palm.disc_m[1:], self._settings.spread)
            linearised = digits_linearised(nearer, trial.seat.view, self._settings.spread)
            scene = replace(trial.scene, linearised=linearised)
            named = updated_as_associated(estimates, scene, trial.named.names, self._settings)
            trial = replace(trial, named=named)
        return trial

    def _searched(
        self,
        trial: FingerTrial,
        points: DigitPoints,
        seat: Seat,
        blobs: Measurements,
        free: NDArray[np.bool_],
        given_up: NDArray[np.bool_],
    ) -> dict[int, FloatArray]:
        """Postures (5,) of digits just given up or missing for some frames, if the blobs left over show them."""
        if not (given_up.any() or self._missing.any()):
            return {}
        named = np.count_nonzero(trial.blob >= 0, axis=1)
        is_due = given_up | ((self._missing >= self._settings.fingers.patience_frames) & (self._missing % 2 == 0))
        chains = np.flatnonzero((named < self._settings.fingers.search.least_discs) & is_due & self.model.has_discs)
        if not chains.size:
            return {}
        unassigned = free & np.isfinite(blobs.value[:, 2])
        unassigned[trial.blob[(trial.blob >= 0) & (named >= self._settings.fingers.search.least_discs)[:, None]]] = (
            False
        )
        value, camera = blobs.value[unassigned], seat.view.camera
        in_camera = camera.back_project(value[:, :2], value[:, 2])
        point = (in_camera - seat.view.translation_m) @ seat.view.rotation
        return search_digits(chains, points.mean[:, SEEN], self._palm.disc_m[1:], point, self._settings.fingers.search)

    def _tried(
        self,
        estimates: ModeMixture,
        points: DigitPoints,
        dt_s: float,
        seat: Seat,
        blobs: Measurements,
        area_px: FloatArray,
        free: NDArray[np.bool_],
    ) -> FingerTrial:
        own, learning = self._settings.fingers, self.model.learning(seat)
        if (kernels := in_c()) is not None:
            return self._tried_in_c(kernels, estimates, points, dt_s, seat, blobs, area_px, free, learning)
        linearised = digits_linearised(points, seat.view, self._settings.spread)
        visibility = disc_visibility(points, linearised, seat, self._visible, dt_s, own)
        scene = DigitScene(
            points.covariance,
            linearised,
            visibility.spread,
            visibility.palm_part,
            visibility.visible,
            blobs,
            free,
            area_px,
            self._disc_m2 * visibility.facing_m2,
            self._noise_factor,
            self.model.resolution_px2,
            seat.view,
            learning,
            self.model.has_discs,
        )
        named = associate_digits(estimates, scene, self._settings)
        return FingerTrial(
            seat, scene, named, areas_m2(named, area_px, visibility.tilt_rad, visibility.facing_m2, own), {}
        )

    def _tried_in_c(
        self,
        kernels: Kernels,
        estimates: ModeMixture,
        points: DigitPoints,
        dt_s: float,
        seat: Seat,
        blobs: Measurements,
        area_px: FloatArray,
        free: NDArray[np.bool_],
        learning: float,
    ) -> FingerTrial:
        """The same in one kernel, up to what becomes of names that are not jointly compatible."""
        settings, own, names, noise = (
            self._settings,
            self._settings.fingers,
            self._settings.association,
            self._settings.noise,
        )
        camera, out, seen = seat.view.camera, like(estimates), 3 * DISCS
        nine, square, rows = (
            np.empty((4, CHAINS, seen)),
            np.empty((4, CHAINS, seen, seen)),
            np.empty((5, CHAINS, DISCS)),
        )
        value, measured, variance, residual = nine
        error, by_digits, by_palm, by_both = square
        visible, tilt_rad, facing_m2, whole_px, disc_m2 = rows
        slope = np.empty((CHAINS, seen, DIGIT_SIZE))
        centre_m, by_place = np.empty((CHAINS, DISCS, 3)), np.empty((CHAINS, DISCS, 3, 3))
        assigned, with_depth = np.empty((CHAINS, DISCS), dtype=np.int64), np.empty((CHAINS, DISCS), dtype=np.bool_)
        nis, dof, (ordinary, settled) = (
            np.empty(CHAINS),
            np.empty(CHAINS, dtype=np.int64),
            np.empty((2, 1), dtype=np.bool_),
        )
        kernels.digits_named(
            self.model.scales.size, len(blobs), *points.parts, points.mean, points.covariance, seat.view.rotation,
            seat.view.translation_m, seat.pose_covariance, camera.fx_px, camera.fy_px, camera.cx_px, camera.cy_px,
            bent_weights(settings.spread).numbers, BENDS, self._visible, dt_s, own.shown_s, own.hidden_s,
            own.steepest_rad, own.steepest_sd_rad, own.least_seen, own.most_seen, own.least_facing, blobs.value,
            blobs.variance, area_px, free, self._disc_m2, self._noise_factor, self.model.has_discs,
            *log_densities(self.model.resolution_px2 / own.clutter, noise.depth_outlier, names), names.gate_sd**2,
            IMPOSSIBLE, math.log(names.prior_marker / names.prior_clutter), noise.whole_from, noise.shade_share,
            settings.marker_radius_m, own.crowded_radii, own.crowded_px, noise.pixel_sd_px, own.skin_px, own.flat_rad,
            learning, estimates.mean, estimates.covariance, estimates.probability, nine, square, rows, slope, centre_m,
            by_place, out.mean, out.covariance, out.probability, assigned, with_depth, nis, dof,
            most_chi2_row(names.consistent), own.was_seen, ordinary, settled,
        )  # fmt: skip
        scene = DigitScene(
            points.covariance, DigitsLinearisation(value, slope, error, points.mean, by_digits, centre_m, by_place),
            by_both, by_palm, visible, blobs, free, area_px, whole_px, self._noise_factor, self.model.resolution_px2,
            seat.view, learning, self.model.has_discs,
        )  # fmt: skip
        if not ordinary.item():
            named = associate_digits(estimates, scene, settings)
        else:
            update = Update(out, nis, dof, residual)
            first = UpdatedDigits(DigitAssignment(assigned, with_depth), update, measured, variance)
            named = first if settled.item() else jointly_checked(first, estimates, scene, settings)
            if named is first:
                return FingerTrial(seat, scene, named, disc_m2, {})
        return FingerTrial(seat, scene, named, areas_m2(named, area_px, tilt_rad, facing_m2, own), {})

    def start(self, timestamp_s: float, is_lost: bool) -> FingerStart:
        """What is believed now, for smoothing over the frames to come."""
        return FingerStart(self._estimates, self._unseen_s, timestamp_s, is_lost)

    def accept(self, trial: FingerTrial, timestamp_s: float, dt_s: float) -> FingerStep:
        """Go on from a trial; what the smoother needs of it."""
        named = trial.named
        is_named, own, noise = named.names.assigned >= 0, self._settings.fingers, self._settings.noise
        if (kernels := in_c()) is not None:
            visible, disc_m2 = np.empty((2, CHAINS, DISCS))
            unseen_s, missing = np.empty((CHAINS, SLOTS)), np.empty(CHAINS, dtype=np.int64)
            factor = np.empty((CHAINS, 3 * DISCS))
            kernels.digits_accepted(
                dt_s, named.names.assigned, trial.scene.visible, own.missed, own.most_seen, SHOWS, self._unseen_s,
                self._missing, own.search.least_discs, named.update.residual, named.measured, self._noise_factor,
                1.0 - math.exp(-dt_s / noise.adapt_s), noise.least_adapted, noise.most_adapted, self._disc_m2,
                trial.disc_m2, own.size_grows, own.size_shrinks, visible, unseen_s, missing, factor, disc_m2,
            )  # fmt: skip
            self._visible, self._unseen_s, self._missing = visible, unseen_s, missing
            self._noise_factor, self._disc_m2 = factor, disc_m2
        else:
            self._remember(trial, is_named, dt_s)
        kept, merged, misread = self.model.within_reach(named.update.mixture, self._estimates)
        self._missing[misread] = self._settings.fingers.patience_frames
        self._take(kept, merged)
        self._palm = trial.seat.palm
        begins, self._begins = self._begins, False
        return FingerStep(timestamp_s, named.measured, named.variance, is_named, trial.postures, begins, trial.bends)

    def _remember(self, trial: FingerTrial, is_named: NDArray[np.bool_], dt_s: float) -> None:
        """Which discs are seen, how noisy and how large, after an accepted frame."""
        named, own, visible = trial.named, self._settings.fingers, trial.scene.visible
        # Bayes: a disc that is in sight goes without a name with the chance ``missed``.
        unnamed = visible * own.missed / (1.0 - (1.0 - own.missed) * visible)
        self._visible = np.where(is_named, own.most_seen, unnamed)
        shown = (SHOWS & is_named[:, None, :]).any(axis=-1)
        self._unseen_s = np.where(shown, 0.0, self._unseen_s + dt_s)
        count = np.count_nonzero(is_named, axis=1)
        self._missing = np.where(count < own.search.least_discs, self._missing + 1, 0)
        residual, measured = (values.reshape(CHAINS, DISCS, 3) for values in (named.update.residual, named.measured))
        factor = self._noise_factor.reshape(CHAINS, DISCS, 3)
        adapted = adapted_factor(factor, residual, np.isfinite(measured), dt_s, self._settings.noise)
        self._noise_factor = adapted.reshape(CHAINS, 3 * DISCS)
        self._disc_m2 = learnt_sizes(self._disc_m2, trial.disc_m2, own)

    def read(self, trial: FingerTrial) -> JointMoment:
        """The joints after that trial was accepted."""
        return self.model.read(self._mean, self._covariance, trial.seat, trial.scene.linearised)


@dataclass(frozen=True, slots=True)
class DiscVisibility:
    """How the discs are to be seen on a palm: ``palm_part`` (5, 9, 9) of the covariance of their images, ``spread`` (5,
    9, 9) all of it; chance (5, 3) that each is ``visible``, its ``tilt_rad`` (5, 3) to the line of sight, and
    ``facing_m2`` (5, 3) pixels for each square metre of it."""

    palm_part: FloatArray
    spread: FloatArray
    visible: FloatArray
    tilt_rad: FloatArray
    facing_m2: FloatArray


def disc_visibility(
    points: DigitPoints,
    linearised: DigitsLinearisation,
    seat: Seat,
    visible: FloatArray,
    dt_s: float,
    own: FingerSettings,
) -> DiscVisibility:
    """How the discs at ``points`` are to be seen ``dt_s`` after they were ``visible`` (5, 3)."""
    tilt = tilt_to(seat.view, points.normal, linearised.centre_m)
    chance = seen_chance(visible, tilt, np.sqrt(tilt_variance(points.covariance)), dt_s, own)
    shift = FingerModel.palm_part(linearised, seat)
    facing = np.maximum(np.cos(tilt), own.least_facing)
    facing_m2 = facing * (seat.view.camera.fx_px / linearised.centre_m[..., 2]) ** 2
    return DiscVisibility(shift, linearised.spread + shift, chance, tilt, facing_m2)


def areas_m2(
    named: UpdatedDigits, area_px: FloatArray, tilt_rad: FloatArray, facing_m2: FloatArray, own: FingerSettings
) -> FloatArray:
    """Areas (5, 3) of the discs as seen, NaN where not or too tilted."""
    assigned = named.names.assigned
    if not area_px.size:
        return np.full(assigned.shape, np.nan)
    return np.where((assigned >= 0) & (tilt_rad < own.flat_rad), area_px[assigned] / facing_m2, np.nan)


def learnt_sizes(known_m2: FloatArray, seen_m2: FloatArray, own: FingerSettings) -> FloatArray:
    """How large each disc is, after one more picture, NaN where not known: quick to grow, slow to shrink, as a disc may
    be half hidden but never too large."""
    weight = np.where(seen_m2 > known_m2, own.size_grows, own.size_shrinks)
    learnt = np.where(np.isnan(known_m2), seen_m2, known_m2 + weight * (seen_m2 - known_m2))
    return np.where(np.isfinite(seen_m2), learnt, known_m2)
