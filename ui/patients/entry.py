"""The form for a new patient, or for changing one: a made-up name first, the real one only if wanted."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QHBoxLayout, QLineEdit, QPlainTextEdit, QVBoxLayout, QWidget

from carpus.ui import terms
from carpus.ui.controls.button import Button
from carpus.ui.controls.column import scroll_area
from carpus.ui.controls.field import Choices, Labelled
from carpus.ui.controls.host import host_of
from carpus.ui.controls.sheet import Sheet
from carpus.ui.controls.text import SEMIBOLD, Text
from carpus.ui.ports import PatientEntry
from carpus.ui.theme import Theme

NOTE_HEIGHT_PX = 84
MOST_LETTERS = 40


class PatientForm(Sheet):
    """Emits ``accepted`` with the entry; Enter in any line accepts, Esc closes. ``removal_wanted`` of a patient who is
    in the list."""

    accepted = Signal(PatientEntry)
    removal_wanted = Signal()

    def __init__(self, host: QWidget, theme: Theme, suggest: Callable[[], str]) -> None:
        super().__init__(host, theme, 560)
        self._suggest = suggest
        self._fault = Text(theme, "", 14, SEMIBOLD, "bad", wrap=True)
        self._title = Text(theme, "", 20, SEMIBOLD)
        self.name = QLineEdit()
        self.name.setMaxLength(MOST_LETTERS)
        self.name.inputRejected.connect(self._say_too_long)
        self.name.textEdited.connect(lambda _: self._fault.hide())
        another = Button(theme, self.tr("&Another"), "plain", height_px=40)
        another.clicked.connect(lambda: self.name.setText(suggest()))
        name_row = QWidget()
        row = QHBoxLayout(name_row)
        row.setContentsMargins(0, 0, 0, 0)
        row.addWidget(self.name, 1)
        row.addWidget(another)
        name_row.setFocusProxy(self.name)
        self.side = Choices(theme, [(side, terms.side_name(side)) for side in ("right", "left", "both")])
        self.dominance = Choices(
            theme,
            [("right", self.tr("Right")), ("left", self.tr("Left")), ("unknown", self.tr("Not known"))],
        )  # fmt: skip
        self.real_name = QLineEdit()
        self.note = QPlainTextEdit()
        self.note.setTabChangesFocus(True)
        self.note.setFixedHeight(theme.px(NOTE_HEIGHT_PX))
        self.save = Button(theme, "", "primary")
        cancel = Button(theme, self.tr("Close without saving"), "plain", hint=self.tr("Esc"), height_px=52)
        self.body = self.card.body
        self.body.setSpacing(16)
        self.body.addWidget(self._title)
        rule = self.tr("A made-up name that can be spoken aloud. No real name, no initials, no date of birth.")
        self.body.addWidget(Text(theme, rule, 14, token="text2", wrap=True))
        self._fields = QWidget()
        column = QVBoxLayout(self._fields)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(14)
        column.addWidget(Labelled(theme, self.tr("&Name in Carpus"), name_row))
        kept = self.tr("&Real name, if wanted (stays in this list, never in a session or report)")
        column.addWidget(Labelled(theme, kept, self.real_name))
        column.addWidget(Labelled(theme, self.tr("Affected hand"), self.side))
        column.addWidget(Labelled(theme, self.tr("Writes with"), self.dominance))
        column.addWidget(Labelled(theme, self.tr("N&ote (no diagnosis, no names)"), self.note))
        self._scroll = scroll_area(self._fields)  # large text on a small screen: the fields scroll, the buttons stay
        self.body.addWidget(self._scroll)
        self.body.addWidget(self._fault)
        self.remove = Button(theme, self.tr("Archi&ve or delete…"), "quiet", icon="trash-2", height_px=40)
        self.remove.clicked.connect(self.close_sheet)
        self.remove.clicked.connect(self.removal_wanted)
        self._fields.layout().addWidget(self.remove)  # type: ignore[union-attr]
        buttons = QHBoxLayout()
        buttons.addStretch(1)
        buttons.addWidget(cancel)
        buttons.addWidget(self.save)
        self.body.addLayout(buttons)
        self.save.clicked.connect(self._accept)
        for chips in (self.side, self.dominance):
            chips.chosen.connect(lambda _: self._judge())
        self.set_default(self.save)
        cancel.clicked.connect(self.close_sheet)
        self._taken: frozenset[str] = frozenset()
        self._words = ""

    def begin(self, entry: PatientEntry | None, taken: frozenset[str], name: str = "") -> None:
        """Open for a new patient (optionally with a name already typed) or with an entry to change."""
        self._taken = taken
        self._title.setText(self.tr("New patient") if entry is None else self.tr("Change patient"))
        self._words = self.tr("Add patient") if entry is None else self.tr("Keep changes")
        self.remove.setVisible(entry is not None)
        is_new = entry is None
        entry = entry or PatientEntry(name or self._suggest(), "right", "unknown")
        self.name.setMaxLength(max(MOST_LETTERS, len(entry.pseudonym)))  # a longer one of old is not cut
        self.name.setText(entry.pseudonym)
        self.side.choose(entry.side)
        self.dominance.choose(entry.dominance if entry.dominance != "both" else "unknown")
        if is_new:  # a hand that nobody chose would be a wrong record
            self.side.choose_nothing()
            self.dominance.choose_nothing()
        self._judge()
        self.real_name.setText(entry.name)
        self.note.setPlainText(entry.note)
        self._fault.hide()
        room = host_of(self).height() - self._theme.px(250)
        self._scroll.setFixedHeight(min(self._fields.sizeHint().height() + 2, max(room, 160)))
        self.open(self.name)
        self.name.selectAll()

    def _judge(self) -> None:
        """What is still to be said stands on the button."""
        no_side, no_dominance = self.side.value() is None, self.dominance.value() is None
        words = self.tr("Which hand is affected?") if no_side else self.tr("Which hand writes?")
        self.save.set_face(words if no_side or no_dominance else self._words)
        self.save.setEnabled(not (no_side or no_dominance))

    def _say_too_long(self) -> None:
        """A letter, or the end of what was pasted, had no more room: never cut without a word."""
        words = self.tr("A name has up to {count} letters: what goes beyond is not taken.")
        self._fault.setText(words.format(count=self.name.maxLength()))
        self._fault.show()

    def _accept(self) -> None:
        name = " ".join(self.name.text().split())
        if not name or name.casefold() in self._taken:
            words = (
                self.tr("Give the patient a name.")
                if not name
                else self.tr("“{name}” is taken. Choose another name.").format(name=name)
            )
            self._fault.setText(words)
            self._fault.show()
            self.name.setFocus(Qt.FocusReason.OtherFocusReason)
            return
        self.close_sheet()
        side, dominance = str(self.side.value()), str(self.dominance.value())
        note, real_name = self.note.toPlainText().strip(), " ".join(self.real_name.text().split())
        self.accepted.emit(PatientEntry(name, side, dominance, note, real_name))  # type: ignore[arg-type]
