"""Measurements without pictures: true projections and depths with the noise that the detector has on pictures.

Thousands of frames a second, for statistics over many recordings. The constants were fitted to the detector's
results on rendered pictures.
"""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from carpus.core.model.depth_sensor import DepthSensor, NoiseModel
from carpus.core.model.types import Detections, FloatArray
from carpus.core.simulation.appearance import room_light
from carpus.core.simulation.disturbances import (
    sample_covered_markers,
    sample_false_blobs,
    sample_frame_times,
    sample_passing_rod,
)
from carpus.core.simulation.scene import Scene
from carpus.core.simulation.sensor import depth_scale
from carpus.core.simulation.spec import RandomStream, RecordingSpec
from carpus.core.simulation.truth import Truth, compute_truth
from tests.simulation.visibility import coarse_visibility

LEAST_FOUND_M = 0.0021
"""Radius of the smallest spot that the detector takes for a disc at all."""

CENTER_SD_PX = {"bright": 0.018, "normal": 0.04, "dim": 0.1}
"""Of a blob's centre, per axis, independent from frame to frame."""
CENTER_SLOW_PX, CENTER_SLOW_S = 0.04, 0.5
"""Of its part that changes slowly with the pose, and how long that is remembered."""
CENTER_BIAS_PX = 0.1
"""Of its part that is constant over a recording (shading, lens, chroma)."""


@dataclass(frozen=True, slots=True)
class BlobDepth:
    """Standard deviations of a blob's depth: ``sd`` independent from frame to frame; ``pattern`` of what stays with the
    place in the picture, over ``cell_px``; ``bias_m`` of what is constant for a marker over a recording (the matching
    window flattens knuckles); ``stated`` what the detector says."""

    sd: NoiseModel
    pattern: NoiseModel
    bias_m: float
    stated: NoiseModel
    cell_px: float = 9.0


def blob_depth(sensor: DepthSensor) -> BlobDepth:
    """By the kind of a sensor, as shares of what it states of itself."""
    if sensor.kind == "structured light":
        return BlobDepth(NoiseModel(0.0, 0.97e-3), NoiseModel(0.0, 0.42e-3), 0.00045, NoiseModel(0.0, 1.55e-3))
    sd, pattern, bias_m, stated, cell_px = _STEREO if sensor.kind == "active stereo" else _TIME_OF_FLIGHT
    stays = sensor.stays
    if sensor.kind == "active stereo":  # knuckles lose by the square of the window's width
        stays, wider = NoiseModel(0.0, stays.square_per_m), sensor.patch_px / _FITTED_PATCH_PX
        bias_m, cell_px = bias_m * wider**2, cell_px * wider
    return BlobDepth(sensor.reading.scale(sd), stays.scale(pattern), bias_m, sensor.reading.scale(stated), cell_px)


_FITTED_PATCH_PX = 11.0
_STEREO = (0.57, 0.95, 0.0009, 1.03, 13.0)
_TIME_OF_FLIGHT = (0.32, 0.6, 0.0004, 0.575, 40.0)
"""Of the sensor's reading, of what stays, metres, of the reading, pixels: fitted on rendered pictures of a D435 and of
an Azure Kinect as the constants above were."""
_SIMILARITY = (0.65, 0.08)
_AREA_SHARE = 0.79

IntArray = NDArray[np.int64]


@dataclass(frozen=True, slots=True)
class MeasurementSequence:
    """``detections`` of N frames, ``marker`` the row of the protocol each blob belongs to (-1: a false blob), the
    true values, and the time of each frame."""

    truth: Truth
    detections: tuple[Detections, ...]
    marker: tuple[IntArray, ...]


def measurement_sequence(spec: RecordingSpec) -> MeasurementSequence:
    """The blobs a detector would find in the recording of ``spec``, with its troubles, without rendering it.

    In the first frame every disc is found, as the calibration needs it.
    """
    scene = Scene(spec)
    times = sample_frame_times(spec)
    truth = compute_truth(scene, times)
    t = times.color_s
    count, markers = truth.marker_px.shape[:2]
    rng = spec.generator(RandomStream.MEASUREMENTS)
    rows = list(spec.marker_protocol.sites)
    pose = scene.pose(t)
    share, facing = coarse_visibility(scene, pose, t, sample_passing_rod(scene))
    share, facing = share[:, rows], facing[:, rows]
    seen = (share > 0.5) & ~sample_covered_markers(spec, t)[:, rows]
    truth = dataclasses.replace(truth, visible_share=np.where(seen, share, 0.0))

    noise = _Noise(spec, scene, rng)
    wander_px = noise.wander(t, (markers, 2))
    noisy = 1.0 if spec.sensor_noise else 0.0
    bias_px = noisy * rng.normal(0.0, CENTER_BIAS_PX, (markers, 2))
    bias_m = noisy * rng.normal(0.0, noise.blob.bias_m, markers)
    depth_pose = scene.pose(times.depth_s)
    depth_true = scene.to_camera(scene.markers_w0_m(depth_pose)[:, rows])[..., 2]
    pixel = noise.pixel(truth.marker_px + bias_px + wander_px)
    depth = noise.depth(truth.marker_px, depth_true + bias_m)
    area = noise.area(truth.marker_position_cam_m[..., 2], scene.patient.marker_radius_m[rows]) * facing

    false_px, false_z, false_radius, false_there = _false_places(scene, t)
    false_pixel, false_depth = noise.pixel(false_px), noise.depth(false_px, false_z)
    false_area = noise.area(false_z, false_radius)
    detections, labels = [], []
    for i in range(count):
        real, spare = np.flatnonzero(seen[i]), np.flatnonzero(false_there[i])
        order = rng.permutation(len(real) + len(spare))
        pixels = np.concatenate((pixel[i, real], false_pixel[i, spare]))[order]
        depths = np.concatenate((depth[i, real], false_depth[i, spare]))[order]
        detections.append(
            Detections(
                pixel=pixels,
                depth_m=depths,
                depth_sd_m=noise.blob.stated.sd_m(depths),
                area_px=np.concatenate((area[i, real], false_area[i, spare]))[order],
                similarity=np.clip(rng.normal(*_SIMILARITY, len(order)), 0.0, 1.0),
            )
        )
        labels.append(np.concatenate((real, np.full(len(spare), -1)))[order].astype(np.int64))
    return MeasurementSequence(truth, tuple(detections), tuple(labels))


class _Noise:
    """Noise of one recording; the depth's pattern stays with the place in the picture."""

    def __init__(self, spec: RecordingSpec, scene: Scene, rng: np.random.Generator) -> None:
        self._rng = rng
        self._on = 1.0 if spec.sensor_noise else 0.0
        self._camera = scene.camera
        self._scale = depth_scale(spec)
        self._center_sd_px = CENTER_SD_PX[room_light(spec)]
        self.blob = blob_depth(self._camera.sensor)
        cell_px = self.blob.cell_px
        cells = (int(self._camera.height_px / cell_px) + 1, int(self._camera.width_px / cell_px) + 1)
        self._pattern = rng.normal(size=cells)

    def pixel(self, true_px: FloatArray) -> FloatArray:
        return np.asarray(true_px + self._on * self._center_sd_px * self._rng.normal(size=true_px.shape))

    def wander(self, time_s: FloatArray, shape: tuple[int, ...]) -> FloatArray:
        """Slow error (N, *shape) of the centres: a first-order process in time."""
        kept = np.exp(-np.diff(time_s) / CENTER_SLOW_S)
        steps = self._rng.normal(size=(len(time_s), *shape))
        out = np.empty_like(steps)
        out[0] = steps[0]
        for i, share in enumerate(kept):
            out[i + 1] = share * out[i] + np.sqrt(1.0 - share * share) * steps[i + 1]
        return np.asarray(self._on * CENTER_SLOW_PX * out)

    def depth(self, true_px: FloatArray, true_m: FloatArray) -> FloatArray:
        cell = np.nan_to_num(true_px / self.blob.cell_px).astype(np.int64)
        column = np.clip(cell[..., 0], 0, self._pattern.shape[1] - 1)
        row = np.clip(cell[..., 1], 0, self._pattern.shape[0] - 1)
        passing, stays = self._rng.normal(size=true_m.shape), self._pattern[row, column]
        sd, pattern = self.blob.sd, self.blob.pattern
        random = sd.square_per_m * passing + pattern.square_per_m * stays
        flat_m = sd.fixed_m * passing + pattern.fixed_m * stays
        return np.asarray(self._scale * (true_m + self._on * random * true_m**2 + self._on * flat_m))

    def area(self, depth_m: FloatArray, radius_m: FloatArray | float) -> FloatArray:
        """Pixels found of a disc that faces the camera."""
        facing = _AREA_SHARE * math.pi * np.square(radius_m / depth_m) * self._camera.fx_px * self._camera.fy_px
        return np.asarray(facing * np.exp(0.05 * self._rng.normal(size=np.shape(facing))))


def _false_places(scene: Scene, time_s: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray, NDArray[np.bool_]]:
    """Pixels (N, B, 2), depths (N, B), radii (B,) and presence (N, B) of the false blobs."""
    blobs = [blob for blob in sample_false_blobs(scene) if blob.radius_m >= LEAST_FOUND_M]
    count = len(time_s)
    if not blobs:
        return np.empty((count, 0, 2)), np.empty((count, 0)), np.empty(0), np.empty((count, 0), dtype=bool)
    pose = scene.pose(time_s)
    places, there = [], []
    for blob in blobs:
        if blob.place == "skin":
            places.append(scene.to_camera(pose.rotation_w2_w0 @ blob.center_m + pose.position_m))
        else:
            places.append(np.broadcast_to(scene.to_camera(blob.center_m), (count, 3)))
        there.append((time_s >= blob.start_s) & (time_s <= blob.end_s))
    center = np.stack(places, axis=1)
    pixel = scene.camera.project(center)
    inside = (pixel >= 2.0).all(axis=-1)
    inside &= (pixel[..., 0] < scene.camera.width_px - 3) & (pixel[..., 1] < scene.camera.height_px - 3)
    return pixel, center[..., 2], np.array([blob.radius_m for blob in blobs]), np.stack(there, axis=1) & inside
