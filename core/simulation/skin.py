"""The skin of hand and forearm: rounded bones, joined smoothly where flesh fills the corner.

Every body part is a set of flattened round cones: the points within a radius, linear from ``radius_a`` to
``radius_b``, of a segment a-b that is widened sideways by a half width, linear too. Parts are united by a smooth
minimum of finite reach (:func:`smooth_minimum`), so that bending a finger does not touch the skin under the palm's
discs: these stay exactly rigid, and exactly on the rendered surface.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import IntEnum

import numpy as np

from core.hand.anatomy import anatomy_from_size
from core.hand.kinematics import SEGMENTS, disc_centres, segment_frames
from core.hand.protocols import HAND21
from core.simulation.patient import Patient
from core.types import FloatArray


class Part(IntEnum):
    """Body parts in the order in which they are united; THUMB to LITTLE join the palm but not one another."""

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


@dataclass(frozen=True, slots=True)
class Cones:
    """P flattened round cones in one frame: ``a_m``, ``b_m`` (P, 3), unit ``lateral`` (P, 3) across the axis,
    ``radius_a_m``, ``radius_b_m``, ``width_a_m``, ``width_b_m`` (half widths) (P,), ``part`` (P,) of :class:`Part`."""

    a_m: FloatArray
    b_m: FloatArray
    lateral: FloatArray
    radius_a_m: FloatArray
    radius_b_m: FloatArray
    width_a_m: FloatArray
    width_b_m: FloatArray
    part: FloatArray

    def moved(self, rotation: FloatArray, translation_m: FloatArray) -> Cones:
        """In another frame: p' = rotation p + translation."""
        return replace(
            self,
            a_m=self.a_m @ rotation.T + translation_m,
            b_m=self.b_m @ rotation.T + translation_m,
            lateral=self.lateral @ rotation.T,
        )

    def __len__(self) -> int:
        return len(self.part)


def joined(*sets: Cones) -> Cones:
    """Several sets as one."""
    return Cones(*(np.concatenate([getattr(s, name) for s in sets]) for name in Cones.__slots__))


def cone_distance(point_m: FloatArray, cones: Cones, i: int) -> FloatArray:
    """Signed distance of points (..., 3) to cone i, metres, negative inside."""
    axis = cones.b_m[i] - cones.a_m[i]
    length = float(np.linalg.norm(axis))
    axis = axis / length
    lateral = cones.lateral[i] - (cones.lateral[i] @ axis) * axis
    lateral = lateral / np.linalg.norm(lateral)
    local = point_m - cones.a_m[i]
    along = local @ axis
    side = local @ lateral
    up = local @ np.cross(axis, lateral)
    share = np.clip(along / length, 0.0, 1.0)
    half_width = cones.width_a_m[i] + share * (cones.width_b_m[i] - cones.width_a_m[i])
    side = side - np.clip(side, -half_width, half_width)
    radial = np.hypot(side, up)
    taper = (cones.radius_a_m[i] - cones.radius_b_m[i]) / length
    foot = np.clip(along - radial * taper / np.sqrt(1.0 - taper * taper), 0.0, length)
    return np.asarray(np.hypot(along - foot, radial) - (cones.radius_a_m[i] - taper * foot))


def smooth_minimum(a: FloatArray, b: FloatArray, reach: float) -> FloatArray:
    """Minimum with a fillet; equal to the sharp minimum wherever a and b differ by more than ``reach``."""
    near = np.maximum(reach - np.abs(a - b), 0.0)
    return np.asarray(np.minimum(a, b) - near * near * (0.25 / reach))


def skin_distance(point_m: FloatArray, cones: Cones) -> FloatArray:
    """Signed distance of points (..., 3) to the skin; the surface that the renderer shows."""
    parts: dict[Part, FloatArray] = {}
    for i in range(len(cones)):
        part = Part(int(cones.part[i]))
        d = cone_distance(point_m, cones, i)
        if part not in parts:
            parts[part] = d
        elif part is Part.PALM:
            parts[part] = smooth_minimum(parts[part], d, BLEND_M[part])
        else:
            parts[part] = np.minimum(parts[part], d)
    palm = parts.pop(Part.PALM)
    out = palm
    for part, d in parts.items():
        out = np.minimum(out, smooth_minimum(palm, d, BLEND_M.get(part, FINGER_BLEND_M)))
    return np.asarray(out)


class HandSkin:
    """The skin of one patient; built once, then posed for every frame."""

    def __init__(self, patient: Patient) -> None:
        self._patient = patient
        self._size = patient.size
        self._mirror = np.array([1.0, -1.0 if patient.anatomy.side == "left" else 1.0, 1.0])
        offset = anatomy_from_size(patient.anatomy.hand_length_m, nail_discs=True).skin_offset_m
        # Where the subject's own offsets are known the bones lie in the joints; in the papers' chain, which has
        # none, the usual thickness of flesh is kept under the discs.
        own = patient.anatomy.skin_offset_m
        self._radius = np.where(own > 0.0, own, offset)
        self._palm = self._fitted_palm()

    def cones_w(self, joint_angles_rad: FloatArray) -> Cones:
        """Palm, thumb and fingers in W for joint angles (J,)."""
        return joined(self._palm, self._digits(joint_angles_rad))

    def forearm_w0(self, supination_rad: float) -> Cones:
        """The forearm in W0, turned about its own axis as far as the hand's (signed Euler phi)."""
        s, joint = self._size, self._patient.wrist_joint_m
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
        """Height in W of the back of the palm over a place (x, y) in W."""
        z = 0.03 * self._size
        for _ in range(60):
            gap = float(skin_distance(np.array([place_m[0], place_m[1], z]), self._palm))
            if abs(gap) < 1e-6 or z < -0.05:
                break
            z -= gap
        return z

    def palm_normals(self) -> FloatArray:
        """Unit normals (6, 3) in W of the skin under the palm's discs."""
        discs = self._patient.anatomy.palm_disc_m * self._mirror
        steps = 2e-4 * np.eye(3)
        slope = np.stack(
            [skin_distance(discs + e, self._palm) - skin_distance(discs - e, self._palm) for e in steps], -1
        )
        return np.asarray(slope / np.linalg.norm(slope, axis=-1, keepdims=True))

    def _fitted_palm(self) -> Cones:
        """The palm, its radii adjusted until the discs lie on its surface."""
        palm = self._rough_palm()
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

    def _rough_palm(self) -> Cones:
        """Carpus, base of the thumb, four metacarpals, and flesh between and beside them; bones start and end at the
        depth of their radius under the discs. Millimetres of a hand 180 mm long."""
        mm = 0.001 * self._size
        discs = self._patient.anatomy.palm_disc_m / mm
        r = self._radius[list(HAND21.palm)] / mm
        under = discs - r[:, None] * np.array([0.0, 0.0, 1.0])
        knuckle = under[2:]
        level = np.array([0.0, 1.0, 0.0])
        # The base of the thumb slopes down to its side, and its disc lies on that slope.
        slope = np.array([0.0, np.cos(_THUMB_BASE_TILT_RAD), -np.sin(_THUMB_BASE_TILT_RAD)])
        thumb = discs[1] - r[1] * np.cross([1.0, 0.0, 0.0], slope) + 3.0 * slope

        def at(x: float, y: float, z: float) -> FloatArray:
            return np.array([x, y, z])

        metacarpals = [
            (np.array([start, 0.5 * end[1], -18.0]), end, level, 12.0, radius, 1.5, 1.5)
            for start, end, radius in zip((38.0, 30.0, 24.0, 22.0), knuckle, r[2:], strict=True)
        ]
        rows = [
            (at(0, -8, -11), at(20, -10, -15), level, 11.0, 11.5, 8.2, 8.2),
            (thumb, at(40, 0, -18), slope, r[1], 11.0, 5.5, 2.0),
            *metacarpals,
            (at(34, -7, -21), at(64, -6, -20), level, 12.0, 11.0, 20.0, 20.0),
            (at(14, -17, -20), at(54, -27, -19), level, 12.0, 10.0, 2.0, 2.0),
            (under[1] + at(6, 2, -7), at(60, 20, -24), level, 12.0, 8.0, 3.0, 2.0),
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

    def _digits(self, joint_angles_rad: FloatArray) -> Cones:
        """Thumb and fingers: every bone runs under its discs at the depth of their radius."""
        s, radius = self._size, self._radius
        anatomy = self._patient.anatomy
        discs = disc_centres(anatomy, joint_angles_rad)
        frames = segment_frames(anatomy, joint_angles_rad)
        normal = frames.dorsal_normal
        rows: list[tuple[FloatArray, FloatArray, FloatArray, float, float, float, float, float]] = []
        for digit in range(5):
            segments = [SEGMENTS.index("MC1") + 3 * digit + i for i in range(3)]
            n = normal[segments]
            standing = [n[0] if digit == 0 else n[0] + n[1], n[1] + n[2], n[2]]
            first = 1 + 4 * digit
            lowered = (0.009 if digit == 0 else 0.003) * s
            under = [discs[first] - np.array([0.0, 0.0, radius[first] + lowered])]
            for i in range(3):
                up = standing[i] / np.linalg.norm(standing[i])
                under.append(discs[first + 1 + i] - radius[first + 1 + i] * up)
            # The digit goes on beyond the disc on the nail, and tapers.
            under[3] = under[3] + _BEYOND_NAIL * (under[3] - under[2])
            # The digit's base stays out of the fillet's reach below the palm's disc, which it would lift.
            reach = BLEND_M[Part.THUMB] if digit == 0 else FINGER_BLEND_M
            base = min(_BASE_RADIUS_M[digit] * s, radius[first] + lowered - reach)
            pip, dip, nail = radius[first + 1 : first + 4]
            radii = [base, pip, dip, nail + _BEYOND_NAIL * (nail - dip)]
            widths = np.array(_DIGIT_WIDTH_M[digit]) * s
            for i in range(3):
                direction = (under[i + 1] - under[i]) / np.linalg.norm(under[i + 1] - under[i])
                across = np.cross(n[i], direction)
                rows.append(
                    (
                        under[i],
                        under[i + 1],
                        across,
                        radii[i],
                        radii[i + 1],
                        widths[i],
                        widths[i + 1],
                        Part.THUMB + digit,
                    )
                )
        columns = (np.array([row[i] for row in rows], dtype=np.float64) for i in range(8))
        return Cones(*columns)
