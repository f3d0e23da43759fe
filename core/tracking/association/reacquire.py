"""Re-acquisition of the palm without a prediction, by its constellation of discs in space."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import permutations
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carpus.core.model import so3
from carpus.core.model.types import Detections, FloatArray
from carpus.core.tracking.association.association import chi2_quantiles
from carpus.core.tracking.filter.palm_state import POSE, PalmView

DISTANCE_TOLERANCE_M = 0.007  # two discs' distance may differ so much from the calibrated one: the depth noise of both
MAX_DISC_GAP_M = 0.008  # of a disc from where the fitted palm puts it
MIN_FOUND_MARKERS = 4  # so many discs are a palm
MAX_SEARCHED_BLOBS = 40  # the most similar ones
MAX_RMS_GAP_M = 0.004  # of the discs; beyond it is not this palm,
MISFIT_PROBABILITY = 0.99  # nor where chance gives a smaller misfit (chi squared) with this probability
RIVAL_RATIO = 1.25  # another association is a rival when its misfit is below so many times the best one's
RIVAL_MARGIN = 9.0  # and this
LATERAL_SD_M = 0.00025  # of a blob across its ray
# Share of all blobs that a palm of none, one, two ... six discs and the fingers on it must explain.
MIN_EXPLAINED_SHARE: tuple[float, ...] = (1.0, 1.0, 1.0, 1.0, 0.8, 0.5, 0.0)
DISC_SD_M = 0.003  # of a disc about where the found pose puts it: depth noise of one frame, and the shape
TURN_SD_RAD = 0.05  # of a found pose at best,
POSITION_SD_M = 0.004  # of its position at best,
TURN_PRIOR_RAD = 0.6  # and of its turn at worst
VELOCITY_SD_M_S = 0.5  # of a hand just found,
RATE_SD_RAD_S = 2.0  # and of its turning
MAX_FITTED_POSES = 24  # that are fitted to all blobs

_MIRROR = np.array([1.0, -1.0, 1.0])

# WRIST MCP2, CMC1 MCP4, MCP3 MCP5: a pair with one of the next pair. Any four discs hold one of these six triples.
_TRIPLES = np.array([(0, 2, 1), (0, 2, 4), (1, 4, 3), (1, 4, 5), (3, 5, 0), (3, 5, 2)])

_FOUR_MARKER_ASSIGNMENTS = np.array(list(permutations(range(6), 4)))  # all associations that four blobs can have
_LOOSE_M2 = 1.0  # variance of a disc that nothing shows: it takes no part

# Whether points (..., 3) in the body may be discs of thumb or fingers.
ReachTest = Callable[[FloatArray], NDArray[np.bool_]]


@dataclass(frozen=True, slots=True)
class TurnLimits:
    """How far a hand that is searched can have turned.

    Within ``max_rad`` of ``rotation_w2_w0`` (3, 3), or, where every disc of the palm shows it, within ``max_tilt_rad``
    of the neutral pose: what was believed before may be wrong.
    """

    rotation_w2_w0: FloatArray
    max_rad: float
    max_tilt_rad: float


@dataclass(frozen=True, slots=True)
class FoundPalm:
    """Pose of the body in W0, and the discs ``matched`` (M,) that determine it."""

    position_m: FloatArray
    rotation_w2_w0: FloatArray
    matched: NDArray[np.bool_]

    @property
    def count(self) -> int:
        return int(np.count_nonzero(self.matched))

    def pose_covariance(self, palm_m: FloatArray) -> FloatArray:
        """Return the covariance (6, 6) of position and turn.

        Discs nearly in a line say little of the turn about that line.
        """
        discs = palm_m[self.matched]
        middle = discs.mean(axis=0)
        lever = so3.skew(discs - middle)
        information = np.einsum("mji,mjk->ik", lever, lever) / DISC_SD_M**2
        turn = np.linalg.inv(information + np.eye(3) / TURN_PRIOR_RAD**2)
        turn += TURN_SD_RAD**2 * np.eye(3)
        # The middle of the discs is what is known; the origin swings about it with the turn.
        swing = self.rotation_w2_w0 @ so3.skew(middle)
        out = np.empty((6, 6))
        out[:3, :3] = swing @ turn @ swing.T + POSITION_SD_M**2 * np.eye(3)
        out[:3, 3:] = swing @ turn
        out[3:, :3] = out[:3, 3:].T
        out[3:, 3:] = turn
        return out


class _PoseFits(NamedTuple):
    """N poses of a palm.

    Rotations (N, 3, 3), translations (N, 3), the blob ``assigned`` (N, 6) to each disc or -1, the discs' root mean
    square gap (N,), and the ``explained_count`` (N,) of blobs by palm and fingers.
    """

    rotation: FloatArray
    translation: FloatArray
    assigned: NDArray[np.int64]
    gap_m: FloatArray
    explained_count: NDArray[np.int64]

    @property
    def disc_count(self) -> NDArray[np.int64]:
        return np.asarray((self.assigned >= 0).sum(axis=1))

    def likeness(self) -> FloatArray:
        """Return the number of matched discs (N,), less by how far they lie from their places."""
        return np.asarray(self.disc_count - self.gap_m / MAX_DISC_GAP_M)

    def subset(self, rows: NDArray[np.int64]) -> _PoseFits:
        return _PoseFits._make(values[rows] for values in self)


def find_palm(
    detections: Detections,
    view: PalmView,
    disc_covariance: FloatArray,
    turn_limits: TurnLimits,
    is_in_reach: ReachTest | None = None,
) -> FoundPalm | None:
    """Find the palm among the blobs, without a prediction.

    Triples of discs with the distances of the palm determine a pose; the pose that most other discs confirm wins if it
    is confirmed by at least four in all and no other association of as many fits about as well. Of just four every
    association is tried: knuckles in a row look much like others. Needs depth; the back of the hand must face the
    camera, and the other hand must not explain the discs better.

    Parameters
    ----------
    detections : Detections
        Undistorted blobs.
    view : PalmView
        The palm's geometry before the camera.
    disc_covariance : (18, 18)
        Covariance of the discs' places on the palm.
    turn_limits : TurnLimits
        How far the hand can be turned.
    is_in_reach : ReachTest, optional
        The blobs left over must mostly lie where the fingers could be.
    """
    known = np.flatnonzero(np.isfinite(detections.depth_m) & (detections.similarity > 0.0))
    if known.size < MIN_FOUND_MARKERS:
        return None
    if known.size > MAX_SEARCHED_BLOBS:
        known = known[np.argsort(-detections.similarity[known])[:MAX_SEARCHED_BLOBS]]
    points = view.camera.backproject(detections.pixel[known], detections.depth_m[known])
    search = _PalmSearch(view.palm_m, points, is_in_reach)
    depth_sd_m = np.hypot(detections.depth_sd_m[known], view.camera.sensor.bias_sd_m(points[:, 2]))

    def rank(fits: _PoseFits) -> tuple[_PoseFits, FloatArray, NDArray[np.bool_]]:
        """Sort by worth, then those a hand can have, then by misfit (N,); with these, and which it cannot have."""
        misfit = _compute_misfit(fits, search, depth_sd_m, disc_covariance)
        is_beyond = _exceeds_turn_limits(fits, turn_limits, view.rotation_w0_cam)
        order = np.lexsort((misfit, is_beyond, -(fits.explained_count + fits.disc_count)))
        return fits.subset(order), misfit[order], is_beyond[order]

    fits = search.select_plausible(search.fit_poses())
    if not fits.disc_count.size:
        return None
    fits, misfit, is_beyond = rank(fits)
    if fits.disc_count[0] == MIN_FOUND_MARKERS:
        others = search.select_plausible(search.fit_all_assignments(fits.assigned[0, fits.assigned[0] >= 0]))
        best = fits.subset(np.arange(1))
        fits, misfit, is_beyond = rank(_PoseFits._make(map(np.concatenate, zip(best, others, strict=True))))
    max_misfit = chi2_quantiles(MISFIT_PROBABILITY)[3 * int(fits.disc_count[0]) - POSE.size]
    if fits.gap_m[0] > MAX_RMS_GAP_M or misfit[0] > max_misfit or is_beyond[0]:
        return None
    # A disc of the palm counts for more than one that a finger could reach.
    worth = fits.explained_count + fits.disc_count
    placed = view.palm_m @ np.swapaxes(fits.rotation, -1, -2) + fits.translation[:, None]
    distance_m = np.linalg.norm(placed - placed[0], axis=-1).max(axis=1)
    is_rival = (worth >= worth[0]) & (distance_m > MAX_DISC_GAP_M) & ~is_beyond
    is_rival &= misfit < RIVAL_RATIO * misfit[0] + RIVAL_MARGIN
    if is_rival.any():
        return None
    matched = fits.assigned[0] >= 0
    is_assigned = np.zeros(len(detections), dtype=bool)
    is_assigned[known[fits.assigned[0, matched]]] = True
    if is_other_hand(detections, is_assigned, view):
        return None
    rotation = view.rotation_w0_cam.T @ fits.rotation[0]
    position = view.rotation_w0_cam.T @ (fits.translation[0] - view.translation_w0_cam_m)
    return FoundPalm(position, rotation, matched)


def is_other_hand(detections: Detections, is_assigned: NDArray[np.bool_], view: PalmView) -> bool:
    """Return whether some of the blobs assigned to this palm are the other hand's.

    Of the blobs about those that are assigned (B,) the mirror image explains at least five and as many as were
    assigned, better than this palm does, however it lies.
    """
    palm, least = view.palm_m, max(MIN_FOUND_MARKERS + 1, int(np.count_nonzero(is_assigned)))
    known = np.isfinite(detections.depth_m)
    points = view.camera.backproject(detections.pixel[known], detections.depth_m[known])
    is_assigned = is_assigned[known]
    if len(points) < least or not is_assigned.any():
        return False
    across_m = np.linalg.norm(palm[:, None] - palm, axis=-1).max() + DISTANCE_TOLERANCE_M
    about = (np.linalg.norm(points[:, None] - points[is_assigned], axis=-1) < across_m).any(axis=1)
    points, is_assigned = points[about], is_assigned[about]
    mirrored = _PalmSearch(palm * _MIRROR, points).find_likeliest_pose()
    if not (mirrored.disc_count >= least).any():
        return False
    others = mirrored.assigned[0, mirrored.assigned[0] >= 0]
    own = _PalmSearch(palm, points[others]).find_likeliest_pose()
    is_better = (own.likeness() < mirrored.likeness()).all()
    return bool(is_better and is_assigned[others].any())


@dataclass(frozen=True, slots=True)
class _PalmSearch:
    """The search of a palm whose discs lie as in ``model`` (6, 3) among ``points`` (B, 3).

    ``is_in_reach`` tells which points the fingers on it may be.
    """

    model: FloatArray
    points: FloatArray
    is_in_reach: ReachTest | None = None

    def fit_poses(self) -> _PoseFits:
        """Return the poses that most points confirm, refitted to all discs that do."""
        triple, blobs = self._match_triples()
        corners, seen = self.model[_TRIPLES], self.points[blobs]
        rotation = _triad_axes(seen) @ np.swapaxes(_triad_axes(corners), -1, -2)[triple]
        # The dorsal side looks at the camera: Z of the palm has a negative component along its axis.
        facing = np.flatnonzero(rotation[:, 2, 2] < 0.0)
        rotation = rotation[facing]
        middle = corners.mean(axis=1)[triple[facing]]
        translation = seen[facing].mean(axis=1) - (rotation @ middle[..., None])[..., 0]
        for last in (False, True):
            nearest, gap_m = self._find_nearest(rotation, translation)
            matched = gap_m < MAX_DISC_GAP_M
            count = matched.sum(axis=1)
            worth = count - np.where(matched, gap_m, 0.0).sum(axis=1) / (6.0 * MAX_DISC_GAP_M)
            kept = np.argsort(-worth, kind="stable")[:MAX_FITTED_POSES]
            kept = kept[count[kept] >= MIN_FOUND_MARKERS - (0 if last else 1)]
            rotation, translation = _fit_rigid_poses(self.model, self.points[nearest[kept]], matched[kept])
        return self._score_poses(rotation, translation)

    def find_likeliest_pose(self) -> _PoseFits:
        """Return the pose that most points confirm best; or none."""
        fits = self.fit_poses()
        return fits.subset(np.argsort(-fits.likeness(), kind="stable")[:1])

    def select_plausible(self, fits: _PoseFits) -> _PoseFits:
        """Select the poses with enough discs and the back of the hand before the camera.

        Where fingers are there to explain the rest, with their share of the points explained.
        """
        least = np.array(MIN_EXPLAINED_SHARE)[fits.disc_count] * (0 if self.is_in_reach is None else len(self.points))
        is_palm = (fits.disc_count >= MIN_FOUND_MARKERS) & (fits.rotation[:, 2, 2] < 0.0)
        return fits.subset(np.flatnonzero(is_palm & (fits.explained_count >= least)))

    def fit_all_assignments(self, four: NDArray[np.int64]) -> _PoseFits:
        """Return the poses of four points by all their associations, where these fit at all."""
        used = np.zeros((len(_FOUR_MARKER_ASSIGNMENTS), len(self.model)), dtype=bool)
        np.put_along_axis(used, _FOUR_MARKER_ASSIGNMENTS, True, axis=1)
        at = np.zeros(used.shape, dtype=np.int64)
        np.put_along_axis(at, _FOUR_MARKER_ASSIGNMENTS, np.broadcast_to(four, _FOUR_MARKER_ASSIGNMENTS.shape), axis=1)
        fits = self._score_poses(*_fit_rigid_poses(self.model, self.points[at], used))
        return fits.subset(np.flatnonzero((fits.assigned == np.where(used, at, -1)).all(axis=1)))

    def _match_triples(self) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """Return which triples (N,) of palm discs have their distances between which points (N, 3)."""
        between = np.linalg.norm(self.points[:, None] - self.points[None], axis=-1)
        triples, blobs = [], []
        for number, (a, b, c) in enumerate(_TRIPLES):
            ab, ac, bc = (
                np.abs(between - np.linalg.norm(self.model[first] - self.model[second])) < DISTANCE_TOLERANCE_M
                for first, second in ((a, b), (a, c), (b, c))
            )
            found = np.argwhere(ab[:, :, None] & ac[:, None, :] & bc[None, :, :])
            triples.append(np.full(len(found), number))
            blobs.append(found)
        return np.concatenate(triples), np.concatenate(blobs)

    def _score_poses(self, rotation: FloatArray, translation: FloatArray) -> _PoseFits:
        """Count the points that confirm these poses."""
        nearest, gap_m = self._find_nearest(rotation, translation)
        matched = gap_m < MAX_DISC_GAP_M
        count = matched.sum(axis=1)
        rms_m = np.sqrt(np.where(matched, gap_m**2, 0.0).sum(axis=1) / np.maximum(count, 1))
        explained = count
        if self.is_in_reach is not None and count.size:
            is_finger = self.is_in_reach((self.points - translation[:, None]) @ rotation)
            np.put_along_axis(is_finger, np.where(matched, nearest, nearest[:, :1]), False, axis=1)
            explained = count + is_finger.sum(axis=1)
        return _PoseFits(rotation, translation, np.where(matched, nearest, -1), rms_m, explained)

    def _find_nearest(self, rotation: FloatArray, translation: FloatArray) -> tuple[NDArray[np.int64], FloatArray]:
        """Return the nearest point (N, 6) to each disc of the placed models, and its gap (N, 6)."""
        points, placed = self.points, self.model @ np.swapaxes(rotation, -1, -2) + translation[:, None, :]
        gap2 = (placed * placed).sum(axis=-1)[..., None] + (points * points).sum(axis=-1) - 2.0 * (placed @ points.T)
        nearest = gap2.argmin(axis=-1)
        least = np.take_along_axis(gap2, nearest[..., None], axis=-1)[..., 0]
        return nearest, np.sqrt(np.maximum(least, 0.0))


def _triad_axes(points: FloatArray) -> FloatArray:
    """Return right-handed axes (..., 3, 3) as columns that three points (..., 3, 3) span."""
    along = points[..., 1, :] - points[..., 0, :]
    normal = _cross(along, points[..., 2, :] - points[..., 0, :])
    axes = np.empty((*along.shape, 3))
    axes[..., 0] = along / np.sqrt((along * along).sum(axis=-1, keepdims=True))
    axes[..., 2] = normal / np.sqrt((normal * normal).sum(axis=-1, keepdims=True))
    axes[..., 1] = _cross(axes[..., 2], axes[..., 0])
    return axes


def _cross(a: FloatArray, b: FloatArray) -> FloatArray:
    return np.asarray(a[..., [1, 2, 0]] * b[..., [2, 0, 1]] - a[..., [2, 0, 1]] * b[..., [1, 2, 0]])


def _fit_rigid_poses(model: FloatArray, points: FloatArray, used: NDArray[np.bool_]) -> tuple[FloatArray, FloatArray]:
    """Return least-squares poses that carry the used (N, 6) discs of the model to points (N, 6, 3)."""
    weight = used / used.sum(axis=1, keepdims=True)
    model_mean = weight @ model
    point_mean = (weight[:, None] @ points)[:, 0]
    cross = np.swapaxes(points * weight[..., None], -1, -2) @ (model - model_mean[:, None])
    rotation = so3.project_to_rotation(cross)
    return rotation, point_mean - (rotation @ model_mean[..., None])[..., 0]


def _exceeds_turn_limits(fits: _PoseFits, limits: TurnLimits, rotation_w0_cam: FloatArray) -> NDArray[np.bool_]:
    """Return which poses (N,) are turned further than a hand can be."""
    about = np.stack((rotation_w0_cam @ limits.rotation_w2_w0, rotation_w0_cam))
    cosine = 0.5 * (np.einsum("kij,nij->kn", about, fits.rotation) - 1.0)
    turn_rad, tilt_rad = np.arccos(np.clip(cosine, -1.0, 1.0))
    is_whole = (fits.assigned >= 0).all(axis=1)
    return np.asarray(np.where(is_whole, tilt_rad > limits.max_tilt_rad, turn_rad > limits.max_rad))


def _compute_misfit(
    fits: _PoseFits, search: _PalmSearch, depth_sd_m: FloatArray, disc_covariance: FloatArray
) -> FloatArray:
    """Return chi squared (N,) of the discs' places, each pose moved to where it is least.

    Across the ray of the camera and of the finger a disc is known to a fraction of a millimetre, along them to some:
    associations are told apart by that, much better than by plain distances.
    """
    discs = len(search.model)
    is_assigned = fits.assigned >= 0
    blob = np.where(is_assigned, fits.assigned, 0)
    point_m = search.points[blob]
    residual_m = (point_m - fits.translation[:, None]) @ fits.rotation - search.model
    residual = np.where(is_assigned[..., None], residual_m, 0.0).reshape(-1, 3 * discs)
    ray = (point_m / point_m[..., 2:]) @ fits.rotation * depth_sd_m[blob][..., None]
    own = ray[..., :, None] * ray[..., None, :] + LATERAL_SD_M**2 * np.eye(3)
    own += np.where(is_assigned, 0.0, _LOOSE_M2)[..., None, None] * np.eye(3)
    disc = np.arange(discs)
    covariance = np.repeat(disc_covariance[None], len(residual), axis=0)
    covariance.reshape(-1, discs, 3, discs, 3)[:, disc, :, disc] += np.swapaxes(own, 0, 1)
    by_pose = np.empty((discs, 3, 6))
    by_pose[..., :3], by_pose[..., 3:] = np.eye(3), so3.skew(-search.model)
    slope = by_pose.reshape(-1, 6)
    right = np.concatenate((residual[..., None], np.broadcast_to(slope, (*residual.shape, 6))), -1)
    solved = np.linalg.solve(covariance, right)
    gradient = slope.T @ solved[..., 0:1]
    step = np.linalg.solve(slope.T @ solved[..., 1:], gradient)
    return np.asarray((residual * solved[..., 0]).sum(axis=-1) - (gradient * step)[..., 0].sum(axis=-1))
