"""Finger angles by name, range and colour, and their values in tracked frames.

MCP, PIP, DIP, spread and TAM of five fingers. The thumb has no PIP joint: its row shows palmar abduction. Spread is
measured from the middle finger, the thumb's from the edge of the palm, and that of the middle finger towards the thumb.
TAM is the sum of a finger's flexion.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Literal

import numpy as np

from carpus.core.measures.motion_range import plausible_joints
from carpus.core.measures.signals import BoolArray
from carpus.core.model.hand.kinematics import DIP_PER_PIP
from carpus.core.model.hand.protocols import MarkerProtocol, markers_at_joint
from carpus.core.model.phrase import Phrase, phrase
from carpus.core.model.rounding import format_rounded
from carpus.core.model.types import FloatArray, TrackedFrame, TrackStatus
from carpus.ui.kit import numbers
from carpus.ui.kit.translate import to_mid_sentence, tr, translate_phrase
from carpus.ui.words.terms import finger_name, long_finger_name

AngleKind = Literal["knuckle", "middle", "end", "spread", "tam"]
ANGLE_KINDS: tuple[AngleKind, ...] = ("knuckle", "middle", "end", "spread")
FINGERS = (1, 2, 3, 4, 5)
# Colours of the curves of a finger's angles.
KIND_TOKENS: dict[AngleKind, str] = {
    "knuckle": "flexion", "middle": "deviation", "end": "rotation", "spread": "flexion", "tam": "accent",
}  # fmt: skip
_JOINTS: dict[AngleKind, str] = {"knuckle": "MCP{}_flexion", "middle": "PIP{}_flexion", "end": "DIP{}_flexion"}
_THUMB_JOINTS: dict[AngleKind, str] = {
    "knuckle": "MCP1_flexion", "middle": "CMC1_abduction", "end": "IP1_flexion", "spread": "CMC1_extension",
}  # fmt: skip


_KIND_NAMES: Mapping[str, Phrase] = {
    "lift": phrase("Palmar abduction"), "knuckle": phrase("MCP"), "middle": phrase("PIP"), "end": phrase("DIP"),
    "ip": phrase("IP"), "spread": phrase("Ab-/adduction"), "tam": phrase("TAM"),
}  # fmt: skip


@dataclass(frozen=True, slots=True)
class FingerAngle:
    """One angle of one finger; ``joint`` is its name in files, ``TAM3`` for total active motion."""

    finger: int
    kind: AngleKind

    @property
    def joint(self) -> str:
        if self.kind == "tam":
            return f"TAM{self.finger}"
        if self.finger == 1:
            return _THUMB_JOINTS[self.kind]
        return f"MCP{self.finger}_abduction" if self.kind == "spread" else _JOINTS[self.kind].format(self.finger)

    @property
    def is_palmar_abduction(self) -> bool:
        """Whether it is the thumb's palmar abduction, which stands in the row of the PIP joints."""
        return self.finger == 1 and self.kind == "middle"

    @property
    def token(self) -> str:
        return KIND_TOKENS[self.kind]

    @property
    def sign(self) -> float:
        """Factor from the angle in files to the displayed one, whose spread points away from the middle finger."""
        return -1.0 if self.kind == "spread" and self.finger in (4, 5) else 1.0

    @property
    def range_deg(self) -> tuple[float, float]:
        if self.kind == "spread":
            return -30.0, 30.0
        if self.is_palmar_abduction:
            return 0.0, 60.0
        return 0.0, {"tam": 140.0 if self.finger == 1 else 270.0}.get(self.kind, 120.0)

    @property
    def kind_name(self) -> str:
        """Name of its row."""
        if self.finger == 1 and self.kind == "end":
            return kind_name("ip")
        return kind_name("lift" if self.is_palmar_abduction else self.kind)

    @property
    def long_name(self) -> str:
        """Name with the finger, such as ``Ring finger, PIP``."""
        return _long_name(self)

    @property
    def short_name(self) -> str:
        """Name of the finger alone, such as ``Ring``."""
        return finger_name(str(self.finger))

    @property
    def range_end_names(self) -> tuple[str, str]:
        return _end_names(self)


# All that can be the large number, finger by finger.
FINGER_ANGLES: tuple[FingerAngle, ...] = tuple(
    FingerAngle(finger, row) for finger in FINGERS for row in (*ANGLE_KINDS, "tam")
)


def kind_name(kind: AngleKind | Literal["lift", "ip"]) -> str:
    """Return the name of a kind of angle."""
    return translate_phrase(_KIND_NAMES[kind])


def _long_name(angle: FingerAngle) -> str:
    joint = angle.kind_name if angle.kind == "tam" else to_mid_sentence(angle.kind_name)
    return tr("{finger}, {joint}").format(finger=long_finger_name(str(angle.finger)), joint=joint)


def _end_names(angle: FingerAngle) -> tuple[str, str]:
    low, high = (f"{format_rounded(abs(value))}°" for value in angle.range_deg)
    if angle.is_palmar_abduction:
        return tr("In the plane of the palm (0°)"), tr("Palmar abduction {angle}").format(angle=high)
    if angle.kind != "spread":
        return tr("Extended"), tr("Flexed {angle}").format(angle=high)
    if angle.finger == 3:
        return tr("Ulnar {angle}").format(angle=low), tr("Radial {angle}").format(angle=high)
    return tr("Adducted {angle}").format(angle=low), tr("Abducted {angle}").format(angle=high)


def spread_side(value_deg: float, finger: int = 0) -> str:
    """Return ``in`` or ``out`` (middle finger: ``radial``, ``ulnar``); empty near zero and if unknown."""
    if not abs(value_deg) >= 0.5:
        return ""
    if finger == 3:
        return tr("ulnar") if value_deg < 0 else tr("radial")
    return tr("add.") if value_deg < 0 else tr("abd.")


def format_spread(value_deg: float, finger: int = 0) -> str:
    """Return a spread angle with its side, such as ``12° out``."""
    return f"{numbers.format_degrees(value_deg)} {spread_side(value_deg, finger)}".strip()


def spread_labels(tick_deg: float, finger: int = 0) -> tuple[tuple[float, str], ...]:
    """Return the tick labels of a spread axis: ``Out 20°``, ``0°``, ``In 20°``."""
    angle = numbers.format_degrees(tick_deg)
    out, inward = tr("Abd. {angle}"), tr("Add. {angle}")
    if finger == 3:
        out, inward = tr("Radial {angle}"), tr("Ulnar {angle}")
    out, inward = out.format(angle=angle), inward.format(angle=angle)
    return (tick_deg, out), (0.0, "0°"), (-tick_deg, inward)


def progress_measure_name(joint: str) -> str:
    """Return the name of the measure that is followed for every finger."""
    figure = find_finger_angle(joint)
    return (
        tr("Total active motion (TAM)")
        if figure.kind == "tam"
        else tr("{row}, range of motion").format(row=figure.kind_name)
    )


def find_finger_angle(joint: str) -> FingerAngle:
    """Return the angle of a joint name, the middle finger's PIP joint if there is none."""
    return next((figure for figure in FINGER_ANGLES if figure.joint == joint), FingerAngle(3, "middle"))


@dataclass(frozen=True, slots=True)
class AngleWeights:
    """Linear map from the joint angles (J,) of a file to the finger angles (F,).

    ``weight`` (F, J); ``is_inferred`` (F,): no marker of its own measures the angle.
    """

    weight: FloatArray
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
    return AngleWeights(weight, np.array(inferred))


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
        Times (n,), angles and standard deviations in degrees (n, F), whether measured (n, F), and marker visibility
        (n, M).
    """
    names = joint_names(protocol, len(frames[-1].kinematics.joint_angles_rad))
    mixed = angle_weights(names)
    angles = np.array([frame.kinematics.joint_angles_rad for frame in frames])
    sds = np.array([frame.kinematics.joint_angles_sd_rad for frame in frames])
    seen = np.isfinite(np.array([frame.marker_measured_px for frame in frames])[..., 0])
    impossible = ~plausible_joints(names, angles)
    value = np.degrees(np.where(impossible, 0.0, angles) @ mixed.weight.T)
    sd = np.degrees(np.sqrt(np.where(impossible, 0.0, sds) ** 2 @ mixed.weight.T**2))
    of_it = impossible.astype(float) @ np.abs(mixed.weight.T) > 0.0
    value[of_it] = sd[of_it] = math.nan
    tracked = np.array([frame.status == TrackStatus.TRACKED for frame in frames])
    lost = np.array([frame.status == TrackStatus.LOST for frame in frames])
    value[lost] = sd[lost] = math.nan
    measured = find_measured_angles(protocol, seen) & tracked[:, None] & np.isfinite(value)
    return np.array([frame.timestamp_s for frame in frames]), value, sd, measured, seen
