"""The one-page result of a camera's calibration: the sentence and every figure, before and now."""

from __future__ import annotations

from datetime import datetime
from pathlib import Path

from carpus.ui import numbers
from carpus.ui.camera_calibration.values import BoardResult
from carpus.ui.camera_calibration.words import effect_rows, headline, kept_words, result_rows
from carpus.ui.fonts import MEDIUM, SEMIBOLD
from carpus.ui.report.page import Page
from carpus.ui.report.pdf import write_page
from carpus.ui.translate import tr

_ROW_PT = 21.0


def write_calibration_page(path: Path, result: BoardResult, when: datetime) -> Path:
    """Write the page. Raises :class:`OutputExists`, :class:`OutputNotWritable` or :class:`DiskFull`."""
    return write_page(path, lambda page: paint_calibration_page(page, result, when), tr("Carpus camera calibration"))


def paint_calibration_page(page: Page, result: BoardResult, when: datetime) -> None:
    """Paint the page."""
    width = page.right - page.left
    page.text(tr("Carpus camera calibration"), page.left, 62, 15, SEMIBOLD)
    page.text_right(numbers.report_date(when), page.right, 62, 10, MEDIUM)
    answer, basis = headline(result)
    lower = page.paragraph(answer, page.left, 78, width, 13, SEMIBOLD, "text" if result.made.is_usable else "bad")
    lower = page.paragraph(basis, page.left, lower + 4, width, 10, token="text2")
    camera = f"{result.camera} {result.serial}".strip()
    pictures = str(len(result.made.intrinsics.used))
    facts = [(tr("Camera"), camera), (tr("Board"), result.made.board), (tr("Pictures"), pictures)]
    page.facts(facts, lower + 10, (0.0, 0.36, 0.88))
    top = lower + 64
    columns = (page.left + 250, page.left + 360)
    before = tr("Before ({day})").format(day=result.since) if result.since else tr("Before (maker)")
    page.text(tr("What"), page.left, top, 8.5, token="text2")
    page.text_right(before, columns[0], top, 8.5, token="text2")
    page.text_right(tr("Now"), columns[1], top, 8.5, token="text2")
    page.text(tr("In words"), columns[1] + 14, top, 8.5, token="text2")
    for state, what, was, now, words in result_rows(result):
        page.rule(top + 6)
        top += _ROW_PT
        page.text(what, page.left, top, 10, MEDIUM, "bad" if state == "bad" else "text")
        page.text_right(was, columns[0], top, 10, token="text2")
        page.text_right(now, columns[1], top, 10, SEMIBOLD)
        page.text(words, columns[1] + 14, top, 9, token="text2")
    page.rule(top + 6)
    top += 40
    page.title(tr("What this means for a hand"), top)
    for name, value in effect_rows(result):
        top += _ROW_PT
        page.text(name, page.left, top, 10)
        page.text_right(value, page.right, top, 10, SEMIBOLD)
    said = tr("Estimated from the change of the camera’s values, not measured on hands.")
    page.paragraph(f"{said} {kept_words(result)}", page.left, top + 14, width, 8.5, token="text2")
