"""What each key does, as a card of the settings."""

from __future__ import annotations

from collections.abc import Mapping

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QKeySequence
from PySide6.QtWidgets import QGridLayout, QKeySequenceEdit

from carpus.ui.controls.button import Button
from carpus.ui.controls.card import Card
from carpus.ui.controls.layouts import fill
from carpus.ui.controls.text import REGULAR, SEMIBOLD, Text
from carpus.ui.keys import DEFAULT_KEYS, action_words
from carpus.ui.theme import Theme

KEY_PX = 104


class KeysCard(Card):
    """``changed`` carries the keys that are not the usual ones, by their actions."""

    changed = Signal(object)

    def __init__(self, theme: Theme, chosen: Mapping[str, str]) -> None:
        super().__init__(theme, 24)
        self._theme, self._chosen = theme, dict(chosen)
        self.fields: dict[str, QKeySequenceEdit] = {}
        self.fault = Text(theme, "", 14, SEMIBOLD, "bad", wrap=True)
        self.fault.hide()
        self.reset = Button(theme, self.tr("Usual keys again"), height_px=40)
        self.reset.clicked.connect(self._reset)
        words = self.tr(
            "Click a key and press another one. While measuring only the space bar and function keys are safe."
        )
        fill(
            self.body,
            Text(theme, self.tr("Keys"), 20, SEMIBOLD),
            Text(theme, words, 14, REGULAR, "text2", wrap=True),
            self._grid(),
            self.fault,
            (self.reset, 0, Qt.AlignmentFlag.AlignLeft),
        )

    def _grid(self) -> QGridLayout:
        grid = QGridLayout()
        grid.setHorizontalSpacing(24)
        half = (len(DEFAULT_KEYS) + 1) // 2
        for place, name in enumerate(DEFAULT_KEYS):
            field = self.fields[name] = QKeySequenceEdit(QKeySequence(self._key_of(name)))
            field.setMaximumSequenceLength(1)
            field.setAccessibleName(action_words(name))
            field.editingFinished.connect(lambda name=name: self._take(name))
            self._theme.follow(field, lambda field=field: field.setFixedWidth(self._theme.px(KEY_PX)))  # type: ignore[misc]
            column = 2 * (place // half)
            grid.addWidget(Text(self._theme, action_words(name), 14, wrap=True), place % half, column)
            grid.addWidget(field, place % half, column + 1)
        grid.setColumnStretch(0, 1)
        grid.setColumnStretch(2, 1)
        return grid

    def _take(self, name: str) -> None:
        key = self.fields[name].keySequence().toString(QKeySequence.SequenceFormat.PortableText)
        taken = [other for other in self._sharing(name) if key and self._key_of(other) == key]
        self.fault.setVisible(bool(taken))
        if taken or not key:
            self.fields[name].setKeySequence(QKeySequence(self._key_of(name)))
            if taken:
                words = self.tr("{key} already does: {action}.")
                self.fault.setText(words.format(key=key, action=action_words(taken[0])))
            return
        self._choose({**self._chosen, name: key})

    def _key_of(self, name: str) -> str:
        return self._chosen.get(name, DEFAULT_KEYS[name])

    def _sharing(self, name: str) -> list[str]:
        """Actions that are live at the same time: by default some share a key because they never meet."""
        default = DEFAULT_KEYS[name]
        return [other for other in DEFAULT_KEYS if other != name and DEFAULT_KEYS[other] != default]

    def _choose(self, keys: Mapping[str, str]) -> None:
        self._chosen = {name: key for name, key in keys.items() if key != DEFAULT_KEYS[name]}
        self.changed.emit(self._chosen)

    def _reset(self) -> None:
        for name, field in self.fields.items():
            field.setKeySequence(QKeySequence(DEFAULT_KEYS[name]))
        self.fault.hide()
        self._choose({})
