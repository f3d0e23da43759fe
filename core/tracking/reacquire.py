"""Finding the palm again without any prediction: its constellation of discs in space is its name tag."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from carpus.core import so3
from carpus.core.tracking.palm_view import View
from carpus.core.types import Detections, FloatArray


@dataclass(frozen=True, slots=True)
class FindingSettings:
    """When blobs are a palm that nothing foretold.

    Two discs' distance may differ from the calibrated one by ``distance_m`` (depth noise of both), a disc lie ``fit_m``
    from where the fitted palm puts it; ``least`` discs are needed. ``most_blobs``, the likest ones, are looked at.
    Beyond ``most_gap_m`` root mean square of the discs it is not this palm; another pose is a rival when its gap is
    below ``rival_gap`` times the best one's and ``rival_gap_m``. ``explained``: share of all blobs that a palm of none,
    one, two ... six discs and the fingers on it must explain, where there are fingers. ``disc_sd_m`` how far a disc may
    lie from where the found pose puts it (depth noise of one picture, and the shape), ``turn_sd_rad`` and
    ``place_sd_m`` how well such a pose is known at best, ``turn_prior_rad`` at worst.
    """

    distance_m: float = 0.007
    fit_m: float = 0.008
    least: int = 4
    most_blobs: int = 40
    most_gap_m: float = 0.004
    rival_gap: float = 1.5
    rival_gap_m: float = 0.001
    explained: tuple[float, ...] = (1.0, 1.0, 1.0, 1.0, 0.8, 0.5, 0.0)
    disc_sd_m: float = 0.003
    turn_sd_rad: float = 0.05
    place_sd_m: float = 0.004
    turn_prior_rad: float = 0.6


_MIRROR = np.array([1.0, -1.0, 1.0])
_MOST_FITTED = 24

# WRIST MCP2, CMC1 MCP4, MCP3 MCP5: a pair with one of the next pair. Any four discs hold one of these six triples.
_TRIPLES = np.array([(0, 2, 1), (0, 2, 4), (1, 4, 3), (1, 4, 5), (3, 5, 0), (3, 5, 2)])

Reach = Callable[[FloatArray], NDArray[np.bool_]]
"""Whether points (..., 3) in the body may be discs of thumb or fingers."""


@dataclass(frozen=True, slots=True)
class FoundPalm:
    """Pose of the body in W0, ``matched`` (M,) the discs that fix it."""

    position_m: FloatArray
    rotation_w2_w0: FloatArray
    matched: NDArray[np.bool_]

    @property
    def count(self) -> int:
        return int(np.count_nonzero(self.matched))

    def pose_covariance(self, palm_m: FloatArray, settings: FindingSettings) -> FloatArray:
        """Covariance (6, 6) of position and turn: discs nearly in a line say little of the turn about that line."""
        discs = palm_m[self.matched]
        middle = discs.mean(axis=0)
        lever = so3.skew(discs - middle)
        told = np.einsum("mji,mjk->ik", lever, lever) / settings.disc_sd_m**2
        turn = np.linalg.inv(told + np.eye(3) / settings.turn_prior_rad**2)
        turn += settings.turn_sd_rad**2 * np.eye(3)
        # The middle of the discs is what is known; the origin swings about it with the turn.
        swing = self.rotation_w2_w0 @ so3.skew(middle)
        out = np.empty((6, 6))
        out[:3, :3] = swing @ turn @ swing.T + settings.place_sd_m**2 * np.eye(3)
        out[:3, 3:] = swing @ turn
        out[3:, :3] = out[:3, 3:].T
        out[3:, 3:] = turn
        return out


@dataclass(frozen=True, slots=True)
class _Fits:
    """Poses (N, 3, 3), (N, 3) of a palm, discs matched (N, 6), their root mean square gap (N,), and blobs explained
    (N,) by palm and fingers."""

    rotation: FloatArray
    translation: FloatArray
    matched: NDArray[np.bool_]
    gap_m: FloatArray
    explained: NDArray[np.int64]

    @property
    def count(self) -> NDArray[np.int64]:
        return np.asarray(self.matched.sum(axis=1))


def find_palm(
    detections: Detections, view: View, settings: FindingSettings, reach: Reach | None = None
) -> FoundPalm | None:
    """Where the palm is, or None.

    Triples of discs with the distances of the palm fix a pose; the pose that most other discs confirm
    wins if it is confirmed by at least four in all and no other, different pose by as many about as well.
    Needs depth; the back of the hand must face the camera, and the other hand must not explain more discs.
    With ``reach`` the blobs left over must mostly lie where the fingers could be.
    """
    known = np.flatnonzero(np.isfinite(detections.depth_m) & (detections.similarity > 0.0))
    if known.size < settings.least:
        return None
    if known.size > settings.most_blobs:
        known = known[np.argsort(-detections.similarity[known])[: settings.most_blobs]]
    points = view.camera.back_project(detections.pixel[known], detections.depth_m[known])
    palm = view.palm_m
    triple, blobs = _triples(palm, points, settings)
    if not triple.size:
        return None
    fits = _fits(palm, triple, blobs, points, settings, reach)
    best = _best(fits, palm, known.size if reach is not None else 0, settings)
    if best is None:
        return None
    if fits.count[best] < len(palm):
        mirrored = _fits(palm * _MIRROR, triple, blobs, points, settings, None)
        if mirrored.count.size and mirrored.count.max() > fits.count[best]:
            return None
    rotation = view.rotation_w0_cam.T @ fits.rotation[best]
    position = view.rotation_w0_cam.T @ (fits.translation[best] - view.translation_w0_cam_m)
    return FoundPalm(position, rotation, fits.matched[best])


def _triples(
    palm_m: FloatArray, points: FloatArray, settings: FindingSettings
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Which of the triples (N,) of palm discs has its distances between which blobs (N, 3)."""
    between = np.linalg.norm(points[:, None] - points[None], axis=-1)
    triples, blobs = [], []
    for number, (a, b, c) in enumerate(_TRIPLES):
        ab, ac, bc = (
            np.abs(between - np.linalg.norm(palm_m[first] - palm_m[second])) < settings.distance_m
            for first, second in ((a, b), (a, c), (b, c))
        )
        found = np.argwhere(ab[:, :, None] & ac[:, None, :] & bc[None, :, :])
        triples.append(np.full(len(found), number))
        blobs.append(found)
    return np.concatenate(triples), np.concatenate(blobs)


def _frames(points: FloatArray) -> FloatArray:
    """Right-handed axes (..., 3, 3) as columns that three points (..., 3, 3) span."""
    along = points[..., 1, :] - points[..., 0, :]
    normal = _cross(along, points[..., 2, :] - points[..., 0, :])
    axes = np.empty((*along.shape, 3))
    axes[..., 0] = along / np.sqrt((along * along).sum(axis=-1, keepdims=True))
    axes[..., 2] = normal / np.sqrt((normal * normal).sum(axis=-1, keepdims=True))
    axes[..., 1] = _cross(axes[..., 2], axes[..., 0])
    return axes


def _cross(a: FloatArray, b: FloatArray) -> FloatArray:
    return np.asarray(a[..., [1, 2, 0]] * b[..., [2, 0, 1]] - a[..., [2, 0, 1]] * b[..., [1, 2, 0]])


def _fits(
    model: FloatArray,
    triple: NDArray[np.int64],
    blobs: NDArray[np.int64],
    points: FloatArray,
    settings: FindingSettings,
    reach: Reach | None,
) -> _Fits:
    """The poses of the model (6, 3) that most points (B, 3) confirm, refitted to all discs that do."""
    corners, seen = model[_TRIPLES], points[blobs]
    rotation = _frames(seen) @ np.swapaxes(_frames(corners), -1, -2)[triple]
    # The dorsal side looks at the camera: Z of the palm has a negative component along its axis.
    facing = np.flatnonzero(rotation[:, 2, 2] < 0.0)
    rotation = rotation[facing]
    middle = corners.mean(axis=1)[triple[facing]]
    translation = seen[facing].mean(axis=1) - (rotation @ middle[..., None])[..., 0]
    for last in (False, True):
        nearest, gap_m = _nearest(model, points, rotation, translation)
        matched = gap_m < settings.fit_m
        count = matched.sum(axis=1)
        worth = count - np.where(matched, gap_m, 0.0).sum(axis=1) / (6.0 * settings.fit_m)
        kept = np.argsort(-worth, kind="stable")[:_MOST_FITTED]
        kept = kept[count[kept] >= settings.least - (0 if last else 1)]
        rotation, translation = _refitted(model, points[nearest[kept]], matched[kept])
    nearest, gap_m = _nearest(model, points, rotation, translation)
    matched = gap_m < settings.fit_m
    count = matched.sum(axis=1)
    mean_m = np.sqrt(np.where(matched, gap_m**2, 0.0).sum(axis=1) / np.maximum(count, 1))
    explained = count
    if reach is not None and count.size:
        local = (points - translation[:, None]) @ rotation
        is_finger = reach(local)
        np.put_along_axis(is_finger, np.where(matched, nearest, nearest[:, :1]), False, axis=1)
        explained = count + is_finger.sum(axis=1)
    return _Fits(rotation, translation, matched, mean_m, explained)


def _nearest(
    model: FloatArray, points: FloatArray, rotation: FloatArray, translation: FloatArray
) -> tuple[NDArray[np.int64], FloatArray]:
    """Nearest point (N, 6) to each disc of the placed models, and its gap (N, 6)."""
    placed = model @ np.swapaxes(rotation, -1, -2) + translation[:, None, :]
    gap2 = (placed * placed).sum(axis=-1)[..., None] + (points * points).sum(axis=-1) - 2.0 * (placed @ points.T)
    nearest = gap2.argmin(axis=-1)
    least = np.take_along_axis(gap2, nearest[..., None], axis=-1)[..., 0]
    return nearest, np.sqrt(np.maximum(least, 0.0))


def _refitted(model: FloatArray, points: FloatArray, used: NDArray[np.bool_]) -> tuple[FloatArray, FloatArray]:
    """Least-squares poses (N, 3, 3), (N, 3) that carry the used (N, 6) discs of the model to points (N, 6, 3)."""
    weight = used / used.sum(axis=1, keepdims=True)
    model_mean = weight @ model
    point_mean = (weight[:, None] @ points)[:, 0]
    cross = np.swapaxes(points * weight[..., None], -1, -2) @ (model - model_mean[:, None])
    rotation = so3.nearest_rotation(cross)
    return rotation, point_mean - (rotation @ model_mean[..., None])[..., 0]


def _best(fits: _Fits, model: FloatArray, blobs: int, settings: FindingSettings) -> int | None:
    """The pose to believe; None when none is good enough, or when a clearly different one is about as good.

    ``blobs`` of which palm and fingers must explain their share, 0 where there are no fingers to explain any.
    """
    good = (fits.count >= settings.least) & (fits.rotation[:, 2, 2] < 0.0)
    order = np.flatnonzero(good & (fits.explained >= np.array(settings.explained)[fits.count] * blobs))
    if not order.size:
        return None
    # A disc of the palm counts for more than one that a finger could reach.
    worth = fits.explained + fits.count
    order = order[np.lexsort((fits.gap_m[order], -worth[order]))]
    best = int(order[0])
    if fits.gap_m[best] > settings.most_gap_m:
        return None
    placed = model @ np.swapaxes(fits.rotation[order], -1, -2) + fits.translation[order][:, None]
    apart = np.median(np.linalg.norm(placed - placed[0], axis=-1), axis=1)
    rival = worth[order] >= worth[best]
    rival &= (apart > 2 * settings.fit_m) & (
        fits.gap_m[order] < settings.rival_gap * fits.gap_m[best] + settings.rival_gap_m
    )
    return None if rival.any() else best
