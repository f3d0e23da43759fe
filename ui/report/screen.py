"""The report as it will be printed, and where it goes."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QSize, Qt, QUrl, Signal
from PySide6.QtGui import QColor, QDesktopServices, QPainter, QPaintEvent, QPixmap
from PySide6.QtWidgets import QFileDialog, QHBoxLayout, QScrollArea, QSizePolicy, QVBoxLayout, QWidget

from ui.background import Background
from ui.controls.button import Button
from ui.controls.card import Card
from ui.controls.text import REGULAR, SEMIBOLD, StateText, Text
from ui.keys import Keys, bind
from ui.report.page import A4_PT, Page
from ui.report.pdf import write_progress_report, write_session_report
from ui.report.progress_page import ProgressReport, paint_progress_page
from ui.report.session_page import SessionReport, paint_session_page
from ui.theme import GAP_PX, MARGIN_PX, Theme

WIDEST_PX = 980
Report = SessionReport | ProgressReport


class ReportScreen(QWidget):
    """Preview and saving. ``saved`` carries the path; ``told`` a fault."""

    saved = Signal(str)
    told = Signal(object)

    def __init__(self, theme: Theme, keys: Keys, background: Background) -> None:
        super().__init__()
        self._theme, self._background = theme, background
        self._report: Report | None = None
        self._folder = ""
        self._name = ""
        self._saved_path = ""
        self.page = PagePreview(theme)
        self.save_button = Button(theme, self.tr("Save PDF…"), "primary", icon="download", hint="Ctrl+P")
        self.open_button = Button(theme, self.tr("Open the PDF"), "plain")
        self.state = StateText(theme, 16, SEMIBOLD, 20)
        self.where = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        self._lay_out()
        self.save_button.clicked.connect(self.ask_and_save)
        self.open_button.clicked.connect(self._open)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setProperty("shows_own_focus", True)
        bind(self, keys, "report", self.save_button.click)

    def _lay_out(self) -> None:
        self._scroll = QScrollArea()
        self._scroll.setWidget(self.page)
        self._scroll.setWidgetResizable(True)
        self._scroll.setAccessibleName(self.tr("Preview of the report"))
        card = Card(self._theme, 24)
        self._card = card
        card.body.setSpacing(12)
        card.body.addWidget(self.state)
        card.body.addWidget(self.where)
        card.body.addWidget(self.save_button)
        card.body.addWidget(self.open_button)
        card.body.addSpacing(8)
        words = self.tr("One page of A4, readable in grey. It carries the made-up name, never a real one.")
        card.body.addWidget(Text(self._theme, words, 14, REGULAR, "text2", wrap=True))
        right = QVBoxLayout()
        right.addWidget(card)
        right.addStretch(1)
        columns = QHBoxLayout(self)
        columns.setContentsMargins(MARGIN_PX, GAP_PX, MARGIN_PX, 0)
        columns.setSpacing(GAP_PX)
        columns.addWidget(self._scroll, 1)
        columns.addLayout(right)
        self._theme.changed.connect(self._fit)
        self._fit()

    def _fit(self) -> None:
        self._card.setFixedWidth(self._theme.px(320))

    # --- life ---------------------------------------------------------------------------------------------
    def begin(self, report: Report, folder: str) -> None:
        """Show a report; ``folder`` is where saving starts."""
        self._report, self._folder = report, folder
        self._name = suggested_name(report)
        self._saved_path = ""
        self.page.show_report(report)
        self._show_state("none", self.tr("Not saved yet"), "")
        self.save_button.setFocus(Qt.FocusReason.OtherFocusReason)

    def _show_state(self, state: str, words: str, where: str) -> None:
        self.state.show_state(state, words, icon="file-text", token="text")  # type: ignore[arg-type]
        self.where.setText(where)
        self.where.setVisible(bool(where))
        self.open_button.setVisible(bool(self._saved_path))

    def ask_and_save(self) -> None:
        """Ask for a name, then save."""
        start = str(Path(self._folder) / self._name)
        path, _ = QFileDialog.getSaveFileName(self, self.tr("Save report"), start, self.tr("PDF (*.pdf)"))
        if path:
            self.save(path, replace_asked=True)

    def save(self, path: str, *, replace_asked: bool = False) -> None:
        """Write the PDF beside the window's thread. The file dialog has asked before something is replaced."""
        report = self._report
        if report is None:
            return
        target = Path(path if path.lower().endswith(".pdf") else f"{path}.pdf")
        self.save_button.setEnabled(False)
        write: Callable[[], Path] = lambda: _written(report, target, replace_asked)  # noqa: E731
        self._background.run(write, lambda done: self._done(str(done)), self._failed, self)

    def _done(self, path: str) -> None:
        self.save_button.setEnabled(True)
        self._saved_path = path
        self._show_state("good", self.tr("Saved"), path)
        self.saved.emit(path)

    def _failed(self, fault: Exception) -> None:
        self.save_button.setEnabled(True)
        self.told.emit(fault)

    def _open(self) -> None:
        QDesktopServices.openUrl(QUrl.fromLocalFile(self._saved_path))


def suggested_name(report: Report) -> str:
    """``Linden-42_2026-11-20_report.pdf``: the made-up name and the day."""
    if isinstance(report, SessionReport):
        when, kind = report.figures.when, "report"
    else:
        when, kind = report.progress.points[-1].figures.when, "progress"
    return f"{report.pseudonym.replace(' ', '-')}_{when:%Y-%m-%d}_{kind}.pdf"


def _written(report: Report, target: Path, replace_asked: bool) -> Path:
    """Write beside an old file first, so that a fault never costs it."""
    part = target.with_name(f".{target.name}.part")
    part.unlink(missing_ok=True)
    place = part if replace_asked and target.exists() else target
    if isinstance(report, SessionReport):
        write_session_report(report, place)
    else:
        write_progress_report(report, place)
    if place != target:
        place.replace(target)
    return target


class PagePreview(QWidget):
    """One page as wide as the room, on the canvas."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._report: Report | None = None
        self._still: QPixmap | None = None
        policy = QSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        policy.setHeightForWidth(True)
        self.setSizePolicy(policy)
        theme.changed.connect(self._forget)

    def show_report(self, report: Report) -> None:
        """Show another page."""
        self._report = report
        self._forget()

    def _forget(self) -> None:
        self._still = None
        self.updateGeometry()
        self.update()

    def _page_width(self, width: int) -> int:
        return min(width - 16, round(WIDEST_PX * self._theme.text_scale))

    def hasHeightForWidth(self) -> bool:
        return True

    def heightForWidth(self, width: int) -> int:
        return round(self._page_width(width) * A4_PT[1] / A4_PT[0]) + GAP_PX

    def sizeHint(self) -> QSize:
        return QSize(800, self.heightForWidth(max(self.width(), 400)))

    def minimumSizeHint(self) -> QSize:
        return QSize(360, self.heightForWidth(max(self.width(), 360)))

    def resizeEvent(self, event) -> None:  # type: ignore[no-untyped-def]
        self._forget()

    def paintEvent(self, event: QPaintEvent) -> None:
        if self._report is None:
            return
        if self._still is None:
            self._still = self._paint_still(self._report)
        painter = QPainter(self)
        left = (self.width() - self._still.width() / self._still.devicePixelRatio()) / 2
        painter.drawPixmap(round(left), 0, self._still)
        painter.setPen(self._theme.color("line"))
        page = self._still.deviceIndependentSize()
        painter.drawRect(round(left), 0, round(page.width()) - 1, round(page.height()) - 1)

    def _paint_still(self, report: Report) -> QPixmap:
        ratio = self.devicePixelRatioF()
        width = self._page_width(self.width())
        height = width * A4_PT[1] / A4_PT[0]
        picture = QPixmap(round(width * ratio), round(height * ratio))
        picture.setDevicePixelRatio(ratio)
        picture.fill(QColor("#FFFFFF"))
        painter = QPainter(picture)
        page = Page(painter, width / A4_PT[0])
        if isinstance(report, SessionReport):
            paint_session_page(page, report)
        else:
            paint_progress_page(page, report)
        painter.end()
        return picture
