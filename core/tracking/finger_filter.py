"""State estimate of thumb and fingers of one hand, on the palm that was just updated."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from carpus.core.calibration.result import Calibration
from carpus.core.model.camera import Camera
from carpus.core.model.types import FloatArray, SurfaceSamples
from carpus.core.tracking.association.association import is_jointly_compatible
from carpus.core.tracking.digits.digit_association import (
    EXTRA_LINEARISATIONS,
    MAX_SEEN,
    DigitScene,
    UpdatedDigits,
    associate_digits,
    compute_disc_scale,
    compute_tilts,
    compute_visibility,
    find_far_digits,
    is_beyond_limits,
    remove_markers,
    update_digits,
)
from carpus.core.tracking.digits.digit_search import MIN_DIGIT_MARKERS, is_in_reach, search_digits
from carpus.core.tracking.digits.finger_model import DIFFUSION_S, FingerModel
from carpus.core.tracking.digits.knuckle_flexion import (
    KnuckleFlexion,
    estimate_knuckle_flexion,
    update_by_knuckle_flexion,
)
from carpus.core.tracking.filter.digit_filter import (
    DIGIT_SIZE,
    OBSERVED,
    RATES,
    DigitBase,
    DigitSigmaPoints,
    draw_sigma_points,
    linearise_digits,
)
from carpus.core.tracking.filter.hand_geometry import (
    FLEXION_SLOT,
    N_DIGITS,
    N_DISCS,
    N_SLOTS,
    SLOT_MOVES_DISC,
    JointState,
    PalmGeometry,
)
from carpus.core.tracking.filter.mixture_filter import ModeMixture
from carpus.core.tracking.filter.predicted_measurement import Measurements, PredictedDigits, adapt_noise_factor
from carpus.core.tracking.filter.settings import AssociationSettings, TrackerSettings
from carpus.core.tracking.filter.soft_tissue import DigitSpeeds
from carpus.core.tracking.smoother.finger_smoother import FingerStep

_RATE, _THUMB_BASE = np.arange(DIGIT_SIZE)[RATES], slice(0, 2)

RESTART_VISIBLE_PROBABILITY = 0.5  # of a disc of a digit that is restarted
MAX_MISSING_FRAMES = 2  # for which a digit may show fewer than two discs before it is searched
MISS_PROBABILITY = 0.1  # that a disc in sight has no blob
# Of a frame on a disc's size, which half a disc understates and nothing overstates.
SIZE_GROWTH_GAIN, SIZE_SHRINK_GAIN = 0.2, 0.02
MAX_AREA_TILT_RAD = math.radians(50.0)  # of a disc whose area is measured


@dataclass(frozen=True, slots=True)
class DigitFrame:
    """Measurements of the digits in one frame, ``dt_s`` after the last one.

    The palm in it is their ``base``; its ``blobs`` have ``area_px`` (D,), and those with ``is_free`` (D,) are not the
    palm's.
    """

    dt_s: float
    base: DigitBase
    blobs: Measurements
    area_px: FloatArray
    is_free: NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class DigitPosterior:
    """Thumb and fingers updated by one frame, on the palm at ``base``.

    ``disc_area_m2`` (5, 3) as measured, NaN where not or too tilted; ``postures`` slots (5,) of digits found again, by
    digit.
    """

    base: DigitBase
    scene: DigitScene
    update: UpdatedDigits
    disc_area_m2: FloatArray
    postures: dict[int, FloatArray]
    knuckle_flexion: KnuckleFlexion = field(default_factory=KnuckleFlexion.none)

    @property
    def prediction_px(self) -> FloatArray:
        """Predicted pixels (5, 3, 2) of the discs, given the palm."""
        return self.scene.linearised.value.reshape(N_DIGITS, N_DISCS, 3)[..., :2]

    @property
    def residual_norm2(self) -> FloatArray:
        """Sum of squared residuals (5, 3) of each disc."""
        return np.asarray((self.update.update.residual**2).reshape(N_DIGITS, N_DISCS, 3).sum(axis=-1))

    @property
    def nis(self) -> float:
        """Normalised innovation squared of all digits together."""
        return float(sum(self.update.update.nis.tolist()))

    @property
    def dof(self) -> int:
        """Degrees of freedom of the NIS."""
        return int(sum(self.update.update.dof.tolist()))

    def find_compatible(self, settings: AssociationSettings) -> NDArray[np.bool_]:
        """Find the digits (5,) whose innovations are within their bounds."""
        nis, dof = self.update.update.nis.tolist(), self.update.update.dof.tolist()
        return np.array([is_jointly_compatible(*of, settings) for of in zip(nis, dof, strict=True)])

    @property
    def blob(self) -> NDArray[np.int64]:
        """Blob (5, 3) of every disc or -1."""
        return self.update.assignment.assigned


@dataclass(slots=True)
class DigitHistory:
    """What frames have shown of the discs so far.

    The ``palm`` that they were on; ``visible_probability`` (5, 3) of each; for how many frames digits (5,) are missing
    and for how long nothing has shown each slot (5, 5), ``unseen_s``; the ``noise_factor`` (5, 9) of their places, and
    ``disc_area_m2`` (5, 3), NaN where not known.
    """

    palm: PalmGeometry
    visible_probability: FloatArray
    missing_frames: NDArray[np.int64]
    unseen_s: FloatArray
    noise_factor: FloatArray
    disc_area_m2: FloatArray

    @classmethod
    def from_neutral_palm(cls, palm: PalmGeometry) -> DigitHistory:
        """Return the history before the first frame: all in sight."""
        return cls(
            palm,
            np.full((N_DIGITS, N_DISCS), MAX_SEEN),
            np.zeros(N_DIGITS, dtype=np.int64),
            np.zeros((N_DIGITS, N_SLOTS)),
            np.ones((N_DIGITS, 3 * N_DISCS)),
            np.full((N_DIGITS, N_DISCS), np.nan),
        )

    def update(self, posterior: DigitPosterior, dt_s: float, settings: TrackerSettings) -> None:
        """Update visibility, noise and sizes after an accepted frame."""
        self.palm = posterior.base.palm
        is_assigned, visible = posterior.blob >= 0, posterior.scene.visible
        # Bayes: a disc that is in sight has no blob with MISS_PROBABILITY.
        without_blob = visible * MISS_PROBABILITY / (1.0 - (1.0 - MISS_PROBABILITY) * visible)
        self.visible_probability = np.where(is_assigned, MAX_SEEN, without_blob)
        is_shown = (SLOT_MOVES_DISC & is_assigned[:, None, :]).any(axis=-1)
        self.unseen_s = np.where(is_shown, 0.0, self.unseen_s + dt_s)
        count = np.count_nonzero(is_assigned, axis=1)
        self.missing_frames = np.where(count < MIN_DIGIT_MARKERS, self.missing_frames + 1, 0)
        residual, measured, factor = (
            values.reshape(N_DIGITS, N_DISCS, 3)
            for values in (posterior.update.update.residual, posterior.update.measured, self.noise_factor)
        )
        adapted = adapt_noise_factor(factor, residual, np.isfinite(measured), dt_s, settings.noise)
        self.noise_factor = adapted.reshape(N_DIGITS, 3 * N_DISCS)
        self.disc_area_m2 = update_disc_areas(self.disc_area_m2, posterior.disc_area_m2)


class FingerFilter:
    """The digits' estimates from frame to frame.

    ``estimates`` is another object whenever any of them has changed.
    """

    def __init__(self, calibration: Calibration, camera: Camera, settings: TrackerSettings) -> None:
        self.model = FingerModel(calibration, camera, settings)
        self._settings = settings
        self.begin_at_neutral()

    def begin_at_neutral(self) -> None:
        """Start (again) from the neutral pose, at rest."""
        self.history = DigitHistory.from_neutral_palm(self.model.calibrated_palm)
        self._is_at_start = True
        neutral = self.model.neutral_mixture()
        self._set_estimates(neutral, neutral.merge())

    def is_in_reach(self, point_m: FloatArray) -> NDArray[np.bool_]:
        """Return whether points (..., 3) in the tracked body may be discs of these fingers."""
        palm = self.history.palm
        on_palm = (point_m - palm.origin_m) @ palm.axes
        return is_in_reach(on_palm, palm.disc_m[1:], self._mean[:, OBSERVED])

    def reset_joints(self) -> None:
        """Start again after the hand was lost: the anatomy is known, the joints may be anywhere."""
        self.history.visible_probability = np.full((N_DIGITS, N_DISCS), RESTART_VISIBLE_PROBABILITY)
        self.history.missing_frames = np.full(N_DIGITS, MAX_MISSING_FRAMES)
        self.history.unseen_s = np.full((N_DIGITS, N_SLOTS), DIFFUSION_S)
        anywhere = self.model.diffuse_mixture(self._mean, self._covariance)
        self._set_estimates(anywhere, anywhere.merge())

    def restart_digit(self, chain: int) -> None:
        """Restart a digit anywhere, of which a person shows a disc where it was not predicted."""
        estimates = self.model.restart_digits(self.estimates, np.arange(N_DIGITS) == chain, self.estimates)
        self.history.visible_probability[chain] = RESTART_VISIBLE_PROBABILITY
        self.history.missing_frames[chain] = MAX_MISSING_FRAMES
        self.history.unseen_s[chain] = DIFFUSION_S
        self._set_estimates(estimates, estimates.merge())

    def _set_estimates(self, estimates: ModeMixture, merged: tuple[FloatArray, FloatArray]) -> None:
        self.estimates, (self._mean, self._covariance) = estimates, merged
        self._speeds: DigitSpeeds | None = None

    @property
    def joint_speeds(self) -> DigitSpeeds:
        """Root mean square rates of the thumb at its base and of the fingers at MCP.

        A joint that nothing shows may turn as fast as its rate is unsure.
        """
        if self._speeds is None:
            unsure = np.where(self.history.unseen_s > 0.0, self._covariance[:, _RATE, _RATE], 0.0)
            square = self._mean[:, _RATE] ** 2 + unsure
            thumb, fingers = (
                float(np.add.reduce(of)) / of.size for of in (square[0, _THUMB_BASE], square[1:, FLEXION_SLOT])
            )
            fastest = self._settings.tissue.fastest_rad_s
            self._speeds = DigitSpeeds(min(math.sqrt(thumb), fastest), min(math.sqrt(fingers), fastest))
        return self._speeds

    def predict(self, dt_s: float) -> PredictedDigits:
        """Predict the digits ``dt_s`` ahead, and their discs on the palm as it was known last."""
        history = self.history
        estimates = self.model.predict(self.estimates, history.unseen_s, dt_s)
        points = draw_sigma_points(*estimates.merge(), history.palm.disc_m[1:], self._settings.scaling)
        return PredictedDigits(estimates, points, history.palm)

    def update(
        self, predicted: PredictedDigits, frame: DigitFrame, samples: SurfaceSamples | None = None
    ) -> DigitPosterior:
        """Update the predicted digits by the free blobs of a frame.

        ``samples`` are depth readings about the fingers, which show the MCP flexion of those whose discs are hidden.
        """
        posterior = self._update_by_blobs(predicted, frame)
        is_unseen = self.model.has_discs & (posterior.blob[:, 0] < 0) & (self.history.unseen_s[:, FLEXION_SLOT] > 0.0)
        hidden = [chain for chain in range(1, N_DIGITS) if is_unseen[chain]]
        if samples is None or not hidden:
            return posterior
        update = posterior.update.update
        root_m = self.history.palm.disc_m[1:]
        flexion = estimate_knuckle_flexion(hidden, update.mixture.merge()[0], root_m, posterior.base.view, samples)
        if not flexion.is_any:
            return posterior
        update = replace(update, mixture=update_by_knuckle_flexion(update.mixture, flexion))
        return replace(posterior, update=replace(posterior.update, update=update), knuckle_flexion=flexion)

    def _update_by_blobs(self, predicted: PredictedDigits, frame: DigitFrame) -> DigitPosterior:
        estimates, points = predicted.estimates, predicted.points
        posterior = self._associate_and_update(estimates, points, frame)
        # Where joints may be far from where h was linearised: iterated posterior linearisation (Garcia-Fernandez 2015).
        is_given_up = is_far = find_far_digits(posterior.scene.state_covariance, posterior.blob >= 0)
        if is_far.any():
            posterior = self._iterate_linearisation(estimates, posterior)
            is_given_up = is_far & is_beyond_limits(*posterior.update.update.mixture.merge())
            is_given_up |= is_far & ~posterior.find_compatible(self._settings.association)
            if is_given_up.any():
                discs = np.repeat(is_given_up[:, None], N_DISCS, axis=1)
                update = remove_markers(discs, posterior.update, estimates, posterior.scene, self._settings)
                posterior = replace(posterior, update=update)
        postures = self._search_missing_digits(posterior, points, frame, is_given_up)
        if not postures:
            return posterior
        chains = np.array(list(postures))
        restarted = self.model.restart_at_postures(estimates, postures)
        points = draw_sigma_points(*restarted.merge(), self.history.palm.disc_m[1:], self._settings.scaling)
        other = self._iterate_linearisation(restarted, self._associate_and_update(restarted, points, frame))
        is_better = np.count_nonzero(other.blob[chains] >= 0) > np.count_nonzero(posterior.blob[chains] >= 0)
        if is_better and other.find_compatible(self._settings.association)[chains].all():
            return replace(other, postures=postures)
        return posterior

    def _iterate_linearisation(self, estimates: ModeMixture, posterior: DigitPosterior) -> DigitPosterior:
        """Update by the same association, h linearised again about what it says."""
        for _ in range(EXTRA_LINEARISATIONS):
            points = draw_sigma_points(
                *posterior.update.update.mixture.merge(), self.history.palm.disc_m[1:], self._settings.scaling
            )
            linearised = linearise_digits(points, posterior.base.view, self._settings.scaling)
            scene = replace(posterior.scene, linearised=linearised)
            update = update_digits(estimates, scene, posterior.update.assignment, self._settings)
            posterior = replace(posterior, update=update)
        return posterior

    def _search_missing_digits(
        self, posterior: DigitPosterior, points: DigitSigmaPoints, frame: DigitFrame, is_given_up: NDArray[np.bool_]
    ) -> dict[int, FloatArray]:
        """Return postures (5,) of digits given up or missing for some frames, if left blobs show them."""
        missing = self.history.missing_frames
        if not (is_given_up.any() or missing.any()):
            return {}
        count = np.count_nonzero(posterior.blob >= 0, axis=1)
        is_due = is_given_up | ((missing >= MAX_MISSING_FRAMES) & (missing % 2 == 0))
        chains = np.flatnonzero((count < MIN_DIGIT_MARKERS) & is_due & self.model.has_discs)
        if not chains.size:
            return {}
        unassigned = frame.is_free & np.isfinite(frame.blobs.value[:, 2])
        unassigned[posterior.blob[(posterior.blob >= 0) & (count >= MIN_DIGIT_MARKERS)[:, None]]] = False
        value, view = frame.blobs.value[unassigned], frame.base.view
        in_camera = view.camera.backproject(value[:, :2], value[:, 2])
        point_m = (in_camera - view.translation_m) @ view.rotation
        return search_digits(chains, points.mean[:, OBSERVED], self.history.palm.disc_m[1:], point_m)

    def _associate_and_update(
        self, estimates: ModeMixture, points: DigitSigmaPoints, frame: DigitFrame
    ) -> DigitPosterior:
        base, history = frame.base, self.history
        linearised = linearise_digits(points, base.view, self._settings.scaling)
        tilt_rad, variance = compute_tilts(points.normal, points.covariance, linearised, base.view)
        visible = compute_visibility(history.visible_probability, tilt_rad, variance, frame.dt_s)
        px_per_m2 = compute_disc_scale(tilt_rad, linearised, base.view)
        palm_covariance = base.compute_image_covariance(linearised)
        scene = DigitScene(
            points.covariance,
            linearised,
            linearised.image_covariance + palm_covariance,
            palm_covariance,
            visible,
            frame.blobs,
            frame.is_free,
            frame.area_px,
            history.disc_area_m2 * px_per_m2,
            history.disc_area_m2,
            history.noise_factor,
            self.model.resolution_px2,
            base.view,
            self.model.compute_learning_share(base),
            self.model.has_discs,
        )
        update = associate_digits(estimates, scene, self._settings)
        disc_area_m2 = compute_disc_areas(update, frame.area_px, tilt_rad, px_per_m2)
        return DigitPosterior(base, scene, update, disc_area_m2, {})

    def accept(self, posterior: DigitPosterior, timestamp_s: float, dt_s: float) -> FingerStep:
        """Accept an update; return what the smoother needs of it."""
        self.history.update(posterior, dt_s, self._settings)
        updated = posterior.update
        estimates, merged, is_misread = self.model.apply_joint_limits(updated.update.mixture, self.estimates)
        self.history.missing_frames[is_misread] = MAX_MISSING_FRAMES
        self._set_estimates(estimates, merged)
        is_at_start, self._is_at_start = self._is_at_start, False
        return FingerStep(
            timestamp_s, updated.measured, updated.variance, posterior.blob >= 0, posterior.postures, is_at_start,
            posterior.knuckle_flexion,
        )  # fmt: skip

    def read_joints(self, posterior: DigitPosterior) -> JointState:
        """Return the joints after an update was accepted."""
        return self.model.readout.read_joints(self._mean, self._covariance, posterior.base, posterior.scene.linearised)


def compute_disc_areas(
    update: UpdatedDigits, area_px: FloatArray, tilt_rad: FloatArray, px_per_m2: FloatArray
) -> FloatArray:
    """Return areas (5, 3) of the discs as seen, NaN where too tilted or not all discs have a blob.

    Otherwise one blob may be that of two discs.
    """
    assigned = update.assignment.assigned
    if not area_px.size:
        return np.full(assigned.shape, np.nan)
    is_resolved = (assigned >= 0).all(axis=1, keepdims=True)
    return np.where(is_resolved & (tilt_rad < MAX_AREA_TILT_RAD), area_px[assigned] / px_per_m2, np.nan)


def update_disc_areas(known_m2: FloatArray, seen_m2: FloatArray) -> FloatArray:
    """Update the areas of the discs: quick to grow, slow to shrink.

    A disc may be half hidden but never too large.
    """
    weight = np.where(seen_m2 > known_m2, SIZE_GROWTH_GAIN, SIZE_SHRINK_GAIN)
    learnt = np.where(np.isnan(known_m2), seen_m2, known_m2 + weight * (seen_m2 - known_m2))
    return np.where(np.isfinite(seen_m2), learnt, known_m2)
