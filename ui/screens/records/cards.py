"""Cards of the settings about backup, lock and records."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QHBoxLayout, QWidget

from carpus.core.model.installation import Finding
from carpus.ui.kit.button import Button
from carpus.ui.kit.card import Card, KeyCaps, Separator
from carpus.ui.kit.field import ChoiceRow
from carpus.ui.kit.icons import State
from carpus.ui.kit.keys import KEYS
from carpus.ui.kit.layouts import STRETCH, column_layout, fill, row_layout
from carpus.ui.kit.text import MEDIUM, REGULAR, SEMIBOLD, StateText, Text, caption
from carpus.ui.kit.theme import Theme
from carpus.ui.kit.translate import translate_phrase


@dataclass(frozen=True, slots=True)
class BackupFacts:
    """State of backups: up to three lines of text, the folder (empty if none) and its state."""

    state: State
    headline: str
    detail: str
    note: str
    folder: str
    folder_state: State
    folder_text: str
    can_back_up: bool


class BackupCard(Card):
    """Card with state, folder and schedule of backups."""

    def __init__(self, theme: Theme, hour: int) -> None:
        super().__init__(theme, 24)
        words = self.tr(
            "Backs up the whole data folder: patients, sessions, images and log. You can continue measuring."
        )
        self.add_heading(self.tr("Backup"), words)
        self.state_card = Card(theme, 14, "soft", "soft")
        self.state_sign = StateText(theme, 16, SEMIBOLD)
        self.headline = Text(theme, "", 16, SEMIBOLD, wrap=True)
        self.detail = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        self.note = Text(theme, "", 12, MEDIUM, "text2", wrap=True)
        self.now_button = Button(theme, self.tr("&Back up now"), icon="archive")
        self.restore_button = Button(theme, self.tr("&Restore…"), icon="rotate-ccw")
        self.progress = caption(theme, self.tr("The backup is verified afterwards."), wrap=True)
        self.folder = Text(theme, "", 14, MEDIUM, wrap=True)
        self.folder_state = StateText(theme, 12, MEDIUM, 16)
        self.folder_button = Button(theme, self.tr("Change…"), height_px=36)
        self.schedule = ChoiceRow(
            theme,
            [(12, self.tr("Daily at 12:00")), (18, self.tr("Daily at 18:00")), (-1, self.tr("Manual only"))],
            hour,
        )
        self._build_layout(theme)

    def _build_layout(self, theme: Theme) -> None:
        texts = column_layout(self.headline, self.detail, self.note, gap=2)
        self.state_card.body.addLayout(row_layout((self.state_sign, 0, Qt.AlignmentFlag.AlignTop), (texts, 1), gap=10))
        shows = caption(theme, self.tr("The changes are shown first."), wrap=True)
        acts = column_layout(self.now_button, self.progress, STRETCH, gap=4)
        again = column_layout(self.restore_button, shows, STRETCH, gap=4)
        keep = Text(theme, self.tr("the last 14 backups, plus one per month for 2 years"), 14)
        fill(
            self.body,
            row_layout((self.state_card, 1), acts, again, gap=16),
            Separator(theme),
            _make_row(theme, self.tr("Backup folder"), self.folder, self.folder_state, self.folder_button),
            Separator(theme),
            _make_row(theme, self.tr("Automatic backup"), self.schedule),
            Separator(theme),
            _make_row(theme, self.tr("Keep"), keep),
            caption(theme, self.tr("Anyone with the backup disk can read it. Use an encrypted disk."), wrap=True),
        )

    def show_facts(self, facts: BackupFacts) -> None:
        fill = "warn_soft" if facts.state == "warn" else "good_soft" if facts.state == "good" else "soft"
        self.state_card.set_colors(fill, fill)
        self.state_sign.show_state(facts.state, "")
        self.state_sign.setVisible(facts.state != "none")
        for text, words in ((self.headline, facts.headline), (self.detail, facts.detail), (self.note, facts.note)):
            text.show_text(words)
        self.folder.setText(facts.folder or self.tr("none"))
        self.folder_state.show_state(facts.folder_state, facts.folder_text)
        self.now_button.setEnabled(facts.can_back_up)

    def show_progress(self, percent: int | None) -> None:
        """Show the percent done; None if no backup is running."""
        running = percent is not None
        self.now_button.setEnabled(not running)
        self.restore_button.setEnabled(not running)
        words = (
            self.tr("{percent} %").format(percent=percent) if running else self.tr("The backup is verified afterwards.")
        )
        self.progress.setText(words)


class LockCard(Card):
    """Card with the automatic lock and the PIN."""

    def __init__(self, theme: Theme, minutes: int) -> None:
        super().__init__(theme, 24)
        words = self.tr("A PIN only hides the screen. It does not encrypt files.")
        self.add_heading(self.tr("Lock"), words)
        self.disk = StateText(theme, 14, SEMIBOLD)
        self.disk_remedy = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        fill(self.body, self.disk, self.disk_remedy)
        self.minutes = ChoiceRow(
            theme,
            [
                (5, self.tr("After 5 min")),
                (10, self.tr("After 10 min")),
                (30, self.tr("After 30 min")),
                (0, self.tr("Never")),
            ],
            minutes,
        )
        self.pin_button = Button(theme, "", height_px=40)
        fill(
            self.body,
            Text(theme, self.tr("Lock automatically"), 14, REGULAR, "text2"),
            self.minutes,
            Text(theme, self.tr("PIN"), 14, REGULAR, "text2"),
        )
        self.body.addLayout(
            row_layout(
                self.pin_button,
                (KeyCaps(theme, [(KEYS["lock"], self.tr("lock now"))]), 0, Qt.AlignmentFlag.AlignVCenter),
                STRETCH,
                gap=20,
            )
        )

    def show_disk(self, finding: Finding) -> None:
        """Show whether the disk is encrypted, which protects the files."""
        self.disk.show_state("good" if finding.state == "good" else "warn", translate_phrase(finding.observation))
        self.disk_remedy.show_text(translate_phrase(finding.remedy))

    def show_pin(self, *, is_set: bool) -> None:
        self.pin_button.set_label(self.tr("Change PIN…") if is_set else self.tr("Set a PIN…"))
        for button in self.minutes.buttons():
            button.setEnabled(is_set)


class RecordsCard(Card):
    """Card with retention period, archive and log."""

    def __init__(self, theme: Theme, years: int, choices: Sequence[int]) -> None:
        super().__init__(theme, 24)
        words = self.tr("Enter the retention period that the law requires after the last session.")
        self.add_heading(self.tr("Records"), words)
        names = {0: self.tr("Not set")}
        shown = sorted({*choices, years})
        options = [(one, names.get(one, self.tr("{n} years").format(n=one))) for one in shown]
        self.years = ChoiceRow(theme, options, years, wraps=True)
        self.due_button = Button(theme, self.tr("Past r&etention period…"), height_px=40)
        self.archive_button = Button(theme, self.tr("&Archive…"), icon="archive", height_px=40)
        self.log_button = Button(theme, self.tr("&Log…"), icon="file-text", height_px=40)
        fill(
            self.body, self.years, 4, row_layout(self.due_button, self.archive_button, self.log_button, STRETCH, gap=12)
        )


def _make_row(theme: Theme, name: str, *widgets: QWidget) -> QHBoxLayout:
    row = row_layout(gap=16)
    label = Text(theme, name, 14, REGULAR, "text2")
    theme.on_change(label, lambda: label.setFixedWidth(theme.px(180)))
    row.addWidget(label)
    for number, widget in enumerate(widgets):
        row.addWidget(widget, 1 if number == 0 else 0)
    return row
