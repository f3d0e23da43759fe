"""A page in its frame: the clinic's letterhead above, the page's number in its head, as large as the paper."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QRectF
from PySide6.QtGui import QImage

from carpus.core.results.report_form import PAPER_PT, Letterhead, ReportForm
from carpus.ui.fonts import REGULAR, SEMIBOLD
from carpus.ui.report.page import A4_PT, MARGIN_PT, Page, painted_on_nothing
from carpus.ui.translate import tr

EDGE_PT = 28.35
"""A centimetre: printers reach no nearer to the edge."""
BODY_TOP_PT, BODY_FOOT_PT = MARGIN_PT - 12.0, A4_PT[1] - EDGE_PT
"""Between these a page paints."""
HEAD_TOP_PT, HEAD_GAP_PT = EDGE_PT, 8.0
LOGO_PT = (150.0, 44.0)
NAME_PT, ADDRESS_PT, LEADING_PT = 11.5, 8.0, 10.5


def paint_framed(page: Page, form: ReportForm, number: int, count: int, paint: Callable[[Page], None]) -> None:
    """Paint a page made for A4 on the form's paper, smaller where letterhead and paper leave it less room."""
    width, height = PAPER_PT[form.paper]
    foot = height - EDGE_PT
    if form.letterhead.is_set:
        tried = painted_on_nothing(page, lambda trial: _paint_letterhead(trial, form.letterhead, MARGIN_PT, width))
        share = min(1.0, (foot - tried - HEAD_GAP_PT) / (BODY_FOOT_PT - BODY_TOP_PT))
        edge = 0.5 * (width - share * A4_PT[0]) + share * MARGIN_PT  # one left edge for head and body
        down = _paint_letterhead(page, form.letterhead, edge, width) + HEAD_GAP_PT - BODY_TOP_PT * share
    else:
        share = min(1.0, foot / BODY_FOOT_PT)
        down = 0.0
    painter = page.painter
    painter.save()
    painter.translate(0.5 * (width - share * A4_PT[0]) * page.point, down * page.point)
    painter.scale(share, share)
    if count > 1:
        page.number = tr("page {number} of {count}").format(number=number, count=count)
    paint(page)
    painter.restore()


def _paint_letterhead(page: Page, head: Letterhead, edge_pt: float, width_pt: float) -> float:
    """Logo at the left, name and address beside it; returns the lower edge."""
    left, top = edge_pt, HEAD_TOP_PT
    right = width_pt - edge_pt
    logo = QImage.fromData(head.logo_png) if head.logo_png else QImage()
    below = top
    if not logo.isNull():
        share = min(LOGO_PT[0] / logo.width(), LOGO_PT[1] / logo.height())
        width, height = logo.width() * share, logo.height() * share
        page.painter.drawImage(page.box(left, top, width, height), logo, QRectF(logo.rect()))
        left, below = left + width + 12.0, top + height
    baseline = top
    if head.name:
        baseline += 11.0
        page.text(head.name, left, baseline, _fitting(page, head.name, right - left, NAME_PT, SEMIBOLD), SEMIBOLD)
        baseline += 1.5
    for line in head.address:
        baseline += LEADING_PT
        page.text(line, left, baseline, _fitting(page, line, right - left, ADDRESS_PT, REGULAR), REGULAR, "text2")
    below = max(below, baseline + 3.0) + 5.0
    page.rule(below, edge_pt, right)
    return below


def _fitting(page: Page, words: str, width_pt: float, size_pt: float, weight: int) -> float:
    """The size at which words are no wider than their room."""
    return size_pt * min(1.0, 0.98 * width_pt / max(page.width_of(words, size_pt, weight), 1.0))
