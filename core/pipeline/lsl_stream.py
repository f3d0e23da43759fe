"""Live angles, positions, quality and events for other programs over Lab Streaming Layer (``carpus[stream]``).

Two outlets, off by default: ``Carpus`` of type ``MoCap``, one sample a picture, and ``CarpusEvents`` of type
``Markers``. Every sample has the time at which its picture was taken, on LSL's own clock.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from carpus.core.calibration.result import Clicks
from carpus.core.model.errors import ExtraMissing
from carpus.core.model.hand.protocols import WRIST_ANGLES, MarkerProtocol
from carpus.core.model.types import TrackedFrame

NAME, EVENTS_NAME = "Carpus", "CarpusEvents"
LIVE_ID = "carpus-live"
"""The source's identity while the window measures: by it a listener finds the stream again."""


class Channel(NamedTuple):
    """One number of a sample: ``label``, ``marker`` or joint it is of, ``kind`` by the MoCap meta-data, ``unit``."""

    label: str
    marker: str
    kind: str
    unit: str


def list_channels(protocol: MarkerProtocol, joint_names: Sequence[str]) -> tuple[Channel, ...]:
    """What a sample holds, in order."""
    out = [Channel("status", "", "Status", "0 tracked, 1 predicted, 2 lost, 3 doubtful")]
    out += [Channel(f"wrist_{name}", "WRIST", "Angle", "degrees") for name in WRIST_ANGLES]
    out += [Channel(f"wrist_{name}_sd", "WRIST", "AngleDeviation", "degrees") for name in WRIST_ANGLES]
    for name in joint_names:
        out += [Channel(name, name.split("_")[0], "Angle", "degrees")]
    for name in joint_names:
        out += [Channel(f"{name}_sd", name.split("_")[0], "AngleDeviation", "degrees")]
    for marker in protocol.markers:
        out += [Channel(f"{marker}_{axis}", marker, f"Position{axis.upper()}", "meters") for axis in "xyz"]
    return (*out, Channel("measured_share", "", "Confidence", "share"), Channel("nis", "", "Quality", "1"))


def build_sample(frame: TrackedFrame) -> list[float]:
    """The numbers of a frame in the order of :func:`list_channels`; NaN where not known."""
    share = frame.measured_share[np.isfinite(frame.measured_share)]
    return [
        float(frame.status),
        *np.degrees(frame.kinematics.angles_rad).tolist(),
        *np.degrees(frame.kinematics.angles_sd_rad).tolist(),
        *np.degrees(frame.kinematics.joint_angles_rad).tolist(),
        *np.degrees(frame.kinematics.joint_angles_sd_rad).tolist(),
        *frame.marker_position_cam_m.ravel().tolist(),
        float(share.mean()) if len(share) else float("nan"),
        float(frame.nis),
    ]


@dataclass(slots=True)
class SampleStream:
    """Two open outlets; used by one thread. ``wall`` and ``monotonic`` clocks are injectable."""

    _samples: Any
    _events: Any
    _offset_s: Callable[[float], float]

    @classmethod
    def open(
        cls, clicks: Clicks, rate_hz: float, *, dip_free: bool, clock: Callable[[], float] | None = None
    ) -> SampleStream:
        """Offer both outlets of the hand that was clicked; the first picture was taken at what ``clock``, asked once,
        says in LSL's time: without it when it comes. Raises :class:`ExtraMissing` without pylsl."""
        lsl = import_pylsl()
        said = list_channels(clicks.protocol, clicks.protocol.joint_names(dip_free))
        info = lsl.StreamInfo(NAME, "MoCap", len(said), rate_hz, lsl.cf_float32, LIVE_ID)
        about = info.desc()
        about.append_child_value("manufacturer", "Carpus")
        about.append_child_value("hand", clicks.side)
        about.append_child_value("frame", "axes of the colour camera: x right, y down, z forward")
        listed = about.append_child("channels")
        for channel in said:
            one = listed.append_child("channel")
            for name, text in (
                ("label", channel.label), ("marker", channel.marker), ("object", "hand"), ("type", channel.kind),
                ("unit", channel.unit),
            ):  # fmt: skip
                one.append_child_value(name, text)
        marks = lsl.StreamInfo(EVENTS_NAME, "Markers", 1, lsl.IRREGULAR_RATE, lsl.cf_string, f"{LIVE_ID}-events")
        return cls(lsl.StreamOutlet(info), lsl.StreamOutlet(marks), _make_clock_offset(clock or lsl.local_clock))

    def on_frame(self, frame: TrackedFrame) -> None:
        """One picture, with the time it was taken."""
        self._samples.push_sample(build_sample(frame), frame.timestamp_s + self._offset_s(frame.timestamp_s))

    def on_event(self, time_s: float, kind: str) -> None:
        """Something that happened: its kind alone, for a note may name somebody."""
        self._events.push_sample([kind], time_s + self._offset_s(time_s))

    def has_listener(self, timeout_s: float) -> bool:
        """Whether somebody listens, within this time."""
        return bool(self._samples.wait_for_consumers(timeout_s))


def _make_clock_offset(clock: Callable[[], float]) -> Callable[[float], float]:
    known: list[float] = []

    def offset_s(time_s: float) -> float:
        if not known:
            known.append(clock() - time_s)
        return known[0]

    return offset_s


def import_pylsl() -> Any:
    """Pylsl. Raises :class:`ExtraMissing` where it, or the library it brings, is not there."""
    try:
        import pylsl
    except (ImportError, RuntimeError, OSError) as cause:
        raise ExtraMissing("pylsl") from cause
    return pylsl
