"""The one-page result of a camera check: the sentence, the six figures, and both control charts."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QColor, QPen

from carpus.core.check_card.card import FIGURES
from carpus.core.check_card.chart import USUAL_OF, Check, Usual, Verdict, sentence_of, usual_of, verdict_of
from carpus.core.check_card.reading import MOST_ANGLE_DEG, MOST_LENGTH_MM
from carpus.ui.fonts import MEDIUM, SEMIBOLD
from carpus.ui.report.page import Page
from carpus.ui.report.pdf import write_page
from carpus.ui.theme import LIGHT

TITLE = "Carpus camera check"
_MOST_SHOWN = 24
_ROW_PT, _CHART_PT = 20.0, 140.0
_TOKENS: dict[Verdict, str] = {"right": "good", "unusual": "warn", "out": "bad"}


@dataclass(frozen=True, slots=True)
class CheckResult:
    """The newest ``check`` of a camera, those before it, and what is said of the picture-taking (``asides``)."""

    camera: str
    check: Check
    earlier: Sequence[Check]
    asides: Sequence[tuple[str, str]]


def write_check_report(path: Path, result: CheckResult) -> Path:
    """Write the page. Raises :class:`OutputExists`, :class:`OutputNotWritable` or :class:`DiskFull`."""
    return write_page(path, lambda page: paint_check_page(page, result), TITLE)


def paint_check_page(page: Page, result: CheckResult) -> None:
    """Paint the page."""
    check, earlier = result.check, result.earlier
    verdict = verdict_of(earlier, check)
    page.text(TITLE, page.left, 62, 15, SEMIBOLD)
    page.text_right(_day(check.when), page.right, 62, 10, MEDIUM)
    lower = page.paragraph(sentence_of(check, verdict), page.left, 76, page.right - page.left, 12, SEMIBOLD,
                           _TOKENS[verdict])  # fmt: skip
    pairs = [("Camera", result.camera), *result.asides]
    page.facts(pairs, lower + 10, (0.0, *(0.46 + 0.54 * k / (len(pairs) - 1) for k in range(len(pairs) - 1))))
    top = _table(page, check, lower + 60)
    usual = usual_of(earlier, check.calibrated)
    shown = [*earlier, check][-_MOST_SHOWN:]
    verdicts = [verdict_of([*earlier, check][: len(earlier) + 1 - len(shown) + k], one) for k, one in enumerate(shown)]
    top = _chart(page, top + 26, "Angles: largest error of three", "°", MOST_ANGLE_DEG, 0, shown, verdicts, usual)
    top = _chart(page, top + 30, "Lengths: largest error of three", " mm", MOST_LENGTH_MM, 1, shown, verdicts, usual)
    said = (
        f"Limits are fixed. Usual: mean of the first {USUAL_OF} checks after a calibration, ± 3 sd. ± in the table is "
        "the sd of one picture. All lengths off by one share: the depth, or a card that was not printed at 100 % (its "
        "ruler says which). If it is out: check once more, then calibrate; still out: do not measure with it."
    )
    page.paragraph(said, page.left, top + 22, page.right - page.left, 8.5, token="text2")


def _table(page: Page, check: Check, top: float) -> float:
    """The six figures; returns the lower edge."""
    columns = (page.left + 250, page.left + 370, page.right)
    page.text("On the card", page.left, top, 8.5, token="text2")
    for name, right in zip(("True", "Measured", "Off by"), columns, strict=True):
        page.text_right(name, right, top, 8.5, token="text2")
    for figure, measured, sd in zip(FIGURES, check.measured, check.sd, strict=True):
        page.rule(top + 6)
        top += _ROW_PT
        unit = "°" if figure.kind == "angle" else " mm"
        page.text(figure.name, page.left, top, 10)
        page.text_right(f"{figure.true:.1f}{unit}", columns[0], top, 10)
        page.text_right(f"{measured:.1f} ± {sd:.1f}{unit}", columns[1], top, 10)
        page.text_right(f"{measured - figure.true:+.1f}{unit}".replace("-", "−"), columns[2], top, 10, SEMIBOLD)
    page.rule(top + 6)
    top += _ROW_PT
    page.text("All distances together", page.left, top, 10)
    page.text_right(f"{100.0 * (check.scale - 1.0):+.2f} %".replace("-", "−"), columns[2], top, 10, SEMIBOLD)
    return top


def _chart(
    page: Page,
    top: float,
    title: str,
    unit: str,
    limit: float,
    value: int,
    shown: Sequence[Check],
    verdicts: Sequence[Verdict],
    usual: Usual | None,
) -> float:
    """One control chart over the last checks; returns the lower edge."""
    page.title(title, top)
    left, right, head, foot = page.left + 26, page.right - 90, top + 12, top + 12 + _CHART_PT
    highest = max(1.5 * limit, *(1.1 * one.values[value] for one in shown))

    def y(at: float) -> float:
        return foot - (foot - head) * min(max(at / highest, 0.0), 1.0)

    page.rule(foot, left, right)
    _line(page, (left, y(limit)), (right, y(limit)), LIGHT.bad, dashed=True)
    page.text(f"limit {limit:.1f}{unit}", right + 6, y(limit) + 3, 8, token="bad")
    page.text_right(f"0{unit}", left - 4, foot + 3, 8, token="text2")
    step = (right - left - 20) / max(len(shown) - 1, 1)
    at = [(left + 10 + step * k, y(one.values[value])) for k, one in enumerate(shown)]
    if usual is not None:
        begin = at[next(k for k, one in enumerate(shown) if one.calibrated == shown[-1].calibrated)][0] - 6.0
        low, high = (float(one) for one in usual.band[value])
        page.painter.fillRect(page.box(begin, y(high), right - begin, y(low) - y(high)), QColor(LIGHT.line))
        page.text(f"usual, up to {high:.1f}{unit}", right + 6, y(high) + 3, 8, token="text2")
    for k in range(1, len(shown)):
        if shown[k].calibrated == shown[k - 1].calibrated:
            _line(page, at[k - 1], at[k], LIGHT.text)
        else:
            between = 0.5 * (at[k - 1][0] + at[k][0])
            _line(page, (between, head), (between, foot), LIGHT.text2, dashed=True)
            page.text("calibrated", between + 2, head + 7, 7, token="text2")
    for place, verdict in zip(at, verdicts, strict=True):
        _MARKS[verdict](page, *place)
    page.text(_day(shown[0].when), left, foot + 12, 8, token="text2")
    if len(shown) > 1:
        page.text_right(_day(shown[-1].when), right, foot + 12, 8, token="text2")
    return foot + 12


def _line(
    page: Page, one: tuple[float, float], other: tuple[float, float], color: str, *, dashed: bool = False
) -> None:
    style = Qt.PenStyle.DashLine if dashed else Qt.PenStyle.SolidLine
    page.painter.setPen(QPen(QColor(color), 1.0 * page.point, style))
    page.painter.drawLine(*(QPointF(x * page.point, y * page.point) for x, y in (one, other)))


def _dot(page: Page, x: float, y: float) -> None:
    page.painter.setPen(Qt.PenStyle.NoPen)
    page.painter.setBrush(QColor(LIGHT.text))
    page.painter.drawEllipse(page.box(x - 2.5, y - 2.5, 5, 5))
    page.painter.setBrush(Qt.BrushStyle.NoBrush)


def _triangle(page: Page, x: float, y: float) -> None:
    _shape(page, [(x, y - 4.5), (x + 4.5, y + 3.5), (x - 4.5, y + 3.5)], LIGHT.warn)


def _octagon(page: Page, x: float, y: float) -> None:
    a, b = 1.9, 4.6
    corners = ((-a, -b), (a, -b), (b, -a), (b, a), (a, b), (-a, b), (-b, a), (-b, -a))
    _shape(page, [(x + dx, y + dy) for dx, dy in corners], LIGHT.bad)


def _shape(page: Page, corners: Sequence[tuple[float, float]], color: str) -> None:
    page.painter.setPen(Qt.PenStyle.NoPen)
    page.painter.setBrush(QColor(color))
    page.painter.drawPolygon([QPointF(x * page.point, y * page.point) for x, y in corners])
    page.painter.setBrush(Qt.BrushStyle.NoBrush)


_MARKS: dict[Verdict, Callable[[Page, float, float], None]] = {"right": _dot, "unusual": _triangle, "out": _octagon}


def _day(when: str) -> str:
    return f"{datetime.fromisoformat(when):%d %b %Y %H:%M}"
