"""Appearance of one recording: colours, light and table, in linear light."""

from __future__ import annotations

import math
from dataclasses import dataclass

import cv2
import numpy as np

from carpus.core.model.types import FloatArray
from carpus.core.simulation.scene import Scene
from carpus.core.simulation.spec import RandomStream, RecordingSpec
from carpus.core.simulation.sphere_tracing import FloatImage

# Skin of Fitzpatrick types I to VI, sRGB.
SKIN_TONES_SRGB = np.array(
    [[238, 200, 180], [226, 178, 150], [202, 149, 117], [166, 112, 82], [118, 77, 55], [80, 53, 41]], dtype=np.float64
)
PAPER_BLUE_SRGB = np.array([38.0, 72.0, 165.0])
_SLEEVES_SRGB = {
    "grey": (95.0, 98.0, 104.0),
    "white": (215.0, 213.0, 207.0),
    "blue": (40.0, 66.0, 140.0),
    "jeans": (74.0, 98.0, 142.0),
}
_METALS_SRGB = np.array([[212.0, 175.0, 95.0], [200.0, 202.0, 206.0]])
_STRAPS_SRGB = np.array([[38.0, 36.0, 35.0], [98.0, 66.0, 42.0], [40.0, 60.0, 120.0]])
_BANDAGE_SRGB = (226.0, 214.0, 196.0)
_WOODS_SRGB = np.array([[170.0, 128.0, 88.0], [120.0, 84.0, 56.0], [205.0, 175.0, 135.0]])
_PLAIN_SRGB = np.array([[205.0, 205.0, 200.0], [140.0, 146.0, 148.0], [92.0, 100.0, 96.0]])

# Brightness of the picture and electrons at full scale: how much light there is, and so how much noise.
LIGHTS = {"bright": (0.92, 4500.0), "normal": (0.72, 1800.0), "dim": (0.34, 800.0)}
READ_NOISE_ELECTRONS = 9.0


def to_linear(srgb: FloatArray) -> FloatArray:
    """Convert sRGB values 0 to 255 to linear light 0 to 1."""
    c = np.asarray(srgb) / 255.0
    return np.asarray(np.where(c <= 0.04045, c / 12.92, ((c + 0.055) / 1.055) ** 2.4))


@dataclass(frozen=True, slots=True)
class WornBand:
    """Band around the forearm: linear colour (3,), start and end from the wrist; cloth has folds."""

    color: FloatArray
    from_m: float
    to_m: float
    is_cloth: bool


@dataclass(frozen=True, slots=True)
class Appearance:
    """Appearance of one recording; linear colours (3,).

    Attributes
    ----------
    ring : None without a ring
    light_cam : (3,) unit vector from the surface to the lamp
    lamp, ambient : (3,) strengths
    electrons : at full scale
    blur_px : of the lens
    mottling : (5, 3) rad/m of the waves in the skin's colour
    table, table_depth_m : albedo (H, W, 3) and depth (H, W)
    """

    skin: FloatArray
    paper: FloatArray
    bands: tuple[WornBand, ...]
    ring: FloatArray | None
    rod: FloatArray
    light_cam: FloatArray
    lamp: FloatArray
    ambient: FloatArray
    electrons: float
    blur_px: float
    mottling: FloatArray
    table: FloatImage
    table_depth_m: FloatImage


def room_light(spec: RecordingSpec) -> str:
    """Return the light of a recording, a key of :data:`LIGHTS`."""
    if spec.light != "drawn":
        return spec.light
    rng = np.random.default_rng([spec.seed, RandomStream.SCENE, 2])
    return ("bright", "normal", "normal", "dim")[int(rng.integers(4))]


def sample_appearance(scene: Scene) -> Appearance:
    """Draw the appearance of a recording."""
    spec = scene.spec
    rng = np.random.default_rng([spec.seed, RandomStream.SCENE, 1])
    tone = int(rng.integers(6)) if spec.skin_tone is None else spec.skin_tone
    sleeve_drawn = ("none", "grey", "white")[int(rng.integers(3))]
    sleeve = sleeve_drawn if spec.sleeve == "drawn" else spec.sleeve
    sleeve_start = rng.uniform(0.045, 0.09)
    level, electrons = LIGHTS[room_light(spec)]
    warmth = rng.uniform(-0.08, 0.10)
    white = np.array([1.0 + warmth, 1.0, 1.0 - warmth])
    side = rng.uniform(0.25, 0.75)
    heading = rng.uniform(0.0, 2.0 * math.pi)
    to_lamp = np.array([side * math.cos(heading), side * math.sin(heading), -1.0])
    to_lamp = to_lamp / np.linalg.norm(to_lamp)
    lamp_share = rng.uniform(0.45, 0.65)
    # the depth of the table along z, (H, W)
    x = (np.arange(scene.camera.width_px) - scene.camera.cx_px) / scene.camera.fx_px
    y = (np.arange(scene.camera.height_px) - scene.camera.cy_px) / scene.camera.fy_px
    normal = scene.rotation_w0_cam[:, 2]
    point = scene.to_camera(np.array([0.0, 0.0, scene.table_height_m]))
    slope = normal[0] * x[None, :] + normal[1] * y[:, None] + normal[2]
    depth = np.asarray((normal @ point) / slope, dtype=np.float32)
    table = _table_albedo(scene, depth, rng)
    return Appearance(
        skin=to_linear(SKIN_TONES_SRGB[tone] * rng.uniform(0.96, 1.04, 3)),
        paper=to_linear(PAPER_BLUE_SRGB * rng.uniform(0.85, 1.15, 3)),
        bands=_sample_bands(spec, sleeve, sleeve_start, rng.uniform(0.85, 1.1)),
        ring=to_linear(_METALS_SRGB[int(spec.generator(RandomStream.WORN).integers(2))])
        if "ring" in spec.accessories
        else None,
        rod=to_linear(np.array([150.0, 140.0, 130.0]) * rng.uniform(0.4, 1.3)),
        light_cam=to_lamp,
        lamp=level * lamp_share * 1.25 * white,
        ambient=level * (1.0 - lamp_share) * 1.25 * white,
        electrons=electrons,
        blur_px=rng.uniform(0.5, 0.75),
        mottling=rng.normal(size=(5, 3)) * rng.uniform(150.0, 700.0, (5, 1)),
        table=table,
        table_depth_m=depth,
    )


def _sample_bands(spec: RecordingSpec, sleeve: str, sleeve_start_m: float, shade: float) -> tuple[WornBand, ...]:
    """Draw bandage, watch and sleeve, in the order in which they are put on."""
    rng = np.random.default_rng([spec.seed, RandomStream.WORN, 1])
    bandage_m, watch_m, strap = rng.uniform(0.010, 0.025), rng.uniform(0.020, 0.040), int(rng.integers(3))
    out = []
    if "bandage" in spec.accessories:
        out.append(WornBand(to_linear(np.array(_BANDAGE_SRGB)), bandage_m, bandage_m + 0.09, is_cloth=True))
    if "watch" in spec.accessories:
        out.append(WornBand(to_linear(_STRAPS_SRGB[strap]), watch_m, watch_m + 0.020, is_cloth=False))
    if sleeve != "none":
        out.append(
            WornBand(to_linear(np.array(_SLEEVES_SRGB[sleeve]) * shade), sleeve_start_m, math.inf, is_cloth=True)
        )
    return tuple(out)


def _table_albedo(scene: Scene, depth_m: FloatImage, rng: np.random.Generator) -> FloatImage:
    """Return the albedo (H, W, 3) of wood, or of a plain surface with a fine grain, fixed in the room."""
    camera = scene.camera
    kind = int(rng.integers(3))
    u, v = np.meshgrid(np.arange(camera.width_px, dtype=np.float64), np.arange(camera.height_px, dtype=np.float64))
    points = camera.backproject(np.stack((u, v), axis=-1), depth_m.astype(np.float64))
    room = (points - scene.translation_w0_cam_m) @ scene.rotation_w0_cam
    along, across = room[..., 0], room[..., 1]
    turn = rng.uniform(0.0, math.pi)
    along, across = math.cos(turn) * along - math.sin(turn) * across, math.sin(turn) * along + math.cos(turn) * across
    if kind < 2:
        base = to_linear(_WOODS_SRGB[int(rng.integers(3))])
        bend = 0.01 * np.sin(along * 11.0 + rng.uniform(0, 6)) + 0.004 * np.sin(along * 37.0 + rng.uniform(0, 6))
        grain = sum(
            rng.uniform(0.3, 1.0) * np.sin((across + bend) * rate + rng.uniform(0.0, 6.0))
            for rate in rng.uniform(90.0, 900.0, 6)
        )
        pattern = 1.0 + 0.055 * np.asarray(grain)
    else:
        base = to_linear(_PLAIN_SRGB[int(rng.integers(3))])
        pattern = np.ones_like(along)
    fine = cv2.GaussianBlur(rng.normal(size=along.shape).astype(np.float32), (0, 0), 1.2)
    broad = cv2.GaussianBlur(rng.normal(size=along.shape).astype(np.float32), (0, 0), 25.0)
    pattern = pattern + 0.06 * fine + 1.5 * broad
    return np.asarray(base * pattern[..., None], dtype=np.float32)
