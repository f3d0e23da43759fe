"""A therapist's own sentences: their places in braces take the figures of the session, with how sure these are."""

from __future__ import annotations

import re
from collections.abc import Callable

from carpus.core.results.figures import SessionFigures
from carpus.core.results.progress import compare
from carpus.ui import numbers, terms
from carpus.ui.report.hand_rows import hand_since_words, range_words
from carpus.ui.report.session_page import SessionReport
from carpus.ui.report.tables import is_deficit, mean_words, prints_spread
from carpus.ui.report.words import since_words
from carpus.ui.translate import inside, tr

ANGLES = {"flexion": 1, "extension": 1, "radial": 0, "ulnar": 0, "supination": 2, "pronation": 2}
PLACES = (*ANGLES, "arc", "change", "repetitions", "date")
_PLACE = re.compile(r"\{(\w+)\}")


def proposals() -> tuple[str, ...]:
    """Offered until the therapist has sentences of their own."""
    return (
        tr("Flexion {flexion}, extension {extension}."),
        tr("The whole arc is {arc}. {change}"),
        tr("Splint as before; exercises at home three times a day."),
        tr("Check again in two weeks."),
    )


def filled(sentence: str, report: SessionReport) -> str:
    """The sentence with its places filled; a figure that is not known is said to be so, another place stays."""
    return _PLACE.sub(lambda found: _value(found[1], report) if found[1] in PLACES else found[0], sentence)


def _value(place: str, report: SessionReport) -> str:
    figures = report.figures
    said: dict[str, Callable[[], str]] = {
        "arc": lambda: _arc(figures),
        "change": lambda: _change(report),
        "repetitions": lambda: str(figures.counted) if figures.counted else "",
        "date": lambda: numbers.report_date(figures.when),
    }
    words = said[place]() if place in said else _row(figures, place, ANGLES[place])
    return words or tr("not measured")


def _row(figures: SessionFigures, movement: str, angle: int) -> str:
    row = next((one for one in figures.rows if one.movement == movement and one.angle == angle), None)
    if row is None or not row.count:
        return ""
    if row.limited:
        return range_words(row)
    if is_deficit(row):
        sd_deg = row.sd_deg if prints_spread(row) else row.measurement_sd_deg
        return f"{inside(terms.deficit_name(movement))} {numbers.with_spread(-row.mean_deg, sd_deg)}"
    return mean_words(row)


def _arc(figures: SessionFigures) -> str:
    angle = figures.exercise.angle
    return "" if angle is None else _row(figures, "arc", angle)


def _change(report: SessionReport) -> str:
    if report.previous is None:
        return _sentence(tr("not measured"))
    day = numbers.day_beside(report.previous.when, report.figures.when)
    if report.joints is not None:
        said = hand_since_words(report.figures, report.previous, day)
    else:
        said = since_words(compare(report.previous, report.figures), day)
    return said or _sentence(tr("not measured"))


def _sentence(words: str) -> str:
    return f"{words[:1].upper()}{words[1:]}."
