"""What of a session was seen well enough to be measured, and its angles as they are drawn."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

import numpy as np

from carpus.core.hand.exercises import Exercise, exercise_named
from carpus.core.hand.forearm_rotation import read_wrist_angles
from carpus.core.measures.fingers import JointTrack, joint_track, joints_seen, possible_joints, valid_joints
from carpus.core.measures.signals import BoolArray, Signal, even_signal, settled, valid_view, valid_wrist_angles
from carpus.core.session.values import Motion, Session
from carpus.core.types import FloatArray


def best_motion(session: Session) -> Motion:
    """The smoother's result where there is one, else the filter's."""
    return session.motion if session.smoothed is None else session.smoothed


def read_angles_rad(session: Session) -> FloatArray:
    """The wrist's angles (N, 3) as a clinician reads them, by the smoother where there is one."""
    exercise = exercise_named(session.header.exercise)
    return read_wrist_angles(best_motion(session).angles_rad, exercise, session.calibration.start_angles_rad)


@dataclass(frozen=True, slots=True)
class ReportCurves:
    """Angles over the session as they are drawn: ``time_s`` (N,) after the first frame, the rest (N, 3).

    The wrist's are counted as :func:`core.hand.forearm_rotation.read_wrist_angles` says.
    """

    time_s: FloatArray
    angles_deg: FloatArray
    sds_deg: FloatArray
    status: FloatArray


def session_curves(session: Session) -> ReportCurves:
    """Angles ready to draw."""
    motion = best_motion(session)
    time_s = session.timestamp_s - session.timestamp_s[0] if len(session) else np.empty(0)
    return ReportCurves(
        time_s, np.degrees(read_angles_rad(session)), np.degrees(motion.angles_sd_rad), np.asarray(session.status)
    )


@dataclass(frozen=True, slots=True)
class JointCurves:
    """Joint angles over the session as they are drawn: ``time_s`` (N,) after the first frame, angles and sds (N, J),
    ``seen`` bool (N, J) where the angle was measured directly and counts."""

    names: tuple[str, ...]
    time_s: FloatArray
    angles_deg: FloatArray
    sds_deg: FloatArray
    seen: np.ndarray


def joint_curves(session: Session) -> JointCurves | None:
    """Curves of a session of the whole hand; None for the wrist alone."""
    names = session.header.joint_names
    if not names:
        return None
    motion = best_motion(session)
    seen = joints_seen(names, session.header.protocol.markers, session.markers.measured_px)
    possible = possible_joints(names, motion.joint_angles_rad)
    angles = np.where(possible, motion.joint_angles_rad, np.nan)
    sds = np.where(possible, motion.joint_angles_sd_rad, np.nan)
    return JointCurves(
        names=names,
        time_s=session.timestamp_s - session.timestamp_s[:1],
        angles_deg=np.degrees(angles),
        sds_deg=np.degrees(sds),
        seen=valid_joints(session.status, seen, angles, sds),
    )


def joint_tracks(session: Session, only: Collection[str] | None = None) -> dict[str, JointTrack]:
    """Every joint by its name, or ``only`` some; empty for the wrist alone."""
    curves = joint_curves(session)
    if curves is None:
        return {}
    angles, sds = np.radians(curves.angles_deg), np.radians(curves.sds_deg)
    return {
        name: joint_track(name, curves.time_s, angles[:, k], sds[:, k], curves.seen[:, k], session.smoothed is not None)
        for k, name in enumerate(curves.names)
        if only is None or name in only
    }


def seen_well(session: Session) -> BoolArray:
    """Frames (N,) that the camera saw well enough to measure the wrist."""
    motion, palm = best_motion(session), list(session.header.protocol.palm)
    view = valid_view(
        session.status, session.markers.measured_px[:, palm], motion.rotation_w2_w0, session.calibration.rotation_w0_cam
    )
    return settled(view, session.timestamp_s - session.timestamp_s[:1])


def wrist_signals(session: Session, view: BoolArray) -> list[Signal]:
    """The wrist's three angles as they are read, each with its sd, with gaps where it was not seen well."""
    angles_rad, sds_rad = read_angles_rad(session), best_motion(session).angles_sd_rad
    valid = valid_wrist_angles(view, angles_rad, sds_rad)
    time_s = session.timestamp_s - session.timestamp_s[:1]
    return [even_signal(time_s, np.column_stack((angles_rad[:, k], sds_rad[:, k])), valid[:, k]) for k in range(3)]


@dataclass(frozen=True, slots=True)
class SeenSession:
    """A session with what of it may be measured: ``view`` (N,) the frames that show the palm well, ``signals`` the
    wrist's three angles, ``tracks`` every joint by its name."""

    session: Session
    exercise: Exercise
    view: BoolArray
    signals: list[Signal]
    tracks: dict[str, JointTrack]

    @classmethod
    def of(cls, session: Session, joints: Collection[str] | None = None) -> SeenSession:
        """By the rules of the ranges; ``joints`` alone where no other is asked for."""
        view = seen_well(session)
        exercise = exercise_named(session.header.exercise)
        return cls(session, exercise, view, wrist_signals(session, view), joint_tracks(session, joints))
