"""The settings: every choice acts at once and is told to whoever stores it."""

from __future__ import annotations

from dataclasses import replace

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QKeySequence
from PySide6.QtWidgets import (
    QFileDialog,
    QGridLayout,
    QHBoxLayout,
    QKeySequenceEdit,
    QLineEdit,
    QVBoxLayout,
    QWidget,
)

from ui import terms
from ui.controls.button import Button
from ui.controls.card import Card
from ui.controls.column import scroll_area
from ui.controls.field import Choices
from ui.controls.text import REGULAR, SEMIBOLD, Text, heading
from ui.keys import DEFAULT_KEYS, action_words
from ui.ports import Preferences
from ui.theme import GAP_PX, MARGIN_PX, TEXT_SCALES, Theme


class SettingsScreen(QWidget):
    """``changed`` carries the whole :class:`Preferences`; ``done`` leads back."""

    changed = Signal(Preferences)
    done = Signal()

    def __init__(self, theme: Theme, preferences: Preferences, version: str = "") -> None:
        super().__init__()
        self._theme, self._preferences, self._version = theme, preferences, version
        self.looks = Choices(
            theme, [("light", self.tr("Light")), ("dark", self.tr("Dark")), ("system", self.tr("As the computer"))],
            preferences.theme,
        )  # fmt: skip
        self.text_scale = Choices(
            theme, [(scale, f"{100 * scale:.0f} %") for scale in TEXT_SCALES], preferences.text_scale
        )
        self.folder = Text(theme, preferences.data_folder, 14)
        self.folder_button = Button(theme, self.tr("Change…"), height_px=40)
        self.therapist = QLineEdit(preferences.therapist)
        self.therapist.setMaxLength(12)
        self.therapist.setAccessibleName(self.tr("Initials on reports"))
        self.keys: dict[str, QKeySequenceEdit] = {}
        self.fault = Text(theme, "", 14, SEMIBOLD, "bad", wrap=True)
        self.back = Button(theme, self.tr("Done"), "primary", hint=self.tr("Esc"))
        self._lay_out()
        self._connect()

    def _lay_out(self) -> None:
        theme = self._theme
        page = QVBoxLayout()
        page.setContentsMargins(0, 4, 12, 4)
        page.setSpacing(GAP_PX)
        looks = self._card(self.tr("Looks"))
        looks.body.addWidget(Text(theme, self.tr("Colours"), 14, REGULAR, "text2"))
        looks.body.addWidget(self.looks)
        looks.body.addSpacing(8)
        looks.body.addWidget(Text(theme, self.tr("Text size"), 14, REGULAR, "text2"))
        looks.body.addWidget(self.text_scale)
        data = self._card(self.tr("Data"))
        note = self.tr("Sessions and the list of patients. Private to you; nothing leaves this computer.")
        data.body.addWidget(Text(theme, note, 14, REGULAR, "text2", wrap=True))
        row = QHBoxLayout()
        row.addWidget(self.folder, 1)
        row.addWidget(self.folder_button)
        data.body.addLayout(row)
        data.body.addSpacing(8)
        data.body.addWidget(Text(theme, self.tr("Initials on reports"), 14, REGULAR, "text2"))
        self.therapist.setMaximumWidth(theme.px(220))
        data.body.addWidget(self.therapist)
        keys = self._card(self.tr("Keys"))
        words = self.tr(
            "Click a key and press another one. While measuring only the space bar and function keys are safe."
        )
        keys.body.addWidget(Text(theme, words, 14, REGULAR, "text2", wrap=True))
        grid = QGridLayout()
        grid.setHorizontalSpacing(24)
        names = list(DEFAULT_KEYS)
        half = (len(names) + 1) // 2
        for place, name in enumerate(names):
            field = QKeySequenceEdit(QKeySequence(self._preferences.keys.get(name, DEFAULT_KEYS[name])))
            field.setMaximumSequenceLength(1)
            field.setAccessibleName(action_words(name))
            field.setFixedWidth(theme.px(120))
            field.editingFinished.connect(lambda name=name: self._take_key(name))
            column = 2 * (place // half)
            grid.addWidget(Text(theme, action_words(name), 14), place % half, column)
            grid.addWidget(field, place % half, column + 1)
            self.keys[name] = field
        grid.setColumnStretch(0, 1)
        grid.setColumnStretch(2, 1)
        keys.body.addLayout(grid)
        self.reset = Button(theme, self.tr("Usual keys again"), height_px=40)
        keys.body.addWidget(self.fault)
        keys.body.addWidget(self.reset, 0, Qt.AlignmentFlag.AlignLeft)
        self.fault.hide()
        about = self._card(self.tr("About Carpus"))
        about.body.addWidget(Text(theme, self.tr("Version {version}, MIT licence.").format(version=self._version), 14))
        about.body.addWidget(Text(theme, terms.LEGAL_SENTENCE, 14, SEMIBOLD, wrap=True))
        for card in (looks, data, keys, about):
            page.addWidget(card)
        page.addStretch(1)
        host = QWidget()
        host.setLayout(page)
        scroll = scroll_area(host)
        head = QHBoxLayout()
        head.setContentsMargins(0, 0, 8, 0)
        head.addWidget(heading(theme, self.tr("Settings")), 1)
        head.addWidget(self.back)
        whole = QVBoxLayout(self)
        whole.setContentsMargins(MARGIN_PX, GAP_PX, MARGIN_PX - 8, GAP_PX)
        whole.setSpacing(12)
        whole.addLayout(head)
        whole.addWidget(scroll, 1)

    def _card(self, title: str) -> Card:
        card = Card(self._theme, 24)
        card.body.addWidget(Text(self._theme, title, 20, SEMIBOLD))
        return card

    def _connect(self) -> None:
        self.looks.chosen.connect(lambda value: self._change(replace(self._preferences, theme=value)))
        self.text_scale.chosen.connect(lambda value: self._change(replace(self._preferences, text_scale=value)))
        self.therapist.editingFinished.connect(self._take_therapist)
        self.folder_button.clicked.connect(self._choose_folder)
        self.reset.clicked.connect(self._reset_keys)
        self.back.clicked.connect(self.done)

    @property
    def preferences(self) -> Preferences:
        """What is chosen now."""
        return self._preferences

    def _change(self, preferences: Preferences) -> None:
        if preferences != self._preferences:
            self._preferences = preferences
            self.changed.emit(preferences)

    def _take_therapist(self) -> None:
        self._change(replace(self._preferences, therapist=self.therapist.text().strip()))

    def _choose_folder(self) -> None:
        path = QFileDialog.getExistingDirectory(self, self.tr("Data folder"), self._preferences.data_folder)
        if path:
            self.folder.setText(path)
            self._change(replace(self._preferences, data_folder=path))

    def _take_key(self, name: str) -> None:
        key = self.keys[name].keySequence().toString(QKeySequence.SequenceFormat.PortableText)
        taken = [other for other in self._sharing(name) if key and self._key_of(other) == key]
        if taken or not key:
            self.keys[name].setKeySequence(QKeySequence(self._key_of(name)))
            words = (
                self.tr("{key} already does: {action}.").format(key=key, action=action_words(taken[0])) if taken else ""
            )
            self.fault.setText(words)
            self.fault.setVisible(bool(words))
            return
        self.fault.hide()
        keys = {**self._preferences.keys, name: key}
        self._change(replace(self._preferences, keys={n: k for n, k in keys.items() if k != DEFAULT_KEYS[n]}))

    def _key_of(self, name: str) -> str:
        return self._preferences.keys.get(name, DEFAULT_KEYS[name])

    def _sharing(self, name: str) -> list[str]:
        """Actions that are live at the same time: by default some share a key because they never meet."""
        default = DEFAULT_KEYS[name]
        return [other for other in DEFAULT_KEYS if other != name and DEFAULT_KEYS[other] != default]

    def _reset_keys(self) -> None:
        for name, field in self.keys.items():
            field.setKeySequence(QKeySequence(DEFAULT_KEYS[name]))
        self.fault.hide()
        self._change(replace(self._preferences, keys={}))
