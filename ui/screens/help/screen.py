"""Help screen: pages of the guide, shortcuts, cards to print."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import Qt, QUrl, Signal
from PySide6.QtGui import QKeyEvent, QResizeEvent
from PySide6.QtWidgets import QFileDialog, QFrame, QTextBrowser, QWidget

from carpus.core.model.errors import CarpusFault
from carpus.ui.kit.button import Button
from carpus.ui.kit.card import Card
from carpus.ui.kit.field import PageIndex
from carpus.ui.kit.keys import KEYS, action_words
from carpus.ui.kit.layouts import column_layout, row_layout
from carpus.ui.kit.text import Text, heading
from carpus.ui.kit.theme import GAP_PX, MARGIN_PX, Theme
from carpus.ui.screens.help import guide
from carpus.ui.words import terms

PICTURE_PX = 720


class HelpScreen(QWidget):
    """Help screen.

    Signals: ``fault_raised`` if the cards could not be saved.
    """

    fault_raised = Signal(object)

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self.page = guide.PAGES[0]
        self.start_folder = ""
        """Folder in which the save dialog starts."""
        self.back_button = Button(theme, self.tr("Back"), "primary", hint=self.tr("Esc"))
        self.cards_button = Button(theme, self.tr("Print cards…"), icon="download")
        self.cards_button.clicked.connect(self._choose_cards_file)
        self.tour_button = Button(theme, self.tr("&Guide me through a first session"), icon="arrow-right")
        self.page_view = _PageView(theme)
        self.page_view.page_requested.connect(self.show_page)
        self._names = (*guide.PAGES, guide.KEYS_PAGE)
        self.index = PageIndex([*map(guide.page_title, guide.PAGES), self.tr("Keys")])
        self.index.setAccessibleName(self.tr("Guide"))
        self.index.currentRowChanged.connect(lambda row: self.show_page(self._names[row]))
        head = row_layout((heading(theme, self.tr("Guide")), 1), self.tour_button, self.cards_button, self.back_button)
        card = Card(theme, 8)
        card.body.addWidget(self.page_view, 1)
        columns = row_layout(self.index, (card, 1), gap=GAP_PX)
        column_layout(
            head,
            (columns, 1),
            Text(theme, terms.legal_notice(), 12, token="text2", wrap=True),
            gap=12,
            margins=(MARGIN_PX, GAP_PX, MARGIN_PX, GAP_PX),
            parent=self,
        )
        theme.changed.connect(self._show_again)
        self._show_again()

    def initial_focus(self) -> QWidget:
        return self.page_view

    def _show_again(self) -> None:
        self.show_page(self.page)

    def show_page(self, name: str) -> None:
        self.page = name
        row = self._names.index(name)
        if row != self.index.currentRow():
            self.index.setCurrentRow(row)  # comes back here
            return
        if name == guide.KEYS_PAGE:
            actions: dict[str, list[str]] = {}  # screens may use a key differently
            for action, key in KEYS.items():
                actions.setdefault(key, []).append(action_words(action))
            rows = [(key, "\n".join(words)) for key, words in actions.items()]
            self.page_view.show_html(guide.keys_html(self.tr("Keys"), rows, self._theme))
        else:
            self.page_view.show_html(guide.page_html(name, self._theme, self._picture_px()))

    def _picture_px(self) -> int:
        return max(200, min(self._theme.px(PICTURE_PX), self.width() - self.index.sizeHint().width() - 120))

    def resizeEvent(self, event: QResizeEvent) -> None:
        if event.oldSize().width() != self.width():
            self._show_again()

    def _choose_cards_file(self) -> None:
        start = str(Path(self.start_folder) / guide.CARDS_FILE_NAME)
        path, _ = QFileDialog.getSaveFileName(self, self.tr("Save the cards"), start, "PDF (*.pdf)")
        if path:
            try:
                guide.write_cards(Path(path))
            except CarpusFault as fault:
                self.fault_raised.emit(fault)


class _PageView(QTextBrowser):
    """View of one page.

    Signals: ``page_requested`` with the page of a link.
    """

    page_requested = Signal(str)

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self.setOpenLinks(False)
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.document().setDocumentMargin(16)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.anchorClicked.connect(lambda url: self.page_requested.emit(url.toString()))

    def show_html(self, text: str) -> None:
        """Show a page from its top."""
        palette = self.palette()
        palette.setColor(palette.ColorRole.Base, self._theme.color("surface"))
        palette.setColor(palette.ColorRole.Text, self._theme.color("text"))
        self.setPalette(palette)
        self.setHtml(text)
        self.verticalScrollBar().setValue(0)

    def loadResource(self, kind: int, name: QUrl | str) -> object:
        """Load pictures from the guide only."""
        return super().loadResource(kind, QUrl.fromLocalFile(guide.picture_path(Path(QUrl(name).toString()).name)))

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape:
            event.ignore()
        else:
            super().keyPressEvent(event)
