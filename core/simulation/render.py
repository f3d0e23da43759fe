"""Noise-free pictures of a scene: linear colour, depth, and how much of each disc is seen."""

from __future__ import annotations

import math
from dataclasses import dataclass

import cv2
import numpy as np

from core.camera import Camera
from core.simulation.appearance import Appearance, appearance_of
from core.simulation.patient import DISC_RADIUS_M
from core.simulation.scene import HandPose, Scene
from core.simulation.skin import Cones, Part
from core.simulation.trace import Box, FloatImage, Surface, box_around, trace
from core.simulation.trouble import FalseBlob, PassingThing, false_blobs, passing_thing
from core.simulation.truth import protocol_rows
from core.types import FloatArray

_SPECULAR = 0.05
_SHADOW_STRENGTH = 0.8
_OCCLUSION_REACH_M = 0.02


@dataclass(frozen=True, slots=True)
class CleanPicture:
    """``color`` (H, W, 3) linear light, ``depth_m`` (H, W), ``visible_share`` (M,) of each disc's area."""

    color: FloatImage
    depth_m: FloatImage
    visible_share: FloatArray


class Renderer:
    """Draws one scene at any time. Discs and false blobs are spots on the skin, cut out by a ball of their radius."""

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self.looks: Appearance = appearance_of(scene)
        self._rows = protocol_rows(scene.spec)
        self._blobs = false_blobs(scene)
        self._thing = passing_thing(scene)
        camera = scene.camera
        self._x = ((np.arange(camera.width_px) - camera.cx_px) / camera.fx_px).astype(np.float32)
        self._y = ((np.arange(camera.height_px) - camera.cy_px) / camera.fy_px).astype(np.float32)
        normal = scene.rotation_w0_cam[:, 2]
        self._table_lambert = max(float(normal @ self.looks.light_cam), 0.0)

    def depth(self, time_s: float) -> FloatImage:
        """Depth alone, (H, W) metres along z."""
        return self._geometry(time_s)[0]

    def picture(self, time_s: float, covered: np.ndarray) -> CleanPicture:
        """Colour and depth at one time; ``covered`` (21,) discs that are hidden under skin-coloured cover."""
        depth, skin, thing, pose = self._geometry(time_s)
        looks = self.looks
        lamp = np.broadcast_to(np.float32(self._table_lambert), depth.shape).copy()
        if skin is not None:
            self._cast_shadow(lamp, skin, time_s)
        light = lamp[..., None] * looks.lamp.astype(np.float32) + looks.ambient.astype(np.float32)
        albedo_blobs = [blob for blob in self._blobs if blob.start_s <= time_s <= blob.end_s]
        table = looks.table
        flat = [blob for blob in albedo_blobs if blob.place == "table"]
        if flat:
            table = table.copy()
            for blob in flat:
                self._paint_flat(table, looks.table_depth_m, blob)
        color = table * light
        visible = np.zeros(len(self._rows))
        if skin is not None:
            visible = self._draw_skin(color, skin, thing, pose, covered, albedo_blobs)
        if thing is not None:
            self._draw_thing(color, depth, thing)
        for blob in albedo_blobs:
            if blob.place == "air":
                self._draw_air_blob(color, depth, blob)
        return CleanPicture(color, depth, visible)

    # geometry

    def _geometry(self, time_s: float) -> tuple[FloatImage, Surface | None, Surface | None, HandPose]:
        """Depth of everything but the blobs in the air, skin and passing thing apart."""
        pose = self.scene.pose(np.array([time_s]))
        skin = trace(self.scene.camera, self.scene.cones_cam(pose, 0))
        depth = self.looks.table_depth_m.copy()
        if skin is not None:
            _put_nearer(depth, skin)
        thing = self._thing_surface(time_s)
        if thing is not None:
            _put_nearer(depth, thing)
        return depth, skin, thing, pose

    def _thing_surface(self, time_s: float) -> Surface | None:
        ends = None if self._thing is None else self._thing.ends_w0_m(time_s)
        if ends is None or self._thing is None:
            return None
        a, b = self.scene.to_camera(ends)
        radius = np.array([self._thing.radius_m])
        lateral = np.cross(b - a, [0.0, 0.0, 1.0])
        cones = Cones(
            a[None], b[None], (lateral / np.linalg.norm(lateral))[None], radius, radius, np.zeros(1), np.zeros(1)
        )
        return trace(self.scene.camera, cones)

    # colour

    def _draw_skin(
        self, color: FloatImage, skin: Surface, thing: Surface | None, pose: HandPose, covered: np.ndarray,
        blobs: list[FalseBlob],
    ) -> FloatArray:  # fmt: skip
        """Shade hand and forearm into ``color``; returns the visible share of each disc."""
        scene, looks = self.scene, self.looks
        rows, columns = skin.box.slices
        x, y = self._x[None, columns], self._y[rows, None]
        points = np.stack((x * skin.depth_m, y * skin.depth_m, skin.depth_m), axis=-1)
        normal = surface_normal(scene.camera, skin.depth_m, x, y)
        albedo = np.broadcast_to(looks.skin.astype(np.float32), points.shape).copy()
        discs_w0 = scene.discs_w0_m(pose)[0]
        self._redden(albedo, points, scene.to_camera(discs_w0))
        self._dress(albedo, points, skin, pose)
        seen = skin.coverage > 0.5
        if thing is not None:
            at_thing = np.full(scene.camera.height_px * scene.camera.width_px, 9.0, dtype=np.float32)
            front = at_thing.reshape(scene.camera.height_px, scene.camera.width_px)
            _put_nearer(front, thing)
            seen &= skin.depth_m < front[rows, columns]
        visible = np.zeros(len(self._rows))
        for m, row in enumerate(self._rows):
            center = scene.to_camera(discs_w0[row])
            spot = self._spot(skin.box, points, center, DISC_RADIUS_M)
            if spot is None:
                continue
            place, share = spot
            if not covered[row]:
                albedo[place] += share[..., None] * (looks.paper.astype(np.float32) - albedo[place])
                tilt = np.maximum(np.abs(np.sum(normal[place] * points[place], axis=-1)), 1e-3)
                z = points[place][..., 2]
                area = z**3 / (scene.camera.fx_px * scene.camera.fy_px) / tilt
                seen_area = float((share * seen[place] * np.minimum(area, 1.5e-5)).sum())
                visible[m] = min(seen_area / (math.pi * DISC_RADIUS_M**2), 1.0)
        for blob in blobs:
            if blob.place == "skin":
                center_w0 = pose.rotation_w2_w0[0] @ blob.center_m + pose.position_m[0]
                spot = self._spot(skin.box, points, scene.to_camera(center_w0), blob.radius_m)
                if spot is not None:
                    place, share = spot
                    paper = (looks.paper * blob.hue_shift).astype(np.float32)
                    albedo[place] += share[..., None] * (paper - albedo[place])
        facing_lamp = np.clip(normal @ looks.light_cam.astype(np.float32), 0.0, 1.0)
        # Light scattered inside the skin softens the terminator.
        lambert = np.float32(0.85) * facing_lamp + np.float32(0.15) * np.sqrt(facing_lamp)
        occlusion = self._occlusion(skin)
        half = looks.light_cam + np.array([0.0, 0.0, -1.0])
        half = (half / np.linalg.norm(half)).astype(np.float32)
        gloss = _SPECULAR * np.clip(normal @ half, 0.0, 1.0) ** 24
        facing = 0.65 + 0.35 * np.clip(-normal[..., 2], 0.0, 1.0)
        lamp, ambient = looks.lamp.astype(np.float32), looks.ambient.astype(np.float32)
        shaded = albedo * (lambert[..., None] * lamp + (facing * occlusion)[..., None] * ambient)
        shaded += gloss[..., None] * lamp
        alpha = skin.coverage[..., None]
        color[rows, columns] += alpha * (shaded - color[rows, columns])
        return visible

    def _spot(
        self, box: Box, points: FloatImage, center: FloatArray, radius_m: float
    ) -> tuple[tuple[slice, slice], FloatImage] | None:
        """Where in ``points`` (over ``box``) the skin lies within a radius of a point, and how much of each pixel."""
        around = box_around(self.scene.camera, center[None], np.array([radius_m]), margin_px=2.0)
        around = Box(
            max(around.top, box.top), min(around.bottom, box.bottom),
            max(around.left, box.left), min(around.right, box.right),
        )  # fmt: skip
        if around.bottom - around.top < 3 or around.right - around.left < 3:
            return None
        place = around.within(box)
        away = np.linalg.norm(points[place] - center.astype(np.float32), axis=-1)
        along_v, along_u = np.gradient(away)
        # Within half a pixel of the edge the spot fills part of a pixel.
        share = np.clip(0.5 - (away - radius_m) / np.maximum(np.hypot(along_u, along_v), 1e-5), 0.0, 1.0)
        return place, share.astype(np.float32)

    def _redden(self, albedo: FloatImage, points: FloatImage, discs: FloatArray) -> None:
        """Knuckles are a little redder and darker than the rest; fixed to the hand."""
        coarse = points[::2, ::2]
        tint = np.zeros(coarse.shape[:2], dtype=np.float32)
        for row in (2, 3, *range(5, 21)):
            gap = np.sum((coarse - discs[row].astype(np.float32)) ** 2, axis=-1)
            tint += np.exp(gap * np.float32(-1.0 / (2.0 * 0.008**2)))
        size = (albedo.shape[1], albedo.shape[0])
        full = cv2.resize(np.minimum(tint, 1.0), size, interpolation=cv2.INTER_LINEAR)
        albedo *= 1.0 - full[..., None] * np.array([0.05, 0.14, 0.13], dtype=np.float32)

    def _dress(self, albedo: FloatImage, points: FloatImage, skin: Surface, pose: HandPose) -> None:
        """The sleeve, from its start on up the forearm."""
        start_m = self.looks.sleeve_start_m
        if start_m is None:
            return
        axis = self.scene.rotation_w0_cam[:, 0].astype(np.float32)
        wrist = self.scene.to_camera(pose.carry_m[0]).astype(np.float32)
        along = (points - wrist) @ axis + np.float32(start_m)
        share = np.clip(0.5 - along / 0.0012, 0.0, 1.0) * (skin.part == Part.FOREARM)
        folds = 1.0 + 0.06 * np.sin(along * 310.0 + 9.0 * np.sin(along * 41.0))
        cloth = self.looks.sleeve.astype(np.float32) * folds[..., None]
        albedo += share[..., None] * (cloth - albedo)

    def _occlusion(self, skin: Surface) -> FloatImage:
        """Corners between fingers get less light from around: depth against its own blurred neighbourhood."""
        rows, columns = skin.box.slices
        around = np.where(skin.coverage > 0.5, skin.depth_m, self.looks.table_depth_m[rows, columns])
        small = cv2.resize(around, None, fx=0.5, fy=0.5, interpolation=cv2.INTER_AREA)
        soft = cv2.GaussianBlur(small, (0, 0), 4.0)
        deeper = np.clip((small - soft) / _OCCLUSION_REACH_M, 0.0, 1.0)
        deeper = cv2.resize(deeper, (around.shape[1], around.shape[0]), interpolation=cv2.INTER_LINEAR)
        return np.asarray(1.0 - 0.5 * deeper, dtype=np.float32)

    def _cast_shadow(self, lamp: FloatImage, skin: Surface, time_s: float) -> None:
        """Dim the lamp on the table where hand and forearm stand before it, softer the higher they are."""
        camera, looks = self.scene.camera, self.looks
        step = 3
        depth, cover = skin.depth_m[::step, ::step], skin.coverage[::step, ::step] > 0.5
        v, u = np.nonzero(cover)
        z = depth[v, u].astype(np.float64)
        pixel = np.stack((u * step + skin.box.left, v * step + skin.box.top), axis=-1).astype(np.float64)
        points = camera.back_project(pixel, z)
        normal = self.scene.rotation_w0_cam[:, 2]
        table = self.scene.to_camera(np.array([0.0, 0.0, self.scene.table_height_m]))
        height = (points - table) @ normal
        ground = points - looks.light_cam * (height / (looks.light_cam @ normal))[:, None]
        spot = np.round(camera.project(ground) / step).astype(np.int64)
        small = np.zeros((camera.height_px // step, camera.width_px // step), dtype=np.float32)
        inside = (spot >= 0).all(axis=1) & (spot[:, 0] < small.shape[1]) & (spot[:, 1] < small.shape[0])
        small[spot[inside, 1], spot[inside, 0]] = 1.0
        softness_px = 2.0 + 0.12 * float(np.median(height)) / float(np.median(z)) * camera.fx_px / step
        soft = cv2.GaussianBlur(cv2.dilate(small, np.ones((3, 3), np.uint8)), (0, 0), softness_px)
        whole = cv2.resize(soft, (camera.width_px, camera.height_px), interpolation=cv2.INTER_LINEAR)
        lamp *= 1.0 - _SHADOW_STRENGTH * np.minimum(whole, 1.0)

    def _draw_thing(self, color: FloatImage, depth: FloatImage, thing: Surface) -> None:
        looks = self.looks
        rows, columns = thing.box.slices
        x, y = self._x[None, columns], self._y[rows, None]
        normal = surface_normal(self.scene.camera, thing.depth_m, x, y)
        lambert = np.clip(normal @ looks.light_cam.astype(np.float32), 0.0, 1.0)[..., None]
        shaded = looks.thing.astype(np.float32) * (lambert * looks.lamp.astype(np.float32) + looks.ambient)
        alpha = (thing.coverage * (thing.depth_m <= depth[rows, columns] + 1e-3))[..., None]
        color[rows, columns] += (alpha * (shaded - color[rows, columns])).astype(np.float32)

    def _paint_flat(self, table: FloatImage, table_depth_m: FloatImage, blob: FalseBlob) -> None:
        """A spot on the table's own paint."""
        center = self.scene.to_camera(blob.center_m)
        box = box_around(self.scene.camera, center[None], np.array([blob.radius_m]), margin_px=3.0)
        if box.is_empty:
            return
        rows, columns = box.slices
        z = table_depth_m[rows, columns]
        points = np.stack((self._x[None, columns] * z, self._y[rows, None] * z, z), axis=-1)
        spot = self._spot(box, points, center, blob.radius_m)
        if spot is not None:
            place, share = spot
            inner = table[rows, columns][place]
            inner += share[..., None] * ((self.looks.paper * blob.hue_shift).astype(np.float32) - inner)

    def _draw_air_blob(self, color: FloatImage, depth: FloatImage, blob: FalseBlob) -> None:
        """A floating disc, in front of what lies behind it."""
        camera, looks = self.scene.camera, self.looks
        center = self.scene.to_camera(blob.center_m)
        box = box_around(camera, center[None], np.array([blob.radius_m]), margin_px=3.0)
        if box.bottom - box.top < 3 or box.right - box.left < 3:
            return
        normal = self.scene.rotation_w0_cam @ blob.normal
        rows, columns = box.slices
        x, y = self._x[None, columns], self._y[rows, None]
        z = (center @ normal / (normal[0] * x + normal[1] * y + normal[2])).astype(np.float32)
        points = np.stack((x * z, y * z, z), axis=-1)
        spot = self._spot(box, points, center, blob.radius_m)
        if spot is None:
            return
        place, share = spot
        z = z[place]
        behind = depth[rows, columns][place]
        share = share * (z < behind)
        light = max(float(normal @ looks.light_cam), 0.0) * looks.lamp + looks.ambient
        paint = (looks.paper * blob.hue_shift * light).astype(np.float32)
        inner = color[rows, columns][place]
        inner += share[..., None] * (paint - inner)
        np.copyto(behind, z, where=share > 0.5)


def surface_normal(camera: Camera, depth_m: FloatImage, x: FloatImage, y: FloatImage) -> FloatImage:
    """Unit normals (H, W, 3) towards the camera; at an edge the slope of the smoother side counts."""
    slope_u = _slope(depth_m, 1) * np.float32(camera.fx_px)
    slope_v = _slope(depth_m, 0) * np.float32(camera.fy_px)
    normal = np.stack((slope_u, slope_v, -(depth_m + x * slope_u + y * slope_v)), axis=-1)
    normal /= np.sqrt(np.sum(normal * normal, axis=-1, keepdims=True))
    return np.asarray(normal, dtype=np.float32)


def _slope(z: FloatImage, axis: int) -> FloatImage:
    step = np.diff(z, axis=axis)
    ends = [(0, 0), (0, 0)]
    ends[axis] = (1, 0)
    before = np.pad(step, ends, mode="edge")
    ends[axis] = (0, 1)
    after = np.pad(step, ends, mode="edge")
    return np.asarray(np.where(np.abs(before) < np.abs(after), before, after))


def _put_nearer(depth: FloatImage, surface: Surface) -> None:
    rows, columns = surface.box.slices
    inner = depth[rows, columns]
    np.copyto(inner, surface.depth_m, where=(surface.coverage > 0.5) & (surface.depth_m < inner))


__all__ = ["CleanPicture", "PassingThing", "Renderer", "surface_normal"]
