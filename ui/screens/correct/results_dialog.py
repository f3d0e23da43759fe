"""Dialog of a re-analysis: its progress, then how much old and new result differ."""

from __future__ import annotations

from PySide6.QtWidgets import QWidget

from carpus.ui.kit.button import Button
from carpus.ui.kit.dialog import Dialog
from carpus.ui.kit.layouts import STRETCH, fill, row_layout
from carpus.ui.kit.progress_bar import ThinProgressBar
from carpus.ui.kit.text import REGULAR, SEMIBOLD, Text
from carpus.ui.kit.theme import Theme


class ResultsDialog(Dialog):
    """Progress and result of a re-analysis.

    Only the user opens it. The focus is on the button that changes nothing, so Enter, Space and Esc decide nothing.
    """

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 720)
        self.title = Text(theme, "", 20, SEMIBOLD, wrap=True)
        self.session_label = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        self.words = Text(theme, "", 14, REGULAR, wrap=True)
        self.bar = ThinProgressBar(theme, self.tr("Progress of the re-analysis"))
        self.stop_button = Button(theme, self.tr("&Stop"), "plain", height_px=44)
        self.keep_button = Button(theme, self.tr("&Keep old result"), "plain", height_px=44)
        self.use_button = Button(theme, self.tr("&Use new result"), "plain", height_px=44)
        self.later_button = Button(theme, "", "plain", height_px=44)
        self.later_button.clicked.connect(self.close_dialog)
        self.set_default(self.later_button)
        body = self.card.body
        body.setSpacing(8)
        for widget in (self.title, self.session_label, self.bar, self.words):
            body.addWidget(widget)
        row = row_layout(self.stop_button, self.keep_button, self.use_button, STRETCH, self.later_button, gap=10)
        fill(body, 4, row)

    def show_running(self, session_label: str, percent: int) -> None:
        self._show_heading(self.tr("Re-analysing: {percent} %").format(percent=percent), session_label)
        self.bar.show_progress(percent, 100)
        self.words.setText(
            self.tr(
                "You can continue working. The old result stays until you choose the new one. “Stop” keeps the old "
                "result."
            )
        )
        self.later_button.set_label(self.tr("Continue working"))
        self._show_sections(is_running=True)

    def show_reading(self, session_label: str) -> None:
        self._show_heading(self.tr("Reading both results…"), session_label)
        self.words.setText("")
        self.later_button.set_label(self.tr("Decide later"))
        self._show_sections()

    def show_results(self, session_label: str, words: str) -> None:
        self._show_heading(self.tr("Use the new result?"), session_label)
        self.words.setText(words)
        self.later_button.set_label(self.tr("Decide later"))
        self._show_sections(is_ready=True)

    def _show_heading(self, title: str, whose: str) -> None:
        self.title.setText(title)
        self.session_label.setText(whose)
        self.setAccessibleName(f"{title} {whose}")

    def _show_sections(self, *, is_running: bool = False, is_ready: bool = False) -> None:
        self.bar.setVisible(is_running)
        self.stop_button.setVisible(is_running)
        self.keep_button.setVisible(is_ready)
        self.use_button.setVisible(is_ready)
        self.words.setVisible(bool(self.words.text()))
