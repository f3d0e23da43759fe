"""Valid data of a session: what was seen well enough to be measured, and curves to draw."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

import numpy as np

from carpus.core.measures.motion_range import JointTrack, joint_track, plausible_joints, valid_joints, visible_joints
from carpus.core.measures.signals import (
    BoolArray,
    Signal,
    exclude_view_edges,
    resample_evenly,
    valid_view,
    valid_wrist_angles,
)
from carpus.core.model.hand.exercises import Exercise, get_exercise
from carpus.core.model.hand.forearm_rotation import to_clinical_wrist_angles
from carpus.core.model.types import FloatArray
from carpus.core.session.values import Motion, Session


def motion_estimate(session: Session) -> Motion:
    """Return the smoother's result if there is one, else the filter's."""
    return session.motion if session.smoothed is None else session.smoothed


def clinical_angles_rad(session: Session) -> FloatArray:
    """Return the wrist angles (N, 3) as a clinician reads them."""
    exercise = get_exercise(session.header.exercise)
    return to_clinical_wrist_angles(motion_estimate(session).angles_rad, exercise, session.calibration.start_angles_rad)


@dataclass(frozen=True, slots=True)
class WristCurves:
    """Wrist angles as drawn: ``time_s`` (N,) after the first frame, the rest (N, 3).

    Counted as in :func:`core.model.hand.forearm_rotation.to_clinical_wrist_angles`.
    """

    time_s: FloatArray
    angles_deg: FloatArray
    sds_deg: FloatArray
    status: FloatArray


def wrist_curves(session: Session) -> WristCurves:
    """Return the wrist angles as they are drawn."""
    motion = motion_estimate(session)
    time_s = session.timestamp_s - session.timestamp_s[0] if len(session) else np.empty(0)
    return WristCurves(
        time_s, np.degrees(clinical_angles_rad(session)), np.degrees(motion.angles_sd_rad), np.asarray(session.status)
    )


@dataclass(frozen=True, slots=True)
class JointCurves:
    """Joint angles as drawn: ``time_s`` (N,) after the first frame, angles and sds (N, J).

    ``is_valid`` (N, J): measured directly and possible.
    """

    names: tuple[str, ...]
    time_s: FloatArray
    angles_deg: FloatArray
    sds_deg: FloatArray
    is_valid: np.ndarray


def joint_curves(session: Session) -> JointCurves | None:
    """Return the joint angles as they are drawn, None for the wrist alone."""
    names = session.header.joint_names
    if not names:
        return None
    motion = motion_estimate(session)
    seen = visible_joints(names, session.header.protocol.markers, session.markers.measured_px)
    possible = plausible_joints(names, motion.joint_angles_rad)
    angles = np.where(possible, motion.joint_angles_rad, np.nan)
    sds = np.where(possible, motion.joint_angles_sd_rad, np.nan)
    return JointCurves(
        names=names,
        time_s=session.timestamp_s - session.timestamp_s[:1],
        angles_deg=np.degrees(angles),
        sds_deg=np.degrees(sds),
        is_valid=valid_joints(session.status, seen, angles, sds),
    )


def joint_tracks(session: Session, names: Collection[str] | None = None) -> dict[str, JointTrack]:
    """Return all joints, or those in ``names``; empty for the wrist alone."""
    curves = joint_curves(session)
    if curves is None:
        return {}
    angles, sds = np.radians(curves.angles_deg), np.radians(curves.sds_deg)
    return {
        name: joint_track(
            name, curves.time_s, angles[:, k], sds[:, k], curves.is_valid[:, k], session.smoothed is not None
        )
        for k, name in enumerate(curves.names)
        if names is None or name in names
    }


def palm_in_view(session: Session) -> BoolArray:
    """Return frames (N,) in which the palm was seen well enough to measure the wrist."""
    motion, palm = motion_estimate(session), list(session.header.protocol.palm)
    view = valid_view(
        session.status, session.markers.measured_px[:, palm], motion.rotation_w2_w0, session.calibration.rotation_w0_cam
    )
    return exclude_view_edges(view, session.timestamp_s - session.timestamp_s[:1])


@dataclass(frozen=True, slots=True)
class MeasurableSession:
    """Session with what may be measured of it.

    ``is_in_view`` (N,): frames that show the palm well; ``signals``: the three clinical wrist angles with their sd, and
    gaps where the palm was not in view; ``tracks``: the joints.
    """

    session: Session
    exercise: Exercise
    is_in_view: BoolArray
    signals: list[Signal]
    tracks: dict[str, JointTrack]

    @classmethod
    def from_session(cls, session: Session, joints: Collection[str] | None = None) -> MeasurableSession:
        """Apply the validity rules; ``joints`` limits the joints."""
        view = palm_in_view(session)
        angles_rad, sds_rad = clinical_angles_rad(session), motion_estimate(session).angles_sd_rad
        valid, time_s = valid_wrist_angles(view, angles_rad, sds_rad), session.timestamp_s - session.timestamp_s[:1]
        both = np.stack((angles_rad, sds_rad), axis=-1)
        signals = [resample_evenly(time_s, both[:, k], valid[:, k]) for k in range(3)]
        return cls(session, get_exercise(session.header.exercise), view, signals, joint_tracks(session, joints))
