"""Which blobs of a picture are the discs of thumb and fingers, as if the palm were where it was just corrected to."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from carpus.core.compiled.digit_images import MAX_SEEN, compute_tilts, compute_visibility, propagate_palm_error
from carpus.core.tracking.association import (
    AssociationSettings,
    is_jointly_compatible,
)
from carpus.core.tracking.digit_association import (
    DigitScene,
    UpdatedDigits,
    associate_digits,
    beyond_reach,
    far_digits,
    updated_as_associated,
    without,
)
from carpus.core.tracking.digit_filter import (
    SEEN,
    DigitPoints,
    DigitsLinearisation,
    digits_linearised,
    spread_points,
)
from carpus.core.tracking.digit_readout import Seat
from carpus.core.tracking.digit_search import MIN_DISCS, search_digits
from carpus.core.tracking.finger_depth import FLEXION, KnuckleBends, knuckle_bends, with_bends
from carpus.core.tracking.finger_model import FingerModel
from carpus.core.tracking.hand_geometry import CHAINS, DISCS, SHOWS, SLOTS, PalmInBody
from carpus.core.tracking.kernel import ModeMixture
from carpus.core.tracking.palm_association import Measurements
from carpus.core.tracking.predicted_measurement import PredictedDigits, adapted_factor
from carpus.core.tracking.settings import TrackerSettings
from carpus.core.types import FloatArray, SurfaceSamples

_UV = 3 * np.arange(DISCS)[:, None] + np.arange(2)


PATIENCE_FRAMES = 2
"""For which a digit may show fewer than two discs before it is searched."""
PINNINGS = 2
"""So often h is linearised again, of a digit found far from where it was expected, about what its discs say."""
MISSED = 0.1
"""The chance that a disc in sight goes without a name."""
SIZE_GROWS, SIZE_SHRINKS = 0.2, 0.02
"""So much of a picture's is taken into a disc's size, which half a disc understates and nothing overstates,"""
FLAT_RAD = math.radians(50.0)
"""while it is tilted by less."""


@dataclass(frozen=True, slots=True)
class DigitPicture:
    """What one picture brings to the digits, ``dt_s`` after the last one: the palm in it as their ``seat``, its
    ``blobs`` with their ``area_px`` (D,), and which of them are ``free`` (D,), not the palm's."""

    dt_s: float
    seat: Seat
    blobs: Measurements
    area_px: FloatArray
    free: NDArray[np.bool_]


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


@dataclass(slots=True)
class DigitMemory:
    """What pictures have shown of the discs so far: the ``palm`` that they were on; the chance (5, 3) that each is
    ``visible``; for how many frames digits (5,) are ``missing`` and for how long nothing has shown each slot (5, 5);
    how noisy their places are, (5, 9), and how large they are, (5, 3), NaN where not known."""

    palm: PalmInBody
    visible: FloatArray
    missing: NDArray[np.int64]
    unseen_s: FloatArray
    noise_factor: FloatArray
    disc_m2: FloatArray

    @classmethod
    def at_neutral(cls, palm: PalmInBody) -> DigitMemory:
        """Before the first picture: all in sight."""
        return cls(
            palm,
            np.full((CHAINS, DISCS), MAX_SEEN),
            np.zeros(CHAINS, dtype=np.int64),
            np.zeros((CHAINS, SLOTS)),
            np.ones((CHAINS, 3 * DISCS)),
            np.full((CHAINS, DISCS), np.nan),
        )

    def remember(self, trial: FingerTrial, dt_s: float, settings: TrackerSettings) -> None:
        """Which discs are seen, how noisy and how large, after an accepted frame."""
        self.palm = trial.seat.palm
        is_named = trial.blob >= 0
        named, visible = trial.named, trial.scene.visible
        # Bayes: a disc that is in sight goes without a name with the chance ``MISSED``.
        unnamed = visible * MISSED / (1.0 - (1.0 - MISSED) * visible)
        self.visible = np.where(is_named, MAX_SEEN, unnamed)
        shown = (SHOWS & is_named[:, None, :]).any(axis=-1)
        self.unseen_s = np.where(shown, 0.0, self.unseen_s + dt_s)
        count = np.count_nonzero(is_named, axis=1)
        self.missing = np.where(count < MIN_DISCS, self.missing + 1, 0)
        residual, measured = (values.reshape(CHAINS, DISCS, 3) for values in (named.update.residual, named.measured))
        factor = self.noise_factor.reshape(CHAINS, DISCS, 3)
        adapted = adapted_factor(factor, residual, np.isfinite(measured), dt_s, settings.noise)
        self.noise_factor = adapted.reshape(CHAINS, 3 * DISCS)
        self.disc_m2 = learnt_sizes(self.disc_m2, trial.disc_m2)


class DigitNaming:
    """Names blobs by what is remembered of the discs; changes nothing of that."""

    def __init__(self, model: FingerModel, memory: DigitMemory, settings: TrackerSettings) -> None:
        self._model, self._memory, self._settings = model, memory, settings

    def weigh(
        self, ahead: PredictedDigits, picture: DigitPicture, samples: SurfaceSamples | None = None
    ) -> FingerTrial:
        """Name the free blobs of a picture as if the palm were there.

        ``ahead`` the digits as expected then; ``samples`` depth readings about the fingers.
        """
        return self._bent(self._named(ahead, picture), samples)

    def _bent(self, trial: FingerTrial, samples: SurfaceSamples | None) -> FingerTrial:
        """The trial with what depth says of knuckles whose fingers' discs are hidden."""
        unseen = self._model.has_discs & (trial.blob[:, 0] < 0) & (self._memory.unseen_s[:, FLEXION] > 0.0)
        hidden = [chain for chain in range(1, CHAINS) if unseen[chain]]
        if samples is None or not hidden:
            return trial
        mean = trial.named.update.mixture.merged()[0]
        bends = knuckle_bends(hidden, mean, self._memory.palm.disc_m[1:], trial.seat.view, samples)
        if not bends.is_any:
            return trial
        update = replace(trial.named.update, mixture=with_bends(trial.named.update.mixture, bends))
        return replace(trial, named=replace(trial.named, update=update), bends=bends)

    def _named(self, ahead: PredictedDigits, picture: DigitPicture) -> FingerTrial:
        estimates, points = ahead.estimates, ahead.points
        trial, given_up = self._found_far(estimates, self._tried(estimates, points, picture))
        anew = self._searched(trial, points, picture, given_up)
        if not anew:
            return trial
        chains = np.array(list(anew))
        restarted = self._model.at_postures(estimates, anew)
        points = spread_points(*restarted.merged(), self._memory.palm.disc_m[1:], self._settings.spread)
        other = self._pinned(restarted, self._tried(restarted, points, picture))
        better = np.count_nonzero(other.blob[chains] >= 0) > np.count_nonzero(trial.blob[chains] >= 0)
        believed = better and other.is_jointly_compatible(chains, self._settings.association)
        return replace(other, postures=anew) if believed else trial

    def _found_far(self, estimates: ModeMixture, trial: FingerTrial) -> tuple[FingerTrial, NDArray[np.bool_]]:
        """The trial, linearised anew where joints may be far from where they were expected (iterated posterior
        linearisation, Garcia-Fernandez 2015), and digits (5,) given up because they would be where they cannot be."""
        far = far_digits(trial.scene.covariance, trial.blob >= 0)
        if not far.any():
            return trial, far
        pinned = self._pinned(estimates, trial)
        wrong = far & beyond_reach(*pinned.named.update.mixture.merged())
        names = self._settings.association
        wrong |= far & np.array([not pinned.is_jointly_compatible(np.array([chain]), names) for chain in range(CHAINS)])
        if not wrong.any():
            return pinned, wrong
        discs = np.repeat(wrong[:, None], DISCS, axis=1)
        return replace(pinned, named=without(discs, pinned.named, estimates, pinned.scene, self._settings)), wrong

    def _pinned(self, estimates: ModeMixture, trial: FingerTrial) -> FingerTrial:
        """The same names, h linearised anew about what they say: what was expected is some way off."""
        for _ in range(PINNINGS):
            nearer = spread_points(
                *trial.named.update.mixture.merged(), self._memory.palm.disc_m[1:], self._settings.spread
            )
            linearised = digits_linearised(nearer, trial.seat.view, self._settings.spread)
            scene = replace(trial.scene, linearised=linearised)
            named = updated_as_associated(estimates, scene, trial.named.names, self._settings)
            trial = replace(trial, named=named)
        return trial

    def _searched(
        self, trial: FingerTrial, points: DigitPoints, picture: DigitPicture, given_up: NDArray[np.bool_]
    ) -> dict[int, FloatArray]:
        """Postures (5,) of digits just given up or missing for some frames, if the blobs left over show them."""
        missing = self._memory.missing
        if not (given_up.any() or missing.any()):
            return {}
        named = np.count_nonzero(trial.blob >= 0, axis=1)
        is_due = given_up | ((missing >= PATIENCE_FRAMES) & (missing % 2 == 0))
        chains = np.flatnonzero((named < MIN_DISCS) & is_due & self._model.has_discs)
        if not chains.size:
            return {}
        unassigned = picture.free & np.isfinite(picture.blobs.value[:, 2])
        unassigned[trial.blob[(trial.blob >= 0) & (named >= MIN_DISCS)[:, None]]] = False
        value, view = picture.blobs.value[unassigned], picture.seat.view
        in_camera = view.camera.back_project(value[:, :2], value[:, 2])
        point = (in_camera - view.translation_m) @ view.rotation
        return search_digits(chains, points.mean[:, SEEN], self._memory.palm.disc_m[1:], point)

    def _tried(self, estimates: ModeMixture, points: DigitPoints, picture: DigitPicture) -> FingerTrial:
        seat = picture.seat
        linearised = digits_linearised(points, seat.view, self._settings.spread)
        visibility = disc_visibility(points, linearised, seat, self._memory.visible, picture.dt_s)
        scene = DigitScene(
            points.covariance,
            linearised,
            visibility.spread,
            visibility.palm_part,
            visibility.visible,
            picture.blobs,
            picture.free,
            picture.area_px,
            self._memory.disc_m2 * visibility.facing_m2,
            self._memory.disc_m2,
            self._memory.noise_factor,
            self._model.resolution_px2,
            seat.view,
            self._model.learning(seat),
            self._model.has_discs,
        )
        named = associate_digits(estimates, scene, self._settings)
        disc_m2 = areas_m2(named, picture.area_px, visibility.tilt_rad, visibility.facing_m2)
        return FingerTrial(seat, scene, named, disc_m2, {})


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
) -> DiscVisibility:
    """How the discs at ``points`` are to be seen ``dt_s`` after they were ``visible`` (5, 3)."""
    tilt, variance = compute_tilts(points.normal, points.covariance, linearised, seat.view)
    chance, facing_m2 = compute_visibility(visible, tilt, variance, linearised, seat.view, dt_s)
    shift = propagate_palm_error(linearised, seat)
    return DiscVisibility(shift, linearised.spread + shift, chance, tilt, facing_m2)


def areas_m2(named: UpdatedDigits, area_px: FloatArray, tilt_rad: FloatArray, facing_m2: FloatArray) -> FloatArray:
    """Areas (5, 3) of the discs as seen, NaN where too tilted, and on digits that do not show a blob for every disc:
    one of them may be that of two."""
    assigned = named.names.assigned
    if not area_px.size:
        return np.full(assigned.shape, np.nan)
    resolved = (assigned >= 0).all(axis=1, keepdims=True)
    return np.where(resolved & (tilt_rad < FLAT_RAD), area_px[assigned] / facing_m2, np.nan)


def learnt_sizes(known_m2: FloatArray, seen_m2: FloatArray) -> FloatArray:
    """How large each disc is, after one more picture, NaN where not known: quick to grow, slow to shrink, as a disc may
    be half hidden but never too large."""
    weight = np.where(seen_m2 > known_m2, SIZE_GROWS, SIZE_SHRINKS)
    learnt = np.where(np.isnan(known_m2), seen_m2, known_m2 + weight * (seen_m2 - known_m2))
    return np.where(np.isfinite(seen_m2), learnt, known_m2)
