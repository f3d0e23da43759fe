"""Display format of numbers, times and dates in the person's language."""

from __future__ import annotations

import math
import re
from contextlib import suppress
from datetime import date, datetime

from PySide6.QtCore import QDate

from carpus.core.model.rounding import format_rounded, round_half_away
from carpus.ui.kit import language
from carpus.ui.kit.translate import tr

NARROW_GAP = "\N{NO-BREAK SPACE}"
UNKNOWN = "\N{EN DASH}"


def format_degrees(value_deg: float) -> str:
    """Return ``42°`` without sign, which a word carries; a dash if unknown.

    >>> format_degrees(-41.6), format_degrees(44.5), format_degrees(-44.5), format_degrees(float("nan"))
    ('42°', '45°', '45°', '–')
    """
    return f"{round_half_away(abs(value_deg))}°" if math.isfinite(value_deg) else UNKNOWN


def format_signed_degrees(value_deg: float) -> str:
    """Return ``−3°`` for a negative angle, where no word carries the sign.

    >>> format_signed_degrees(-3.2), format_signed_degrees(-0.3)
    ('−3°', '0°')
    """
    shown = format_degrees(value_deg)
    minus = "\N{MINUS SIGN}" if value_deg < 0 and shown != format_degrees(0.0) else ""
    return f"{minus}{shown}"


def format_degree_range(low_deg: float, high_deg: float) -> str:
    """Return ``60–80°``, or ``60°`` if both are equal."""
    low, high = format_rounded(low_deg), format_rounded(high_deg)
    return f"{low}°" if low_deg == high_deg else f"{low}–{high}°"


def format_with_sd(value_deg: float, sd_deg: float) -> str:
    """Return ``57° ± 2°`` with no-break spaces; the angle alone if the SD is unknown.

    >>> format_with_sd(57.2, 2.4), format_with_sd(57.2, 0.2), format_with_sd(57.2, float("nan"))
    ('57°\\xa0±\\xa02°', '57°\\xa0±\\xa01°', '57°')
    """
    if not math.isfinite(value_deg) or not math.isfinite(sd_deg):
        return format_degrees(value_deg)
    return f"{format_degrees(value_deg)}{NARROW_GAP}{format_sd(sd_deg)}"


def format_sd(sd_deg: float) -> str:
    """Return ``± 2°``, at least 1°; empty if unknown."""
    if not math.isfinite(sd_deg):
        return ""
    return f"±{NARROW_GAP}{max(1, round_half_away(sd_deg))}°"


def format_millimetres(value_mm: float) -> str:
    """Return ``12 mm``."""
    return f"{round_half_away(value_mm)}{NARROW_GAP}mm" if math.isfinite(value_mm) else UNKNOWN


def format_shortest(value: float) -> str:
    """Return a number with one decimal only if it has one.

    >>> format_shortest(2.5), format_shortest(5.0)
    ('2.5', '5')
    """
    return format_fixed(value, int(value % 1 != 0))


def format_fixed(value: float, decimals: int) -> str:
    """Return ``12.5`` with so many decimals; a dash if unknown.

    >>> format_fixed(12.46, 1), format_fixed(float("nan"), 1), format_fixed(-0.04, 1)
    ('12.5', '–', '0.0')
    """
    if not math.isfinite(value):
        return UNKNOWN
    return _localise(format_rounded(value, decimals))


def format_signed(value: float, decimals: int) -> str:
    """Return ``+1.3`` or ``−0.4``."""
    return f"{'−' if value < 0 else '+'}{format_fixed(abs(value), decimals)}"


def format_significant(value: float, digits: int) -> str:
    """Return ``0.65`` with so many significant digits.

    >>> format_significant(0.6512, 3), format_significant(12.0, 3)
    ('0.651', '12')
    """
    return _localise(f"{value:.{digits}g}") if math.isfinite(value) else UNKNOWN


def _localise(plain: str) -> str:
    """Replace the decimal point by the language's."""
    return plain.replace(".", language.locale().decimalPoint())


def format_clock(seconds: float) -> str:
    """Return ``01:24``, with hours if there are any.

    >>> format_clock(84.9), format_clock(3661)
    ('01:24', '1:01:01')
    """
    if not math.isfinite(seconds):
        return UNKNOWN
    whole = int(max(0.0, seconds))
    hours, rest = divmod(whole, 3600)
    return (f"{hours}:" if hours else "") + f"{rest // 60:02d}:{rest % 60:02d}"


def format_clock_tenths(seconds: float) -> str:
    """Return ``00:20.6``.

    >>> format_clock_tenths(20.65)
    '00:20.6'
    """
    tenths = int(max(0.0, seconds) * 10 + 1e-6)
    return f"{format_clock(tenths // 10)}{language.locale().decimalPoint()}{tenths % 10}"


def format_short_date(when: date | datetime) -> str:
    """Return ``Fri 13 Nov``."""
    return language.locale().toString(_to_qdate(when), tr("ddd d MMM"))


def format_day_month(when: date | datetime) -> str:
    """Return ``13 Nov``."""
    return language.locale().toString(_to_qdate(when), tr("d MMM"))


def format_distinct_day(when: datetime, *others: datetime) -> str:
    """Return ``13 Nov``, or ``13 Nov, 15:29`` if another session is of the same day."""
    same = any(other != when and other.date() == when.date() for other in others)
    return f"{format_day_month(when)}, {format_distinct_time(when, *others)}" if same else format_day_month(when)


def format_distinct_time(when: datetime, *others: datetime) -> str:
    """Return ``15:29``, or ``15:29:07`` if another session is of the same minute."""
    day, minute = when.date(), (when.hour, when.minute)  # of hundreds of sessions with each row: nothing is written
    same = any(other != when and other.date() == day and (other.hour, other.minute) == minute for other in others)
    return f"{when:%H:%M:%S}" if same else f"{when:%H:%M}"


def format_time_or_day(when: datetime, now: datetime) -> str:
    """Return ``15:29`` for the same day as ``now``, else ``13 Nov``."""
    return format_distinct_time(when, now) if when.date() == now.date() else format_day_month(when)


def format_recording_time(minutes: float) -> str:
    """Return how long a disk takes recordings: ``8 min``, ``17 h``, ``more than 99 h``."""
    if minutes < 600.0:
        return tr("{minutes} min").format(minutes=format_rounded(minutes))
    hours = minutes / 60.0
    return tr("more than 99 h") if hours > 99.0 else tr("{hours} h").format(hours=format_rounded(hours))


def format_long_date(when: date | datetime) -> str:
    """Return ``Friday 20 November 2026``."""
    return language.locale().toString(_to_qdate(when), tr("dddd d MMMM yyyy"))


def format_date(when: date | datetime) -> str:
    """Return ``20 Nov 2026``."""
    return language.locale().toString(_to_qdate(when), tr("d MMM yyyy"))


def qt_date_format() -> str:
    """Return the date format of fields in Qt's notation."""
    return tr("d MMM yyyy")


def format_date_time(when: datetime, *others: datetime) -> str:
    """Return ``20 Nov 2026, 11:36``, with seconds if ``others`` are of the same minute."""
    return f"{format_date(when)}, {format_distinct_time(when, *others)}"


def format_days_ago(when: date | datetime, today: date) -> str:
    """Return ``yesterday`` or ``7 days ago``; empty for the future."""
    days = (today - (when.date() if isinstance(when, datetime) else when)).days
    if days < 0:
        return ""
    return {0: tr("today"), 1: tr("yesterday")}.get(days, tr("{days} days ago").format(days=days))


def format_weeks_since(day: date, today: date) -> str:
    """Return ``13 weeks``, below one ``5 days``; empty for the future."""
    days = (today - day).days
    if days < 0:
        return ""
    weeks = days // 7
    if weeks:
        return tr("1 week") if weeks == 1 else tr("{count} weeks").format(count=weeks)
    return tr("1 day") if days == 1 else tr("{count} days").format(count=days)


MIN_YEAR = 1900


def parse_date(text: str, latest: date | None = None) -> date | None:
    """Parse a date as people type it, day before month, or as Carpus writes it; None for anything else.

    A year of two digits is of the last century where it would be after ``latest``.

    >>> parse_date("21.8.26"), parse_date("2026-08-21"), parse_date("31.2.2026"), parse_date("soon")
    (datetime.date(2026, 8, 21), datetime.date(2026, 8, 21), None, None)
    >>> parse_date("21.8.202"), parse_date("21.8.99999999999"), parse_date("21.8.2026 5")  # slips
    (None, None, None)
    >>> parse_date("12.3.81", date(2026, 10, 3))
    datetime.date(1981, 3, 12)
    >>> parse_date("3 Oct 2026") == parse_date("3 October 2026") == date(2026, 10, 3)
    True
    """
    if found := re.fullmatch(r"(\d{1,4})[\s./-]+(\d{1,2})[\s./-]+(\d{1,4})", text.strip().strip(".")):
        day, month, year = map(int, found.groups() if len(found[1]) < 3 else reversed(found.groups()))
        with suppress(ValueError):
            typed_day = date(year + 2000 if year < 100 else year, month, day)
            if year < 100 and latest is not None and typed_day > latest:
                typed_day = date(year + 1900, month, day)
            return typed_day if typed_day.year >= MIN_YEAR else None
        return None
    for pattern in (qt_date_format(), qt_date_format().replace("MMM", "MMMM")):  # the month written out too
        typed = language.locale().toDate(text.strip(), pattern)
        if typed.isValid():
            return date(typed.year(), typed.month(), typed.day())
    return None


def format_ordinal(number: int) -> str:
    """Return ``6th``; other languages translate the whole pattern.

    >>> [format_ordinal(number) for number in (1, 2, 3, 4, 11, 12, 13, 21, 112)]
    ['1st', '2nd', '3rd', '4th', '11th', '12th', '13th', '21st', '112th']
    """
    last = 0 if number % 100 in (11, 12, 13) else number % 10
    pattern = {1: tr("{number}st"), 2: tr("{number}nd"), 3: tr("{number}rd")}.get(last, tr("{number}th"))
    return pattern.format(number=number)


def _to_qdate(when: date | datetime) -> QDate:
    return QDate(when.year, when.month, when.day)
