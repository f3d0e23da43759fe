"""The report as it will be printed, and where it goes."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from pathlib import Path

from PySide6.QtCore import QMarginsF, QSize, Qt, QUrl, Signal
from PySide6.QtGui import QColor, QDesktopServices, QPageLayout, QPageSize, QPainter, QPicture, QPixmap
from PySide6.QtPrintSupport import QPrintDialog, QPrinter
from PySide6.QtWidgets import QFileDialog, QLabel, QScrollArea, QSizePolicy, QWidget

from carpus.core.durable import replace_file
from carpus.core.results.report_form import PAPER_PT
from carpus.ui.background import Background
from carpus.ui.controls.button import Button
from carpus.ui.controls.card import Card
from carpus.ui.controls.layouts import RING_PX, STRETCH, fill, in_column, in_line, scrolled
from carpus.ui.controls.text import REGULAR, SEMIBOLD, StateText, Text
from carpus.ui.keys import bind_screen
from carpus.ui.report.home_page import HomeReport
from carpus.ui.report.letter_page import LetterReport
from carpus.ui.report.page import Page
from carpus.ui.report.pages import Report, pages_of
from carpus.ui.report.panel import ReportPanel
from carpus.ui.report.pdf import POINTS_PER_INCH, report_pdf, store_pdf
from carpus.ui.report.progress_page import ProgressReport
from carpus.ui.report.session_page import SessionReport
from carpus.ui.theme import GAP_PX, MARGIN_PX, Theme
from carpus.ui.tour.bubble import BubbleView

WIDEST_PX = 980


class ReportScreen(QWidget):
    """Preview and saving. ``saved`` carries the path; ``letter_wanted`` and ``home_wanted`` the report that a
    letter or a sheet for home is to be made of; ``told`` a fault."""

    saved = Signal(str)
    letter_wanted = Signal(object)
    home_wanted = Signal(object)
    told = Signal(object)

    def __init__(self, theme: Theme, background: Background) -> None:
        super().__init__()
        self._theme, self._background = theme, background
        self._report: Report | None = None
        self._folder = ""
        self._name = ""
        self._saved: tuple[Report, str] | None = None
        self.page = PagePreview(theme)
        self.save_button = Button(theme, self.tr("Save PDF…"), "primary", icon="download", hint="Ctrl+P")
        self.bubble = BubbleView(theme)
        self.open_button = Button(theme, self.tr("Open the PDF"), "plain")
        self.print_button = Button(theme, self.tr("Print…"), "plain")
        self.letter_button = Button(theme, self.tr("Letter to the doctor…"), "plain")
        self.home_button = Button(theme, self.tr("Sheet for home…"), "plain", hint="Ctrl+H")
        self.back_button = Button(theme, self.tr("Back to the report"), "quiet")
        self.panel = ReportPanel(theme)
        self.state = StateText(theme, 16, SEMIBOLD, 20)
        self.where = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        self._lay_out()
        self.save_button.clicked.connect(self.ask_and_save)
        self.open_button.clicked.connect(self._open)
        self.print_button.clicked.connect(self.print_out)
        self.panel.changed.connect(self._show_changed)
        self.letter_button.clicked.connect(self._ask_letter)
        self.home_button.clicked.connect(self._ask_home)
        self.back_button.clicked.connect(self.to_report)
        bind_screen(self, {"report": self.save_button.click, "home_sheet": self.home_button.click})

    def _lay_out(self) -> None:
        self._scroll = QScrollArea()
        self._scroll.setWidget(self.page)
        self._scroll.setWidgetResizable(True)
        self._scroll.setAccessibleName(self.tr("Preview of the report"))
        card = Card(self._theme, 24)
        self._card = card
        card.body.setSpacing(12)
        fill(
            card.body,
            self.state,
            self.bubble,
            self.save_button,
            self.print_button,
            self.letter_button,
            self.home_button,
            self.back_button,
            self.open_button,
            self.where,  # what comes with the saved file pushes no button away
        )
        self.pages = Text(self._theme, "", 14, REGULAR, "text2", wrap=True)
        fill(card.body, self.pages, 8, self.panel)
        host = in_column(card, STRETCH)
        self._side = scrolled(host)
        in_line((self._scroll, 1), self._side, gap=GAP_PX, margins=(MARGIN_PX, GAP_PX, MARGIN_PX, 0), within=self)
        self._theme.changed.connect(self._fit)
        self._fit()

    def _fit(self) -> None:
        self._card.setFixedWidth(self._theme.px(320))
        bar = self._side.verticalScrollBar().sizeHint().width()
        self._side.setFixedWidth(self._theme.px(320) + 2 * RING_PX + bar)

    # --- life ---------------------------------------------------------------------------------------------
    def begin(self, report: Report, folder: str) -> None:
        """Show a report; ``folder`` is where saving starts."""
        self._report, self._folder = report, folder
        self._name = suggested_name(report)
        self.panel.setVisible(isinstance(report, SessionReport))
        self.letter_button.setVisible(isinstance(report, SessionReport))
        self.home_button.setVisible(isinstance(report, SessionReport))
        self.back_button.setVisible(isinstance(report, LetterReport | HomeReport))
        if isinstance(report, SessionReport):
            self.panel.begin(report)
        self._show_pages(report)
        self._scroll.verticalScrollBar().setValue(0)
        self._show_saved()
        self.save_button.setFocus(Qt.FocusReason.OtherFocusReason)

    def _show_changed(self, report: Report) -> None:
        self._report = report
        self._show_saved()
        self._show_pages(report)

    def _show_pages(self, report: Report) -> None:
        self.page.show_pages(pages_of(report))
        count = len(self.page.pages)
        if report.form.paper == "letter":
            pages = self.tr("One page of US Letter") if count == 1 else self.tr("{count} pages of US Letter")
        else:
            pages = self.tr("One page of A4") if count == 1 else self.tr("{count} pages of A4")
        pages = pages.format(count=count)
        words = self.tr("{pages}, readable in grey. It carries the made-up name, never a real one.")
        if isinstance(report, LetterReport) and report.real_name:
            words = self.tr("{pages}, readable in grey. It carries the patient’s real name: mind where you save it.")
        self.pages.setText(words.format(pages=pages))

    @property
    def shown(self) -> Report | None:
        return self._report

    def _show_saved(self) -> None:
        """Where what is shown lies as a file, also after a letter or a sheet that was made of it."""
        path = self._saved[1] if self._saved is not None and self._saved[0] is self._report else ""
        words = self.tr("Saved") if path else self.tr("Not saved yet")
        self.state.show_state("good" if path else "none", words, icon="file-text", token="text")
        self.where.say(path)
        self.open_button.setVisible(bool(path))

    def ask_and_save(self) -> None:
        start = str(Path(self._folder) / self._name)
        path, _ = QFileDialog.getSaveFileName(self, self.tr("Save report"), start, self.tr("PDF (*.pdf)"))
        if path:
            self.save(path, replace_asked=True)

    def _ask_letter(self) -> None:
        self.panel.keep_comment()
        if isinstance(self._report, SessionReport):
            self.letter_wanted.emit(self._report)

    def _ask_home(self) -> None:
        if isinstance(self._report, SessionReport):
            self.home_wanted.emit(self._report)

    def to_report(self) -> bool:
        """Back from a letter or sheet to the report it was made of; whether there was one."""
        if not isinstance(self._report, LetterReport | HomeReport):
            return False
        self.begin(self._report.report, self._folder)
        return True

    def print_out(self) -> None:
        self.panel.keep_comment()
        if self._report is None:
            return
        printer = printer_for(self._report, len(self.page.pages))
        if QPrintDialog(printer, self).exec():
            print_on(printer, self.page.pages)
            if printer.outputFileName():  # printed into a file, which goes with the session when that is erased
                self._done(self._report, printer.outputFileName())

    def save(self, path: str, *, replace_asked: bool = False) -> None:
        """Write the PDF beside the window's thread. The file dialog has asked before something is replaced."""
        self.panel.keep_comment()
        report = self._report
        if report is None:
            return
        target = Path(path if path.lower().endswith(".pdf") else f"{path}.pdf")
        if self.window().focusWidget() is self.save_button:
            self.setFocus(Qt.FocusReason.OtherFocusReason)  # a button that goes grey hands it to the next one: Print
        self.save_button.setEnabled(False)
        content = report_pdf(self.page.pages)  # widgets live here; the disk may take its time elsewhere
        self._background.run(
            partial(_written, content, target, replace_asked),
            lambda done: self._done(report, str(done)),
            self._failed,
            self,
        )

    def _done(self, report: Report, path: str) -> None:
        self._save_again()
        self._saved = report, path
        self._show_saved()
        self.saved.emit(path)

    def _failed(self, fault: Exception) -> None:
        self._save_again()
        self.told.emit(fault)

    def _save_again(self) -> None:
        self.save_button.setEnabled(True)
        if self.window().focusWidget() is self:
            self.save_button.setFocus(Qt.FocusReason.OtherFocusReason)

    def _open(self) -> None:
        QDesktopServices.openUrl(QUrl.fromLocalFile(self.where.text()))


def suggested_name(report: Report) -> str:
    """``Linden-42_2026-11-20_15-29_wrist-fe_report.pdf``: the made-up name, when, and what was done."""
    name, when = report.pseudonym.replace(" ", "-"), max(figures.when for figures in report.sessions)
    if isinstance(report, ProgressReport):
        return f"{name}_{when:%Y-%m-%d}_{report.kind}.pdf"
    what = report.sessions[0].exercise.id.lower().replace("_", "-")
    return f"{name}_{when:%Y-%m-%d_%H-%M}_{what}_{report.kind}.pdf"


def _written(content: bytes, target: Path, replace_asked: bool) -> Path:
    """Put in the place of an old file only where the person has agreed to that."""
    if replace_asked and target.exists():
        replace_file(target, lambda place: store_pdf(place, content))
    else:
        store_pdf(target, content)
    return target


class PagePreview(QWidget):
    """The pages as wide as the room, one under the other on the canvas."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self.pages: list[Page] = []
        self._sheets: list[QLabel] = []
        policy = QSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        policy.setHeightForWidth(True)
        self.setSizePolicy(policy)
        theme.changed.connect(self._lay_out)

    def show_pages(self, pages: list[Page]) -> None:
        self.pages = pages
        self._lay_out()

    def _page_size(self, width: int) -> QSize:
        paper = self.pages[0].size_pt if self.pages else PAPER_PT["a4"]
        wide = min(width - 16, round(WIDEST_PX * self._theme.text_scale))
        return QSize(wide, round(wide * paper[1] / paper[0]))

    def hasHeightForWidth(self) -> bool:
        return True

    def heightForWidth(self, width: int) -> int:
        return max(len(self.pages), 1) * (self._page_size(width).height() + GAP_PX)

    def sizeHint(self) -> QSize:
        return QSize(800, self.heightForWidth(max(self.width(), 400)))

    def minimumSizeHint(self) -> QSize:
        return QSize(360, self.heightForWidth(max(self.width(), 360)))

    def resizeEvent(self, event) -> None:  # type: ignore[no-untyped-def]
        self._lay_out()

    def showEvent(self, event) -> None:  # type: ignore[no-untyped-def]
        self._lay_out()

    def _lay_out(self) -> None:
        """Paint each page anew, where anybody sees it."""
        self.updateGeometry()
        if not self.pages or not self.isVisible():
            return
        size = self._page_size(self.width())
        while len(self._sheets) < len(self.pages):
            self._sheets.append(QLabel(self))
        for number, sheet in enumerate(self._sheets):
            sheet.setVisible(number < len(self.pages))
            left, top = (self.width() - size.width()) // 2, number * (size.height() + GAP_PX)
            sheet.setGeometry(left, top, size.width(), size.height())
            if number < len(self.pages):
                sheet.setPixmap(self._painted(self.pages[number], size))

    def _painted(self, page: Page, size: QSize) -> QPixmap:
        ratio = self.devicePixelRatioF()
        picture = QPixmap(size * ratio)
        picture.setDevicePixelRatio(ratio)
        picture.fill(QColor("#FFFFFF"))
        painter = QPainter(picture)
        page.paint(painter, size.width() / page.size_pt[0])
        painter.setPen(self._theme.color("line"))
        painter.drawRect(0, 0, size.width() - 1, size.height() - 1)
        painter.end()
        return picture


SIZES = {"a4": QPageSize.PageSizeId.A4, "letter": QPageSize.PageSizeId.Letter}
NAME = "Carpus report"
"""What a printer's list of jobs shows: nobody's name."""


def printer_for(report: Report, count: int) -> QPrinter:
    """The usual printer, set to the paper of a report with so many pages."""
    printer = QPrinter(QPrinter.PrinterMode.HighResolution)
    size = QPageSize(SIZES[report.form.paper])
    printer.setPageLayout(QPageLayout(size, QPageLayout.Orientation.Portrait, QMarginsF(0, 0, 0, 0)))
    printer.setFullPage(True)
    printer.setDocName(NAME)
    printer.setFromTo(1, count)
    return printer


def print_on(printer: QPrinter, pages: Sequence[Page]) -> None:
    """Print the pages that were asked for, smaller where the printer has other paper than the report."""
    first = max(printer.fromPage(), 1)
    last = printer.toPage() or len(pages)
    printer.setFullPage(True)
    there = printer.pageLayout().pageSize().size(QPageSize.Unit.Point)
    width, height = pages[0].size_pt
    share = min(1.0, there.width() / (width - 1.0), there.height() / (height - 1.0))
    painter = QPainter()
    if not painter.begin(printer):
        return
    try:
        for number, page in enumerate(pages[first - 1 : last]):
            if number:
                printer.newPage()
            picture = QPicture()  # onto a printer itself Qt paints a widget as an image
            with QPainter(picture) as recorder:
                page.paint(recorder, share * picture.logicalDpiX() / POINTS_PER_INCH)
            painter.drawPicture(0, 0, picture)
    finally:
        painter.end()
