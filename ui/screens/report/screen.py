"""Report preview, and where it is saved and printed."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path

from PySide6.QtCore import QMarginsF, QSize, Qt, QUrl, Signal, SignalInstance
from PySide6.QtGui import QColor, QDesktopServices, QPageLayout, QPageSize, QPainter, QPicture, QPixmap
from PySide6.QtPrintSupport import QPrintDialog, QPrinter
from PySide6.QtWidgets import QFileDialog, QLabel, QScrollArea, QSizePolicy, QWidget

from carpus.core.platform.durable import replace_file
from carpus.core.records.session_list import to_file_name
from carpus.core.results.report_form import PAPER_PT
from carpus.ui.kit.background import Background
from carpus.ui.kit.button import Button
from carpus.ui.kit.card import Card
from carpus.ui.kit.keys import bind_screen_keys
from carpus.ui.kit.layouts import RING_PX, STRETCH, column_layout, fill, row_layout, scroll_column
from carpus.ui.kit.text import REGULAR, SEMIBOLD, StateText, Text
from carpus.ui.kit.theme import GAP_PX, MARGIN_PX, Theme
from carpus.ui.kit.translate import translate_phrase
from carpus.ui.report.home_page import HomeReport
from carpus.ui.report.letter_page import LetterReport
from carpus.ui.report.page import POINTS_PER_INCH, Page, Report, layout_pages, report_pdf, save_pdf
from carpus.ui.report.progress_page import ProgressReport
from carpus.ui.report.session_page import SessionReport
from carpus.ui.screens.report.panel import ReportPanel
from carpus.ui.screens.tour.bubble import BubbleView

MAX_PAGE_PX = 980


class ReportScreen(QWidget):
    """Preview of a report.

    Emits ``saved`` and ``sent`` (path), ``letter_requested`` and ``home_sheet_requested`` (report), ``send_requested``
    (session report, for the practice system), ``fault_raised``.
    """

    saved = Signal(str)
    sent = Signal(str)
    letter_requested = Signal(object)
    home_sheet_requested = Signal(object)
    fault_raised = Signal(object)
    send_requested = Signal(object)

    def __init__(self, theme: Theme, background: Background) -> None:
        super().__init__()
        self._theme, self._background = theme, background
        self.report: Report | None = None
        self._folder = ""
        self._name = ""
        self._saved_report: tuple[Report, str] | None = None
        self.preview = PagePreview(theme)
        self.save_button = Button(theme, self.tr("Save PDF…"), "primary", icon="download", hint="Ctrl+P")
        self.bubble = BubbleView(theme)
        self.open_button = Button(theme, self.tr("Open the PDF"), "plain")
        self.print_button = Button(theme, self.tr("Print…"), "plain")
        self.letter_button = Button(theme, self.tr("Letter to the doctor…"), "plain")
        self.home_button = Button(theme, self.tr("Home exercise sheet…"), "plain", hint="Ctrl+H")
        self.send_button = Button(theme, self.tr("Send to clinic software"), "plain")
        self.can_send: Callable[[], bool] = lambda: False
        """Returns whether a practice system waits for the result of this patient."""
        self.back_button = Button(theme, self.tr("Back to the report"), "quiet")
        self.panel = ReportPanel(theme)
        self.save_state = StateText(theme, 16, SEMIBOLD, 20)
        self.path_text = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        self._build_layout()
        self.save_button.clicked.connect(self.save_with_dialog)
        self.open_button.clicked.connect(self._open)
        self.print_button.clicked.connect(self.print_report)
        self.panel.changed.connect(self._show_changed)
        self.letter_button.clicked.connect(lambda: self._request(self.letter_requested))
        self.home_button.clicked.connect(lambda: self._request(self.home_sheet_requested))
        self.send_button.clicked.connect(lambda: self._request(self.send_requested))
        self.send_requested.connect(lambda _: self.send_button.setEnabled(False))
        self.back_button.clicked.connect(self.show_parent_report)
        bind_screen_keys(self, {"report": self.save_button.click, "home_sheet": self.home_button.click})

    def _build_layout(self) -> None:
        self._scroll = QScrollArea()
        self._scroll.setWidget(self.preview)
        self._scroll.setWidgetResizable(True)
        self._scroll.setAccessibleName(self.tr("Preview of the report"))
        card = Card(self._theme, 24)
        self._card = card
        card.body.setSpacing(12)
        fill(
            card.body,
            self.save_state,
            self.bubble,
            self.save_button,
            self.print_button,
            self.letter_button,
            self.home_button,
            self.send_button,
            self.back_button,
            self.open_button,
            self.path_text,  # what comes with the saved file pushes no button away
        )
        self.pages_text = Text(self._theme, "", 14, REGULAR, "text2", wrap=True)
        fill(card.body, self.pages_text, 8, self.panel)
        host = column_layout(card, STRETCH)
        self._side = scroll_column(host)
        row_layout((self._scroll, 1), self._side, gap=GAP_PX, margins=(MARGIN_PX, GAP_PX, MARGIN_PX, 0), parent=self)
        self._theme.changed.connect(self._fit)
        self._fit()

    def _fit(self) -> None:
        self._card.setFixedWidth(self._theme.px(320))
        bar = self._side.verticalScrollBar().sizeHint().width()
        self._side.setFixedWidth(self._theme.px(320) + 2 * RING_PX + bar)

    # --- life ---------------------------------------------------------------------------------------------
    def show_report(self, report: Report, folder: str) -> None:
        """Show a report; ``folder`` is where saving starts."""
        self.report, self._folder = report, folder
        self._name = default_file_name(report)
        self.panel.setVisible(isinstance(report, SessionReport))
        self.letter_button.setVisible(isinstance(report, SessionReport))
        self.home_button.setVisible(isinstance(report, SessionReport))
        is_measured = isinstance(report, SessionReport) and not report.results.is_simulated
        self.send_button.setVisible(is_measured and self.can_send())
        self.back_button.setVisible(isinstance(report, LetterReport | HomeReport))
        if isinstance(report, SessionReport):
            self.panel.show_report(report)
        self._show_pages(report)
        self._scroll.verticalScrollBar().setValue(0)
        self._show_saved()
        self.save_button.setFocus(Qt.FocusReason.OtherFocusReason)

    def _show_changed(self, report: Report) -> None:
        self.report = report
        self._show_saved()
        self._show_pages(report)

    def _show_pages(self, report: Report) -> None:
        self.preview.show_pages(layout_pages(report))
        count = len(self.preview.pages)
        if report.form.paper == "letter":
            pages = self.tr("One page of US Letter") if count == 1 else self.tr("{count} pages of US Letter")
        else:
            pages = self.tr("One page of A4") if count == 1 else self.tr("{count} pages of A4")
        pages = pages.format(count=count)
        words = self.tr("{pages}, readable in black and white. Contains the pseudonym, not the real name.")
        if report.printed_patient is not None and report.printed_patient.name:
            words = self.tr(
                "{pages}, readable in black and white. Contains the patient’s real name: store it securely."
            )
        self.pages_text.setText(words.format(pages=pages))

    def _show_saved(self) -> None:
        """Show the path of the report if it was saved, also after a letter was made of it."""
        path = self._saved_report[1] if self._saved_report is not None and self._saved_report[0] is self.report else ""
        words = self.tr("Saved") if path else self.tr("Not saved yet")
        self.save_state.show_state("good" if path else "none", words, icon="file-text", token="text")
        self.path_text.show_text(path)
        self.open_button.setVisible(bool(path))

    def save_with_dialog(self) -> None:
        start = str(Path(self._folder) / self._name)
        path, _ = QFileDialog.getSaveFileName(self, self.tr("Save report"), start, self.tr("PDF (*.pdf)"))
        if path:
            self.save(path, may_replace=True)

    def _request(self, requested: SignalInstance) -> None:
        """Ask for what is made of a session's report, with the comment as it is typed."""
        self.panel.save_comment()
        if isinstance(self.report, SessionReport):
            requested.emit(self.report)

    def show_sent(self, report: Report, path: str) -> None:
        """Show that the practice system has the report; an empty path that it could not be sent."""
        self.send_button.setEnabled(True)
        if path:
            self._saved_report = report, path
            self._show_saved()
            self.sent.emit(path)

    def show_parent_report(self) -> bool:
        """Return from a letter or home sheet to its report; False if there is none."""
        if not isinstance(self.report, LetterReport | HomeReport):
            return False
        self.show_report(self.report.report, self._folder)
        return True

    def print_report(self) -> None:
        self.panel.save_comment()
        if self.report is None:
            return
        printer = make_printer(self.report, len(self.preview.pages))
        if QPrintDialog(printer, self).exec():
            print_pages(printer, self.preview.pages)
            if printer.outputFileName():  # printed into a file, which goes with the session when that is erased
                self._finish_saving(self.report, printer.outputFileName())

    def save(self, path: str, *, may_replace: bool = False) -> None:
        """Write the PDF in the background; the file dialog has asked before replacing a file."""
        self.panel.save_comment()
        report = self.report
        if report is None:
            return
        target = Path(path if path.lower().endswith(".pdf") else f"{path}.pdf")
        if self.window().focusWidget() is self.save_button:
            self.setFocus(Qt.FocusReason.OtherFocusReason)  # a button that goes grey hands it to the next one: Print
        self.save_button.setEnabled(False)
        content = report_pdf(self.preview.pages)  # widgets live here; the disk may take its time elsewhere
        self._background.run(
            partial(_write_file, content, target, may_replace),
            lambda done: self._finish_saving(report, str(done)),
            self._report_failure,
            self,
        )

    def _finish_saving(self, report: Report, path: str) -> None:
        self._enable_saving()
        self._saved_report = report, path
        self._show_saved()
        self.saved.emit(path)

    def _report_failure(self, fault: Exception) -> None:
        self._enable_saving()
        self.fault_raised.emit(fault)

    def _enable_saving(self) -> None:
        self.save_button.setEnabled(True)
        if self.window().focusWidget() is self:
            self.save_button.setFocus(Qt.FocusReason.OtherFocusReason)

    def _open(self) -> None:
        QDesktopServices.openUrl(QUrl.fromLocalFile(self.path_text.text()))


def default_file_name(report: Report) -> str:
    """Return ``Linden-42_2026-11-20_15-29_wrist-fe_report.pdf``: pseudonym, time and content."""
    name, when = to_file_name(report.pseudonym) or "patient", max(results.when for results in report.sessions)
    kind = translate_phrase(report.kind)
    if isinstance(report, ProgressReport):
        return f"{name}_{when:%Y-%m-%d}_{kind}.pdf"
    what = report.sessions[0].exercise.id.lower().replace("_", "-")
    return f"{name}_{when:%Y-%m-%d_%H-%M}_{what}_{kind}.pdf"


def _write_file(content: bytes, target: Path, may_replace: bool) -> Path:
    """Write the file; replace an old one only if the person has agreed."""
    if may_replace and target.exists():
        replace_file(target, lambda place: save_pdf(place, content))
    else:
        save_pdf(target, content)
    return target


class PagePreview(QWidget):
    """The pages as wide as the room, one below the other."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self.pages: list[Page] = []
        self._sheets: list[QLabel] = []
        policy = QSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        policy.setHeightForWidth(True)
        self.setSizePolicy(policy)
        theme.changed.connect(self._update_pages)

    def show_pages(self, pages: list[Page]) -> None:
        self.pages = pages
        self._update_pages()

    def _page_size(self, width: int) -> QSize:
        paper = self.pages[0].size_pt if self.pages else PAPER_PT["a4"]
        wide = min(width - 16, round(MAX_PAGE_PX * self._theme.text_scale))
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
        self._update_pages()

    def showEvent(self, event) -> None:  # type: ignore[no-untyped-def]
        self._update_pages()

    def _update_pages(self) -> None:
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
                sheet.setPixmap(self._paint_page(self.pages[number], size))

    def _paint_page(self, page: Page, size: QSize) -> QPixmap:
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


PAGE_SIZES = {"a4": QPageSize.PageSizeId.A4, "letter": QPageSize.PageSizeId.Letter}
# Shown in the printer's job list, so without a name.
PRINT_JOB_NAME = "Carpus report"


def make_printer(report: Report, count: int) -> QPrinter:
    """Return the default printer, set to the paper of a report with so many pages."""
    printer = QPrinter(QPrinter.PrinterMode.HighResolution)
    size = QPageSize(PAGE_SIZES[report.form.paper])
    printer.setPageLayout(QPageLayout(size, QPageLayout.Orientation.Portrait, QMarginsF(0, 0, 0, 0)))
    printer.setFullPage(True)
    printer.setDocName(PRINT_JOB_NAME)
    printer.setFromTo(1, count)
    return printer


def print_pages(printer: QPrinter, pages: Sequence[Page]) -> None:
    """Print the selected pages, scaled down if the printer has smaller paper."""
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
