"""Depth sensors: noise models and limits.

One value per sensor goes with the camera (:attr:`core.model.camera.Camera.sensor`) from the source to detector,
calibration, tracker and session file; a new sensor is one more value here.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields, replace
from typing import Any, Literal, get_args

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
"""Share of a marker's area from which the detector takes its depth."""


@dataclass(frozen=True, slots=True)
class NoiseModel:
    """Standard deviation ``fixed_m`` + ``square_per_m`` z^2 at a depth of z metres."""

    fixed_m: float = 0.0
    square_per_m: float = 0.0

    def sd_m(self, depth_m: FloatArray) -> FloatArray:
        """Return the standard deviation (...) at depths (...), metres."""
        out = self.square_per_m * depth_m**2
        return np.asarray(out + self.fixed_m if self.fixed_m else out)

    def scale(self, factor: float) -> NoiseModel:
        return NoiseModel(self.fixed_m * factor, self.square_per_m * factor)


@dataclass(frozen=True, slots=True)
class DepthSensor:
    """Depth sensor and its noise.

    Attributes
    ----------
    reading : NoiseModel
        Temporal noise of one reading.
    stays : NoiseModel
        Error that persists on the same surface (fixed pattern): no averaging over time removes it.
    patch_px : float
        Width of a square within which readings are fully correlated.
    averages : bool
        Whether readings of several such squares are independent.
    edge : str
        Readings at an edge: ``torn`` in flecks, ``fattened`` by the matching window, ``flying`` between both surfaces.
    edge_px : int
        Width of the affected zone.
    nearest_m, farthest_m : float
        Range of the sensor.
    registration : str
        Who registers depth to colour.
    baseline_m, focal_px : float
        Of a stereo pair and its depth image; 0 for time of flight.
    stays_px : float
        Correlation length of the persistent error; 0 if not beyond the patch.
    origin : str
        ``stated`` by the source, or ``assumed``.
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
        """Return the standard deviation (...) of one reading at depths (...)."""
        return self.reading.sd_m(depth_m)

    def mean_sd_m(self, depth_m: FloatArray, pixels: FloatArray) -> FloatArray:
        """Return the standard deviation (...) of the mean of ``pixels`` neighbouring readings (...) at depths (...)."""
        sd = self.reading.sd_m(depth_m)
        if not self.averages:
            return sd
        return np.asarray(sd / np.sqrt(np.maximum(pixels / self.patch_px**2, 1.0)))

    def disc_sd_m(self, depth_m: FloatArray, area_px: FloatArray) -> FloatArray:
        """Return the standard deviation (...) of a marker's depth, read over the middle of its area (...)."""
        return self.mean_sd_m(depth_m, CORE_SHARE * area_px)

    def bias_sd_m(self, depth_m: FloatArray) -> FloatArray:
        """Return the standard deviation (...) of the persistent error."""
        return self.stays.sd_m(depth_m)

    def flat_bias_sd_m(self, depth_m: FloatArray) -> FloatArray:
        """Return the same on a flat surface, on which a wide matching window has no effect."""
        flat = NoiseModel(0.0, self.stays.square_per_m) if self.kind == "active stereo" else self.stays
        return flat.sd_m(depth_m)

    def disc_bias_sd_m(self, depth_m: FloatArray, area_px: FloatArray) -> FloatArray:
        """Return the persistent error (...) of a flat marker's depth.

        The error is fully correlated within the matching window's width and independent beyond it; the middle of a
        large marker averages several windows.
        """
        wide = np.sqrt(CORE_SHARE * area_px) / self.patch_px
        kept = np.where(
            wide <= 1.0, 1.0 - wide / 3.0, (1.0 - 1.0 / (3.0 * np.maximum(wide, 1.0))) / np.maximum(wide, 1.0)
        )
        return np.asarray(self.flat_bias_sd_m(depth_m) * kept)

    def with_focal(self, focal_px: float, color_focal_px: float = math.nan) -> DepthSensor:
        """Return the same stereo pair with depth images of another focal length; other kinds are unchanged.

        Disparity is as accurate as before, and the window as many of its own pixels wide. ``color_focal_px`` converts
        that width to pixels of the colour image that depth is registered to.
        """
        if self.kind != "active stereo":
            return self
        made = _build_stereo_sensor(self.name, self.baseline_m, focal_px, self.nearest_m, self.farthest_m)
        larger = color_focal_px / _COLOR_FOCAL_PX if color_focal_px > 0.0 else 1.0
        return replace(made, origin=self.origin, patch_px=max(made.patch_px * larger, 1.0))

    def to_dict(self) -> dict[str, Any]:
        """Return all values in plain types, as files store them."""
        return asdict(self)


def parse_sensor(value: object) -> DepthSensor:
    """Parse a sensor in a file: the name of a known one, or the output of :meth:`DepthSensor.to_dict`.

    Unknown keys are ignored, since a newer file may have more. Raises ValueError.
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
    numbers: tuple[object, ...] = (
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
    ok = ok and all(
        isinstance(one, int | float) and not isinstance(one, bool) and math.isfinite(one) and one >= 0.0
        for one in numbers
    )
    ok = ok and all(0.0 <= law.fixed_m < 1.0 and 0.0 <= law.square_per_m < 1.0 for law in laws)
    ok = ok and max(sensor.reading.fixed_m, sensor.reading.square_per_m) > 0.0
    if not ok or sensor.edge_px > _MAX_EDGE_PX or sensor.patch_px < 1.0 or sensor.farthest_m <= sensor.nearest_m:
        raise ValueError("its figures are no sensor's")
    return sensor


def _build_stereo_sensor(
    name: str, baseline_m: float, focal_px: float, nearest_m: float, farthest_m: float
) -> DepthSensor:
    """Return a RealSense of the D400 family: sd = z^2 subpixel / (focal length x baseline), disparity sd 0.08 pixel.

    Grunnet-Jepsen, Sweetser and Woodfill, "Tuning depth cameras for best performance" (maker's paper, rev. 2.0): the
    formula and its 0.08 pixel for a textured surface, over a plane. It includes the persistent error (the projector's
    spots on the surface, the larger part) and the temporal noise.
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
"""Width of the matching window in the depth image; default focal length of the colour image that depth is registered
to.
"""
_RELIEF_M, _RELIEF_PATCH_PX = 0.0005, 11.0
"""Height of knuckles lost in a window of that width; it grows with the square of the width."""

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
"""Sensor of a source that does not state one."""
