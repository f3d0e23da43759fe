"""Fit one digit (thumb or long finger) of the hand model to measured discs by regularised least squares.

A digit has 11 constants and 4 angles in each pose (thumb 5). Gauss-Newton over all of them at once, with a Gaussian
prior on the constants and one on the angles of each pose; the angles are eliminated pose by pose (Schur complement).
All in axes of a right hand.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from carpus.core.hand.kinematics import finger_discs, thumb_discs
from carpus.core.types import FloatArray

DIGIT_CONSTANTS = (
    "length_1", "length_2", "length_3", "fan", "roll", "start_ahead", "start_aside", "start_depth",
    "height_1", "height_2", "height_3",
)  # fmt: skip
"""Bones (PP MP DP; thumb MC1 PP1 DP1), direction in the palm, roll (thumb only), the first joint centre from the disc
over it (MCP or CMC1; along X, along Y, downwards), heights of the three discs over their joint centres. Metres, rad."""

DigitModel = Callable[[FloatArray, FloatArray], FloatArray]
"""Constants (..., 11) and angles (..., 4 or 5) to the digit's three discs (..., 3, 3) in W."""

_DOWN = np.array([1.0, 1.0, -1.0])
_MOST_STEPS = 30
_SETTLED = 1e-4
_DIFFERENCE_STEP = 1e-5  # metres and radians alike


@dataclass(frozen=True, slots=True)
class Gaussian:
    """What is known of some numbers: ``mean`` (..., P) and ``covariance`` (..., P, P)."""

    mean: FloatArray
    covariance: FloatArray


@dataclass(frozen=True, slots=True)
class DigitFit:
    """Result: ``constants`` (11) and ``angles`` (F, 4 or 5) a posteriori, ``cross`` (F, 4 or 5, 11) the covariance
    between the two; ``residual_m`` (F, 3, 3) model minus measurement in W; ``cost`` sum of squares in standard
    deviations, priors included."""

    constants: Gaussian
    angles: Gaussian
    cross: FloatArray
    residual_m: FloatArray
    cost: float


def finger_model(mcp_disc_m: FloatArray) -> DigitModel:
    """Model of a long finger whose MCP disc lies there (3,)."""

    def discs(constants: FloatArray, angles_rad: FloatArray) -> FloatArray:
        knuckle = mcp_disc_m + constants[..., 5:8] * _DOWN
        return finger_discs(knuckle, constants[..., 3], constants[..., :3], constants[..., 8:], angles_rad)

    return discs


def thumb_model(cmc_disc_m: FloatArray) -> DigitModel:
    """Model of a thumb whose CMC1 disc lies there (3,)."""

    def discs(constants: FloatArray, angles_rad: FloatArray) -> FloatArray:
        cmc = cmc_disc_m + constants[..., 5:8] * _DOWN
        return thumb_discs(
            cmc, constants[..., 3], constants[..., 4], constants[..., :3], constants[..., 8:], angles_rad
        )

    return discs


def fit_digit(
    model: DigitModel, constants: Gaussian, angles: Gaussian, disc_m: FloatArray, information_m2: FloatArray
) -> DigitFit:
    """Fit the constants and the angles of F poses.

    ``constants`` and ``angles`` are the priors, (11) and (F, 4 or 5); the search starts at their means.
    ``disc_m`` (F, 3, 3) measured discs in W, ``information_m2`` (F, 3, 3, 3) inverse covariances in 1/m2, zero where
    a disc (or its depth) is not known.
    """
    problem = _Problem(
        model, constants.mean, _inverse(constants.covariance), angles.mean, _inverse(angles.covariance),
        np.where(np.isfinite(disc_m), disc_m, 0.0), _square_root(information_m2),
    )  # fmt: skip
    c, q = _minimum(problem, constants.mean, angles.mean)
    c_covariance, q_covariance, cross = _NormalEquations.at(problem, c, q).covariances()
    residual_m = model(c, q) - problem.disc_m
    return DigitFit(Gaussian(c, c_covariance), Gaussian(q, q_covariance), cross, residual_m, problem.cost(c, q))


@dataclass(frozen=True, slots=True)
class _Problem:
    """Least squares of one digit: priors as mean and information, discs with the root of their information."""

    model: DigitModel
    constants: FloatArray
    constants_information: FloatArray
    angles: FloatArray
    angles_information: FloatArray
    disc_m: FloatArray
    root: FloatArray

    def residual(self, c: FloatArray, q: FloatArray) -> FloatArray:
        """Discs, model minus measured, in standard deviations, (..., F, 9)."""
        off = (self.root @ (self.model(c[..., None, :], q) - self.disc_m)[..., None])[..., 0]
        return np.asarray(off.reshape(*off.shape[:-2], 9))

    def cost(self, c: FloatArray, q: FloatArray) -> float:
        """Sum of squares in standard deviations, priors included."""
        dc, dq = c - self.constants, q - self.angles
        prior = dc @ self.constants_information @ dc + np.einsum("fi,fij,fj", dq, self.angles_information, dq)
        return float(np.sum(self.residual(c, q) ** 2) + prior)


def _minimum(problem: _Problem, c: FloatArray, q: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Levenberg-Marquardt from constants (11,) and angles (F, m)."""
    now, damping = problem.cost(c, q), 1e-4
    normal = _NormalEquations.at(problem, c, q)
    for _ in range(_MOST_STEPS):
        step_c, step_q = normal.step(damping)
        after = problem.cost(c + step_c, q + step_q)
        if after > now:
            damping *= 10.0
            continue
        is_settled = now - after <= _SETTLED * (1.0 + now)
        c, q, now, damping = c + step_c, q + step_q, after, damping * 0.1
        if is_settled:
            break
        normal = _NormalEquations.at(problem, c, q)
    return c, q


@dataclass(frozen=True, slots=True)
class _NormalEquations:
    """Hessian: constants ``cc`` (11, 11), angles ``qq`` (F, m, m), between them ``cq`` (F, 11, m); and gradients."""

    cc: FloatArray
    cq: FloatArray
    qq: FloatArray
    gradient_c: FloatArray
    gradient_q: FloatArray

    @staticmethod
    def at(problem: _Problem, c: FloatArray, q: FloatArray) -> _NormalEquations:
        p, m = len(c), q.shape[1]
        moves = _DIFFERENCE_STEP * np.eye(p + m)
        c_moved = np.concatenate((c + moves[:, :p], c - moves[:, :p]))
        q_moved = np.concatenate((q + moves[:, None, p:], q - moves[:, None, p:]))
        ahead, back = np.split(problem.residual(c_moved, q_moved), 2)
        slope = (ahead - back) / (2.0 * _DIFFERENCE_STEP)
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
        """Levenberg-Marquardt step of constants (11,) and angles (F, m)."""
        cc = self.cc + damping * np.diag(np.diag(self.cc))
        qq = self.qq * (1.0 + damping * np.eye(self.qq.shape[1]))
        carried = np.linalg.solve(qq, np.swapaxes(self.cq, 1, 2))  # (F, m, 11)
        drawn = np.linalg.solve(qq, self.gradient_q[..., None])[..., 0]  # (F, m)
        schur = cc - np.einsum("fij,fjk->ik", self.cq, carried)
        step_c = -np.linalg.solve(schur, self.gradient_c - np.einsum("fij,fj->i", self.cq, drawn))
        return step_c, -drawn - carried @ step_c

    def covariances(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Posterior covariances of the constants (11, 11), of the angles of each pose (F, m, m), and between the
        angles and the constants (F, m, 11)."""
        carried = np.linalg.solve(self.qq, np.swapaxes(self.cq, 1, 2))
        covariance = _inverse(self.cc - np.einsum("fij,fjk->ik", self.cq, carried))
        cross = -carried @ covariance
        return covariance, _inverse(self.qq) - np.asarray(cross @ np.swapaxes(carried, 1, 2)), cross


def _inverse(matrix: FloatArray) -> FloatArray:
    """Inverse of symmetric matrices (..., n, n), symmetric to the last digit."""
    inverse = np.linalg.inv(matrix)
    return np.asarray(0.5 * (inverse + np.swapaxes(inverse, -1, -2)), dtype=np.float64)


def _square_root(information: FloatArray) -> FloatArray:
    """S with S'S = information, also where it is singular."""
    value, vector = np.linalg.eigh(information)
    return np.asarray(np.sqrt(np.maximum(value, 0.0))[..., None] * np.swapaxes(vector, -1, -2))
