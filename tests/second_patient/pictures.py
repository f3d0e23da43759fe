"""The second camera's pictures: skin, paper, nails, table, cushion and lamp by a z-buffer; a warm, vignetting lens; and
depth by structured light, with a law of its own.

Depth law: disparity d = ``DISPARITY_PX_M`` / z, read with noise of ``disparity_sd_px`` (drawn for each unit) that
neighbours share over some pixels, and given in steps of ``STEP_PX``. Along edges a reading belongs to either surface
or to a mixture; where the projector cannot shine, at grazing skin and now and then anywhere, there is none.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from carpus.core.model.types import ByteImage, DepthImage, FloatArray
from tests.second_patient.discs import NAMES
from tests.second_patient.patient import Body, Hung, Patient
from tests.second_patient.person import Bone, place_at_rest

FloatImage = NDArray[np.float32]
SAMPLES = 2
"""Samples each way in a pixel of the colour picture."""
_CUSHION_M = ((-0.30, -0.030), (-0.075, 0.075))
_CUSHION_DEEP_M = 0.034
_PAPER_OVER_REST = 2.4
_SLEEVE_FROM_M = -0.13
DISPARITY_PX_M = 568.0 * 0.0748
STEP_PX = 1.0 / 8.0
COUNTS_PER_M = 5000.0
_PATCH_PX = (1.9, 1.2)
"""Reach of what neighbours share, along and across the rows."""
_EDGE_PX = 1.4
_GRAZING = 0.030
"""Depth may change so much from pixel to pixel, metres, before a surface grazes the light."""
_BANK = 5


@dataclass(frozen=True, slots=True)
class Fragments:
    """The nearest surface at F samples: ``row``, ``column`` of the sample (F,), the ``triangle`` (F,) seen there,
    the ``share`` (F, 3) of its corners, ``depth_m`` (F,)."""

    row: NDArray[np.int64]
    column: NDArray[np.int64]
    triangle: NDArray[np.int64]
    share: FloatArray
    depth_m: FloatArray


def fragments(
    pixel: FloatArray, depth_m: FloatArray, triangle: NDArray[np.int64], shape: tuple[int, int], per_pixel: int = 1
) -> Fragments:
    """What is seen of triangles (T, 3) of corners at ``pixel`` (V, 2) and ``depth_m`` (V,), on a grid of ``per_pixel``
    samples each way in every pixel of a picture of ``shape``; those seen from behind are left out."""
    rows, columns = shape[0] * per_pixel, shape[1] * per_pixel
    spot = (pixel + 0.5) * per_pixel - 0.5
    a, b, c = (spot[triangle[:, i]] for i in range(3))
    area = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])
    low = np.ceil(np.minimum(np.minimum(a, b), c)).astype(np.int64)
    high = np.floor(np.maximum(np.maximum(a, b), c)).astype(np.int64)
    low, high = np.maximum(low, 0), np.minimum(high, [columns - 1, rows - 1])
    size = high - low + 1
    kept = np.flatnonzero((area < 0.0) & (size > 0).all(axis=1) & (depth_m[triangle] > 0.05).all(axis=1))
    low, size, area, a, b, c = low[kept], size[kept], area[kept], a[kept], b[kept], c[kept]
    count = size[:, 0] * size[:, 1]
    owner = np.repeat(np.arange(len(kept)), count)
    wide = size[owner, 0]
    place = np.arange(len(owner)) - np.repeat(np.cumsum(count) - count, count)
    down = place // wide
    x = low[owner, 0] + place - down * wide
    y = low[owner, 1] + down
    # Shares of the corners, and one over the depth (not depth), are linear over the picture.
    near = 1.0 / depth_m[triangle[kept]]
    part_b = np.stack((c[:, 1] - a[:, 1], a[:, 0] - c[:, 0]), axis=1) / area[:, None]
    part_c = np.stack((a[:, 1] - b[:, 1], b[:, 0] - a[:, 0]), axis=1) / area[:, None]
    at_b, at_c = (-np.einsum("ti,ti->t", part, a) for part in (part_b, part_c))
    share_b = x * part_b[owner, 0] + y * part_b[owner, 1] + at_b[owner]
    share_c = x * part_c[owner, 0] + y * part_c[owner, 1] + at_c[owner]
    inside = np.flatnonzero((share_b >= -1e-9) & (share_c >= -1e-9) & (share_b + share_c <= 1.0 + 1e-9))
    owner, share_b, share_c = owner[inside], share_b[inside], share_c[inside]
    near_a, near_b, near_c = near[owner].T
    nearness = near_a + share_b * (near_b - near_a) + share_c * (near_c - near_a)
    sample = y[inside] * columns + x[inside]
    order = np.argsort(nearness)
    front = np.full(rows * columns, -1, dtype=np.int64)
    front[sample[order]] = order
    seen = front[front >= 0]
    owner, sample, share_b, share_c = owner[seen], sample[seen], share_b[seen], share_c[seen]
    share = np.stack((1.0 - share_b - share_c, share_b, share_c), axis=1) * near[owner] / nearness[seen, None]
    return Fragments(sample // columns, sample % columns, kept[owner], share, 1.0 / nearness[seen])


class Look:
    """Looks of a seed. Colours are linear light, red green blue. ``lamp`` (3,) unit way to the lamp in the room;
    ``paint`` (V, 3) of the skin's corners; ``table`` (H, W, 3) and its ``table_depth_m`` (H, W) with the cushion, as
    seen without a hand."""

    def __init__(self, patient: Patient, hung: Hung, seed: int) -> None:
        rng = np.random.default_rng([seed, 1607])
        swing, high = rng.uniform(0.0, 2.0 * np.pi), np.radians(rng.uniform(48.0, 75.0))
        self.lamp = np.array([np.cos(swing) * np.cos(high), np.sin(swing) * np.cos(high), np.sin(high)])
        warm = float(rng.uniform(-0.1, 0.1))
        self.lamp_light = float(rng.uniform(0.55, 0.85)) * np.array([1.0 + warm, 1.0, 1.0 - warm])
        self.sky_light = float(rng.uniform(0.30, 0.45)) * np.array([1.0, 1.0, 1.0 + 0.4 * warm])
        self.paper = np.array([rng.uniform(0.012, 0.035), rng.uniform(0.07, 0.15), rng.uniform(0.36, 0.58)])
        self.table, self.table_depth_m = _background(hung, patient, self, rng)
        self.gloss, self.paint = float(rng.uniform(0.02, 0.09)), _paint(patient, rng)


def _paint(patient: Patient, rng: np.random.Generator) -> FloatArray:
    """Colour of the skin's corners: a tone between fair and dark, mottled, redder knuckles, paler nails, a sleeve."""
    skin, person = patient.skin, patient.person
    tone = float(rng.uniform(0.0, 1.0))
    fair, dark = np.array([0.60, 0.36, 0.25]), np.array([0.13, 0.065, 0.038])
    base = fair ** (1.0 - tone) * dark**tone
    corner = skin.corner_m
    waves = rng.normal(size=(12, 3)) * 140.0
    mottle = np.sin(corner @ waves.T + rng.uniform(0.0, 6.3, 12)).mean(axis=1)
    out = base * (1.0 + 0.12 * mottle[:, None] * np.array([0.7, 1.0, 1.1]))
    rest = place_at_rest(person)
    mm = 1e-3 * person.size
    for ray in (1, 2, 3, 4):
        first = Bone.PP2 + 3 * (ray - 1)
        for bone, wide, red in ((first, 8.0, 0.10), (first + 1, 5.0, 0.14), (first + 2, 3.5, 0.10)):
            near = np.exp(-0.5 * (np.linalg.norm(corner - rest.joint_m[0, bone], axis=1) / (1.6 * wide * mm)) ** 2)
            out *= 1.0 - near[:, None] * red * np.array([0.3, 1.3, 1.2])
    tips = [(Bone.PP2 + 3 * i + 2, person.finger_m[i, 2]) for i in range(4)] + [(Bone.DP1, person.thumb_m[2])]
    for bone, length in tips:
        turn = rest.turn[0, bone]
        local = (corner - rest.joint_m[0, bone]) @ turn
        nail = np.clip((skin.normal @ turn[:, 2] - 0.55) / 0.2, 0.0, 1.0) * np.clip(
            (local[:, 0] / length - 0.5) / 0.1, 0.0, 1.0
        )
        nail = nail * (np.linalg.norm(local - [0.75 * length, 0.0, 0.0], axis=1) < 14.0 * mm)
        out += (0.35 * nail)[:, None] * (np.array([0.62, 0.40, 0.36]) * (0.5 + 0.5 * (1.0 - tone)) - out)
    sleeve = np.clip((_SLEEVE_FROM_M - corner[:, 0]) / 0.004, 0.0, 1.0)[:, None]
    cloth = np.array([[0.30, 0.29, 0.28], [0.05, 0.05, 0.055], [0.35, 0.10, 0.09], [0.10, 0.22, 0.12]])[rng.integers(4)]
    ribs = 1.0 + 0.18 * np.sin(corner[:, :1] * 900.0)
    return np.asarray(out * (1.0 - sleeve) + sleeve * cloth * ribs)


def _background(hung: Hung, patient: Patient, look: Look, rng: np.random.Generator) -> tuple[FloatImage, FloatImage]:
    """Table and cushion."""
    camera = hung.camera
    v, u = np.mgrid[0 : camera.height_px, 0 : camera.width_px].astype(np.float64)
    ideal = camera.undistort(np.stack((u.ravel(), v.ravel()), axis=-1)).reshape(*u.shape, 2)
    ray = camera.backproject(ideal, np.ones(u.shape))
    up = hung.turn @ np.array([0.0, 0.0, 1.0])
    foot = hung.to_camera(np.array([0.0, 0.0, -hung.table_m]))
    depth = (foot @ up) / (ray @ up)
    place = (ray * depth[..., None] - hung.shift_m) @ hung.turn
    woods = np.array(
        [[0.42, 0.30, 0.19], [0.62, 0.58, 0.52], [0.22, 0.16, 0.12], [0.50, 0.50, 0.48], [0.30, 0.36, 0.30]]
    )
    wood = woods[rng.integers(len(woods))]
    grain = np.zeros(u.shape)
    for _ in range(7):
        along, across = rng.uniform(4.0, 18.0), rng.uniform(60.0, 420.0)
        bent = place[..., 1] + 0.006 * np.sin(along * place[..., 0] + rng.uniform(0.0, 6.3))
        grain += np.sin(across * bent + rng.uniform(0.0, 6.3)) / 7.0
    table = (
        wood
        * (1.0 + float(rng.uniform(0.04, 0.22)) * grain[..., None])
        * (look.lamp_light * look.lamp[2] + look.sky_light)
    )
    box, quads = _cushion(hung)
    cam = hung.to_camera(patient.mirror * box)
    faces = quads[:, ::-1] if patient.side == "left" else quads
    triangle = np.concatenate((faces[:, [0, 1, 2]], faces[:, [0, 2, 3]]))
    seen = fragments(hung.pixel(cam), cam[:, 2], triangle, u.shape)
    room = patient.mirror * box
    normal = np.cross(room[triangle[:, 1]] - room[triangle[:, 0]], room[triangle[:, 2]] - room[triangle[:, 0]])
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    cloth = np.array([[0.16, 0.17, 0.18], [0.40, 0.36, 0.30], [0.12, 0.24, 0.20]])[rng.integers(3)]
    lit = np.clip(normal @ look.lamp, 0.0, 1.0)[:, None] * look.lamp_light + look.sky_light * (
        0.6 + 0.4 * normal[:, 2:]
    )
    weave = 1.0 + 0.06 * rng.normal(size=(len(seen.row), 1))
    table[seen.row, seen.column] = cloth * lit[seen.triangle] * weave
    depth[seen.row, seen.column] = seen.depth_m
    return table.astype(np.float32), depth.astype(np.float32)


def _cushion(hung: Hung) -> tuple[FloatArray, NDArray[np.int64]]:
    """The cushion under the forearm: corners (8, 3) in the room of a right hand and faces (5, 4) seen from outside."""
    (x0, x1), (y0, y1) = _CUSHION_M
    low, high = -hung.table_m, -min(_CUSHION_DEEP_M, hung.table_m - 0.02)
    slope = 0.018
    box = np.array(
        [[x0, y0, low], [x1 + slope, y0 - slope, low], [x1 + slope, y1 + slope, low], [x0, y1, low],
         [x0, y0, high], [x1, y0, high], [x1, y1, high], [x0, y1, high]]
    )  # fmt: skip
    quads = np.array([[4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]])
    return box, quads


def front_faces(patient: Patient) -> NDArray[np.int64]:
    """The skin's triangles in mathematical order from outside, on this side of the body."""
    return patient.skin.triangle[:, ::-1] if patient.side == "left" else patient.skin.triangle


def render_depth(patient: Patient, hung: Hung, look: Look, body: Body) -> FloatImage:
    """Depth (H, W) of everything, along the camera's z."""
    cam = hung.to_camera(body.point_m)
    depth = look.table_depth_m.copy()
    seen = fragments(hung.pixel(cam), cam[:, 2], front_faces(patient), depth.shape)
    depth[seen.row, seen.column] = np.minimum(depth[seen.row, seen.column], seen.depth_m)
    return depth


def render_color(
    patient: Patient, hung: Hung, look: Look, body: Body, stuck: NDArray[np.bool_]
) -> tuple[FloatImage, FloatArray]:
    """The picture in linear light (H, W, 3), and the share (21,) of each disc's paper that is seen, by area on the
    picture; ``stuck`` (21,) which discs are on the hand."""
    shape = look.table_depth_m.shape
    cam = hung.to_camera(body.point_m)
    pixel = hung.pixel(cam)
    low = np.clip(np.floor(pixel.min(axis=0)).astype(int) - 1, 0, [shape[1] - 1, shape[0] - 1])
    high = np.clip(np.ceil(pixel.max(axis=0)).astype(int) + 2, 1, [shape[1], shape[0]])
    box = (int(high[1] - low[1]), int(high[0] - low[0]))
    faces = front_faces(patient)
    seen = fragments(pixel - low, cam[:, 2], faces, box, SAMPLES)
    every = np.hstack((body.point_m, body.normal, look.paint, patient.skin.corner_m)).astype(np.float32)
    mixed = np.einsum("fi,fij->fj", seen.share.astype(np.float32), every[faces[seen.triangle]])
    place, normal, paint, rest = mixed[:, :3], mixed[:, 3:6], mixed[:, 6:9], mixed[:, 9:]
    normal /= np.sqrt(np.einsum("fj,fj->f", normal, normal))[:, None]
    shine = np.full(len(place), look.gloss, dtype=np.float32)
    rows = np.full((box[0] * SAMPLES, box[1] * SAMPLES), -1, dtype=np.int64)
    rows[seen.row, seen.column] = np.arange(len(place))
    share = _stick(hung, look, body, patient, stuck, (low, rows, place, rest), (paint, shine))
    light = _shaded(hung, look, place, normal, paint, shine)
    fine = np.zeros((*rows.shape, 3), dtype=np.float32)
    cover = (rows >= 0).astype(np.float32)
    fine[rows >= 0] = light
    table = _shadowed(hung, look, body, faces)
    flat = look.table_depth_m[low[1] : high[1], low[0] : high[0]]
    hidden = np.repeat(np.repeat(flat, SAMPLES, 0), SAMPLES, 1)[seen.row, seen.column] < seen.depth_m
    cover[seen.row[hidden], seen.column[hidden]] = 0.0
    fine[seen.row[hidden], seen.column[hidden]] = 0.0
    size = (box[1], box[0])
    whole = cv2.resize(fine, size, interpolation=cv2.INTER_AREA)
    part = cv2.resize(cover, size, interpolation=cv2.INTER_AREA)[..., None]
    cut = (slice(low[1], high[1]), slice(low[0], high[0]))
    table[cut] = whole + (1.0 - part) * table[cut]
    return table, share


def _stick(
    hung: Hung,
    look: Look,
    body: Body,
    patient: Patient,
    stuck: NDArray[np.bool_],
    seen: tuple[NDArray[np.int64], NDArray[np.int64], FloatArray, FloatArray],
    onto: tuple[FloatArray, FloatArray],
) -> FloatArray:
    """Paint the paper onto the samples; gives the share of each disc that is seen."""
    low, rows, place, rest = seen
    paint, shine = onto
    share = np.zeros(len(NAMES))
    cam = hung.to_camera(body.disc_m)
    middle = (hung.pixel(cam) - low + 0.5) * SAMPLES - 0.5
    focal = 0.5 * (hung.camera.fx_px + hung.camera.fy_px) * SAMPLES
    facing = np.abs(np.sum((body.disc_normal @ hung.turn.T) * cam, axis=1)) / np.linalg.norm(cam, axis=1)
    across = np.cross(body.disc_normal, body.disc_along)
    for i in np.flatnonzero(stuck):
        radius = patient.stuck.size_m[i]
        reach = 1.15 * radius * focal / cam[i, 2] + 2.0
        u0, v0 = np.maximum(np.floor(middle[i] - reach).astype(int), 0)
        u1, v1 = np.maximum(np.ceil(middle[i] + reach).astype(int) + 1, 0)
        some = rows[v0:v1, u0:u1]
        some = some[some >= 0]
        away = place[some] - body.disc_m[i]
        mine = np.linalg.norm(rest[some] - body.disc_rest_m[i], axis=1) < _PAPER_OVER_REST * radius
        some, away = some[mine], away[mine]
        angle = np.arctan2(away @ across[i], away @ body.disc_along[i])
        wave2, wave3, phase2, phase3 = patient.stuck.cut[i]
        edge = radius * (1.0 + wave2 * np.cos(2.0 * angle + phase2) + wave3 * np.cos(3.0 * angle + phase3))
        sample_m = cam[i, 2] / focal
        paper = np.clip((edge - np.linalg.norm(away, axis=1)) / sample_m + 0.5, 0.0, 1.0)
        paint[some] += paper[:, None] * (look.paper - paint[some])
        shine[some] *= 1.0 - paper
        share[i] = paper.sum() * sample_m**2 / (np.pi * radius**2 * max(facing[i], 0.05))
    return np.clip(share, 0.0, 1.0)


def _shaded(
    hung: Hung, look: Look, place: FloatArray, normal: FloatArray, paint: FloatArray, shine: FloatArray
) -> FloatImage:
    """Light (F, 3) that comes from the samples: a lamp that reaches a little round the edge, a sky, some gloss."""
    lamp, lamp_light, sky_light = (part.astype(np.float32) for part in (look.lamp, look.lamp_light, look.sky_light))
    toward = np.clip((normal @ lamp + np.float32(0.18)) / np.float32(1.18), 0.0, 1.0)[:, None]
    sky = (np.float32(0.62) + np.float32(0.38) * normal[:, 2:]) * sky_light
    half = (-hung.turn.T @ hung.shift_m).astype(np.float32) - place
    half /= np.sqrt(np.einsum("fj,fj->f", half, half))[:, None]
    half += lamp
    half /= np.sqrt(np.einsum("fj,fj->f", half, half))[:, None]
    gloss = shine * np.clip(np.einsum("fj,fj->f", normal, half), 0.0, 1.0) ** np.float32(22.0)
    return np.asarray(paint * (toward * lamp_light + sky) + gloss[:, None] * lamp_light, dtype=np.float32)


def _shadowed(hung: Hung, look: Look, body: Body, faces: NDArray[np.int64]) -> FloatImage:
    """The table with the soft shadow of the hand: the skin thrown along the lamp's light onto the table top."""
    drop = (body.point_m[:, 2] + hung.table_m) / look.lamp[2]
    fallen = hung.to_camera(body.point_m - drop[:, None] * look.lamp)
    small = hung.pixel(fallen) / 4.0
    shape = (look.table.shape[0] // 4, look.table.shape[1] // 4)
    a, b, c = (small[faces[:, i]] for i in range(3))
    # Only what faces the lamp: every place of the shadow is then filled once.
    lit = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) < (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])
    mask = np.zeros(shape, dtype=np.uint8)
    cv2.fillPoly(mask, list(np.round(small[faces[lit]] * 8.0).astype(np.int32)), 255, lineType=cv2.LINE_8, shift=3)
    shade = cv2.GaussianBlur(mask.astype(np.float32) / 255.0, (0, 0), 2.2)
    shade = cv2.resize(shade, (look.table.shape[1], look.table.shape[0]), interpolation=cv2.INTER_LINEAR)
    dark = look.sky_light / (look.sky_light + look.lamp_light * look.lamp[2])
    return look.table * (np.float32(1.0) - shade[..., None] * ((1.0 - dark) * 0.85).astype(np.float32))


class Sensor:
    """One unit for pictures of ``shape``: its lens, its colours and its depth, and the noise that it draws on."""

    def __init__(self, seed: int, shape: tuple[int, int]) -> None:
        rng, self.seed = np.random.default_rng([seed, 1709]), seed
        v, u = np.mgrid[0 : shape[0], 0 : shape[1]]
        away = np.hypot((u - 0.5 * shape[1]) / (0.5 * shape[1]), (v - 0.5 * shape[0]) / (0.5 * shape[1]))
        self.falloff = (1.0 - float(rng.uniform(0.10, 0.32)) * away**2).astype(np.float32)
        warm = float(rng.uniform(-0.10, 0.12))
        bright = float(rng.uniform(0.85, 1.15))
        self.gain = bright * np.array([1.0 + warm, 1.0 + float(rng.uniform(-0.04, 0.04)), 1.0 - warm])
        self.bank = [rng.standard_normal((*shape, 3), dtype=np.float32) for _ in range(_BANK)]
        self.patch = [_patches(rng.standard_normal(shape, dtype=np.float32)) for _ in range(_BANK)]
        pattern = 0.045 * _patches(rng.standard_normal(shape, dtype=np.float32))
        self.pattern_px = pattern.astype(np.float32)
        self.blur_px, self.shot, self.read, self.chroma_blur_px, self.disparity_sd_px = rng.uniform(
            [0.45, 1.5e-4, 0.8e-3, 0.6, 0.055], [0.75, 5e-4, 2.2e-3, 1.1, 0.10]
        ).tolist()
        self.scale = 1.0 + float(np.clip(rng.normal(0.0, 0.003), -0.006, 0.006))


def _patches(white: FloatImage) -> FloatImage:
    """Noise of sd 1 that neighbours share."""
    soft = cv2.GaussianBlur(white, (0, 0), sigmaX=_PATCH_PX[0], sigmaY=_PATCH_PX[1])
    return np.asarray(soft / soft.std(), dtype=np.float32)


_LINEAR = np.linspace(0.0, 1.0, 4096)
_SRGB = np.where(_LINEAR <= 0.0031308, 12.92 * _LINEAR, 1.055 * _LINEAR ** (1 / 2.4) - 0.055)
_GAMMA: ByteImage = np.round(255.0 * _SRGB).astype(np.uint8)


def expose(sensor: Sensor, light: FloatImage, frame: int) -> ByteImage:
    """(H, W, 3) linear light as 8-bit colour, red first."""
    rng = np.random.default_rng([sensor.seed, 1801, frame])
    seen = cv2.GaussianBlur(
        light * (sensor.falloff[..., None] * sensor.gain.astype(np.float32)), (0, 0), sensor.blur_px
    )
    noise = _rolled(sensor.bank, rng)
    seen = seen + noise * np.sqrt(np.float32(sensor.shot) * np.maximum(seen, 0.0) + np.float32(sensor.read**2))
    eight = _GAMMA[np.clip(seen * 4095.0, 0.0, 4095.0).astype(np.uint16)]
    split = cv2.cvtColor(eight, cv2.COLOR_RGB2YCrCb)
    half = cv2.resize(split[..., 1:], (split.shape[1] // 2, split.shape[0] // 2), interpolation=cv2.INTER_AREA)
    half = cv2.GaussianBlur(half, (0, 0), 0.5 * sensor.chroma_blur_px)
    split[..., 1:] = cv2.resize(half, (split.shape[1], split.shape[0]), interpolation=cv2.INTER_LINEAR)
    return np.asarray(cv2.cvtColor(split, cv2.COLOR_YCrCb2RGB))


def read_depth(sensor: Sensor, depth_m: FloatImage, frame: int) -> DepthImage:
    """(H, W) true depth as the unit gives it, 5000 counts a metre, 0 for no reading."""
    rng = np.random.default_rng([sensor.seed, 1901, frame])
    shape = depth_m.shape
    disparity = (DISPARITY_PX_M / depth_m).astype(np.float32)
    noise, jump_u, jump_v, dice = (_rolled(sensor.patch, rng) for _ in range(4))
    v, u = np.indices(shape, dtype=np.float32)
    read = cv2.remap(
        disparity,
        u + _EDGE_PX * jump_u,
        v + 0.6 * _EDGE_PX * jump_v,
        cv2.INTER_NEAREST,
        borderMode=cv2.BORDER_REPLICATE,
    )
    high = cv2.dilate(disparity, np.ones((5, 5), np.uint8))
    low = cv2.erode(disparity, np.ones((5, 5), np.uint8))
    edge = high - low > 1.2
    mixed = edge & (dice > 0.9)
    read = np.where(mixed, cv2.blur(disparity, (3, 3)), read)
    read = read + np.float32(sensor.disparity_sd_px) * noise + sensor.pattern_px
    steps = np.round(read / STEP_PX) * STEP_PX
    out = np.round(COUNTS_PER_M * sensor.scale * DISPARITY_PX_M / steps)
    # The projector stands to the left: what a nearer thing hides from it, further left, is dark.
    column = u + disparity
    dark = column < np.maximum.accumulate(column, axis=1) - 1.0
    slope = np.maximum(np.abs(np.gradient(depth_m, axis=0)), np.abs(np.gradient(depth_m, axis=1)))
    blind = dark | (edge & (dice < -1.1)) | ((slope > _GRAZING) & (dice < 0.3)) | (noise * dice > 6.5)
    return np.where(blind, 0, out).astype(np.uint16)


def _rolled(bank: list[FloatImage], rng: np.random.Generator) -> FloatImage:
    """One of the drawn noises, shifted: new for every frame without being drawn for it."""
    one = bank[int(rng.integers(len(bank)))]
    down, right, flip = int(rng.integers(one.shape[0])), int(rng.integers(one.shape[1])), int(rng.integers(2))
    return np.roll(one, (down, right), axis=(0, 1)) * np.float32(1 - 2 * flip)
