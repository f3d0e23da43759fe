"""The figures of the papers' filter: they give none, so each says where it is from."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, Self

from carpus.core.tracking.unscented import Spread

_MOTION = {"slow": (0.7, 0.75, 0.4), "standard": (2.0, 1.5, 1.0), "brisk": (6.0, 4.0, 2.0)}
"""eta_v, eta_omega and eta_theta of a slow, a usual and a lively hand (reference 4.5; of joints its figures for
abduction: with its larger ones for flexion the picture alone holds no finger)."""


@dataclass(frozen=True, slots=True)
class PaperSettings:
    """Noise, start and priors of the papers' filter; all of it is stored with a session.

    ``palm``: its discs laid into one plane, since the palm's arch "is not considered" (wrist paper, II-B), or taken as
    measured, to see what the rest of the method is worth.
    ``acceleration_m_s2``, ``turn_rate_rad_s`` and ``joint_rate_rad_s``: standard deviations of eta_v, eta_omega and
    eta_theta of (1) per sample at 30 pictures a second. ``pixel_sd_px`` of nu_i in (2), the same for all markers (the
    reference says 0.8 for the palm, 1.2 for fingers). ``*_start_*``: what is not known of the neutral pose.
    ``clutter_prior`` p(a = 0) of (12); what is left is shared alike by the markers. ``alpha``, ``beta``, ``kappa`` of
    the sigma points. ``lost_after_s``: without three markers of the palm for so long, the hand is lost.
    """

    acceleration_m_s2: float = 2.0
    turn_rate_rad_s: float = 1.5
    joint_rate_rad_s: float = 1.0
    pixel_sd_px: float = 1.0
    position_start_m: float = 0.003
    velocity_start_m_s: float = 0.02
    angle_start_rad: float = 0.03
    joint_start_rad: float = 0.15
    clutter_prior: float = 0.1
    alpha: float = 0.25
    beta: float = 2.0
    kappa: float = 0.0
    lost_after_s: float = 1.5
    palm: Literal["flat", "measured"] = "flat"

    @classmethod
    def for_profile(cls, name: str) -> Self:
        """The settings for a ``slow``, ``standard`` or ``brisk`` hand."""
        return cls(*_MOTION[name])

    @property
    def spread(self) -> Spread:
        return Spread(self.alpha, self.beta, self.kappa)
