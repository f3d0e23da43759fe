"""Progress bar."""

from __future__ import annotations

from PySide6.QtWidgets import QProgressBar

from carpus.ui.kit.theme import Theme


class ThinProgressBar(QProgressBar):
    """Thin progress bar; busy until the first progress is known."""

    def __init__(self, theme: Theme, name: str) -> None:
        super().__init__()
        self._theme = theme
        self.setTextVisible(False)
        self.setAccessibleName(name)
        self.setFixedHeight(8)
        theme.changed.connect(self._apply_theme)
        self._apply_theme()

    def show_busy(self) -> None:
        self.setRange(0, 0)

    def show_progress(self, done: int, total: int) -> None:
        self.setRange(0, max(total, 1))
        self.setValue(done)

    def _apply_theme(self) -> None:
        tokens = self._theme.tokens
        bar = f"QProgressBar {{ background: {tokens.sunken}; border: 0; border-radius: 4px; height: 8px; }}"
        chunk = f" QProgressBar::chunk {{ background: {tokens.accent}; border-radius: 4px; }}"
        self.setStyleSheet(bar + chunk)
