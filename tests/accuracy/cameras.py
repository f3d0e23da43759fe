"""The camera itself: what its calibration with a board finds of simulated cameras, and what the check card tells."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from carpus.core.calibration.camera.board import CHESSBOARD, create_board_sheet
from carpus.core.calibration.camera.board_views import WANTED_VIEWS, ViewCollector
from carpus.core.calibration.camera.calibrate import CameraCalibration, calibrate_camera
from carpus.core.calibration.card.card import CardReading
from carpus.core.calibration.card.measure import measure_card
from carpus.core.capture.calibrated_source import compute_correction_table
from carpus.core.capture.camera_info import StoredCalibration
from carpus.core.model.camera import DEFAULT_CAMERA, Camera
from carpus.core.model.depth_sensor import AZURE_KINECT, D435
from carpus.core.model.errors import BoardViewsTooSimilar
from carpus.core.model.types import FloatArray, Frame
from carpus.core.simulation.sensor import depth_scale
from tests.accuracy.pages import ruled
from tests.studio import LENS, Studio, card_scene, poses, texture_of

FOCAL_SHARE, DEPTH_SHARE = 0.003, 0.002
"""What was promised."""
OFF_SHARE = 0.02
"""Depth by so much off must be told by the card."""
CARD_FRAMES, CARD_EVERY_S = 12, 2.5
SEED = 7000
_DISTANCES_M = (0.5, 0.62, 0.8)
_FINE_M = 1e-4
MOST_POSES = 64


@dataclass(frozen=True, slots=True)
class SimulatedCamera:
    """A lens, and within which share its depth's scale is drawn anew for each seed."""

    name: str
    lens: Camera
    depth_share: float


CAMERAS = (
    SimulatedCamera("as the Xtion, bent lens", LENS, 0.02),
    SimulatedCamera("straight lens", Camera(569.3, 568.6, 322.8, 236.9), 0.02),
    SimulatedCamera("wide, barrel", Camera(498.2, 499.0, 311.5, 247.6, distortion=(-0.17, 0.05, -0.0009, 0.0013, 0.0)),
                    0.03),
    SimulatedCamera("long, pincushion", Camera(604.4, 605.7, 326.1, 232.2, distortion=(0.16, -0.31, 0.0, 0.0012, 0.0)),
                    0.03),
    SimulatedCamera("active stereo, D435", replace(LENS, sensor=D435), 0.02),
    SimulatedCamera("time of flight, Azure", replace(LENS, sensor=AZURE_KINECT), 0.02),
)  # fmt: skip


@dataclass(frozen=True, slots=True)
class CameraRun:
    """One calibration, off from the truth: focal lengths and depth scale as shares, with the stated standard
    deviations; the middle in px; then the card before the calibrated camera: right, and with depth 2 % off."""

    camera: str
    focal: float
    focal_sd: float
    middle_px: float
    lens_px: float
    depth: float
    depth_sd: float
    card: CardReading
    told: tuple[bool, bool]


def run_one(simulated: SimulatedCamera, seed: int) -> CameraRun:
    """Calibrate a camera never seen before and check it with the card."""
    studio = Studio(simulated.lens, seed, simulated.depth_share)
    texture = texture_of(create_board_sheet(CHESSBOARD, "a4"))
    unknown = replace(DEFAULT_CAMERA, sensor=simulated.lens.sensor)
    gathering = ViewCollector(unknown)
    made = _calibrated(gathering, studio, texture, seed)
    found, lens, depth = made.intrinsics.camera, simulated.lens, made.depth
    assert depth is not None
    stored = StoredCalibration("simulated", "", depth.scale, depth.offset_m)
    rng = np.random.default_rng([seed, 1])
    scene = card_scene(float(rng.uniform(0.55, 0.65)), float(rng.uniform(0.0, 8.0)), float(rng.uniform(-20.0, 20.0)))
    seen = [studio.frame(scene, 100 + k, CARD_EVERY_S * k) for k in range(CARD_FRAMES)]
    reading, *off = (
        measure_card(_corrected(seen, stored, 1.0 + share), found, simulated.name)
        for share in (0.0, OFF_SHARE, -OFF_SHARE)
    )
    return CameraRun(
        simulated.name,
        max(abs(found.fx_px / lens.fx_px - 1.0), abs(found.fy_px / lens.fy_px - 1.0)),
        made.intrinsics.focal_sd_px / lens.fx_px,
        max(abs(found.cx_px - lens.cx_px), abs(found.cy_px - lens.cy_px)),
        _lens_px(found, lens),
        abs(depth.scale / depth_scale(studio.spec) - 1.0) if depth.offset_m == 0.0 else _at_a_hand(depth, studio),
        depth.scale_sd, reading, (not off[0].has_valid_lengths, not off[1].has_valid_lengths),
    )  # fmt: skip


def _calibrated(gathering: ViewCollector, studio: Studio, texture: FloatArray, seed: int) -> CameraCalibration:
    """As a person does it: as many pictures as are asked for, and more while the program says that it needs them."""
    shown = poses(texture, MOST_POSES, _DISTANCES_M, seed)
    for k, placed in enumerate(shown, 1):
        gathering.add(studio.frame([placed], k, float(k)))
        if len(gathering.views) >= WANTED_VIEWS or k == len(shown):
            try:
                return calibrate_camera(gathering.views, replace(DEFAULT_CAMERA, sensor=studio.camera.sensor), "camera")
            except BoardViewsTooSimilar:
                if k == len(shown):
                    raise
    raise BoardViewsTooSimilar("camera", "too few pictures were kept")


def _at_a_hand(depth: object, studio: Studio) -> float:
    """Where a shift goes with the scale, what both make of a hand's distance is compared, 0.65 m."""
    scale, offset_m = depth.scale, depth.offset_m  # type: ignore[attr-defined]
    return abs((scale * 0.65 + offset_m) / (depth_scale(studio.spec) * 0.65) - 1.0)


def _corrected(frames: Sequence[Frame], stored: StoredCalibration, share: float) -> Iterator[Frame]:
    """Depth put right by the calibration, of a camera whose depth has gone off by a share since."""
    for frame in frames:
        assert frame.depth_raw is not None
        table: NDArray[np.uint16] = compute_correction_table(stored, frame.depth_unit_m)
        yield replace(frame, depth_raw=table[frame.depth_raw], depth_unit_m=_FINE_M * share)


def _lens_px(found: Camera, lens: Camera) -> float:
    """Furthest that a ray of the picture's inner nine tenths lands beside the true one, the camera's turn aside."""
    u, v = np.meshgrid(np.linspace(32, 608, 11), np.linspace(24, 456, 9))
    pixel = np.stack((u.ravel(), v.ravel()), axis=-1)
    rays = [one.backproject(one.undistort(pixel), np.ones(len(pixel))) for one in (found, lens)]
    turned = rays[0] @ np.linalg.lstsq(rays[0], rays[1], rcond=None)[0]
    return float(np.linalg.norm(turned[:, :2] / turned[:, 2:] - rays[1][:, :2], axis=1).max() * lens.fx_px)


def report(only: str, seeds: int) -> str:
    """Run every camera with fresh seeds, and tell."""
    runs = [
        run_one(one, SEED + 100 * number + k)
        for number, one in enumerate(CAMERAS)
        if only.lower() in one.name.lower()
        for k in range(seeds)
    ]
    return "\n".join([ruled(_table(runs)), "", *_verdicts(runs)]) if runs else ""


HEAD = (
    "simulated camera", "calibrations", "focal length off, %", "middle off, px", "rays off, px", "depth scale off, %",
    "card, right: ° / mm off", "card, all lengths off, %", "2 % off told",
)  # fmt: skip


def _table(runs: Sequence[CameraRun]) -> list[tuple[str, ...]]:
    rows = [HEAD]
    for name in [*dict.fromkeys(run.camera for run in runs), "all"]:
        some = [run for run in runs if name in (run.camera, "all")]
        angle = max(run.card.angle_error_deg for run in some)
        length = max(run.card.length_error_mm for run in some)
        rows.append((
            name, str(len(some)),
            most_of([100 * run.focal for run in some], 2), most_of([run.middle_px for run in some], 1),
            most_of([run.lens_px for run in some], 2), most_of([100 * run.depth for run in some], 2),
            f"{angle:.1f} / {length:.1f}",
            f"{max(100 * abs(run.card.scale - 1.0) for run in some):.2f}",
            f"{sum(map(sum, (run.told for run in some)))} of {2 * len(some)}",
        ))  # fmt: skip
    return rows


def most_of(values: Sequence[float], digits: int) -> str:
    """Root mean square and worst."""
    square = float(np.sqrt(np.mean(np.square(values))))
    return f"{square:.{digits}f}, worst {max(values):.{digits}f}"


def _verdicts(runs: Sequence[CameraRun]) -> list[str]:
    count = len(runs)
    focal = sum(run.focal <= FOCAL_SHARE for run in runs)
    depth = sum(run.depth <= DEPTH_SHARE for run in runs)
    told = sum(map(sum, (run.told for run in runs)))
    right = sum(run.card.has_valid_angles and run.card.has_valid_lengths for run in runs)
    sure = sum(run.focal <= 2.0 * run.focal_sd for run in runs)
    sure_depth = sum(run.depth <= 2.0 * run.depth_sd for run in runs)
    return [
        f"focal length within {100 * FOCAL_SHARE:.1f} %: {focal} of {count} (promised: all)",
        f"depth scale within {100 * DEPTH_SHARE:.1f} %: {depth} of {count} (promised: all)",
        f"card tells depth {100 * OFF_SHARE:.0f} % off: {told} of {2 * count} (promised: all)",
        f"card calls a right camera right: {right} of {count}",
        f"within 2 stated sd: focal length {sure} of {count}, depth scale {sure_depth} of {count}",
    ]
