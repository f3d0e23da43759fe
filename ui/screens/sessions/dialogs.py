"""Dialogs for excluding a session and for choosing from a list."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QHBoxLayout, QLineEdit, QWidget

from carpus.ui.kit.button import Button
from carpus.ui.kit.dialog import Dialog
from carpus.ui.kit.field import Combo
from carpus.ui.kit.layouts import STRETCH, row_layout
from carpus.ui.kit.theme import Theme


class ExcludeDialog(Dialog):
    """Reason for excluding a session.

    Signals: ``reason_given``.
    """

    reason_given = Signal(str)

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 600)
        words = self.tr(
            "The session stays in the list and can be opened, but is excluded from analysis. You can include it again."
        )
        self.add_heading(self.tr("Exclude this session?"), words)
        quick = QHBoxLayout()
        self.buttons: list[Button] = []
        for reason in (self.tr("wrong exercise"), self.tr("practice run"), self.tr("markers lost"), self.tr("pain")):
            button = Button(theme, reason, "plain", height_px=40)
            button.clicked.connect(lambda _=False, reason=reason: self._accept(reason))
            quick.addWidget(button)
            self.buttons.append(button)
        quick.addStretch(1)
        self.card.body.addLayout(quick)
        self.reason_field = QLineEdit(placeholderText=self.tr("Another reason"))
        self.reason_field.setAccessibleName(self.tr("Another reason"))
        self.accept_button = Button(theme, self.tr("Exclude"), "plain")
        self.accept_button.clicked.connect(lambda: self._accept(self.reason_field.text().strip()))
        self.reason_field.textChanged.connect(self._on_reason_edited)
        self.card.body.addWidget(self.reason_field)
        self.close_button = Button(theme, self.tr("Cancel"), "plain")
        self.close_button.clicked.connect(self.close_dialog)
        self.card.body.addLayout(row_layout(STRETCH, self.accept_button, self.close_button))

    def request_reason(self) -> None:
        self.reason_field.clear()
        self._on_reason_edited("")
        self.open()

    def _on_reason_edited(self, text: str) -> None:
        """Make Exclude the default once a reason is typed."""
        self.accept_button.setEnabled(bool(text.strip()))
        self.set_default(self.accept_button if text.strip() else self.close_button)

    def _accept(self, reason: str) -> None:
        if reason:
            self.close_dialog()
            self.reason_given.emit(reason)


class ChoiceDialog(Dialog):
    """Choice of one item of a list.

    Signals: ``chosen`` with its key.
    """

    chosen = Signal(str)

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 600)
        self.add_heading()
        self.choice_field = Combo()
        self.choice_field.setAccessibleName(self.tr("Choice"))
        self.card.body.addWidget(self.choice_field)
        self.accept_button = Button(theme, "", "primary", height_px=44)
        self.accept_button.clicked.connect(self._accept)
        close = Button(theme, self.tr("Cancel"), "plain", height_px=44)
        close.clicked.connect(self.close_dialog)
        self.set_default(close)
        self.card.body.addLayout(row_layout(STRETCH, self.accept_button, close))

    def request_choice(self, title: str, words: str, accept_text: str, choices: Sequence[tuple[str, str]]) -> None:
        """Open with (key, text) pairs; ``accept_text`` is the button's label."""
        self.title.setText(title)
        self.words.setText(words)
        self.accept_button.set_label(accept_text)
        self.choice_field.set_choices(choices)
        self.accept_button.setEnabled(bool(choices))
        self.open(self.choice_field if self.accept_button.isEnabled() else None)

    def _accept(self) -> None:
        key = self.choice_field.currentData()
        self.close_dialog()
        self.chosen.emit(str(key))
