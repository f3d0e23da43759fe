"""The table of words (:mod:`core.words`) in the person's language."""

from __future__ import annotations

from carpus.core import words
from carpus.core.calibration.result import CalibrationFinding
from carpus.core.errors import CarpusFault
from carpus.core.words import Words
from carpus.ui import numbers
from carpus.ui.translate import say


def fault_words(fault: CarpusFault) -> Words:
    """What happened, whether the data are safe, what to do."""
    return words.words_of(fault, say=say)


def finding_words(finding: CalibrationFinding) -> Words:
    """What is not as it should be at calibration, and how to mend it."""
    return words.finding_words(finding, say, lambda value: numbers.figures(value, 3))
