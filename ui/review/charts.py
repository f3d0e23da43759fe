"""The curves of the review, or the ways in their place, of the wrist or of a finger."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QWidget

from carpus.ui.controls.field import Choices
from carpus.ui.controls.layouts import in_column
from carpus.ui.figures import FINGERS, figure_of
from carpus.ui.marker_words import finger_name
from carpus.ui.plot.motion import MotionPlot
from carpus.ui.plot.session import HandPlot, SessionPlot
from carpus.ui.plot.session_view import CurveView
from carpus.ui.plot.ways import finger_ways, wrist_way
from carpus.ui.plot.ways_view import WaysView
from carpus.ui.review.reviewed import Reviewed
from carpus.ui.theme import Theme
from carpus.ui.translate import inside

WRIST = -1
"""Instead of a finger's number: the wrist's three angles."""


class ReviewCharts(QWidget):
    """``chosen``: another finger is looked at."""

    chosen = Signal()

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        fingers: list[tuple[object, str]] = [(0, self.tr("All fingers"))]
        fingers += [(finger, finger_name(str(finger))) for finger in FINGERS]
        self.finger = Choices(theme, [*fingers, (WRIST, self.tr("Wrist"))])
        self.finger.hide()  # until a session of the whole hand is shown
        for button in self.finger.buttons():
            button.setFocusPolicy(Qt.FocusPolicy.TabFocus)  # a click must leave Space and the arrows to the player
        self.curves = CurveView(theme)
        self.ways = WaysView(theme)
        self.ways.hide()
        column = in_column(self.finger, gap=8, margins=(0, 0, 0, 0), within=self)
        column.addWidget(self.curves, 1)
        column.addWidget(self.ways, 1)
        self.finger.chosen.connect(lambda _: self.chosen.emit())

    @property
    def number(self) -> int:
        """The finger that is looked at, 0 for all, :data:`WRIST` for none."""
        value = self.finger.value()
        return value if isinstance(value, int) else 0

    def fit(self, reviewed: Reviewed | None, *, tight: bool) -> bool:
        """With large text fewer panels; whether another finger had to be chosen for that."""
        self.curves.show_single(tight)
        self.finger.buttons()[0].setVisible(not tight)
        if tight and reviewed is not None and reviewed.is_hand and self.number == 0:
            self.finger.choose(figure_of(reviewed.figures.exercise.joint).finger)  # five panels have no room
            return True
        return False

    def show_plot(self, reviewed: Reviewed, view: str, current: int) -> SessionPlot:
        """What is chosen of a session: its ``angles``, ``path``, ``place`` or ``zyz``."""
        shown = (reviewed.curves, reviewed.figures.exercise, reviewed.figures.repetitions, current)
        if view in ("place", "zyz"):
            plot: SessionPlot = MotionPlot(*shown, motion=reviewed.motion, kind="zyz" if view == "zyz" else "place")
        elif reviewed.joints is not None and self.number != WRIST:
            plot = HandPlot(*shown, joints=reviewed.joints, finger=self.number)
        else:
            plot = SessionPlot(*shown, *reviewed.figures.targets_deg)
        self.curves.show_plot(plot)
        self.curves.setVisible(view != "path")
        self.ways.setVisible(view == "path")
        self.finger.setVisible(reviewed.is_hand and view in ("angles", "path"))
        if view == "path":
            self._show_ways(reviewed)
        return plot

    def _show_ways(self, reviewed: Reviewed) -> None:
        if not reviewed.is_hand or self.number == WRIST:
            self.ways.show_plot(wrist_way(reviewed.motion), self.tr("Path of the wrist, with the hand’s axes"))
            return
        words = self.tr("Ways of the finger tips")
        if self.number:
            words = self.tr("Ways of the joints: {finger}").format(finger=inside(finger_name(str(self.number))))
        self.ways.show_plot(finger_ways(reviewed.motion, self.number), words)

    def set_time(self, time_s: float) -> None:
        self.curves.set_time(time_s)
        self.ways.set_time(time_s)
