"""Ranges of motion as they are shown: of an angle of the wrist, a joint of the hand, or a whole finger (TAM).

The wrist's angles are the papers', or in the order of the ISB (clinical reference 1.3): the same turn has other angles
in another order, and sessions read in different orders are never compared.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from carpus.core import so3
from carpus.core.hand.clinical_angles import angle_rates_matrix, isb_from_rotation
from carpus.core.hand.exercises import PRONOSUPINATION, SIDES, Exercise, Movement
from carpus.core.hand.forearm_rotation import is_from_thumb_up
from carpus.core.hand.protocols import joint_angle_names
from carpus.core.measures.fingers import FINGERS, JointTrack, TotalMotion, joint_range, total_active_motion
from carpus.core.measures.motion_range import RangeFigure, motion_range
from carpus.core.measures.noise import HIGHEST_CUTOFF_HZ
from carpus.core.measures.repetitions import Repetition
from carpus.core.measures.signals import Signal, low_pass
from carpus.core.results.seen import SeenSession
from carpus.core.session.values import AngleOrder, Motion, Session
from carpus.core.types import FloatArray, Side

_STEP_RAD = 1e-6


def in_order(session: Session, order: AngleOrder) -> Session:
    """The session with its wrist angles and their standard deviations in an order; its turns stay as they are."""
    if order == session.angle_order:
        return session
    if session.angle_order != "zyx":
        raise ValueError(f"a session in the order {session.angle_order}")
    side = session.header.hand
    smoothed = None if session.smoothed is None else _in_isb(session.smoothed, side)
    return replace(session, motion=_in_isb(session.motion, side), smoothed=smoothed, angle_order=order)


def _in_isb(motion: Motion, side: Side) -> Motion:
    turned = motion.rotation_w2_w0
    return replace(
        motion,
        angles_rad=isb_from_rotation(turned, side),
        angles_sd_rad=isb_sd_rad(turned, motion.angles_sd_rad, side),
    )


def isb_sd_rad(rotation_w2_w0: FloatArray, angles_sd_rad: FloatArray, side: Side) -> FloatArray:
    """Standard deviations (N, 3) of the ISB's angles, from those of the papers' angles taken as independent."""
    known = np.isfinite(rotation_w2_w0).all(axis=(1, 2)) & np.isfinite(angles_sd_rad).all(axis=1)
    out = np.full(angles_sd_rad.shape, np.nan)
    turned = rotation_w2_w0[known]
    steps = so3.exp(_STEP_RAD * np.eye(3))
    here = isb_from_rotation(turned, side)
    by_turn = np.stack([(isb_from_rotation(turned @ step, side) - here) / _STEP_RAD for step in steps], axis=-1)
    by_angles = by_turn @ np.linalg.inv(angle_rates_matrix(turned, side))
    out[known] = np.sqrt((by_angles**2 @ angles_sd_rad[known][:, :, None] ** 2)[..., 0])
    return out


FREE_ORDER = (1, 0, 2)
"""Bending first where no angle is trained."""
RowKey = tuple[str, Movement, int]
"""Joint (empty for the wrist), movement, column of the wrist's angle (-1 for a joint)."""


@dataclass(frozen=True, slots=True)
class RangeRow:
    """Range of one movement over the counted repetitions. ``values_deg`` one each; ``limited`` by the camera's view."""

    movement: Movement
    angle: int
    mean_deg: float
    sd_deg: float
    best_deg: float
    measurement_sd_deg: float
    values_deg: tuple[float, ...]
    limited: bool
    joint: str = ""
    """The joint angle or ``TAM3``, by its name in every file; empty for the wrist, whose ``angle`` is its column."""
    seen_share: float = math.nan
    """Share of all frames in which the joint was seen."""
    inferred: bool = False
    """Whether an end joint that no disc measures is part of it."""

    @property
    def key(self) -> RowKey:
        """What it is the range of."""
        return self.joint, self.movement, self.angle

    @property
    def count(self) -> int:
        return len(self.values_deg)


def is_total(joint: str) -> bool:
    """Whether a row's joint is the total active motion of a finger."""
    return joint.startswith("TAM")


def range_row(movement: Movement, angle: int, figure: RangeFigure, limited: bool) -> RangeRow:
    """A row of the wrist; :func:`dataclasses.replace` makes it one of a joint."""
    values = tuple(math.degrees(value) for value in figure.values)
    return RangeRow(
        movement, angle, math.degrees(figure.mean), math.degrees(figure.spread_sd), math.degrees(figure.best),
        math.degrees(figure.measurement_sd), values, limited,
    )  # fmt: skip


def wrist_rows(seen: SeenSession, counted: Sequence[Repetition]) -> tuple[RangeRow, ...]:
    """Of the angle that the exercise trains, else of all three: over the repetitions that count, without any over the
    whole session. A rotation that accompanies another movement is no pronation or supination: it has its arc alone."""
    angles = FREE_ORDER if seen.exercise.angle is None else (seen.exercise.angle,)
    smoothed = seen.session.smoothed is not None
    rows = (row for angle in angles for row in _angle_rows(angle, seen.signals[angle], counted, smoothed))
    thumb_up = is_from_thumb_up(seen.exercise)
    return tuple(row for row in rows if thumb_up or row.angle != PRONOSUPINATION or row.movement == "arc")


def _angle_rows(angle: int, signal: Signal, counted: Sequence[Repetition], smoothed: bool) -> list[RangeRow]:
    """Arc, positive and negative direction of one angle. A direction that was never reached is below zero: by so much
    the other one does not come back to neutral (a deficit). Without repetitions it is left out."""
    if not len(signal.time_s):
        return []
    smooth = low_pass(signal, HIGHEST_CUTOFF_HZ)
    measured = motion_range(smooth.column(0), signal.column(1), tuple(counted), smoothed=smoothed)
    positive, negative = SIDES[angle]
    turned = replace(measured.minimum, values=-measured.minimum.values, best=-measured.minimum.best)
    rows = [
        range_row("arc", angle, measured.arc, measured.top_limited or measured.bottom_limited),
        range_row(positive, angle, measured.maximum, measured.top_limited),
        range_row(negative, angle, turned, measured.bottom_limited),
    ]
    least = -math.inf if counted else 0.0
    return [row for row in rows if row.count and (row.movement == "arc" or row.mean_deg > least)]


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


def trick_deg(seen: SeenSession) -> FloatArray:
    """Largest size of the other angles (3,); NaN for the trained one and where the exercise has no limit."""
    out = np.full(3, math.nan)
    if math.isfinite(seen.exercise.trick_limit_deg):
        for k, signal in enumerate(seen.signals):
            if k != seen.exercise.angle and len(signal.time_s):
                value = low_pass(signal.column(0)).value
                if np.isfinite(value).any():
                    out[k] = math.degrees(float(np.nanmax(np.abs(value))))
    return out
