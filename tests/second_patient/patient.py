"""The patient as one body before a camera of its own: bones, skin, discs at any moment, on either side, and the truth.

The room of a RIGHT hand has the axes of B where the hand lies straight; a left hand is the whole mirrored at y = 0.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from carpus.core.model.camera import Camera
from carpus.core.model.hand.protocols import get_protocol
from carpus.core.model.types import FloatArray, Side
from tests.second_patient.discs import (
    NAMES,
    PALM,
    StuckDiscs,
    bends,
    disc_points,
    lifts_m,
    on_paths,
    skin_points,
    stick_discs,
)
from tests.second_patient.motions import Motion, Row
from tests.second_patient.person import Bone, Person, Placed, Posture, about, draw_person, place_at_rest, place_bones
from tests.second_patient.skin import Skin, blended_turn, dual_quaternions, make_skin, turn_vectors

MIRROR = np.array([1.0, -1.0, 1.0])
_DOWN = np.array([[0.0, -1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, -1.0]])
"""From the room to a camera that looks straight down, fingers to the top of the picture."""
_HELD_M = 0.016
_IN_PLANE = [NAMES.index(name) for name in ("WRIST", "MCP2", "MCP3", "MCP4", "MCP5")]


class Hung:
    """The camera of a seed in the room of a hand, which is ``mirror``-ed: ``turn`` (3, 3) and ``shift_m`` (3,) take
    points of the room to its axes; the table top is ``table_m`` below the room's zero."""

    def __init__(self, seed: int, mirror: FloatArray) -> None:
        rng = np.random.default_rng([seed, 1511])
        focal = float(rng.uniform(522.0, 552.0))
        tall = round(focal * float(rng.uniform(0.997, 1.003)), 2)
        middle = [round(at + float(rng.uniform(-7.0, 7.0)), 2) for at in (319.5, 239.5)]
        bent = [round(float(rng.uniform(*ends)), 4) for ends in ((0.0, 0.04), (-0.08, 0.0))]
        self.camera = Camera(round(focal, 2), tall, *middle, distortion=(*bent, 0.0, 0.0, 0.0), origin="file")
        tilt, lean, yaw = np.radians(rng.uniform([-5.0, -5.0, -14.0], [6.0, 5.0, 14.0]))
        self.turn = about(0, tilt) @ about(1, lean) @ about(2, yaw) @ _DOWN
        distance = float(rng.uniform(0.64, 0.76))
        aim = np.array([rng.uniform(-0.03, 0.03), rng.uniform(0.0, 0.03), distance])
        self.shift_m = aim - self.turn @ (mirror * [0.025, 0.0, 0.0])
        self.table_m = float(rng.uniform(0.085, 0.12))

    def to_camera(self, room_m: FloatArray) -> FloatArray:
        """Points (..., 3) of the room in the camera's axes."""
        return room_m @ self.turn.T + self.shift_m

    def pixel(self, cam_m: FloatArray) -> FloatArray:
        """Where the lens puts points (..., 3) in the picture, distortion included; (..., 2)."""
        x, y = cam_m[..., 0] / cam_m[..., 2], cam_m[..., 1] / cam_m[..., 2]
        k1, k2, p1, p2, k3 = self.camera.distortion
        r2 = x * x + y * y
        radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3))
        u = x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x)
        v = y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y
        camera = self.camera
        return np.stack((camera.fx_px * u + camera.cx_px, camera.fy_px * v + camera.cy_px), axis=-1)


@dataclass(frozen=True, slots=True, repr=False)
class Body:
    """One moment in the room: corners ``point_m`` (V, 3) and ``normal`` (V, 3), discs ``disc_m`` (21, 3) with the way
    out ``disc_normal`` (21, 3) and towards the finger tip ``disc_along`` (21, 3), and where they sit at rest
    ``disc_rest_m`` (21, 3)."""

    point_m: FloatArray
    normal: FloatArray
    disc_m: FloatArray
    disc_normal: FloatArray
    disc_along: FloatArray
    disc_rest_m: FloatArray


@dataclass(frozen=True, slots=True, repr=False)
class Patient:
    """``chain_axes`` (3, 3): axes of W, by the discs of the neutral pose, in B: the fingers' angles count in them."""

    side: Side
    person: Person
    skin: Skin
    stuck: StuckDiscs
    chain_axes: FloatArray

    @property
    def mirror(self) -> FloatArray:
        """What the room's axes are multiplied by on this side."""
        return MIRROR if self.side == "left" else np.ones(3)

    def placed(self, posture: Posture) -> Placed:
        """All bones, of the right hand."""
        return place_bones(self.person, posture, self.chain_axes)

    def discs_m(self, posture: Posture) -> FloatArray:
        """Centres of the discs in the room, (N, 21, 3)."""
        return self.mirror * disc_points(self.person, self.skin, self.stuck, posture, self.chain_axes)

    def body(self, posture: Posture) -> Body:
        """Skin and discs of a single moment."""
        rest = place_at_rest(self.person)
        dual = dual_quaternions(rest, self.placed(posture))[0]
        rise, tendon = (part[0] for part in lifts_m(self.person, posture))
        point = skin_points(self.skin, np.arange(len(self.skin.corner_m)), dual, rise, tendon)
        normal = turn_vectors(blended_turn(self.skin.weight, dual), self.skin.normal)
        corner, share = on_paths(self.stuck.path, bends(posture)[0] * self.stuck.slip_m)
        disc = np.einsum("mk,mkj->mj", share, point[corner])
        disc_normal = np.einsum("mk,mkj->mj", share, normal[corner])
        disc_normal /= np.linalg.norm(disc_normal, axis=1, keepdims=True)
        weight = np.einsum("mk,mkb->mb", share, self.skin.weight[corner])
        along = turn_vectors(blended_turn(weight, dual), np.array([path.along for path in self.stuck.path]))
        along -= np.sum(along * disc_normal, axis=1, keepdims=True) * disc_normal
        along /= np.linalg.norm(along, axis=1, keepdims=True)
        sits = np.einsum("mk,mkj->mj", share, self.skin.corner_m[corner])
        return Body(*(self.mirror * part for part in (point, normal, disc, disc_normal, along)), sits)


def make_patient(seed: int, side: Side, neutral: Posture, *, rigid: bool = False) -> Patient:
    """The patient of a seed; ``neutral`` is the posture that is clicked; ``rigid``: skin and palm stand still."""
    person, skin, stuck = _grown(seed, rigid)
    axes = np.eye(3)
    for _ in range(3):
        disc = disc_points(person, skin, stuck, neutral, axes)[0]
        hand = place_bones(person, neutral, axes).turn[0, Bone.FIXED]
        axes = hand.T @ frame_of_discs(disc, hand[:, 2])
    return Patient(side, person, skin, stuck, axes)


@lru_cache(maxsize=8)
def _grown(seed: int, rigid: bool) -> tuple[Person, Skin, StuckDiscs]:
    """What is the same in every take of a patient: to net the skin takes longer than all the rest."""
    rng = np.random.default_rng([seed, 1301])
    person = draw_person(rng, rigid=rigid)
    skin = make_skin(person)
    stuck = stick_discs(person, skin, rng)
    if rigid:
        skin = _held(skin, stuck)
        stuck = StuckDiscs(stuck.path, np.zeros(len(NAMES)), stuck.size_m, stuck.cut)
    return person, skin, stuck


def frame_of_discs(disc_m: FloatArray, out: FloatArray) -> FloatArray:
    """Axes of W as columns (3, 3) from the discs (21, 3): X from WRIST to MCP3, Z the normal of the plane through WRIST
    and the knuckles on the side of ``out``, Y = Z x X (interface 4, reference 1.1)."""
    x = disc_m[NAMES.index("MCP3")] - disc_m[NAMES.index("WRIST")]
    x = x / np.linalg.norm(x)
    plane = disc_m[_IN_PLANE] - disc_m[_IN_PLANE].mean(axis=0)
    z = np.linalg.svd(plane)[2][2]
    z = z * np.sign(z @ out)
    z = z - (z @ x) * x
    z = z / np.linalg.norm(z)
    return np.stack((x, np.cross(z, x), z), axis=-1)


def _held(skin: Skin, stuck: StuckDiscs) -> Skin:
    """The skin around each disc of the palm fast on its bone."""
    weight = skin.weight.copy()
    for name in PALM:
        bone = {"MCP4": Bone.MC4, "MCP5": Bone.MC5}.get(name, Bone.FIXED)
        path = stuck.path[NAMES.index(name)]
        row = len(path.share) // 2
        near = np.linalg.norm(skin.corner_m - path.share[row] @ skin.corner_m[path.corner[row]], axis=1) < _HELD_M
        weight[near], weight[near, bone] = 0.0, 1.0
    return Skin(skin.corner_m, skin.normal, skin.triangle, weight, skin.knuckle, skin.tendon)


class Truth:
    """N frames, M discs of the protocol, 21 finger angles (0 with ``wrist6``).

    The wrist is the fixed unit (capitate, metacarpals 2 and 3), its neutral pose the first frame; W0 stands on the
    discs of that frame. ``position_m`` (N, 3) of the WRIST disc and ``rotation_w2_w0`` (N, 3, 3) of the bones;
    ``angles_rad`` (N, 3) clinical; ``joint_angles_rad`` (N, J) of the bones, those of ring and little finger against
    their own metacarpals; ``disc_position_cam_m`` (N, M, 3) centres on the skin; ``disc_pixel`` (N, M, 2) as a lens
    without distortion sees them; ``visible_share`` (N, M) of each disc's paper, unknown
    until it is rendered.
    """

    def __init__(
        self, row: Row, patient: Patient, motion: Motion, hung: Hung, time_s: FloatArray, stamp_s: FloatArray
    ) -> None:
        self.side, self.protocol, self.camera, self.timestamp_s = (
            patient.side,
            get_protocol(row.protocol),
            hung.camera,
            stamp_s,
        )
        rows, wrist = [NAMES.index(name) for name in self.protocol.markers], NAMES.index("WRIST")
        posture = motion(time_s)
        placed, disc = patient.placed(posture), patient.discs_m(posture)
        fixed, disc0 = _fixed(patient, placed), patient.discs_m(motion(np.zeros(1)))[0]
        axes = frame_of_discs(disc0, fixed[0][:, 2])
        self.position_m = (disc[:, wrist] - disc0[wrist]) @ axes
        self.rotation_w2_w0 = axes.T @ fixed @ fixed[0].T @ axes
        self.angles_rad = clinical(self.rotation_w2_w0, patient.side)
        self.joint_angles_rad = posture.fingers if self.protocol.has_fingers else np.empty((len(time_s), 0))
        self.joint_position_w0_m = (joint_centres(patient, placed)[:, rows] - disc0[wrist]) @ axes
        self.disc_position_cam_m = hung.to_camera(disc[:, rows])
        self.disc_pixel = hung.camera.project(self.disc_position_cam_m)
        self.visible_share = np.full((len(time_s), len(rows)), np.nan)
        self.marker_position_w0_m = (disc0[rows] - disc0[wrist]) @ axes
        self.rotation_w0_cam, self.translation_w0_cam_m = hung.turn @ axes, hung.to_camera(disc0[wrist])


def _fixed(patient: Patient, placed: Placed) -> FloatArray:
    """Turns (N, 3, 3) of the fixed unit in the room, mirrored for a left hand."""
    mirror = np.diag(patient.mirror)
    return mirror @ placed.turn[:, Bone.FIXED] @ mirror


def joint_centres(patient: Patient, placed: Placed) -> FloatArray:
    """Joint centres under the discs and the ends of the last links, in the room (N, 21, 3): the last link ends under
    the disc on the nail."""
    person = patient.person
    out = np.empty((len(placed.turn), len(NAMES), 3))
    joint = placed.joint_m
    out[:, 0] = joint[:, Bone.FIXED]
    out[:, 1:4] = joint[:, Bone.MC1 : Bone.MC1 + 3]
    out[:, 4] = joint[:, Bone.DP1] + 0.8 * person.thumb_m[2] * placed.turn[:, Bone.DP1, :, 0]
    for ray in range(4):
        first = Bone.PP2 + 3 * ray
        out[:, 5 + 4 * ray : 8 + 4 * ray] = joint[:, first : first + 3]
        out[:, 8 + 4 * ray] = joint[:, first + 2] + 0.74 * person.finger_m[ray, 2] * placed.turn[:, first + 2, :, 0]
    return patient.mirror * out


def clinical(rotation: FloatArray, side: Side) -> FloatArray:
    """Deviation, flexion, pro-supination (N, 3) of rotations (N, 3, 3), + radial, + flexion, + supination."""
    sign = 1.0 if side == "right" else -1.0
    return np.stack(
        (
            sign * np.arctan2(rotation[:, 1, 0], rotation[:, 0, 0]),
            np.arcsin(np.clip(-rotation[:, 2, 0], -1.0, 1.0)),
            sign * np.arctan2(rotation[:, 2, 1], rotation[:, 2, 2]),
        ),
        axis=1,
    )
