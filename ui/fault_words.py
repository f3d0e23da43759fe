"""The table of words (:mod:`core.words`) in the person's language."""

from __future__ import annotations

from pathlib import PureWindowsPath

from carpus.core import words
from carpus.core.calibration import result
from carpus.core.calibration.result import CalibrationFinding
from carpus.core.errors import CarpusFault
from carpus.core.words import Words
from carpus.ui import numbers
from carpus.ui.translate import say, tr

MOST_LETTERS = 32


def fault_words(fault: Exception) -> Words:
    """What happened, whether the data are safe, what to do; what is no known fault is a mistake of the program."""
    if isinstance(fault, CarpusFault):
        return words.words_of(type(fault)(_end_of_path(fault.subject), fault.detail), say=say)
    return Words(
        tr("Something happened that Carpus does not know."),
        tr("Everything stored before is safe."),
        tr("Go back and try again. If it comes back, start Carpus anew and report it."),
    )


def finding_words(finding: CalibrationFinding) -> Words:
    """What is not as it should be at calibration, and how to mend it."""
    return result.finding_words(finding, say, lambda value: numbers.figures(value, 3))


def shortened(name: str, most: int = MOST_LETTERS) -> str:
    """The beginning and the end of a long name.

    >>> shortened("Linden-42_2026-11-20_113600_WRIST_FE_right.h5", 24)
    'Linden-42_20…FE_right.h5'
    """
    if len(name) <= most:
        return name
    tail = (most - 1) // 2
    return f"{name[: most - 1 - tail]}…{name[-tail:]}"


def _end_of_path(text: str) -> str:
    """The end of a path, so that a card has room for it; the whole path is in the log."""
    path = PureWindowsPath(text)  # takes both kinds of stroke
    if not path.root or len(path.parts) < 3:
        return text
    return f"…/{shortened(path.parent.name)}/{shortened(path.name)}"
