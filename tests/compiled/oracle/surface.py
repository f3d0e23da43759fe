"""The fit to the back of the hand in NumPy."""

from __future__ import annotations

import numpy as np

from carpus.core.model import so3
from carpus.core.model.hand.dorsal_surface import DorsalSurface
from carpus.core.model.types import FloatArray, SurfaceSamples
from carpus.core.tracking.filter.palm_state import POSITION, RELIEF, SIZE, SURFACE, TURN, PalmEstimate, PalmView
from carpus.core.tracking.filter.surface_fit import SurfaceSettings

KEPT = np.array([0, 1, 5])
"""Turn about X and Y and shift along Z among turn and shift."""


def measure_surface(
    estimate: PalmEstimate, samples: SurfaceSamples, surface: DorsalSurface, view: PalmView, settings: SurfaceSettings
) -> tuple[FloatArray | int, ...] | None:
    """What the compiled function tells."""
    in_camera = view.camera.backproject(samples.pixel, samples.depth_m)
    in_w0 = (in_camera - view.translation_w0_cam_m) @ view.rotation_w0_cam
    rotation, position, middle = estimate.rotation_w2_w0, estimate.position_m, surface.middle_m
    shifted, turned = np.zeros(3), np.zeros(3)
    for _ in range(settings.steps):
        place = (in_w0 - position) @ rotation - middle
        plane = planes_under(place, surface)
        over = np.vecdot(place, plane[:, :3]) + plane[:, 3]
        near = np.abs(over) < settings.most_m
        if np.count_nonzero(near) < settings.least:
            return None
        weight = near * settings.huber_m / np.maximum(np.abs(over), settings.huber_m)
        by_pose = np.concatenate((np.cross(place, plane[:, :3]), plane[:, :3]), axis=1).T
        weighed = by_pose[KEPT] * weight
        inverse = np.linalg.inv(weighed @ by_pose[KEPT].T)
        about_x, about_y, up = inverse @ (weighed @ over)
        turn = np.array((about_x, about_y, 0.0))
        shift = np.array((0.0, 0.0, up)) - np.cross(turn, middle)
        shifted, turned = shifted + shift, turned + turn
        position, rotation = position + rotation @ shift, rotation @ so3.exp(turn)
    kept, pixel = weighed[:, near], samples.pixel[near]
    overlap = np.maximum(1.0 - np.abs(pixel[:, None] - pixel) / view.camera.sensor.patch_px, 0.0).prod(axis=-1)
    sensor, depth_m = view.camera.sensor, np.median(samples.depth_m)
    shared = 1.0 if sensor.averages else settings.shared
    together = shared * kept @ overlap @ kept.T + (1.0 - shared) * kept @ kept.T
    reading_m = max(settings.reading_per_m * depth_m**2, float(sensor.reading_sd_m(depth_m)))
    scatter2 = max(float(weight @ over**2 / weight.sum()), reading_m**2)
    up_m = float(sensor.bias_sd_m(depth_m)) if sensor.stays_px else 0.0
    turn_rad = up_m * view.camera.fx_px / (max(sensor.stays_px, 1.0) * depth_m)
    stays = np.array([settings.turn_sd_rad**2 + turn_rad**2] * 2 + [settings.up_sd_m**2 + up_m**2])
    by_whole = inverse @ (weighed @ by_pose.T)
    by_shift = by_whole[:, 3:]
    by_turn = by_whole[:, :3] + np.cross(middle, by_shift)
    slope = np.zeros((3, SIZE))
    slope[:, TURN], slope[:, POSITION] = by_turn, by_shift @ estimate.rotation_w2_w0.T
    slope[:, RELIEF] = slope[:, SURFACE] = np.eye(3)
    value = by_shift @ shifted + by_turn @ turned - estimate.value[RELIEF] - estimate.value[SURFACE]
    covariance = settings.goes_on * scatter2 * (inverse @ together @ inverse) + np.diag(stays)
    return value, covariance, slope, int(np.count_nonzero(near))


def planes_under(place: FloatArray, surface: DorsalSurface) -> FloatArray:
    """Planes (S, 4) of the nodes nearest to places (S, 3) about the surface's middle."""
    rows, columns = surface.height_m.shape
    node = np.rint(place @ surface.to_node[:3] + surface.to_node[3])
    column, row = np.clip(np.where(np.isnan(node), 0.0, node), 0.0, (columns + 1.0, rows + 1.0)).astype(np.int64).T
    return surface.plane[row * (columns + 2) + column]
