"""Finger angles of tracked frames: values, standard deviations, and whether they were measured."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from carpus.core.measures.finger_range import plausible_joints
from carpus.core.model.hand.kinematics import DIP_PER_PIP
from carpus.core.model.hand.protocols import MarkerProtocol, markers_at_joint
from carpus.core.model.types import FloatArray, TrackedFrame, TrackStatus
from carpus.ui.words.finger_angles import FINGER_ANGLES, FingerAngle

BoolArray = NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class AngleWeights:
    """Linear map from the joint angles (J,) of a file to the finger angles (F,).

    Parameters
    ----------
    weight
            Weights (F, J).
    variance_weight
            Weights of the variances (F, J).
    is_inferred
            True where no marker of its own measures an angle (F,).
    """

    weight: FloatArray
    variance_weight: FloatArray
    is_inferred: BoolArray


def joint_names(protocol: MarkerProtocol, count: int) -> tuple[str, ...]:
    """Return the names of ``count`` joint angles of a protocol, with coupled or with free DIP joints."""
    coupled = protocol.joint_names()
    return coupled if len(coupled) == count else protocol.joint_names(dip_free=True)


@lru_cache(maxsize=4)
def angle_weights(names: tuple[str, ...]) -> AngleWeights:
    """Return the weights for joint angles of these names; NaN for an angle that they do not determine."""
    weight = np.zeros((len(FINGER_ANGLES), len(names)))
    for row, figure in enumerate(FINGER_ANGLES):
        parts = [figure]
        if figure.kind == "tam":
            parts = [FingerAngle(figure.finger, part) for part in ("knuckle", "middle", "end") if figure.finger > 1]
            parts = parts or [FingerAngle(1, "knuckle"), FingerAngle(1, "end")]
        for part in parts:
            if part.joint in names:
                weight[row, names.index(part.joint)] += part.sign
            elif (follows := f"PIP{part.finger}_flexion") in names:
                weight[row, names.index(follows)] += DIP_PER_PIP
            else:
                weight[row] = math.nan
    inferred = [
        figure.kind == "end"
        and figure.finger > 1
        and f"PIP{figure.finger}_flexion" in names
        and figure.joint not in names
        for figure in FINGER_ANGLES
    ]
    return AngleWeights(weight, weight**2, np.array(inferred))


@lru_cache(maxsize=4)
def _marker_requirements(protocol: MarkerProtocol) -> tuple[BoolArray, BoolArray]:
    """Return the markers (F, M) that an angle needs, and whether the protocol has them all (F,).

    A joint needs the marker over it and the next one distally.
    """
    out, has = (
        np.zeros((len(FINGER_ANGLES), len(protocol.markers)), dtype=bool),
        np.ones(len(FINGER_ANGLES), dtype=bool),
    )
    for row, figure in enumerate(FINGER_ANGLES):
        joints = [figure.joint]
        if figure.kind == "tam":
            joints = ["MCP1_flexion", "IP1_flexion"] if figure.finger == 1 else []
            joints = joints or [f"MCP{figure.finger}_flexion", f"PIP{figure.finger}_flexion"]
        discs = {disc for joint in joints for disc in markers_at_joint(joint)}
        has[row] = discs <= set(protocol.markers)
        out[row, [protocol.markers.index(disc) for disc in discs if has[row]]] = True
    return out, has


def find_measured_angles(protocol: MarkerProtocol, is_visible: BoolArray) -> BoolArray:
    """Return which angles (n, F) are measured, given which markers (n, M) are visible."""
    needed, has = _marker_requirements(protocol)
    return np.asarray(~(~is_visible[:, None] & needed).any(axis=2) & has, dtype=np.bool_)


def estimate_finger_angles(
    protocol: MarkerProtocol, frames: Sequence[TrackedFrame]
) -> tuple[FloatArray, FloatArray, FloatArray, BoolArray, BoolArray]:
    """Return the finger angles of frames.

    Returns
    -------
    tuple
            Times (n,), angles and standard deviations in degrees (n, F), whether measured (n, F), and marker
        visibility (n, M).
    """
    names = joint_names(protocol, len(frames[-1].kinematics.joint_angles_rad))
    mixed = angle_weights(names)
    angles = np.array([frame.kinematics.joint_angles_rad for frame in frames])
    sds = np.array([frame.kinematics.joint_angles_sd_rad for frame in frames])
    seen = np.isfinite(np.array([frame.marker_measured_px for frame in frames])[..., 0])
    impossible = ~plausible_joints(names, angles)
    value = np.degrees(np.where(impossible, 0.0, angles) @ mixed.weight.T)
    sd = np.degrees(np.sqrt(np.where(impossible, 0.0, sds) ** 2 @ mixed.variance_weight.T))
    of_it = impossible.astype(float) @ np.abs(mixed.weight.T) > 0.0
    value[of_it] = sd[of_it] = math.nan
    tracked = np.array([frame.status == TrackStatus.TRACKED for frame in frames])
    lost = np.array([frame.status == TrackStatus.LOST for frame in frames])
    value[lost] = sd[lost] = math.nan
    measured = find_measured_angles(protocol, seen) & tracked[:, None] & np.isfinite(value)
    return np.array([frame.timestamp_s for frame in frames]), value, sd, measured, seen
