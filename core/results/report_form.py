"""Form of a clinic's reports: letterhead, paper and sections."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal, get_args

from carpus.core.session.values import AngleOrder

Paper = Literal["a4", "letter"]
PAPERS: tuple[Paper, ...] = get_args(Paper)
PAPER_PT: dict[Paper, tuple[float, float]] = {"a4": (595.28, 841.89), "letter": (612.0, 792.0)}
"""Width and height in points."""
LETTER_COUNTRIES = ("US", "CA")
DEFAULT_EXCLUDED = frozenset({"diagnosis"})
"""Excluded until the clinic wants it."""
MAX_SENTENCES = 60
MAX_NAME_CHARACTERS, MAX_ADDRESS_LINES, MAX_ADDRESS_CHARACTERS = 60, 4, 80


@dataclass(frozen=True, slots=True)
class ReportSettings:
    """Settings of reports: ``therapist`` initials, and the ``angle_order`` in window and reports."""

    therapist: str = ""
    angle_order: AngleOrder = "zyx"


@dataclass(frozen=True, slots=True)
class Letterhead:
    """Name, address lines and logo (PNG) of the clinic; all may be empty."""

    name: str = ""
    address: tuple[str, ...] = ()
    logo_png: bytes = b""

    @property
    def is_set(self) -> bool:
        return bool(self.name or self.address or self.logo_png)


@dataclass(frozen=True, slots=True)
class ReportForm:
    """Form of reports; ``sentences`` are the therapist's own for comments.

    ``prints_names``: real name, birth date and record number stand beside the pseudonym.
    """

    letterhead: Letterhead = field(default_factory=Letterhead)
    paper: Paper = "a4"
    excluded_sections: frozenset[str] = DEFAULT_EXCLUDED
    sentences: tuple[str, ...] = ()
    prints_names: bool = False

    def includes(self, section: str) -> bool:
        return section not in self.excluded_sections


def default_paper(country: str) -> Paper:
    """Return the paper of a country by its two letters.

    >>> default_paper("US"), default_paper("DE")
    ('letter', 'a4')
    """
    return "letter" if country.upper() in LETTER_COUNTRIES else "a4"


DEFAULT_FORM = ReportForm()
"""No letterhead, A4, everything but the diagnosis."""
