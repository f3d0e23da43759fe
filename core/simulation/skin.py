"""The skin of hand and forearm: rounded bones, joined smoothly where flesh fills the corner.

Every body part is a set of flattened round cones: the points within a radius, linear from ``radius_a`` to
``radius_b``, of a segment a-b that is widened sideways by ``half_width``. Parts are united by a smooth minimum of
finite reach (:func:`smooth_minimum`), so that bending a finger does not touch the skin under the palm's discs: these
stay exactly rigid, and exactly on the rendered surface.
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


BLEND_M = {Part.PALM: 0.008, Part.THUMB: 0.006, Part.FOREARM: 0.006}
"""Reach of the smooth union: within the palm, and of thumb and forearm with the palm."""
FINGER_BLEND_M = 0.005


@dataclass(frozen=True, slots=True)
class Cones:
    """P flattened round cones in one frame: ``a_m``, ``b_m`` (P, 3), unit ``lateral`` (P, 3) across the axis,
    ``radius_a_m``, ``radius_b_m``, ``half_width_m`` (P,), ``part`` (P,) of :class:`Part`."""

    a_m: FloatArray
    b_m: FloatArray
    lateral: FloatArray
    radius_a_m: FloatArray
    radius_b_m: FloatArray
    half_width_m: FloatArray
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
    side = side - np.clip(side, -cones.half_width_m[i], cones.half_width_m[i])
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
        ulnar = -0.003 * s * self._mirror[1] * lateral
        a = joint + 0.0095 * s * down + ulnar + np.array([-0.004 * s, 0.0, 0.0])
        middle = joint + 0.012 * s * down + np.array([-0.080 * s, 0.0, -0.002 * s])
        elbow = middle + np.array([-0.450 * s, 0.0, -0.020 * s])
        return Cones(
            a_m=np.array([a, middle]),
            b_m=np.array([middle, elbow]),
            lateral=np.array([lateral, lateral]),
            radius_a_m=np.array([0.0105, 0.0165]) * s,
            radius_b_m=np.array([0.0165, 0.042]) * s,
            half_width_m=np.array([0.0125, 0.0155]) * s,
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
        s, discs = self._size, self._patient.anatomy.palm_disc_m
        under = discs - self._radius[list(HAND21.palm), None] * np.array([0.0, 0.0, 1.0])
        y = np.array([0.0, 1.0, 0.0])
        rows: list[tuple[FloatArray, FloatArray, FloatArray, float, float, float]] = []
        mm = 0.001 * s

        def add(a: FloatArray, b: FloatArray, radius_a: float, radius_b: float, half_width: float) -> None:
            rows.append((a, b, y, radius_a * mm, radius_b * mm, half_width * mm))

        def at(x: float, lateral: float, z: float) -> FloatArray:
            return np.array([x, lateral, z]) * mm

        r = self._radius / mm
        wrist, cmc1, mcp = under[0], under[1], under[2:]
        add(wrist + at(0, -8, 0), wrist + at(20, -10, -3), r[0], 11.5, 8.2)
        add(cmc1, at(36, -2, -18), r[1], 11.0, 0.0)
        for k in range(4):
            base = at(32 if k == 0 else 22, 0, -18) + np.array([0.0, 0.5 * mcp[k, 1], 0.0])
            add(base, mcp[k], 12.0, r[5 + 4 * k], 1.5)
        add(at(34, -7, -21), at(64, -6, -20), 12.0, 11.0, 20.0)
        add(at(14, -17, -20), at(54, -27, -19), 12.0, 10.0, 2.0)
        add(at(34, 14, -28), at(58, 17, -24), 10.0, 8.0, 2.0)
        palm = Cones(
            a_m=np.array([row[0] for row in rows]),
            b_m=np.array([row[1] for row in rows]),
            lateral=np.array([row[2] for row in rows]),
            radius_a_m=np.array([row[3] for row in rows]),
            radius_b_m=np.array([row[4] for row in rows]),
            half_width_m=np.array([row[5] for row in rows]),
            part=np.full(len(rows), float(Part.PALM)),
        )
        return replace(palm, a_m=palm.a_m * self._mirror, b_m=palm.b_m * self._mirror)

    def _digits(self, joint_angles_rad: FloatArray) -> Cones:
        """Thumb and fingers: every bone runs under its discs at the depth of their radius."""
        s, radius = self._size, self._radius
        anatomy = self._patient.anatomy
        discs = disc_centres(anatomy, joint_angles_rad)
        frames = segment_frames(anatomy, joint_angles_rad)
        normal = frames.dorsal_normal
        a, b, lateral, radius_a, radius_b, width, part = ([] for _ in range(7))
        for digit in range(5):
            segments = [SEGMENTS.index("MC1") + 3 * digit + i for i in range(3)]
            n = normal[segments]
            standing = [n[0] + n[1], n[1] + n[2], n[2]]
            if digit == 0:
                standing[0] = n[0]
            first = 1 + 4 * digit
            under = [discs[first] - np.array([0.0, 0.0, 1.0]) * (radius[first] + (0.009 if digit == 0 else 0.003) * s)]
            for i in range(3):
                up = standing[i] / np.linalg.norm(standing[i])
                under.append(discs[first + 1 + i] - radius[first + 1 + i] * up)
            base = 0.008 * s if digit == 0 else 0.008 * s * (0.92 if digit == 4 else 1.0)
            radii = [base, *radius[first + 1 : first + 4]]
            for i in range(3):
                start, end, r0, r1 = under[i], under[i + 1], radii[i], radii[i + 1]
                if i == 2:
                    # The finger goes on beyond the disc on the nail, tapering as before.
                    beyond = (0.25 if digit == 0 else 0.3) + 0.05
                    r_tip = r1 + (r1 - r0) * beyond
                    end, r1 = end + (end - start) * beyond, r_tip
                a.append(start)
                b.append(end)
                direction = (end - start) / np.linalg.norm(end - start)
                lateral.append(np.cross(n[i], direction))
                radius_a.append(r0)
                radius_b.append(r1)
                width.append((3.2, 2.8, 2.6)[i] * 0.001 * s * (1.25 if digit == 0 else 0.85 if digit == 4 else 1.0))
                part.append(float(Part.THUMB + digit))
        return Cones(*(np.array(column) for column in (a, b, lateral, radius_a, radius_b, width, part)))
