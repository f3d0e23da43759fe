"""The table of words (:mod:`core.words`) in the person's language."""

from __future__ import annotations

import traceback

from carpus.core import words
from carpus.core.calibration import result
from carpus.core.calibration.result import CalibrationFinding
from carpus.core.errors import UNEXPECTED, CarpusFault
from carpus.core.words import Words
from carpus.ui import numbers
from carpus.ui.translate import say, tr


def fault_words(fault: Exception) -> Words:
    """Say a fault in the person's language; any other exception is an unexpected error."""
    if isinstance(fault, CarpusFault):
        return words.words_of(fault, brief=True, say=say)
    return Words(
        tr("An unexpected error occurred."),
        tr("Everything saved before is safe."),
        tr("Try again. If it happens again, restart Carpus and show the details to your IT support."),
        tr("Program"),
        UNEXPECTED,
        tuple(traceback.format_exception_only(fault)),
    )


def finding_words(finding: CalibrationFinding) -> Words:
    """Say a finding of the calibration, and how to correct it."""
    return result.finding_words(finding, say, lambda value: numbers.figures(value, 3))
