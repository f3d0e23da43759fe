"""Motion model of the palm: constant velocities, driven by white accelerations.

Noise is given as the papers' standard deviation per sample at 30 frames a second and used as a continuous density q =
sd^2 / 30, so that other or missing frame times keep their meaning (clinical reference 4.5). The acceleration acts all
along the step: Q holds q dt^3 / 3, q dt^2 / 2 and q dt.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from carpus.core.compiled.mixture import predict_palm_modes
from carpus.core.compiled.palm import compute_palm_transition
from carpus.core.model.types import FloatArray
from carpus.core.tracking.filter.mixture_filter import ModeMixture, Transition
from carpus.core.tracking.filter.palm_state import POSITION, RATE, SIZE, SKIN, TURN, VELOCITY, PalmEstimate
from carpus.core.tracking.filter.soft_tissue import HOME, STILL, ZERO_SPEEDS, DigitSpeeds, TissueModes

REFERENCE_DT_S = 1.0 / 30.0

MODE_DWELL_S = 0.5  # mean time in a motion mode
RATE_MEMORY_S = 0.2  # over which the velocity of an unseen hand fades
COLLINEAR_RMS_M = 0.008  # discs that lie as near (rms) to one line say nothing of turning about it


@dataclass(frozen=True, slots=True)
class MotionNoise:
    """Standard deviations per sample at 30 Hz.

    ``acceleration_m_s2`` of the wrist (eta_v of the papers), ``turn_acceleration_rad_s2`` of its turning,
    ``joint_acceleration_rad_s2`` of the fingers.
    """

    acceleration_m_s2: float = 2.0
    turn_acceleration_rad_s2: float = 8.0
    joint_acceleration_rad_s2: float = 12.0

    @property
    def acceleration_density(self) -> float:
        """Density q of the wrist's acceleration, m^2/s^3."""
        return self.acceleration_m_s2**2 * REFERENCE_DT_S

    @property
    def turn_acceleration_density(self) -> float:
        """Density q of its angular acceleration, rad^2/s^3."""
        return self.turn_acceleration_rad_s2**2 * REFERENCE_DT_S


@dataclass(frozen=True, slots=True)
class PalmTransition(Transition):
    """A step of the palm: ``switch`` (K, K) from row to column mode, and the rotation (3, 3) that its rate makes."""

    switch: FloatArray
    rotation_increment: FloatArray

    def propagate(self, estimate: PalmEstimate, dt_s: float, covariance: FloatArray | None = None) -> PalmEstimate:
        """Return the nominal estimate after the step, its covariance as before or as given."""
        value = estimate.value.copy()
        value[POSITION] += estimate.velocity_m_s * dt_s
        value[TURN] = 0.0
        covariance = estimate.covariance if covariance is None else covariance
        return PalmEstimate(estimate.rotation_w2_w0 @ self.rotation_increment, value, covariance)


@dataclass(frozen=True, slots=True)
class PalmMotion:
    """Process model of one palm.

    ``noise`` of its motion, whose root the modes multiply by ``scales`` (M,), and its soft ``tissue``. Motions last
    ``dwell_s``. Resting tissue is combined with every motion; while it moves the hand is taken to move calmly,
    ``moving_scale``: else a moving hand explains what tissue does, and the other way. ``unseen_scale`` is the factor
    for turns that nothing in the frame shows: how briskly a hand moves is told by what is seen of it, and says nothing
    of these. ``scale_of`` and ``tissue_of`` give, of each of the K modes (K,), those at rest first, the factor on the
    motion's noise and the tissue's mode.
    """

    noise: MotionNoise
    tissue: TissueModes
    scales: FloatArray
    unseen_scale: float = 3.0
    dwell_s: float = MODE_DWELL_S
    moving_scale: float = 0.5

    scale_of: FloatArray = field(init=False, repr=False, compare=False)
    tissue_of: NDArray[np.int64] = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        resting, count = self.tissue.resting, self.tissue.count
        scale = [*np.repeat(self.scales, resting), *(self.moving_scale for _ in range(resting, count))]
        object.__setattr__(self, "scale_of", np.array(scale, dtype=np.float64))
        tissue = [*np.tile(np.arange(resting), self.scales.size), *range(resting, count)]
        object.__setattr__(self, "tissue_of", np.array(tissue))

    @property
    def modes(self) -> int:
        return self.scale_of.size

    @property
    def initial_probability(self) -> FloatArray:
        """Probability (K,) of the modes of a hand just calibrated."""
        out: FloatArray = self.tissue.initial_probability[self.tissue_of]
        out[: self.scales.size * self.tissue.resting] /= self.scales.size
        return out

    def tissue_noise(self, mode_transitions: FloatArray, step: PalmTransition) -> FloatArray:
        """Return the noise (r, r) of the tissue in a step with these mode transitions (K, K).

        For smoothing, where tissue keeps all it has: coming home is driven as well.
        """
        tissue = self.tissue
        joint = np.zeros((tissue.count, tissue.count))
        np.add.at(joint, (self.tissue_of[:, None], self.tissue_of), mode_transitions)
        pushed = np.empty((tissue.count, *step.relaxing.shape[1:]))
        pushed[self.tissue_of] = step.relaxing
        if tissue.count == 1:
            return np.asarray(pushed[0])
        skin = slice(0, SKIN.stop - SKIN.start)
        pushed[STILL, skin, skin] *= tissue.creep
        pushed[HOME] = pushed[STILL]
        home_probability = float(joint[:, HOME].sum() - joint[HOME, HOME])
        return np.asarray(np.tensordot(joint.sum(axis=0), pushed, 1) + home_probability * tissue.stationary[-1])


def palm_transition(
    rate_rad_s: FloatArray,
    motion: PalmMotion,
    dt_s: float,
    unseen: FloatArray | None = None,
    digits: DigitSpeeds = ZERO_SPEEDS,
) -> PalmTransition:
    """Return the step of ``dt_s`` of a palm that turns at ``rate_rad_s`` (3,).

    ``unseen`` (3, 3) projects on the turns in W2 that nothing showed.
    """
    return PalmTransition(*compute_palm_transition(motion, rate_rad_s, dt_s, unseen, digits))


def predict_palm(
    estimate: PalmEstimate,
    mixture: ModeMixture,
    motion: PalmMotion,
    dt_s: float,
    unseen: FloatArray | None = None,
    digits: DigitSpeeds = ZERO_SPEEDS,
) -> tuple[PalmEstimate, ModeMixture]:
    """Predict the palm ``dt_s`` ahead, its modes as errors from the nominal estimate.

    What a mode does not keep of the nominal estimate is an error of the mode.
    """
    step = palm_transition(estimate.rate_rad_s, motion, dt_s, unseen, digits)
    predicted = ModeMixture(*predict_palm_modes(mixture, step, estimate.value, step.switch))
    return step.propagate(estimate, dt_s, predicted.merge()[1][0]), predicted


def fading_factors(keep: float) -> FloatArray:
    """Return factors (n,) that leave the share ``keep`` of the velocities."""
    out = np.ones(SIZE)
    out[VELOCITY] = out[RATE] = keep
    return out


def fading_matrix(keep: float, unseen: FloatArray) -> FloatArray:
    """Return a matrix (n, n) that leaves the share ``keep`` of turning along ``unseen`` (3, 3)."""
    out = np.eye(SIZE)
    out[RATE, RATE] -= (1.0 - keep) * unseen
    return out


def find_unobserved_turns(disc_m: FloatArray) -> FloatArray | None:
    """Return the projection (3, 3) on turns that the discs do not show; None where they show all.

    Discs near one line say nothing of turning about it: what moves then is their heights over it, a few millimetres.
    ``disc_m`` (D, 3) are their places on the palm.
    """
    if len(disc_m) < 2:
        return np.eye(3)
    offset = disc_m[:, :2] - disc_m[:, :2].mean(axis=0)
    _, spread, axes = np.linalg.svd(offset, full_matrices=False)
    if spread[1] >= COLLINEAR_RMS_M * math.sqrt(len(disc_m)):
        return None
    line = np.array([axes[0, 0], axes[0, 1], 0.0])
    return np.outer(line, line)
