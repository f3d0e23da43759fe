"""A simulated camera before which a printed board is shown, or a check card lies."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np

from carpus.core.calibration.camera.printed_sheet import PrintedSheet, SheetBox, SheetDisc
from carpus.core.calibration.card.card import (
    CARD_CORNER_MM,
    FOOT_CORNER_MM,
    SLOPE_DEG,
    SLOPE_MM,
    WEDGE_CORNER_MM,
    WIDTH_MM,
    card_sheet,
    wedge_sheet,
)
from carpus.core.model.camera import Camera
from carpus.core.model.types import FloatArray, Frame
from carpus.core.simulation.appearance import sample_appearance, to_linear
from carpus.core.simulation.scene import Scene
from carpus.core.simulation.sensor import ColorSensor, create_depth_sensor
from carpus.core.simulation.spec import RecordingSpec
from carpus.core.simulation.sphere_tracing import FloatImage

PX_PER_MM = 8
FINER = 2
BEHIND_M = 1.2
LENS = Camera(531.7, 532.9, 316.4, 244.1, distortion=(0.11, -0.24, 0.0011, -0.0008, 0.0), origin="file")
"""A lens as a colour camera of this kind has."""


@dataclass(frozen=True, slots=True)
class Placed:
    """A sheet's texture in linear light (rows, columns, 3) and where it is: ``rotation`` (3, 3) and ``shift_m`` (3,)
    take points of the sheet, in metres from its upper left corner, to the camera."""

    texture: FloatArray
    rotation: FloatArray
    shift_m: FloatArray


def render_texture(sheet: PrintedSheet) -> FloatArray:
    """White paper with the sheet's boxes and discs, in linear light."""
    size = (round(sheet.height_mm * PX_PER_MM), round(sheet.width_mm * PX_PER_MM))
    out = np.full((*size, 3), 0.86, dtype=np.float32)
    for mark in sheet.items:
        if isinstance(mark, SheetBox):
            left, top = round(mark.left_mm * PX_PER_MM), round(mark.top_mm * PX_PER_MM)
            right = round((mark.left_mm + mark.width_mm) * PX_PER_MM)
            bottom = round((mark.top_mm + mark.height_mm) * PX_PER_MM)
            out[top:bottom, left:right] = _light(mark.color)
        elif isinstance(mark, SheetDisc):
            v, u = np.indices(size, dtype=np.float32)
            off = np.hypot((u + 0.5) / PX_PER_MM - mark.x_mm, (v + 0.5) / PX_PER_MM - mark.y_mm)
            out[off <= mark.radius_mm] = _light(mark.color)
    return np.asarray(cv2.blur(out, (3, 3)))


def _light(color: str) -> FloatArray:
    srgb = np.array([int(color[k : k + 2], 16) for k in (1, 3, 5)], dtype=np.float64)
    return np.maximum(to_linear(srgb), 0.03).astype(np.float32)


class Studio:
    """A camera that looks at sheets; the noise is the simulator's, that of depth of the kind of the camera's sensor."""

    def __init__(self, camera: Camera = LENS, seed: int = 3, depth_scale_error: float = 0.01) -> None:
        self.camera = camera
        self.spec = RecordingSpec(seed=seed, depth_scale_error=depth_scale_error, light="normal")
        self._color = ColorSensor(self.spec, sample_appearance(Scene(self.spec)))
        self._depth = create_depth_sensor(self.spec, camera)
        self._rays = {step: _rays(camera, step) for step in (1, FINER)}
        self._drawn: tuple[Sequence[Placed], FloatImage, FloatImage] | None = None

    def frame(self, sheets: Sequence[Placed], index: int, time_s: float) -> Frame:
        """What the camera makes of the sheets, the nearest in front."""
        if self._drawn is None or self._drawn[0] is not sheets:  # what lies still is drawn once
            light, _ = self._seen(sheets, FINER)
            height, width = self.camera.height_px, self.camera.width_px
            light = light.reshape(height, FINER, width, FINER, 3).mean(axis=(1, 3))
            _, depth_m = self._seen(sheets, 1)
            self._drawn = (sheets, light.astype(np.float32), depth_m.astype(np.float32))
        _, light, depth_m = self._drawn
        rgb = self._color.expose(light, index)
        return Frame(index, time_s, rgb, self._depth.measure(depth_m, index, light), 1.0 / 5000.0)

    def _seen(self, sheets: Sequence[Placed], step: int) -> tuple[FloatImage, FloatImage]:
        rays = self._rays[step]
        light = np.full(rays.shape, 0.12, dtype=np.float32)
        depth_m = np.full(rays.shape[:2], BEHIND_M, dtype=np.float32)
        for sheet in sheets:
            box = self._box(sheet, step)
            part, depth, drawn = rays[box], depth_m[box], light[box]
            normal = sheet.rotation[:, 2].astype(np.float32)
            away = np.float32(normal @ sheet.shift_m) / (part @ normal)
            points = part * away[..., None] - sheet.shift_m.astype(np.float32)
            x, y = points @ sheet.rotation[:, 0].astype(np.float32), points @ sheet.rotation[:, 1].astype(np.float32)
            rows, columns = sheet.texture.shape[:2]
            u, v = x * (1e3 * PX_PER_MM) - 0.5, y * (1e3 * PX_PER_MM) - 0.5
            inside = (u > 0) & (v > 0) & (u < columns - 1) & (v < rows - 1) & (away > 0) & (away < depth)
            if step > 1:
                drawn[inside] = cv2.remap(sheet.texture, u, v, cv2.INTER_LINEAR)[inside]
            depth[inside] = away[inside]
        return light, depth_m

    def _box(self, sheet: Placed, step: int) -> tuple[slice, slice]:
        """Rows and columns that hold the sheet, with a border."""
        rows, columns = sheet.texture.shape[:2]
        flat = np.array([[0, 0, 0], [columns, 0, 0], [0, rows, 0], [columns, rows, 0]]) / (1e3 * PX_PER_MM)
        pixel = self.camera.distort(self.camera.project(flat @ sheet.rotation.T + sheet.shift_m)) * step
        low, high = np.floor(pixel.min(axis=0)) - 12, np.ceil(pixel.max(axis=0)) + 12
        low, high = np.maximum(low, 0).astype(int), np.maximum(high, 0).astype(int)
        return slice(low[1], high[1]), slice(low[0], high[0])


def _rays(camera: Camera, step: int) -> FloatArray:
    u = (np.arange(camera.width_px * step) + 0.5) / step - 0.5
    v = (np.arange(camera.height_px * step) + 0.5) / step - 0.5
    pixel = np.stack(np.meshgrid(u, v), axis=-1).reshape(-1, 2)
    ideal = camera.undistort(pixel)
    rays = camera.backproject(ideal, np.ones(len(ideal)))
    return rays.reshape(len(v), len(u), 3).astype(np.float32)


def build_held_sheet(
    texture: FloatArray, centre_m: Sequence[float], tilt_deg: float, towards_deg: float, turn_deg: float
) -> Placed:
    """A sheet with its middle at a place of the camera, tilted by an angle about an axis in the picture, and turned."""
    axis = np.array([math.cos(math.radians(towards_deg)), math.sin(math.radians(towards_deg)), 0.0])
    tilt = np.asarray(cv2.Rodrigues(axis * math.radians(tilt_deg))[0])
    turn = np.asarray(cv2.Rodrigues(np.array([0.0, 0.0, math.radians(turn_deg)]))[0])
    rotation = np.asarray(tilt @ turn, dtype=np.float64)
    rows, columns = texture.shape[:2]
    middle = np.array([columns, rows, 0.0]) / (2e3 * PX_PER_MM)
    return Placed(texture, rotation, np.asarray(centre_m, dtype=np.float64) - rotation @ middle)


def poses(
    texture: FloatArray, count: int = 20, distances_m: Sequence[float] = (0.5, 0.62, 0.8), seed: int = 5
) -> list[Placed]:
    """As a person shows a board who does what the program asks: everywhere, four tilts, near and far."""
    out = []
    rng = np.random.default_rng(seed)
    places = ((-0.5, -0.4), (0.5, -0.4), (-0.5, 0.4), (0.5, 0.4), (0.0, 0.0), (0.0, -0.5), (0.0, 0.5), (0.6, 0.0),
              (-0.6, 0.0), (0.2, 0.1))  # fmt: skip
    for k in range(count):
        z = distances_m[k % len(distances_m)] + float(rng.uniform(-0.03, 0.03))
        right, down = places[k % len(places)]
        reach_x, reach_y = z * 0.6 - 0.12, z * 0.45 - 0.09
        tilt = 0.0 if k % 6 == 5 else float(rng.uniform(26.0, 44.0))
        centre = (right * max(reach_x, 0.0) * 1.6, down * max(reach_y, 0.0) * 1.6, z)
        out.append(
            build_held_sheet(
                texture, centre, tilt, 90.0 * (k % 4) + float(rng.uniform(-15, 15)), float(rng.uniform(-8, 8))
            )
        )
    return out


# The check card with its wedge before the simulator's camera.
def card_scene(distance_m: float = 0.6, tilt_deg: float = 4.0, turn_deg: float = 7.0) -> list[Placed]:
    """The flat sheet and both faces of the wedge, nearly straight under the camera."""
    card, wedge = render_texture(card_sheet("a4")), render_texture(wedge_sheet("a4"))
    tilt = np.asarray(cv2.Rodrigues(np.array([math.radians(tilt_deg), 0.0, 0.0]))[0])
    turn = np.asarray(cv2.Rodrigues(np.array([0.0, 0.0, math.radians(turn_deg)]))[0])
    # The sheet's x to the right, y down, z into the table: as the camera looks.
    rotation = np.asarray(tilt @ turn, dtype=np.float64)
    a_m = np.array([*CARD_CORNER_MM, 0.0]) / 1e3
    middle_m = a_m + np.array([0.04, 0.07, 0.0])
    shift = np.array([0.01, -0.005, distance_m]) - rotation @ middle_m
    low_edge_m = a_m + np.array([*FOOT_CORNER_MM, 0.0]) / 1e3
    left, top = (round(one * PX_PER_MM) for one in WEDGE_CORNER_MM)
    width, slope = (round(one * PX_PER_MM) for one in (WIDTH_MM, SLOPE_MM))
    faces = [
        (wedge[top : top + slope, left : left + width], SLOPE_DEG, low_edge_m),
        (wedge[top + slope : top + 2 * slope, left : left + width], -SLOPE_DEG, _ridge_m(low_edge_m)),
    ]
    out = [Placed(card, rotation, shift)]
    for texture, rise_deg, corner_m in faces:
        # Up, out of the sheet, is -z here: a face that rises along y turns about x by a negative angle.
        face = np.asarray(cv2.Rodrigues(np.array([-math.radians(rise_deg), 0.0, 0.0]))[0])
        turned = np.asarray(rotation @ face, dtype=np.float64)
        out.append(Placed(np.ascontiguousarray(texture), turned, rotation @ corner_m + shift))
    return out


def _ridge_m(low_edge_m: FloatArray) -> FloatArray:
    slope = math.radians(SLOPE_DEG)
    return low_edge_m + np.array([0.0, SLOPE_MM * math.cos(slope), -SLOPE_MM * math.sin(slope)]) / 1e3
