"""How sure the figures of a session are."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from carpus.core.hand.exercises import STILL_RADIUS_MM, Exercise
from carpus.core.measures.fingers import JointTrack
from carpus.core.measures.forearm import WristCentre, rotation_in_place, wrist_centre
from carpus.core.measures.signals import even_signal, low_pass
from carpus.core.results.repetition_rows import ShownRepetition
from carpus.core.results.seen import SeenSession, best_motion
from carpus.core.session.values import Session
from carpus.core.types import FloatArray, TrackStatus

STILLNESS_CUTOFF_HZ = 3.0
"""A forearm does not move faster than this; noise does."""


@dataclass(frozen=True, slots=True)
class Quality:
    """How sure the figures are. Shares 0 to 1 of all frames; ``hidden_share`` of all looks at markers."""

    frames: int
    measured_share: float
    hidden_share: float
    dropped: int
    forearm_mm: float
    angle_sd_deg: float
    tilt_deg: float
    distance_m: float
    residual_mm: float
    centre_mm: tuple[float, float, float] = (math.nan,) * 3
    centre_residual_mm: float = math.nan
    """Where the wrist turns, from the WRIST disc in the hand's axes, and how well that fits."""

    @property
    def forearm_moved(self) -> bool:
        """Whether the wrist's centre left the ball it must stay in."""
        return self.forearm_mm > STILL_RADIUS_MM


def quality_of(seen: SeenSession, repetitions: Sequence[ShownRepetition]) -> Quality:
    """Of a session with these repetitions."""
    session, motion, verdict = seen.session, best_motion(seen.session), seen.session.calibration.verdict
    time_s = session.timestamp_s - session.timestamp_s[:1]
    centre = wrist_centre(motion.position_m, rotation_in_place(motion.rotation_w2_w0, motion.w0_turn_rad), seen.view)
    within = [one for one in repetitions if one.counts] if seen.tracks else ()
    return Quality(
        frames=len(session),
        measured_share=float(np.mean(session.status == TrackStatus.TRACKED)) if len(session) else math.nan,
        hidden_share=_hidden_share(session, time_s, within),
        dropped=int(np.maximum(session.quality.dropped_before, 0).sum()),
        forearm_mm=_forearm_mm(time_s, centre),
        centre_mm=tuple((1e3 * centre.centre_w2_m).tolist()),
        centre_residual_mm=1e3 * centre.residual_m,
        angle_sd_deg=_typical_joint_sd(seen.tracks) if seen.tracks else _typical_sd(session, seen.exercise),
        tilt_deg=verdict.tilt_deg,
        distance_m=verdict.distance_m,
        residual_mm=float(np.nanmax(verdict.residual_mm)) if np.isfinite(verdict.residual_mm).any() else math.nan,
    )


def _hidden_share(session: Session, time_s: FloatArray, within: Sequence[ShownRepetition]) -> float:
    """Share of all looks at markers in which one was hidden, within repetitions if any: rest hides none."""
    inside = np.ones(len(time_s), dtype=bool)
    if within:
        inside = np.any([(time_s >= rep.start_s) & (time_s <= rep.end_s) for rep in within], axis=0)
    seen = np.isfinite(session.markers.measured_px[inside, :, 0])
    return float(np.mean(~seen)) if seen.size else math.nan


def _forearm_mm(time_s: FloatArray, centre: WristCentre) -> float:
    """How far the forearm went: what the centre of the wrist's turning moved, without a frame's noise."""
    known = np.isfinite(centre.moved_m)
    if int(known.sum()) < 2:
        return math.nan
    moved = low_pass(even_signal(time_s, centre.moved_m, known), STILLNESS_CUTOFF_HZ).value
    return 1000.0 * float(np.nanmax(moved)) if np.isfinite(moved).any() else math.nan


def _typical_sd(session: Session, exercise: Exercise) -> float:
    sds_deg = np.degrees(best_motion(session).angles_sd_rad)
    columns = sds_deg if exercise.angle is None else sds_deg[:, [exercise.angle]]
    known = columns[(np.asarray(session.status) == TrackStatus.TRACKED)[:, None] & np.isfinite(columns)]
    return float(np.median(known)) if known.size else math.nan


def _typical_joint_sd(tracks: Mapping[str, JointTrack]) -> float:
    known = [track.seen_sd.value[track.seen_sd.finite] for track in tracks.values() if track.known]
    return math.degrees(float(np.median(np.concatenate(known)))) if known else math.nan
