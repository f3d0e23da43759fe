"""Which blobs of a picture are the discs of thumb and fingers, as if the palm were where it was just corrected to."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from carpus.core.compiled.digit_images import MAX_SEEN, compute_tilts, compute_visibility, propagate_palm_error
from carpus.core.model.types import FloatArray, SurfaceSamples
from carpus.core.tracking.association.association import is_jointly_compatible
from carpus.core.tracking.association.palm_association import Measurements
from carpus.core.tracking.digits.digit_association import (
    DigitScene,
    UpdatedDigits,
    associate_digits,
    find_far_digits,
    is_beyond_limits,
    remove_markers,
    update_digits,
)
from carpus.core.tracking.digits.digit_readout import DigitBase
from carpus.core.tracking.digits.digit_search import MIN_DIGIT_MARKERS, search_digits
from carpus.core.tracking.digits.finger_model import FingerModel
from carpus.core.tracking.digits.knuckle_flexion import (
    FLEXION_SLOT,
    KnuckleFlexion,
    estimate_knuckle_flexion,
    update_by_knuckle_flexion,
)
from carpus.core.tracking.filter.digit_filter import (
    OBSERVED,
    DigitLinearisation,
    DigitSigmaPoints,
    draw_sigma_points,
    linearise_digits,
)
from carpus.core.tracking.filter.hand_geometry import N_DIGITS, N_DISCS, N_SLOTS, SLOT_MOVES_DISC, PalmGeometry
from carpus.core.tracking.filter.mixture_filter import ModeMixture
from carpus.core.tracking.filter.predicted_measurement import PredictedDigits, adapt_noise_factor
from carpus.core.tracking.filter.settings import AssociationSettings, TrackerSettings

_UV = 3 * np.arange(N_DISCS)[:, None] + np.arange(2)


MAX_MISSING_FRAMES = 2
"""For which a digit may show fewer than two discs before it is searched."""
EXTRA_LINEARISATIONS = 2
"""So often h is linearised again, of a digit found far from where it was expected, about what its discs say."""
MISS_PROBABILITY = 0.1
"""The chance that a disc in sight goes without a name."""
SIZE_GROWTH_GAIN, SIZE_SHRINK_GAIN = 0.2, 0.02
"""So much of a picture's is taken into a disc's size, which half a disc understates and nothing overstates,"""
MAX_AREA_TILT_RAD = math.radians(50.0)
"""while it is tilted by less."""


@dataclass(frozen=True, slots=True)
class DigitFrame:
    """What one picture brings to the digits, ``dt_s`` after the last one: the palm in it as their ``seat``, its
    ``blobs`` with their ``area_px`` (D,), and which of them are ``is_free`` (D,), not the palm's."""

    dt_s: float
    seat: DigitBase
    blobs: Measurements
    area_px: FloatArray
    is_free: NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class DigitPosterior:
    """What one frame would tell of thumb and fingers on the palm at ``seat``.

    ``disc_area_m2`` (5, 3) areas of the discs as seen, NaN where not or too tilted; ``postures`` slots (5,) of digits
    found
    anew, by digit.
    """

    seat: DigitBase
    scene: DigitScene
    update: UpdatedDigits
    disc_area_m2: FloatArray
    postures: dict[int, FloatArray]
    knuckle_flexion: KnuckleFlexion = field(default_factory=KnuckleFlexion.none)

    @property
    def prediction_px(self) -> FloatArray:
        """Where each disc was expected, (5, 3, 2), given the palm."""
        return self.scene.linearised.value.reshape(N_DIGITS, N_DISCS, 3)[..., :2]

    @property
    def prediction_cov_px2(self) -> FloatArray:
        """Covariance (5, 3, 2, 2) of that."""
        return self.scene.spread[:, _UV[:, :, None], _UV[:, None, :]]

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
        """Its degrees of freedom."""
        return int(sum(self.update.update.dof.tolist()))

    def is_jointly_compatible(self, chains: NDArray[np.int64], settings: AssociationSettings) -> bool:
        """Whether what was measured of those digits is what was foreseen."""
        update = self.update.update
        return all(
            is_jointly_compatible(float(update.nis[chain]), int(update.dof[chain]), settings) for chain in chains
        )

    @property
    def blob(self) -> NDArray[np.int64]:
        """Blob (5, 3) taken for every disc or -1."""
        return self.update.assignment.assigned


@dataclass(slots=True)
class DigitHistory:
    """What pictures have shown of the discs so far: the ``palm`` that they were on; the chance (5, 3) that each is
    ``visible_probability``; for how many frames digits (5,) are ``missing_frames`` and for how long nothing has shown
    each slot (5, 5);
    how noisy their places are, (5, 9), and how large they are, (5, 3), NaN where not known."""

    palm: PalmGeometry
    visible_probability: FloatArray
    missing_frames: NDArray[np.int64]
    unseen_s: FloatArray
    noise_factor: FloatArray
    disc_area_m2: FloatArray

    @classmethod
    def from_neutral_palm(cls, palm: PalmGeometry) -> DigitHistory:
        """Before the first picture: all in sight."""
        return cls(
            palm,
            np.full((N_DIGITS, N_DISCS), MAX_SEEN),
            np.zeros(N_DIGITS, dtype=np.int64),
            np.zeros((N_DIGITS, N_SLOTS)),
            np.ones((N_DIGITS, 3 * N_DISCS)),
            np.full((N_DIGITS, N_DISCS), np.nan),
        )

    def update(self, posterior: DigitPosterior, dt_s: float, settings: TrackerSettings) -> None:
        """Which discs are seen, how noisy and how large, after an accepted frame."""
        self.palm = posterior.seat.palm
        is_named = posterior.blob >= 0
        named, visible = posterior.update, posterior.scene.visible
        # Bayes: a disc that is in sight goes without a name with the chance ``MISS_PROBABILITY``.
        unnamed = visible * MISS_PROBABILITY / (1.0 - (1.0 - MISS_PROBABILITY) * visible)
        self.visible_probability = np.where(is_named, MAX_SEEN, unnamed)
        shown = (SLOT_MOVES_DISC & is_named[:, None, :]).any(axis=-1)
        self.unseen_s = np.where(shown, 0.0, self.unseen_s + dt_s)
        count = np.count_nonzero(is_named, axis=1)
        self.missing_frames = np.where(count < MIN_DIGIT_MARKERS, self.missing_frames + 1, 0)
        residual, measured = (
            values.reshape(N_DIGITS, N_DISCS, 3) for values in (named.update.residual, named.measured)
        )
        factor = self.noise_factor.reshape(N_DIGITS, N_DISCS, 3)
        adapted = adapt_noise_factor(factor, residual, np.isfinite(measured), dt_s, settings.noise)
        self.noise_factor = adapted.reshape(N_DIGITS, 3 * N_DISCS)
        self.disc_area_m2 = update_disc_areas(self.disc_area_m2, posterior.disc_area_m2)


class DigitUpdater:
    """Names blobs by what is remembered of the discs; changes nothing of that."""

    def __init__(self, model: FingerModel, memory: DigitHistory, settings: TrackerSettings) -> None:
        self._model, self._history, self._settings = model, memory, settings

    def update(
        self, predicted: PredictedDigits, frame: DigitFrame, samples: SurfaceSamples | None = None
    ) -> DigitPosterior:
        """Name the free blobs of a picture as if the palm were there.

        ``predicted`` the digits as expected then; ``samples`` depth readings about the fingers.
        """
        return self._update_by_knuckle_depth(self._associate(predicted, frame), samples)

    def _update_by_knuckle_depth(self, trial: DigitPosterior, samples: SurfaceSamples | None) -> DigitPosterior:
        """The trial with what depth says of knuckles whose fingers' discs are hidden."""
        unseen = self._model.has_discs & (trial.blob[:, 0] < 0) & (self._history.unseen_s[:, FLEXION_SLOT] > 0.0)
        hidden = [chain for chain in range(1, N_DIGITS) if unseen[chain]]
        if samples is None or not hidden:
            return trial
        mean = trial.update.update.mixture.merge()[0]
        bends = estimate_knuckle_flexion(hidden, mean, self._history.palm.disc_m[1:], trial.seat.view, samples)
        if not bends.is_any:
            return trial
        update = replace(trial.update.update, mixture=update_by_knuckle_flexion(trial.update.update.mixture, bends))
        return replace(trial, update=replace(trial.update, update=update), knuckle_flexion=bends)

    def _associate(self, ahead: PredictedDigits, picture: DigitFrame) -> DigitPosterior:
        estimates, points = ahead.estimates, ahead.points
        trial, given_up = self._relinearise_far_digits(
            estimates, self._associate_and_update(estimates, points, picture)
        )
        anew = self._search_missing_digits(trial, points, picture, given_up)
        if not anew:
            return trial
        chains = np.array(list(anew))
        restarted = self._model.restart_at_postures(estimates, anew)
        points = draw_sigma_points(*restarted.merge(), self._history.palm.disc_m[1:], self._settings.spread)
        other = self._iterate_linearisation(restarted, self._associate_and_update(restarted, points, picture))
        better = np.count_nonzero(other.blob[chains] >= 0) > np.count_nonzero(trial.blob[chains] >= 0)
        believed = better and other.is_jointly_compatible(chains, self._settings.association)
        return replace(other, postures=anew) if believed else trial

    def _relinearise_far_digits(
        self, estimates: ModeMixture, trial: DigitPosterior
    ) -> tuple[DigitPosterior, NDArray[np.bool_]]:
        """The trial, linearised anew where joints may be far from where they were expected (iterated posterior
        linearisation, Garcia-Fernandez 2015), and digits (5,) given up because they would be where they cannot be."""
        far = find_far_digits(trial.scene.covariance, trial.blob >= 0)
        if not far.any():
            return trial, far
        pinned = self._iterate_linearisation(estimates, trial)
        wrong = far & is_beyond_limits(*pinned.update.update.mixture.merge())
        names = self._settings.association
        wrong |= far & np.array(
            [not pinned.is_jointly_compatible(np.array([chain]), names) for chain in range(N_DIGITS)]
        )
        if not wrong.any():
            return pinned, wrong
        discs = np.repeat(wrong[:, None], N_DISCS, axis=1)
        return replace(
            pinned, update=remove_markers(discs, pinned.update, estimates, pinned.scene, self._settings)
        ), wrong

    def _iterate_linearisation(self, estimates: ModeMixture, trial: DigitPosterior) -> DigitPosterior:
        """The same names, h linearised anew about what they say: what was expected is some way off."""
        for _ in range(EXTRA_LINEARISATIONS):
            nearer = draw_sigma_points(
                *trial.update.update.mixture.merge(), self._history.palm.disc_m[1:], self._settings.spread
            )
            linearised = linearise_digits(nearer, trial.seat.view, self._settings.spread)
            scene = replace(trial.scene, linearised=linearised)
            named = update_digits(estimates, scene, trial.update.assignment, self._settings)
            trial = replace(trial, update=named)
        return trial

    def _search_missing_digits(
        self, trial: DigitPosterior, points: DigitSigmaPoints, picture: DigitFrame, given_up: NDArray[np.bool_]
    ) -> dict[int, FloatArray]:
        """Postures (5,) of digits just given up or missing for some frames, if the blobs left over show them."""
        missing = self._history.missing_frames
        if not (given_up.any() or missing.any()):
            return {}
        named = np.count_nonzero(trial.blob >= 0, axis=1)
        is_due = given_up | ((missing >= MAX_MISSING_FRAMES) & (missing % 2 == 0))
        chains = np.flatnonzero((named < MIN_DIGIT_MARKERS) & is_due & self._model.has_discs)
        if not chains.size:
            return {}
        unassigned = picture.is_free & np.isfinite(picture.blobs.value[:, 2])
        unassigned[trial.blob[(trial.blob >= 0) & (named >= MIN_DIGIT_MARKERS)[:, None]]] = False
        value, view = picture.blobs.value[unassigned], picture.seat.view
        in_camera = view.camera.backproject(value[:, :2], value[:, 2])
        point = (in_camera - view.translation_m) @ view.rotation
        return search_digits(chains, points.mean[:, OBSERVED], self._history.palm.disc_m[1:], point)

    def _associate_and_update(
        self, estimates: ModeMixture, points: DigitSigmaPoints, picture: DigitFrame
    ) -> DigitPosterior:
        seat = picture.seat
        linearised = linearise_digits(points, seat.view, self._settings.spread)
        visibility = compute_disc_visibility(points, linearised, seat, self._history.visible_probability, picture.dt_s)
        scene = DigitScene(
            points.covariance,
            linearised,
            visibility.spread,
            visibility.palm_covariance,
            visibility.visible_probability,
            picture.blobs,
            picture.is_free,
            picture.area_px,
            self._history.disc_area_m2 * visibility.px_per_m2,
            self._history.disc_area_m2,
            self._history.noise_factor,
            self._model.resolution_px2,
            seat.view,
            self._model.compute_learning_share(seat),
            self._model.has_discs,
        )
        named = associate_digits(estimates, scene, self._settings)
        disc_m2 = compute_disc_areas(named, picture.area_px, visibility.tilt_rad, visibility.px_per_m2)
        return DigitPosterior(seat, scene, named, disc_m2, {})


@dataclass(frozen=True, slots=True)
class DiscVisibility:
    """How the discs are to be seen on a palm: ``palm_covariance`` (5, 9, 9) of the covariance of their images,
    ``spread`` (5,
    9, 9) all of it; chance (5, 3) that each is ``visible_probability``, its ``tilt_rad`` (5, 3) to the line of
    sight, and
    ``px_per_m2`` (5, 3) pixels for each square metre of it."""

    palm_covariance: FloatArray
    spread: FloatArray
    visible_probability: FloatArray
    tilt_rad: FloatArray
    px_per_m2: FloatArray


def compute_disc_visibility(
    points: DigitSigmaPoints,
    linearised: DigitLinearisation,
    seat: DigitBase,
    visible: FloatArray,
    dt_s: float,
) -> DiscVisibility:
    """How the discs at ``points`` are to be seen ``dt_s`` after they were ``visible_probability`` (5, 3)."""
    tilt, variance = compute_tilts(points.normal, points.covariance, linearised, seat.view)
    chance, facing_m2 = compute_visibility(visible, tilt, variance, linearised, seat.view, dt_s)
    shift = propagate_palm_error(linearised, seat)
    return DiscVisibility(shift, linearised.spread + shift, chance, tilt, facing_m2)


def compute_disc_areas(
    named: UpdatedDigits, area_px: FloatArray, tilt_rad: FloatArray, facing_m2: FloatArray
) -> FloatArray:
    """Areas (5, 3) of the discs as seen, NaN where too tilted, and on digits that do not show a blob for every disc:
    one of them may be that of two."""
    assigned = named.assignment.assigned
    if not area_px.size:
        return np.full(assigned.shape, np.nan)
    resolved = (assigned >= 0).all(axis=1, keepdims=True)
    return np.where(resolved & (tilt_rad < MAX_AREA_TILT_RAD), area_px[assigned] / facing_m2, np.nan)


def update_disc_areas(known_m2: FloatArray, seen_m2: FloatArray) -> FloatArray:
    """How large each disc is, after one more picture, NaN where not known: quick to grow, slow to shrink, as a disc may
    be half hidden but never too large."""
    weight = np.where(seen_m2 > known_m2, SIZE_GROWTH_GAIN, SIZE_SHRINK_GAIN)
    learnt = np.where(np.isnan(known_m2), seen_m2, known_m2 + weight * (seen_m2 - known_m2))
    return np.where(np.isfinite(seen_m2), learnt, known_m2)
