"""How the palm may move between two frames: constant velocities, pushed by white accelerations.

Noise is given as the papers' standard deviation per sample at 30 pictures a second and used as a continuous density
q = sd^2 / 30, so that other or missing frame times keep their meaning (clinical reference 4.5). The acceleration acts
all along the step: Q holds q dt^3 / 3, q dt^2 / 2 and q dt.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from carpus.core.compiled.palm import compute_mode_transition, compute_palm_transition
from carpus.core.model.types import FloatArray
from carpus.core.tracking.filter.mixture_filter import ModeMixture, Transition, propagate_mixture
from carpus.core.tracking.filter.palm_state import POSITION, RATE, SIZE, SKIN, TURN, VELOCITY, PalmEstimate
from carpus.core.tracking.filter.soft_tissue import HOME, STILL, ZERO_SPEEDS, DigitSpeeds, TissueModes

REFERENCE_DT_S = 1.0 / 30.0


MODE_DWELL_S = 0.5
"""So long a motion mode is kept."""
RATE_MEMORY_S = 0.2
"""So long an unseen hand is taken to go on as it moved."""


@dataclass(frozen=True, slots=True)
class MotionNoise:
    """Standard deviations per sample at 30 Hz: ``acceleration_m_s2`` of the wrist (eta_v of the papers),
    ``turn_acceleration_rad_s2`` of its turning, ``joint_acceleration_rad_s2`` of the fingers."""

    acceleration_m_s2: float = 2.0
    turn_acceleration_rad_s2: float = 8.0
    joint_acceleration_rad_s2: float = 12.0

    @property
    def push(self) -> float:
        """Density q of the wrist's acceleration, m^2/s^3."""
        return self.acceleration_m_s2**2 * REFERENCE_DT_S

    @property
    def turning(self) -> float:
        """Density q of its angular acceleration, rad^2/s^3."""
        return self.turn_acceleration_rad_s2**2 * REFERENCE_DT_S


@dataclass(frozen=True, slots=True)
class PalmTransition(Transition):
    """A step of the palm, and the turn (3, 3) that the rate makes of it."""

    rotation_increment: FloatArray

    def propagate(self, estimate: PalmEstimate, dt_s: float, covariance: FloatArray | None = None) -> PalmEstimate:
        """The nominal estimate after the step, its covariance left as it is, or the one given."""
        value = estimate.value.copy()
        value[POSITION] += estimate.velocity_m_s * dt_s
        value[TURN] = 0.0
        covariance = estimate.covariance if covariance is None else covariance
        return PalmEstimate(estimate.rotation_w2_w0 @ self.rotation_increment, value, covariance)


@dataclass(frozen=True, slots=True)
class PalmMotion:
    """What pushes one palm: ``noise`` of its motion, whose root the modes multiply by ``scales`` (M,), and what its
    soft ``tissue`` does. Motions last ``dwell_s``. Resting tissue is combined with every motion; while it moves the
    hand is taken to move calmly, ``moving_scale``: else a moving hand explains what tissue does, and the other way.
    ``unseen_scale`` is the factor for turns that nothing in the picture shows: how briskly a hand
    moves is told by what is seen of it, and says nothing of these."""

    noise: MotionNoise
    tissue: TissueModes
    scales: FloatArray
    unseen_scale: float = 3.0
    dwell_s: float = MODE_DWELL_S
    moving_scale: float = 0.5

    scale_of: FloatArray = field(init=False, repr=False, compare=False)
    tissue_of: NDArray[np.int64] = field(init=False, repr=False, compare=False)
    """Of each of the K modes (K,), those at rest first: the factor on the motion's noise, and the tissue's mode."""

    def __post_init__(self) -> None:
        resting, count = self.tissue.resting, self.tissue.count
        scale = [*np.repeat(self.scales, resting), *(self.moving_scale for _ in range(resting, count))]
        object.__setattr__(self, "scale_of", np.array(scale, dtype=np.float64))
        tissue = [*np.tile(np.arange(resting), self.scales.size), *range(resting, count)]
        object.__setattr__(self, "tissue_of", np.array(tissue))

    @property
    def modes(self) -> int:
        return self.scale_of.size

    def mode_transition_matrix(
        self, rate_rad_s: FloatArray, dt_s: float, digits: DigitSpeeds = ZERO_SPEEDS
    ) -> FloatArray:
        """Probability (K, K) to go from row to column mode in ``dt_s``, of a hand that turns at ``rate_rad_s`` (3,)."""
        return compute_mode_transition(self, rate_rad_s, dt_s, digits)

    @property
    def initial_probability(self) -> FloatArray:
        """Probability (K,) of the modes of a hand just calibrated."""
        out: FloatArray = self.tissue.initial_probability[self.tissue_of]
        out[: self.scales.size * self.tissue.resting] /= self.scales.size
        return out

    def tissue_noise(self, mode_transitions: FloatArray, step: PalmTransition) -> FloatArray:
        """What pushes the tissue (r, r) in a step that went from row to column mode with these probabilities (K, K),
        seen as one that keeps all it has: coming home is a push as well."""
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
        came_home = float(joint[:, HOME].sum() - joint[HOME, HOME])
        return np.asarray(np.tensordot(joint.sum(axis=0), pushed, 1) + came_home * tissue.stationary[-1])


def palm_transition(
    rate_rad_s: FloatArray,
    motion: PalmMotion,
    dt_s: float,
    unseen: FloatArray | None = None,
    digits: DigitSpeeds = ZERO_SPEEDS,
) -> PalmTransition:
    """The step of ``dt_s`` of a palm that turns at ``rate_rad_s`` (3,) while its ``digits`` move; ``unseen`` (3, 3)
    projects on the turns in W2 that nothing showed."""
    return PalmTransition(*compute_palm_transition(motion, rate_rad_s, dt_s, unseen, digits))


def predict_palm(
    estimate: PalmEstimate,
    mixture: ModeMixture,
    motion: PalmMotion,
    dt_s: float,
    unseen: FloatArray | None = None,
    digits: DigitSpeeds = ZERO_SPEEDS,
) -> tuple[PalmEstimate, ModeMixture]:
    """The palm ``dt_s`` later, its modes as errors from the nominal estimate, whose covariance is that of them all."""
    step = palm_transition(estimate.rate_rad_s, motion, dt_s, unseen, digits)
    later = propagate_mixture(
        mixture, step, estimate.value, motion.mode_transition_matrix(estimate.rate_rad_s, dt_s, digits)
    )
    return step.propagate(estimate, dt_s, later.merge()[1][0]), later


def fading_factors(keep: float) -> FloatArray:
    """Factors (n,) that leave the share ``keep`` of the velocities and all else as it is."""
    out = np.ones(SIZE)
    out[VELOCITY] = out[RATE] = keep
    return out


def fading_matrix(keep: float, unseen: FloatArray) -> FloatArray:
    """A matrix (n, n) that leaves the share ``keep`` of the turning along ``unseen`` (3, 3) and all else as it is."""
    out = np.eye(SIZE)
    out[RATE, RATE] -= (1.0 - keep) * unseen
    return out


def find_unobserved_turns(disc_m: FloatArray, collinear_rms_m: float) -> FloatArray | None:
    """Which turns (3, 3, a projection) discs at ``disc_m`` (D, 3) on the palm do not show; None where they show all.

    Discs near one line say nothing of turning about it: what moves then is their heights over it, a few millimetres.
    """
    if len(disc_m) < 2:
        return np.eye(3)
    apart = disc_m[:, :2] - disc_m[:, :2].mean(axis=0)
    _, spread, axes = np.linalg.svd(apart, full_matrices=False)
    if spread[1] >= collinear_rms_m * math.sqrt(len(disc_m)):
        return None
    line = np.array([axes[0, 0], axes[0, 1], 0.0])
    return np.outer(line, line)
