"""The one-page result of a camera's calibration: the sentence and every figure, before and now."""

from __future__ import annotations

from datetime import datetime
from pathlib import Path

from carpus.ui import numbers
from carpus.ui.fonts import MEDIUM, SEMIBOLD
from carpus.ui.report.page import Page, PageColumn
from carpus.ui.report.pdf import write_page
from carpus.ui.translate import tr
from carpus.ui.words.camera_calibration import BoardResult, effect_rows, headline, kept_words, result_rows

_ROW_PT = 21.0
FIGURES = (
    PageColumn(0.0, MEDIUM, size_pt=10.0), PageColumn(0.49, ends=True, size_pt=10.0, token="text2"),
    PageColumn(0.706, SEMIBOLD, ends=True, size_pt=10.0), PageColumn(0.733, room=0.267, token="text2"),
)  # fmt: skip
EFFECTS = (PageColumn(0.0, size_pt=10.0), PageColumn(1.0, SEMIBOLD, ends=True, size_pt=10.0))


def write_calibration_page(path: Path, result: BoardResult, when: datetime) -> Path:
    """Write the page. Raises :class:`OutputExists`, :class:`OutputNotWritable` or :class:`DiskFull`."""
    return write_page(path, lambda page: paint_calibration_page(page, result, when), tr("Carpus camera calibration"))


def paint_calibration_page(page: Page, result: BoardResult, when: datetime) -> None:
    """Paint the page."""
    page.text(tr("Carpus camera calibration"), page.left, 62, 15, SEMIBOLD)
    page.text_right(numbers.report_date(when), page.right, 62, 10, MEDIUM)
    answer, basis = headline(result)
    lower = page.said(answer, 78, 13, SEMIBOLD, "text" if result.made.is_usable else "bad")
    lower = page.said(basis, lower + 4, 10, token="text2")
    camera = f"{result.camera} {result.serial}".strip()
    pictures = str(len(result.made.intrinsics.used))
    facts = [(tr("Camera"), camera), (tr("Board"), result.made.board), (tr("Pictures"), pictures)]
    page.facts(facts, lower + 10, (0.0, 0.36, 0.88))
    before = tr("Before ({day})").format(day=result.since) if result.since else tr("Before (maker)")
    rows = [
        ((what, MEDIUM, "bad" if state == "bad" else "text"), was, now, words)
        for state, what, was, now, words in result_rows(result)
    ]
    heads = (tr("What"), before, tr("Now"), tr("In words"))
    top = page.table(FIGURES, rows, lower + 56, heads=heads, pitch_pt=_ROW_PT, drop_pt=6.0) + 34
    page.title(tr("What this means for a hand"), top)
    top = page.table(EFFECTS, effect_rows(result), top + 6, pitch_pt=_ROW_PT, drop_pt=6.0)
    said = tr("Estimated from the change of the camera’s values, not measured on hands.")
    page.said(f"{said} {kept_words(result)}", top + 8, 8.5, token="text2")
