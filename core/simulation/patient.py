"""Who is simulated: the bones and discs of one hand, drawn around the average hand of its size."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass, field

import numpy as np

from carpus.core.hand.anatomy import HandAnatomy, anatomy_from_size
from carpus.core.hand.kinematics import disc_centres
from carpus.core.hand.protocols import MarkerProtocol
from carpus.core.hand.sites import PALM_SITES, SITES
from carpus.core.hand.wrist_frame import wrist_axes
from carpus.core.simulation.spec import RandomStream, RecordingSpec
from carpus.core.types import FloatArray

WRIST_JOINT_DEPTH_M = 0.015
"""Depth of the wrist's centre of rotation under the WRIST disc of a hand 180 mm long (reference 2)."""

DISC_RADIUS_M, SMALL_DISC_RADIUS_M = 0.006, 0.004
"""The paper discs are 12 mm wide, 8 mm at the ends of small fingers and on children (reference 2)."""
_LEAST_SPACING_M = 0.0145
"""Two discs of 12 mm nearer than this would nearly touch: the therapist takes small ones."""

_THUMB_ROLL_DEG = (54.0, 4.0)
"""Mean and scatter; below the reference's 60, as a disc on a thumb rolled further cannot be seen from above."""
_LENGTH_RANGE_M = {False: (0.130, 0.200), True: (0.150, 0.200)}
"""Hands drawn, without and with discs on fingers. On smaller ones those at the end of the little
finger touch: only when asked for."""
_SEGMENT_SD, _FLESH_SD, _OFFSET_SD = 0.05, 0.08, 0.03
_DISC_PLACE_SD_M = np.array([0.0007, 0.0007, 0.0007])


@dataclass(frozen=True, slots=True)
class Patient:
    """``anatomy`` in W with its side; ``wrist_joint_m`` (3,) centre of the wrist's rotation in W;
    ``disc_radius_m`` (21,); ``size`` hand length over 180 mm; ``digit_width`` of the digits over the usual;
    ``stuck_off_m`` (21, 2) of each disc from its place in the anatomy, distally and to the radial side."""

    anatomy: HandAnatomy
    wrist_joint_m: FloatArray
    disc_radius_m: FloatArray
    size: float
    digit_width: float = 1.0
    stuck_off_m: FloatArray = field(default_factory=lambda: np.zeros((21, 2)))


def patient_of(spec: RecordingSpec) -> Patient:
    """Draw a patient: segments vary by 5 %, flesh by 8 %, disc places by 0.7 mm around the reference's table."""
    rng = spec.random(RandomStream.PATIENT)
    drawn_m = rng.uniform(*_LENGTH_RANGE_M[spec.marker_protocol.has_fingers])
    length_m = drawn_m if spec.hand_length_mm is None else spec.hand_length_mm / 1000.0
    size = length_m / 0.180
    breadth_m = length_m * rng.uniform(0.43, 0.47)
    average = anatomy_from_size(
        length_m,
        breadth_m,
        side=spec.hand,
        arch=rng.uniform(0.75, 1.1),
        skin_offsets=spec.skin_offsets,
        nail_discs=True,
    )
    discs = average.palm_disc_m + size * _DISC_PLACE_SD_M * rng.normal(size=(6, 3))
    discs = discs - discs[0]
    discs = discs @ wrist_axes(discs, towards=np.array([0.0, 0.0, 1.0]))
    flesh = rng.normal(1.0, _FLESH_SD)
    depth = (average.palm_disc_m - average.palm_joint_m)[:, 2] * rng.normal(flesh, _OFFSET_SD, 6)
    anatomy = dataclasses.replace(
        average,
        palm_disc_m=discs,
        palm_joint_m=discs - np.outer(depth, [0.0, 0.0, 1.0]),
        fan_rad=average.fan_rad + np.radians(rng.normal(0.0, [3.0, 1.5, 1.0, 1.5, 1.5])),
        thumb_roll_rad=float(np.radians(np.clip(rng.normal(*_THUMB_ROLL_DEG), 44.0, 62.0))),
        thumb_length_m=average.thumb_length_m * rng.normal(1.0, _SEGMENT_SD, 3),
        finger_length_m=average.finger_length_m * rng.normal(1.0, _SEGMENT_SD, (4, 3)),
        thumb_offset_m=average.thumb_offset_m * rng.normal(flesh, _OFFSET_SD, 3),
        finger_offset_m=average.finger_offset_m * rng.normal(flesh, _OFFSET_SD, (4, 3)),
    )
    return Patient(
        anatomy,
        np.array([0.0, 0.0, -WRIST_JOINT_DEPTH_M * size]),
        disc_radii(disc_centres(anatomy, np.zeros(17)), spec.marker_protocol),
        size,
    )


def disc_radii(flat_m: FloatArray, protocol: MarkerProtocol, usual_m: float = DISC_RADIUS_M) -> FloatArray:
    """Radius of each disc of ``hand21``, at places (21, 3) of the straight hand, usually ``usual_m``: all small on a
    hand whose palm is too narrow for large ones, and at the ends of the fingers where two discs of the protocol would
    nearly touch."""
    used = list(protocol.sites)
    gap = np.linalg.norm(flat_m[used][:, None] - flat_m[used][None], axis=-1) + np.eye(len(used))
    is_tight = np.zeros(len(SITES), dtype=bool)
    is_tight[used] = gap.min(axis=1) < _LEAST_SPACING_M + 2.0 * (usual_m - DISC_RADIUS_M)
    ends = [row for row, name in enumerate(SITES) if name[:3] in ("DIP", "TIP") and name != "TIP1"]
    radius = np.full(len(SITES), usual_m)
    if is_tight[list(PALM_SITES)].any():
        radius[:] = SMALL_DISC_RADIUS_M
    elif is_tight.any():
        radius[ends] = SMALL_DISC_RADIUS_M
    return radius
