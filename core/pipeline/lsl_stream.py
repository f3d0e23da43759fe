"""Live angles, positions, quality and events over Lab Streaming Layer (``carpus[stream]``).

There are two outlets, off by default: ``Carpus`` of type ``MoCap``, one sample a frame, and ``CarpusEvents`` of type
``Markers``. Samples have the capture time of their frame on LSL's clock.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np

from carpus.core.calibration.result import Clicks
from carpus.core.model.errors import ExtraMissing
from carpus.core.model.hand.protocols import WRIST_ANGLES, MarkerProtocol
from carpus.core.model.types import TrackedFrame

NAME, EVENTS_NAME = "Carpus", "CarpusEvents"
LIVE_ID = "carpus-live"
"""Source identity, by which a listener finds the stream again."""


class Channel(NamedTuple):
    """Channel of a sample: label, marker or joint, kind by the MoCap meta-data, unit."""

    label: str
    marker: str
    kind: str
    unit: str


def list_channels(protocol: MarkerProtocol, joint_names: Sequence[str]) -> tuple[Channel, ...]:
    """Return the channels of a sample in order."""
    found = [Channel("status", "", "Status", "0 tracked, 1 predicted, 2 lost, 3 doubtful")]
    found += [Channel(f"wrist_{name}", "WRIST", "Angle", "degrees") for name in WRIST_ANGLES]
    found += [Channel(f"wrist_{name}_sd", "WRIST", "AngleDeviation", "degrees") for name in WRIST_ANGLES]
    for name in joint_names:
        found += [Channel(name, name.split("_")[0], "Angle", "degrees")]
    for name in joint_names:
        found += [Channel(f"{name}_sd", name.split("_")[0], "AngleDeviation", "degrees")]
    for marker in protocol.markers:
        found += [Channel(f"{marker}_{axis}", marker, f"Position{axis.upper()}", "meters") for axis in "xyz"]
    return (*found, Channel("measured_share", "", "Confidence", "share"), Channel("nis", "", "Quality", "1"))


def build_sample(frame: TrackedFrame) -> list[float]:
    """Return the values of a frame in the order of :func:`list_channels`; unknown ones are NaN."""
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


class SampleStream:
    """Two open outlets of a hand, to be used by one thread; raises :class:`ExtraMissing` without pylsl.

    ``clock`` gives the LSL time of the first frame and is called once; default is the time when it comes.
    """

    def __init__(
        self, clicks: Clicks, rate_hz: float, *, dip_free: bool, clock: Callable[[], float] | None = None
    ) -> None:
        lsl = import_pylsl()
        channels = list_channels(clicks.protocol, clicks.protocol.joint_names(dip_free))
        info = lsl.StreamInfo(NAME, "MoCap", len(channels), rate_hz, lsl.cf_float32, LIVE_ID)
        about = info.desc()
        about.append_child_value("manufacturer", "Carpus")
        about.append_child_value("hand", clicks.side)
        about.append_child_value("frame", "axes of the colour camera: x right, y down, z forward")
        listed = about.append_child("channels")
        for channel in channels:
            entry = listed.append_child("channel")
            for name, text in (
                ("label", channel.label), ("marker", channel.marker), ("object", "hand"), ("type", channel.kind),
                ("unit", channel.unit),
            ):  # fmt: skip
                entry.append_child_value(name, text)
        marks = lsl.StreamInfo(EVENTS_NAME, "Markers", 1, lsl.IRREGULAR_RATE, lsl.cf_string, f"{LIVE_ID}-events")
        self._samples, self._events = lsl.StreamOutlet(info), lsl.StreamOutlet(marks)
        self._clock = clock or lsl.local_clock
        self._offset_s: float | None = None

    def on_frame(self, frame: TrackedFrame) -> None:
        """Send the sample of a frame with its capture time."""
        self._samples.push_sample(build_sample(frame), self._lsl_time_s(frame.timestamp_s))

    def on_event(self, time_s: float, kind: str) -> None:
        """Send an event, its kind alone: a note may contain names."""
        self._events.push_sample([kind], self._lsl_time_s(time_s))

    def has_listener(self, timeout_s: float) -> bool:
        """Return whether a listener connects within a time."""
        return bool(self._samples.wait_for_consumers(timeout_s))

    def _lsl_time_s(self, time_s: float) -> float:
        if self._offset_s is None:
            self._offset_s = self._clock() - time_s
        return time_s + self._offset_s


def import_pylsl() -> Any:
    """Import pylsl; raises :class:`ExtraMissing` if it or its library is missing."""
    try:
        import pylsl
    except (ImportError, RuntimeError, OSError) as cause:
        raise ExtraMissing("pylsl") from cause
    return pylsl
