"""Calibration of the hand at its neutral pose from a person's clicks (wrist paper II-C and III-D)."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from carpus.core.calibration.candidates import find_marker_candidates, is_paper
from carpus.core.calibration.label_checks import (
    MAX_DEPTH_OFFSET_M,
    SAME_MARKER_RADII,
    SAME_SPOT_PX,
    find_label_fault,
    find_odd_marker,
    find_shifted_labels,
    is_other_side,
    plan_view,
)
from carpus.core.calibration.neutral_depth import (
    COMPARED_WIDTH_PX,
    MIN_OFFSET_PX,
    estimate_back_surface,
    estimate_depth_offset_px,
)
from carpus.core.calibration.neutral_pose import TOWARDS_CAMERA, estimate_neutral_pose
from carpus.core.calibration.result import Calibration, CalibrationFinding, Clicks, Verdict
from carpus.core.detection.appearance import (
    MAX_CLICK_DISTANCE_RADII,
    DetectionSettings,
    MarkerAppearance,
    assign_nearest,
    estimate_radius_px,
    learn_appearance,
    to_hsv,
)
from carpus.core.detection.detector import Detector
from carpus.core.model.camera import Camera
from carpus.core.model.depth_sensor import DepthSensor
from carpus.core.model.errors import CalibrationImpossible, ClickOnNoMarker, MarkerWithoutDepth
from carpus.core.model.hand.clinical_angles import wrist_axes
from carpus.core.model.types import Detections, FloatArray, Frame, Region


@dataclass(frozen=True, slots=True)
class CalibrationSettings:
    """Limits of the hand calibration.

    Attributes
    ----------
    still_s : float
        Longest time over which the neutral pose is averaged while the hand is still.
    min_distance_m : float
        From camera to hand; wrist paper, II-C.
    max_tilt_deg : float
        Of the back of the hand to the image plane.
    max_residual_mm : float
        Of a marker from its expected position.
    hand_length_mm : tuple of float
        Shortest and longest plausible hand: a child of six to a tall man.
    """

    still_s: float = 0.5
    min_distance_m: float = 0.6
    max_tilt_deg: float = 15.0
    max_residual_mm: float = 4.0
    hand_length_mm: tuple[float, float] = (110.0, 225.0)


_MCP3_OVER_HAND_LENGTH = 0.446
"""Wrist crease to middle knuckle over hand length (reference 3.3)."""
MAX_STILL_MOTION_PX = 0.7
"""Motion of the markers up to which the hand is still."""
STILL_GATE_PX, MIN_STILL_MARKERS = 4.0, 3
"""While the hand is still, at least so many markers lie within this distance of their click."""
MIN_NEUTRAL_FRAMES = 5
"""Fewer still frames give a finding."""
DEFAULT_PIXEL_SD_PX, SYSTEMATIC_PIXEL_SD_PX = 0.3, 0.1
"""Noise of a marker's centre if too few frames show it; the part that averaging does not remove."""
MAX_HAND_LENGTH_CHANGE = 0.15
"""Markers placed anew lie up to half a centimetre off on the 8 cm that are measured."""


@dataclass(frozen=True, slots=True)
class NeutralCapture:
    """Measurements (F, M) of the M markers over the F still frames, ``pixel`` (F, M, 2); NaN where not measured.

    The standard deviation is that stated by the detector, the duration from the first to the last still frame.
    """

    pixel: FloatArray
    depth_m: FloatArray
    depth_sd_m: FloatArray
    area_px: FloatArray
    duration_s: float = 0.0

    @property
    def frame_count(self) -> int:
        return int(self.pixel.shape[0])


@dataclass(frozen=True, slots=True)
class MeasurementNoise:
    """Noise of one frame's marker centres and depths on a still hand; NaN with too few frames.

    ``depth_noise_ratio`` is the depth noise over that of the sensor model, ``marker_radius_m`` that of palm markers.
    """

    pixel_sd_px: float = float("nan")
    depth_sd_m: float = float("nan")
    depth_noise_ratio: float = float("nan")
    marker_radius_m: float = float("nan")


@dataclass(frozen=True, slots=True)
class MeasuredHand:
    """Verdict on a neutral capture, its noise, and the calibration unless a finding blocks it."""

    verdict: Verdict
    calibration: Calibration | None
    noise: MeasurementNoise


@dataclass(frozen=True, slots=True)
class CalibrationOutcome(MeasuredHand):
    """Measured hand with the appearance of its markers.

    ``pixel`` (M, 2) is where they were found, NaN where not; ``capture_frames`` is the number of still frames used.
    """

    appearance: MarkerAppearance
    pixel: FloatArray
    capture_frames: int


def calibrate_hand(
    clicks: Clicks,
    frames: Sequence[Frame],
    camera: Camera,
    settings: CalibrationSettings,
    detection: DetectionSettings,
    start_angles_rad: FloatArray | None = None,
) -> CalibrationOutcome:
    """Find the clicked markers, average them while the hand is still, measure and check the palm.

    ``frames`` are the clicked one and those that follow it; ``start_angles_rad`` (3,) deviation, flexion and
    pronosupination of the neutral pose, None for zero.
    """
    first = frames[0]
    radius_px = estimate_radius_px(first, clicks.pixel, camera, detection)
    margin_px = 3.0 * float(radius_px.max()) + 12.0
    left, top = (int(value) for value in clicks.pixel.min(axis=0) - margin_px)
    right, bottom = (int(value) + 1 for value in clicks.pixel.max(axis=0) + margin_px)
    region = Region(left, top, right, bottom).clip(camera.width_px, camera.height_px)
    appearance, blobs, blob_index, findings = _find_clicked_markers(
        clicks, first, region, MAX_CLICK_DISTANCE_RADII * radius_px, camera, detection
    )
    detector = Detector(appearance, camera, detection)
    found_px = np.where((blob_index >= 0)[:, None], _select_rows(blobs.pixel, blob_index), np.nan)
    if np.any(blob_index < 0):
        verdict = _empty_verdict(clicks, findings)
        return CalibrationOutcome(verdict, None, MeasurementNoise(), appearance, found_px, 0)

    offset_px = estimate_depth_offset_px(first, appearance, found_px)
    if offset_px > 0.0:
        limit_px = MIN_OFFSET_PX * camera.width_px / COMPARED_WIDTH_PX
        findings.append(CalibrationFinding("depth_off", (), offset_px, limit_px, "px"))

    def iterate_detections() -> Iterator[tuple[float, Detections]]:
        yield first.timestamp_s, blobs
        for frame in frames[1:]:
            yield frame.timestamp_s, detector.detect(frame, region)

    capture = capture_neutral_pose(iterate_detections(), blob_index, settings)
    hand = measure_hand(clicks, capture, camera, settings, findings, start_angles_rad)
    if not any(finding.kind in _LABEL_FINDINGS for finding in hand.verdict.findings):
        all_blobs = detector.detect(first)
        hand = _check_unlabelled_spots(hand, clicks, first, found_px, radius_px, all_blobs, camera, detection)
    calibration = hand.calibration
    if calibration is not None:
        still = [frame for frame in frames if frame.timestamp_s <= first.timestamp_s + capture.duration_s]
        calibration = replace(calibration, surface=estimate_back_surface(calibration, still, camera))
    return CalibrationOutcome(hand.verdict, calibration, hand.noise, appearance, found_px, capture.frame_count)


_LABEL_FINDINGS = ("shifted", "swapped", "misnamed", "wrong_side")


def _check_unlabelled_spots(
    hand: MeasuredHand,
    clicks: Clicks,
    frame: Frame,
    found_px: FloatArray,
    radius_px: FloatArray,
    blobs: Detections,
    camera: Camera,
    detection: DetectionSettings,
) -> MeasuredHand:
    """Add a finding if an unlabelled spot may be a marker, or if a marker makes no palm."""
    names = clicks.protocol.markers
    distance_px = np.linalg.norm(blobs.pixel[:, None] - found_px[None], axis=-1)
    is_marker = distance_px.min(axis=1) < SAME_SPOT_PX
    distance_px[distance_px.argmin(axis=0)] = np.inf  # a marker is its own nearest blob
    near = distance_px / radius_px
    if near.size and near.min() < SAME_MARKER_RADII:
        spot, marker = np.unravel_index(int(near.argmin()), near.shape)
        spot_px = tuple(map(float, blobs.pixel[spot]))
        hand = _add_finding(hand, CalibrationFinding("near_spot", (names[marker],), spot_px=spot_px))
    depth_m = float(hand.verdict.distance_m)
    is_near = ~np.isfinite(blobs.depth_m) | (np.abs(blobs.depth_m - depth_m) < MAX_DEPTH_OFFSET_M)
    spare_px = blobs.pixel[~is_marker & is_near]
    spare_px = spare_px[is_paper(spare_px, frame, to_hsv(frame.color_rgb), camera, detection)]

    def plan(pixel: FloatArray) -> FloatArray:
        return plan_view(camera.backproject(camera.undistort(pixel), np.full(len(pixel), depth_m)))

    palm = list(clicks.protocol.palm)
    odd = find_odd_marker(clicks.side, plan(found_px[palm]), plan(spare_px))
    if odd is None or not np.isfinite(depth_m):
        return hand
    kind = "other_spot" if odd.is_spot_better else "spare_spot" if odd.spot >= 0 else "no_palm"
    spot_px = tuple(map(float, spare_px[odd.spot])) if odd.spot >= 0 else ()
    marker_names = (names[palm[odd.marker]],) if odd.marker >= 0 else ()
    return _add_finding(hand, CalibrationFinding(kind, marker_names, spot_px=spot_px))


_HandT = TypeVar("_HandT", bound=MeasuredHand)


def _add_finding(hand: _HandT, finding: CalibrationFinding) -> _HandT:
    verdict = replace(hand.verdict, findings=(*hand.verdict.findings, finding))
    calibration = None if hand.calibration is None else replace(hand.calibration, verdict=verdict)
    return replace(hand, verdict=verdict, calibration=calibration)


_ClickedMarkers = tuple[MarkerAppearance, Detections, NDArray[np.int64], list[CalibrationFinding]]
"""Appearance, blobs of the clicked frame, blob of each click (M,) or -1, findings."""


def _find_clicked_markers(
    clicks: Clicks, frame: Frame, region: Region, reach_px: FloatArray, camera: Camera, detection: DetectionSettings
) -> _ClickedMarkers:
    def detect_at_pixels(pixel: FloatArray) -> _ClickedMarkers:
        """Learn the appearance at ``pixel`` (M, 2) and assign the blobs."""
        appearance, _ = learn_appearance(frame, pixel, camera, detection)
        blobs = Detector(appearance, camera, detection).detect(frame, region)
        return appearance, blobs, *_assign_clicks(clicks, blobs, reach_px)

    found = detect_at_pixels(clicks.pixel)
    if np.all(found[2] >= 0):
        return found
    # With small markers, or clicks at their edges, the appearance is better learnt in the middle of a blue spot.
    spots_px = find_marker_candidates(frame, camera, detection).pixel
    spot = assign_nearest(np.linalg.norm(clicks.pixel[:, None] - spots_px[None], axis=-1), reach_px)
    again = detect_at_pixels(np.where((spot >= 0)[:, None], _select_rows(spots_px, spot), clicks.pixel))
    return max(found, again, key=lambda each: int(np.count_nonzero(each[2] >= 0)))


def require_calibration(outcome: CalibrationOutcome) -> Calibration:
    """Return the calibration. Raises the error of the first finding that blocks it."""
    for finding in outcome.verdict.findings:
        if finding.blocks:
            fault = MarkerWithoutDepth if finding.kind == "no_depth" else ClickOnNoMarker
            raise fault(", ".join(finding.markers))
    if outcome.calibration is None:
        raise CalibrationImpossible()
    return outcome.calibration


def _select_rows(values: FloatArray, index: NDArray[np.int64]) -> FloatArray:
    if values.shape[0] == 0:
        return np.full((index.size, *values.shape[1:]), np.nan)
    return values[np.maximum(index, 0)]


def _assign_clicks(
    clicks: Clicks, blobs: Detections, reach_px: FloatArray
) -> tuple[NDArray[np.int64], list[CalibrationFinding]]:
    """Return the blob of each click (M,) or -1, by the smallest total distance, and the findings."""
    names = clicks.protocol.markers
    findings: list[CalibrationFinding] = []
    distance = np.linalg.norm(clicks.pixel[:, None] - blobs.pixel[None], axis=-1)
    taken = assign_nearest(distance, reach_px)
    for marker in np.flatnonzero(taken < 0):
        rivals = [r for r in range(len(names)) if taken[r] >= 0 and distance[marker, taken[r]] <= reach_px[marker]]
        if rivals:
            rival = min(rivals, key=lambda r: float(distance[marker, taken[r]]))
            findings.append(CalibrationFinding("two_clicks_on_one", (names[rival], names[marker]), blocks=True))
        else:
            findings.append(CalibrationFinding("click_on_no_marker", (names[marker],), blocks=True))
    return taken, findings


def capture_neutral_pose(
    detections: Iterable[tuple[float, Detections]], blob_index: NDArray[np.int64], settings: CalibrationSettings
) -> NeutralCapture:
    """Collect the markers from the first frame on until the hand moves.

    ``detections`` are time and blobs of each frame, in order; ``blob_index`` (M,) is the blob of each marker in the
    first one.
    """
    frames = iter(detections)
    start_s, blobs = next(frames)
    start_px = blobs.pixel[blob_index]
    measured = [_measure_blobs(blobs, blob_index)]
    duration_s = 0.0
    for time_s, blobs in frames:
        if time_s - start_s > settings.still_s:
            break
        if not len(blobs):
            continue
        distance = np.linalg.norm(start_px[:, None] - blobs.pixel[None], axis=-1)
        nearest = distance.argmin(axis=1)
        near = distance[np.arange(len(start_px)), nearest] < STILL_GATE_PX
        if np.count_nonzero(near) < MIN_STILL_MARKERS:
            continue
        moved_px = np.median(blobs.pixel[nearest[near]] - start_px[near], axis=0)
        if float(np.hypot(*moved_px)) > MAX_STILL_MOTION_PX:
            break
        duration_s = time_s - start_s
        measured.append(tuple(np.where(near, each.T, np.nan).T for each in _measure_blobs(blobs, nearest)))
    pixel, depth_m, depth_sd_m, area_px = map(np.stack, zip(*measured, strict=True))
    return NeutralCapture(pixel, depth_m, depth_sd_m, area_px, duration_s)


def _measure_blobs(blobs: Detections, index: NDArray[np.int64]) -> tuple[FloatArray, ...]:
    return blobs.pixel[index], blobs.depth_m[index], blobs.depth_sd_m[index], blobs.area_px[index]


def measure_hand(
    clicks: Clicks,
    capture: NeutralCapture,
    camera: Camera,
    settings: CalibrationSettings,
    earlier_findings: Iterable[CalibrationFinding] = (),
    start_angles_rad: FloatArray | None = None,
) -> MeasuredHand:
    """Average the markers of the still hand, estimate shape and neutral pose, check them."""
    names = clicks.protocol.markers
    findings = list(earlier_findings)
    palm = np.array(clicks.protocol.palm)
    depth_count = np.isfinite(capture.depth_m).sum(axis=0)
    for marker in np.flatnonzero(depth_count == 0):
        findings.append(CalibrationFinding("no_depth", (names[marker],), blocks=bool(marker in palm)))
    if np.any(depth_count[palm] == 0):
        return MeasuredHand(_empty_verdict(clicks, findings), None, MeasurementNoise())
    with np.errstate(all="ignore"):
        pixel = camera.undistort(np.nanmean(capture.pixel, axis=0))
        depth_m = _nanmean(capture.depth_m)
    # Children wear smaller markers (reference 2).
    radius_m = np.sqrt(_nanmean(capture.area_px[:, palm]) / np.pi) * _nanmean(capture.depth_m[:, palm]) / camera.fx_px
    noise = replace(_estimate_noise(capture, camera.sensor), marker_radius_m=float(np.nanmedian(radius_m)))
    point_cam = camera.backproject(pixel, depth_m)
    axes_cam = wrist_axes(point_cam[palm], TOWARDS_CAMERA)
    origin_cam = point_cam[palm[0]]
    marker_w0_m = (point_cam - origin_cam) @ axes_cam
    seen = np.isfinite(depth_m)
    if not np.all(np.isfinite(axes_cam)):
        raise CalibrationImpossible(", ".join(names))
    rotation, translation = estimate_neutral_pose(
        camera, marker_w0_m[seen], pixel[seen], depth_m[seen], axes_cam, origin_cam
    )
    covariance = _marker_covariances(
        point_cam,
        rotation,
        np.isfinite(capture.pixel[..., 0]).sum(axis=0),
        depth_count,
        _nanmean(capture.depth_sd_m),
        _nanmean(capture.area_px),
        noise,
        camera,
    )
    # the RMS distance of each marker from its fitted place
    ideal = camera.undistort(np.nan_to_num(capture.pixel.reshape(-1, 2))).reshape(capture.pixel.shape)
    measured_m = camera.backproject(ideal, capture.depth_m)
    squared = np.sum((measured_m - (marker_w0_m @ rotation.T + translation)) ** 2, axis=-1)
    squared[~np.isfinite(capture.pixel[..., 0])] = np.nan
    residual_mm = 1e3 * np.sqrt(_nanmean(squared))
    hand_length_mm = 1e3 * float(np.linalg.norm(marker_w0_m[palm[3]])) / _MCP3_OVER_HAND_LENGTH
    view_axis = -origin_cam / np.linalg.norm(origin_cam)
    tilt_deg = float(np.degrees(np.arccos(np.clip(rotation[:, 2] @ view_axis, -1.0, 1.0))))
    verdict = Verdict(residual_mm, hand_length_mm, tilt_deg, float(origin_cam[2]), capture.frame_count, ())
    usual_m = float(np.median(depth_m[seen]))
    plan = plan_view(camera.backproject(pixel, np.where(seen, depth_m, usual_m)))
    near_m = max(settings.min_distance_m, camera.sensor.nearest_m)
    findings += _check_calibration(clicks, verdict, plan, replace(settings, min_distance_m=near_m))
    calibration = Calibration(
        clicks,
        marker_w0_m,
        rotation,
        translation,
        covariance,
        np.zeros(3) if start_angles_rad is None else start_angles_rad,
        replace(verdict, findings=tuple(findings)),
    )
    return MeasuredHand(calibration.verdict, calibration, noise)


def _nanmean(values: FloatArray) -> FloatArray:
    count = np.isfinite(values).sum(axis=0)
    total = np.nansum(values, axis=0)
    return np.asarray(np.where(count > 0, total / np.maximum(count, 1), np.nan))


def _estimate_noise(capture: NeutralCapture, sensor: DepthSensor) -> MeasurementNoise:
    """Estimate the noise of one frame without the common drift; NaN with too few frames."""
    if capture.frame_count < 4:
        return MeasurementNoise()
    centred = capture.pixel - np.nanmean(capture.pixel, axis=0)  # centred, so that a missing marker moves no median
    drift = centred - np.nanmedian(centred, axis=1, keepdims=True)
    # The median that is removed contains a part of each marker's own scatter, more with fewer markers.
    seen = int(np.count_nonzero(np.isfinite(capture.pixel[..., 0]).sum(axis=0) > 1))
    pixel_sd = math.sqrt(_mean_variance(drift) * seen / max(seen - 1, 1))
    depth_sd = math.sqrt(_mean_variance(capture.depth_m))
    book_m = sensor.disc_sd_m(capture.depth_m, capture.area_px)
    return MeasurementNoise(pixel_sd, depth_sd, depth_sd / float(np.nanmean(book_m)))


def _mean_variance(series: FloatArray) -> float:
    """Return the mean variance over time of series (F, ...) seen more than once, else NaN."""
    is_repeated = np.isfinite(series).sum(axis=0) > 1
    return float(np.mean(np.nanvar(series[:, is_repeated], axis=0, ddof=1))) if is_repeated.any() else math.nan


def _marker_covariances(
    point_cam: FloatArray,
    rotation: FloatArray,
    pixel_count: NDArray[np.int64],
    depth_count: NDArray[np.int64],
    detector_sd_m: FloatArray,
    area_px: FloatArray,
    noise: MeasurementNoise,
    camera: Camera,
) -> FloatArray:
    """Return covariances (M, 3, 3) in W0: lateral from the pixels, along the ray from the depth."""
    z = point_cam[:, 2]
    book_m = camera.sensor.disc_sd_m(z, area_px)
    scatter_m = noise.depth_sd_m if np.isfinite(noise.depth_sd_m) else book_m
    steep2 = np.maximum(detector_sd_m**2 - book_m**2, 0.0)  # of a slope, as steep in every frame
    along = scatter_m**2 / np.maximum(depth_count, 1) + camera.sensor.bias_sd_m(z) ** 2 + steep2
    pixel_sd = noise.pixel_sd_px if np.isfinite(noise.pixel_sd_px) else DEFAULT_PIXEL_SD_PX
    across_m = np.hypot(pixel_sd / np.sqrt(np.maximum(pixel_count, 1)), SYSTEMATIC_PIXEL_SD_PX) * z / camera.fx_px
    ray = point_cam / z[:, None]
    flat = np.diag([1.0, 1.0, 0.0])
    in_cam = across_m[:, None, None] ** 2 * flat + along[:, None, None] * (ray[:, :, None] * ray[:, None, :])
    return np.asarray(rotation.T @ in_cam @ rotation)


def _check_calibration(
    clicks: Clicks, verdict: Verdict, plan: FloatArray, settings: CalibrationSettings
) -> list[CalibrationFinding]:
    names = clicks.protocol.markers
    out: list[CalibrationFinding] = []
    shifted = find_shifted_labels(clicks.side, plan[list(clicks.protocol.palm)])
    if len(shifted) > 2:
        out.append(CalibrationFinding("shifted", shifted))
    elif is_other_side(clicks.protocol, clicks.side, plan):
        out.append(CalibrationFinding("wrong_side"))
    elif shifted and not clicks.protocol.has_fingers:
        out.append(CalibrationFinding("swapped", shifted))
    elif clicks.protocol.has_fingers:
        names_at_fault = find_label_fault(clicks.protocol, clicks.side, plan)
        if names_at_fault is not None and names_at_fault.misplaced:
            out.append(CalibrationFinding("misnamed", (names_at_fault.misplaced,)))
        elif names_at_fault is not None:
            out.append(CalibrationFinding("swapped", sum(names_at_fault.swapped, ())))
    for marker in np.flatnonzero(verdict.residual_mm > settings.max_residual_mm):
        out.append(
            CalibrationFinding(
                "residual", (names[marker],), float(verdict.residual_mm[marker]), settings.max_residual_mm, "mm"
            )
        )
    low, high = settings.hand_length_mm
    if not low <= verdict.hand_length_mm <= high:
        limit = low if verdict.hand_length_mm < low else high
        out.append(CalibrationFinding("hand_length", (), verdict.hand_length_mm, limit, "mm"))
    if verdict.tilt_deg > settings.max_tilt_deg:
        out.append(CalibrationFinding("tilt", (), verdict.tilt_deg, settings.max_tilt_deg, "deg"))
    if verdict.distance_m < settings.min_distance_m:
        out.append(CalibrationFinding("distance", (), verdict.distance_m, settings.min_distance_m, "m"))
    if verdict.frames_used < MIN_NEUTRAL_FRAMES:
        out.append(CalibrationFinding("few_frames", (), verdict.frames_used, MIN_NEUTRAL_FRAMES, "frames"))
    return out


def _empty_verdict(clicks: Clicks, findings: list[CalibrationFinding]) -> Verdict:
    unknown = np.full(len(clicks.protocol.markers), np.nan)
    return Verdict(unknown, np.nan, np.nan, np.nan, 0, tuple(findings))


def check_hand_length(outcome: CalibrationOutcome, previous_length_mm: float) -> CalibrationOutcome:
    """Add a finding if the hand's length differs from the previous one; NaN means there is none."""
    length_mm = outcome.verdict.hand_length_mm
    if not (math.isfinite(previous_length_mm) and math.isfinite(length_mm)):
        return outcome
    if abs(length_mm - previous_length_mm) <= MAX_HAND_LENGTH_CHANGE * previous_length_mm:
        return outcome
    return _add_finding(outcome, CalibrationFinding("other_length", (), length_mm, previous_length_mm, "mm"))
