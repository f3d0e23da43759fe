"""The bound: the filter and smoother of Carpus, told what nobody can know.

It is given the true name of every blob, the true hand and neutral pose, the constant part of each marker's
measurement error, taken away, and the variance of the rest. What it still gets wrong no association, calibration or
noise model could mend; only another filter could.
"""

from __future__ import annotations

import time
from dataclasses import replace

import numpy as np

from carpus.core.hand import clinical_angles
from carpus.core.tracking.kernel import Bank, carried, mixed
from carpus.core.tracking.motion import PalmMotion, palm_step, slowing
from carpus.core.tracking.palm_association import Measurements, update
from carpus.core.tracking.palm_smoother import FilterStep, smoothed_palm
from carpus.core.tracking.palm_state import SIZE, TURN, PalmBelief, resting_belief
from carpus.core.tracking.palm_view import View, recentred
from carpus.core.tracking.predicted_measurement import predicted_measurement
from carpus.core.tracking.settings import TrackerSettings
from carpus.core.tracking.soft_tissue import always_pushed
from carpus.core.types import FloatArray, Side, TrackStatus
from tests.accuracy.runs import INFORMED, Estimate, Mode, Run, degrees_between
from tests.accuracy.scenarios import Scenario
from tests.accuracy.sequences import LEAST_DISCS, measured_and_errors, scored_frames
from tests.simulation.measurements import MeasurementSequence
from tests.tracking.hands import RIGID


def informed_run(
    scenario: Scenario,
    sequence: MeasurementSequence,
    begin_s: float,
    mode: Mode,
    settings: TrackerSettings | None = None,
) -> Run:
    """Filter and smooth a wrist sequence; frames after ``begin_s`` are scored, as those of Carpus are."""
    settings = TrackerSettings() if settings is None else settings
    truth = sequence.truth
    measured, error = measured_and_errors(sequence)
    measured = measured - np.nanmean(error, axis=0)
    variance = np.nanmean(np.nanvar(error, axis=0), axis=0)
    view = View(
        truth.camera,
        truth.rotation_w0_cam,
        truth.translation_w0_cam_m,
        truth.marker_position_w0_m,
        np.zeros((6, 18)),
    )
    scales = np.array(settings.mode_scales)
    motion = PalmMotion(settings.motion_noise, always_pushed(RIGID.tissue), scales)
    belief = resting_belief(settings.initial, 1e-14 * np.eye(21))
    bank = Bank.alike(np.zeros((1, SIZE)), belief.covariance[None], scales.size)
    steps: list[FilterStep] = []
    beliefs: list[PalmBelief] = []
    as_stated = np.ones(measured.shape[1:])
    times = truth.timestamp_s
    begin = time.process_time()
    for i, seen in enumerate(measured):
        dt_s = float(times[i] - times[i - 1]) if i else 1e-6
        step = palm_step(belief.rate_rad_s, motion, dt_s)
        bank = carried(mixed(bank, motion.switch(belief.rate_rad_s, dt_s)), step, belief.value)
        ahead_of = replace(step.carries(belief, dt_s), covariance=bank.merged()[1][0])
        ahead = predicted_measurement(ahead_of, bank, view, settings.spread)
        names = np.where(np.isfinite(seen[:, 0]), np.arange(len(seen)), -1)
        blobs = Measurements(seen, np.broadcast_to(variance, seen.shape))
        belief, bank = recentred(ahead_of, update(ahead, blobs, names, np.isfinite(seen[:, 2]), as_stated).bank)
        if np.count_nonzero(names >= 0) < LEAST_DISCS:
            kept = slowing(float(np.exp(-dt_s / settings.rate_memory_s)))
            belief = replace(belief, value=belief.value * kept, covariance=belief.covariance * np.outer(kept, kept))
            bank = Bank(bank.mean * kept, bank.covariance * np.outer(kept, kept), bank.probability)
        beliefs.append(belief)
        steps.append(FilterStep(float(times[i]), belief, bank.probability[0], True))
    ms = 1e3 * (time.process_time() - begin) / len(times)
    scored = scored_frames(truth, begin_s)
    smoothed = [belief for belief in smoothed_palm(steps, motion) if belief is not None]
    true_rad = truth.angles_rad[scored]
    return Run(
        scenario.name,
        truth.spec.seed,
        mode,
        INFORMED,
        _estimate(_only(beliefs, scored), truth.spec.hand, true_rad),
        _estimate(_only(smoothed, scored), truth.spec.hand, true_rad),
        np.full(int(scored.sum()), TrackStatus.TRACKED),
        int(np.isfinite(measured[scored, :, 0]).sum()),
        0,
        0.0,
        0.0,
        ms,
    )


def _only(beliefs: list[PalmBelief], scored: np.ndarray) -> list[PalmBelief]:
    return [belief for belief, keep in zip(beliefs, scored, strict=True) if keep]


def _estimate(beliefs: list[PalmBelief], side: Side, true_rad: FloatArray) -> Estimate:
    rotation = np.array([belief.rotation_w2_w0 for belief in beliefs])
    turn = np.array([belief.covariance[TURN, TURN] for belief in beliefs])
    by_turn = clinical_angles.angle_rates_matrix(rotation, side)
    variance = np.einsum("nij,njk,nik->ni", by_turn, turn, by_turn)
    angles = clinical_angles.angles_from_rotation(rotation, side)
    return Estimate(degrees_between(angles, true_rad), np.degrees(np.sqrt(variance)))
