"""The last seconds of the finger joints as arrays ready to draw, and how well each disc has been seen."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from core.hand.kinematics import DIP_PER_PIP
from core.hand.protocols import HAND21, joint_angle_names
from core.measures.fingers import possible_joints
from core.types import FloatArray, TrackedFrame, TrackStatus
from ui.figures import FIGURES, Figure
from ui.live.history import KEPT_S
from ui.plot.series import Series

Seen = Literal["seen", "partly", "hidden"]
SHARE_S = 0.4
"""How well a disc is seen is judged over this long: hidden after 0.3 s, and seen again as soon."""
SEEN_SHARE, HIDDEN_SHARE = 0.75, 0.25
EVERY = 3
"""Small panels draw every third frame: ten points a second, two pixels each on a large screen."""

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


@dataclass(frozen=True, slots=True)
class Block:
    """Samples of all figures: ``time_s`` (n,), ``value_deg``, ``sd_deg`` and ``predicted`` (n, F)."""

    time_s: FloatArray
    value_deg: FloatArray
    sd_deg: FloatArray
    predicted: BoolArray


class JointHistory:
    """Frames in, arrays of the last ten seconds out, degrees; figures in the order of :data:`ui.figures.FIGURES`."""

    def __init__(self) -> None:
        self.clear()

    def clear(self) -> None:
        """Forget everything, as before another recording."""
        count = len(FIGURES)
        self.last_index = -1
        self._mix = mix(17)
        self._time_s = np.empty(0)
        self._index = np.empty(0, dtype=np.int64)
        self._value = np.empty((0, count))
        self._sd = np.empty((0, count))
        self._speed = np.full(count, math.nan)
        self._measured = np.empty((0, count), dtype=bool)
        self._seen = np.empty((0, len(HAND21.markers)), dtype=bool)
        self._tracked = np.empty(0, dtype=bool)

    def append(self, frames: Sequence[TrackedFrame]) -> None:
        """Add frames in order; what is older than needed goes."""
        fresh = [frame for frame in frames if frame.index > self.last_index and len(frame.joint_angles_rad)]
        if not fresh:
            return
        self.last_index = fresh[-1].index
        time_s, value, sd, measured, seen = figures_of(fresh)
        mixed = self._mix = mix(len(fresh[-1].joint_angles_rad))
        self._speed = np.degrees(mixed.weight @ fresh[-1].joint_velocity_rad_s)
        kept = self._time_s >= time_s[-1] - KEPT_S
        self._time_s = np.concatenate((self._time_s[kept], time_s))
        self._index = np.concatenate((self._index[kept], [frame.index for frame in fresh]))
        self._value = np.concatenate((self._value[kept], value))
        self._sd = np.concatenate((self._sd[kept], sd))
        self._measured = np.concatenate((self._measured[kept], measured))
        self._seen = np.concatenate((self._seen[kept], seen))
        tracked = [frame.status == TrackStatus.TRACKED for frame in fresh]
        self._tracked = np.concatenate((self._tracked[kept], tracked))

    def __len__(self) -> int:
        return len(self._time_s)

    @property
    def now_s(self) -> float:
        """Time of the newest frame, NaN before the first."""
        return float(self._time_s[-1]) if len(self._time_s) else math.nan

    def value(self, figure: int) -> tuple[float, float, bool]:
        """Newest value, its standard deviation, and whether its discs have been seen of late, as :meth:`seen` says."""
        if not len(self._time_s):
            return math.nan, math.nan, False
        value, sd = float(self._value[-1, figure]), float(self._sd[-1, figure])
        visible = self._recent_share() >= HIDDEN_SHARE
        shown = bool(measured_figures(visible[None])[0, figure]) and bool(self._tracked[-1])
        return value, sd, shown and math.isfinite(value)

    def speed(self, figure: int) -> float:
        """Newest speed, degrees per second."""
        return float(self._speed[figure])

    def inferred(self, figure: int) -> bool:
        """Whether the figure only follows another joint."""
        return bool(self._mix.inferred[figure])

    def series(self, figure: int) -> Series:
        """The curve of a figure with its band, every third frame."""
        part = slice(None)
        if len(self._index) > 2:
            part = self._index % EVERY == 0  # type: ignore[assignment]
        predicted = ~self._measured[part, figure]
        if self.inferred(figure):
            predicted = np.ones_like(predicted)
        return Series(self._time_s[part], self._value[part, figure], self._sd[part, figure], predicted)

    def block(self, start_s: float) -> Block:
        """All curves from a time on, every third frame."""
        part = (self._time_s >= start_s) & (self._index % EVERY == 0)
        predicted = ~self._measured[part] | self._mix.inferred
        return Block(self._time_s[part], self._value[part], self._sd[part], predicted)

    def seen(self) -> dict[str, Seen]:
        """How well each disc has been seen of late: light, map, cells and the large number all go by it."""
        if not len(self._time_s):
            return dict.fromkeys(HAND21.markers, "hidden")
        return {
            name: "seen" if part >= SEEN_SHARE else "hidden" if part < HIDDEN_SHARE else "partly"
            for name, part in zip(HAND21.markers, self._recent_share().tolist(), strict=True)
        }

    @property
    def infers(self) -> bool:
        """Whether the end joints only follow the middle joints."""
        return bool(self._mix.inferred.any())

    def _recent_share(self) -> FloatArray:
        return np.asarray(self._seen[self._time_s >= self._time_s[-1] - SHARE_S].mean(axis=0))


def figures_of(frames: Sequence[TrackedFrame]) -> tuple[FloatArray, FloatArray, FloatArray, BoolArray, BoolArray]:
    """Times (n,), values and standard deviations (n, F) in degrees, supported (n, F), discs seen (n, M)."""
    mixed = mix(len(frames[-1].joint_angles_rad))
    angles = np.array([frame.joint_angles_rad for frame in frames])
    sds = np.array([frame.joint_angles_sd_rad for frame in frames])
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
