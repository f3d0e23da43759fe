"""Settings screen: an index and one page at a time; each choice takes effect at once."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal, get_args

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QApplication, QCheckBox, QFileDialog, QStackedWidget, QVBoxLayout, QWidget

from carpus.core.measures.change_limits import DEFAULT_LIMITS, ErrorLimits
from carpus.core.model.phrase import LANGUAGES
from carpus.core.model.rounding import format_rounded
from carpus.core.pipeline.live_values import StartMode
from carpus.core.platform.version import __version__
from carpus.core.session.values import AngleOrder
from carpus.ui.kit.button import Button
from carpus.ui.kit.card import Card
from carpus.ui.kit.field import ChoiceRow, PageIndex
from carpus.ui.kit.forms import Field, Form
from carpus.ui.kit.icons import State
from carpus.ui.kit.layouts import STRETCH, Part, ScrollArea, ScrolledColumn, column_layout, fill, row_layout
from carpus.ui.kit.text import REGULAR, SEMIBOLD, Icon, Text, heading
from carpus.ui.kit.theme import GAP_PX, MARGIN_PX, TEXT_SCALES, Theme
from carpus.ui.screens.settings.limits_card import limits_card
from carpus.ui.words import terms

SettingsPage = Literal["camera", "measuring", "report", "safety", "looks", "research", "about"]

ThemeChoice = Literal["light", "dark", "system"]


@dataclass(frozen=True, slots=True)
class Preferences:
    """Choices of the settings screen.

    ``angle_order`` is zyx or isb, ``stream`` sends live values to other programs.
    """

    theme: ThemeChoice = "system"
    text_scale: float = 1.0
    data_folder: str = ""
    angle_order: AngleOrder = "zyx"
    stream: bool = False
    patient_sound: bool = False
    """Whether the patient's view beeps at the goal."""
    language: str = "system"
    """Code of :data:`carpus.ui.kit.language.LANGUAGES`, or ``system``."""
    research: bool = False
    """Whether options for research are shown."""
    start: StartMode = "key"


class SettingsScreen(QWidget):
    """Settings screen.

    Signals: ``changed`` with the whole :class:`Preferences`.
    """

    changed = Signal(Preferences)

    def __init__(self, theme: Theme, preferences: Preferences, measured: ErrorLimits = DEFAULT_LIMITS) -> None:
        super().__init__()
        self._theme, self.preferences = theme, preferences
        table = self._make_table(theme)
        self.form = Form(theme, [field for *_, fields in table for field in fields])
        self.form.fill(preferences)
        self._shown_values = self.form.values()
        self.language_note = Text(theme, "", 14, SEMIBOLD, "bad", wrap=True)
        self.language_note.hide()
        self.folder_text = Text(theme, preferences.data_folder, 14)
        self.folder_button = Button(theme, self.tr("Change…"), height_px=40)
        self.retest_button = Button(theme, self.tr("Calculate from test–retest sessions…"), height_px=40)
        self.done_button = Button(theme, self.tr("Done"), "primary", hint=self.tr("Esc"))
        self._limits_host = Card(theme, 0)  # what is in it changes when new limits are put into force
        self._limits_host.set_colors("canvas", "canvas")
        self.show_limits(measured)
        self._pages: dict[SettingsPage, QVBoxLayout] = {part: QVBoxLayout() for part in get_args(SettingsPage)}
        self._research_cards: list[Card] = []
        self._build_layout(table)
        self.form.changed.connect(self._apply_choices)
        self.folder_button.clicked.connect(self.choose_folder)

    def _make_table(self, theme: Theme) -> list[tuple[SettingsPage, str, str, list[Field]]]:
        """Return the cards: page, title, description and fields."""
        computer = ("system", self.tr("Match system"))
        looks = ChoiceRow(theme, [("light", self.tr("Light")), ("dark", self.tr("Dark")), computer])
        sizes = ChoiceRow(theme, [(scale, f"{format_rounded(100 * scale)} %") for scale in TEXT_SCALES])
        orders = [("zyx", self.tr("As published: deviation first")), ("isb", self.tr("ISB: flexion first"))]
        starts = [
            ("key", self.tr("On key press")), ("countdown", self.tr("3 s after key press")),
            ("still", self.tr("When the hand is still")),
        ]  # fmt: skip
        sounds = [(False, self.tr("No sound")), (True, self.tr("Beep at the goal"))]
        streams = [(False, self.tr("Off")), (True, self.tr("Stream live values"))]
        return [
            (
                "measuring", self.tr("Start of a recording"),
                self.tr(
                    "Hands-free start: use a pedal or a presentation remote (Page Down). An automatic start is "
                    "counted down, and Space cancels it."
                ),
                [Field("start", "", ChoiceRow(theme, starts))],
            ),
            (
                "measuring", self.tr("The patient’s view"),
                self.tr(
                    "A second screen or window shows the patient what to do. Open it while measuring. For each "
                    "exercise, choose whether it speaks to a child or an adult."
                ),
                [Field("patient_sound", "", ChoiceRow(theme, sounds))],
            ),
            (
                "looks", self.tr("Appearance"), "",
                [
                    Field("theme", self.tr("Colours"), looks),
                    Field("text_scale", self.tr("Text size"), sizes),
                    Field("language", self.tr("Language"), ChoiceRow(theme, [*LANGUAGES.items(), computer])),
                ],
            ),
            (
                "research", self.tr("Research"),
                self.tr(
                    "Shows path and axes, speeds, the motion page in reports, all export formats, angle order and "
                    "streaming. Values do not change."
                ),
                [Field("research", "", QCheckBox(self.tr("For research")))],
            ),
            (
                "research", self.tr("Angle order"),
                self.tr(
                    "Order of the wrist angles in review, progress and reports. Session files keep the papers’ "
                    "order (ZYX). Sessions with different orders are not compared."
                ),
                [Field("angle_order", "", ChoiceRow(theme, orders))],
            ),
            (
                "research", self.tr("Other programs"),
                self.tr(
                    "Streams angles, positions and events over Lab Streaming Layer (LSL). Any computer on the "
                    "network can read them. Names and images are not included. Applies from the next set-up."
                ),
                [Field("stream", "", ChoiceRow(theme, streams))],
            ),
        ]  # fmt: skip

    def _build_layout(self, table: list[tuple[SettingsPage, str, str, list[Field]]]) -> None:
        theme, narrow = self._theme, Qt.AlignmentFlag.AlignLeft
        for part, title, words, fields in table:
            card = self._make_card(title, words)
            for field in fields:
                one = self.form.labelled_widgets[field.name]
                field.widget.setAccessibleName(field.widget.accessibleName() or title)
                fill(card.body, 0 if field is fields[0] else 8, (one, 0, narrow) if isinstance(one, QCheckBox) else one)
            self._pages[part].addWidget(card)
            if part == "looks":
                card.body.addWidget(self.language_note)
            elif part == "research" and fields[0].name != "research":
                self._research_cards.append(card)
        self._pages["measuring"].addWidget(self._limits_host)
        words = self.tr("Sessions and patient list. Private to your user account. Nothing leaves this computer.")
        data = self._make_card(self.tr("Data"), words, row_layout((self.folder_text, 1), self.folder_button))
        self._pages["safety"].addWidget(data)
        self._pages["about"].addWidget(self._make_about_card())
        self._build_index()
        self._show_research_cards()
        self.show_page("looks")
        self.demo_notice = Text(theme, self.tr("In the demo, settings apply until it is closed."), 14, wrap=True)
        self.demo_notice.hide()
        head = row_layout(
            (heading(theme, self.tr("Settings")), 1),
            (self.demo_notice, 1),
            self.done_button,
            gap=16,
            margins=(0, 0, 8, 0),
        )
        beside = row_layout(self.index, (self._page_stack, 1), gap=GAP_PX)
        column_layout(head, (beside, 1), gap=12, margins=(MARGIN_PX, GAP_PX, MARGIN_PX - 8, GAP_PX), parent=self)

    def _make_about_card(self) -> Card:
        theme = self._theme
        words = self.tr(
            "Carpus never checks for updates online. Compare this version with the latest one where you got Carpus. "
            "Back up, then install it over this one. Patients, sessions and settings stay."
        )
        self.licences_button = Button(theme, self.tr("Components and licences"), height_px=40)
        return self._make_card(
            self.tr("About Carpus"),
            "",
            Text(theme, self.tr("Version {version}, MIT licence.").format(version=__version__), 14),
            Text(theme, terms.legal_notice(), 14, SEMIBOLD, wrap=True),
            Text(theme, words, 14, REGULAR, "text2", wrap=True),
            (self.licences_button, 0, Qt.AlignmentFlag.AlignLeft),
        )

    def _build_index(self) -> None:
        titles: dict[SettingsPage, str] = {
            "camera": self.tr("Camera"), "measuring": self.tr("Measuring"), "report": self.tr("Report and clinic"),
            "safety": self.tr("Safety"), "looks": self.tr("Appearance and language"),
            "research": self.tr("Research"), "about": self.tr("About Carpus"),
        }  # fmt: skip
        self._page_stack = QStackedWidget()
        for page in self._pages.values():
            page.setContentsMargins(0, 4, 12, 4)
            page.setSpacing(GAP_PX)
            page.addStretch(1)
            host = ScrolledColumn()
            host.setLayout(page)
            self._page_stack.addWidget(ScrollArea(host))
        self.index = PageIndex([titles[part] for part in self._pages])
        self.index.setAccessibleName(self.tr("Settings"))
        self.index.currentRowChanged.connect(self._page_stack.setCurrentIndex)

    def show_limits(self, measured: ErrorLimits) -> None:
        while (item := self._limits_host.body.takeAt(0)) is not None:
            if (old := item.widget()) is not None:
                self.retest_button.setParent(None)
                old.hide()
                old.deleteLater()
        card = limits_card(self._theme, measured)
        fill(card.body, 8, (self.retest_button, 0, Qt.AlignmentFlag.AlignLeft))
        self._limits_host.body.addWidget(card)

    def show_computing(self, *, on: bool) -> None:
        """Show that sessions are being read, about one second each."""
        self.retest_button.setEnabled(not on)
        words = self.tr("Reading the sessions…") if on else self.tr("Calculate from test–retest sessions…")
        self.retest_button.set_label(words)

    def revert_language(self, code: str, reason: str) -> None:
        """Select the old language again and show why it could not be changed."""
        self.preferences = replace(self.preferences, language=code)
        self.form["language"].choose(code)
        self._shown_values = self.form.values()
        self.language_note.show_text(reason)

    def add_cards(self, part: SettingsPage, *cards: Card) -> None:
        """Add cards of other modules at the top of a page."""
        for number, card in enumerate(cards):
            self._pages[part].insertWidget(number, card)
        self._show_research_cards()

    def show_page(self, part: SettingsPage) -> None:
        self.index.setCurrentRow(get_args(SettingsPage).index(part))

    def _show_research_cards(self) -> None:
        """Show cards for research only if switched on, and hide empty pages."""
        for card in self._research_cards:
            card.setVisible(self.preferences.research)
        for number, page in enumerate(self._pages.values()):
            self.index.setRowHidden(number, page.count() == 1)

    def _make_card(self, title: str, words: str, *parts: Part) -> Card:
        card = Card(self._theme, 24)
        card.add_heading(title, words)
        fill(card.body, *parts)
        return card

    def _apply_preferences(self, preferences: Preferences) -> None:
        if preferences != self.preferences:
            self.preferences = preferences
            self.changed.emit(preferences)

    def _apply_choices(self) -> None:
        """Apply changed choices; preferences that are not offered here stay."""
        before, self._shown_values = self._shown_values, self.form.values()
        self._apply_preferences(
            replace(self.preferences, **{name: new for name, new in self._shown_values.items() if new != before[name]})
        )
        self._show_research_cards()

    def choose_folder(self) -> None:
        over = self if self.isVisible() else QApplication.activeWindow()  # the first start asks from another screen
        path = QFileDialog.getExistingDirectory(over, self.tr("Data folder"), self.preferences.data_folder)
        if path:
            self.folder_text.setText(path)
            self._apply_preferences(replace(self.preferences, data_folder=path))


class CameraCard(Card):
    """Status of the camera, with buttons to check and calibrate it."""

    def __init__(self, theme: Theme) -> None:
        super().__init__(theme, 24)
        self._theme = theme
        words = self.tr(
            "A printed board calibrates the camera. A printed card checks in 30 seconds whether the camera is still "
            "within tolerance."
        )
        self.add_heading(self.tr("Camera"), words)
        self._row = row_layout(gap=10)
        self._sign = Icon(theme, "none")
        self._state = Text(theme, "", 14, SEMIBOLD, wrap=True)
        fill(self._row, self._sign, (self._state, 1))
        self.body.addLayout(self._row)
        buttons = row_layout(gap=12)
        self.check_button = Button(theme, self.tr("Chec&k card…"), height_px=40)
        self.calibrate_button = Button(theme, self.tr("Cali&brate the camera…"), height_px=40)
        fill(buttons, self.check_button, self.calibrate_button, STRETCH)
        self.body.addLayout(buttons)

    def show_status(self, state: State, words: str) -> None:
        sign = Icon(self._theme, state)
        self._row.replaceWidget(self._sign, sign)
        self._sign.hide()
        self._sign.deleteLater()
        self._sign = sign
        self._state.setText(words)

    def show_demo(self) -> None:
        """Show that a simulated camera needs no calibration."""
        for button in (self.check_button, self.calibrate_button):
            button.hide()
        self._sign.hide()  # an empty sign would set the words in
        self._state.setText(self.tr("In the demo the camera is simulated. It needs no calibration."))
