"""Sphere tracing of the skin (:mod:`core.simulation.skin`) along camera rays.

Each cone is evaluated only where its bounding sphere is visible.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import reduce

import numpy as np
from numpy.typing import NDArray

from carpus.core.model.camera import Camera
from carpus.core.model.types import FloatArray
from carpus.core.simulation.skin import BLEND_M, FINGER_BLEND_M, Cones, Part

FloatImage = NDArray[np.float32]

_STEPS = 7
_MIN_APPROACH = np.float32(0.35)
"""A grazing ray approaches slowly; steps are lengthened up to the inverse of this."""
_FAR_M = np.float32(9.0)
_PROBE_M = 5e-4
"""Step of the numerical normal, well above single precision."""


@dataclass(frozen=True, slots=True)
class Box:
    """Rows and columns of a part of an image, ends excluded."""

    top: int
    bottom: int
    left: int
    right: int

    @property
    def slices(self) -> tuple[slice, slice]:
        return slice(self.top, self.bottom), slice(self.left, self.right)

    @property
    def is_empty(self) -> bool:
        return self.bottom <= self.top or self.right <= self.left

    def relative_slices(self, outer: Box) -> tuple[slice, slice]:
        """Return the slices of this box inside arrays that cover ``outer``."""
        return (
            slice(self.top - outer.top, self.bottom - outer.top),
            slice(self.left - outer.left, self.right - outer.left),
        )

    def union(self, other: Box) -> Box:
        """Return the smallest box that holds both."""
        if other.is_empty:
            return self
        if self.is_empty:
            return other
        return Box(
            min(self.top, other.top), max(self.bottom, other.bottom),
            min(self.left, other.left), max(self.right, other.right),
        )  # fmt: skip


@dataclass(frozen=True, slots=True)
class TracedSurface:
    """Visible surface inside ``box``.

    ``depth_m`` is where each ray meets it or passes nearest, ``coverage`` 0 to 1 of each pixel, ``normal`` (H, W, 3)
    outwards, ``part`` the nearest :class:`Part`.
    """

    box: Box
    depth_m: FloatImage
    coverage: FloatImage
    normal: FloatImage
    part: NDArray[np.uint8]


def bounding_box(camera: Camera, center_m: FloatArray, radius_m: FloatArray, margin_px: float = 1.0) -> Box:
    """Return the box of the image that holds spheres (K, 3) of radii (K,) in the camera."""
    near = np.maximum(center_m[:, 2] - radius_m, 0.05)
    reach_px = radius_m / near * camera.fx_px * 1.15 + margin_px
    pixel = camera.project(np.column_stack((center_m[:, :2], np.maximum(center_m[:, 2], 0.05))))
    low = np.floor((pixel - reach_px[:, None]).min(axis=0))
    high = np.ceil((pixel + reach_px[:, None]).max(axis=0)) + 1
    return Box(
        int(max(low[1], 0)),
        int(min(high[1], camera.height_px)),
        int(max(low[0], 0)),
        int(min(high[0], camera.width_px)),
    )


def _cone_parameters(cones: Cones) -> FloatArray:
    """Return what rendering needs of each cone, (P, 18).

    Axes (3, 3) in rows, ``a_m`` along them, length, half width and its slope, radius, taper, lean of the normal.
    """
    along = cones.b_m - cones.a_m
    length = np.linalg.norm(along, axis=1)
    along = along / length[:, None]
    lateral = cones.lateral - np.vecdot(cones.lateral, along)[:, None] * along
    lateral /= np.linalg.norm(lateral, axis=1)[:, None]
    axes = np.stack((along, lateral, np.cross(along, lateral)), axis=1)
    taper = (cones.radius_a_m - cones.radius_b_m) / length
    widening = (cones.width_b_m - cones.width_a_m) / length
    sizes = (length, cones.width_a_m, widening, cones.radius_a_m, taper, taper / np.sqrt(1.0 - taper * taper))
    return np.hstack((axes.reshape(-1, 9), np.vecdot(axes, cones.a_m[:, None]), np.column_stack(sizes)))


class _VisibleCone:
    """Cone prepared for an image: the rays' components along its axes, over its box."""

    def __init__(self, parameters: FloatArray, part: Part, x: FloatImage, y: FloatImage, box: Box) -> None:
        self.axes, self.origin = parameters[:9].reshape(3, 3), parameters[9:12]
        rows, columns = box.slices
        self.ray = [
            (np.float32(e[0]) * x[None, columns] + (np.float32(e[1]) * y[rows, None] + np.float32(e[2])))
            for e in self.axes
        ]
        self.length, self.width, self.widening, self.radius, self.taper, self.lean = parameters[12:].astype(np.float32)
        self.box, self.part = box, part

    def distance(self, z: FloatImage, offset_m: FloatArray) -> FloatImage:
        """Return the signed distance at depth z along each ray, displaced by ``offset_m`` (3,).

        In single precision and over the box only; see :func:`skin.cone_distances`.
        """
        origin = (self.origin - self.axes @ offset_m).astype(np.float32)
        along = z * self.ray[0]
        along -= origin[0]
        side = z * self.ray[1]
        side -= origin[1]
        if self.widening == 0.0:
            side -= np.clip(side, -self.width, self.width)
        else:
            half_width = np.clip(along, np.float32(0.0), self.length)
            half_width *= self.widening
            half_width += self.width
            side -= np.clip(side, -half_width, half_width)
        up = z * self.ray[2]
        up -= origin[2]
        up *= up
        side *= side
        up += side
        radial = np.sqrt(up)
        foot = np.clip(along - self.lean * radial, np.float32(0.0), self.length)
        along -= foot
        along *= along
        along += up
        np.sqrt(along, out=along)
        foot *= self.taper
        along += foot
        along -= self.radius
        return along


def _smooth_minimum(a: FloatImage, b: FloatImage, reach: float) -> FloatImage:
    near = np.abs(a - b)
    np.subtract(np.float32(reach), near, out=near)
    np.maximum(near, np.float32(0.0), out=near)
    near *= near
    near *= np.float32(0.25 / reach)
    return np.asarray(np.minimum(a, b) - near)


def trace_cones(camera: Camera, cones: Cones) -> TracedSurface | None:
    """Trace the skin that the camera sees; None if it is outside the image."""
    x = ((np.arange(camera.width_px) - camera.cx_px) / camera.fx_px).astype(np.float32)
    y = ((np.arange(camera.height_px) - camera.cy_px) / camera.fy_px).astype(np.float32)
    reach = np.maximum(cones.radius_a_m + cones.width_a_m, cones.radius_b_m + cones.width_b_m)
    near_m = max(float((np.minimum(cones.a_m[:, 2], cones.b_m[:, 2]) - reach).min()), 0.1)
    places = _visible_boxes(camera, cones)
    if not places:
        return None
    whole = reduce(Box.union, places.values())
    numbers = _cone_parameters(cones)[list(places)]
    seen = [_VisibleCone(numbers[k], Part(int(cones.part[i])), x, y, box) for k, (i, box) in enumerate(places.items())]
    return _trace_rays(seen, whole, x, y, near_m, camera.fx_px)


def _visible_boxes(camera: Camera, cones: Cones) -> dict[int, Box]:
    """Return the box of each cone that may be visible, by its row."""
    out: dict[int, Box] = {}
    for i in range(len(cones)):
        wider = max(cones.width_a_m[i], cones.width_b_m[i]) + max(BLEND_M.values())
        radius = np.array([cones.radius_a_m[i], cones.radius_b_m[i]]) + wider
        box = bounding_box(camera, np.array([cones.a_m[i], cones.b_m[i]]), radius)
        if not box.is_empty:
            out[i] = box
    return out


def _trace_rays(
    visible: list[_VisibleCone], whole: Box, x: FloatImage, y: FloatImage, near_m: float, fx_px: float
) -> TracedSurface:
    """Trace the union of all cones along the rays x, y of ``whole``, from depth ``near_m`` on."""
    part_box: dict[Part, Box] = {}
    for cone in visible:
        part_box[cone.part] = part_box.get(cone.part, Box(0, 0, 0, 0)).union(cone.box)
    rows, columns = whole.slices
    per_length = 1.0 / np.sqrt(1.0 + x[None, columns] ** 2 + y[rows, None] ** 2)
    z = np.full(per_length.shape, near_m, dtype=np.float32)
    best = np.full(z.shape, _FAR_M, dtype=np.float32)
    depth = z.copy()
    stretch = np.ones_like(z)
    part_image = np.zeros(z.shape, dtype=np.uint8)
    before = best
    for step in range(_STEPS):
        distance = _union_distance(visible, part_box, whole, z, np.zeros(3), part_image if step == _STEPS - 1 else None)
        size = np.abs(distance)
        closer = size < best
        np.copyto(depth, z, where=closer)
        np.copyto(best, size, where=closer)
        if step > 0:
            approach = (before - distance) / np.maximum(before * stretch, np.float32(1e-6))
            stretch = np.float32(1.0) / np.clip(approach, _MIN_APPROACH, np.float32(1.0))
        z = z + distance * stretch * per_length
        before = distance
    pixel_m = depth / np.float32(fx_px)
    coverage = np.clip(1.0 - best / (0.8 * pixel_m), 0.0, 1.0, dtype=np.float32)
    normal = np.stack(
        [_union_distance(visible, part_box, whole, depth, offset) for offset in np.eye(3) * _PROBE_M], axis=-1
    )
    normal -= _union_distance(visible, part_box, whole, depth, np.zeros(3))[..., None]
    length = np.sqrt(np.einsum("hwi,hwi->hw", normal, normal))
    normal /= np.maximum(length, np.float32(1e-9))[..., None]
    return TracedSurface(whole, depth, coverage, normal, part_image)


def _union_distance(
    visible: list[_VisibleCone],
    part_box: dict[Part, Box],
    whole: Box,
    z: FloatImage,
    offset_m: FloatArray,
    part_image: NDArray[np.uint8] | None = None,
) -> FloatImage:
    """Return the distance to the skin at depths z of every ray, as :func:`skin.skin_distance`.

    Writes the nearest part into ``part_image`` if given.
    """
    palm = np.full(z.shape, _FAR_M, dtype=np.float32)
    others = {
        part: np.full(z[box.relative_slices(whole)].shape, _FAR_M, dtype=np.float32)
        for part, box in part_box.items()
        if part is not Part.PALM
    }
    for cone in visible:
        place = cone.box.relative_slices(whole)
        d = cone.distance(z[place], offset_m)
        if cone.part is Part.PALM:
            palm[place] = _smooth_minimum(palm[place], d, BLEND_M[Part.PALM])
        else:
            inner = cone.box.relative_slices(part_box[cone.part])
            np.minimum(others[cone.part][inner], d, out=others[cone.part][inner])
    out = palm.copy()
    for part, d in others.items():
        place = part_box[part].relative_slices(whole)
        np.minimum(out[place], _smooth_minimum(palm[place], d, BLEND_M.get(part, FINGER_BLEND_M)), out=out[place])
    if part_image is not None:
        nearest = palm.copy()
        for part, d in others.items():
            place = part_box[part].relative_slices(whole)
            part_image[place][d < nearest[place]] = int(part)
            np.minimum(nearest[place], d, out=nearest[place])
    return out
