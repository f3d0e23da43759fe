"""Brings a session and a reference together: in time, in space, in sampling; then says how far they agree."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from carpus.core import so3
from carpus.core.agreement.clocks import (
    LEAST_OVERLAP_S,
    STEP_S,
    ClockCurves,
    Shift,
    at_times,
    best_shift,
    with_drift,
)
from carpus.core.agreement.reference import Reference, listed
from carpus.core.agreement.statistics import FEWEST, Agreement, agreement
from carpus.core.errors import ReferenceUnsuited
from carpus.core.hand.clinical_angles import angles_from_rotation, rotation_from_angles
from carpus.core.hand.forearm_rotation import pronosupination_from_palm_down
from carpus.core.hand.protocols import PALM_MARKERS, WRIST_ANGLES
from carpus.core.measures.signals import Signal, low_pass
from carpus.core.phrase import phrase
from carpus.core.results.figures import SessionFigures
from carpus.core.results.seen import best_motion
from carpus.core.rounding import written
from carpus.core.session.values import Session
from carpus.core.types import FloatArray, TrackStatus

SAFE_OVERLAP_S = 5.0
SAME_CLOCK_S, SAME_CLOCK_ALIKE = 0.5, 0.01
"""Two results of one recording are not further apart, and not apart for a match that is hardly better."""
MOST_SHIFT_S = 10.0
FURTHEST_SHIFT_S, LARGEST_DRIFT_PERCENT = 3600.0, 10.0
"""What a person may say of two clocks."""
LEAST_MATCH = 0.5
"""Below this correlation no shift is believed: it is not the same movement."""
LARGEST_SCALE, MOVES_RAD = 2.0, math.radians(3.0)
"""Where one moves by so many times the standard deviation of the other, and by so much, their units may differ."""
FAR_APART_M = 0.010
"""Of a rigid fit: markers stuck beside the discs, and skin that glides, leave less."""
SLOW_HZ = 5.0
NEUTRAL_S = 0.5
NEUTRAL_POSE, FIRST_IN_COMMON = "its neutral pose", "the session at the first moment in common"
STILL_S = 0.5
SINCE_1970_S = 1e8
"""Times as large count from 1970: two that are near each other are of one clock."""
STILL_RAD = math.radians(3.0)
"""A reading is compared with the half second about it, in which the angle stays within this."""


@dataclass(frozen=True, slots=True)
class Alignment:
    """Rigid turn and shift of the reference's points onto the session's: ``turn_rad``, ``residual_m`` root mean square
    over ``markers``; ``zero`` where the reference's angles have theirs."""

    turn_rad: float
    residual_m: float
    markers: tuple[str, ...]
    zero: str


@dataclass(frozen=True, slots=True)
class Pairs:
    """One angle: ``time_s`` (N,) after the session's first picture, ``measured_rad`` and ``reference_rad`` (N,)."""

    name: str
    time_s: FloatArray
    measured_rad: FloatArray
    reference_rad: FloatArray
    figures_deg: Agreement


@dataclass(frozen=True, slots=True)
class Compared:
    """``left_out`` pictures of ``pictures`` predicted, doubtful or lost; ``not_used`` each with its reason; ``remarks``
    what must be looked at before the figures are believed, of one angle where its name stands before it."""

    kind: str
    pairs: tuple[Pairs, ...]
    shift: Shift | None
    alignment: Alignment | None
    pictures: int
    left_out: int
    overlap_s: float
    rate_hz: float
    not_used: tuple[str, ...]
    remarks: tuple[str, ...] = ()

    def remarks_on(self, name: str) -> list[str]:
        """What must be looked at before the figures of one angle are believed: its own remarks, and those of all."""
        others = tuple(f"{pairs.name}: " for pairs in self.pairs if pairs.name != name)
        return [remark for remark in self.remarks if not remark.startswith(others)]


def compare(
    session: Session,
    reference: Reference,
    *,
    smoothed: bool = False,
    most_shift_s: float = MOST_SHIFT_S,
    lag_s: float = math.nan,
    drift: float = 0.0,
    figures: SessionFigures | None = None,
) -> Compared:
    """Agreement of a session with a reference: of the filter's result, or the smoother's.

    ``lag_s`` is taken for the shift where it is known, and not looked for; ``drift`` is the share by which the
    reference's clock runs fast. ``figures`` of the session serve readings that name no time. Raises
    :class:`ReferenceUnsuited`.
    """
    if not len(session):
        raise ReferenceUnsuited(reference.path, phrase("the session holds no picture"))
    if not (len(reference.time_s) or reference.readings):
        raise _nothing_in_common(reference)
    motion = best_motion(session) if smoothed else session.motion
    time_s = session.timestamp_s - session.timestamp_s[0]
    use = np.asarray(session.status) == TrackStatus.TRACKED
    names = (*WRIST_ANGLES, *session.header.joint_names)
    values = np.column_stack((motion.angles_rad, motion.joint_angles_rad))
    own = {name: np.where(use, values[:, k], np.nan) for k, name in enumerate(names)}
    if reference.readings:
        return _with_readings(reference, time_s, own, figures)
    not_used = list(reference.unused)
    if reference.points_m:
        curves = _curves_of_points(session, reference, time_s)
        not_used += [f"{name}: fingers are not worked out from markers" for name in session.header.joint_names[:1]]
    else:
        curves = _curves_of_angles(session, reference, time_s, own)
        not_used += [f"{name}: not in the session" for name in reference.angles_rad if name not in own]
        not_used += [f"{name}: not in the reference" for name in own if name not in reference.angles_rad]
    shift = _shift(curves, session, reference, most_shift_s, lag_s, drift)
    theirs: Mapping[str, FloatArray] = reference.angles_rad
    alignment = None
    if reference.points_m:
        theirs, alignment = _angles_of_points(session, reference, time_s, shift)
    reference_s = _since_start(reference, session)
    pairs = []
    for name in names:
        if name not in theirs:
            continue
        found = at_times(shift.reference_time_s(time_s), reference_s, _unwrapped(theirs[name]))
        pair = _paired(name, time_s, own[name], found)
        if pair is None:
            not_used.append(f"{name}: fewer than {FEWEST} pictures in common")
        else:
            pairs.append(pair)
    if not pairs:
        raise ReferenceUnsuited(reference.path, phrase("the two have no time in common"))
    overlap_s = max(float(one.time_s[-1] - one.time_s[0]) for one in pairs)
    rate_hz = 1.0 / float(np.median(np.diff(reference_s))) if len(reference_s) > 1 else math.nan
    return Compared(
        reference.kind, tuple(pairs), shift, alignment, len(session), int((~use).sum()), overlap_s, rate_hz,
        tuple(not_used), (*reference.remarks, *_remarks_of_space(alignment), *remarks_of(pairs, shift, overlap_s)),
    )  # fmt: skip


def _paired(name: str, time_s: FloatArray, own_rad: FloatArray, found_rad: FloatArray) -> Pairs | None:
    """An angle where both have it, the reference's moved by whole turns to the session's; None of too few pictures."""
    both = np.isfinite(found_rad) & np.isfinite(own_rad)
    if both.sum() < FEWEST:
        return None
    mine, other = np.unwrap(own_rad[both]), found_rad[both]
    other = other + 2.0 * math.pi * np.rint(np.median(mine - other) / (2.0 * math.pi))
    return Pairs(name, time_s[both], mine, other, agreement(np.degrees(mine), np.degrees(other)))


def _unwrapped(angle_rad: FloatArray) -> FloatArray:
    """An angle (K,) without jumps of whole turns; one that spans more than a turn has none."""
    known = np.isfinite(angle_rad)
    if not known.any() or float(np.ptp(angle_rad[known])) > 2.0 * math.pi + 1e-9:
        return angle_rad
    out = angle_rad.copy()
    out[known] = np.unwrap(angle_rad[known])
    return np.asarray(out)


def _shift(
    curves: ClockCurves,
    session: Session,
    reference: Reference,
    most_shift_s: float,
    lag_s: float,
    drift: float,
) -> Shift:
    """As given, or the best there is, with the drift that is left."""
    if math.isfinite(lag_s):
        given = Shift(lag_s, math.nan, was_given=True, drift=drift)
        return with_drift(curves, replace(given, match=curves.match(given)))
    alike = 0.0
    if _one_clock(reference, session):
        alike = SAME_CLOCK_ALIKE if reference.angles_rad else 0.0
        most_shift_s = min(most_shift_s, SAME_CLOCK_S) if reference.same_clock else most_shift_s
    faster = replace(curves, time_s=curves.time_s * (1.0 + drift))
    shift = replace(best_shift(faster, most_shift_s, alike), drift=drift)
    shift = with_drift(curves, shift)
    _check_match(reference, curves, shift)
    return shift


def _nothing_in_common(reference: Reference) -> ReferenceUnsuited:
    why = phrase("less than {least_overlap_s} s in common, or nothing moves", least_overlap_s=f"{LEAST_OVERLAP_S:g}")
    return ReferenceUnsuited(reference.path, why)


def _check_match(reference: Reference, curves: ClockCurves, shift: Shift) -> None:
    """Cleared of drift, which over minutes blurs what is the same movement."""
    if math.isnan(shift.match):
        raise _nothing_in_common(reference)
    match = abs(shift.match)
    if math.isfinite(shift.drift_found):
        cleared = Shift(shift.lag_without_drift_s, math.nan, drift=shift.drift + shift.drift_found)
        match = max(match, abs(curves.match(cleared)))
    if not match >= LEAST_MATCH:
        raise ReferenceUnsuited(
            reference.path,
            phrase("the curves match by {match} at best: is it the same movement?", match=written(match, 2)),
        )


def remarks_of(pairs: Sequence[Pairs], shift: Shift | None, overlap_s: float = math.nan) -> tuple[str, ...]:
    """What must be looked at before the figures are believed."""
    out: list[str] = [
        phrase(
            "{angle}: runs against Carpus (r = {r}), so one of the two has the opposite sign or is of another movement",
            angle=one.name,
            r=written(one.figures_deg.correlation, 3),
        )
        for one in pairs
        if one.figures_deg.is_opposite
    ]
    out += [
        phrase(
            "{angle}: the reference moves {percent} % as far as Carpus: its unit may be another, or its angle",
            angle=one.name,
            percent=f"{100.0 * share:.3g}",
        )
        for one in pairs
        if not 1.0 / LARGEST_SCALE <= (share := _scale(one)) <= LARGEST_SCALE
    ]
    return tuple(out) if shift is None else (*out, *_remarks_of_clocks(shift, overlap_s))


def _remarks_of_space(alignment: Alignment | None) -> list[str]:
    if alignment is None or alignment.residual_m <= FAR_APART_M:
        return []
    return [
        phrase(
            "discs and markers stay {apart} mm apart, up to {most} are usual: other markers, another hand, or jumps",
            apart=written(1e3 * alignment.residual_m, 1),
            most=written(1e3 * FAR_APART_M),
        )
    ]


def _remarks_of_clocks(shift: Shift, overlap_s: float) -> list[str]:
    out: list[str] = []
    if overlap_s < SAFE_OVERLAP_S:
        out.append(
            phrase("only {time} s are in common: the shift of the clocks is not sure", time=written(overlap_s, 1))
        )
    if shift.match < 0.0 and math.isfinite(shift.most_s):
        out.append(
            phrase("the curves run against each other, or the shift is beyond {most} s", most=f"{shift.most_s:g}")
            if shift.upright is None
            else phrase(
                "the curves run against each other, or the shift is beyond {most} s: with the same sign they match "
                "best at {later} s ({match})",
                most=f"{shift.most_s:g}",
                later=f"{shift.upright[0]:+.2f}",
                match=written(shift.upright[1], 3),
            )
        )
    if shift.rivals:
        others = ", ".join(f"{later_s:+.2f} s ({written(match, 3)})" for later_s, match in shift.rivals)
        words = phrase(
            "the shift is not sure: taken is {taken} s ({match}); as well or nearly match {others}",
            taken=f"{shift.reference_later_s:+.2f}",
            match=written(shift.match, 3),
            others=others,
        )
        out.append(f"{words} …" if shift.more_rivals else words)
    if shift.at_edge:
        out.append(phrase("the best shift lies at the end of what was searched: it may be further"))
    if math.isfinite(shift.drift_found):
        percent, found_s = 100.0 * shift.drift_found, shift.drift_found * overlap_s
        words = phrase(
            "the clocks drift: the reference's runs {percent} % against Carpus's, {seconds} s over {length} s, and the "
            "figures hold that error (lag {lag} s with drift {drift} %)",
            percent=f"{percent:+.2f}",
            seconds=f"{found_s:+.2f}",
            length=written(overlap_s),
            lag=f"{shift.lag_without_drift_s:+.3f}",
            drift=f"{percent + 100.0 * shift.drift:+.2f}",
        )
        out.append(words)
    return out


def _scale(pairs: Pairs) -> float:
    """How far the reference moves as a share of how far Carpus does; 1 where neither moves much."""
    mine, other = float(pairs.measured_rad.std()), float(pairs.reference_rad.std())
    return other / mine if mine > 0.0 and max(mine, other) >= MOVES_RAD else 1.0


# --- time ------------------------------------------------------------------------------------------------------
def _since_start(reference: Reference, session: Session) -> FloatArray:
    """The reference's times from its first reading; of a recording's other result from the session's first picture."""
    if not len(reference.time_s):
        return reference.time_s
    start_s = float(reference.time_s[0])
    if _one_clock(reference, session):
        start_s = float(session.timestamp_s[0])
    return np.asarray(reference.time_s - start_s)


def _one_clock(reference: Reference, session: Session) -> bool:
    first_s, last_s = float(session.timestamp_s[0]), float(session.timestamp_s[-1])
    near = bool(abs(float(reference.time_s[0]) - first_s) <= last_s - first_s)
    return near and (reference.same_clock or first_s > SINCE_1970_S)


def _curves_of_angles(
    session: Session, reference: Reference, time_s: FloatArray, own: Mapping[str, FloatArray]
) -> ClockCurves:
    names = [name for name in reference.angles_rad if name in own]
    if not names:
        there = listed(reference.names)
        why = phrase("no disc of the palm and no angle of the wrist or fingers is in it; it has {there}", there=there)
        if reference.angles_rad:
            why = phrase("no angle of the session is in it; it has {there}", there=there)
        raise ReferenceUnsuited(reference.path, why)
    names = [name for name in names if np.fmax.reduce(own[name]) > np.fmin.reduce(own[name])]
    theirs_s = _since_start(reference, session)
    mine = np.column_stack([own[name] for name in names]) if names else np.empty((len(time_s), 0))
    other = np.column_stack([reference.angles_rad[name] for name in names]) if names else np.empty((len(theirs_s), 0))
    return ClockCurves(time_s, mine, theirs_s, other, either_sign=True)


def _curves_of_points(session: Session, reference: Reference, time_s: FloatArray) -> ClockCurves:
    """How fast each disc moves, which no turn and no shift of the axes changes."""
    names = _common(reference)
    markers = session.header.protocol.markers
    theirs_s = _since_start(reference, session)
    mine = np.column_stack([_speed(time_s, session.markers.position_cam_m[:, markers.index(name)]) for name in names])
    other = np.column_stack([_speed(theirs_s, reference.points_m[name]) for name in names])
    return ClockCurves(time_s, mine, theirs_s, other)


def _speed(time_s: FloatArray, place_m: FloatArray) -> FloatArray:
    """Smoothed speed (N,) of a point (N, 3); NaN where it is not known."""
    known = np.isfinite(place_m).all(axis=-1)
    if known.sum() < 8:
        return np.full(len(time_s), np.nan)
    even_s = np.arange(time_s[0], time_s[-1], STEP_S)
    even = np.column_stack([np.interp(even_s, time_s[known], place_m[known, axis]) for axis in range(3)])
    slow = low_pass(Signal(even_s, even, 1.0 / STEP_S, 1.0, np.empty((0, 2))), SLOW_HZ).value
    speed = np.linalg.norm(np.gradient(slow, STEP_S, axis=0), axis=1)
    out = np.interp(time_s, even_s, speed)
    out[~known] = np.nan
    return np.asarray(out)


# --- space -----------------------------------------------------------------------------------------------------
def _common(reference: Reference) -> list[str]:
    names = [name for name in PALM_MARKERS if name in reference.points_m]
    if len(names) < 3:
        raise ReferenceUnsuited(
            reference.path,
            phrase("three discs of the palm are needed; say which of {there} they are", there=listed(reference.names)),
        )
    return names


def _angles_of_points(
    session: Session, reference: Reference, time_s: FloatArray, shift: Shift
) -> tuple[dict[str, FloatArray], Alignment]:
    """The wrist's angles of the reference's points, on the session's definition of the hand's axes at its neutral pose.

    The discs of the palm are one rigid body in both: their whole ways give the turn between the two systems of axes,
    and the reference's own neutral pose its zero.
    """
    names = _common(reference)
    markers = session.header.protocol.markers
    reference_s = _since_start(reference, session)
    theirs = np.stack([reference.points_m[name] for name in names], axis=1)
    mine = np.stack([session.markers.position_cam_m[:, markers.index(name)] for name in names], axis=1)
    there = at_times(shift.reference_time_s(time_s), reference_s, theirs)
    both = np.isfinite(there).all(axis=(1, 2)) & np.isfinite(mine).all(axis=(1, 2))
    both &= np.asarray(session.status) == TrackStatus.TRACKED
    if both.sum() < FEWEST:
        raise ReferenceUnsuited(reference.path, phrase("the two have no time in common"))
    turn, move = so3.rigid(there[both].reshape(-1, 3), mine[both].reshape(-1, 3))
    off = there[both] @ turn.T + move - mine[both]
    known = np.isfinite(theirs).all(axis=(1, 2))
    side = session.header.hand
    start = rotation_from_angles(np.nan_to_num(session.calibration.start_angles_rad), side)
    begin_s, zero = 0.0, NEUTRAL_POSE
    own_s = (reference_s - shift.reference_later_s) / (1.0 + shift.drift)
    if not (known & _within(own_s, begin_s)).any():
        # It began later: the zero is the session's own at the first moment that both have.
        begin_s, zero = float(time_s[both][0]), FIRST_IN_COMMON
        own = session.motion.rotation_w2_w0[both & _within(time_s, begin_s)]
        start = so3.mean_rotation(own, np.full(len(own), 1.0 / len(own)))
    neutral = theirs[known & _within(own_s, begin_s)].mean(axis=0)
    w0_in_reference = turn.T @ session.calibration.rotation_w0_cam
    rotation = np.full((len(theirs), 3, 3), np.nan)
    for k in np.flatnonzero(known):
        body, _ = so3.rigid(neutral, theirs[k])
        rotation[k] = w0_in_reference.T @ body @ w0_in_reference
    angles = angles_from_rotation(rotation @ start, side)
    residual = float(np.sqrt(np.mean(np.sum(off**2, axis=-1))))
    turned = float(np.linalg.norm(so3.log(turn)))
    return (
        {name: angles[:, k] for k, name in enumerate(WRIST_ANGLES)},
        Alignment(turned, residual, tuple(names), zero),
    )


def _within(time_s: FloatArray, begin_s: float) -> np.ndarray:
    return (time_s >= begin_s - 1e-6) & (time_s <= begin_s + NEUTRAL_S)


# --- readings --------------------------------------------------------------------------------------------------
def _with_readings(
    reference: Reference,
    time_s: FloatArray,
    own: Mapping[str, FloatArray],
    figures: SessionFigures | None,
) -> Compared:
    """Readings with a time against the held angle about it; those without against the session's range that way."""
    not_used = list(reference.unused)
    found: dict[str, list[tuple[float, float, float]]] = {}
    left = 0
    for reading in reference.readings:
        if reading.angle not in own:
            not_used.append(phrase("{angle}: not in the session", angle=reading.angle))
            continue
        if math.isfinite(reading.time_s):
            about = np.abs(time_s - reading.time_s) <= STILL_S
            values = own[reading.angle][about & np.isfinite(own[reading.angle])]
            if len(values) < FEWEST or float(np.ptp(values)) > 2.0 * STILL_RAD:
                left += 1
                not_used.append(
                    phrase(
                        "{angle} at {time} s: the hand was not still, or not seen",
                        angle=reading.angle,
                        time=f"{reading.time_s:g}",
                    )
                )
                continue
            mine = float(values.mean())
        else:
            mine = _range_end(figures, reading.angle, reading.movement)
            if not math.isfinite(mine):
                left += 1
                not_used.append(
                    phrase(
                        "{movement}: the session has no range that way, and the list names no time",
                        movement=reading.movement,
                    )
                )
                continue
        found.setdefault(reading.angle, []).append((reading.time_s, mine, reading.value_rad))
    pairs = []
    for name in own:
        if name in found:
            t, mine_rad, theirs_rad = (np.array(column) for column in zip(*found[name], strict=True))
            figures_deg = agreement(np.degrees(mine_rad), np.degrees(theirs_rad), waveform=False)
            pairs.append(Pairs(name, t, mine_rad, theirs_rad, figures_deg))
    if not pairs:
        raise ReferenceUnsuited(reference.path, not_used[-1] if not_used else phrase("no reading can be used"))
    count = len(reference.readings)
    return Compared(
        reference.kind, tuple(pairs), None, None, count, left, math.nan, math.nan, tuple(not_used),
        (*reference.remarks, *remarks_of(pairs, None)),
    )  # fmt: skip


def _range_end(figures: SessionFigures | None, angle: str, movement: str) -> float:
    """Mean of the ranges that way, radians with its sign."""
    if figures is None:
        return math.nan
    row = figures.find(angle, movement)
    if row is None:
        return math.nan
    away = movement in ("extension", "ulnar", "pronation") and row.angle >= 0
    end = math.radians(-row.mean if away else row.mean)
    is_forearm = movement in ("supination", "pronation")  # which a range has from thumb up, and a pair not
    return float(pronosupination_from_palm_down(np.array(end))) if is_forearm else end
