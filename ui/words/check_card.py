"""What the screen of the check card is told, as values, and what it says."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime, timedelta

from carpus.core.calibration.card.card import FIGURES, MOST_SCALE
from carpus.core.calibration.card.chart import OLD_DAYS, CardCheck, Verdict
from carpus.core.types import FloatArray
from carpus.ui import numbers
from carpus.ui.icons import State
from carpus.ui.translate import tr

_NEAR_SHARE = 0.8
"""Of its limit: a figure beyond is marked before it is out."""
_ONE_SHARE_PERCENT = 0.5


def headline(now: CameraChecks) -> tuple[str, str]:
    """The sentence, and what it rests on."""
    last = now.newest
    if last is None:
        return (
            tr("This camera has not been checked yet."),
            tr("Print the card, lay it under the camera, and look at it for 30 seconds."),
        )
    day = check_day(last)
    limits = tr("the limits are {angle}° and {length} mm").format(
        angle=numbers.fixed(last.most_angle_deg, 1), length=numbers.fixed(last.most_length_mm, 1)
    )
    off = tr("{angle}° and {length} mm off at most").format(
        angle=numbers.fixed(last.angle_error_deg, 1), length=numbers.fixed(last.length_error_mm, 1)
    )
    basis = tr("Check of {day}: {off}; {limits}.").format(day=day, off=off, limits=limits)
    if now.recalibrated:
        return (
            tr("Calibrated since the last check."),
            tr("{basis} Check it now: that check was with the values before.").format(basis=basis),
        )
    if now.verdict == "out":
        return _out_words(last), basis + " " + out_next(last)
    if now.verdict == "unusual":
        return tr("The camera measures otherwise than usual."), basis + " " + tr("Within the limits: check once more.")
    if now.days > OLD_DAYS:
        words = tr("The last check is {days} days old.").format(days=int(now.days))
        return words, basis + " " + tr("It measured right then.")
    return tr("The camera measures right."), basis


def _out_words(last: CardCheck) -> str:
    """Which of them is out."""
    if not last.lengths_hold and not last.angles_hold:
        return tr("The camera is out: lengths and angles are wrong.")
    if not last.angles_hold:
        return tr("The camera is out: angles are {angle}° off.").format(angle=numbers.fixed(last.angle_error_deg, 1))
    share = 100.0 * (last.scale - 1.0)
    pattern = (
        tr("The camera is out: lengths are {share} % too long.")
        if share > 0
        else tr("The camera is out: lengths are {share} % too short.")
    )
    if abs(share) < _ONE_SHARE_PERCENT:
        return tr("The camera is out: a length is {length} mm off.").format(
            length=numbers.fixed(last.length_error_mm, 1)
        )
    return pattern.format(share=numbers.fixed(abs(share), 1))


def out_next(last: CardCheck) -> str:
    """What still holds, and that nothing is lost."""
    holds = tr("Angles still hold.") if last.angles_hold else ""
    return f"{holds} {tr('Nothing is lost; sessions near this check say that they are not sure.')}".strip()


def check_day(check: CardCheck) -> str:
    """``20 Nov 2026, 08:12``."""
    return numbers.report_date(datetime.fromisoformat(check.when))


def figure_rows(check: CardCheck) -> list[tuple[State, str, str, str]]:
    """State, what on the card, measured, off by."""
    rows: list[tuple[State, str, str, str]] = []
    for figure, measured, sd in zip(FIGURES, check.measured, check.sd, strict=True):
        angle = figure.kind == "angle"
        off, limit = abs(measured - figure.true), check.most_angle_deg if angle else check.most_length_mm
        unit = "°" if angle else f"{numbers.NARROW_GAP}mm"
        state: State = "bad" if off > limit else "warn" if off > _NEAR_SHARE * limit else "good"
        value = (
            f"{numbers.fixed(measured, 1)}° ± {numbers.fixed(sd, 1)}°"
            if angle
            else f"{numbers.fixed(measured, 1)}{unit}"
        )
        rows.append((state, figure_name(figure.name), value, f"{numbers.fixed(off, 1)}{unit}"))
    share = 100.0 * (check.scale - 1.0)
    state = "bad" if abs(check.scale - 1.0) > MOST_SCALE else "good"
    rows.append((state, tr("All distances"), "", f"{'−' if share < 0 else '+'}{numbers.fixed(abs(share), 1)} %"))
    return rows


def figure_name(name: str) -> str:
    """The card's figures by their names."""
    return {
        "Wedge 30°": tr("Wedge 30°"),
        "Over the ridge 50°": tr("Over the ridge 50°"),
        "Flat 90°": tr("Flat 90°"),
        "80 mm across": tr("80 mm across"),
        "120 mm along": tr("120 mm along"),
        "25 mm high": tr("25 mm high"),
    }.get(name, name)


def cause_words(now: CameraChecks) -> str:
    """What may be behind a check that is out; when the next one is due otherwise."""
    last = now.newest
    if last is None:
        return ""
    share = 100.0 * (last.scale - 1.0)
    if abs(share) >= 100.0 * MOST_SCALE:
        pattern = (
            tr("All about {share} % long: the depth, or a card not printed at 100 %; its ruler says which.")
            if share > 0
            else tr("All about {share} % short: the depth, or a card not printed at 100 %; its ruler says which.")
        )
        return pattern.format(share=numbers.fixed(abs(share), 1))
    due = datetime.fromisoformat(last.when) + timedelta(days=OLD_DAYS)
    calibrated = tr("Calibrated {day}.").format(day=now.calibrated) if now.calibrated else tr("Not calibrated yet.")
    return tr("Next check by {day}. {calibrated}").format(day=numbers.short_date(due), calibrated=calibrated)


def hint(now: CardProgress | None) -> str:
    """What to do with the card."""
    if now is None or (now.pixel is None and now.blue == 0):
        return tr("Lay the card flat under the camera, all of it in the picture, about 60 cm away.")
    if now.moved:
        return tr("The card has moved: the seconds begin again.")
    if now.pixel is None:
        return tr("{count} of 6 discs seen: all of the card in the picture, even light, its wedge upright.").format(
            count=min(now.blue, 6)
        )
    return tr("All six discs are seen. Leave it lying.")


@dataclass(frozen=True, slots=True)
class CameraChecks:
    """One camera: its name, number (empty where nobody knows), all its ``checks``, oldest first, with what is said of
    the newest, and how many days ago that was; ``recalibrated``: calibrated since."""

    camera: str
    serial: str
    checks: Sequence[CardCheck] = ()
    verdict: Verdict | None = None
    days: float = float("nan")
    calibrated: str = ""
    recalibrated: bool = False
    simulated: bool = False

    @property
    def newest(self) -> CardCheck | None:
        return self.checks[-1] if self.checks else None


@dataclass(frozen=True, slots=True)
class CardProgress:
    """How far a check is: ``pixel`` of the discs (6, 2), None while they are not all seen; how many ``blue`` discs are;
    ``seconds`` of steady pictures; ``moved`` the card lies elsewhere and all began again."""

    pixel: FloatArray | None
    blue: int
    seconds: float
    moved: bool = False
