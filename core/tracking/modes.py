"""Motion modes: the same hand at rest, at exercise and in haste, run side by side.

An interacting multiple model (Blom and Bar-Shalom 1988): each mode is the same filter with its process
noise scaled; how well each foresaw the measurements decides its weight, so nobody has to choose between
a calm curve and one that follows.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from core.tracking.motion import REFERENCE_DT_S
from core.tracking.state import Belief, StateLayout
from core.types import FloatArray


def switching(count: int, dwell_s: float, dt_s: float = REFERENCE_DT_S) -> FloatArray:
    """Probability (K, K) to go from row to column mode in ``dt_s``, staying ``dwell_s`` on average."""
    if count == 1:
        return np.ones((1, 1))
    leave = 1.0 - np.exp(-dt_s / dwell_s)
    out = np.full((count, count), leave / (count - 1))
    np.fill_diagonal(out, 1.0 - leave)
    return out


def merge(beliefs: Belief, probability: FloatArray, layout: StateLayout) -> Belief:
    """One Gaussian with the mean and covariance of the mixture of K beliefs."""
    if probability.size == 1:
        return beliefs.pick(0)
    best = beliefs.pick(int(np.argmax(probability)))
    error = best.error_to(beliefs, layout)
    mean = probability @ error
    apart = error - mean
    covariance = np.tensordot(probability, beliefs.covariance, axes=1) + (apart.T * probability) @ apart
    return best.moved(mean, layout, covariance)


def mix(beliefs: Belief, probability: FloatArray, switch: FloatArray, layout: StateLayout) -> tuple[Belief, FloatArray]:
    """Start of the next step: each mode's belief mixed from all, and the modes' probabilities (K,)."""
    if probability.size == 1:
        return beliefs, probability
    joint = switch * probability[:, None]
    predicted = joint.sum(axis=0)
    share = joint / predicted  # (from, to)
    best = beliefs.pick(int(np.argmax(probability)))
    error = best.error_to(beliefs, layout)
    mean = share.T @ error
    apart = error[None, :, :] - mean[:, None, :]  # (to, from, n)
    covariance = (
        np.tensordot(share.T, beliefs.covariance, axes=1) + np.swapaxes(apart * share.T[:, :, None], -1, -2) @ apart
    )
    lead = (probability.size,)
    base = Belief(
        *(
            np.broadcast_to(a, (*lead, *a.shape))
            for a in (
                best.position_m,
                best.velocity_m_s,
                best.rotation_w2_w0,
                best.rate_rad_s,
                best.joints_rad,
                best.joint_rates_rad_s,
                best.shape,
                best.covariance,
            )
        )
    )
    return replace(base.moved(mean, layout), covariance=covariance), predicted


def reweigh(predicted: FloatArray, log_likelihood: FloatArray) -> FloatArray:
    """Probabilities (K,) after the measurement; none ever falls to zero."""
    log_weight = np.log(predicted) + log_likelihood
    weight = np.exp(log_weight - log_weight.max())
    weight = np.maximum(weight / weight.sum(), 1e-6)
    return np.asarray(weight / weight.sum())
