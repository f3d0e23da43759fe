"""Finding the palm again without any prediction: its constellation of discs in space is its name tag."""

from __future__ import annotations

from itertools import combinations

import numpy as np

from core.so3 import nearest_rotation
from core.tracking.measurement import View
from core.tracking.settings import TrackerSettings
from core.types import Detections, FloatArray

DISTANCE_TOLERANCE_M = 0.007
"""Two discs' distance may differ from the calibrated one by this much (depth noise of both)."""
FIT_TOLERANCE_M = 0.008
LEAST_MATCHED = 4
MOST_BLOBS = 40
MOST_GAP_M = 0.004
"""Root mean square gap of the discs from the fitted palm above which it is not this palm."""
RIVAL_GAP, RIVAL_GAP_M = 1.5, 0.001
"""Another pose is a rival when its discs' gap is below this many times the best one's plus that much."""
_MIRROR = np.array([1.0, -1.0, 1.0])


def find_palm(
    detections: Detections, view: View, settings: TrackerSettings
) -> tuple[FloatArray, FloatArray, int] | None:
    """Position (3,) and rotation (3, 3) of the body in W0 and the number of discs matched, or None.

    Triples of discs with the distances of the palm fix a pose; the pose that most other discs confirm
    wins if it is confirmed by at least four in all and no other, different pose by as many about as well.
    Needs depth; the back of the hand must face the camera, and the other hand must not explain more discs.
    """
    known = np.flatnonzero(np.isfinite(detections.depth_m) & (detections.similarity > 0.0))
    if known.size < LEAST_MATCHED:
        return None
    if known.size > MOST_BLOBS:
        known = known[np.argsort(-detections.similarity[known])[:MOST_BLOBS]]
    points = view.camera.back_project(detections.pixel[known], detections.depth_m[known])
    palm = view.geometry.palm_m
    fit = _best_fit(palm, points)
    if fit is None:
        return None
    other_hand = _best_fit(palm * _MIRROR, points)
    if other_hand is not None and other_hand[0] > fit[0]:
        return None
    count, rotation_cam, translation_cam = fit
    rotation = view.rotation_w0_cam.T @ rotation_cam
    position = view.rotation_w0_cam.T @ (translation_cam - view.translation_w0_cam_m)
    return position, rotation, count


def _best_fit(model: FloatArray, points: FloatArray) -> tuple[int, FloatArray, FloatArray] | None:
    """Discs matched, rotation (3, 3) and translation (3,) of the model (6, 3) that explains most points (B, 3).

    None when fewer than four discs match, or when clearly different poses explain as many about as well.
    """
    best: list[tuple[int, float, FloatArray, FloatArray]] = []
    blob_distance = np.linalg.norm(points[:, None] - points[None], axis=-1)
    model_distance = np.linalg.norm(model[:, None] - model[None], axis=-1)
    for triple in combinations(range(model.shape[0]), 3):
        a, b, c = triple
        ab = np.abs(blob_distance - model_distance[a, b]) < DISTANCE_TOLERANCE_M
        ac = np.abs(blob_distance - model_distance[a, c]) < DISTANCE_TOLERANCE_M
        bc = np.abs(blob_distance - model_distance[b, c]) < DISTANCE_TOLERANCE_M
        i, j, k = np.nonzero(ab[:, :, None] & ac[:, None, :] & bc[None, :, :])
        if i.size == 0:
            continue
        chosen = np.stack((i, j, k), axis=1)
        rotation, translation = _rigid_fits(model[list(triple)], points[chosen])
        # The dorsal side looks at the camera: Z of the palm has a negative component along its axis.
        facing = rotation[:, 2, 2] < 0.0
        rotation, translation = rotation[facing], translation[facing]
        placed = model @ np.swapaxes(rotation, -1, -2) + translation[:, None, :]
        gaps = np.linalg.norm(placed[:, :, None, :] - points[None, None], axis=-1)
        nearest = gaps.min(axis=-1)
        matched = nearest < FIT_TOLERANCE_M
        count = matched.sum(axis=1)
        cost = np.where(matched, nearest, 0.0).sum(axis=1)
        for n in np.flatnonzero(count >= LEAST_MATCHED):
            best.append((int(count[n]), float(cost[n]), rotation[n], translation[n]))
    if not best:
        return None
    best.sort(key=lambda one: (-one[0], one[1] / one[0]))
    count, _, rotation, translation = best[0]
    rotation, translation, gap_m = _refit(model, points, rotation, translation)
    if gap_m > MOST_GAP_M:
        return None
    for other_count, _, other, other_at in best[1:]:
        if other_count < count:
            break
        apart = np.linalg.norm((model @ other.T + other_at) - (model @ rotation.T + translation), axis=1)
        if float(np.median(apart)) > 2 * FIT_TOLERANCE_M:
            *_, other_gap_m = _refit(model, points, other, other_at)
            if other_gap_m < RIVAL_GAP * gap_m + RIVAL_GAP_M:
                return None
    return count, rotation, translation


def _rigid_fits(model_m: FloatArray, points_m: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Least-squares poses (N, 3, 3), (N, 3) that carry model points (P, 3) to (N, P, 3) (Kabsch)."""
    model_mean, point_mean = model_m.mean(axis=0), points_m.mean(axis=1)
    cross = np.einsum("npi,pj->nij", points_m - point_mean[:, None], model_m - model_mean)
    rotation = nearest_rotation(cross)
    return rotation, point_mean - rotation @ model_mean


def _refit(
    model: FloatArray, points: FloatArray, rotation: FloatArray, translation: FloatArray
) -> tuple[FloatArray, FloatArray, float]:
    """The pose fitted again to all discs that confirm it, and their root mean square gap."""
    placed = model @ rotation.T + translation
    gaps = np.linalg.norm(placed[:, None] - points[None], axis=-1)
    blob = gaps.argmin(axis=1)
    matched = gaps[np.arange(model.shape[0]), blob] < FIT_TOLERANCE_M
    fitted_rotation, fitted_translation = _rigid_fits(model[matched], points[blob[matched]][None])
    left_over = model[matched] @ fitted_rotation[0].T + fitted_translation[0] - points[blob[matched]]
    return fitted_rotation[0], fitted_translation[0], float(np.sqrt(np.mean(np.sum(left_over**2, axis=1))))
