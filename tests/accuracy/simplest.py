"""The simplest thing that could measure a wrist: what Carpus must beat in every row.

Blue pixels by a fixed threshold, for each marker the blob nearest to its last place, no blob twice, and the
rigid turn that fits
the palm's points in space best, frame by frame (Kabsch).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path

import cv2
import numpy as np
from scipy.optimize import linear_sum_assignment

from carpus.core.capture.files.tum import TumFolder
from carpus.core.model.camera import Camera
from carpus.core.model.hand.clinical_angles import angles_from_rotation, wrist_axes
from carpus.core.model.so3 import project_to_rotation
from carpus.core.model.types import FloatArray, Frame, TrackStatus
from carpus.core.simulation.recording import sample_clicks
from tests.accuracy.carpus import OWN_PX, longest_untracked_s, select_scored_frames
from tests.accuracy.scenarios import Scenario
from tests.accuracy.scores import SIMPLEST, Estimate, Mode, Run, degrees_between, longest_s
from tests.simulation.measurements import MeasurementSequence

REACH_PX = 25.0
"""A marker's blob is not looked for further than this from its last place."""
_BLUE_FROM, _BLUE_TO = (95, 90, 30), (130, 255, 255)
_AREA_PX = (10, 400)
_TOWARDS_CAMERA = np.array([0.0, 0.0, -1.0])

Spots = tuple[FloatArray, FloatArray]
"""Pixels (D, 2) and depths (D,) of one frame, NaN where unknown."""


def blue_spots(frame: Frame) -> Spots:
    """Connected blue pixels of a plausible size, with the median depth inside each."""
    hsv = cv2.cvtColor(frame.color_rgb, cv2.COLOR_RGB2HSV)
    count, labels, stats, middle = cv2.connectedComponentsWithStats(cv2.inRange(hsv, _BLUE_FROM, _BLUE_TO))
    area = stats[:, cv2.CC_STAT_AREA]
    kept = [label for label in range(1, count) if _AREA_PX[0] <= area[label] <= _AREA_PX[1]]
    depth_m = np.full(len(kept), np.nan)
    if frame.depth_raw is not None:
        for i, label in enumerate(kept):
            left, top, width, height = stats[label, :4]
            box = np.s_[top : top + height, left : left + width]
            raw = frame.depth_raw[box][(labels[box] == label) & (frame.depth_raw[box] > 0)]
            if raw.size:
                depth_m[i] = float(np.median(raw)) * frame.depth_unit_m
    return middle[kept].reshape(-1, 2), depth_m


def nearest_points(frames: Iterable[Spots], start_px: FloatArray, camera: Camera) -> tuple[FloatArray, FloatArray]:
    """Pixels (N, M, 2) and points in camera axes (N, M, 3) of the markers, NaN where no spot was near."""
    last_px = start_px.copy()
    pixels, points = [], []
    for spot_px, depth_m in frames:
        pixel, point = np.full(start_px.shape, np.nan), np.full((len(start_px), 3), np.nan)
        if len(spot_px):
            gap = np.linalg.norm(last_px[:, None] - spot_px[None], axis=-1)
            marker, spot = linear_sum_assignment(np.minimum(gap, REACH_PX))
            near = gap[marker, spot] < REACH_PX
            marker, spot = marker[near], spot[near]
            pixel[marker], point[marker] = spot_px[spot], camera.backproject(spot_px[spot], depth_m[spot])
            last_px[marker] = spot_px[spot]
        pixels.append(pixel)
        points.append(point)
    return np.array(pixels), np.array(points)


def turns(neutral_m: FloatArray, points_m: FloatArray) -> FloatArray:
    """Rotations (N, 3, 3) of W2 in W0 from the neutral points (M, 3) and those of each frame (N, M, 3).

    Where fewer than three points are known, the last turn is kept.
    """
    axes = wrist_axes(neutral_m[:6], _TOWARDS_CAMERA)
    out = np.empty((len(points_m), 3, 3))
    last = np.eye(3)
    for i, points in enumerate(points_m[:, :6]):
        known = np.isfinite(points[:, 2])
        if known.sum() >= 3:
            model, seen = neutral_m[:6][known], points[known]
            cross = (seen - seen.mean(axis=0)).T @ (model - model.mean(axis=0))
            last = axes.T @ project_to_rotation(cross) @ axes
        out[i] = last
    return out


def simplest_run(scenario: Scenario, sequence: MeasurementSequence, begin_s: float, folder: Path | None = None) -> Run:
    """Frames after ``begin_s`` are scored; with the ``folder`` of the recording by its pictures, else by the blobs."""
    mode: Mode = "blobs" if folder is None else "pictures"
    truth = sequence.truth
    times = truth.timestamp_s
    spots: list[Spots] = []

    def seen() -> Iterator[Spots]:
        if folder is None:
            spots.extend((blobs.pixel, blobs.depth_m) for blobs in sequence.detections)
        else:
            spots.extend(blue_spots(frame) for frame in TumFolder(folder).frames())
        yield from spots

    pixel, points = nearest_points(seen(), sample_clicks(truth).pixel, truth.camera)
    still = points[times <= begin_s]
    count = np.isfinite(still).sum(axis=0)
    neutral = np.where(count > 0, np.nansum(still, axis=0) / np.maximum(count, 1), np.nan)
    known = np.isfinite(neutral).all()
    rotation = turns(neutral, points) if known else np.full((len(times), 3, 3), np.nan)
    scored = select_scored_frames(truth, begin_s)
    error = degrees_between(angles_from_rotation(rotation, truth.spec.hand), truth.angles_rad)[scored]
    wrong = np.zeros(pixel.shape[:2], dtype=bool)
    for i, marker in np.argwhere(np.isfinite(pixel[..., 0])):
        gap = np.linalg.norm(truth.marker_px[i] - pixel[i, marker], axis=-1)
        wrong[i, marker] = gap.argmin() != marker or gap.min() > OWN_PX
    seen_enough = np.isfinite(points[..., 2]).sum(axis=1) >= 3
    return Run(
        scenario.name,
        truth.spec.seed,
        mode,
        SIMPLEST,
        Estimate(error, np.full(error.shape, np.nan)),
        None,
        np.where(seen_enough, TrackStatus.TRACKED, TrackStatus.PREDICTED)[scored],
        int(np.isfinite(pixel[scored, :, 0]).sum()),
        int(wrong[scored].sum()),
        longest_s(wrong[scored], times[scored]),
        longest_untracked_s(sequence, seen_enough),
    )
