"""Whether the simulated discs lie on the skin: on its shape, and on what is drawn of it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import cv2
import numpy as np
import pytest

from carpus.core.model.hand.protocols import HAND21
from carpus.core.model.types import FloatArray
from carpus.core.simulation.recording import SimulatedRecording
from carpus.core.simulation.scene import Scene
from carpus.core.simulation.skin import skin_distance


def gaps_m(scene: Scene, time_s: FloatArray, rows: Sequence[int]) -> FloatArray:
    """Distance (N, R) of discs from the skin at some times."""
    pose = scene.pose(time_s)
    discs = scene.to_camera(scene.markers_w0_m(pose))
    return np.array([skin_distance(discs[i, list(rows)], scene.cones_cam(pose, i)) for i in range(len(time_s))])


def discs_found_on_the_surface(pictures: SimulatedRecording, frames: Iterable[int], least_facing: float) -> int:
    """How many discs, seen and facing the camera by so much, have the depth of the surface drawn under them; all do."""
    truth, checked = pictures.truth, 0
    rows = [HAND21.markers.index(name) for name in truth.spec.marker_protocol.markers]
    for frame in frames:
        clean = pictures.render_clean(frame)
        normals = pictures.scene.marker_normals_w0(pictures.scene.pose(truth.time_s[frame : frame + 1]))[0, rows]
        discs = truth.marker_position_cam_m[frame]
        facing = -np.sum(normals @ truth.rotation_w0_cam.T * discs, axis=1) / np.linalg.norm(discs, axis=1)
        for m in np.flatnonzero((clean.visible_share > 0.8) & (facing > least_facing)):
            place = tuple(truth.marker_px[frame, m].tolist())
            seen_m = float(cv2.getRectSubPix(clean.depth_m, (1, 1), place)[0, 0])
            assert seen_m == pytest.approx(discs[m, 2], abs=5e-4), (frame, m)
            checked += 1
    return checked
