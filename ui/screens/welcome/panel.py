"""The first start: checks of the computer, the data folder, and a guided first session."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QHBoxLayout, QWidget

from carpus.core.model.installation import Finding
from carpus.core.platform.version import PURPOSE
from carpus.ui.kit.button import Button
from carpus.ui.kit.card import Card, Separator
from carpus.ui.kit.field import ChoiceRow
from carpus.ui.kit.icons import State
from carpus.ui.kit.layouts import STRETCH, column_layout, fill, row_layout, scroll_column
from carpus.ui.kit.text import MEDIUM, REGULAR, SEMIBOLD, Icon, Text
from carpus.ui.kit.theme import Theme
from carpus.ui.kit.translate import translate_phrase

_ICONS: dict[str, State] = {"good": "good", "warning": "warn", "bad": "bad"}


def purpose_lines() -> str:
    """Return what Carpus does, a line each."""
    return "\n".join(f"{translate_phrase(word)}: {translate_phrase(meaning)}" for word, meaning in PURPOSE)


class WelcomePanel(Card):
    """Shows what Carpus is, the checks of this computer, and the offer of a guided session."""

    def __init__(self, theme: Theme) -> None:
        super().__init__(theme, 0)
        self._theme = theme
        self.check_rows: list[CheckRow] = []
        self.state_label = Text(theme, "", 14, MEDIUM, wrap=True)
        self.folder_label = Text(theme, "", 14, MEDIUM, wrap=True)
        self.restart_label = Text(theme, "", 14, MEDIUM, "warn", wrap=True)
        self.folder_button = Button(theme, self.tr("Another &folder…"), height_px=36)
        self.close_button = Button(theme, self.tr("Close Carpus"), height_px=36)
        self.again_button = Button(theme, self.tr("&Look again"), "quiet", icon="rotate-ccw", height_px=36)
        self.details_button = Button(theme, self.tr("&Details"), "quiet", height_px=36)
        self.details_button.setCheckable(True)
        self.tour_button = Button(theme, self.tr("&Guide me through a first session"), icon="arrow-right")
        self.later_button = Button(theme, self.tr("Not now"), "quiet", hint=self.tr("Esc"))
        names = [(False, self.tr("Pseudonym only")), (True, self.tr("Real name too"))]
        self.prints_names = ChoiceRow(theme, names)
        self._rows = column_layout(gap=4)
        self._build_layout()
        for button in (
            self.tour_button, self.later_button, self.again_button, self.folder_button, self.close_button,
            self.details_button,
        ):  # fmt: skip
            button.setFocusPolicy(Qt.FocusPolicy.TabFocus)  # a click leaves the keyboard with the search
        self.details_button.toggled.connect(self._show_rows)
        self.show_checking()
        self.show_folder("", needs_restart=False)

    def _build_layout(self) -> None:
        theme = self._theme
        text = column_layout(Text(theme, self.tr("Welcome to Carpus"), 20, SEMIBOLD), gap=8)
        self.purpose = Text(theme, purpose_lines(), 14, REGULAR, "text2", wrap=True)
        fill(text, self.purpose, row_layout((self.state_label, 1), self.details_button, self.again_button), self._rows)
        text.addWidget(Separator(theme))
        note = self.tr("Patients and sessions are saved here. Nothing leaves this computer.")
        lies = column_layout(Text(theme, note, 14, REGULAR, "text2", wrap=True), self.folder_label, gap=0)
        text.addLayout(row_layout((lies, 1), self.folder_button, gap=12))
        text.addWidget(Text(theme, self.tr("What should reports and letters print?"), 14, REGULAR, "text2", wrap=True))
        text.addWidget(self.prints_names)
        later = QHBoxLayout()
        later.setContentsMargins(20, 6, 20, 8)  # its widgets hide it whole, and this with it
        later.setSpacing(12)
        fill(later, (self.restart_label, 1), self.close_button)
        text.addStretch(1)
        foot = row_layout(self.tour_button, STRETCH, self.later_button, gap=8, margins=(20, 10, 20, 12))
        self.body.setSpacing(0)
        self.body.setContentsMargins(1, 1, 1, 1)
        area = scroll_column(text)
        text.setContentsMargins(20, 14, 20, 8)
        self.body.addWidget(area, 1)
        self.body.addLayout(later)  # never scrolled away: it came after what was looked at
        fill(self.body, Separator(theme), foot)

    def show_checking(self) -> None:
        self.state_label.setText(self.tr("Checking this computer …"))
        self.again_button.setEnabled(False)

    def show_checks(self, checks: Sequence[Finding]) -> None:
        """Show the checks, problems first."""
        for old in self.check_rows:
            self._rows.removeWidget(old)
            old.hide()
            old.deleteLater()
        order = {"bad": 0, "warning": 1, "good": 2}
        self.check_rows = [
            CheckRow(self._theme, check) for check in sorted(checks, key=lambda check: order[check.state])
        ]
        for row in self.check_rows:
            self._rows.addWidget(row)
        self._show_rows()
        wanting = sum(check.state != "good" for check in checks)
        self.purpose.setVisible(not wanting)  # what is to be done has the room
        if not wanting:
            words = self.tr("This computer has everything that Carpus needs.")
        elif wanting == 1:
            words = self.tr("One thing needs your attention. The practice patient works without it.")
        else:
            words = self.tr("{count} things need your attention. The practice patient works without them.")
        self.state_label.setText(words.format(count=wanting))
        self.again_button.setEnabled(True)

    def _show_rows(self) -> None:
        for row in self.check_rows:
            row.setVisible(row.check.state != "good" or self.details_button.isChecked())

    def show_folder(self, folder: str, *, needs_restart: bool) -> None:
        """Show the data folder of this or of the next start."""
        self.folder_label.setText(folder)
        self.restart_label.setText(
            self.tr("The new folder is used from the next start. Close Carpus and open it again before you measure.")
            if needs_restart
            else ""
        )
        self.restart_label.setVisible(needs_restart)
        self.close_button.setVisible(needs_restart)


class CheckRow(QWidget):
    """One check: state, name, finding, remedy."""

    def __init__(self, theme: Theme, check: Finding) -> None:
        super().__init__()
        self.check = check
        words = column_layout(Text(theme, f"{check.name}: {check.observation}", 14, REGULAR, wrap=True), gap=0)
        if check.remedy:
            words.addWidget(Text(theme, check.remedy, 14, MEDIUM, wrap=True))
        row_layout(
            (Icon(theme, _ICONS[check.state], 16, (18, 20), alignment=0.5), 0, Qt.AlignmentFlag.AlignTop),
            (words, 1),
            gap=10,
            margins=(0, 0, 0, 0),
            parent=self,
        )
        states = {"good": self.tr("good"), "warning": self.tr("to check"), "bad": self.tr("missing")}
        self.setAccessibleName(f"{check.name}, {states[check.state]}: {check.observation}. {check.remedy}")
