"""Fits the noise of :mod:`tests.simulation.measurements` to what the detector makes of rendered pictures.

``python -c "from tests.simulation.noise_fit import fitted_noise; print(fitted_noise())"`` (some minutes).
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from carpus.core.detection.appearance import learn_appearance
from carpus.core.detection.detector import Detector
from carpus.core.detection.settings import DetectionSettings
from carpus.core.simulation.recording import SimulatedPictures, clicks_of
from carpus.core.simulation.sensor import depth_scale
from carpus.core.simulation.spec import RecordingSpec
from carpus.core.types import FloatArray

_NEAR_PX = 4.0
_WELL_SEEN_SHARE = 0.6


@dataclass(frozen=True, slots=True)
class FittedNoise:
    """Medians over recordings and markers of robust standard deviations.

    ``center_sd_px`` and ``depth_sd_per_m2`` from frame to frame (second differences, so that motion and slow changes
    do not count); ``center_bias_px`` and ``depth_bias_m`` of what stays of each marker over a recording;
    ``depth_slow_per_m2`` of the rest; ``stated_depth_sd_per_m2`` what the detector says; ``similarity`` mean and
    standard deviation; ``area_share`` found over true projected area; ``found_share`` of well seen discs.
    """

    center_sd_px: float
    center_bias_px: float
    center_slow_px: float
    depth_sd_per_m2: float
    depth_bias_m: float
    depth_slow_per_m2: float
    stated_depth_sd_per_m2: float
    similarity: tuple[float, float]
    area_share: float
    found_share: float


def default_specs(recordings: int = 16, seconds: float = 3.0) -> list[RecordingSpec]:
    """Recordings over all tones, lights, sides and distances."""
    return [
        RecordingSpec(seed=1000 + i, motion="mixed", seconds=seconds, hand="right" if i % 2 else "left")
        for i in range(recordings)
    ]


def fitted_noise(specs: Iterable[RecordingSpec] | None = None) -> FittedNoise:
    """Detect on rendered pictures and compare with the truth."""
    rows: list[list[float]] = []
    similarity: list[float] = []
    areas: list[float] = []
    found, expected = 0, 0
    for spec in default_specs() if specs is None else specs:
        seen = _detected(spec)
        similarity += seen.similarity[np.isfinite(seen.similarity)].tolist()
        areas += seen.area_share[np.isfinite(seen.area_share)].tolist()
        found += int(np.isfinite(seen.error_px[..., 0]).sum())
        expected += int(seen.is_well_seen.sum())
        for m in range(seen.error_px.shape[1]):
            error, z = seen.error_px[:, m], seen.error_z_m[:, m]
            slow_px, slow_z = _slow(error), _slow(z[:, None])
            scale = float(np.nanmedian(seen.depth_m[:, m])) ** 2
            rows.append(
                [
                    _fast_sd(error),
                    float(np.abs(np.nanmean(error, axis=0)).mean()) / 0.798,
                    slow_px,
                    _fast_sd(z[:, None]) / scale,
                    float(np.nanmean(z)),
                    slow_z / scale,
                    float(np.nanmedian(seen.stated_sd_m[:, m])) / scale,
                ]
            )
    table = np.array(rows)
    middle = np.nanmedian(table, axis=0)
    return FittedNoise(
        center_sd_px=middle[0],
        center_bias_px=middle[1],
        center_slow_px=middle[2],
        depth_sd_per_m2=middle[3],
        depth_bias_m=float(np.nanstd(table[:, 4])),
        depth_slow_per_m2=middle[5],
        stated_depth_sd_per_m2=middle[6],
        similarity=(float(np.mean(similarity)), float(np.std(similarity))),
        area_share=float(np.median(areas)),
        found_share=found / max(expected, 1),
    )


@dataclass(frozen=True, slots=True)
class _Seen:
    """Detected minus true over (N, M); NaN where not found."""

    error_px: FloatArray
    error_z_m: FloatArray
    depth_m: FloatArray
    stated_sd_m: FloatArray
    similarity: FloatArray
    area_share: FloatArray
    is_well_seen: FloatArray


def _detected(spec: RecordingSpec) -> _Seen:
    pictures = SimulatedPictures(spec)
    truth, settings = pictures.truth, DetectionSettings()
    count, markers = truth.disc_pixel.shape[:2]
    shape = (count, markers)
    error_px = np.full((*shape, 2), np.nan)
    error_z, stated, similarity, area = (np.full(shape, np.nan) for _ in range(4))
    is_well_seen = np.zeros(shape)
    depth = truth.disc_position_cam_m[..., 2]
    scale = depth_scale(spec)
    detector: Detector | None = None
    for i, frame in enumerate(pictures.frames()):
        if detector is None:
            looks, _ = learn_appearance(frame, clicks_of(truth).pixel, truth.camera, settings)
            detector = Detector(looks, truth.camera, settings)
        blobs = detector.detect(frame)
        is_well_seen[i] = pictures.visible_share(i) > _WELL_SEEN_SHARE
        if len(blobs) == 0:
            continue
        gap = np.linalg.norm(blobs.pixel[None] - truth.disc_pixel[i][:, None], axis=-1)
        nearest = gap.argmin(axis=1)
        for m in np.flatnonzero((gap.min(axis=1) < _NEAR_PX) & (is_well_seen[i] > 0)):
            b = nearest[m]
            error_px[i, m] = blobs.pixel[b] - truth.disc_pixel[i, m]
            error_z[i, m] = blobs.depth_m[b] / scale - depth[i, m]
            stated[i, m] = blobs.depth_sd_m[b]
            similarity[i, m] = blobs.similarity[b]
            radius_px = pictures.scene.patient.disc_radius_m[m] * truth.camera.fx_px / depth[i, m]
            area[i, m] = blobs.area_px[b] / (np.pi * radius_px**2)
    return _Seen(error_px, error_z, depth, stated, similarity, area, is_well_seen)


def _fast_sd(error: FloatArray) -> float:
    """Robust standard deviation of the part that is independent from frame to frame; (N, C)."""
    second = error[2:] - 2.0 * error[1:-1] + error[:-2]
    return float(1.4826 * np.nanmedian(np.abs(second)) / np.sqrt(6.0))


def _slow(error: FloatArray) -> float:
    """Standard deviation of what neither the constant nor the fast part explains; (N, C)."""
    total = float(np.nanmean(np.nanvar(error, axis=0)))
    return float(np.sqrt(max(total - _fast_sd(error) ** 2, 0.0)))
