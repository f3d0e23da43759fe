"""A report and its pages: parts laid out by Qt, the same on screen and paper; and their PDF, without a display."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import ClassVar, Protocol

from PySide6.QtCore import QBuffer, QByteArray, QIODevice, QMarginsF, QPoint, QRectF, QSize, QSizeF, Qt
from PySide6.QtGui import (
    QFont,
    QGuiApplication,
    QImage,
    QPageLayout,
    QPageSize,
    QPainter,
    QPaintEvent,
    QPdfWriter,
    QPen,
    QRegion,
    QTextLayout,
    QTextOption,
)
from PySide6.QtWidgets import QApplication, QHBoxLayout, QLayout, QSizePolicy, QVBoxLayout, QWidget

from carpus.core.formats.output_files import open_new_file, require_folder
from carpus.core.model.phrase import Phrase
from carpus.core.records.values import Patient
from carpus.core.results.report_form import PAPER_PT, Letterhead, ReportForm
from carpus.core.results.session_results import SessionResults
from carpus.ui.charts.chart import Chart
from carpus.ui.charts.panel import PlotStyle, paper_style
from carpus.ui.kit.card import Separator
from carpus.ui.kit.fonts import font, load_fonts
from carpus.ui.kit.language import thread_language, use_language
from carpus.ui.kit.layouts import STRETCH, Part, column_layout, row_layout
from carpus.ui.kit.table import Cell, Table, TableColumn
from carpus.ui.kit.text import MEDIUM, REGULAR, SEMIBOLD, Icon, PlainText
from carpus.ui.kit.theme import Theme
from carpus.ui.kit.translate import to_mid_sentence, tr
from carpus.ui.words import terms
from carpus.ui.words.terms import printed_name

# Shown by PDF viewers and mail programs, so without a name.
TITLE = "Carpus report"
RESOLUTION_DPI = 1200
POINTS_PER_INCH = 72.0
POINTS_PER_MM = POINTS_PER_INCH / 25.4
# Layout pixels per point: Qt places in whole pixels, and a quarter of a point is finer than print.
UNIT = 4
# Margins at the sides, above and below; printers leave a centimetre free.
MARGIN_PT, TOP_PT, FOOT_PT = 42.5, 30.5, 28.5
# Width of the parts on A4; Letter is wider.
BODY_WIDTH_PT = PAPER_PT["a4"][0] - 2 * MARGIN_PT
LOGO_PT = (150.0, 44.0)
DISPLAY_FROM_PT = 20.0
# Room for the head of a page, the title of a section and the legal sentence.
HEAD_PT = 130.0
# No page is laid out smaller.
MIN_SCALE = 0.3


class _Paper(Theme):
    """The light theme in points; it never changes."""

    line_px = 2

    def __init__(self) -> None:
        super().__init__("light", UNIT)

    def font(self, size_px: float, weight: int) -> QFont:
        return font(size_px * UNIT, weight, display=size_px >= DISPLAY_FROM_PT)

    def on_change(self, widget: object, callback: Callable[[], None]) -> None:
        callback()


# Longer than any word of a language; unbroken, it would make the whole page small.
_LONG_WORD = re.compile(r"\S{28,}")


def _break_anywhere(word: re.Match[str]) -> str:
    """Return the word with invisible breaks after every letter."""
    return "\u200b".join(word[0])


PAPER = _Paper()
CHART: PlotStyle = paper_style(UNIT)


def to_layout_units(*sizes: float) -> tuple[int, ...]:
    """Return lengths in points as layout pixels."""
    return tuple(PAPER.px(size) for size in sizes)


def paragraph(words: str, size: float = 9.0, weight: int = REGULAR, token: str = "text") -> PlainText:
    """Return a paragraph that wraps."""
    return PlainText(PAPER, _LONG_WORD.sub(_break_anywhere, words), size, weight, token, wrap=True)


def label(words: str, size: float = 9.0, weight: int = REGULAR, token: str = "text") -> PlainText:
    """Return words in one line."""
    return PlainText(PAPER, words, size, weight, token)


def column(*parts: Part | float, gap: float = 0.0, within: QWidget | None = None) -> QVBoxLayout:
    """Stack parts; numbers are gaps in points."""
    return column_layout(*_to_units(parts), gap=PAPER.px(gap), margins=(0, 0, 0, 0), parent=within)


def line(*parts: Part | float, gap: float = 0.0) -> QHBoxLayout:
    """Put parts side by side; numbers are gaps in points."""
    return row_layout(*_to_units(parts), gap=PAPER.px(gap), margins=(0, 0, 0, 0))


def _to_units(parts: Sequence[Part | float]) -> list[Part]:
    return [PAPER.px(part) if isinstance(part, int | float) else part for part in parts]


def rule() -> Separator:
    """Return a horizontal line."""
    return Separator(PAPER)


def line_or_column(first: PlainText, *rest: QWidget | float, is_apart: bool = True) -> QLayout:
    """Put parts in one line, or below the first one if they are too wide."""
    widths = [one.sizeHint().width() if isinstance(one, QWidget) else PAPER.px(one) for one in (first, *rest, 12.0)]
    if sum(widths) <= PAPER.px(BODY_WIDTH_PT):
        behind: tuple[Part | float, ...] = (STRETCH, *rest) if is_apart else (12.0, *rest, STRETCH)
        return line((first, 0, Qt.AlignmentFlag.AlignBottom), *behind)
    for one in (first, *rest):
        if isinstance(one, PlainText) and one.sizeHint().width() > PAPER.px(BODY_WIDTH_PT):
            one.setText(_LONG_WORD.sub(_break_anywhere, one.text()))
            one.setWordWrap(True)
    return column(first, line(*rest, *([] if len(rest) == 1 else [STRETCH])))


def section_title(words: str, *aside: str | QWidget | float) -> QLayout:
    """Return the title of a section with a remark or a legend."""
    behind = [label(one, 8.5, REGULAR, "text2") if isinstance(one, str) else one for one in aside if one != ""]
    return line_or_column(label(words, 11.5, SEMIBOLD), *behind)


def page_head(kind: str, number: str, who: str, what: str, printed_patient: Patient | None = None) -> QLayout:
    """Return the page head: logo, kind and number of the page, patient and content."""
    aside = f"{kind} · {number}" if number else kind
    top = line(
        Icon(PAPER, "carpus", 15, (15, 15)),
        5.0,
        label("Carpus", 11.5, SEMIBOLD),
        STRETCH,
        label(aside, 8.5, token="text2"),
    )
    name = line_or_column(label(who, 21.0, SEMIBOLD), label(what, 14.0, REGULAR, "text2"), is_apart=False)
    below = [paragraph(printed_name(printed_patient), 12.0, SEMIBOLD)] if printed_patient is not None else []
    return column(top, 9.0, name, *below, 4.0, rule())


def exercise_head(report: Report, title: str, number: str) -> QLayout:
    """Return the head of a page about an exercise of one hand."""
    newest = report.sessions[-1]
    what = f"{terms.exercise_name(newest.exercise.id)}, {to_mid_sentence(terms.hand_name(newest.side))}"
    return page_head(title, number, report.pseudonym, what, report.printed_patient)


def fact_row(pairs: Sequence[tuple[str, str]]) -> QLayout:
    """Return small names over their values, side by side."""
    parts: list[Part] = [
        (column(paragraph(name, 8.5, REGULAR, "text2"), paragraph(value, 10.0, MEDIUM)), max(len(name), len(value), 8))
        for name, value in pairs
    ]
    return line(*parts, gap=8.0)


def table(
    columns: Sequence[TableColumn],
    heads: Sequence[str | Cell],
    rows: Sequence[Sequence[str | Cell]],
    size: float = 9.0,
    pitch: float = 3.0,
) -> Table:
    """Return a table as wide as the page."""
    made = Table(PAPER, size, size - 0.5, gap=8.0, pitch=pitch)
    made.show_rows(columns, heads, rows)
    made.fit_width(PAPER.px(BODY_WIDTH_PT))
    return made


def paged_table(
    form: ReportForm,
    columns: Sequence[TableColumn],
    heads: Sequence[str | Cell],
    rows: Sequence[Sequence[str | Cell]],
    size: float = 9.0,
    pitch: float = 3.0,
) -> list[Table]:
    """Return a table as one for each page that it needs, below the page's head and a title."""
    room = body_size(form)[1] - PAPER.px(HEAD_PT)
    ends = table(columns, heads, rows, size, pitch).row_ends_px()
    tables, first = list[Table](), 0
    while first < len(rows):
        start = ends[first] - ends[0]
        last = max(bisect_right(ends, room + start) - 1, first + 1)
        tables.append(table(columns, heads, rows[first:last], size, pitch))
        first = last
    return tables


def value_rows(lines: Sequence[tuple[str, str, str]]) -> QLayout:
    """Return rows of names and right-aligned values (name, value, token) for half the page."""
    rows: list[Part] = []
    for name, value, token in lines:
        named, shown = label(name, 8.5, REGULAR, "text2"), label(value, 8.5, MEDIUM, token)
        shown.setAlignment(Qt.AlignmentFlag.AlignRight)
        if named.sizeHint().width() + shown.sizeHint().width() + PAPER.px(8.0) > PAPER.px(0.5 * BODY_WIDTH_PT - 28.0):
            named.setWordWrap(True)
            shown.setWordWrap(True)
        rows.append(line((named, len(name)), (shown, len(value)), gap=8.0))
    return column(*rows, gap=2.5)


def break_lines(words: str, size: float, width: float) -> list[str]:
    """Break a text into lines of at most that width; a longer word is broken too."""
    found = []
    for part in words.splitlines():
        letters = part.encode("utf-16-le")  # as Qt counts them: a picture among letters is two
        lines = QTextLayout(part, PAPER.font(size, REGULAR))
        option = lines.textOption()
        option.setWrapMode(QTextOption.WrapMode.WrapAtWordBoundaryOrAnywhere)
        lines.setTextOption(option)
        lines.beginLayout()
        while (one := lines.createLine()).isValid():
            one.setLineWidth(PAPER.px(width))
            start, end = 2 * one.textStart(), 2 * (one.textStart() + one.textLength())
            found.append(letters[start:end].decode("utf-16-le").rstrip())
        lines.endLayout()
    return found


def legal_line() -> PlainText:
    """Return the legal sentence of every page."""
    return paragraph(terms.LEGAL_SENTENCE, 8.0, SEMIBOLD)


class RoundedBox(QWidget):
    """Column in a rounded frame, or on a filled ground."""

    def __init__(self, *parts: Part | float, fill: str = "") -> None:
        super().__init__()
        self._fill = fill
        column(*parts, within=self).setContentsMargins(*to_layout_units(11.0, 8.0, 11.0, 8.0))

    def paintEvent(self, event: QPaintEvent) -> None:
        painter, reach = QPainter(self), 0.4 * UNIT
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(QPen(PAPER.color(self._fill or "line"), 0.8 * UNIT))
        if self._fill:
            painter.setBrush(PAPER.color(self._fill))
        painter.drawRoundedRect(QRectF(self.rect()).adjusted(reach, reach, -reach, -reach), 6 * UNIT, 6 * UNIT)


class PaintedPart(QWidget):
    """Part that is painted, between ``min_height`` and ``max_height`` points high."""

    def __init__(
        self, paint: Callable[[QPainter, QRectF], None], min_height: float, max_height: float = 0.0, width: float = 0.0
    ) -> None:
        super().__init__()
        self._paint, self._height = paint, PAPER.px(max_height or min_height)
        self.setMinimumHeight(PAPER.px(min_height))
        self.setMaximumHeight(self._height)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        if width:
            self.setFixedWidth(PAPER.px(width))

    def sizeHint(self) -> QSize:
        return QSize(0, self._height)

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        self._paint(painter, QRectF(self.rect()))


def chart_part(
    make_chart: Callable[[Theme], Chart], min_height: float, max_height: float, style: PlotStyle = CHART
) -> PaintedPart:
    """Return a chart, made anew each time that it is painted, as a part."""

    def paint(painter: QPainter, box: QRectF) -> None:
        chart = make_chart(Theme("light"))
        chart.render_on_paper(painter, style, box)
        chart.deleteLater()

    return PaintedPart(paint, min_height, max_height)


class Report(Protocol):
    """Report that can be shown, printed and saved; its kind in a word is for the file name."""

    kind: ClassVar[Phrase]

    @property
    def form(self) -> ReportForm: ...

    @property
    def language(self) -> str:
        """Language by two letters; empty for the window's."""

    @property
    def pseudonym(self) -> str: ...

    @property
    def printed_patient(self) -> Patient | None:
        """Patient whose real name is printed beside the pseudonym; None for the pseudonym alone."""

    @property
    def sessions(self) -> Sequence[SessionResults]: ...

    def head(self, number: str) -> QLayout | None:
        """Return the head of a page, given its number in words; None for pages without one."""

    def pages(self) -> Sequence[QVBoxLayout]:
        """Return what each page has below its head."""


class Page:
    """Parts under the clinic's letterhead, scaled down if there is too much."""

    def __init__(self, form: ReportForm, body: QLayout, *, simulated: bool = False) -> None:
        """Lay the page out in the current language."""
        self._language = thread_language()
        self.size_pt = PAPER_PT[form.paper]
        self._watermark = tr("SIMULATED") if simulated else ""
        self._parts: list[tuple[QWidget, int, float]] = []
        top, (width, height) = PAPER.px(TOP_PT), body_size(form)
        if form.letterhead.is_set:
            top += self._place(_letterhead(form.letterhead), top, width, height)
        self._place(body, top, width, PAPER.px(self.size_pt[1] - FOOT_PT) - top, fills=True)

    def _place(self, layout: QLayout, top: int, width: int, height: int, *, fills: bool = False) -> int:
        """Lay parts out in their room and return the height they take."""
        host, share = fit_parts(layout, width, height)
        across = round(width / share)
        host.resize(across, round(height / share) if fills else layout.minimumHeightForWidth(across))
        self._parts.append((host, top, share))
        return round(share * host.height())

    @property
    def size_mm(self) -> QSizeF | None:
        """Size of the paper; None for A4, which Qt knows by name."""
        return None if self.size_pt == PAPER_PT["a4"] else QSizeF(*(25.4 / 72.0 * side for side in self.size_pt))

    def paint(self, painter: QPainter, point: float) -> None:
        """Paint the page with ``point`` painter units per point."""
        painter.save()
        painter.scale(point / UNIT, point / UNIT)
        if self._watermark:
            self._paint_watermark(painter)
        for part, top, share in self._parts:
            painter.save()
            painter.translate(PAPER.px(MARGIN_PT), top)
            painter.scale(share, share)
            with use_language(self._language):
                render_parts(part, painter)
            painter.restore()
        painter.restore()

    def _paint_watermark(self, painter: QPainter) -> None:
        """Paint SIMULATED across the page, so that no copy of it passes for a patient's."""
        painter.save()
        painter.translate(*(0.5 * UNIT * side for side in self.size_pt))
        painter.rotate(-55.0)
        painter.setFont(PAPER.font(96.0, SEMIBOLD))
        painter.setPen(PAPER.color("norm"))
        box = QRectF(-2000.0, -400.0, 4000.0, 800.0)
        painter.drawText(box, Qt.AlignmentFlag.AlignCenter, self._watermark)
        painter.restore()


def layout_pages(report: Report) -> list[Page]:
    """Lay the pages out in the report's language; call it in the window's thread only."""
    with use_language(report.language):
        laid_out, is_simulated = report.pages(), any(results.is_simulated for results in report.sessions)
        pages, count = [], len(laid_out)
        for number, page in enumerate(laid_out, 1):
            words = tr("page {number} of {count}").format(number=number, count=count) if count > 1 else ""
            if (head := report.head(words)) is not None:
                page.insertLayout(0, head)
            pages.append(Page(report.form, page, simulated=is_simulated))
        return pages


def body_size(form: ReportForm) -> tuple[int, int]:
    """Return width and height of a page between its margins, below a usual letterhead if there is one."""
    width, height = PAPER_PT[form.paper]
    head = LOGO_PT[1] + 12.0 if form.letterhead.is_set else 0.0
    across, down = to_layout_units(width - 2 * MARGIN_PT, height - TOP_PT - FOOT_PT - head)
    return across, down


def render_parts(host: QWidget, painter: QPainter) -> None:
    """Render an invisible widget's children."""
    painter.setRenderHints(QPainter.RenderHint.Antialiasing | QPainter.RenderHint.TextAntialiasing)
    host.render(painter, QPoint(), QRegion(), QWidget.RenderFlag.DrawChildren)


def fit_parts(layout: QLayout, width: int, height: int) -> tuple[QWidget, float]:
    """Lay parts out on a widget of their own and return the largest scale, up to 1, at which they fit."""
    host = QWidget()
    host.setLayout(layout)
    layout.setSizeConstraint(QLayout.SizeConstraint.SetNoConstraint)  # it would ask for the height of the least width

    def has_room(share: float) -> bool:
        across = round(width / share)
        return layout.minimumSize().width() <= across and layout.minimumHeightForWidth(across) <= height / share

    low, high = MIN_SCALE, 1.0
    if has_room(high):
        return host, high
    while high - low > 0.005:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if has_room(middle) else (low, middle)
    return host, low


def _letterhead(head: Letterhead) -> QLayout:
    words = column(STRETCH, *(paragraph(one, 11.5, SEMIBOLD) for one in (head.name,) if one))
    for one in head.address:
        words.addWidget(paragraph(one, 8.0, REGULAR, "text2"))
    words.addStretch(1)
    logo = QImage.fromData(head.logo_png) if head.logo_png else QImage()
    if logo.isNull():
        return column(words, 4.0, rule(), 8.0)
    share = min(LOGO_PT[0] / logo.width(), LOGO_PT[1] / logo.height())
    size = logo.width() * share, logo.height() * share
    picture = PaintedPart(lambda painter, box: painter.drawImage(box, logo), size[1], width=size[0])
    return column(line((picture, 0, Qt.AlignmentFlag.AlignTop), 12.0, (words, 1)), 4.0, rule(), 8.0)


# --- PDF --------------------------------------------------------------------------------------------------
# Paints a page, given painter units per point.
PaintPage = Callable[[QPainter, float], None]


def ensure_application() -> QApplication:
    """Return the running Qt application, or a new one without a screen; keep it while writing."""
    running = QGuiApplication.instance()
    application = running if isinstance(running, QApplication) else QApplication(["carpus", "-platform", "offscreen"])
    load_fonts()
    return application


def write_report(report: Report, output_path: Path) -> Path:
    """Write a report of any kind as PDF.

    Raises
    ------
    OutputExists, OutputNotWritable, DiskFull
            If the file cannot be written; no partial file is left.
    """
    application = ensure_application()
    content = report_pdf(layout_pages(report))
    del application
    return save_pdf(output_path, content)


def report_pdf(pages: Sequence[Page]) -> bytes:
    """Return pages as a PDF; call it in the window's thread only."""
    return pdf_bytes([(page.size_mm, page.paint) for page in pages], TITLE)


def save_pdf(output_path: Path, content: bytes) -> Path:
    """Save a PDF's content; raises the faults of :func:`write_report`."""
    require_folder(output_path)
    with open_new_file(output_path) as file:
        file.write(content)
    return output_path


def pdf_bytes(pages: Sequence[tuple[QSizeF | None, PaintPage]], title: str) -> bytes:
    """Return the PDF of pages (size in mm or None for A4, paint function)."""
    store = QByteArray()
    buffer = QBuffer(store)
    buffer.open(QIODevice.OpenModeFlag.WriteOnly)
    writer = QPdfWriter(buffer)
    writer.setResolution(RESOLUTION_DPI)
    writer.setPageLayout(_layout(pages[0][0]))
    writer.setTitle(title)
    writer.setCreator("Carpus")
    painter = QPainter(writer)
    try:
        for number, (size, paint) in enumerate(pages):
            if number:
                writer.setPageLayout(_layout(size))
                writer.newPage()
            paint(painter, RESOLUTION_DPI / POINTS_PER_INCH)
    finally:
        painter.end()  # a writer that goes while it is painted on ends the program
    buffer.close()
    return bytes(store.data())


def _layout(size_mm: QSizeF | None) -> QPageLayout:
    size = (
        QPageSize(QPageSize.PageSizeId.A4)
        if size_mm is None
        else QPageSize(size_mm, QPageSize.Unit.Millimeter, "", QPageSize.SizeMatchPolicy.ExactMatch)
    )
    return QPageLayout(size, QPageLayout.Orientation.Portrait, QMarginsF(0, 0, 0, 0))
