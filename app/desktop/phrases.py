"""The table of words (:mod:`core.words`) as the screens ask for it."""

from __future__ import annotations

from pathlib import PureWindowsPath

from PySide6.QtCore import QObject

from carpus.core.calibration.result import CalibrationFinding
from carpus.core.errors import CarpusFault
from carpus.core.words import Words
from carpus.ui.fault_words import fault_words, finding_words

MOST_LETTERS = 32


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


class WordTable(QObject):
    """Phrasebook of the windows; what is no known fault is a mistake of the program, and is said to be one."""

    def fault(self, fault: Exception) -> Words:
        """The three answers."""
        if isinstance(fault, CarpusFault):
            return fault_words(type(fault)(_end_of_path(fault.subject), fault.detail))
        return Words(
            self.tr("Something happened that Carpus does not know."),
            self.tr("Everything stored before is safe."),
            self.tr("Go back and try again. If it comes back, start Carpus anew and report it."),
        )

    def finding(self, finding: CalibrationFinding) -> Words:
        """What a finding says and how to mend it; nothing is recorded yet, so nothing can be lost."""
        return finding_words(finding)
