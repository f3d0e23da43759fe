"""One session on its way into other formats."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from carpus.core.formats.even import EvenTimes, even_times, rate_of
from carpus.core.measures.by_hand import HandValue
from carpus.core.results.figures import SessionFigures
from carpus.core.results.repetition_rows import on_clock
from carpus.core.session.values import Event, Session
from carpus.core.types import FloatArray

CAMERA_AXES = "axes of the colour camera: x right, y down in its picture, z forward"
W0_AXES = (
    "W0, the hand's axes at the neutral pose: origin WRIST disc, X to the MCP3 disc, Z out of the back of the hand"
)
ANGLES_MEAN = (
    "deviation + radial, flexion + flexion, pronosupination + supination on both hands; "
    "ZYX Euler angles of the hand W2 in W0; joints: zero is the straight finger, + bends, + spreads to the thumb's side"
)


@dataclass(frozen=True, slots=True)
class Take:
    """``name`` without ending, the same for every file of it; ``provenance`` what it was made from, by what."""

    session: Session
    figures: SessionFigures
    name: str
    provenance: Mapping[str, Any]
    by_hand: tuple[HandValue, ...] = ()
    """What a person measured by hand on the day of the session, of its hand and of the person; never in the figures."""

    @property
    def even(self) -> EvenTimes:
        """Its times as a format of even sampling has them."""
        return even_times(self.session.timestamp_s, rate_of(self.session))


class About(NamedTuple):
    """What a format needs of a session when all are written."""

    name: str
    subject_id: str
    hand: str
    exercise: str
    recorded: str
    simulated: bool
    provenance: Mapping[str, Any]


def about(take: Take) -> About:
    """Of one session."""
    header = take.session.header
    return About(
        take.name, header.subject_id, header.hand, header.exercise, header.recorded, header.simulated, take.provenance
    )


def repetition_events(take: Take) -> list[Event]:
    """Start, peak and end of every repetition as shown, on the clock of the frames, for formats that know moments."""
    if not len(take.session):
        return []
    start_s, out = float(take.session.timestamp_s[0]), []
    for number, one in enumerate(take.figures.repetitions, 1):
        if one.row is not None:
            said = f"{number}" if one.row.counted else f"{number}, not counted: {one.row.reason.replace('_', ' ')}"
            row = on_clock(one.row, start_s)
            for kind, time_s in (("start", row.start_s), ("peak", row.peak_s), ("end", row.end_s)):
                if math.isfinite(time_s):
                    out.append(Event(time_s, f"repetition_{kind}", said))
    return out


def joint_centres_cam_m(session: Session) -> FloatArray:
    """Joint centres and tips (N, M, 3) in camera axes; (N, 0, 3) without fingers."""
    calibration = session.calibration
    turned = session.motion.joint_position_m @ calibration.rotation_w0_cam.T
    return np.asarray(turned + calibration.translation_w0_cam_m)


def measured(session: Session) -> np.ndarray:
    """Whether each marker was seen in each frame, (N, M)."""
    return np.asarray(np.isfinite(session.markers.measured_px).all(axis=-1))


def number(value: float, digits: int) -> str:
    """A number in a table; not known is empty, and nothing is minus nothing.

    >>> number(-0.0001, 3), number(float("nan"), 3)
    ('0.000', '')
    """
    if value != value:
        return ""
    text = f"{value:.{digits}f}"
    return text[1:] if text.startswith("-") and not text.strip("-0.") else text
