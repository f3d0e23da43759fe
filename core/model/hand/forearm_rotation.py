"""The zero of pronation and supination, and the conversion between its two conventions.

Two zeros are in use (clinical reference 1.2), each under a name of its own:

- ``pronosupination``, in every file: the angle phi of the hand's frame, + = supination on both hands, from the **palm
  down** (the neutral pose, or what a therapist measured it to be: ``/calibration/start_angles``).
- Supination and pronation, in all that a clinician reads or enters: of the forearm, from the **thumb up**. A palm flat
  on the table is at 90 degrees of pronation, of which the forearm's own joints give 80 to 90.

Where the rotation only accompanies another movement it is neither: it is the rotation from the start.
"""

from __future__ import annotations

import math

import numpy as np

from carpus.core.model.hand.exercises import AXIS_LIMIT_DEG, AXIS_TICK_DEG, PRONOSUPINATION, Exercise
from carpus.core.model.hand.protocols import WRIST_ANGLES
from carpus.core.model.types import FloatArray

PALM_DOWN_PRONATION_DEG = 90.0  # Pronation, from thumb up, of a palm that lies flat on the table.


def supination_from_thumb_up(pronosupination_rad: FloatArray) -> FloatArray:
    """Return supination (+) and pronation (-) from thumb up, in (-pi, pi], of the files' angle.

    >>> np.degrees(supination_from_thumb_up(np.radians([0.0, 90.0, 180.0, -180.0]))).round(9) + 0.0
    array([-90.,   0.,  90.,  90.])
    """
    turned = pronosupination_rad - math.radians(PALM_DOWN_PRONATION_DEG)
    return np.asarray(math.pi - np.mod(math.pi - turned, 2.0 * math.pi))


def to_clinical_rad(name: str, angle_rad: FloatArray) -> FloatArray:
    """Return an angle of the files as a clinician reads it: pronosupination from thumb up."""
    return supination_from_thumb_up(angle_rad) if name == WRIST_ANGLES[PRONOSUPINATION] else angle_rad


def pronosupination_from_palm_down(supination_rad: FloatArray) -> FloatArray:
    """Return the files' angle, in (-pi, pi]; inverse of :func:`supination_from_thumb_up`."""
    turned = supination_rad + math.radians(PALM_DOWN_PRONATION_DEG)
    return np.asarray(math.pi - np.mod(math.pi - turned, 2.0 * math.pi))


def is_counted_from_thumb_up(exercise: Exercise) -> bool:
    """Return whether an exercise trains pronation and supination, or no angle in particular."""
    return exercise.angle == PRONOSUPINATION or (exercise.angle is None and not exercise.joint)


def to_clinical_wrist_angles(angles_rad: FloatArray, exercise: Exercise, start_angles_rad: FloatArray) -> FloatArray:
    """Return the wrist's angles (..., 3) of a file as a clinician reads them.

    The third is supination from thumb up, or the rotation from the start where it accompanies another movement.
    """
    out = np.array(angles_rad, dtype=np.float64)
    turned = out[..., PRONOSUPINATION]
    if is_counted_from_thumb_up(exercise):
        out[..., PRONOSUPINATION] = supination_from_thumb_up(turned)
    else:
        out[..., PRONOSUPINATION] = turned - start_angles_rad[PRONOSUPINATION]
    return out


def axis_limits_deg(angle: int, exercise: Exercise) -> tuple[float, float]:
    """Return outermost tick and end of the fixed axis of a wrist angle in an exercise."""
    if angle == PRONOSUPINATION and is_counted_from_thumb_up(exercise):
        return PALM_DOWN_PRONATION_DEG, 1.3 * PALM_DOWN_PRONATION_DEG
    return AXIS_TICK_DEG[angle], AXIS_LIMIT_DEG[angle]


def to_clinical_targets_deg(stored_deg: tuple[float, float], exercise: Exercise | None) -> tuple[float, float]:
    """Return targets as a clinician reads them, of stored ones (from palm down); NaN for none."""
    if exercise is None or exercise.angle != PRONOSUPINATION:
        return stored_deg
    return stored_deg[0] - PALM_DOWN_PRONATION_DEG, stored_deg[1] - PALM_DOWN_PRONATION_DEG


def from_clinical_targets_deg(read_deg: tuple[float, float], exercise: Exercise | None) -> tuple[float, float]:
    """Return targets as stored; inverse of :func:`to_clinical_targets_deg`."""
    if exercise is None or exercise.angle != PRONOSUPINATION:
        return read_deg
    return read_deg[0] + PALM_DOWN_PRONATION_DEG, read_deg[1] + PALM_DOWN_PRONATION_DEG
