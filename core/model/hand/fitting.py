"""One subject's anatomy from the discs measured at the neutral pose; movement sharpens it in the filter.

The anatomical table is the prior (clinical reference 2 and 3.3). The neutral chain is not taken as straight: the
discs of one finger stand at different heights over the bones, and a patient may not be able to stretch a finger.
Each digit is fitted on its own, the palm's discs being given.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from carpus.core.model.hand.anatomy import HandAnatomy
from carpus.core.model.hand.anatomy_prior import (
    DIGIT_DISCS,
    FLEXIONS,
    AnatomyPrior,
    DigitModel,
    Gaussian,
    angles_prior,
    average_hand,
    constants_prior,
    finger_model,
    fit_digit,
    thumb_model,
    with_constants,
)
from carpus.core.model.hand.protocols import PALM_SITES, SITES
from carpus.core.model.types import FloatArray, Side


@dataclass(frozen=True, slots=True)
class MeasuredDiscs:
    """Discs measured in F poses, in W of the hand's own side (W2 of each pose).

    ``disc_m`` (F, 21, 3), NaN when not seen; without a depth, any point on the line of sight. ``line_of_sight`` (F,
    21, 3)
    unit line of sight; ``lateral_sd_m`` and ``depth_sd_m`` (F, 21) across and along it, infinite without a depth.
    """

    disc_m: FloatArray
    line_of_sight: FloatArray
    lateral_sd_m: FloatArray
    depth_sd_m: FloatArray

    def information_m2(self) -> FloatArray:
        """Inverse covariance of each disc, (F, 21, 3, 3), zero where not seen."""
        along = np.where(np.isfinite(self.line_of_sight), self.line_of_sight, 0.0)
        outer = along[..., :, None] * along[..., None, :]
        across, depth = self.lateral_sd_m[..., None, None] ** -2, self.depth_sd_m[..., None, None] ** -2
        information = across * (np.eye(3) - outer) + depth * outer
        is_seen = np.asarray(np.isfinite(self.disc_m).all(axis=-1))
        return np.where(is_seen[..., None, None], information, 0.0)


@dataclass(frozen=True, slots=True)
class AnatomyFit:
    """A subject's hand and how well it is known.

    ``digits`` constants of the thumb and of fingers 2 to 5, mean (5, 11) and covariance (5, 11, 11), in the order of
    ``DIGIT_CONSTANTS``; ``neutral_digits`` angles of each digit at the neutral pose (4 or 5, zero is the straight
    chain) and ``neutral_cross`` (4 or 5, 11) how they err together with its constants; ``residual_m`` (21, 3) model
    minus measurement at the neutral pose; ``outlier_depth`` markers whose depth was left out.
    """

    anatomy: HandAnatomy
    digits: Gaussian
    neutral_digits: tuple[Gaussian, ...]
    neutral_cross: tuple[FloatArray, ...]
    residual_m: FloatArray
    outlier_depth: tuple[str, ...]


def fit_anatomy(
    measured: MeasuredDiscs,
    side: Side,
    *,
    dip_free: bool = False,
    skin_offsets: bool = True,
    prior: AnatomyPrior | None = None,
    is_straight: tuple[bool, ...] = (),
) -> AnatomyFit:
    """The hand whose discs were measured at the neutral pose (F = 1); the palm's discs are taken as measured.

    With ``skin_offsets=False`` discs are joints, as in the papers. ``is_straight`` (5,) or empty: what a person says of
    each finger.
    """
    prior = prior or AnatomyPrior()
    lateral = measured.lateral_sd_m.copy()
    if skin_offsets:
        moving = np.array(DIGIT_DISCS)
        lateral[:, moving] = np.hypot(lateral[:, moving], prior.stuck_off_m)
    measured = replace(measured, lateral_sd_m=lateral)
    disc, information = _right_handed(measured, side)
    blind = replace(measured, depth_sd_m=np.full_like(measured.depth_sd_m, np.inf))
    across = _right_handed(blind, side)[1]
    average = average_hand(disc[0], side, skin_offsets)
    starts = list(PALM_SITES[1:])
    digits = constants_prior(average, prior, measured.lateral_sd_m[0, starts], measured.depth_sd_m[0, starts])
    absurd: list[str] = []
    neutral: list[Gaussian] = []
    for chain, discs in enumerate(DIGIT_DISCS):
        own = list(discs)
        known = Gaussian(digits.mean[chain], digits.covariance[chain])
        model = _digit_model(average, chain)
        is_chain_straight = is_straight[chain] if is_straight else None
        angles = _choose_angles_prior(
            model, known, chain, prior, dip_free, is_chain_straight, disc[:, own], information[:, own]
        )
        neutral.append(angles)
        for i in _find_depth_outliers(model, known, angles, disc[:, own], information[:, own], across[:, own], prior):
            information[:, own[i]] = across[:, own[i]]
            absurd.append(SITES[own[i]])
    return _fit_digits(average, digits, neutral, disc, information, tuple(absurd))


def _choose_angles_prior(
    model: DigitModel,
    known: Gaussian,
    chain: int,
    prior: AnatomyPrior,
    dip_free: bool,
    is_straight: bool | None,
    disc_m: FloatArray,
    information_m2: FloatArray,
) -> Gaussian:
    """What is expected of a digit's angles at the neutral pose, unless its discs show a finger that is bent: then it is
    not drawn towards straight."""
    expected = angles_prior(chain, prior, dip_free, is_straight)
    bent = angles_prior(chain, prior, dip_free, is_straight=False)
    shown = fit_digit(model, known, bent, disc_m, information_m2).angles
    flexions = list(FLEXIONS[min(chain, 1)])
    off = (shown.mean - expected.mean)[0, flexions]
    variance = np.diagonal((shown.covariance + expected.covariance)[0])[flexions]
    return bent if (np.abs(off) > prior.evidently_sd * np.sqrt(variance)).any() else expected


def _fit_digits(
    hand: HandAnatomy,
    average: Gaussian,
    neutral: list[Gaussian],
    disc_m: FloatArray,
    information_m2: FloatArray,
    absurd_depth: tuple[str, ...],
) -> AnatomyFit:
    """Fit each digit to the neutral pose, discs (1, 21, 3) in axes of a right hand; ``average`` constants (5, 11);
    ``neutral`` angles expected of each."""
    fits = []
    for chain, discs in enumerate(DIGIT_DISCS):
        own = list(discs)
        known = Gaussian(average.mean[chain], average.covariance[chain])
        fits.append(fit_digit(_digit_model(hand, chain), known, neutral[chain], disc_m[:, own], information_m2[:, own]))
    digits = Gaussian(
        np.stack([fit.constants.mean for fit in fits]), np.stack([fit.constants.covariance for fit in fits])
    )
    residual = np.zeros((21, 3))
    for discs, fit in zip(DIGIT_DISCS, fits, strict=True):
        residual[list(discs)] = fit.residual_m[0]
    residual[~np.isfinite(disc_m[0])] = np.nan
    return AnatomyFit(
        anatomy=with_constants(hand, digits.mean),
        digits=digits,
        neutral_digits=tuple(Gaussian(fit.angles.mean[0], fit.angles.covariance[0]) for fit in fits),
        neutral_cross=tuple(fit.cross[0] for fit in fits),
        residual_m=residual * _mirror(hand.side),
        outlier_depth=absurd_depth,
    )


def _mirror(side: Side) -> FloatArray:
    return np.array([1.0, 1.0 if side == "right" else -1.0, 1.0])


def _right_handed(seen: MeasuredDiscs, side: Side) -> tuple[FloatArray, FloatArray]:
    """Discs (F, 21, 3) and their information (F, 21, 3, 3) in axes of a right hand."""
    mirror = _mirror(side)
    return seen.disc_m * mirror, seen.information_m2() * mirror[:, None] * mirror


def _digit_model(hand: HandAnatomy, chain: int) -> DigitModel:
    disc = hand.palm_disc_m[1 + chain]
    return finger_model(disc) if chain else thumb_model(disc)


def _find_depth_outliers(
    model: DigitModel,
    constants: Gaussian,
    angles: Gaussian,
    disc_m: FloatArray,
    information_m2: FloatArray,
    across_m2: FloatArray,
    prior: AnatomyPrior,
) -> list[int]:
    """Which of the three depths of a neutral digit no likely hand explains."""
    absurd: list[int] = []
    cost = fit_digit(model, constants, angles, disc_m, information_m2).cost
    while cost > prior.absurd_cost and len(absurd) < 3:
        without = {}
        for i in set(range(3)) - set(absurd):
            lighter = information_m2.copy()
            lighter[:, [*absurd, i]] = across_m2[:, [*absurd, i]]
            fit = fit_digit(model, constants, angles, disc_m, lighter)
            if np.linalg.norm(fit.residual_m[0, i]) > prior.absurd_m:
                without[i] = fit.cost
        if not without:
            break
        best = min(without, key=lambda i: without[i])
        if cost - without[best] < prior.absurd_gain:
            break
        cost = without[best]
        absurd.append(best)
    return absurd
