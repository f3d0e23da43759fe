"""Motion modes: the same hand at rest, at exercise and in haste, run side by side.

An interacting multiple model (Blom and Bar-Shalom 1988): each mode is the same filter with its process
noise scaled; how well each foresaw the measurements decides its weight, so nobody has to choose between
a calm curve and one that follows. All modes are kept as small errors from one nominal belief.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from core import so3
from core.tracking.motion import REFERENCE_DT_S, MotionNoise, carried, coasted, stride
from core.tracking.state import Belief, StateLayout
from core.types import FloatArray


@dataclass(frozen=True, slots=True)
class ModeBank:
    """K beliefs about one hand: ``error`` (K, n) of each mode's mean from the nominal one, ``covariance``
    (K, n, n), ``probability`` (K,). Right after :func:`merged` the nominal belief is that of the mixture."""

    nominal: Belief
    error: FloatArray
    covariance: FloatArray
    probability: FloatArray

    @staticmethod
    def of(belief: Belief, count: int) -> ModeBank:
        """All modes alike and as probable."""
        n = belief.covariance.shape[0]
        covariance = np.broadcast_to(belief.covariance, (count, n, n)).copy()
        return ModeBank(belief, np.zeros((count, n)), covariance, np.full(count, 1.0 / count))


def switching(count: int, dwell_s: float, dt_s: float = REFERENCE_DT_S) -> FloatArray:
    """Probability (K, K) to go from row to column mode in ``dt_s``, staying ``dwell_s`` on average."""
    if count == 1:
        return np.ones((1, 1))
    leave = 1.0 - math.exp(-dt_s / dwell_s)
    out = np.full((count, count), leave / (count - 1))
    out.reshape(-1)[:: count + 1] = 1.0 - leave
    return out


def mixed(bank: ModeBank, switch: FloatArray) -> ModeBank:
    """Start of the next step: each mode's belief mixed from all that may have switched to it."""
    if bank.probability.size == 1:
        return bank
    probability = bank.probability @ switch
    share = (switch * bank.probability[:, None] / probability).T  # (to, from)
    error = share @ bank.error
    apart = bank.error - error[:, None, :]  # (to, from, n)
    covariance = (share @ bank.covariance.reshape(share.shape[0], -1)).reshape(bank.covariance.shape)
    covariance += (apart * share[:, :, None]).transpose(0, 2, 1) @ apart
    return ModeBank(bank.nominal, error, covariance, probability)


def predicted(bank: ModeBank, noise: MotionNoise, scales: FloatArray, dt_s: float, layout: StateLayout) -> ModeBank:
    """Linear prediction of all modes, the noise of each multiplied by its scale (K,): P <- F P F' + Q."""
    step = stride(bank.nominal, noise, dt_s, layout)
    error = bank.error.copy()
    error[:, layout.moving] = error[:, layout.moving] @ step.forward.T
    covariance = carried(bank.covariance, step, layout, scales * scales)
    return ModeBank(coasted(bank.nominal, step, dt_s, layout), error, covariance, bank.probability)


def merged(bank: ModeBank, layout: StateLayout) -> ModeBank:
    """The bank with its nominal belief moved to the mean of the mixture and given its covariance."""
    probability = bank.probability
    mean = probability @ bank.error
    apart = bank.error - mean
    covariance = (probability @ bank.covariance.reshape(probability.size, -1)).reshape(mean.size, mean.size)
    covariance += (apart.T * probability) @ apart
    turn = layout.turn
    # The turns are measured from another rotation now: log(Exp(-m) Exp(e)) to second order.
    error = apart.copy()
    error[:, turn] += 0.5 * (bank.error[:, turn] @ so3.skew(mean[turn]))
    return ModeBank(bank.nominal.moved(mean, layout, covariance), error, bank.covariance, probability)


def reweighed(predicted_probability: FloatArray, log_likelihood: FloatArray) -> FloatArray:
    """Probabilities (K,) after the measurement; none ever falls to zero."""
    log_weight = np.log(predicted_probability) + log_likelihood
    weight = np.exp(log_weight - log_weight.max())
    weight = np.maximum(weight / weight.sum(), 1e-6)
    return np.asarray(weight / weight.sum())


def slowed(bank: ModeBank, keep: float, layout: StateLayout) -> ModeBank:
    """The bank with all velocities multiplied by ``keep``, their uncertainty and the modes' differences too."""
    nominal = replace(
        bank.nominal,
        velocity_m_s=bank.nominal.velocity_m_s * keep,
        rate_rad_s=bank.nominal.rate_rad_s * keep,
        joint_rates_rad_s=bank.nominal.joint_rates_rad_s * keep,
    )
    kept = np.ones(layout.size)
    for rate in (layout.velocity, layout.rate, layout.joint_rates):
        kept[rate] = keep
    both = np.outer(kept, kept)
    nominal = replace(nominal, covariance=nominal.covariance * both)
    return ModeBank(nominal, bank.error * kept, bank.covariance * both, bank.probability)
