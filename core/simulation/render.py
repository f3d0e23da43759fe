"""Noise-free images of a scene: colour, depth, and the visible share of each marker."""

from __future__ import annotations

import math
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from carpus.core.model.camera import Camera
from carpus.core.model.hand.kinematics import SEGMENTS
from carpus.core.model.hand.protocols import PALM_SITES
from carpus.core.model.types import FloatArray
from carpus.core.simulation.appearance import Appearance, sample_appearance
from carpus.core.simulation.disturbances import sample_false_blobs, sample_passing_rod
from carpus.core.simulation.scene import HandPose, Scene
from carpus.core.simulation.skin import Cones, Part
from carpus.core.simulation.sphere_tracing import Box, FloatImage, TracedSurface, bounding_box, trace_cones

_EDGE_ON = 0.02
_LARGEST_SAG_M, _HIDING_GAP_M = 0.004, 0.004


@dataclass(frozen=True, slots=True)
class PaperPatch:
    """Round piece of paper in the camera; ``bend`` is 0 flat to 1 like the skin."""

    center_m: FloatArray
    normal: FloatArray
    radius_m: float
    color: FloatArray
    bend: float


_BAND_EDGE_M = np.float32(0.0012)
_RING_M, _RING_SHARE, _RING_AWAY_M = 0.002, 0.5, 0.011
"""Half width of a ring, its place on the bone, and how far from the bone it may lie."""
_KNUCKLES = (2, 3, 6, 7, 10, 11, 14, 15, 18, 19)
_NAILS = (4, 8, 12, 16, 20)
_KNUCKLE_RADIUS_M, _NAIL_RADIUS_M = 0.006, 0.0048
_KNUCKLE_TINT = np.array([0.05, 0.13, 0.12], dtype=np.float32)
_NAIL_TINT = np.array([1.10, 1.12, 1.16], dtype=np.float32)


def find_spot_pixels(
    camera: Camera, box: Box, points: FloatImage, center_m: FloatArray, radius_m: float
) -> tuple[tuple[slice, slice], FloatImage] | None:
    """Return where the surface ``points`` over ``box`` lie within a radius of a point, and the share of each pixel.

    None if that is outside the box.
    """
    around = bounding_box(camera, center_m[None], np.array([radius_m]), margin_px=2.0)
    top, left = max(around.top, box.top), max(around.left, box.left)
    around = Box(top, min(around.bottom, box.bottom), left, min(around.right, box.right))
    if around.bottom - around.top < 3 or around.right - around.left < 3:
        return None
    place = around.relative_slices(box)
    away = np.linalg.norm(points[place] - center_m.astype(np.float32), axis=-1)
    along_v, along_u = np.gradient(away)
    # Within half a pixel of the edge the spot fills part of a pixel.
    share = np.clip(0.5 - (away - radius_m) / np.maximum(np.hypot(along_u, along_v), 1e-5), 0.0, 1.0)
    return place, share.astype(np.float32)


def project_patch(
    camera: Camera, rays: tuple[FloatImage, FloatImage], depth_m: FloatImage, patch: PaperPatch
) -> tuple[tuple[slice, slice], FloatImage, FloatImage] | None:
    """Return where a paper patch appears: rows and columns, share of each pixel, depth of the paper.

    ``rays`` are the rays' x and y at z = 1. Paper is stiffer than skin: it follows the skin below its tangent plane by
    ``patch.bend``, and lies on skin that rises. What stands clearly in front hides it.
    """
    box = bounding_box(camera, patch.center_m[None], np.array([patch.radius_m]), margin_px=2.0)
    if box.bottom - box.top < 3 or box.right - box.left < 3:
        return None
    rows, columns = box.slices
    x, y = rays[0][None, columns], rays[1][rows, None]
    n, c = patch.normal, patch.center_m
    toward = n[0] * x + n[1] * y + n[2]
    if float(toward.max()) > -_EDGE_ON:
        return None
    plane = (float(c @ n) / toward).astype(np.float32)
    behind = depth_m[rows, columns]
    gap = behind - plane
    z = plane + np.where(gap > 0.0, np.float32(patch.bend) * np.minimum(gap, _LARGEST_SAG_M), gap)
    away = np.sqrt((x * z - c[0]) ** 2 + (y * z - c[1]) ** 2 + (z - c[2]) ** 2)
    along_v, along_u = np.gradient(away)
    share = np.clip(0.5 - (away - patch.radius_m) / np.maximum(np.hypot(along_u, along_v), 1e-5), 0.0, 1.0)
    share *= gap > -_HIDING_GAP_M
    return (rows, columns), share.astype(np.float32), z.astype(np.float32)


def skin_albedo(
    appearance: Appearance, points: FloatImage, markers_cam_m: FloatArray, hand_axes: FloatArray
) -> FloatImage:
    """Return the albedo (H, W, 3) of bare skin.

    ``markers_cam_m`` (21, 3) tell where knuckles and nails are, ``hand_axes`` (3, 3) fix the mottling to the hand.
    """
    coarse = points[::2, ::2]
    size = (points.shape[1], points.shape[0])
    local = (coarse - markers_cam_m[0].astype(np.float32)) @ hand_axes.astype(np.float32)
    waves = np.zeros(coarse.shape[:2], dtype=np.float32)
    for direction in appearance.mottling:
        waves += np.sin(local @ direction.astype(np.float32))
    mottled = np.float32(1.0) + np.float32(0.016) * waves
    red = np.zeros_like(waves)
    for row in _KNUCKLES:
        offset = coarse - markers_cam_m[row].astype(np.float32)
        red += np.exp(np.einsum("hwi,hwi->hw", offset, offset) * np.float32(-0.5 / _KNUCKLE_RADIUS_M**2))
    full = cv2.resize(np.dstack((mottled, np.minimum(red, 1.0))), size, interpolation=cv2.INTER_LINEAR)
    tint = np.float32(1.0) - full[..., 1:] * _KNUCKLE_TINT
    return np.asarray(appearance.skin.astype(np.float32) * full[..., :1] * tint, dtype=np.float32)


def paint_nails(
    albedo: FloatImage, camera: Camera, box: Box, points: FloatImage, markers_cam_m: FloatArray, size: float
) -> None:
    """Paint nails, a little lighter than the skin."""
    for row in _NAILS:
        spot = find_spot_pixels(camera, box, points, markers_cam_m[row], _NAIL_RADIUS_M * size)
        if spot is not None:
            place, share = spot
            albedo[place] *= 1.0 + share[..., None] * (_NAIL_TINT - 1.0)


def paint_bands(
    albedo: FloatImage, appearance: Appearance, points: FloatImage, is_forearm: np.ndarray, wrist_m: FloatArray,
    forearm_axis: FloatArray,
) -> None:  # fmt: skip
    """Paint sleeve, watch and bandage; ``forearm_axis`` points to the hand."""
    if not appearance.bands:
        return
    to_wrist = (points - wrist_m.astype(np.float32)) @ forearm_axis.astype(np.float32)
    for band in appearance.bands:
        along = to_wrist + np.float32(band.from_m)
        share = np.clip(0.5 - along / _BAND_EDGE_M, 0.0, 1.0) * is_forearm
        if np.isfinite(band.to_m):
            share *= np.clip(0.5 + (to_wrist + np.float32(band.to_m)) / _BAND_EDGE_M, 0.0, 1.0)
        wave = np.sin(along * 310.0 + 9.0 * np.sin(along * 41.0))
        folds = 1.0 + 0.06 * wave if band.is_cloth else np.ones_like(along)
        color = band.color.astype(np.float32) * folds[..., None]
        albedo += share[..., None] * (color - albedo)


def paint_ring(albedo: FloatImage, points: FloatImage, color: FloatArray, bone_m: FloatArray, size: float) -> None:
    """Paint a ring around the first bone of a finger, from joint to joint (2, 3)."""
    along_m = bone_m[1] - bone_m[0]
    length = float(np.linalg.norm(along_m))
    offset = points - bone_m[0].astype(np.float32)
    along = offset @ (along_m / length).astype(np.float32)
    away = np.sqrt(np.maximum(np.einsum("hwi,hwi->hw", offset, offset) - along * along, 0.0))
    share = np.clip(0.5 + (_RING_M - np.abs(along - np.float32(_RING_SHARE * length))) / _BAND_EDGE_M, 0.0, 1.0)
    share *= away < _RING_AWAY_M * size
    albedo += share[..., None].astype(np.float32) * (color.astype(np.float32) - albedo)


_GLOSS, _GLOSS_POWER = 0.05, 24
_SHADOW_STRENGTH = 0.8
_CORNER_DEPTH_M = 0.02
_COARSE = 3


def shade_skin(albedo: FloatImage, normal: FloatImage, ambient_share: FloatImage, appearance: Appearance) -> FloatImage:
    """Return the linear colour (H, W, 3) of skin under lamp and ambient light, with a faint gloss."""
    facing_lamp = np.clip(normal @ appearance.light_cam.astype(np.float32), 0.0, 1.0)
    # Light scattered inside the skin softens the terminator.
    lambert = np.float32(0.85) * facing_lamp + np.float32(0.15) * np.sqrt(facing_lamp)
    half = appearance.light_cam + np.array([0.0, 0.0, -1.0])
    half = (half / np.linalg.norm(half)).astype(np.float32)
    gloss = np.float32(_GLOSS) * np.clip(normal @ half, 0.0, 1.0) ** _GLOSS_POWER
    facing = (np.float32(0.65) + np.float32(0.35) * np.clip(-normal[..., 2], 0.0, 1.0)) * ambient_share
    out = np.empty_like(albedo)
    for channel in range(3):
        lamp, ambient = np.float32(appearance.lamp[channel]), np.float32(appearance.ambient[channel])
        out[..., channel] = albedo[..., channel] * (lambert * lamp + facing * ambient) + gloss * lamp
    return out


def ambient_occlusion(skin: TracedSurface, background_m: FloatImage) -> FloatImage:
    """Return the share of ambient light per pixel, less where the surroundings are nearer."""
    around = np.where(skin.coverage > 0.5, skin.depth_m, background_m)
    small = around
    if min(around.shape) > 1:  # a hand that leaves the image may have one column left
        small = cv2.resize(around, None, fx=0.5, fy=0.5, interpolation=cv2.INTER_AREA)
    soft = cv2.GaussianBlur(small, (0, 0), 4.0)
    deeper = np.clip((small - soft) / _CORNER_DEPTH_M, 0.0, 1.0)
    size = (around.shape[1], around.shape[0])
    return np.asarray(1.0 - 0.5 * cv2.resize(deeper, size, interpolation=cv2.INTER_LINEAR), dtype=np.float32)


def table_shadow(
    camera: Camera, skin: TracedSurface, to_lamp: FloatArray, table_normal: FloatArray, table_point_m: FloatArray
) -> FloatImage:
    """Return the share of the lamp's light (H, W) on the table; softer the higher the hand is."""
    v, u = np.nonzero(skin.coverage[::_COARSE, ::_COARSE] > 0.5)
    z = skin.depth_m[::_COARSE, ::_COARSE][v, u].astype(np.float64)
    shape = (camera.height_px // _COARSE, camera.width_px // _COARSE)
    small = np.zeros(shape, dtype=np.float32)
    softness_px = 2.0
    if z.size:
        pixel = np.stack((u * _COARSE + skin.box.left, v * _COARSE + skin.box.top), axis=-1).astype(np.float64)
        points = camera.backproject(pixel, z)
        height = (points - table_point_m) @ table_normal
        ground = points - to_lamp * (height / (to_lamp @ table_normal))[:, None]
        spot = np.round(camera.project(ground) / _COARSE).astype(np.int64)
        inside = (spot >= 0).all(axis=1) & (spot[:, 0] < shape[1]) & (spot[:, 1] < shape[0])
        small[spot[inside, 1], spot[inside, 0]] = 1.0
        softness_px += 0.12 * float(np.median(height)) / float(np.median(z)) * camera.fx_px / _COARSE
    soft = cv2.GaussianBlur(cv2.dilate(small, np.ones((3, 3), np.uint8)), (0, 0), softness_px)
    whole = cv2.resize(soft, (camera.width_px, camera.height_px), interpolation=cv2.INTER_LINEAR)
    return np.asarray(1.0 - _SHADOW_STRENGTH * np.minimum(whole, 1.0), dtype=np.float32)


_NOTHING_M = 9.0
_RING_BONE = SEGMENTS.index("PP4")
_PALM_BEND, _DIGIT_BEND = 0.3, 0.6
"""How far paper follows the skin: the back of the hand gives way under it, a knuckle does not."""


@dataclass(frozen=True, slots=True)
class CleanImage:
    """Linear colour (H, W, 3), depth (H, W), and the visible share (M,) of each marker."""

    color: FloatImage
    depth_m: FloatImage
    visible_share: FloatArray


@dataclass(frozen=True, slots=True)
class _SceneSurfaces:
    """Surfaces at one time: skin, rod, and the depth of everything but floating blobs."""

    depth_m: FloatImage
    skin: TracedSurface | None
    rod: TracedSurface | None
    pose: HandPose


class Renderer:
    """Renders one scene at any time."""

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self.appearance: Appearance = sample_appearance(scene)
        self._rows = scene.spec.marker_protocol.sites
        self._blobs = sample_false_blobs(scene)
        self._rod = sample_passing_rod(scene)
        camera = scene.camera
        self._rays = (
            ((np.arange(camera.width_px) - camera.cx_px) / camera.fx_px).astype(np.float32),
            ((np.arange(camera.height_px) - camera.cy_px) / camera.fy_px).astype(np.float32),
        )
        self._up = scene.rotation_w0_cam[:, 2]
        self._table_point_m = scene.to_camera(np.array([0.0, 0.0, scene.table_height_m]))

    def render_depth(self, time_s: float, is_covered: NDArray[np.bool_]) -> FloatImage:
        """Render the depth (H, W) along z, m."""
        surfaces = self._trace_surfaces(time_s)
        self._draw_false_blobs(None, surfaces.depth_m, time_s, surfaces.pose, ("skin", "air"))
        self._draw_markers(None, surfaces.depth_m, surfaces, is_covered)
        return surfaces.depth_m

    def render(self, time_s: float, is_covered: NDArray[np.bool_]) -> CleanImage:
        """Render colour and depth; ``is_covered`` (21,) markers are hidden under a skin-coloured cover."""
        surfaces = self._trace_surfaces(time_s)
        color, depth = self._shade_table(surfaces), surfaces.depth_m
        if surfaces.skin is not None:
            self._draw_skin(color, surfaces, surfaces.skin)
        self._draw_false_blobs(color, depth, time_s, surfaces.pose, ("table", "skin"))
        visible = self._draw_markers(color, depth, surfaces, is_covered)
        if surfaces.rod is not None:
            self._draw_rod(color, depth, surfaces.rod)
        self._draw_false_blobs(color, depth, time_s, surfaces.pose, ("air",))
        return CleanImage(color, depth, visible)

    def _trace_surfaces(self, time_s: float) -> _SceneSurfaces:
        pose = self.scene.pose(np.array([time_s]))
        skin = trace_cones(self.scene.camera, self.scene.cones_cam(pose, 0))
        rod = self._trace_rod(time_s)
        depth = self.appearance.table_depth_m.copy()
        for surface in (skin, rod):
            if surface is not None:
                _merge_nearer(depth, surface)
        return _SceneSurfaces(depth, skin, rod, pose)

    def _trace_rod(self, time_s: float) -> TracedSurface | None:
        ends = None if self._rod is None else self._rod.end_points_w0_m(time_s)
        if ends is None or self._rod is None:
            return None
        a, b = self.scene.to_camera(ends)
        radius, none = np.array([self._rod.radius_m]), np.zeros(1)
        across = np.cross(b - a, [0.0, 0.0, 1.0])
        across = (across / np.linalg.norm(across))[None]
        return trace_cones(self.scene.camera, Cones(a[None], b[None], across, radius, radius, none, none, none))

    def _shade_table(self, surfaces: _SceneSurfaces) -> FloatImage:
        """Return the lit table (H, W, 3) with the hand's shadow."""
        appearance = self.appearance
        facing = np.float32(max(float(self._up @ appearance.light_cam), 0.0))
        if surfaces.skin is None:
            return np.asarray(appearance.table * (facing * appearance.lamp + appearance.ambient).astype(np.float32))
        lit = table_shadow(self.scene.camera, surfaces.skin, appearance.light_cam, self._up, self._table_point_m)
        lamp, ambient = appearance.lamp.astype(np.float32), appearance.ambient.astype(np.float32)
        out = np.empty_like(appearance.table)
        for channel in range(3):  # one at a time: NumPy is slow over rows of three
            out[..., channel] = appearance.table[..., channel] * (facing * lit * lamp[channel] + ambient[channel])
        return out

    def _draw_skin(self, color: FloatImage, surfaces: _SceneSurfaces, skin: TracedSurface) -> None:
        scene, appearance, pose = self.scene, self.appearance, surfaces.pose
        rows, columns = skin.box.slices
        x, y = self._rays[0][None, columns], self._rays[1][rows, None]
        points = np.stack((x * skin.depth_m, y * skin.depth_m, skin.depth_m), axis=-1)
        markers = scene.to_camera(scene.markers_w0_m(pose)[0])
        albedo = skin_albedo(appearance, points, markers, scene.rotation_w0_cam @ pose.rotation_w2_w0[0])
        paint_nails(albedo, scene.camera, skin.box, points, markers, scene.patient.size)
        wrist = scene.to_camera(pose.arm_displacement_m[0])
        paint_bands(albedo, appearance, points, skin.part == Part.FOREARM, wrist, scene.rotation_w0_cam[:, 0])
        if appearance.ring is not None:
            bones = scene.bones_w(pose)
            ends = np.stack((bones.start_m[0, _RING_BONE], bones.end_m[0, _RING_BONE]))
            ends = ends @ pose.rotation_w2_w0[0].T + pose.position_m[0]
            paint_ring(albedo, points, appearance.ring, scene.to_camera(ends), scene.patient.size)
        corners = ambient_occlusion(skin, appearance.table_depth_m[rows, columns])
        inner = color[rows, columns]
        inner += skin.coverage[..., None] * (shade_skin(albedo, skin.normal, corners, appearance) - inner)

    def _draw_markers(
        self, color: FloatImage | None, depth_m: FloatImage, surfaces: _SceneSurfaces, is_covered: NDArray[np.bool_]
    ) -> FloatArray:
        """Draw the markers and return the visible share of each, (M,)."""
        scene, pose = self.scene, surfaces.pose
        centers = scene.to_camera(scene.markers_w0_m(pose)[0])
        normals = scene.marker_normals_w0(pose)[0] @ scene.rotation_w0_cam.T
        front = np.full(surfaces.depth_m.shape, _NOTHING_M, dtype=np.float32)
        if surfaces.rod is not None:
            _merge_nearer(front, surfaces.rod)
        visible = np.zeros(len(self._rows))
        for m, row in enumerate(self._rows):
            if is_covered[row]:
                continue
            bend = _PALM_BEND if row in PALM_SITES else _DIGIT_BEND
            radius_m = float(scene.patient.marker_radius_m[row])
            patch = PaperPatch(centers[row], normals[row], radius_m, self.appearance.paper, bend)
            drawn = self._draw_patch(color, depth_m, patch)
            if drawn is None:
                continue
            place, share, z = drawn
            # Paper area that one pixel sees: z^2 / f^2 over the cosines of ray and normal.
            x, y = self._rays[0][None, place[1]], self._rays[1][place[0], None]
            facing = np.abs(patch.normal[0] * x + patch.normal[1] * y + patch.normal[2])
            area = z**2 / (facing * scene.camera.fx_px * scene.camera.fy_px)
            seen_area = float((share * (z < front[place]) * area).sum())
            visible[m] = min(seen_area / (math.pi * radius_m**2), 1.0)
        return visible

    def _draw_patch(
        self, color: FloatImage | None, depth_m: FloatImage, patch: PaperPatch
    ) -> tuple[tuple[slice, slice], FloatImage, FloatImage] | None:
        """Draw one patch into depth and, if given, colour; None if it is not visible."""
        drawn = project_patch(self.scene.camera, self._rays, depth_m, patch)
        if drawn is not None:
            place, share, z = drawn
            if color is not None:
                lambert = max(float(patch.normal @ self.appearance.light_cam), 0.0)
                light = patch.color * (lambert * self.appearance.lamp + self.appearance.ambient)
                inner = color[place]
                inner += share[..., None] * (light.astype(np.float32) - inner)
            np.copyto(depth_m[place], z, where=share > 0.5)
        return drawn

    def _draw_false_blobs(
        self, color: FloatImage | None, depth_m: FloatImage, time_s: float, pose: HandPose, places: tuple[str, ...]
    ) -> None:
        for blob in self._blobs:
            if blob.place in places and blob.start_s <= time_s <= blob.end_s:
                center, normal = blob.center_m, blob.normal
                if blob.place == "skin":
                    center = pose.rotation_w2_w0[0] @ center + pose.position_m[0]
                    normal = pose.rotation_w2_w0[0] @ normal
                paper = self.appearance.paper * blob.hue_shift
                turned = self.scene.rotation_w0_cam @ normal
                patch = PaperPatch(self.scene.to_camera(center), turned, blob.radius_m, paper, _PALM_BEND)
                self._draw_patch(color, depth_m, patch)

    def _draw_rod(self, color: FloatImage, depth_m: FloatImage, rod: TracedSurface) -> None:
        appearance = self.appearance
        rows, columns = rod.box.slices
        lambert = np.clip(rod.normal @ appearance.light_cam.astype(np.float32), 0.0, 1.0)[..., None]
        shaded = appearance.rod.astype(np.float32) * (lambert * appearance.lamp.astype(np.float32) + appearance.ambient)
        alpha = (rod.coverage * (rod.depth_m <= depth_m[rows, columns] + 1e-3))[..., None]
        inner = color[rows, columns]
        inner += (alpha * (shaded - inner)).astype(np.float32)


def _merge_nearer(depth_m: FloatImage, surface: TracedSurface) -> None:
    inner = depth_m[surface.box.slices]
    np.copyto(inner, surface.depth_m, where=(surface.coverage > 0.5) & (surface.depth_m < inner))
