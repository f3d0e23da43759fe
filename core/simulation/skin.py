"""Skin of hand and forearm as a smooth union of rounded bones.

Every body part is a set of flattened round cones: the points within a radius, linear from ``radius_a`` to ``radius_b``,
of a segment a-b that is widened sideways by a half width, linear too. Parts are united by a smooth minimum of finite
reach (:func:`smooth_minimum`), so that bending a finger does not touch the skin over the fixed unit. On a rigid hand
the palm's markers stay exactly on the rendered surface; a soft one has a palm that cups (:meth:`HandSkin.cones_w`) and
markers that follow it (:func:`project_to_surface`).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

from carpus.core.model import so3
from carpus.core.model.hand.anatomy import anatomy_from_size
from carpus.core.model.hand.kinematics import SEGMENTS, disc_centres, segment_frames
from carpus.core.model.hand.protocols import PALM_SITES
from carpus.core.model.types import FloatArray
from carpus.core.simulation.hand_motion import TissueState
from carpus.core.simulation.patient import WRIST_JOINT_DEPTH_M, SimulatedPatient


class Part(IntEnum):
    """Body parts in the order of their union; THUMB to LITTLE join the palm but not one another."""

    PALM = 0
    THUMB = 1
    INDEX = 2
    MIDDLE = 3
    RING = 4
    LITTLE = 5
    FOREARM = 6


BLEND_M = {Part.PALM: 0.005, Part.THUMB: 0.006, Part.FOREARM: 0.006}
"""Reach of the smooth union: within the palm, and of thumb and forearm with the palm."""
FINGER_BLEND_M = 0.005

# Thumb, index, middle, ring, little of a hand 180 mm long; widths at the four joints.
_BASE_RADIUS_M = (0.0080, 0.0080, 0.0082, 0.0080, 0.0072)
_DIGIT_WIDTH_M = (
    (0.0045, 0.0045, 0.0042, 0.0022),
    (0.0032, 0.0030, 0.0026, 0.0016),
    (0.0032, 0.0030, 0.0026, 0.0016),
    (0.0030, 0.0028, 0.0024, 0.0015),
    (0.0026, 0.0023, 0.0020, 0.0012),
)
_THUMB_BASE_TILT_RAD = np.radians(20.0)
_BEYOND_NAIL = 0.32

_NEWTON_STEPS = 2
_SLOPE_STEP_M = 1e-6

_METACARPALS = slice(2, 6)
_RING_METACARPAL, _LITTLE_METACARPAL, _SLAB, _HYPOTHENAR = 4, 5, 6, 7
"""Rows of the palm's cones."""
_CUP_AXES = np.array([[0.25, 0.97, 0.0], [0.36, 0.93, 0.0]])
"""Axes of a right hand's metacarpals 4 and 5: they flex and turn towards the thumb."""
_SLAB_ROLL = 0.8
"""Roll of the flesh between the metacarpals per angle of the little one's."""
_KNUCKLE_REACH_M = 0.004
"""How far a metacarpal's head stands out beyond the marker when its finger is flexed."""


@dataclass(frozen=True, slots=True)
class Cones:
    """P flattened round cones in one frame; all arrays but ``part`` may have leading axes, the poses.

    Attributes
    ----------
    a_m, b_m, lateral : (P, 3) ends of the axis, unit vector across it
    radius_a_m, radius_b_m, width_a_m, width_b_m : (P,) radii and half widths
    part : (P,) of :class:`Part`
    """

    a_m: FloatArray
    b_m: FloatArray
    lateral: FloatArray
    radius_a_m: FloatArray
    radius_b_m: FloatArray
    width_a_m: FloatArray
    width_b_m: FloatArray
    part: FloatArray

    def transform(self, rotation: FloatArray, translation_m: FloatArray) -> Cones:
        """Transform to another frame: p' = rotation p + translation."""
        return replace(
            self,
            a_m=self.a_m @ rotation.T + translation_m,
            b_m=self.b_m @ rotation.T + translation_m,
            lateral=self.lateral @ rotation.T,
        )

    def broadcast(self, lead: tuple[int, ...]) -> Cones:
        """Broadcast to poses of leading shape ``lead``."""

        def broadcast_array(values: FloatArray) -> FloatArray:
            return np.broadcast_to(values, (*lead, *values.shape)).copy()

        return self._rearrange(broadcast_array, broadcast_array, self.part)

    def select(self, rows: NDArray[np.bool_]) -> Cones:
        """Return some of the cones (P,)."""
        return self._rearrange(lambda points: points[..., rows, :], lambda sizes: sizes[..., rows], self.part[rows])

    def regroup(self, groups: int) -> Cones:
        """Split into equal successive groups along a further leading axis."""
        count = len(self) // groups

        def points(values: FloatArray) -> FloatArray:
            return values.reshape(*values.shape[:-2], groups, count, 3)

        def sizes(values: FloatArray) -> FloatArray:
            return values.reshape(*values.shape[:-1], groups, count)

        return self._rearrange(points, sizes, self.part.reshape(groups, count))

    def _rearrange(
        self, points: Callable[[FloatArray], FloatArray], sizes: Callable[[FloatArray], FloatArray], part: FloatArray
    ) -> Cones:
        """Apply functions to all points and to all sizes."""
        a, b, lateral = map(points, (self.a_m, self.b_m, self.lateral))
        radius_a, radius_b = map(sizes, (self.radius_a_m, self.radius_b_m))
        width_a, width_b = map(sizes, (self.width_a_m, self.width_b_m))
        return Cones(a, b, lateral, radius_a, radius_b, width_a, width_b, part)

    def rotate(self, rows: NDArray[np.int64], rotation: FloatArray, pivot_m: FloatArray) -> None:
        """Rotate some cones in place by rotations (..., 3, 3) about a point."""
        for points in (self.a_m, self.b_m):
            points[..., rows, :] = _rotate_points(points[..., rows, :], rotation, pivot_m)
        self.lateral[..., rows, :] = _rotate_points(self.lateral[..., rows, :], rotation, np.zeros(3))

    def __len__(self) -> int:
        return len(self.part)


def _rotate_points(point_m: FloatArray, rotation: FloatArray, pivot_m: FloatArray) -> FloatArray:
    """Rotate points (..., K, 3) by rotations (..., 3, 3) about a point."""
    return np.asarray((point_m - pivot_m) @ np.swapaxes(rotation, -1, -2) + pivot_m)


def join_cones(*sets: Cones) -> Cones:
    """Join several sets of the same poses."""

    def concatenate(name: str) -> FloatArray:
        values = [getattr(one, name) for one in sets]
        return np.asarray(np.concatenate(values, axis=-2 if name in ("a_m", "b_m", "lateral") else -1))

    return Cones(*(concatenate(name) for name in Cones.__slots__))


def cone_distances(point_m: FloatArray, cones: Cones) -> FloatArray:
    """Return the signed distances (..., K, P) of points (..., K, 3) to every cone, m, negative inside."""
    along_axis = cones.b_m - cones.a_m
    length = np.linalg.norm(along_axis, axis=-1)
    axis = along_axis / length[..., None]
    lateral = cones.lateral - np.sum(cones.lateral * axis, axis=-1, keepdims=True) * axis
    lateral = lateral / np.linalg.norm(lateral, axis=-1, keepdims=True)
    axes = np.stack((axis, lateral, np.cross(axis, lateral)), axis=-2)
    local = point_m[..., :, None, :] - cones.a_m[..., None, :, :]
    along, side, up = (np.einsum("...kpj,...pj->...kp", local, axes[..., i, :]) for i in range(3))
    length = length[..., None, :]
    width_a, width_b = cones.width_a_m[..., None, :], cones.width_b_m[..., None, :]
    radius_a, radius_b = cones.radius_a_m[..., None, :], cones.radius_b_m[..., None, :]
    half_width = width_a + np.clip(along / length, 0.0, 1.0) * (width_b - width_a)
    side = side - np.clip(side, -half_width, half_width)
    radial = np.hypot(side, up)
    taper = (radius_a - radius_b) / length
    foot = np.clip(along - radial * taper / np.sqrt(1.0 - taper * taper), 0.0, length)
    return np.asarray(np.hypot(along - foot, radial) - (radius_a - taper * foot))


def smooth_minimum(a: FloatArray, b: FloatArray, reach: float | FloatArray) -> FloatArray:
    """Return the minimum with a fillet where a and b differ by less than ``reach``."""
    near = np.maximum(reach - np.abs(a - b), 0.0)
    return np.asarray(np.minimum(a, b) - near * near * (0.25 / reach))


def skin_distance(point_m: FloatArray, cones: Cones) -> FloatArray:
    """Return the signed distance of points (..., 3) to the rendered skin."""
    palm, digits = _part_distances(cone_distances(point_m.reshape(-1, 3), cones), cones.part)
    out = palm
    for part, distance in digits.items():
        out = np.minimum(out, smooth_minimum(palm, distance, BLEND_M.get(part, FINGER_BLEND_M)))
    return np.asarray(out.reshape(point_m.shape[:-1]))


def _part_distances(distance: FloatArray, part_of_cone: FloatArray) -> tuple[FloatArray, dict[Part, FloatArray]]:
    """Return the distance to the palm and to each other part from those (..., P) to the cones."""
    palm: FloatArray | None = None
    others: dict[Part, FloatArray] = {}
    for i, number in enumerate(part_of_cone):
        part, d = Part(int(number)), distance[..., i]
        if part is Part.PALM:
            palm = d if palm is None else smooth_minimum(palm, d, BLEND_M[part])
        else:
            others[part] = d if part not in others else np.minimum(others[part], d)
    assert palm is not None
    return palm, others


class _MarkerSupport:
    """Palm, and each finger for its own markers: another finger over a marker hides it, but does not carry it."""

    def __init__(self, cones: Cones) -> None:
        self._palm = cones.select(cones.part == Part.PALM)
        digits = cones.select((cones.part >= Part.THUMB) & (cones.part <= Part.LITTLE))
        self._digits = digits.regroup(5)
        self._blend_m = np.array([BLEND_M.get(Part(n), FINGER_BLEND_M) for n in range(Part.THUMB, Part.FOREARM)])

    def distance(self, marker_m: FloatArray) -> FloatArray:
        """Return the signed distance (..., 21) of markers (..., 21, 3) to their support."""
        to_cones = cone_distances(marker_m, self._palm)
        out = to_cones[..., 0]
        for i in range(1, to_cones.shape[-1]):
            out = smooth_minimum(out, to_cones[..., i], BLEND_M[Part.PALM])
        on_digits = marker_m[..., 1:, :].reshape(*marker_m.shape[:-2], 5, 4, 3)
        digit = cone_distances(on_digits, self._digits).min(axis=-1)
        palm = out[..., 1:].reshape(digit.shape)
        carried = smooth_minimum(palm, digit, self._blend_m[:, None])
        return np.concatenate((out[..., :1], carried.reshape(*marker_m.shape[:-2], 20)), axis=-1)

    def gradient(self, marker_m: FloatArray, distance: FloatArray) -> FloatArray:
        """Return its gradient (..., 21, 3)."""
        steps = _SLOPE_STEP_M * np.eye(3)
        return np.stack([self.distance(marker_m + step) - distance for step in steps], axis=-1) / _SLOPE_STEP_M


def project_to_surface(marker_m: FloatArray, cones: Cones) -> tuple[FloatArray, FloatArray]:
    """Return the nearest points on palm and own finger to markers (..., 21, 3), and unit normals."""
    support, place = _MarkerSupport(cones), marker_m
    step = normal = np.zeros_like(marker_m)
    for _ in range(_NEWTON_STEPS):
        distance = support.distance(place)
        slope = support.gradient(place, distance)
        steepness = np.linalg.norm(slope, axis=-1, keepdims=True)
        normal = slope / np.maximum(steepness, 1e-12)
        step = normal / np.maximum(steepness, 0.3)
        place = place - distance[..., None] * step
    # The point is near now: the last gradient will do.
    return place - support.distance(place)[..., None] * step, normal


class HandSkin:
    """Skin of one patient, posed for every frame."""

    def __init__(self, patient: SimulatedPatient, knuckle_rise_m: float = 0.0) -> None:
        self._patient = patient
        self._knuckle_rise_m = knuckle_rise_m
        self._size = patient.size
        self._mirror = np.array([1.0, -1.0 if patient.anatomy.side == "left" else 1.0, 1.0])
        offset = anatomy_from_size(patient.anatomy.hand_length_m, nail_discs=True).skin_offset_m
        # With the patient's own offsets the bones lie in the joints; the papers' chain has none, so the usual thickness
        # of flesh lies under the markers.
        own = patient.anatomy.skin_offset_m
        self._radius = np.where(own > 0.0, own, offset)
        self._palm = self._fit_palm()
        self.pivots_m = self._palm.a_m[[_RING_METACARPAL, _LITTLE_METACARPAL]]
        """Bases (2, 3) in W of metacarpals 4 and 5, about which these flex."""

    def cones_w(self, joint_angles_rad: FloatArray, tissue: TissueState | None = None) -> Cones:
        """Return palm, thumb and fingers in W for joint angles (..., J) and the tissue of a soft hand."""
        digits = self._digit_cones(joint_angles_rad)
        palm = self._palm.broadcast(joint_angles_rad.shape[:-1])
        if tissue is None:
            return join_cones(palm, digits)
        turns = self.cup_rotations(tissue.cup_rad)
        for ray, part in enumerate((Part.RING, Part.LITTLE)):
            digits.rotate(np.flatnonzero(digits.part == part), turns[..., ray, :, :], self.pivots_m[ray])
        self._cup_palm(palm, tissue.cup_rad, turns)
        return join_cones(palm, self._knuckle_cones(palm, tissue.rise), digits)

    def cup_rotations(self, cup_rad: FloatArray) -> FloatArray:
        """Return the rotations (..., 2, 3, 3) of rays 4 and 5 in W for metacarpal flexions (..., 2)."""
        axes = _CUP_AXES / np.linalg.norm(_CUP_AXES, axis=1, keepdims=True)
        right = so3.exp(cup_rad[..., None] * axes)
        return np.asarray(self._mirror[:, None] * right * self._mirror)

    def cup_points(self, point_m: FloatArray, cup_rad: FloatArray) -> FloatArray:
        """Return points (..., 21, 3) of W, in the order of ``hand21``, with rays 4 and 5 cupped."""
        out = point_m.copy()
        turns = self.cup_rotations(cup_rad)
        for ray, rows in enumerate((slice(13, 17), slice(17, 21))):
            out[..., rows, :] = _rotate_points(out[..., rows, :], turns[..., ray, :, :], self.pivots_m[ray])
        return out

    def _cup_palm(self, palm: Cones, cup_rad: FloatArray, turns: FloatArray) -> None:
        """Cup palms in place: flex metacarpals 4 and 5 with their flesh.

        The flesh between the metacarpals rolls about its radial edge.
        """
        palm.rotate(np.array([_RING_METACARPAL]), turns[..., 0, :, :], self.pivots_m[0])
        palm.rotate(np.array([_LITTLE_METACARPAL, _HYPOTHENAR]), turns[..., 1, :, :], self.pivots_m[1])
        edge = self._palm.a_m[_SLAB] + self._palm.lateral[_SLAB] * self._palm.width_a_m[_SLAB]
        roll = so3.exp(_SLAB_ROLL * cup_rad[..., 1:] * np.array([1.0, 0.0, 0.0]))
        palm.rotate(np.array([_SLAB]), self._mirror[:, None] * roll * self._mirror, edge)

    def _knuckle_cones(self, palm: Cones, rise: FloatArray) -> Cones:
        """Return metacarpal heads that rise with flexion; at ``rise`` (..., 4) 0 they lift no skin."""
        heads = palm.b_m[..., _METACARPALS, :]
        along = heads - palm.a_m[..., _METACARPALS, :]
        along = along / np.linalg.norm(along, axis=-1, keepdims=True)
        reach = BLEND_M[Part.PALM]
        # The smooth union lifts the skin by (reach - distance)^2 / (4 reach).
        up = np.sqrt(4.0 * reach * self._knuckle_rise_m)
        radius = palm.radius_b_m[..., _METACARPALS] - reach + rise * up
        width = palm.width_b_m[..., _METACARPALS]
        return Cones(
            a_m=heads - 0.002 * along,
            b_m=heads + (_KNUCKLE_REACH_M * self._size * rise[..., None] + 1e-5) * along,
            lateral=palm.lateral[..., _METACARPALS, :],
            radius_a_m=radius,
            radius_b_m=radius,
            width_a_m=width,
            width_b_m=width,
            part=np.full(4, float(Part.PALM)),
        )

    def forearm_cones_w0(self, supination_rad: float) -> Cones:
        """Return the forearm in W0, turned about its axis as far as the hand's (signed Euler phi)."""
        s = self._size
        joint = np.array([0.0, 0.0, -WRIST_JOINT_DEPTH_M * s])  # the usual place, where the skin joins
        turn = 0.85 * supination_rad
        lateral = np.array([0.0, np.cos(turn), np.sin(turn)])
        down = np.array([0.0, np.sin(turn), -np.cos(turn)])
        ulnar = -0.007 * s * self._mirror[1] * lateral
        a = joint + 0.0095 * s * down + ulnar + np.array([-0.004 * s, 0.0, 0.0])
        middle = joint + 0.012 * s * down + np.array([-0.080 * s, 0.0, -0.002 * s])
        elbow = middle + np.array([-0.450 * s, 0.0, -0.020 * s])
        return Cones(
            a_m=np.array([a, middle]),
            b_m=np.array([middle, elbow]),
            lateral=np.array([lateral, lateral]),
            radius_a_m=np.array([0.0105, 0.0165]) * s,
            radius_b_m=np.array([0.0165, 0.042]) * s,
            width_a_m=np.array([0.0160, 0.0160]) * s,
            width_b_m=np.array([0.0160, 0.0120]) * s,
            part=np.array([Part.FOREARM, Part.FOREARM], dtype=np.float64),
        )

    def palm_height_m(self, place_m: FloatArray) -> float:
        """Return the height in W of the back of the palm over (x, y) in W."""
        z = 0.03 * self._size
        for _ in range(60):
            gap = float(skin_distance(np.array([place_m[0], place_m[1], z]), self._palm))
            if abs(gap) < 1e-6 or z < -0.05:
                break
            z -= gap
        return z

    def palm_normals(self) -> FloatArray:
        """Return the unit normals (6, 3) in W of the skin under the palm's markers."""
        discs = self._patient.anatomy.palm_disc_m * self._mirror
        steps = 2e-4 * np.eye(3)
        slope = np.stack(
            [skin_distance(discs + e, self._palm) - skin_distance(discs - e, self._palm) for e in steps], -1
        )
        return np.asarray(slope / np.linalg.norm(slope, axis=-1, keepdims=True))

    def _fit_palm(self) -> Cones:
        """Adjust the palm's radii until the markers lie on its surface."""
        palm = self._initial_palm()
        discs = self._patient.anatomy.palm_disc_m * self._mirror
        carpus, bump, first_metacarpal = 0, 1, 2
        for _ in range(8):
            gap = skin_distance(discs, palm)
            radius_a, radius_b = palm.radius_a_m.copy(), palm.radius_b_m.copy()
            radius_a[carpus] += gap[0]
            radius_b[carpus] += gap[0]
            radius_a[bump] += gap[1]
            radius_b[first_metacarpal : first_metacarpal + 4] += gap[2:]
            palm = replace(palm, radius_a_m=radius_a, radius_b_m=radius_b)
        return palm

    def _initial_palm(self) -> Cones:
        """Return carpus, thumb base, four metacarpals, and the flesh between and beside them.

        Bones start and end at the depth of their radius under the markers. Millimetres of a hand 180 mm long.
        """
        mm = 0.001 * self._size
        discs = self._patient.anatomy.palm_disc_m / mm
        r = self._radius[list(PALM_SITES)] / mm
        under = discs - r[:, None] * np.array([0.0, 0.0, 1.0])
        knuckle = under[2:]
        level = np.array([0.0, 1.0, 0.0])
        # The base of the thumb slopes down to its side, and its marker lies on that slope.
        slope = np.array([0.0, np.cos(_THUMB_BASE_TILT_RAD), -np.sin(_THUMB_BASE_TILT_RAD)])
        thumb = discs[1] - r[1] * np.cross([1.0, 0.0, 0.0], slope) + 3.0 * slope

        metacarpals = [
            (np.array([start, 0.5 * end[1], -18.0]), end, level, 12.0, radius, 1.5, 1.5)
            for start, end, radius in zip((38.0, 30.0, 24.0, 22.0), knuckle, r[2:], strict=True)
        ]
        rows = [
            (np.array([0, -8, -11]), np.array([20, -10, -15]), level, 11.0, 11.5, 8.2, 8.2),
            (thumb, np.array([40, 0, -18]), slope, r[1], 11.0, 5.5, 2.0),
            *metacarpals,
            (np.array([34, -7, -21]), np.array([64, -6, -20]), level, 12.0, 11.0, 20.0, 20.0),
            (np.array([14, -17, -20]), np.array([54, -27, -19]), level, 12.0, 10.0, 2.0, 2.0),
            (under[1] + np.array([6, 2, -7]), np.array([60, 20, -24]), level, 12.0, 8.0, 3.0, 2.0),
        ]
        a, b, lateral, radius_a, radius_b, width_a, width_b = (np.array([row[i] for row in rows]) for i in range(7))
        return Cones(
            a_m=mm * a * self._mirror,
            b_m=mm * b * self._mirror,
            lateral=lateral * self._mirror,
            radius_a_m=mm * radius_a,
            radius_b_m=mm * radius_b,
            width_a_m=mm * width_a,
            width_b_m=mm * width_b,
            part=np.full(len(rows), float(Part.PALM)),
        )

    def _digit_cones(self, joint_angles_rad: FloatArray) -> Cones:
        """Return thumb and fingers: bones run under their markers at the depth of their radius."""
        s, radius = self._size, self._radius
        anatomy = self._patient.anatomy
        discs = disc_centres(anatomy, joint_angles_rad)
        frames = segment_frames(anatomy, joint_angles_rad)
        normal = frames.dorsal_normal
        points: list[tuple[FloatArray, FloatArray, FloatArray]] = []
        sizes: list[tuple[float, float, float, float]] = []
        for digit in range(5):
            segments = [SEGMENTS.index("MC1") + 3 * digit + i for i in range(3)]
            n = np.moveaxis(normal[..., segments, :], -2, 0)
            standing = [n[0] if digit == 0 else n[0] + n[1], n[1] + n[2], n[2]]
            first = 1 + 4 * digit
            lowered = (0.009 if digit == 0 else 0.003) * s
            under = [discs[..., first, :] - np.array([0.0, 0.0, radius[first] + lowered])]
            for i in range(3):
                up = standing[i] / np.linalg.norm(standing[i], axis=-1, keepdims=True)
                under.append(discs[..., first + 1 + i, :] - radius[first + 1 + i] * up)
            # The digit goes on beyond the marker on the nail, and tapers.
            under[3] = under[3] + _BEYOND_NAIL * (under[3] - under[2])
            # The digit's base stays below the reach of the fillet, which would lift the palm's marker.
            reach = BLEND_M[Part.THUMB] if digit == 0 else FINGER_BLEND_M
            base = min(_BASE_RADIUS_M[digit] * s, radius[first] + lowered - reach)
            pip, dip, nail = radius[first + 1 : first + 4]
            radii = [base, pip, dip, nail + _BEYOND_NAIL * (nail - dip)]
            widths = np.array(_DIGIT_WIDTH_M[digit]) * s * self._patient.digit_width
            for i in range(3):
                direction = under[i + 1] - under[i]
                direction = direction / np.linalg.norm(direction, axis=-1, keepdims=True)
                points.append((under[i], under[i + 1], np.cross(n[i], direction)))
                sizes.append((radii[i], radii[i + 1], widths[i], widths[i + 1]))
        shape = (*joint_angles_rad.shape[:-1], len(sizes))
        part = np.repeat(np.arange(Part.THUMB, Part.FOREARM, dtype=np.float64), 3)
        a, b, lateral = (np.stack(column, axis=-2) for column in zip(*points, strict=True))
        columns = (np.broadcast_to(np.array(size), shape) for size in zip(*sizes, strict=True))
        radius_a, radius_b, width_a, width_b = columns
        return Cones(a, b, lateral, radius_a, radius_b, width_a, width_b, part)
