"""Texts of a camera's last check, and of a check in progress."""

from __future__ import annotations

import math
from dataclasses import dataclass
from datetime import datetime
from typing import TYPE_CHECKING

from carpus.core.calibration.card.card import verdict_sentence
from carpus.core.model.types import FloatArray
from carpus.ui.kit import numbers
from carpus.ui.kit.icons import State
from carpus.ui.kit.translate import tr, translate_phrase

if TYPE_CHECKING:  # a window loads nothing that reads files
    from carpus.core.calibration.card.checks import CheckStatus


def check_words(status: CheckStatus) -> tuple[State, str]:
    """Return state and text of the last check, with the next step."""
    check = status.last_check
    if check is None:
        return "open", tr("This camera has not been checked yet.")
    day = numbers.format_date_time(datetime.fromisoformat(check.checked_at))
    words = tr("{verdict} Checked {day}.").format(verdict=translate_phrase(verdict_sentence(check.reading)), day=day)
    if status.is_recalibrated:
        return "warn", f"{words} {tr('Check the camera again: it has been calibrated since the last check.')}"
    if status.is_out_of_tolerance:
        next_step = tr(
            "Check the camera once more, then calibrate it. If it is still out of tolerance, do not measure with it."
        )
        return "bad", f"{words} {next_step}"
    if status.is_due:
        return "warn", f"{words} {tr('Check the camera again: a check is due once a week.')}"
    return "good", words


def camera_words(status: CheckStatus) -> tuple[State, str]:
    """Return state and text of a camera for the settings."""
    if not status.serial:
        return "open", tr("Not calibrated and not checked yet.")
    calibrated = tr("never calibrated")
    if math.isfinite(status.calibration_age_days):
        days = int(status.calibration_age_days)
        ago = {0: tr("today"), 1: tr("yesterday")}.get(days, tr("{days} days ago").format(days=days))
        calibrated = tr("calibrated {ago}").format(ago=ago)
    state, words = check_words(status)
    return state, tr("Camera {serial}: {calibrated}. {words}").format(
        serial=status.serial, calibrated=calibrated, words=words
    )


@dataclass(frozen=True, slots=True)
class CardProgress:
    """Progress of a check.

    Parameters
    ----------
    disc_px
            Pixels of the discs (6, 2), None until all are visible.
    disc_count
            Number of blue discs.
    seconds
            Duration of steady frames.
    has_moved
            True if the card moved and the check started again.
    """

    disc_px: FloatArray | None
    disc_count: int
    seconds: float
    has_moved: bool = False


def card_hint(progress: CardProgress | None) -> str:
    """Say what to do with the card."""
    if progress is None or (progress.disc_px is None and progress.disc_count == 0):
        return tr("Lay the card flat under the camera, fully in view, about 60 cm away.")
    if progress.has_moved:
        return tr("The card moved: the countdown starts again.")
    if progress.disc_px is None:
        return tr(
            "{count} of 6 markers visible. Show the whole card in the image, in even light, with its wedge upright."
        ).format(count=min(progress.disc_count, 6))
    return tr("All six markers are visible. Do not move the card.")
