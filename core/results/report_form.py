"""How a clinic's reports look: letterhead, paper, and the parts that are wanted."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal, get_args

from carpus.core.session.values import AngleOrder

Paper = Literal["a4", "letter"]
PAPERS: tuple[Paper, ...] = get_args(Paper)
PAPER_PT: dict[Paper, tuple[float, float]] = {"a4": (595.28, 841.89), "letter": (612.0, 792.0)}
"""Width and height in points."""
LETTER_COUNTRIES = ("US", "CA")
"""Where Letter is the usual paper."""
SECTIONS = ("diagnosis", "table", "curves", "bars", "quality", "speed", "by_hand", "motion")
"""Parts of a session's report that may be left out. Who and when, the sentences, warnings, method, legal sentence and
origin always stay; so does ``quality`` where something is not as it should be."""
DEFAULT_EXCLUDED = frozenset({"diagnosis"})
"""Left out until the clinic wants it."""
MAX_SENTENCES = 60
MAX_NAME_CHARACTERS, MAX_ADDRESS_LINES, MAX_ADDRESS_CHARACTERS = 60, 4, 80


@dataclass(frozen=True, slots=True)
class ReportSettings:
    """``therapist`` initials that are printed on reports; ``angle_order`` of the wrist's angles in the window and on
    reports: the papers' ``zyx`` or ``isb``."""

    therapist: str = ""
    angle_order: AngleOrder = "zyx"


@dataclass(frozen=True, slots=True)
class Letterhead:
    """The clinic's name, lines of its address and its logo, a PNG; all may be empty."""

    name: str = ""
    address: tuple[str, ...] = ()
    logo_png: bytes = b""

    @property
    def is_set(self) -> bool:
        return bool(self.name or self.address or self.logo_png)


@dataclass(frozen=True, slots=True)
class ReportForm:
    """What a report is printed on and with. ``excluded_sections``: of :data:`SECTIONS`; ``sentences`` the therapist's
    own,
    to write comments with."""

    letterhead: Letterhead = field(default_factory=Letterhead)
    paper: Paper = "a4"
    excluded_sections: frozenset[str] = DEFAULT_EXCLUDED
    sentences: tuple[str, ...] = ()

    def includes(self, section: str) -> bool:
        return section not in self.excluded_sections


def default_paper(country: str) -> Paper:
    """The paper of a country by its two letters.

    >>> default_paper("US"), default_paper("DE")
    ('letter', 'a4')
    """
    return "letter" if country.upper() in LETTER_COUNTRIES else "a4"


DEFAULT_FORM = ReportForm()
"""No letterhead, A4, everything but the diagnosis."""
