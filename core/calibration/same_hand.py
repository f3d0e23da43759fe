"""Is it the hand of last time? A hand has one length; wrong names, or another patient's set-up, have another."""

from __future__ import annotations

import math
from dataclasses import replace

from carpus.core.calibration.calibrate import CalibrationOutcome
from carpus.core.calibration.result import CalibrationFinding, Verdict
from carpus.core.calibration.settings import CalibrationSettings


def compared_with_last_time(
    outcome: CalibrationOutcome, last_length_mm: float, settings: CalibrationSettings
) -> CalibrationOutcome:
    """The outcome, doubted where the hand is not as long as the same hand was; NaN: there is none to compare with."""
    now_mm = outcome.verdict.hand_length_mm
    if not (math.isfinite(last_length_mm) and math.isfinite(now_mm)):
        return outcome
    if abs(now_mm - last_length_mm) <= settings.most_length_change * last_length_mm:
        return outcome
    finding = CalibrationFinding("other_length", (), now_mm, last_length_mm, "mm")
    verdict: Verdict = replace(outcome.verdict, findings=(*outcome.verdict.findings, finding))
    calibration = outcome.calibration
    return replace(
        outcome,
        verdict=verdict,
        calibration=None if calibration is None else replace(calibration, verdict=verdict),
    )
