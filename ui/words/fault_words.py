"""Faults and findings (:mod:`core.model.fault_text`) in the user's language."""

from __future__ import annotations

import traceback

from carpus.core.calibration import result
from carpus.core.calibration.result import CalibrationFinding
from carpus.core.model import fault_text
from carpus.core.model.errors import UNEXPECTED_CODE, CarpusFault
from carpus.core.model.fault_text import MessageText
from carpus.ui.kit import numbers
from carpus.ui.kit.translate import tr, translate_phrase


def fault_words(fault: Exception) -> MessageText:
    """Return the text of a fault; any other exception is an unexpected error."""
    if isinstance(fault, CarpusFault):
        return fault_text.format_fault(fault, is_brief=True, translate=translate_phrase)
    return MessageText(
        tr("An unexpected error occurred."),
        tr("Everything saved before is safe."),
        tr("Try again. If it happens again, restart Carpus and show the details to your IT support."),
        tr("Program"),
        UNEXPECTED_CODE,
        tuple(traceback.format_exception_only(fault)),
    )


def finding_words(finding: CalibrationFinding) -> MessageText:
    """Return the text of a calibration finding and its remedy."""
    return result.finding_words(finding, translate_phrase, lambda value: numbers.format_significant(value, 3))
