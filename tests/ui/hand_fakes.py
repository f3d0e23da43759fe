"""Stored sessions of the whole hand: a simulated fist whose fingertips go out of sight where a camera loses them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from datetime import datetime, timedelta

import numpy as np

from carpus.core.model.hand.protocols import HAND21, joint_angle_names
from carpus.core.records.values import SessionEntry
from carpus.core.results.repetition_rows import RepetitionChoices
from carpus.core.session.values import Event, MarkerSeries, Motion, QualitySeries, Session
from carpus.core.simulation.recording import SimulatedRecording
from tests.ui.fakes import FPS, NOW, FakeSessions, build_session, cache_sessions, simulated

SECONDS, SPEED_HZ = 40.0, 0.2
JOINT_SD_DEG = 2.0
SD_GROWS_DEG_S = 12.0
HIDES_BEYOND_DEG = 55.0
"Bending of the middle joint beyond which the finger's outer discs are not seen."


@cache_sessions
def hand_session(
    when: datetime = NOW,
    share: float = 1.0,
    exercise: str = "FIST_COMPOSITE",
    session_id: str = "hand-7",
    motion: str = "fist",
    hides_beyond_deg: float = HIDES_BEYOND_DEG,
    hidden: Sequence[tuple[float, float, str]] = (),
    lost: Sequence[tuple[float, float]] = (),
    side: str = "right",
) -> Session:
    """A session whose joints bend by a share of the simulated motion.

    ``hidden`` (start_s, end_s, marker) and ``lost`` (start_s, end_s) in seconds after the first frame.
    """
    pictures = simulated(motion, SECONDS, SPEED_HZ, side, "hand21")
    truth = pictures.truth
    names = joint_angle_names(False)
    time_s = truth.timestamp_s - truth.timestamp_s[0]
    count = len(time_s)
    rng = np.random.default_rng(2)
    wobble = np.cumsum(rng.normal(0.0, 0.25, (count, len(names))), axis=0)
    wobble = np.clip(wobble - np.linspace(0, 1, count)[:, None] * wobble[-1], -3.0, 3.0)
    joints = share * truth.joint_angles_rad + np.radians(wobble) * 0.5
    measured = truth.marker_px + rng.normal(0.0, 0.2, truth.marker_px.shape)
    for finger in (2, 3, 4, 5):
        bent = np.degrees(joints[:, names.index(f"PIP{finger}_flexion")]) > hides_beyond_deg + 4 * (finger - 3)
        for joint in ("DIP", "TIP"):
            measured[bent, HAND21.markers.index(f"{joint}{finger}")] = math.nan
    for start_s, end_s, marker in hidden:
        measured[(time_s >= start_s) & (time_s < end_s), HAND21.markers.index(marker)] = math.nan
    sd_deg = np.full(joints.shape, JOINT_SD_DEG)
    at = np.array([HAND21.markers.index(name.split("_")[0]) for name in names])
    unseen = ~(np.isfinite(measured[:, at, 0]) & np.isfinite(measured[:, at + 1, 0]))
    since = np.zeros(len(names))
    for row in range(count):
        since = np.where(unseen[row], since + 1.0 / FPS, 0.0)
        sd_deg[row] += SD_GROWS_DEG_S * np.sqrt(since)
    status = np.zeros(count, dtype=np.int64)
    gone = np.zeros(count, dtype=bool)
    for start_s, end_s in lost:
        gone |= (time_s >= start_s) & (time_s < end_s)
    status[gone] = 2
    measured[gone] = math.nan
    known = np.where(gone, math.nan, 1.0)
    motion_values = Motion(
        position_m=truth.position_m * known[:, None],
        velocity_m_s=truth.velocity_m_s * known[:, None],
        w0_turn_rad=np.zeros((count, 3)) * known[:, None],
        rotation_w2_w0=truth.rotation_w2_w0 * known[:, None, None],
        angular_velocity_rad_s=truth.angular_velocity_rad_s * known[:, None],
        angles_rad=truth.angles_rad * known[:, None],
        angles_sd_rad=np.radians(np.tile([0.4, 0.9, 1.2], (count, 1))) * known[:, None],
        angles_zyz_rad=np.full((count, 3), math.nan),
        joint_angles_rad=joints * known[:, None],
        joint_angles_sd_rad=np.radians(sd_deg) * known[:, None],
        joint_velocity_rad_s=truth.joint_velocity_rad_s * known[:, None],
        joint_position_m=truth.joint_position_w0_m * known[:, None, None],
    )
    return build_session(
        pictures, when, exercise, session_id,
        (Event(float(truth.timestamp_s[300]), "note", "Swelling less than last week."),),
        status=status, motion=motion_values,
        markers=MarkerSeries(
            truth.marker_position_cam_m * known[:, None, None],
            measured,
            np.where(np.isfinite(measured[..., 0]), truth.marker_position_cam_m[..., 2], math.nan),
            np.zeros(measured.shape[:2], dtype=bool),
        ),
        quality=QualitySeries(
            np.zeros(count, int), np.ones((count, len(names))), np.full(count, 30.0), np.full(count, 60)
        ),
    )  # fmt: skip


class FakeHandSessions(FakeSessions):
    """Five sessions of a fist that gets better; in the last one the thumb was covered for a while."""

    def __init__(self, pictures: bool = True) -> None:
        days, shares = (35, 28, 21, 7, 0), (0.55, 0.62, 0.74, 0.86, 1.0)
        self.sessions: dict[str, Session] = {}
        for number, (day, share) in enumerate(zip(days, shares, strict=True), 3):
            hidden = [(9.0, 14.0, "IP1"), (9.0, 14.0, "TIP1")] if day == 0 else []
            self.sessions[f"hand-{number}"] = hand_session(
                NOW - timedelta(days=day), share, session_id=f"hand-{number}", hidden=hidden, hides_beyond_deg=62.0,
                lost=[(31.0, 32.0)] if day == 0 else [],
            )  # fmt: skip
        self.kept: dict[str, RepetitionChoices] = {}
        self.results: list[SessionEntry] = []
        self.pictures = pictures

    def pictures_of(self, side: str) -> SimulatedRecording:
        return simulated("fist", SECONDS, SPEED_HZ, side, "hand21")


def without_hidden(session: Session) -> Session:
    """The same with every disc seen in every frame."""
    measured = np.where(np.isfinite(session.markers.measured_px), session.markers.measured_px, 100.0)
    return replace(session, markers=replace(session.markers, measured_px=measured))
