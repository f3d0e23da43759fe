"""One subject's anatomy from the discs measured at the neutral pose.

The anatomical table is the prior (clinical reference 2 and 3.3); movement sharpens the result in the filter. The
neutral chain is not taken as straight: the discs of one finger stand at different heights over the bones, and a patient
may not be able to stretch a finger. Each digit is fitted on its own, the palm's discs being given.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from carpus.core.model.hand.anatomy import HandAnatomy
from carpus.core.model.hand.anatomy_prior import (
    DIGIT_DISCS,
    FLEXIONS,
    AnatomyPrior,
    DigitFit,
    DigitModel,
    Gaussian,
    angles_prior,
    average_hand,
    constants_prior,
    digit_model,
    fit_digit,
    with_constants,
)
from carpus.core.model.hand.protocols import PALM_SITES, SITES
from carpus.core.model.types import FloatArray, Side


@dataclass(frozen=True, slots=True)
class MeasuredDiscs:
    """Discs measured in F poses, in W of the hand's own side (W2 of each pose).

    ``disc_m`` (F, 21, 3), NaN when not seen; without a depth, any point on the line of sight. ``line_of_sight`` (F, 21,
    3) unit vectors; ``lateral_sd_m`` and ``depth_sd_m`` (F, 21) across and along it, infinite without a depth.
    """

    disc_m: FloatArray
    line_of_sight: FloatArray
    lateral_sd_m: FloatArray
    depth_sd_m: FloatArray

    def information_m2(self) -> FloatArray:
        """Return the inverse covariance of each disc, (F, 21, 3, 3), zero where not seen."""
        along = np.where(np.isfinite(self.line_of_sight), self.line_of_sight, 0.0)
        outer = along[..., :, None] * along[..., None, :]
        across, depth = self.lateral_sd_m[..., None, None] ** -2, self.depth_sd_m[..., None, None] ** -2
        information = across * (np.eye(3) - outer) + depth * outer
        is_seen = np.asarray(np.isfinite(self.disc_m).all(axis=-1))
        return np.where(is_seen[..., None, None], information, 0.0)


@dataclass(frozen=True, slots=True)
class AnatomyFit:
    """A subject's hand and its covariance.

    ``digits`` constants of the thumb and of fingers 2 to 5, mean (5, 11) and covariance (5, 11, 11), in the order of
    ``DIGIT_CONSTANTS``; ``neutral_digits`` angles of each digit at the neutral pose (4 or 5, zero is the straight
    chain) and ``neutral_cross`` (4 or 5, 11) their covariance with its constants; ``residual_m`` (21, 3) model minus
    measurement at the neutral pose; ``outlier_depth`` markers whose depth was left out.
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
    """Fit the hand whose discs were measured at the neutral pose (F = 1).

    The palm's discs are taken as measured. With ``skin_offsets=False`` discs are joints, as in the papers.
    ``is_straight`` (5,) or empty: what a person says of each finger.
    """
    prior = prior or AnatomyPrior()
    lateral = measured.lateral_sd_m.copy()
    if skin_offsets:
        moving = np.array(DIGIT_DISCS)
        lateral[:, moving] = np.hypot(lateral[:, moving], prior.stuck_off_m)
    measured = replace(measured, lateral_sd_m=lateral)
    without_depth = replace(measured, depth_sd_m=np.full_like(measured.depth_sd_m, np.inf))
    mirror = np.array([1.0, 1.0 if side == "right" else -1.0, 1.0])
    disc = measured.disc_m * mirror
    information, lateral_information = (
        each.information_m2() * mirror[:, None] * mirror for each in (measured, without_depth)
    )
    hand = average_hand(disc[0], side, skin_offsets)
    roots = list(PALM_SITES[1:])
    average = constants_prior(hand, prior, measured.lateral_sd_m[0, roots], measured.depth_sd_m[0, roots])
    fits: list[DigitFit] = []
    outlier_depth: list[str] = []
    residual = np.zeros((21, 3))
    for chain, own in enumerate(map(list, DIGIT_DISCS)):
        constants = Gaussian(average.mean[chain], average.covariance[chain])
        model = digit_model(hand.palm_disc_m[1 + chain], is_thumb=chain == 0)
        angles = angles_prior(chain, prior, dip_free, is_straight[chain] if is_straight else None)
        # A finger whose discs show that it is bent is not drawn towards straight.
        bent = angles_prior(chain, prior, dip_free, is_straight=False)
        measured_angles = fit_digit(model, constants, bent, disc[:, own], information[:, own]).angles
        flexions = list(FLEXIONS[min(chain, 1)])
        difference = (measured_angles.mean - angles.mean)[0, flexions]
        variance = np.diagonal((measured_angles.covariance + angles.covariance)[0])[flexions]
        if (np.abs(difference) > prior.evidently_sd * np.sqrt(variance)).any():
            angles = bent
        for i in _find_depth_outliers(
            model, constants, angles, disc[:, own], information[:, own], lateral_information[:, own], prior
        ):
            information[:, own[i]] = lateral_information[:, own[i]]
            outlier_depth.append(SITES[own[i]])
        fits.append(fit_digit(model, constants, angles, disc[:, own], information[:, own]))
        residual[own] = fits[-1].residual_m[0]
    residual[~np.isfinite(disc[0])] = np.nan
    digits = Gaussian(
        np.stack([fit.constants.mean for fit in fits]), np.stack([fit.constants.covariance for fit in fits])
    )
    return AnatomyFit(
        anatomy=with_constants(hand, digits.mean),
        digits=digits,
        neutral_digits=tuple(Gaussian(fit.angles.mean[0], fit.angles.covariance[0]) for fit in fits),
        neutral_cross=tuple(fit.cross[0] for fit in fits),
        residual_m=residual * mirror,
        outlier_depth=tuple(outlier_depth),
    )


def _find_depth_outliers(
    model: DigitModel,
    constants: Gaussian,
    angles: Gaussian,
    disc_m: FloatArray,
    information_m2: FloatArray,
    lateral_m2: FloatArray,
    prior: AnatomyPrior,
) -> list[int]:
    """Return which of the three depths of a neutral digit no likely hand explains."""
    outliers: list[int] = []
    cost = fit_digit(model, constants, angles, disc_m, information_m2).cost
    while cost > prior.absurd_cost and len(outliers) < 3:
        without = {}
        for i in set(range(3)) - set(outliers):
            lighter = information_m2.copy()
            lighter[:, [*outliers, i]] = lateral_m2[:, [*outliers, i]]
            fit = fit_digit(model, constants, angles, disc_m, lighter)
            if np.linalg.norm(fit.residual_m[0, i]) > prior.absurd_m:
                without[i] = fit.cost
        if not without:
            break
        best = min(without, key=lambda i: without[i])
        if cost - without[best] < prior.absurd_gain:
            break
        cost = without[best]
        outliers.append(best)
    return outliers
