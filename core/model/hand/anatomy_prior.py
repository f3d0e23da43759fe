"""The prior of a hand's anatomy, and one digit fitted to measured discs with it.

Means from the anatomical table (clinical reference 2 and 3.3). A digit has 11 constants and 4 angles in each pose
(thumb 5). Gauss-Newton over all of them at once, with a Gaussian prior on the constants and one on the angles of each
pose; the angles are eliminated pose by pose (Schur complement). Thumb first, then fingers 2 to 5; axes of a right hand.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from carpus.core.model.hand.anatomy import HandAnatomy, anatomy_from_size
from carpus.core.model.hand.kinematics import DIP_PER_PIP, finger_discs, thumb_discs
from carpus.core.model.hand.protocols import PALM_SITES
from carpus.core.model.types import FloatArray, Side

# Bones (PP MP DP; thumb MC1 PP1 DP1), direction in the palm, roll (thumb only), the first joint centre from the disc
# over it (MCP or CMC1; along X, along Y, downwards), heights of the three discs over their joint centres. Metres,
# radians.
DIGIT_CONSTANTS = (
    "length_1", "length_2", "length_3", "fan", "roll", "start_ahead", "start_aside", "start_depth",
    "height_1", "height_2", "height_3",
)  # fmt: skip

# Constants (..., 11) and angles (..., 4 or 5) to the digit's three discs (..., 3, 3) in W.
DigitModel = Callable[[FloatArray, FloatArray], FloatArray]

_DOWN = np.array([1.0, 1.0, -1.0])
_MAX_ITERATIONS = 30
_COST_TOLERANCE = 1e-4
_DIFFERENCE_STEP = 1e-5  # metres and radians alike


@dataclass(frozen=True, slots=True)
class Gaussian:
    """A Gaussian: ``mean`` (..., P) and ``covariance`` (..., P, P)."""

    mean: FloatArray
    covariance: FloatArray


@dataclass(frozen=True, slots=True)
class DigitFit:
    """Posterior of a digit: ``constants`` (11) and ``angles`` (F, 4 or 5).

    ``cross`` (F, 4 or 5, 11) covariance between the two; ``residual_m`` (F, 3, 3) model minus measurement in W;
    ``cost`` sum of squares in standard deviations, priors included.
    """

    constants: Gaussian
    angles: Gaussian
    cross: FloatArray
    residual_m: FloatArray
    cost: float


def digit_model(root_disc_m: FloatArray, *, is_thumb: bool) -> DigitModel:
    """Return the model of a digit whose MCP (thumb: CMC1) disc lies at ``root_disc_m`` (3,)."""

    def place_discs(constants: FloatArray, angles_rad: FloatArray) -> FloatArray:
        root_m, fan_rad, roll_rad = root_disc_m + constants[..., 5:8] * _DOWN, constants[..., 3], constants[..., 4]
        if is_thumb:
            return thumb_discs(root_m, fan_rad, roll_rad, constants[..., :3], constants[..., 8:], angles_rad)
        return finger_discs(root_m, fan_rad, constants[..., :3], constants[..., 8:], angles_rad)

    return place_discs


def fit_digit(
    model: DigitModel, constants: Gaussian, angles: Gaussian, disc_m: FloatArray, information_m2: FloatArray
) -> DigitFit:
    """Fit the constants and the angles of F poses.

    Parameters
    ----------
    model : DigitModel
        Finger or thumb.
    constants, angles : Gaussian
        The priors, (11) and (F, 4 or 5); the search starts at their means.
    disc_m : (F, 3, 3)
        Measured discs in W.
    information_m2 : (F, 3, 3, 3)
        Inverse covariances in 1/m2, zero where a disc (or its depth) is not known.
    """
    # s with S'S = information, also where it is singular
    value, vector = np.linalg.eigh(information_m2)
    problem = _Problem(
        model,
        constants.mean,
        _invert_symmetric(constants.covariance),
        angles.mean,
        _invert_symmetric(angles.covariance),
        np.where(np.isfinite(disc_m), disc_m, 0.0),
        np.asarray(np.sqrt(np.maximum(value, 0.0))[..., None] * np.swapaxes(vector, -1, -2)),
    )
    c, q = _minimise(problem, constants.mean, angles.mean)
    c_covariance, q_covariance, cross = _NormalEquations.from_problem(problem, c, q).covariances()
    residual_m = model(c, q) - problem.disc_m
    return DigitFit(Gaussian(c, c_covariance), Gaussian(q, q_covariance), cross, residual_m, problem.cost(c, q))


@dataclass(frozen=True, slots=True)
class _Problem:
    """Least squares of one digit: priors as mean and information, discs with the root of theirs."""

    model: DigitModel
    constants: FloatArray
    constants_information: FloatArray
    angles: FloatArray
    angles_information: FloatArray
    disc_m: FloatArray
    root: FloatArray

    def residual(self, c: FloatArray, q: FloatArray) -> FloatArray:
        """Return discs, model minus measured, in standard deviations, (..., F, 9)."""
        difference = (self.root @ (self.model(c[..., None, :], q) - self.disc_m)[..., None])[..., 0]
        return np.asarray(difference.reshape(*difference.shape[:-2], 9))

    def cost(self, c: FloatArray, q: FloatArray) -> float:
        """Return the sum of squares in standard deviations, priors included."""
        dc, dq = c - self.constants, q - self.angles
        prior = dc @ self.constants_information @ dc + np.einsum("fi,fij,fj", dq, self.angles_information, dq)
        return float(np.sum(self.residual(c, q) ** 2) + prior)


def _minimise(problem: _Problem, c: FloatArray, q: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Minimise the cost from constants (11,) and angles (F, m) by Levenberg-Marquardt."""
    now, damping = problem.cost(c, q), 1e-4
    normal = _NormalEquations.from_problem(problem, c, q)
    for _ in range(_MAX_ITERATIONS):
        step_c, step_q = normal.step(damping)
        after = problem.cost(c + step_c, q + step_q)
        if after > now:
            damping *= 10.0
            continue
        is_settled = now - after <= _COST_TOLERANCE * (1.0 + now)
        c, q, now, damping = c + step_c, q + step_q, after, damping * 0.1
        if is_settled:
            break
        normal = _NormalEquations.from_problem(problem, c, q)
    return c, q


@dataclass(frozen=True, slots=True)
class _NormalEquations:
    """Hessian of constants ``cc`` (11, 11), angles ``qq`` (F, m, m), mixed ``cq`` (F, 11, m); gradients."""

    cc: FloatArray
    cq: FloatArray
    qq: FloatArray
    gradient_c: FloatArray
    gradient_q: FloatArray

    @staticmethod
    def from_problem(problem: _Problem, c: FloatArray, q: FloatArray) -> _NormalEquations:
        p, m = len(c), q.shape[1]
        moves = _DIFFERENCE_STEP * np.eye(p + m)
        c_moved = np.concatenate((c + moves[:, :p], c - moves[:, :p]))
        q_moved = np.concatenate((q + moves[:, None, p:], q - moves[:, None, p:]))
        plus, minus = np.split(problem.residual(c_moved, q_moved), 2)
        slope = (plus - minus) / (2.0 * _DIFFERENCE_STEP)
        here = problem.residual(c, q)
        by_c, by_q = np.moveaxis(slope[:p], 0, -1), np.moveaxis(slope[p:], 0, -1)  # (F, 9 coordinates, p or m)
        dc, dq = c - problem.constants, q - problem.angles
        by_c_t, by_q_t = np.swapaxes(by_c, 1, 2), np.swapaxes(by_q, 1, 2)
        return _NormalEquations(
            cc=(by_c_t @ by_c).sum(axis=0) + problem.constants_information,
            cq=by_c_t @ by_q,
            qq=by_q_t @ by_q + problem.angles_information,
            gradient_c=(by_c_t @ here[..., None])[..., 0].sum(axis=0) + problem.constants_information @ dc,
            gradient_q=(by_q_t @ here[..., None] + problem.angles_information @ dq[..., None])[..., 0],
        )

    def step(self, damping: float) -> tuple[FloatArray, FloatArray]:
        """Return the Levenberg-Marquardt step of constants (11,) and angles (F, m)."""
        cc = self.cc + damping * np.diag(np.diag(self.cc))
        qq = self.qq * (1.0 + damping * np.eye(self.qq.shape[1]))
        carried = np.linalg.solve(qq, np.swapaxes(self.cq, 1, 2))  # (F, m, 11)
        drawn = np.linalg.solve(qq, self.gradient_q[..., None])[..., 0]  # (F, m)
        schur = cc - np.einsum("fij,fjk->ik", self.cq, carried)
        step_c = -np.linalg.solve(schur, self.gradient_c - np.einsum("fij,fj->i", self.cq, drawn))
        return step_c, -drawn - carried @ step_c

    def covariances(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return the posterior covariances.

        Of the constants (11, 11), of the angles of each pose (F, m, m), and between angles and constants (F, m, 11).
        """
        carried = np.linalg.solve(self.qq, np.swapaxes(self.cq, 1, 2))
        covariance = _invert_symmetric(self.cc - np.einsum("fij,fjk->ik", self.cq, carried))
        cross = -carried @ covariance
        return covariance, _invert_symmetric(self.qq) - np.asarray(cross @ np.swapaxes(carried, 1, 2)), cross


def _invert_symmetric(matrix: FloatArray) -> FloatArray:
    """Invert symmetric matrices (..., n, n), the result symmetric to the last digit."""
    inverse = np.linalg.inv(matrix)
    return np.asarray(0.5 * (inverse + np.swapaxes(inverse, -1, -2)), dtype=np.float64)


# places in ``hand21`` of the three moving discs of thumb and fingers
DIGIT_DISCS = ((2, 3, 4), (6, 7, 8), (10, 11, 12), (14, 15, 16), (18, 19, 20))
_PALM = list(PALM_SITES)
_FIXED_SD = 1e-6


@dataclass(frozen=True, slots=True)
class AnatomyPrior:
    """Standard deviations of a hand about the average one of its size.

    ``bone_share`` of a bone's length, for which the reference's two tables lie 7 to 15 % apart; ``last_bone_share`` of
    the last one, which ends under a disc whose place on the nail varies; ``thumb_roll_rad`` of an estimate that other
    sources put 20 degrees off; ``height_scale`` common to all offsets of a digit, besides the scatter of each in the
    table; ``finger_start_m`` and ``thumb_start_m``, along X and Y, of the first joint centre (MCP, CMC1) from the place
    under its disc: people stick a disc up to 5 mm off its place, that of CMC1 anywhere on the slope over it.

    ``depth_bias_sd_m``: constant error of a disc's depth over a recording. To the camera it is height, at the neutral
    pose and after, so it is part of what is not known of the heights. ``stuck_off_m``: how far a disc on a finger is
    stuck beside the middle of its joint. ``finger_depth_m`` of each disc's height over its joint centre by itself (MCP,
    PIP, DIP, TIP), ``thumb_depth_m`` (CMC1, MCP1, IP1, TIP1): with ``height_scale`` somewhat more than a quarter of the
    ranges of reference 2, as hands after an injury are swollen; of the thumb half, as it shows a camera above its side,
    where skin slopes.

    ``neutral_*`` of the angles at the neutral pose, about a hand that lies relaxed: joints bent by
    ``relaxed_flexion_rad``, the thumb a little out, ``relaxed_thumb_rad`` CMC extension and abduction.
    ``straight_rad``: how straight a finger lies of which a person says that it does, each joint by itself;
    ``straight_thumb_rad`` a thumb, which nobody aligns. ``bent_rad``: flexion of a finger that cannot be straightened,
    or whose discs lie ``evidently_sd`` standard deviations from where a straight one's would. ``dip_free_rad``: how far
    DIP flexion is from 2/3 of PIP flexion; ``dip_slack_rad`` where it should follow it.

    A neutral digit that costs more than ``absurd_cost`` (sum of squares in standard deviations) may have an outlier of
    depth: one that lies farther than ``absurd_m`` from where the others say, and that costs ``absurd_gain``. Less than
    that is flesh, or a disc stuck askew.
    """

    bone_share: float = 0.09
    last_bone_share: float = 0.20
    fan_rad: float = math.radians(2.5)
    thumb_fan_rad: float = math.radians(5.0)
    thumb_roll_rad: float = math.radians(12.0)
    height_scale: float = 0.1
    finger_depth_m: tuple[float, ...] = (0.0015, 0.0007, 0.0005, 0.0004)
    thumb_depth_m: tuple[float, ...] = (0.0035, 0.0015, 0.0010, 0.0010)
    finger_start_m: tuple[float, ...] = (0.0025, 0.0020)
    thumb_start_m: tuple[float, ...] = (0.0030, 0.0040)
    depth_bias_sd_m: float = 0.0004
    stuck_off_m: float = 0.0006
    neutral_abduction_rad: float = math.radians(2.2)
    neutral_flexion_rad: float = math.radians(4.5)
    neutral_thumb_rad: float = math.radians(5.0)
    relaxed_flexion_rad: float = math.radians(4.0)
    relaxed_thumb_rad: tuple[float, ...] = (math.radians(10.0), math.radians(9.0))
    straight_rad: float = math.radians(3.0)
    straight_thumb_rad: float = math.radians(6.0)
    bent_rad: float = math.radians(20.0)
    evidently_sd: float = 3.5
    dip_free_rad: float = math.radians(10.0)
    dip_slack_rad: float = math.radians(4.0)
    absurd_m: float = 0.008
    absurd_cost: float = 30.0
    absurd_gain: float = 12.0


def average_hand(disc_m: FloatArray, side: Side, skin_offsets: bool) -> HandAnatomy:
    """Return the average hand of the size seen, with the palm discs of ``disc_m`` (21, 3) in W."""
    unit = anatomy_from_size(1.0, 1.0, arch=0.0, skin_offsets=False)
    palm = disc_m[_PALM]
    flat = disc_m[..., :2]
    ratios = list(palm[2:, 0] / unit.palm_disc_m[2:, 0])
    for own, bones in zip(DIGIT_DISCS[1:], unit.finger_length_m, strict=True):
        places = flat[[own[0] - 1, *own[:2]]]
        ratios += list(np.linalg.norm(np.diff(places, axis=0), axis=-1) / bones[:2])
    length_m = float(np.nanmedian(ratios))
    lateral = unit.palm_disc_m[:, 1]
    breadth_m = float(lateral @ palm[:, 1] / (lateral @ lateral))
    average = anatomy_from_size(length_m, breadth_m, side=side, skin_offsets=skin_offsets)
    half_nail = anatomy_from_size(length_m, breadth_m, nail_discs=True)
    return replace(
        average,
        palm_disc_m=palm,
        palm_joint_m=palm - np.outer(average.skin_offset_m[_PALM], [0.0, 0.0, 1.0]),
        finger_length_m=0.5 * (average.finger_length_m + half_nail.finger_length_m),
        thumb_length_m=0.5 * (average.thumb_length_m + half_nail.thumb_length_m),
    )


def constants_prior(
    average: HandAnatomy, prior: AnatomyPrior, lateral_sd_m: FloatArray, depth_sd_m: FloatArray
) -> Gaussian:
    """Return the prior (5, 11) of the digits' constants, with the scatter between people.

    ``lateral_sd_m`` and ``depth_sd_m`` (5,) tell how well the discs CMC1 and MCP2 to MCP5, from which the digits start,
    were measured: an error there stays in the joint centres below them.
    """
    mean, covariance = constants_from_anatomy(average), np.zeros((5, 11, 11))
    shares = np.array([prior.bone_share, prior.bone_share, prior.last_bone_share])
    has_offsets = bool(np.any(average.skin_offset_m))
    for chain in range(5):
        sd = np.full(11, _FIXED_SD)
        sd[:3] = shares * mean[chain, :3]
        sd[3] = prior.fan_rad if chain else prior.thumb_fan_rad
        if not chain:
            sd[4] = prior.thumb_roll_rad
        # A disc of the thumb is turned away from a camera above by the thumb's roll.
        stays_m = prior.depth_bias_sd_m * np.array([1.0, *(3 * [1.0 if chain else math.cos(mean[0, 4])])])
        sd[7:] = np.maximum(stays_m, _FIXED_SD)
        heights = np.zeros(11)
        if has_offsets:
            sd[5:7] = np.hypot(prior.finger_start_m if chain else prior.thumb_start_m, lateral_sd_m[chain])
            sd[7:] = np.hypot(prior.finger_depth_m if chain else prior.thumb_depth_m, stays_m)
            heights[7:] = mean[chain, 7:]
        sd[7] = math.hypot(sd[7], depth_sd_m[chain])
        covariance[chain] = np.diag(sd**2) + prior.height_scale**2 * np.outer(heights, heights)
    return Gaussian(mean, covariance)


def constants_from_anatomy(hand: HandAnatomy) -> FloatArray:
    """Return the constants (5, 11) of a hand's digits, in the order of ``DIGIT_CONSTANTS``."""
    constants = np.zeros((5, 11))
    constants[:, :3] = np.vstack((hand.thumb_length_m, hand.finger_length_m))
    constants[:, 3] = hand.fan_rad
    constants[0, 4] = hand.thumb_roll_rad
    constants[:, 5:8] = (hand.palm_joint_m[1:] - hand.palm_disc_m[1:]) * _DOWN
    constants[:, 8:] = np.vstack((hand.thumb_offset_m, hand.finger_offset_m))
    return constants


def with_constants(hand: HandAnatomy, constants: FloatArray) -> HandAnatomy:
    """Return the hand with these constants (5, 11) of its digits."""
    joints = hand.palm_joint_m.copy()
    joints[1:] = hand.palm_disc_m[1:] + constants[:, 5:8] * _DOWN
    return replace(
        hand,
        palm_joint_m=joints,
        fan_rad=constants[:, 3],
        thumb_roll_rad=float(constants[0, 4]),
        thumb_length_m=constants[0, :3],
        finger_length_m=constants[1:, :3],
        thumb_offset_m=constants[0, 8:],
        finger_offset_m=constants[1:, 8:],
    )


# Columns of the flexions of the thumb, and of a finger (whose DIP follows), that are zero when it is straight.
FLEXIONS = ((2, 4), (1, 2))


def angles_prior(chain: int, prior: AnatomyPrior, dip_free: bool, is_straight: bool | None = None) -> Gaussian:
    """Return the prior (1, 4 or 5) of a digit's angles at the neutral pose.

    A relaxed hand on average; ``is_straight`` is what a person said of the finger, None for nothing.
    """
    bent = prior.relaxed_flexion_rad
    if chain == 0:
        sd = np.full(5, prior.neutral_thumb_rad)
        sd[3] = 0.5 * prior.neutral_thumb_rad
        mean = np.array([*prior.relaxed_thumb_rad, bent, 0.0, bent])
    else:
        sd = np.full(4, prior.neutral_flexion_rad)
        sd[0] = prior.neutral_abduction_rad
        mean = np.array([0.0, bent, bent, 0.0])
    flexions = list(FLEXIONS[min(chain, 1)])
    if is_straight is not None:
        if is_straight:
            straight = prior.straight_rad if chain else prior.straight_thumb_rad
            share = sd[flexions] ** 2 / (sd[flexions] ** 2 + straight**2)
            mean[flexions] *= 1.0 - share
            sd[flexions] = np.sqrt(share) * straight
        else:
            sd[flexions] = np.hypot(sd[flexions], prior.bent_rad)
    if chain == 0:
        return Gaussian(mean[None], np.diag(sd**2)[None])
    mean[3] = DIP_PER_PIP * mean[2]
    sd[3] = prior.dip_free_rad if dip_free else prior.dip_slack_rad
    follow = np.eye(4)  # DIP is 2/3 PIP give or take
    follow[3, 2] = DIP_PER_PIP
    return Gaussian(mean[None], (follow @ np.diag(sd**2) @ follow.T)[None])
