"""Tracking again: how far it is and how to stop it, then old and new result over each other and the choice of one."""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtWidgets import QWidget

from carpus.core.results.figures import SessionFigures
from carpus.core.results.seen import JointCurves, ReportCurves
from carpus.ui.controls.button import Button
from carpus.ui.controls.card import Surface
from carpus.ui.controls.field import Choices
from carpus.ui.controls.layouts import STRETCH, fill, in_line
from carpus.ui.controls.progress_bar import ThinBar
from carpus.ui.controls.sheet import Sheet
from carpus.ui.controls.text import REGULAR, SEMIBOLD, Text
from carpus.ui.figures import FINGERS
from carpus.ui.fonts import MEDIUM
from carpus.ui.marker_words import finger_name
from carpus.ui.plot.compared import OLD_TOKEN, ComparedHandPlot, ComparedPlot, legend_words, most_different_finger
from carpus.ui.plot.session import SessionChart
from carpus.ui.theme import Theme

WRIST = -1
"""Instead of a finger's number."""


@dataclass(frozen=True, slots=True)
class BothResults:
    """What is drawn of the old and of the new result of one recording; ``finger`` is one that was corrected, or 0."""

    figures: SessionFigures
    old: ReportCurves
    new: ReportCurves
    old_joints: JointCurves | None = None
    new_joints: JointCurves | None = None
    finger: int = 0


class ResultsSheet(Sheet):
    """``stop`` ends the tracking; ``keep`` and ``use`` decide about the new result that is shown.

    It is opened by hand only. The keyboard lies on the button that changes nothing, so that Enter, Space and Esc
    decide nothing.
    """

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 980)
        self.both: BothResults | None = None
        """The two results that are shown; None while one is made or read."""
        self.title = Text(theme, "", 20, SEMIBOLD, wrap=True)
        self.whose = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        self.words = Text(theme, "", 14, REGULAR, wrap=True)
        self.bar = ThinBar(theme, self.tr("How far the tracking is"))
        self.legend = _legend(theme)
        fingers = [(finger, finger_name(str(finger))) for finger in FINGERS]
        self.finger = Choices(theme, [*fingers, (WRIST, self.tr("Wrist"))])
        self.finger.chosen.connect(lambda _: self._draw())
        self.curves = SessionChart(theme)
        self.curves.cursor_moved.connect(self.curves.set_time)
        self.stop = Button(theme, self.tr("&Stop"), "plain", height_px=44)
        self.keep = Button(theme, self.tr("&Keep the old one"), "plain", height_px=44)
        self.use = Button(theme, self.tr("&Use the new result"), "plain", height_px=44)
        self.later = Button(theme, "", "plain", height_px=44)
        self.later.clicked.connect(self.close_sheet)
        self.set_default(self.later)
        body = self.card.body
        body.setSpacing(8)
        for widget in (self.title, self.whose, self.bar, self.words, self.legend, self.finger):
            body.addWidget(widget)
        body.addWidget(self.curves, 1)
        row = in_line(self.stop, self.keep, self.use, STRETCH, self.later, gap=10)
        fill(body, 4, row)

    def show_running(self, whose: str, percent: int) -> None:
        self._show(self.tr("Tracking again: {percent} %").format(percent=percent), whose)
        self.bar.show_progress(percent, 100)
        self.words.setText(
            self.tr("Go on working meanwhile. Nothing replaces the old result until you choose; Stop keeps it.")
        )
        self.later.set_face(self.tr("Go on working"))
        self._show_parts(running=True, both=None)

    def show_reading(self, whose: str) -> None:
        self._show(self.tr("Reading both results…"), whose)
        self.words.setText("")
        self.later.set_face(self.tr("Decide later"))
        self._show_parts(running=False, both=None)

    def show_both(self, whose: str, words: str, both: BothResults) -> None:
        self._show(self.tr("Use the new result?"), whose)
        self.words.setText(words)
        self.later.set_face(self.tr("Decide later"))
        finger = both.finger or most_different_finger(both.old_joints, both.new_joints)
        self.finger.choose(finger or WRIST)
        self._show_parts(running=False, both=both)
        self._draw()

    def begin(self) -> None:
        """Open; what is shown was told before."""
        self.open()

    def _show(self, title: str, whose: str) -> None:
        self.title.setText(title)
        self.whose.setText(whose)
        self.setAccessibleName(f"{title} {whose}")

    def _show_parts(self, *, running: bool, both: BothResults | None) -> None:
        self.both = both
        self.bar.setVisible(running)
        self.stop.setVisible(running)
        for widget in (self.legend, self.curves, self.keep, self.use):
            widget.setVisible(both is not None)
        self.finger.setVisible(both is not None and both.new_joints is not None)
        self.words.setVisible(bool(self.words.text()))

    def _draw(self) -> None:
        both = self.both
        if both is None:
            return
        shown = (both.new, both.figures.exercise, both.figures.repetitions, -1)
        finger = self.finger.value()
        if both.new_joints is not None and isinstance(finger, int) and finger > 0:
            self.curves.show_plot(ComparedHandPlot(*shown, joints=both.new_joints, finger=finger, old=both.old_joints))
        else:
            self.curves.show_plot(ComparedPlot(*shown, old=both.old))


def _legend(theme: Theme) -> QWidget:
    """How the old and the new result are drawn."""
    legend = QWidget()
    legend.setAccessibleName(", ".join(legend_words()))
    row = in_line(gap=6, margins=(0, 0, 0, 0), within=legend)
    for words, token, width_px in zip(legend_words(), (OLD_TOKEN, "curve_a"), (1, 3), strict=True):
        stroke = Surface(theme, token)
        stroke.setFixedSize(36, width_px)
        fill(row, stroke, Text(theme, words, 14, MEDIUM), 16)
    row.addStretch(1)
    return legend
