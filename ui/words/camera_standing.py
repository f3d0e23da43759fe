"""How far a camera is to be trusted today, in one sentence, in two words for the top bar, and over a session."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from carpus.ui import numbers
from carpus.ui.icons import State
from carpus.ui.translate import inside, tr

if TYPE_CHECKING:  # a window loads nothing that reads files
    from carpus.core.calibration.card.standing import Standing
    from carpus.core.results.camera_said import CameraSaid


def bar_words(now: Standing) -> tuple[State, str] | None:
    """For the top bar; None where there is nothing to say."""
    if now.is_out:
        return "bad", tr("Camera out: check it")
    if now.is_unusual:
        return "warn", tr("Camera unusual: check it")
    if now.is_old:
        return "warn", tr("Check {days} days old").format(days=int(now.checked_days))
    return None


def session_lines(now: Standing) -> list[str]:
    """Over the screens of a session that is measured with a camera which was out; empty otherwise."""
    last = now.check
    if last is None or not now.is_out:
        return []
    if last.angles_hold:
        share = 100.0 * (last.scale - 1.0)
        pattern = (
            tr("This camera was out at its last check: lengths {share} % too long. Angles hold. Check once more.")
            if share > 0
            else tr("This camera was out at its last check: lengths {share} % too short. Angles hold. Check once more.")
        )
        return [pattern.format(share=numbers.fixed(abs(share), 1))]
    words = tr("This camera was out at its last check: angles {angle}° off. Check it once more, or calibrate it.")
    return [words.format(angle=numbers.fixed(last.angle_error_deg, 1))]


def unsure_words(camera: CameraSaid) -> str:
    """Over a session near which a check was out; empty where none was."""
    if camera.angles_not_sure:
        return tr("Angles not sure: a check of this camera near this session was out.")
    if camera.lengths_not_sure:
        return tr("Lengths not sure: a check of this camera near this session was out; angles hold.")
    return ""


def unsure_name(camera: CameraSaid) -> str:
    """The same in a row of a list."""
    if camera.angles_not_sure:
        return tr("angles not sure")
    return tr("lengths not sure") if camera.lengths_not_sure else ""


def card_words(now: Standing) -> tuple[State, str]:
    """For the settings."""
    if not now.serial:
        return "open", tr("Not calibrated and not checked yet.")
    calibrated = tr("Never calibrated.")
    if math.isfinite(now.calibrated_days):
        calibrated = tr("Calibrated {ago}.").format(ago=_ago(now.calibrated_days))
    checked = tr("Never checked.")
    state: State = "open"
    if math.isfinite(now.checked_days):
        found = tr("out of its limits") if now.verdict == "out" else tr("otherwise than usual")
        found = tr("it measured right") if now.verdict == "right" else found
        checked = tr("Checked {ago}: {found}.").format(ago=_ago(now.checked_days), found=found)
        state = "bad" if now.is_out else "warn" if now.is_unusual or now.is_old or now.recalibrated else "good"
    words = tr("Camera {serial}: {calibrated} {checked}").format(
        serial=now.serial, calibrated=inside(calibrated), checked=checked
    )
    if now.recalibrated:
        words += " " + tr("Check it again: it was calibrated since.")
    return state, words


def _ago(days: float) -> str:
    whole = int(days)
    return {0: tr("today"), 1: tr("yesterday")}.get(whole, tr("{days} days ago").format(days=whole))
