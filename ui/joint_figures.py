"""From tracked frames to the figures of the whole hand: values, how sure they are, and whether they were measured."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from carpus.core.hand.kinematics import DIP_PER_PIP
from carpus.core.hand.protocols import HAND21, joint_angle_names
from carpus.core.measures.fingers import possible_joints
from carpus.core.types import FloatArray, TrackedFrame, TrackStatus
from carpus.ui.figures import FIGURES, Figure

BoolArray = NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class Mix:
    """How the figures (F,) come from the joint angles (J,) of every file and from the discs (M,) seen.

    ``weight`` (F, J); ``variance_weight`` (F, J) for variances; ``inferred`` (F,) where no disc of its own can tell.
    """

    weight: FloatArray
    variance_weight: FloatArray
    inferred: BoolArray


@lru_cache(maxsize=2)
def mix(joint_count: int) -> Mix:
    """For the 17 angles with coupled end joints, or for all 21."""
    dip_free = joint_count > 17
    names = joint_angle_names(dip_free)
    weight = np.zeros((len(FIGURES), len(names)))
    for row, figure in enumerate(FIGURES):
        parts = [figure]
        if figure.row == "tam":
            parts = [Figure(figure.finger, part) for part in ("knuckle", "middle", "end") if figure.finger > 1]
            parts = parts or [Figure(1, "knuckle"), Figure(1, "end")]
        for part in parts:
            if part.joint in names:
                weight[row, names.index(part.joint)] += part.sign
            else:
                weight[row, names.index(f"PIP{part.finger}_flexion")] += DIP_PER_PIP
    inferred = np.array([figure.row == "end" and figure.finger > 1 and not dip_free for figure in FIGURES])
    return Mix(weight, weight**2, inferred)


@lru_cache(maxsize=1)
def _needed() -> BoolArray:
    """Discs (F, M) a figure needs: of a joint the one over it and the next one outwards, as in every file's figures."""
    out = np.zeros((len(FIGURES), len(HAND21.markers)), dtype=bool)
    for row, figure in enumerate(FIGURES):
        joints = [figure.joint]
        if figure.row == "tam":
            joints = ["MCP1_flexion", "IP1_flexion"] if figure.finger == 1 else []
            joints = joints or [f"MCP{figure.finger}_flexion", f"PIP{figure.finger}_flexion"]
        for joint in joints:
            first = HAND21.markers.index(joint.split("_")[0])
            out[row, first : first + 2] = True
    return out


def measured_figures(seen: BoolArray) -> BoolArray:
    """Which figures (n, F) are seen where discs (n, M) are."""
    return np.asarray(~(~seen[:, None] & _needed()).any(axis=2), dtype=np.bool_)


def figures_of(frames: Sequence[TrackedFrame]) -> tuple[FloatArray, FloatArray, FloatArray, BoolArray, BoolArray]:
    """Times (n,), values and standard deviations (n, F) in degrees, supported (n, F), discs seen (n, M)."""
    mixed = mix(len(frames[-1].moment.joint_angles_rad))
    angles = np.array([frame.moment.joint_angles_rad for frame in frames])
    sds = np.array([frame.moment.joint_angles_sd_rad for frame in frames])
    seen = np.isfinite(np.array([frame.marker_measured_px for frame in frames])[..., 0])
    impossible = ~possible_joints(joint_angle_names(angles.shape[1] > 17), angles)
    value = np.degrees(np.where(impossible, 0.0, angles) @ mixed.weight.T)
    sd = np.degrees(np.sqrt(np.where(impossible, 0.0, sds) ** 2 @ mixed.variance_weight.T))
    of_it = impossible.astype(float) @ np.abs(mixed.weight.T) > 0.0
    value[of_it] = sd[of_it] = math.nan
    tracked = np.array([frame.status == TrackStatus.TRACKED for frame in frames])
    lost = np.array([frame.status == TrackStatus.LOST for frame in frames])
    value[lost] = sd[lost] = math.nan
    measured = measured_figures(seen) & tracked[:, None] & np.isfinite(value)
    return np.array([frame.timestamp_s for frame in frames]), value, sd, measured, seen
