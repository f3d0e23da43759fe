"""The bound: the filter and smoother of Carpus, told what nobody can know.

It is given the true name of every blob, the true hand and neutral pose, the constant part of each marker's
measurement error, taken away, and the variance of the rest. What it still gets wrong no association, calibration or
noise model could mend; only another filter could.
"""

from __future__ import annotations

import time

import numpy as np

from core.hand import clinical_angles
from core.simulation.measurements import MeasurementSequence
from core.tracking import modes
from core.tracking.measurement import RigidPalm, View, forecast_reduced
from core.tracking.modes import ModeBank
from core.tracking.naming import Measurable, correct
from core.tracking.settings import TrackerSettings
from core.tracking.smoother import FilterStep, smooth
from core.tracking.state import Belief, StateLayout, resting_belief
from core.types import FloatArray, Side, TrackStatus
from tests.accuracy.runs import INFORMED, Estimate, Mode, Run, degrees_between
from tests.accuracy.scenarios import Scenario
from tests.accuracy.sequences import LEAST_DISCS, measured_and_errors, scored_frames


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
    layout = StateLayout(0, settings.motion == "constant_rate", 0)
    view = View(truth.camera, truth.rotation_w0_cam, truth.translation_w0_cam_m, RigidPalm(truth.marker_position_w0_m))
    scales = np.array(settings.mode_scales)
    bank = ModeBank.of(resting_belief(layout, settings.initial), scales.size)
    steps: list[FilterStep] = []
    beliefs: list[Belief] = []
    as_stated = np.ones(measured.shape[1:])
    times = truth.timestamp_s
    begin = time.process_time()
    for i, seen in enumerate(measured):
        dt_s = float(times[i] - times[i - 1]) if i else 1e-6
        switch = modes.switching(scales.size, settings.mode_dwell_s, dt_s)
        ahead = forecast_reduced(
            modes.mixed(bank, switch), settings.motion_noise, scales, dt_s, layout, view, settings.spread
        )
        names = np.where(np.isfinite(seen[:, 0]), np.arange(len(seen)), -1)
        blobs = Measurable(seen, np.broadcast_to(variance, seen.shape))
        bank = modes.merged(correct(ahead, blobs, names, np.isfinite(seen[:, 2]), as_stated).bank, layout)
        if np.count_nonzero(names >= 0) < LEAST_DISCS:
            bank = modes.slowed(bank, float(np.exp(-dt_s / settings.rate_memory_s)), layout)
        beliefs.append(bank.nominal)
        steps.append(FilterStep(float(times[i]), bank.nominal, float(np.sqrt(bank.probability @ scales**2)), True))
    ms = 1e3 * (time.process_time() - begin) / len(times)
    scored = scored_frames(truth, begin_s)
    smoothed = [belief for belief in smooth(steps, settings.motion_noise, layout) if belief is not None]
    true_rad = truth.angles_rad[scored]
    return Run(
        scenario.name,
        truth.spec.seed,
        mode,
        INFORMED,
        _estimate(_only(beliefs, scored), truth.spec.hand, layout, true_rad),
        _estimate(_only(smoothed, scored), truth.spec.hand, layout, true_rad),
        np.full(int(scored.sum()), TrackStatus.TRACKED),
        int(np.isfinite(measured[scored, :, 0]).sum()),
        0,
        0.0,
        0.0,
        ms,
    )


def _only(beliefs: list[Belief], scored: np.ndarray) -> list[Belief]:
    return [belief for belief, keep in zip(beliefs, scored, strict=True) if keep]


def _estimate(beliefs: list[Belief], side: Side, layout: StateLayout, true_rad: FloatArray) -> Estimate:
    rotation = np.array([belief.rotation_w2_w0 for belief in beliefs])
    turn = np.array([belief.covariance[layout.turn, layout.turn] for belief in beliefs])
    by_turn = clinical_angles.angle_rates_matrix(rotation, side)
    variance = np.einsum("nij,njk,nik->ni", by_turn, turn, by_turn)
    angles = clinical_angles.angles_from_rotation(rotation, side)
    return Estimate(degrees_between(angles, true_rad), np.degrees(np.sqrt(variance)))
