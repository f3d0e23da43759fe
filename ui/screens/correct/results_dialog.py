"""Dialog of a re-analysis: its progress, then the comparison of old and new result."""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtWidgets import QWidget

from carpus.core.results.session_results import SessionResults
from carpus.core.results.valid_data import JointCurves, WristCurves
from carpus.ui.charts.result_comparison import (
    OLD_TOKEN,
    ComparisonPlot,
    HandComparisonPlot,
    find_changed_finger,
    legend_words,
)
from carpus.ui.charts.session import SessionChart
from carpus.ui.kit.button import Button
from carpus.ui.kit.card import Surface
from carpus.ui.kit.dialog import Dialog
from carpus.ui.kit.field import ChoiceRow
from carpus.ui.kit.fonts import MEDIUM
from carpus.ui.kit.layouts import STRETCH, fill, row_layout
from carpus.ui.kit.progress_bar import ThinProgressBar
from carpus.ui.kit.text import REGULAR, SEMIBOLD, Text
from carpus.ui.kit.theme import Theme
from carpus.ui.words.finger_angles import FINGERS
from carpus.ui.words.marker_words import finger_name

WRIST = -1
"""Choice of the wrist in place of a finger."""


@dataclass(frozen=True, slots=True)
class ResultPair:
    """Old and new result of a recording; ``finger`` was corrected, 0 if none."""

    figures: SessionResults
    old: WristCurves
    new: WristCurves
    old_joints: JointCurves | None = None
    new_joints: JointCurves | None = None
    finger: int = 0


class ResultsDialog(Dialog):
    """Progress and result of a re-analysis.

    Only the user opens it. The focus is on the button that changes nothing, so Enter, Space and Esc decide nothing.
    """

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 980)
        self.results: ResultPair | None = None
        """The two results shown; None while one is computed or read."""
        self.title = Text(theme, "", 20, SEMIBOLD, wrap=True)
        self.session_label = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        self.words = Text(theme, "", 14, REGULAR, wrap=True)
        self.bar = ThinProgressBar(theme, self.tr("Progress of the re-analysis"))
        self.legend = _make_legend(theme)
        fingers = [(finger, finger_name(str(finger))) for finger in FINGERS]
        self.finger = ChoiceRow(theme, [*fingers, (WRIST, self.tr("Wrist"))])
        self.finger.chosen.connect(lambda _: self._draw())
        self.curves = SessionChart(theme)
        self.curves.cursor_moved.connect(self.curves.set_time)
        self.stop_button = Button(theme, self.tr("&Stop"), "plain", height_px=44)
        self.keep_button = Button(theme, self.tr("&Keep old result"), "plain", height_px=44)
        self.use_button = Button(theme, self.tr("&Use new result"), "plain", height_px=44)
        self.later_button = Button(theme, "", "plain", height_px=44)
        self.later_button.clicked.connect(self.close_dialog)
        self.set_default(self.later_button)
        body = self.card.body
        body.setSpacing(8)
        for widget in (self.title, self.session_label, self.bar, self.words, self.legend, self.finger):
            body.addWidget(widget)
        body.addWidget(self.curves, 1)
        row = row_layout(self.stop_button, self.keep_button, self.use_button, STRETCH, self.later_button, gap=10)
        fill(body, 4, row)

    def show_running(self, session_label: str, percent: int) -> None:
        self._show_heading(self.tr("Re-analysing: {percent} %").format(percent=percent), session_label)
        self.bar.show_progress(percent, 100)
        self.words.setText(
            self.tr(
                "You can continue working. The old result stays until you choose the new one. Stop keeps the old "
                "result."
            )
        )
        self.later_button.set_label(self.tr("Continue working"))
        self._show_sections(running=True, both=None)

    def show_reading(self, session_label: str) -> None:
        self._show_heading(self.tr("Reading both results…"), session_label)
        self.words.setText("")
        self.later_button.set_label(self.tr("Decide later"))
        self._show_sections(running=False, both=None)

    def show_results(self, session_label: str, words: str, results: ResultPair) -> None:
        self._show_heading(self.tr("Use the new result?"), session_label)
        self.words.setText(words)
        self.later_button.set_label(self.tr("Decide later"))
        finger = results.finger or find_changed_finger(results.old_joints, results.new_joints)
        self.finger.choose(finger or WRIST)
        self._show_sections(running=False, both=results)
        self._draw()

    def _show_heading(self, title: str, whose: str) -> None:
        self.title.setText(title)
        self.session_label.setText(whose)
        self.setAccessibleName(f"{title} {whose}")

    def _show_sections(self, *, running: bool, both: ResultPair | None) -> None:
        self.results = both
        self.bar.setVisible(running)
        self.stop_button.setVisible(running)
        for widget in (self.legend, self.curves, self.keep_button, self.use_button):
            widget.setVisible(both is not None)
        self.finger.setVisible(both is not None and both.new_joints is not None)
        self.words.setVisible(bool(self.words.text()))

    def _draw(self) -> None:
        both = self.results
        if both is None:
            return
        shown = (both.new, both.figures.exercise, both.figures.repetitions, -1)
        finger = self.finger.value()
        if both.new_joints is not None and isinstance(finger, int) and finger > 0:
            self.curves.show_plot(
                HandComparisonPlot(*shown, joints=both.new_joints, finger=finger, old=both.old_joints)
            )
        else:
            self.curves.show_plot(ComparisonPlot(*shown, old=both.old))


def _make_legend(theme: Theme) -> QWidget:
    legend = QWidget()
    legend.setAccessibleName(", ".join(legend_words()))
    row = row_layout(gap=6, margins=(0, 0, 0, 0), parent=legend)
    for words, token, width_px in zip(legend_words(), (OLD_TOKEN, "curve_a"), (1, 3), strict=True):
        stroke = Surface(theme, token)
        stroke.setFixedSize(36, width_px)
        fill(row, stroke, Text(theme, words, 14, MEDIUM), 16)
    row.addStretch(1)
    return legend
