"""The bound: the filter of Carpus, told what nobody can know.

It is given the true name of every blob, the true hand and neutral pose, the constant part of each marker's
measurement error, taken away, and the variance of the rest. What it still gets wrong no association, calibration or
noise model could mend; only another filter could.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from carpus.core.model.hand import clinical_angles
from carpus.core.model.types import FloatArray, Side, TrackStatus
from carpus.core.tracking.association.palm_association import Measurements, update_palm
from carpus.core.tracking.filter.mixture_filter import ModeMixture
from carpus.core.tracking.filter.motion import RATE_MEMORY_S, PalmMotion, fading_factors, predict_palm
from carpus.core.tracking.filter.palm_state import SIZE, TURN, PalmEstimate, PalmView, initial_estimate, reset_error
from carpus.core.tracking.filter.predicted_measurement import predict_measurement
from carpus.core.tracking.filter.settings import TrackerSettings
from carpus.core.tracking.filter.soft_tissue import single_moving_mode
from tests.accuracy.runs import INFORMED, Estimate, Mode, Run, degrees_between
from tests.accuracy.scenarios import Scenario
from tests.accuracy.sequences import LEAST_DISCS, select_scored_frames, split_measurements
from tests.simulation.measurements import MeasurementSequence
from tests.tracking.hands import RIGID


def run_informed(scenario: Scenario, sequence: MeasurementSequence, begin_s: float, mode: Mode) -> Run:
    """Filter a wrist sequence; frames after ``begin_s`` are scored, as those of Carpus are."""
    settings, truth = TrackerSettings(), sequence.truth
    measured, error = split_measurements(sequence)
    measured = measured - np.nanmean(error, axis=0)
    variance = np.nanmean(np.nanvar(error, axis=0), axis=0)
    view = PalmView(
        truth.camera, truth.rotation_w0_cam, truth.translation_w0_cam_m, truth.marker_position_w0_m, np.zeros((6, 18))
    )
    scales = np.array(settings.mode_scales)
    motion = PalmMotion(settings.motion_noise, single_moving_mode(RIGID.tissue), scales)
    estimate = initial_estimate(settings.initial, 1e-14 * np.eye(21))
    mixture = ModeMixture.from_gaussian(np.zeros((1, SIZE)), estimate.covariance[None], scales.size)
    estimates: list[PalmEstimate] = []
    as_stated = np.ones(measured.shape[1:])
    times = truth.timestamp_s
    for i, seen in enumerate(measured):
        dt_s = float(times[i] - times[i - 1]) if i else 1e-6
        ahead_of, mixture = predict_palm(estimate, mixture, motion, dt_s)
        ahead = predict_measurement(ahead_of, mixture, view, settings.scaling)
        names = np.where(np.isfinite(seen[:, 0]), np.arange(len(seen)), -1)
        blobs = Measurements(seen, np.broadcast_to(variance, seen.shape))
        estimate, mixture = reset_error(
            ahead_of, update_palm(ahead, blobs, names, np.isfinite(seen[:, 2]), as_stated).mixture
        )
        if np.count_nonzero(names >= 0) < LEAST_DISCS:
            kept = fading_factors(float(np.exp(-dt_s / RATE_MEMORY_S)))
            estimate = replace(
                estimate, value=estimate.value * kept, covariance=estimate.covariance * np.outer(kept, kept)
            )
            mixture = ModeMixture(mixture.mean * kept, mixture.covariance * np.outer(kept, kept), mixture.probability)
        estimates.append(estimate)
    scored = select_scored_frames(truth, begin_s)
    true_rad = truth.angles_rad[scored]
    return Run(
        scenario.name,
        truth.spec.seed,
        mode,
        INFORMED,
        _estimate([estimates[i] for i in np.flatnonzero(scored)], truth.spec.hand, true_rad),
        None,
        np.full(int(scored.sum()), TrackStatus.TRACKED),
        int(np.isfinite(measured[scored, :, 0]).sum()),
        0,
        0.0,
        0.0,
    )


def _estimate(estimates: list[PalmEstimate], side: Side, true_rad: FloatArray) -> Estimate:
    rotation = np.array([estimate.rotation_w2_w0 for estimate in estimates])
    turn = np.array([estimate.covariance[TURN, TURN] for estimate in estimates])
    by_turn = clinical_angles.angle_rates_matrix(rotation, side)
    variance = np.einsum("nij,njk,nik->ni", by_turn, turn, by_turn)
    angles = clinical_angles.angles_from_rotation(rotation, side)
    return Estimate(degrees_between(angles, true_rad), np.degrees(np.sqrt(variance)))
