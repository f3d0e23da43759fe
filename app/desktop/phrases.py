"""The table of words (:mod:`core.words`) as the screens ask for it."""

from __future__ import annotations

from core.calibration.result import Finding
from core.errors import CarpusFault
from core.words import finding_words, words_of
from ui.ports import Words


class WordTable:
    """Phrasebook of the windows; what is no known fault is a mistake of the program, and is said to be one."""

    def fault(self, fault: Exception) -> Words:
        """The three answers."""
        if isinstance(fault, CarpusFault):
            words = words_of(fault)
            return Words(words.happened, words.safe, words.do)
        return Words(
            "Something happened that Carpus does not know.",
            "Everything stored before is safe.",
            "Go back and try again. If it comes back, start Carpus anew and report it.",
        )

    def finding(self, finding: Finding) -> Words:
        """Headline and remedy of a finding; nothing is recorded yet, so nothing can be lost."""
        words = finding_words(finding)
        return Words(words.headline, "", words.remedy)
