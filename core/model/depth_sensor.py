"""What is known of a depth sensor: how it measures, how sure one reading is, where it cannot be trusted.

One value per sensor goes with the camera (:attr:`core.model.camera.Camera.sensor`) from the source to the detector, the
calibration, the tracker and the session file, so that a new sensor is one more value here.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields, replace
from typing import Any, Literal, TypeGuard, get_args

import numpy as np

from carpus.core.model.types import FloatArray

Kind = Literal["structured light", "active stereo", "time of flight"]
Edge = Literal["torn", "fattened", "flying"]
Registration = Literal["camera", "library", "none"]

ASSUMED = "assumed"
"""Origin of a sensor that no source stated."""
_MAX_TEXT = 80
_MAX_EDGE_PX = 40
CORE_SHARE = 0.4
"""Of a disc's area: what the detector takes its depth from."""


@dataclass(frozen=True, slots=True)
class NoiseModel:
    """Standard deviation ``fixed_m`` + ``square_per_m`` z^2 at a depth of z metres."""

    fixed_m: float = 0.0
    square_per_m: float = 0.0

    def sd_m(self, depth_m: FloatArray) -> FloatArray:
        """Standard deviation (...) at depths (...), metres."""
        out = self.square_per_m * depth_m**2
        return np.asarray(out + self.fixed_m if self.fixed_m else out)

    def scale(self, factor: float) -> NoiseModel:
        return NoiseModel(self.fixed_m * factor, self.square_per_m * factor)


@dataclass(frozen=True, slots=True)
class DepthSensor:
    """How depth came to be.

    ``reading``: noise of one reading. ``stays``: error that stays as long as the surface stays, of it or beside it: no
    averaging over time removes it. ``patch_px``: readings within a square so wide are as one; those of several such
    squares average where ``averages``. ``edge``: what becomes of readings about an edge (``torn`` in flecks,
    ``fattened`` by the matching window, ``flying`` between both surfaces), ``edge_px`` how far about it.
    There are no readings below ``nearest_m`` and above ``farthest_m``. ``registration``: who lays depth on colour. Of a
    pair of eyes ``baseline_m`` and ``focal_px`` of the depth picture, 0 for time of flight. ``stays_px``: over how much
    of the picture what stays is alike, 0 where no further than the patch. ``origin``: ``stated`` by the source, or
    ``assumed``.
    """

    name: str
    kind: Kind
    reading: NoiseModel
    stays: NoiseModel
    patch_px: float
    averages: bool
    edge: Edge
    edge_px: int
    nearest_m: float
    farthest_m: float
    registration: Registration
    baseline_m: float = 0.0
    focal_px: float = 0.0
    stays_px: float = 0.0
    origin: str = "stated"

    def reading_sd_m(self, depth_m: FloatArray) -> FloatArray:
        """Standard deviation (...) of one reading at depths (...)."""
        return self.reading.sd_m(depth_m)

    def mean_sd_m(self, depth_m: FloatArray, pixels: FloatArray) -> FloatArray:
        """Standard deviation (...) of the mean of so many neighbouring readings (...) at depths (...)."""
        sd = self.reading.sd_m(depth_m)
        if not self.averages:
            return sd
        return np.asarray(sd / np.sqrt(np.maximum(pixels / self.patch_px**2, 1.0)))

    def disc_sd_m(self, depth_m: FloatArray, area_px: FloatArray) -> FloatArray:
        """Standard deviation (...) of a disc's depth, read over the middle of its area (...)."""
        return self.mean_sd_m(depth_m, CORE_SHARE * area_px)

    def bias_sd_m(self, depth_m: FloatArray) -> FloatArray:
        """Standard deviation (...) of the part that stays."""
        return self.stays.sd_m(depth_m)

    def flat_bias_sd_m(self, depth_m: FloatArray) -> FloatArray:
        """The same over a flat surface, from which a wide matching window takes nothing off."""
        flat = NoiseModel(0.0, self.stays.square_per_m) if self.kind == "active stereo" else self.stays
        return flat.sd_m(depth_m)

    def disc_bias_sd_m(self, depth_m: FloatArray, area_px: FloatArray) -> FloatArray:
        """What stays of a flat disc's depth (...): its middle holds more than one place of a window's error, which is
        alike over the window's width and gone beyond it."""
        wide = np.sqrt(CORE_SHARE * area_px) / self.patch_px
        kept = np.where(
            wide <= 1.0, 1.0 - wide / 3.0, (1.0 - 1.0 / (3.0 * np.maximum(wide, 1.0))) / np.maximum(wide, 1.0)
        )
        return np.asarray(self.flat_bias_sd_m(depth_m) * kept)

    def with_focal(self, focal_px: float, color_focal_px: float = math.nan) -> DepthSensor:
        """The same pair of eyes with depth pictures of another focal length: its disparity is as sure as before, and
        its window as many of its own pixels wide; ``color_focal_px`` of the colour picture that depth is laid on says
        how many of colour's that are. Other kinds stay as they are."""
        if self.kind != "active stereo":
            return self
        made = _build_stereo_sensor(self.name, self.baseline_m, focal_px, self.nearest_m, self.farthest_m)
        larger = color_focal_px / _COLOR_FOCAL_PX if color_focal_px > 0.0 else 1.0
        return replace(made, origin=self.origin, patch_px=max(made.patch_px * larger, 1.0))

    def to_dict(self) -> dict[str, Any]:
        """All of it in plain values, as files carry it."""
        return asdict(self)


def parse_sensor(value: object) -> DepthSensor:
    """The sensor that a file tells by the name of a known one or as :meth:`DepthSensor.to_dict` wrote it.

    Raises ValueError with what is wrong. Keys that are not known are passed over: a newer file may say more.
    """
    if isinstance(value, str):
        known = next((sensor for sensor in SENSORS.values() if sensor.name == value), SENSORS.get(value))
        if known is None:
            raise ValueError(f"no sensor that Carpus knows: {value[:_MAX_TEXT]!r} (known: {', '.join(SENSORS)})")
        return known
    if not isinstance(value, Mapping):
        raise ValueError("neither a sensor's name nor its figures")
    values: dict[str, Any] = {}
    for field in fields(DepthSensor):
        if field.name in value:
            values[field.name] = value[field.name]
    try:
        values |= {
            law: NoiseModel(*(float(value[law][f.name]) for f in fields(NoiseModel))) for law in ("reading", "stays")
        }
        out = DepthSensor(**values)
    except (KeyError, TypeError, ValueError, OverflowError) as cause:
        raise ValueError("its figures are not all there") from cause
    return _validate(out)


def _validate(sensor: DepthSensor) -> DepthSensor:
    laws = (sensor.reading, sensor.stays)
    numbers = (
        sensor.patch_px,
        sensor.stays_px,
        sensor.edge_px,
        sensor.nearest_m,
        sensor.farthest_m,
        sensor.baseline_m,
        sensor.focal_px,
    )
    flags = ((sensor.averages, bool), (sensor.edge_px, int))
    told: tuple[tuple[object, type], ...] = ((sensor.name, str), (sensor.origin, str), *flags)
    ok = all(isinstance(value, kind) for value, kind in told)
    ok = ok and 0 < len(sensor.name) <= _MAX_TEXT and len(sensor.origin) <= _MAX_TEXT
    ok = ok and sensor.kind in get_args(Kind) and sensor.edge in get_args(Edge)
    ok = ok and sensor.registration in get_args(Registration)
    ok = ok and all(_is_non_negative(number) for number in numbers)
    ok = ok and all(0.0 <= law.fixed_m < 1.0 and 0.0 <= law.square_per_m < 1.0 for law in laws)
    ok = ok and max(sensor.reading.fixed_m, sensor.reading.square_per_m) > 0.0
    if not ok or sensor.edge_px > _MAX_EDGE_PX or sensor.patch_px < 1.0 or sensor.farthest_m <= sensor.nearest_m:
        raise ValueError("its figures are no sensor's")
    return sensor


def _is_non_negative(value: object) -> TypeGuard[float]:
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value) and value >= 0.0


def _build_stereo_sensor(
    name: str, baseline_m: float, focal_px: float, nearest_m: float, farthest_m: float
) -> DepthSensor:
    """A RealSense of the D400 family: sd = z^2 subpixel / (focal length x baseline), with a disparity to 0.08 pixel.

    Grunnet-Jepsen, Sweetser and Woodfill, "Tuning depth cameras for best performance" (maker's paper, rev. 2.0): the
    formula and its 0.08 pixel for a textured surface, over a plane: it holds what stays (the projector's spots as they
    lie on the surface, the larger part) and what changes from picture to picture.
    """
    law = NoiseModel(square_per_m=_SUBPIXEL_PX / (focal_px * baseline_m))
    patch_px = _WINDOW_PX * _COLOR_FOCAL_PX / focal_px
    relief_m = _RELIEF_M * (patch_px / _RELIEF_PATCH_PX) ** 2
    stays = NoiseModel(relief_m, _SUBPIXEL_STAYS_PX / (focal_px * baseline_m))
    return DepthSensor(
        name, "active stereo", law, stays, max(patch_px, 1.0), True, "fattened", 6, nearest_m, farthest_m, "library",
        baseline_m=baseline_m, focal_px=focal_px,
    )  # fmt: skip


_SUBPIXEL_PX, _SUBPIXEL_STAYS_PX = 0.08, 0.06
_WINDOW_PX, _COLOR_FOCAL_PX = 9.0, 525.0
"""Width of the matching window in the depth picture; focal length of the colour picture that depth is laid on, where
nobody says it."""
_RELIEF_M, _RELIEF_PATCH_PX = 0.0005, 11.0
"""What a window so wide takes off the height of knuckles, besides: it grows with the square of its width."""

PRIMESENSE = DepthSensor(
    "PrimeSense",
    "structured light",
    NoiseModel(square_per_m=1.425e-3),
    NoiseModel(square_per_m=0.5e-3),
    9.0,
    False,
    "torn",
    6,
    0.4,
    3.5,
    "camera",
    baseline_m=0.075,
    focal_px=575.0,
)
"""Asus Xtion, Kinect for Xbox 360: half a step of 1/8 pixel in disparity (Khoshelham and Elberink 2012,
clinical reference 7.2). Neighbours share the step that they are rounded to: they do not average."""

D415 = _build_stereo_sensor("RealSense D415", 0.055, 1004.0, 0.45, 6.0)
"""65 degrees across 1280 pixels."""
D435 = _build_stereo_sensor("RealSense D435", 0.050, 424.0, 0.20, 6.0)
"""90 degrees across 848 pixels; the D435i, D435f are the same pair of eyes."""
D455 = _build_stereo_sensor("RealSense D455", 0.095, 424.0, 0.40, 6.0)
"""90 degrees across 848 pixels; the D456, D457 are the same pair of eyes."""

AZURE_KINECT = DepthSensor(
    "Azure Kinect",
    "time of flight",
    NoiseModel(fixed_m=0.5e-3, square_per_m=0.5e-3),
    NoiseModel(fixed_m=0.9e-3, square_per_m=0.1e-3),
    2.0,
    True,
    "flying",
    2,
    0.30,
    3.8,
    "library",
    stays_px=80.0,
)
"""Azure Kinect and Orbbec Femto (the same chip), narrow view: about 1 mm at 1 m on bright surfaces (Tolgyessy et al.
2021, Kurillo et al. 2022); neighbours are independent but for their interpolation onto the colour picture. What stays:
fixed pattern and light that comes by another way."""

SENSORS: Mapping[str, DepthSensor] = {
    "primesense": PRIMESENSE,
    "d415": D415,
    "d435": D435,
    "d455": D455,
    "azure": AZURE_KINECT,
}
"""Every known sensor by the name that files, commands and settings use."""

ASSUMED_SENSOR = replace(PRIMESENSE, origin=ASSUMED)
"""Of a source that does not say."""
