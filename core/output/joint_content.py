"""What review, progress and report say of the joints of the whole hand, in degrees; NaN is unknown."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from carpus.core.hand.sites import joint_angle_names
from carpus.core.measures.fingers import (
    FINGERS,
    JointTrack,
    TotalMotion,
    joint_range,
    joint_track,
    joints_seen,
    possible_joints,
    total_active_motion,
    valid_joints,
)
from carpus.core.measures.repetitions import Repetition
from carpus.core.output.exercises import Exercise
from carpus.core.output.range_rows import RangeRow, RowKey, best_motion, range_row
from carpus.core.session.values import Session
from carpus.core.types import FloatArray


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


def joint_tracks(session: Session) -> dict[str, JointTrack]:
    """Every joint by its name; empty for the wrist alone."""
    curves = joint_curves(session)
    if curves is None:
        return {}
    angles, sds = np.radians(curves.angles_deg), np.radians(curves.sds_deg)
    return {
        name: joint_track(name, curves.time_s, angles[:, k], sds[:, k], curves.seen[:, k], session.smoothed is not None)
        for k, name in enumerate(curves.names)
    }


def joint_rows(
    tracks: Mapping[str, JointTrack], counted: Sequence[Repetition], exercise: Exercise
) -> tuple[RangeRow, ...]:
    """TAM of every finger, then arc, most and least bent of every joint. ``extension`` rows hold the least bent angle
    with its sign: what is missing to straight, below zero bent back."""
    rows: list[RangeRow] = []
    if tracks and exercise.total:
        for finger in FINGERS:
            joints, inferred = bending_joints(finger, tuple(tracks))
            if set(joints) <= set(tracks):
                own = [tracks[name] for name in joints]
                rows += _total_rows(total_active_motion(finger, own, counted, inferred=inferred))
    for name, track in tracks.items():
        found = joint_range(track, counted)
        share = track.seen_share
        for row in (
            range_row("arc", -1, found.arc, found.top_limited or found.bottom_limited),
            range_row("flexion", -1, found.maximum, found.top_limited),
            range_row("extension", -1, found.minimum, found.bottom_limited),
        ):
            rows.append(replace(row, joint=name, seen_share=share))
    return tuple(rows)


def bending_joints(finger: int, names: Sequence[str]) -> tuple[tuple[str, ...], bool]:
    """Names of the joints that bend a finger, base first, and whether its end joint is inferred, not measured."""
    if finger == 1:
        return ("MCP1_flexion", "IP1_flexion"), False
    end = f"DIP{finger}_flexion"
    measured = (f"MCP{finger}_flexion", f"PIP{finger}_flexion")
    return ((*measured, end), False) if end in names else (measured, True)


def finger_keys(finger: int) -> tuple[RowKey, ...]:
    """What is followed of one finger: its total, then the arcs of its joints; of finger 0 the totals of all."""
    if finger == 0:
        return tuple((f"TAM{k}", "arc", -1) for k in FINGERS)
    joints, _ = bending_joints(finger, joint_angle_names(True))
    return ((f"TAM{finger}", "arc", -1), *((name, "arc", -1) for name in joints))


def spread_keys() -> tuple[RowKey, ...]:
    """The arcs of spreading, thumb to little finger."""
    names = ("CMC1_extension", *(f"MCP{k}_abduction" for k in FINGERS[1:]))
    return tuple((name, "arc", -1) for name in names)


def thumb_keys() -> tuple[RowKey, ...]:
    """What is followed where the thumb's base is trained: its lift and spread first, then its bending."""
    names = ("CMC1_abduction", "CMC1_extension", *bending_joints(1, joint_angle_names(True))[0])
    return tuple((name, "arc", -1) for name in names)


def _total_rows(total: TotalMotion) -> list[RangeRow]:
    row = range_row("arc", -1, total.total, total.limited)
    deficit = range_row("extension", -1, total.deficit, total.limited)
    flexion = range_row("flexion", -1, total.flexion, total.limited)
    return [
        replace(item, joint=f"TAM{total.finger}", seen_share=total.seen_share, inferred=total.inferred)
        for item in (row, flexion, deficit)
    ]
