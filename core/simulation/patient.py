"""Simulated patient: bones and markers of one hand, drawn around the average hand of its size.

A wide anatomy varies what a prior must not assume: heights of markers over the joints, shape of the palm, fan of the
fingers, thickness of the digits, wrist centre, markers of 10 to 14 mm placed some millimetres off, swelling.
"""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass, field

import numpy as np

from carpus.core.model.hand.anatomy import HandAnatomy, anatomy_from_size
from carpus.core.model.hand.clinical_angles import wrist_axes
from carpus.core.model.hand.kinematics import disc_centres
from carpus.core.model.hand.protocols import PALM_SITES, SITES, MarkerProtocol
from carpus.core.model.types import FloatArray
from carpus.core.simulation.spec import RandomStream, RecordingSpec

WRIST_JOINT_DEPTH_M = 0.015
"""Depth of the wrist centre under the WRIST marker of a hand 180 mm long (reference 2)."""

MARKER_RADIUS_M, SMALL_MARKER_RADIUS_M = 0.006, 0.004
"""Markers are 12 mm wide, 8 mm at the ends of small fingers and on children (reference 2)."""
_MIN_SPACING_M = 0.0145
"""Two markers of 12 mm that are nearer would touch: small ones are used."""

_THUMB_ROLL_DEG = (54.0, 4.0)
"""Mean and scatter; below the reference's 60, as a marker on a thumb rolled further is not visible."""
_LENGTH_RANGE_M = {False: (0.130, 0.200), True: (0.150, 0.200)}
"""Without and with finger markers, which touch at the end of a smaller little finger."""
_SEGMENT_SD, _FLESH_SD, _OFFSET_SD = 0.05, 0.08, 0.03
_MARKER_POSITION_SD_M = np.array([0.0007, 0.0007, 0.0007])


@dataclass(frozen=True, slots=True)
class SimulatedPatient:
    """Hand of a patient: anatomy in W with its side.

    Attributes
    ----------
    wrist_joint_m : (3,) centre of the wrist's rotation in W
    marker_radius_m : (21,)
    size : hand length over 180 mm
    digit_width : of the digits over the usual width
    placement_error_m : (21, 2) of each marker, distally and to the radial side
    """

    anatomy: HandAnatomy
    wrist_joint_m: FloatArray
    marker_radius_m: FloatArray
    size: float
    digit_width: float = 1.0
    placement_error_m: FloatArray = field(default_factory=lambda: np.zeros((21, 2)))


def sample_patient(spec: RecordingSpec) -> SimulatedPatient:
    """Draw a patient: segments vary by 5 %, flesh by 8 %, marker places by 0.7 mm."""
    rng = spec.generator(RandomStream.PATIENT)
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
    markers = average.palm_disc_m + size * _MARKER_POSITION_SD_M * rng.normal(size=(6, 3))
    markers = markers - markers[0]
    markers = markers @ wrist_axes(markers, dorsal_direction=np.array([0.0, 0.0, 1.0]))
    flesh = rng.normal(1.0, _FLESH_SD)
    depth = (average.palm_disc_m - average.palm_joint_m)[:, 2] * rng.normal(flesh, _OFFSET_SD, 6)
    anatomy = dataclasses.replace(
        average,
        palm_disc_m=markers,
        palm_joint_m=markers - np.outer(depth, [0.0, 0.0, 1.0]),
        fan_rad=average.fan_rad + np.radians(rng.normal(0.0, [3.0, 1.5, 1.0, 1.5, 1.5])),
        thumb_roll_rad=float(np.radians(np.clip(rng.normal(*_THUMB_ROLL_DEG), 44.0, 62.0))),
        thumb_length_m=average.thumb_length_m * rng.normal(1.0, _SEGMENT_SD, 3),
        finger_length_m=average.finger_length_m * rng.normal(1.0, _SEGMENT_SD, (4, 3)),
        thumb_offset_m=average.thumb_offset_m * rng.normal(flesh, _OFFSET_SD, 3),
        finger_offset_m=average.finger_offset_m * rng.normal(flesh, _OFFSET_SD, (4, 3)),
    )
    return SimulatedPatient(
        anatomy,
        np.array([0.0, 0.0, -WRIST_JOINT_DEPTH_M * size]),
        marker_radii(disc_centres(anatomy, np.zeros(17)), spec.marker_protocol),
        size,
    )


def marker_radii(flat_m: FloatArray, protocol: MarkerProtocol, nominal_m: float = MARKER_RADIUS_M) -> FloatArray:
    """Return the radius (21,) of each marker at positions (21, 3) of the straight hand.

    All are small on a palm that is too narrow for large ones, and those at the ends of the fingers if two would touch.
    """
    used = list(protocol.sites)
    gap = np.linalg.norm(flat_m[used][:, None] - flat_m[used][None], axis=-1) + np.eye(len(used))
    is_tight = np.zeros(len(SITES), dtype=bool)
    is_tight[used] = gap.min(axis=1) < _MIN_SPACING_M + 2.0 * (nominal_m - MARKER_RADIUS_M)
    ends = [row for row, name in enumerate(SITES) if name[:3] in ("DIP", "TIP") and name != "TIP1"]
    radius = np.full(len(SITES), nominal_m)
    if is_tight[list(PALM_SITES)].any():
        radius[:] = SMALL_MARKER_RADIUS_M
    elif is_tight.any():
        radius[ends] = SMALL_MARKER_RADIUS_M
    return radius


MAX_PLACEMENT_ERROR_M = 0.005
"""Of a marker on the palm; half on a finger, where creases show its place."""
_PLACEMENT_SHARE = {"TIP": 0.3, "PIP": 0.5, "DIP": 0.4, "MCP1": 0.5, "IP1": 0.5}
_MIN_GAP_M, _MAX_TRIES = 0.002, 40
_SIDEWAYS_SHARE = 0.4
"""Placement error across a finger as a share of that along it."""
_WIDE_FLESH_SD, _HEIGHT_SD, _HEIGHT_RANGE = 0.12, 0.12, (0.7, 1.5)
_BREADTH, _ARCH = (0.90, 1.12), (0.5, 1.5)
_JOINT_SD_M = np.array([0.0025, 0.0015, 0.0])
_FAN_SD_RAD = np.radians(2.0)
_DIGIT_WIDTH = (0.8, 1.25)
_MARKER_RADIUS_RANGE_M = (0.005, 0.007)
_WRIST_JOINT_M = ((-0.004, 0.006), (0.012, 0.020))
"""Along X from the WRIST marker's place, and below it, of a hand 180 mm long."""
_SWOLLEN_CHANCE = 0.3
_SWELLING_M, _SWOLLEN_DIGIT = (0.002, 0.005), (1.1, 1.25)


def sample_wide_anatomy(patient: SimulatedPatient, spec: RecordingSpec) -> SimulatedPatient:
    """Draw the patient with a more varied anatomy."""
    rng = spec.generator(RandomStream.ANATOMY)
    size, usual = patient.size, patient.anatomy
    swollen = rng.random() < _SWOLLEN_CHANCE
    swelling_m, digit_swelling = (
        rng.uniform(*_SWELLING_M) * size * swollen,
        1.0 + (rng.uniform(*_SWOLLEN_DIGIT) - 1.0) * swollen,
    )
    flesh = rng.normal(1.0, _WIDE_FLESH_SD)

    def heights(usual_m: FloatArray) -> FloatArray:
        return np.asarray(usual_m * np.clip(rng.normal(flesh, _HEIGHT_SD, usual_m.shape), *_HEIGHT_RANGE))

    depth = heights((usual.palm_disc_m - usual.palm_joint_m)[:, 2]) + swelling_m
    markers = usual.palm_disc_m * [1.0, rng.uniform(*_BREADTH), rng.uniform(*_ARCH)]
    markers = markers + size * _JOINT_SD_M * rng.normal(size=(6, 3))
    markers = markers - markers[0]
    markers = markers @ wrist_axes(markers, dorsal_direction=np.array([0.0, 0.0, 1.0]))
    anatomy = dataclasses.replace(
        usual,
        palm_disc_m=markers,
        palm_joint_m=markers - np.outer(depth, [0.0, 0.0, 1.0]),
        fan_rad=usual.fan_rad + rng.normal(0.0, _FAN_SD_RAD, 5),
        thumb_offset_m=heights(usual.thumb_offset_m) * digit_swelling,
        finger_offset_m=heights(usual.finger_offset_m) * digit_swelling,
    )
    along_m, below_m = (rng.uniform(*limits) * size for limits in _WRIST_JOINT_M)
    flat = disc_centres(anatomy, np.zeros(17))
    radius_m = marker_radii(flat, spec.marker_protocol, rng.uniform(*_MARKER_RADIUS_RANGE_M))
    return dataclasses.replace(
        patient,
        anatomy=anatomy,
        wrist_joint_m=np.array([along_m, 0.0, -below_m]),
        marker_radius_m=radius_m,
        digit_width=rng.uniform(*_DIGIT_WIDTH) * digit_swelling,
        placement_error_m=_sample_placement_error_m(flat, radius_m, anatomy.hand_length_m / 0.180, rng),
    )


def _sample_placement_error_m(
    flat_m: FloatArray, radius_m: FloatArray, size: float, rng: np.random.Generator
) -> FloatArray:
    """Draw the displacement (21, 2) of each marker, distal and radial; no marker overlaps another."""
    off_m = np.zeros((len(SITES), 2))
    mirror = -1.0 if flat_m[2, 1] < 0.0 else 1.0
    for row, name in enumerate(SITES):
        share = _PLACEMENT_SHARE.get(name, _PLACEMENT_SHARE.get(name[:3], 1.0))
        others = np.delete(np.arange(len(off_m)), row)
        for _ in range(_MAX_TRIES):
            reach_m, way = (
                MAX_PLACEMENT_ERROR_M * share * np.sqrt(rng.uniform()) * min(size, 1.0),
                rng.uniform(0.0, 2.0 * np.pi),
            )
            tried = reach_m * np.array([np.cos(way), np.sin(way) * (_SIDEWAYS_SHARE if share < 1.0 else 1.0)])
            places = flat_m[:, :2] + off_m * [1.0, mirror]
            gap = np.linalg.norm(places[others] - (flat_m[row, :2] + tried * [1.0, mirror]), axis=1)
            usual = np.linalg.norm(flat_m[others] - flat_m[row], axis=1)
            if (gap >= np.minimum(radius_m[others] + radius_m[row] + _MIN_GAP_M, usual)).all():
                off_m[row] = tried
                break
    return off_m
