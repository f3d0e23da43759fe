"""Ranges of motion of a wrist angle, a joint, or a whole finger (TAM).

Wrist angles are those of the papers, or in the order of the ISB (clinical reference 1.3). Sessions in different orders
are never compared.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

import numpy as np

from carpus.core.measures.motion_range import (
    FINGERS,
    JointTrack,
    MotionRange,
    RangeStatistics,
    joint_range,
    motion_range,
    total_active_motion,
)
from carpus.core.measures.noise import MAX_CUTOFF_HZ
from carpus.core.measures.repetitions import Repetition
from carpus.core.measures.signals import Signal, low_pass
from carpus.core.model import so3
from carpus.core.model.hand.clinical_angles import angle_rates_matrix, isb_from_rotation
from carpus.core.model.hand.exercises import DIRECTIONS, PRONOSUPINATION, Exercise, Movement
from carpus.core.model.hand.forearm_rotation import is_counted_from_thumb_up
from carpus.core.model.hand.protocols import WRIST_ANGLES, joint_angle_names
from carpus.core.model.types import FloatArray, Side
from carpus.core.results.measure import Measure, MeasureKey
from carpus.core.results.valid_data import MeasurableSession
from carpus.core.session.values import AngleOrder, Motion, Session

_STEP_RAD = 1e-6


def with_angle_order(session: Session, order: AngleOrder) -> Session:
    """Return the session with wrist angles and their standard deviations in an order."""
    if order == session.angle_order:
        return session
    if session.angle_order != "zyx":
        raise ValueError(f"a session in the order {session.angle_order}")
    side = session.header.hand
    smoothed = None if session.smoothed is None else _with_isb_angles(session.smoothed, side)
    return replace(session, motion=_with_isb_angles(session.motion, side), smoothed=smoothed, angle_order=order)


def _with_isb_angles(motion: Motion, side: Side) -> Motion:
    turned = motion.rotation_w2_w0
    return replace(
        motion,
        angles_rad=isb_from_rotation(turned, side),
        angles_sd_rad=isb_sd_rad(turned, motion.angles_sd_rad, side),
    )


def isb_sd_rad(rotation_w2_w0: FloatArray, angles_sd_rad: FloatArray, side: Side) -> FloatArray:
    """Compute standard deviations (N, 3) of ISB angles from those of the papers' angles, as independent."""
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
"""Flexion first if no angle is trained."""


def make_range_measure(subject: str, movement: Movement, figure: RangeStatistics, is_lower_bound: bool) -> Measure:
    """Make the measure of one movement of an angle or joint."""
    values = tuple(math.degrees(value) for value in figure.values)
    return Measure(
        "range", subject, movement, "deg", values, math.degrees(figure.mean), math.degrees(figure.spread_sd),
        math.degrees(figure.best), math.degrees(figure.measurement_sd), is_lower_bound,
    )  # fmt: skip


def measure_wrist_ranges(seen: MeasurableSession, repetitions: Sequence[Repetition]) -> tuple[Measure, ...]:
    """Measure the trained wrist angle, else all three, over the repetitions or the whole session.

    Rotation that accompanies another movement is not pronation or supination: only its arc is measured.
    """
    angles = FREE_ORDER if seen.exercise.angle is None else (seen.exercise.angle,)
    smoothed = seen.session.smoothed is not None
    rows = (row for angle in angles for row in _measure_angle_ranges(angle, seen.signals[angle], repetitions, smoothed))
    thumb_up = is_counted_from_thumb_up(seen.exercise)
    return tuple(row for row in rows if thumb_up or row.wrist_angle != PRONOSUPINATION or row.quantity == "arc")


def _measure_angle_ranges(
    angle: int, signal: Signal, repetitions: Sequence[Repetition], smoothed: bool
) -> list[Measure]:
    """Measure the arc and both directions of a wrist angle.

    A direction that was never reached is negative: the other one lacks so much to neutral. Without repetitions it is
    left out.
    """
    if not len(signal.time_s):
        return []
    smooth = low_pass(signal, MAX_CUTOFF_HZ)
    found = motion_range(smooth.column(0), signal.column(1), tuple(repetitions), smoothed=smoothed)
    (positive, negative), of = DIRECTIONS[angle], WRIST_ANGLES[angle]
    turned = replace(found.minimum, values=-found.minimum.values, best=-found.minimum.best)
    rows = [
        make_range_measure(of, "arc", found.arc, found.top_limited or found.bottom_limited),
        make_range_measure(of, positive, found.maximum, found.top_limited),
        make_range_measure(of, negative, turned, found.bottom_limited),
    ]
    least = -math.inf if repetitions else 0.0
    return [row for row in rows if row.count and (row.quantity == "arc" or row.mean > least)]


def measure_joint_ranges(
    tracks: Mapping[str, JointTrack], repetitions: Sequence[Repetition], exercise: Exercise
) -> tuple[Measure, ...]:
    """Measure every finger's TAM, then arc, largest and smallest angle of every joint.

    ``extension`` is the smallest signed angle, below zero in hyperextension.
    """
    rows: list[Measure] = []
    for finger in FINGERS if tracks and exercise.has_total_motion else ():
        joints, inferred = flexion_joints(finger, tuple(tracks))
        if set(joints) <= set(tracks):
            own = [tracks[name] for name in joints]
            share = min(track.visible_share for track in own) if all(track.is_known for track in own) else 0.0
            rows += _make_joint_measures(
                f"TAM{finger}", total_active_motion(own, repetitions, inferred=inferred), share, inferred
            )
    for name, track in tracks.items():
        rows += _make_joint_measures(name, joint_range(track, repetitions), track.visible_share)
    return tuple(rows)


def _make_joint_measures(
    subject: str, found: MotionRange, seen_share: float, inferred: bool = False
) -> Iterator[Measure]:
    for row in (
        make_range_measure(subject, "arc", found.arc, found.top_limited or found.bottom_limited),
        make_range_measure(subject, "flexion", found.maximum, found.top_limited),
        make_range_measure(subject, "extension", found.minimum, found.bottom_limited),
    ):
        yield replace(row, seen_share=seen_share, is_inferred=inferred)


def flexion_joints(finger: int, names: Sequence[str]) -> tuple[tuple[str, ...], bool]:
    """Return the joints that flex a finger, base first, and whether its DIP joint is inferred."""
    if finger == 1:
        return ("MCP1_flexion", "IP1_flexion"), False
    end = f"DIP{finger}_flexion"
    measured = (f"MCP{finger}_flexion", f"PIP{finger}_flexion")
    return ((*measured, end), False) if end in names else (measured, True)


def progress_keys(choice: str) -> tuple[MeasureKey, ...]:
    """Return the arcs that are followed: every ``tam`` or ``spread``, the thumb's ``lift``, or a finger by its number.

    Of the thumb palmar abduction and extension come first, of a finger its TAM. Empty for the wrist.
    """
    names: tuple[str, ...] = ()
    if choice == "tam":
        names = tuple(f"TAM{finger}" for finger in FINGERS)
    elif choice == "spread":
        names = ("CMC1_extension", *(f"MCP{finger}_abduction" for finger in FINGERS[1:]))
    elif choice:
        first = ("CMC1_abduction", "CMC1_extension") if choice == "lift" else (f"TAM{choice}",)
        names = (*first, *flexion_joints(1 if choice == "lift" else int(choice), joint_angle_names(True))[0])
    return tuple((name, "arc") for name in names)


LARGEST_SIZE = "largest size"


def measure_still_angles(seen: MeasurableSession) -> tuple[Measure, ...]:
    """Measure angles that should stay still; none if the exercise sets no limit."""
    if not math.isfinite(seen.exercise.trick_limit_deg):
        return ()
    out = []
    for angle, signal in enumerate(seen.signals):
        if angle != seen.exercise.angle and len(signal.time_s):
            size_rad = np.abs(low_pass(signal.column(0)).value)
            if np.isfinite(size_rad).any():
                size_deg = math.degrees(float(np.nanmax(size_rad)))
                out.append(Measure("still", WRIST_ANGLES[angle], LARGEST_SIZE, "deg", (size_deg,), size_deg))
    return tuple(out)
