"""Scene geometry: camera, table, and the hand at any time."""

from __future__ import annotations

import math
from dataclasses import dataclass

import cv2
import numpy as np

from carpus.core.model.camera import Camera
from carpus.core.model.depth_sensor import SENSORS
from carpus.core.model.hand.clinical_angles import rotation_from_angles, side_sign, wrist_axes
from carpus.core.model.hand.kinematics import SegmentFrames, disc_centres, joint_centres, segment_frames
from carpus.core.model.hand.protocols import PALM_SITES
from carpus.core.model.types import FloatArray
from carpus.core.simulation.hand_motion import HandMotion, TissueMovement, TissueState, sample_tissue
from carpus.core.simulation.motions import create_motion
from carpus.core.simulation.patient import SimulatedPatient, sample_patient, sample_wide_anatomy
from carpus.core.simulation.skin import Cones, HandSkin, join_cones, project_to_surface
from carpus.core.simulation.spec import RandomStream, RecordingSpec

_FROM_ABOVE = np.array([[0.0, -1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, -1.0]])
"""W0 in a camera that looks straight down, fingers up in the image (reference 1.1)."""

_LOWEST_GAP_M = 0.006
_PICTURE_MARGIN_PX = 22.0
_MOTION_SAMPLES = 80


@dataclass(frozen=True, slots=True)
class HandPose:
    """Pose at N times.

    Attributes
    ----------
    rotation_w2_w0, position_m : (N, 3, 3), (N, 3) of W2 in W0
    angles_rad, joint_angles_rad : (N, 3), (N, J) of the fixed unit, of each finger against its own metacarpal
    arm_displacement_m : (N, 3)
    """

    rotation_w2_w0: FloatArray
    position_m: FloatArray
    angles_rad: FloatArray
    joint_angles_rad: FloatArray
    arm_displacement_m: FloatArray
    tissue: TissueState


class Scene:
    """One patient under one camera; ``table_height_m`` is the table's z in W0."""

    def __init__(self, spec: RecordingSpec) -> None:
        self.spec = spec
        self.patient: SimulatedPatient = sample_patient(spec)
        if spec.anatomy == "wide":
            self.patient = sample_wide_anatomy(self.patient, spec)
        self.motion: HandMotion = create_motion(spec)
        self.tissue = sample_tissue(spec)
        self._tissue_movement = TissueMovement(self.tissue, self.motion, spec.seconds)
        self.skin = HandSkin(self.patient, self.tissue.knuckle_rise_m)
        self._last_skin_markers: tuple[HandPose, tuple[FloatArray, FloatArray]] | None = None
        self._markers_follow_skin = not self.tissue.is_rigid or bool(self.patient.placement_error_m.any())
        self._palm_normals = self.skin.palm_normals()
        rng = spec.generator(RandomStream.SCENE)
        focal_px = 525.0 * rng.uniform(0.98, 1.02)
        self.camera = Camera(
            focal_px, focal_px * rng.uniform(0.998, 1.002), 319.5 + rng.uniform(-5, 5), 239.5 + rng.uniform(-5, 5),
            origin="file", sensor=SENSORS[spec.sensor],
        )  # fmt: skip
        self.table_height_m = self._lowest_point_m() - _LOWEST_GAP_M
        self.rotation_w0_cam = self._sample_orientation(rng)
        self.translation_w0_cam_m = self._sample_placement(rng)

    def pose(self, time_s: FloatArray) -> HandPose:
        """Return the pose at times (N,) after the first frame."""
        angles = self.motion.wrist_angles_rad(time_s)
        arm = self.motion.arm_displacement_m(time_s)
        rotation = rotation_from_angles(angles, self.spec.hand)
        joint = self.patient.wrist_joint_m
        position = joint - rotation @ joint + arm
        joints, tissue = self.motion.joint_angles_rad(time_s), self._tissue_movement.evaluate(time_s)
        return HandPose(rotation, position, angles, joints, arm, tissue)

    def markers_w0_m(self, pose: HandPose) -> FloatArray:
        """Return all 21 marker centres in W0, (N, 21, 3)."""
        if self._markers_follow_skin:
            return _to_w0(self._skin_markers_w(pose)[0], pose)
        return _to_w0(disc_centres(self.patient.anatomy, pose.joint_angles_rad), pose)

    def marker_normals_w0(self, pose: HandPose) -> FloatArray:
        """Return the unit normals of the 21 markers in W0, (N, 21, 3).

        Those of the skin on the palm, and everywhere if markers follow the skin; else the bisectors of the digits'
        bones.
        """
        if self._markers_follow_skin:
            return np.asarray(self._skin_markers_w(pose)[1] @ pose.rotation_w2_w0.transpose(0, 2, 1))
        bones = segment_frames(self.patient.anatomy, pose.joint_angles_rad).dorsal_normal[:, 1:].reshape(-1, 5, 3, 3)
        normals = np.empty((len(bones), 21, 3))
        normals[:, list(PALM_SITES)] = self._palm_normals
        rays = normals[:, 1:].reshape(-1, 5, 4, 3)
        rays[:, 1:, 1] = bones[:, 1:, 0] + bones[:, 1:, 1]
        rays[:, 0, 1] = bones[:, 0, 0]
        rays[:, :, 2] = bones[:, :, 1] + bones[:, :, 2]
        rays[:, :, 3] = bones[:, :, 2]
        normals = normals / np.linalg.norm(normals, axis=-1, keepdims=True)
        return np.asarray(normals @ pose.rotation_w2_w0.transpose(0, 2, 1))

    def bones_w(self, pose: HandPose) -> SegmentFrames:
        """Return all bones in W, with rays 4 and 5 cupped."""
        bones = segment_frames(self.patient.anatomy, pose.joint_angles_rad)
        if self.tissue.is_rigid:
            return bones
        turns = self.skin.cup_rotations(pose.tissue.cup_rad)
        for ray, rows in enumerate((slice(10, 13), slice(13, 16))):
            turn, pivot = turns[:, ray].transpose(0, 2, 1), self.skin.pivots_m[ray]
            bones.start_m[:, rows] = (bones.start_m[:, rows] - pivot) @ turn + pivot
            bones.end_m[:, rows] = (bones.end_m[:, rows] - pivot) @ turn + pivot
            bones.dorsal_normal[:, rows] = bones.dorsal_normal[:, rows] @ turn
        return bones

    def _skin_markers_w(self, pose: HandPose) -> tuple[FloatArray, FloatArray]:
        """Return centres and normals (N, 21, 3) in W of markers on the skin; keeps those of the last pose."""
        if self._last_skin_markers is None or self._last_skin_markers[0] is not pose:
            self._last_skin_markers = (pose, self._compute_skin_markers_w(pose))
        return self._last_skin_markers[1]

    def _compute_skin_markers_w(self, pose: HandPose) -> tuple[FloatArray, FloatArray]:
        anatomy, tissue = self.patient.anatomy, pose.tissue
        markers = disc_centres(anatomy, pose.joint_angles_rad)
        markers = markers + self._displacement_m(segment_frames(anatomy, pose.joint_angles_rad), tissue.glide_m)
        cones = self.skin.cones_w(pose.joint_angles_rad, tissue)
        return project_to_surface(self.skin.cup_points(markers, tissue.cup_rad), cones)

    def _displacement_m(self, bones: SegmentFrames, glide_m: FloatArray) -> FloatArray:
        """Return displacements (N, 21, 3) of an uncupped hand: placement errors and glides (N, 21)."""
        along = bones.end_m - bones.start_m
        along = along / np.linalg.norm(along, axis=-1, keepdims=True)
        digits = along[:, 1:].reshape(-1, 5, 3, 3)
        distal, up = np.empty((len(along), 21, 3)), np.zeros((len(along), 21, 3))
        distal[:, 0], up[:, 0, 2] = along[:, 0], 1.0
        rays, normals = distal[:, 1:].reshape(-1, 5, 4, 3), up[:, 1:].reshape(-1, 5, 4, 3)
        fan = self.patient.anatomy.fan_rad
        mirror = -1.0 if self.patient.anatomy.side == "left" else 1.0
        rays[:, :, 0] = np.stack((np.cos(fan), mirror * np.sin(fan), np.zeros(5)), axis=-1)
        rays[:, :, 1:3] = digits[:, :, :2] + digits[:, :, 1:]
        rays[:, :, 3] = digits[:, :, 2]
        normals[:, :, 0, 2] = 1.0
        normals[:, :, 1:] = bones.dorsal_normal[:, 1:].reshape(-1, 5, 3, 3)
        distal = distal / np.linalg.norm(distal, axis=-1, keepdims=True)
        radial = mirror * np.cross(up, distal)
        off_m = self.patient.placement_error_m
        glides = distal.copy()
        palm = list(PALM_SITES)
        glides[:, palm, 1] += mirror * self.tissue.swerve_rad[palm]
        return np.asarray(glide_m[..., None] * glides + off_m[:, :1] * distal + off_m[:, 1:] * radial)

    def marker_frame(self) -> tuple[FloatArray, FloatArray]:
        """Return axes (3, 3) and origin (3,) of the markers' W of the first frame in that of the bones.

        They are equal unless markers were placed off. True values count from the markers' frame, the only visible one.
        """
        if not self.patient.placement_error_m.any():
            return np.eye(3), np.zeros(3)
        palm = self.markers_w0_m(self.pose(np.zeros(1)))[0, list(PALM_SITES)]
        return wrist_axes(palm, dorsal_direction=np.array([0.0, 0.0, 1.0])), palm[0]

    def joints_w0_m(self, pose: HandPose) -> FloatArray:
        """Return all 21 joint centres and tips in W0, (N, 21, 3)."""
        joints = joint_centres(self.patient.anatomy, pose.joint_angles_rad)
        if not self.tissue.is_rigid:
            joints = self.skin.cup_points(joints, pose.tissue.cup_rad)
        return _to_w0(joints, pose)

    def to_camera(self, point_w0_m: FloatArray) -> FloatArray:
        """Transform points (..., 3) from W0 to the camera."""
        return np.asarray(point_w0_m @ self.rotation_w0_cam.T + self.translation_w0_cam_m)

    def cones_cam(self, pose: HandPose, i: int) -> Cones:
        """Return the skin of hand and forearm at the i-th time in the camera."""
        tissue = None if self.tissue.is_rigid else pose.tissue.select(i)
        hand = self.skin.cones_w(pose.joint_angles_rad[i], tissue)
        hand = hand.transform(pose.rotation_w2_w0[i], pose.position_m[i])
        supination = side_sign(self.spec.hand) * float(pose.angles_rad[i, 2])
        forearm = self.skin.forearm_cones_w0(supination).transform(np.eye(3), pose.arm_displacement_m[i])
        return join_cones(hand, forearm).transform(self.rotation_w0_cam, self.translation_w0_cam_m)

    def _lowest_point_m(self) -> float:
        """Return the height in W0 of the lowest point of the skin."""
        times = self._sample_times_s()
        pose = self.pose(times)
        cones = self.skin.cones_w(pose.joint_angles_rad, None if self.tissue.is_rigid else pose.tissue)
        up = pose.rotation_w2_w0[:, 2, :, None]  # of W0, in W2
        side = np.abs((cones.lateral @ up)[..., 0])
        low_a = (cones.a_m @ up)[..., 0] - cones.radius_a_m - cones.width_a_m * side
        low_b = (cones.b_m @ up)[..., 0] - cones.radius_b_m - cones.width_b_m * side
        lowest = (np.minimum(low_a, low_b) + pose.position_m[:, 2:]).min()
        return min(-0.040 * self.patient.size, float(lowest))

    def _sample_times_s(self) -> FloatArray:
        """Return times that show the extent of the motion."""
        return np.linspace(0.0, self.spec.seconds, min(_MOTION_SAMPLES, 1 + round(20.0 * self.spec.seconds)))

    def _sample_orientation(self, rng: np.random.Generator) -> FloatArray:
        yaw = math.radians(rng.uniform(-20.0, 20.0) if self.spec.yaw_deg is None else self.spec.yaw_deg)
        drawn_tilt, heading = rng.uniform(0.0, 10.0), rng.uniform(-math.pi, math.pi)
        if self.spec.marker_protocol.has_fingers:
            # The thumb's markers face sideways: its side of the hand is turned up so that they are visible.
            drawn_tilt, heading = 0.6 * drawn_tilt + 6.0, 0.2 * heading
            if self.spec.hand == "left":
                heading += math.pi
        heading = heading if self.spec.tilt_heading_deg is None else math.radians(self.spec.tilt_heading_deg)
        tilt = math.radians(drawn_tilt if self.spec.tilt_deg is None else self.spec.tilt_deg)
        axis = np.array([math.cos(heading), math.sin(heading), 0.0])
        turned, _ = cv2.Rodrigues(np.array([0.0, 0.0, yaw]))
        tilted, _ = cv2.Rodrigues(tilt * axis)
        return np.asarray(_FROM_ABOVE @ turned @ tilted)

    def _sample_placement(self, rng: np.random.Generator) -> FloatArray:
        """Centre the markers' motion in the image, far enough to see all of it."""
        reaches = self.spec.motion.startswith("reach")
        nearest, farthest = (0.84, 0.90) if reaches else (0.62, 0.78 if self.spec.marker_protocol.has_fingers else 0.88)
        drawn = rng.uniform(nearest, farthest)
        distance_m = drawn if self.spec.distance_m is None else self.spec.distance_m
        shift_m = rng.uniform(-0.025, 0.025, 2)
        times = self._sample_times_s()
        pose = self.pose(times)
        if self.spec.leaves_picture:
            pose = self.pose(times[times < 0.4 * self.spec.seconds])
        markers = self.markers_w0_m(pose).reshape(-1, 3) @ self.rotation_w0_cam.T
        middle = 0.5 * (markers.min(axis=0) + markers.max(axis=0))
        wrist = self.markers_w0_m(pose)[0, 0] @ self.rotation_w0_cam.T
        translation = np.array([-middle[0], -middle[1], distance_m - wrist[2]])
        translation[:2] += shift_m
        pixel = self.camera.project(markers + translation)
        size = np.array([self.camera.width_px, self.camera.height_px])
        too_low = np.maximum(_PICTURE_MARGIN_PX - pixel.min(axis=0), 0.0)
        too_high = np.maximum(pixel.max(axis=0) - (size - 1 - _PICTURE_MARGIN_PX), 0.0)
        translation[:2] += (too_low - too_high) * distance_m / self.camera.fx_px
        return translation


def _to_w0(point_m: FloatArray, pose: HandPose) -> FloatArray:
    """Transform points (N, K, 3) from W2 to W0."""
    return np.asarray(point_m @ pose.rotation_w2_w0.transpose(0, 2, 1) + pose.position_m[:, None, :])
