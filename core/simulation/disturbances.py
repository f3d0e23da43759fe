"""Disturbances of a recording: false blobs, covered markers, a passing rod, dropped frames."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from carpus.core.model.hand.protocols import PALM_MARKERS
from carpus.core.model.types import FloatArray
from carpus.core.simulation.hand_motion import STILL_S
from carpus.core.simulation.patient import MARKER_RADIUS_M
from carpus.core.simulation.scene import Scene
from carpus.core.simulation.spec import RandomStream, RecordingSpec

BLOB_MEAN_S = 0.8
_BLOB_GAP_TO_DISC_M = 0.015
_PEN_AWAY_M, _PEN_RADIUS_M = (0.009, 0.016), (0.0008, 0.002)

BlobPlace = Literal["table", "air", "skin"]


@dataclass(frozen=True, slots=True)
class FalseBlob:
    """Blue spot that is no marker, from ``start_s`` to ``end_s``.

    Centre and unit normal (3,) are in W0 for ``table`` and ``air``, in W2 for ``skin``. ``hue_shift`` (3,) multiplies
    the colour of the paper.
    """

    place: BlobPlace
    start_s: float
    end_s: float
    center_m: FloatArray
    normal: FloatArray
    radius_m: float
    hue_shift: FloatArray


@dataclass(frozen=True, slots=True)
class PassingRod:
    """Rod that crosses above the hand: both ends (2, 3) in W0 at the start and end of the crossing."""

    start_s: float
    end_s: float
    from_m: FloatArray
    to_m: FloatArray
    radius_m: float

    def end_points_w0_m(self, time_s: float) -> FloatArray | None:
        """Return both ends (2, 3) at a time, None if the rod is absent."""
        if not self.start_s <= time_s <= self.end_s:
            return None
        share = (time_s - self.start_s) / (self.end_s - self.start_s)
        return np.asarray(self.from_m + share * (self.to_m - self.from_m))


@dataclass(frozen=True, slots=True)
class FrameTimes:
    """Frames that were kept: times (N,) after the first frame, and frames dropped before each."""

    color_s: FloatArray
    depth_s: FloatArray
    dropped_before: NDArray[np.int64]


def sample_frame_times(spec: RecordingSpec) -> FrameTimes:
    """Draw the frame times, with a millisecond of jitter; the first frame is always kept."""
    rng = spec.generator(RandomStream.TIMES)
    count = max(1, round(spec.seconds * spec.fps))
    jitter_s = np.clip(rng.normal(0.0, 0.001, (2, count)), -0.003, 0.003)
    nominal_s = np.arange(count) / spec.fps
    color_s = np.round(nominal_s + jitter_s[0] - jitter_s[0, 0], 6)
    depth_s = np.round(color_s + spec.depth_delay_s + 0.5 * jitter_s[1], 6)
    kept = spec.generator(RandomStream.TROUBLE).random(count) >= spec.dropped_share
    kept[0] = True
    index = np.flatnonzero(kept)
    dropped_before = np.diff(index, prepend=index[0] - 1) - 1
    return FrameTimes(color_s[kept], depth_s[kept], dropped_before)


def sample_covered_markers(spec: RecordingSpec, time_s: FloatArray) -> NDArray[np.bool_]:
    """Draw the covered markers (N, 21) at times (N,); none during the still start."""
    covered = np.zeros((len(time_s), 21), dtype=bool)
    if spec.hidden_share <= 0.0:
        return covered
    rng = np.random.default_rng([spec.seed, RandomStream.TROUBLE, 1])
    open_mean_s = spec.hidden_mean_s * (1.0 / spec.hidden_share - 1.0)
    for marker in range(21):
        now_s, is_covered = STILL_S, bool(rng.random() < spec.hidden_share)
        while now_s < spec.seconds + 1.0:
            lasts_s = rng.exponential(spec.hidden_mean_s if is_covered else open_mean_s)
            if is_covered:
                covered[(time_s >= now_s) & (time_s < now_s + lasts_s), marker] = True
            now_s += lasts_s
            is_covered = not is_covered
    return covered


def sample_false_blobs(scene: Scene) -> tuple[FalseBlob, ...]:
    """Draw the false blobs of a recording, on average ``spec.false_blobs`` at a time."""
    spec = scene.spec
    rng = np.random.default_rng([spec.seed, RandomStream.TROUBLE, 2])
    slots = int(spec.false_blobs) + (1 if rng.random() < spec.false_blobs % 1.0 else 0)
    blobs = []
    for _ in range(slots):
        now_s = -rng.exponential(BLOB_MEAN_S)
        while now_s < spec.seconds:
            end_s = now_s + 0.1 + rng.exponential(BLOB_MEAN_S)
            blobs.append(_sample_blob(scene, rng, now_s, end_s))
            now_s = end_s
    return (*(blob for blob in blobs if blob.end_s > 0.0), *_sample_pen_marks(scene))


def _sample_pen_marks(scene: Scene) -> Iterator[FalseBlob]:
    """Draw dots of a blue pen beside the markers, there all the time."""
    spec = scene.spec
    rng = spec.generator(RandomStream.WORN)
    markers = scene.patient.anatomy.palm_disc_m * [1.0, -1.0 if spec.hand == "left" else 1.0, 1.0]
    for _ in range(spec.pen_marks):
        disc = markers[int(rng.integers(len(markers)))]
        away_m, way = rng.uniform(*_PEN_AWAY_M), rng.uniform(0.0, 2.0 * math.pi)
        place = disc + away_m * np.array([math.cos(way), math.sin(way), 0.0])
        place[2] = scene.skin.palm_height_m(place[:2])
        radius_m, hue = rng.uniform(*_PEN_RADIUS_M), rng.uniform(0.5, 1.1, 3)
        yield FalseBlob("skin", -1.0, math.inf, place, np.array([0.0, 0.0, 1.0]), radius_m, hue)


def _sample_blob(scene: Scene, rng: np.random.Generator, start_s: float, end_s: float) -> FalseBlob:
    places: tuple[BlobPlace, ...] = ("table", "table", "air", "skin")
    place = places[int(rng.integers(4))]
    radius_m = MARKER_RADIUS_M * rng.uniform(0.7, 1.3)
    hue = rng.uniform(0.8, 1.25, 3)
    if place == "skin":
        found = _sample_palm_point(scene, rng)
        if found is not None:
            return FalseBlob(place, start_s, end_s, found, np.array([0.0, 0.0, 1.0]), radius_m, hue)
        place = "table"
    pixel = np.array([rng.uniform(30.0, 610.0), rng.uniform(30.0, 450.0)])
    ray = scene.rotation_w0_cam.T @ scene.camera.backproject(pixel, np.array(1.0))
    eye = -scene.rotation_w0_cam.T @ scene.translation_w0_cam_m
    height_m = scene.table_height_m + 0.0004
    normal = np.array([0.0, 0.0, 1.0])
    if place == "air":
        height_m = rng.uniform(scene.table_height_m + 0.02, 0.06)
        tilt, heading = rng.uniform(0.0, math.radians(40.0)), rng.uniform(0.0, 2.0 * math.pi)
        normal = np.array([math.sin(tilt) * math.cos(heading), math.sin(tilt) * math.sin(heading), math.cos(tilt)])
    center = eye + ray * (height_m - eye[2]) / ray[2]
    return FalseBlob(place, start_s, end_s, center, normal, radius_m, hue)


def _sample_palm_point(scene: Scene, rng: np.random.Generator) -> FloatArray | None:
    """Draw a point of the back of the palm in W2, clear of the markers; None if none is found."""
    markers = scene.patient.anatomy.palm_disc_m.copy()
    if scene.spec.hand == "left":
        markers[:, 1] *= -1.0
    for _ in range(20):
        share = rng.dirichlet(np.ones(len(PALM_MARKERS)))
        point = share @ markers
        point[2] = scene.skin.palm_height_m(point[:2])
        if np.linalg.norm(markers - point, axis=1).min() > _BLOB_GAP_TO_DISC_M:
            return np.asarray(point)
    return None


def sample_passing_rod(scene: Scene) -> PassingRod | None:
    """Draw the rod of ``spec.object_passes``, 5 to 9 cm above the hand for about a second."""
    spec = scene.spec
    if not spec.object_passes:
        return None
    rng = np.random.default_rng([spec.seed, RandomStream.TROUBLE, 3])
    lasts_s = rng.uniform(0.9, 1.5)
    start_s = rng.uniform(max(STILL_S + 0.4, 0.3 * spec.seconds), max(STILL_S + 0.5, 0.7 * spec.seconds - lasts_s))
    height_m, heading = rng.uniform(0.05, 0.09), rng.uniform(-0.6, 0.6)
    along = np.array([math.cos(heading), math.sin(heading), 0.0])
    across = np.array([-along[1], along[0], 0.0])
    middle = np.array([0.4 * scene.patient.anatomy.hand_length_m, 0.0, height_m])
    rod = np.array([-0.6 * along, 0.35 * along])
    return PassingRod(
        start_s,
        start_s + lasts_s,
        middle - 0.28 * across + rod,
        middle + 0.28 * across + rod,
        rng.uniform(0.018, 0.035),
    )
