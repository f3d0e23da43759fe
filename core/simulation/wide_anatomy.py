"""Hands and discs that differ from the tables by more than these say: what a prior may not take for granted.

Heights of discs over the joints, the palm's shape, fans of the fingers, thickness of the digits, the wrist's centre of
rotation, discs of 10 to 14 mm that are stuck some millimetres off their place, and swelling.
"""

from __future__ import annotations

import dataclasses

import numpy as np

from carpus.core.hand.kinematics import disc_centres
from carpus.core.hand.sites import SITES
from carpus.core.hand.wrist_frame import wrist_axes
from carpus.core.simulation.patient import Patient, disc_radii
from carpus.core.simulation.spec import RandomStream, RecordingSpec
from carpus.core.types import FloatArray

MOST_OFF_M = 0.005
"""A disc of the palm is stuck at most this far off its place; half on a finger, where the creases show it."""
_OFF_SHARE = {"TIP": 0.3, "PIP": 0.5, "DIP": 0.4, "MCP1": 0.5, "IP1": 0.5}
_LEAST_GAP_M, _TRIES = 0.002, 40
_SLIM = 0.4
"""Sideways a finger allows this much less than along it."""
_FLESH_SD, _HEIGHT_SD, _HEIGHT_RANGE = 0.12, 0.12, (0.7, 1.5)
_BREADTH, _ARCH = (0.90, 1.12), (0.5, 1.5)
_JOINT_SD_M = np.array([0.0025, 0.0015, 0.0])
_FAN_SD_RAD = np.radians(2.0)
_DIGIT_WIDTH = (0.8, 1.25)
_DISC_RADIUS_M = (0.005, 0.007)
_WRIST_JOINT_M = ((-0.004, 0.006), (0.012, 0.020))
"""Along X from the WRIST disc's place, and below it, of a hand 180 mm long."""
_SWOLLEN_CHANCE = 0.3
_SWELLING_M, _SWOLLEN_DIGIT = (0.002, 0.005), (1.1, 1.25)


def widened(patient: Patient, spec: RecordingSpec) -> Patient:
    """The patient with an anatomy drawn more widely around it."""
    rng = spec.random(RandomStream.ANATOMY)
    size, usual = patient.size, patient.anatomy
    swollen = rng.random() < _SWOLLEN_CHANCE
    swelling_m, digit_swelling = (
        rng.uniform(*_SWELLING_M) * size * swollen,
        1.0 + (rng.uniform(*_SWOLLEN_DIGIT) - 1.0) * swollen,
    )
    flesh = rng.normal(1.0, _FLESH_SD)

    def heights(usual_m: FloatArray) -> FloatArray:
        return np.asarray(usual_m * np.clip(rng.normal(flesh, _HEIGHT_SD, usual_m.shape), *_HEIGHT_RANGE))

    depth = heights((usual.palm_disc_m - usual.palm_joint_m)[:, 2]) + swelling_m
    discs = usual.palm_disc_m * [1.0, rng.uniform(*_BREADTH), rng.uniform(*_ARCH)]
    discs = discs + size * _JOINT_SD_M * rng.normal(size=(6, 3))
    discs = discs - discs[0]
    discs = discs @ wrist_axes(discs, towards=np.array([0.0, 0.0, 1.0]))
    anatomy = dataclasses.replace(
        usual,
        palm_disc_m=discs,
        palm_joint_m=discs - np.outer(depth, [0.0, 0.0, 1.0]),
        fan_rad=usual.fan_rad + rng.normal(0.0, _FAN_SD_RAD, 5),
        thumb_offset_m=heights(usual.thumb_offset_m) * digit_swelling,
        finger_offset_m=heights(usual.finger_offset_m) * digit_swelling,
    )
    along_m, below_m = (rng.uniform(*limits) * size for limits in _WRIST_JOINT_M)
    flat = disc_centres(anatomy, np.zeros(17))
    radius_m = disc_radii(flat, spec.marker_protocol, rng.uniform(*_DISC_RADIUS_M))
    return dataclasses.replace(
        patient,
        anatomy=anatomy,
        wrist_joint_m=np.array([along_m, 0.0, -below_m]),
        disc_radius_m=radius_m,
        digit_width=rng.uniform(*_DIGIT_WIDTH) * digit_swelling,
        stuck_off_m=_stuck_off_m(flat, radius_m, anatomy.hand_length_m / 0.180, rng),
    )


def _stuck_off_m(flat_m: FloatArray, radius_m: FloatArray, size: float, rng: np.random.Generator) -> FloatArray:
    """Displacement (21, 2) of each disc from its place (21, 3), distally and to the radial side; nobody sticks a disc
    onto its neighbour."""
    off_m = np.zeros((len(SITES), 2))
    mirror = -1.0 if flat_m[2, 1] < 0.0 else 1.0
    for row, name in enumerate(SITES):
        share = _OFF_SHARE.get(name, _OFF_SHARE.get(name[:3], 1.0))
        others = np.delete(np.arange(len(off_m)), row)
        for _ in range(_TRIES):
            reach_m, way = MOST_OFF_M * share * np.sqrt(rng.uniform()) * min(size, 1.0), rng.uniform(0.0, 2.0 * np.pi)
            tried = reach_m * np.array([np.cos(way), np.sin(way) * (_SLIM if share < 1.0 else 1.0)])
            places = flat_m[:, :2] + off_m * [1.0, mirror]
            gap = np.linalg.norm(places[others] - (flat_m[row, :2] + tried * [1.0, mirror]), axis=1)
            usual = np.linalg.norm(flat_m[others] - flat_m[row], axis=1)
            if (gap >= np.minimum(radius_m[others] + radius_m[row] + _LEAST_GAP_M, usual)).all():
                off_m[row] = tried
                break
    return off_m
