"""Motion modes: the same hand at rest, at exercise and in haste, run side by side.

An interacting multiple model (Blom and Bar-Shalom 1988): each mode is the same filter with its process
noise scaled; how well each foresaw the measurements decides its weight, so nobody has to choose between
a calm curve and one that follows. All modes are kept as small errors from one nominal belief.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from core.tracking.motion import REFERENCE_DT_S, MotionNoise, advance, process_covariance, transition
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
    leave = 1.0 - np.exp(-dt_s / dwell_s)
    out = np.full((count, count), leave / (count - 1))
    np.fill_diagonal(out, 1.0 - leave)
    return out


def mixed(bank: ModeBank, switch: FloatArray) -> ModeBank:
    """Start of the next step: each mode's belief mixed from all that may have switched to it."""
    if bank.probability.size == 1:
        return bank
    joint = switch * bank.probability[:, None]
    probability = joint.sum(axis=0)
    share = (joint / probability).T  # (to, from)
    error = share @ bank.error
    apart = bank.error - error[:, None, :]  # (to, from, n)
    within = (share @ bank.covariance.reshape(share.shape[0], -1)).reshape(bank.covariance.shape)
    between = np.swapaxes(apart * share[:, :, None], -1, -2) @ apart
    return ModeBank(bank.nominal, error, within + between, probability)


def predicted(bank: ModeBank, noise: MotionNoise, scales: FloatArray, dt_s: float, layout: StateLayout) -> ModeBank:
    """Linear prediction of all modes, the noise of each multiplied by its scale (K,): P <- F P F' + Q."""
    f = transition(bank.nominal, dt_s, layout)
    q = process_covariance(bank.nominal, noise, dt_s, layout)
    nominal = advance(bank.nominal, np.zeros(6 + layout.joint_count), dt_s, layout)
    covariance = f @ bank.covariance @ f.T + (scales * scales)[:, None, None] * q
    return ModeBank(nominal, bank.error @ f.T, covariance, bank.probability)


def merged(bank: ModeBank, layout: StateLayout) -> ModeBank:
    """The bank with its nominal belief moved to the mean of the mixture and given its covariance."""
    mean = bank.probability @ bank.error
    apart = bank.error - mean
    within = (bank.probability @ bank.covariance.reshape(bank.probability.size, -1)).reshape(mean.size, mean.size)
    covariance = within + (apart.T * bank.probability) @ apart
    turn = layout.turn
    # The turns are measured from another rotation now: log(Exp(-m) Exp(e)) to second order.
    error = apart.copy()
    x, y, z = mean[turn]
    error[:, turn] -= 0.5 * (bank.error[:, turn] @ np.array([[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]]))
    return ModeBank(bank.nominal.moved(mean, layout, covariance), error, bank.covariance, bank.probability)


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
