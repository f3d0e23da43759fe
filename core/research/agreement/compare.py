"""Comparison of a session with a reference: alignment in time and space, then agreement."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from carpus.core.measures.signals import Signal, low_pass
from carpus.core.model import so3
from carpus.core.model.errors import ReferenceUnsuited
from carpus.core.model.hand.clinical_angles import angles_from_rotation, rotation_from_angles
from carpus.core.model.hand.forearm_rotation import pronosupination_from_palm_down
from carpus.core.model.hand.protocols import PALM_MARKERS, WRIST_ANGLES
from carpus.core.model.phrase import phrase
from carpus.core.model.rounding import format_rounded
from carpus.core.model.types import FloatArray, TrackStatus
from carpus.core.research.agreement.reference import Reference, list_names
from carpus.core.research.agreement.statistics import MIN_PAIRS, Agreement, compute_agreement
from carpus.core.research.agreement.time_alignment import (
    MIN_OVERLAP_S,
    STEP_S,
    AlignmentCurves,
    ClockShift,
    find_shift,
    interpolate,
    with_residual_drift,
)
from carpus.core.results.session_results import SessionResults
from carpus.core.results.valid_data import motion_estimate
from carpus.core.session.values import Session

MIN_SAFE_OVERLAP_S = 5.0
SAME_CLOCK_S, SAME_CLOCK_TOLERANCE = 0.5, 0.01
"""Largest shift of two results of one recording; none is assumed for a hardly better match."""
DEFAULT_MAX_SHIFT_S = 10.0
MAX_SHIFT_S, MAX_DRIFT_PERCENT = 3600.0, 10.0
"""Limits of what a person may enter."""
MIN_MATCH = 0.5
"""With a lower correlation it is not the same movement."""
MAX_OPPOSITE_CORRELATION = -0.5
"""Below it the two have opposite signs, or are different movements."""
MAX_SCALE_RATIO, MIN_MOTION_SD_RAD = 2.0, math.radians(3.0)
"""Ratio of the standard deviations, of angles that move so much, above which units may differ."""
MAX_RESIDUAL_M = 0.010
"""Markers beside Carpus's, and skin that glides, leave a smaller residual of the rigid fit."""
POINT_CUTOFF_HZ = 5.0
NEUTRAL_S = 0.5
NEUTRAL_POSE, FIRST_IN_COMMON = "its neutral pose", "the session at the first moment in common"
STILL_S = 0.5
SINCE_1970_S = 1e8
"""Larger times count from 1970: two that are near each other share a clock."""
MAX_STILL_RAD = math.radians(3.0)
"""A reading is compared with the half second around it, in which the angle moves no more than this."""


@dataclass(frozen=True, slots=True)
class Alignment:
    """Rigid fit of the reference's points to the session's, its RMS residual, and where its angles are zero."""

    rotation_rad: float
    residual_m: float
    markers: tuple[str, ...]
    zero: str


@dataclass(frozen=True, slots=True)
class AnglePairs:
    """Paired values (N,) of one angle; times after the session's first frame."""

    name: str
    time_s: FloatArray
    measured_rad: FloatArray
    reference_rad: FloatArray
    figures_deg: Agreement


@dataclass(frozen=True, slots=True)
class Comparison:
    """Agreement of a session with a reference.

    Attributes
    ----------
    frame_count, excluded_count : int
        All frames, and those of them that are predicted, doubtful or lost and so left out.
    overlap_s, rate_hz : float
        Time that both recorded, and frames a second of the reference.
    unused : tuple of str
        What was not used, with the reason.
    remarks : tuple of str
        What to check before you trust the values; those of one angle begin with its name.
    """

    kind: str
    pairs: tuple[AnglePairs, ...]
    shift: ClockShift | None
    alignment: Alignment | None
    frame_count: int
    excluded_count: int
    overlap_s: float
    rate_hz: float
    unused: tuple[str, ...]
    remarks: tuple[str, ...] = ()

    def angle_remarks(self, name: str) -> list[str]:
        """Return the remarks on one angle and those on all."""
        others = tuple(f"{pairs.name}: " for pairs in self.pairs if pairs.name != name)
        return [remark for remark in self.remarks if not remark.startswith(others)]


def compare_session(
    session: Session,
    reference: Reference,
    *,
    smoothed: bool = False,
    max_shift_s: float = DEFAULT_MAX_SHIFT_S,
    lag_s: float = math.nan,
    drift: float = 0.0,
    figures: SessionResults | None = None,
) -> Comparison:
    """Compare a session, the filter's or the smoother's result, with a reference.

    A finite ``lag_s`` is used as the shift instead of searching one; ``drift`` is the share by which the reference's
    clock runs fast. ``figures`` are the session's results for readings without a time. Raises
    :class:`ReferenceUnsuited`.
    """
    if not len(session):
        raise ReferenceUnsuited(reference.path, phrase("the session contains no frames"))
    if not (len(reference.time_s) or reference.readings):
        raise _overlap_error(reference)
    motion = motion_estimate(session) if smoothed else session.motion
    time_s = session.timestamp_s - session.timestamp_s[0]
    is_tracked = np.asarray(session.status) == TrackStatus.TRACKED
    names = (*WRIST_ANGLES, *session.header.joint_names)
    values = np.column_stack((motion.angles_rad, motion.joint_angles_rad))
    session_angles = {name: np.where(is_tracked, values[:, k], np.nan) for k, name in enumerate(names)}
    if reference.readings:
        return _compare_readings(reference, time_s, session_angles, figures)
    unused = list(reference.unused)
    if reference.points_m:
        curves = _speed_curves(session, reference, time_s)
        unused += [f"{name}: fingers are not worked out from markers" for name in session.header.joint_names[:1]]
    else:
        curves = _angle_curves(session, reference, time_s, session_angles)
        unused += [f"{name}: not in the session" for name in reference.angles_rad if name not in session_angles]
        unused += [f"{name}: not in the reference" for name in session_angles if name not in reference.angles_rad]
    shift = _estimate_shift(curves, session, reference, max_shift_s, lag_s, drift)
    reference_angles: Mapping[str, FloatArray] = reference.angles_rad
    alignment = None
    if reference.points_m:
        reference_angles, alignment = _angles_from_points(session, reference, time_s, shift)
    reference_s = _reference_times_s(reference, session)
    pairs = []
    for name in names:
        if name not in reference_angles:
            continue
        found = interpolate(shift.reference_time_s(time_s), reference_s, _unwrap_angle(reference_angles[name]))
        pair = _pair_angle(name, time_s, session_angles[name], found)
        if pair is None:
            unused.append(f"{name}: fewer than {MIN_PAIRS} pictures in common")
        else:
            pairs.append(pair)
    if not pairs:
        raise ReferenceUnsuited(reference.path, phrase("session and reference do not overlap in time"))
    overlap_s = max(float(one.time_s[-1] - one.time_s[0]) for one in pairs)
    rate_hz = 1.0 / float(np.median(np.diff(reference_s))) if len(reference_s) > 1 else math.nan
    remarks = (*reference.remarks, *_alignment_remarks(alignment), *comparison_remarks(pairs, shift, overlap_s))
    excluded = int((~is_tracked).sum())
    return Comparison(
        reference.kind,
        tuple(pairs),
        shift,
        alignment,
        len(session),
        excluded,
        overlap_s,
        rate_hz,
        tuple(unused),
        remarks,
    )


def _pair_angle(
    name: str, time_s: FloatArray, measured_rad: FloatArray, reference_rad: FloatArray
) -> AnglePairs | None:
    """Pair an angle, corrected by whole turns; None with too few frames."""
    both = np.isfinite(reference_rad) & np.isfinite(measured_rad)
    if both.sum() < MIN_PAIRS:
        return None
    measured, other = np.unwrap(measured_rad[both]), reference_rad[both]
    other = other + 2.0 * math.pi * np.rint(np.median(measured - other) / (2.0 * math.pi))
    return AnglePairs(name, time_s[both], measured, other, compute_agreement(np.degrees(measured), np.degrees(other)))


def _unwrap_angle(angle_rad: FloatArray) -> FloatArray:
    """Unwrap an angle (K,), unless it spans more than a turn."""
    known = np.isfinite(angle_rad)
    if not known.any() or float(np.ptp(angle_rad[known])) > 2.0 * math.pi + 1e-9:
        return angle_rad
    out = angle_rad.copy()
    out[known] = np.unwrap(angle_rad[known])
    return np.asarray(out)


def _estimate_shift(
    curves: AlignmentCurves, session: Session, reference: Reference, max_shift_s: float, lag_s: float, drift: float
) -> ClockShift:
    """Return the given shift or the best one, with its residual drift."""
    if math.isfinite(lag_s):
        given = ClockShift(lag_s, math.nan, is_given=True, drift=drift)
        return with_residual_drift(curves, replace(given, match=curves.match(given)))
    tolerance = 0.0
    if _has_same_clock(reference, session):
        tolerance = SAME_CLOCK_TOLERANCE if reference.angles_rad else 0.0
        max_shift_s = min(max_shift_s, SAME_CLOCK_S) if reference.same_clock else max_shift_s
    faster = replace(curves, time_s=curves.time_s * (1.0 + drift))
    shift = replace(find_shift(faster, max_shift_s, tolerance), drift=drift)
    shift = with_residual_drift(curves, shift)
    _check_match(reference, curves, shift)
    return shift


def _overlap_error(reference: Reference) -> ReferenceUnsuited:
    reason = phrase(
        "session and reference overlap by less than {least_overlap_s} s, or nothing moves",
        least_overlap_s=f"{MIN_OVERLAP_S:g}",
    )
    return ReferenceUnsuited(reference.path, reason)


def _check_match(reference: Reference, curves: AlignmentCurves, shift: ClockShift) -> None:
    """Raise if the curves do not match, cleared of drift, which blurs the match over minutes."""
    if math.isnan(shift.match):
        raise _overlap_error(reference)
    match = abs(shift.match)
    if math.isfinite(shift.residual_drift):
        cleared = ClockShift(shift.drift_free_lag_s, math.nan, drift=shift.drift + shift.residual_drift)
        match = max(match, abs(curves.match(cleared)))
    if not match >= MIN_MATCH:
        words = phrase(
            "the best match of the curves is only {match}. Check that they show the same movement",
            match=format_rounded(match, 2),
        )
        raise ReferenceUnsuited(reference.path, words)


def comparison_remarks(
    pairs: Sequence[AnglePairs], shift: ClockShift | None, overlap_s: float = math.nan
) -> tuple[str, ...]:
    """Return what to check before the values are believed."""
    out: list[str] = [
        phrase(
            "{angle}: opposite to Carpus (r = {r}). One of the two has the opposite sign or shows another movement",
            angle=one.name,
            r=format_rounded(one.figures_deg.correlation, 3),
        )
        for one in pairs
        if one.figures_deg.correlation < MAX_OPPOSITE_CORRELATION
    ]
    out += [
        phrase(
            "{angle}: the reference moves {percent} % as far as Carpus. It may have another unit or be another angle",
            angle=one.name,
            percent=f"{100.0 * share:.3g}",
        )
        for one in pairs
        if not 1.0 / MAX_SCALE_RATIO <= (share := _motion_ratio(one)) <= MAX_SCALE_RATIO
    ]
    return tuple(out) if shift is None else (*out, *_clock_remarks(shift, overlap_s))


def _alignment_remarks(alignment: Alignment | None) -> list[str]:
    if alignment is None or alignment.residual_m <= MAX_RESIDUAL_M:
        return []
    return [
        phrase(
            "the markers of session and reference are {apart} mm apart (expected: up to {most} mm). They may be "
            "other markers or another hand, or the markers may jump",
            apart=format_rounded(1e3 * alignment.residual_m, 1),
            most=format_rounded(1e3 * MAX_RESIDUAL_M),
        )
    ]


def _clock_remarks(shift: ClockShift, overlap_s: float) -> list[str]:
    out: list[str] = []
    if overlap_s < MIN_SAFE_OVERLAP_S:
        time = format_rounded(overlap_s, 1)
        out.append(phrase("only {time} s of overlap: the time shift is uncertain", time=time))
    if shift.match < 0.0 and math.isfinite(shift.max_shift_s):
        out.append(
            phrase("the curves are opposite, or the time shift is more than {most} s", most=f"{shift.max_shift_s:g}")
            if shift.same_sign_shift is None
            else phrase(
                "the curves are opposite, or the time shift is more than {most} s. With the same sign they match "
                "best at {later} s ({match})",
                most=f"{shift.max_shift_s:g}",
                later=f"{shift.same_sign_shift[0]:+.2f}",
                match=format_rounded(shift.same_sign_shift[1], 3),
            )
        )
    if shift.rivals:
        others = ", ".join(f"{later_s:+.2f} s ({format_rounded(match, 3)})" for later_s, match in shift.rivals)
        words = phrase(
            "the time shift is uncertain: {taken} s is used ({match}). Equally or nearly as good: {others}",
            taken=f"{shift.lag_s:+.2f}",
            match=format_rounded(shift.match, 3),
            others=others,
        )
        out.append(f"{words} …" if shift.has_more_rivals else words)
    if shift.is_at_search_limit:
        out.append(phrase("the best time shift is at the limit of the search range: it may be larger"))
    if math.isfinite(shift.residual_drift):
        percent, found_s = 100.0 * shift.residual_drift, shift.residual_drift * overlap_s
        words = phrase(
            "the clocks drift: the reference by {percent} % relative to Carpus, {seconds} s over {length} s. The "
            "values contain this error (lag {lag} s with drift {drift} %)",
            percent=f"{percent:+.2f}",
            seconds=f"{found_s:+.2f}",
            length=format_rounded(overlap_s),
            lag=f"{shift.drift_free_lag_s:+.3f}",
            drift=f"{percent + 100.0 * shift.drift:+.2f}",
        )
        out.append(words)
    return out


def _motion_ratio(pairs: AnglePairs) -> float:
    """Return the reference's range over that of Carpus; 1 if neither moves much."""
    measured, other = float(pairs.measured_rad.std()), float(pairs.reference_rad.std())
    return other / measured if measured > 0.0 and max(measured, other) >= MIN_MOTION_SD_RAD else 1.0


# --- time ------------------------------------------------------------------------------------------------------
def _reference_times_s(reference: Reference, session: Session) -> FloatArray:
    """Return the reference's times from its first reading, or from the first frame on a shared clock."""
    if not len(reference.time_s):
        return reference.time_s
    start_s = float(reference.time_s[0])
    if _has_same_clock(reference, session):
        start_s = float(session.timestamp_s[0])
    return np.asarray(reference.time_s - start_s)


def _has_same_clock(reference: Reference, session: Session) -> bool:
    first_s, last_s = float(session.timestamp_s[0]), float(session.timestamp_s[-1])
    near = bool(abs(float(reference.time_s[0]) - first_s) <= last_s - first_s)
    return near and (reference.same_clock or first_s > SINCE_1970_S)


def _angle_curves(
    session: Session, reference: Reference, time_s: FloatArray, session_angles: Mapping[str, FloatArray]
) -> AlignmentCurves:
    names = [name for name in reference.angles_rad if name in session_angles]
    if not names:
        there = list_names(reference.names)
        reason = phrase("no palm marker and no angle of the wrist or fingers, only {there}", there=there)
        if reference.angles_rad:
            reason = phrase("no angle of the session, only {there}", there=there)
        raise ReferenceUnsuited(reference.path, reason)
    names = [name for name in names if np.fmax.reduce(session_angles[name]) > np.fmin.reduce(session_angles[name])]
    theirs_s = _reference_times_s(reference, session)
    measured = np.column_stack([session_angles[name] for name in names]) if names else np.empty((len(time_s), 0))
    other = np.column_stack([reference.angles_rad[name] for name in names]) if names else np.empty((len(theirs_s), 0))
    return AlignmentCurves(time_s, measured, theirs_s, other, ignores_sign=True)


def _speed_curves(session: Session, reference: Reference, time_s: FloatArray) -> AlignmentCurves:
    """Return the markers' speeds, which do not depend on the axes."""
    names = _common_markers(reference)
    markers = session.header.protocol.markers
    theirs_s = _reference_times_s(reference, session)
    measured = np.column_stack(
        [_point_speed(time_s, session.markers.position_cam_m[:, markers.index(name)]) for name in names]
    )
    other = np.column_stack([_point_speed(theirs_s, reference.points_m[name]) for name in names])
    return AlignmentCurves(time_s, measured, theirs_s, other)


def _point_speed(time_s: FloatArray, place_m: FloatArray) -> FloatArray:
    """Return the smoothed speed (N,) of a point (N, 3); NaN where unknown."""
    known = np.isfinite(place_m).all(axis=-1)
    if known.sum() < 8:
        return np.full(len(time_s), np.nan)
    even_s = np.arange(time_s[0], time_s[-1], STEP_S)
    even = np.column_stack([np.interp(even_s, time_s[known], place_m[known, axis]) for axis in range(3)])
    slow = low_pass(Signal(even_s, even, 1.0 / STEP_S, 1.0, np.empty((0, 2))), POINT_CUTOFF_HZ).value
    speed = np.linalg.norm(np.gradient(slow, STEP_S, axis=0), axis=1)
    out = np.interp(time_s, even_s, speed)
    out[~known] = np.nan
    return np.asarray(out)


# --- space -----------------------------------------------------------------------------------------------------
def _common_markers(reference: Reference) -> list[str]:
    names = [name for name in PALM_MARKERS if name in reference.points_m]
    if len(names) < 3:
        there = list_names(reference.names)
        words = phrase("three palm markers are needed: state which of {there} they are", there=there)
        raise ReferenceUnsuited(reference.path, words)
    return names


def _angles_from_points(
    session: Session, reference: Reference, time_s: FloatArray, shift: ClockShift
) -> tuple[dict[str, FloatArray], Alignment]:
    """Compute the wrist angles of the reference's points in the session's axes at its neutral pose.

    The palm is one rigid body in both: its whole path gives the rotation between the axes, and the reference's own
    neutral pose its zero.
    """
    names = _common_markers(reference)
    markers = session.header.protocol.markers
    reference_s = _reference_times_s(reference, session)
    reference_values = np.stack([reference.points_m[name] for name in names], axis=1)
    measured = np.stack([session.markers.position_cam_m[:, markers.index(name)] for name in names], axis=1)
    there = interpolate(shift.reference_time_s(time_s), reference_s, reference_values)
    both = np.isfinite(there).all(axis=(1, 2)) & np.isfinite(measured).all(axis=(1, 2))
    both &= np.asarray(session.status) == TrackStatus.TRACKED
    if both.sum() < MIN_PAIRS:
        raise ReferenceUnsuited(reference.path, phrase("session and reference do not overlap in time"))
    turn, move = so3.fit_rigid_transform(there[both].reshape(-1, 3), measured[both].reshape(-1, 3))
    off = there[both] @ turn.T + move - measured[both]
    known = np.isfinite(reference_values).all(axis=(1, 2))
    side = session.header.hand
    start = rotation_from_angles(np.nan_to_num(session.calibration.start_angles_rad), side)
    begin_s, zero = 0.0, NEUTRAL_POSE
    own_s = (reference_s - shift.lag_s) / (1.0 + shift.drift)
    if not (known & _is_in_neutral_pose(own_s, begin_s)).any():
        # The reference began later: its zero is the session's at the first common frame.
        begin_s, zero = float(time_s[both][0]), FIRST_IN_COMMON
        own = session.motion.rotation_w2_w0[both & _is_in_neutral_pose(time_s, begin_s)]
        start = so3.project_to_rotation(own.mean(axis=0))
    neutral = reference_values[known & _is_in_neutral_pose(own_s, begin_s)].mean(axis=0)
    w0_in_reference = turn.T @ session.calibration.rotation_w0_cam
    rotation = np.full((len(reference_values), 3, 3), np.nan)
    for k in np.flatnonzero(known):
        body, _ = so3.fit_rigid_transform(neutral, reference_values[k])
        rotation[k] = w0_in_reference.T @ body @ w0_in_reference
    angles = angles_from_rotation(rotation @ start, side)
    residual = float(np.sqrt(np.mean(np.sum(off**2, axis=-1))))
    turned = float(np.linalg.norm(so3.log(turn)))
    return (
        {name: angles[:, k] for k, name in enumerate(WRIST_ANGLES)},
        Alignment(turned, residual, tuple(names), zero),
    )


def _is_in_neutral_pose(time_s: FloatArray, begin_s: float) -> np.ndarray:
    return (time_s >= begin_s - 1e-6) & (time_s <= begin_s + NEUTRAL_S)


# --- readings --------------------------------------------------------------------------------------------------
def _compare_readings(
    reference: Reference, time_s: FloatArray, session_angles: Mapping[str, FloatArray], figures: SessionResults | None
) -> Comparison:
    """Compare readings with the held angle around their time, or with the session's range."""
    unused = list(reference.unused)
    found: dict[str, list[tuple[float, float, float]]] = {}
    excluded_count = 0
    for reading in reference.readings:
        if reading.angle not in session_angles:
            unused.append(phrase("{angle}: not in the session", angle=reading.angle))
            continue
        if math.isfinite(reading.time_s):
            about = np.abs(time_s - reading.time_s) <= STILL_S
            values = session_angles[reading.angle][about & np.isfinite(session_angles[reading.angle])]
            if len(values) < MIN_PAIRS or float(np.ptp(values)) > 2.0 * MAX_STILL_RAD:
                facts = {"angle": reading.angle, "time": f"{reading.time_s:g}"}
                excluded_count += 1
                unused.append(phrase("{angle} at {time} s: the hand was not still, or not visible", **facts))
                continue
            measured = float(values.mean())
        else:
            measured = _range_end(figures, reading.angle, reading.movement)
            if not math.isfinite(measured):
                words = phrase(
                    "{movement}: the session has no range in this direction, and the list of readings has no time",
                    movement=reading.movement,
                )
                excluded_count += 1
                unused.append(words)
                continue
        found.setdefault(reading.angle, []).append((reading.time_s, measured, reading.value_rad))
    pairs = []
    for name in session_angles:
        if name in found:
            t, measured_rad, reference_rad = (np.array(column) for column in zip(*found[name], strict=True))
            figures_deg = compute_agreement(np.degrees(measured_rad), np.degrees(reference_rad), waveform=False)
            pairs.append(AnglePairs(name, t, measured_rad, reference_rad, figures_deg))
    if not pairs:
        raise ReferenceUnsuited(reference.path, unused[-1] if unused else phrase("no usable reading"))
    count = len(reference.readings)
    return Comparison(
        reference.kind, tuple(pairs), None, None, count, excluded_count, math.nan, math.nan, tuple(unused),
        (*reference.remarks, *comparison_remarks(pairs, None)),
    )  # fmt: skip


def _range_end(figures: SessionResults | None, angle: str, movement: str) -> float:
    """Return the mean of the range in that direction, signed, rad."""
    if figures is None:
        return math.nan
    row = figures.find(angle, movement)
    if row is None:
        return math.nan
    away = movement in ("extension", "ulnar", "pronation") and row.wrist_angle >= 0
    end = math.radians(-row.mean if away else row.mean)
    is_forearm = movement in ("supination", "pronation")  # which a range has from thumb up, and a pair not
    return float(pronosupination_from_palm_down(np.array(end))) if is_forearm else end
