"""The window of the patient's view: when it opens, and what it shows."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Qt, QTimer, Signal
from PySide6.QtGui import QCloseEvent, QGuiApplication, QKeyEvent, QScreen
from PySide6.QtWidgets import QApplication, QWidget

from carpus.core.model.hand.forearm_rotation import from_clinical_targets_deg
from carpus.core.records.session_setup import SessionSetup
from carpus.ui.kit.layouts import column_layout
from carpus.ui.kit.theme import Theme
from carpus.ui.picture.movement_guide import ExerciseGuide, ExerciseSnapshot, GuideScene
from carpus.ui.screens.patient.view import PatientView

if TYPE_CHECKING:
    from carpus.ui.shell.flow import ScreenContext


class PatientViewController(QObject):
    """Opens one window at most and draws the snapshots of the live screen."""

    def __init__(self, context: ScreenContext, on_open_changed: Callable[[bool], None]) -> None:
        super().__init__(context.window)
        self._context, self._on_open_changed = context, on_open_changed
        self._set_up: SessionSetup | None = None
        self._guide: ExerciseGuide | None = None
        self._goals_sounded = 0
        self._is_resting = self._is_hidden = False
        self.window: PatientWindow | None = None
        application = QGuiApplication.instance()
        if isinstance(application, QGuiApplication):
            application.screenRemoved.connect(self._on_screen_removed)

    @property
    def is_open(self) -> bool:
        return self.window is not None and self.window.isVisible()

    def toggle(self) -> None:
        if self.is_open:
            self.close()
            return
        if self.window is None:
            self.window = PatientWindow(self._context.theme)
            self.window.closed.connect(lambda: self._on_open_changed(False))
        self.window.view.sound_on = self._context.patient_sound
        self.window.view.show_set_up(self._set_up)
        self.window.open_on_free_screen(self._context.window)
        self._on_open_changed(True)

    def close(self) -> None:
        """Close the window, if there is one."""
        if self.window is not None:
            self.window.close()

    def close_if_covering(self) -> bool:
        """Close the window if it covers the main window; return True if it did."""
        window = self.window
        if (
            window is None
            or not self.is_open
            or window.isMinimized()
            or window.screen() is not self._context.window.screen()
        ):
            return False
        window.close()
        return True

    def _on_screen_removed(self, _: object) -> None:
        """Close a full-screen window whose screen was unplugged: it would cover the therapist's."""
        if self.window is not None and self.window.isFullScreen():
            self.close()

    def start_exercise(self, set_up: SessionSetup) -> None:
        self._set_up, self._goals_sounded = set_up, 0
        read = set_up.target_positive_deg, set_up.target_negative_deg
        self._guide = ExerciseGuide(set_up.exercise, *from_clinical_targets_deg(read, set_up.exercise))
        if self.window is not None:
            self.window.view.show_set_up(set_up)

    def show_rest(self, left: tuple[int, int, int, int] | None) -> None:
        """Show a rest: seconds left and in all, parts done and in all; None ends it."""
        self._is_resting = left is not None
        if left is not None:
            left_s, rest_s, done, asked = left
            share = math.ceil(10 * left_s / max(rest_s, 1)) / 10
            self._show_lasting_scene(GuideScene("rest", done=done, asked=asked, rest_share=share, rest_s=left_s))

    def show_done(self) -> None:
        scene = self.window.view.scene if self.window is not None else GuideScene()
        self._show_lasting_scene(GuideScene("done", asked=scene.asked, done=scene.done))

    def clear(self) -> None:
        """Remove the hand when measuring has ended."""
        if self.window is None or self.window.view.scene.phase != "done":
            self._show_lasting_scene(GuideScene())

    def hide_content(self) -> None:
        """Show nothing but a word until :meth:`show_content`, while the program is locked."""
        self._show_lasting_scene(GuideScene())
        self._is_hidden = True

    def show_content(self) -> None:
        self._is_hidden = False

    def _show_lasting_scene(self, scene: GuideScene) -> None:
        if self.window is not None and not self._is_hidden:
            self.window.show_lasting_scene(scene)

    def update(self, snapshot: ExerciseSnapshot) -> None:
        """Draw the present pose of the hand."""
        if self.window is None or not self.is_open or self._guide is None or self._is_resting or self._is_hidden:
            return
        self.window.show_live_scene(self._guide.update(snapshot))
        if self._guide.goals_reached > self._goals_sounded:
            self._goals_sounded = self._guide.goals_reached
            if self._context.patient_sound and math.isfinite(self.window.view.scene.goal_deg):
                QApplication.beep()


MAX_SCENE_AGE_MS = 900
"""A live scene disappears without a new one for this long."""
MIN_SIZE_PX = (480, 360)


class PatientWindow(QWidget):
    """Window that never takes the keyboard: space bar and pedal must reach the live screen.

    Esc closes it if the system has given it the keyboard all the same.
    """

    closed = Signal()

    def __init__(self, theme: Theme) -> None:
        super().__init__(None, Qt.WindowType.Window | Qt.WindowType.WindowDoesNotAcceptFocus)
        self.setAttribute(Qt.WidgetAttribute.WA_ShowWithoutActivating)
        self.setAttribute(Qt.WidgetAttribute.WA_QuitOnClose, False)
        self.setProperty("stays_when_locked", True)
        self.setWindowTitle(self.tr("Patient’s view (Esc closes it)"))
        self.setMinimumSize(*MIN_SIZE_PX)
        self.view = PatientView(theme)
        column_layout(self.view, margins=(0, 0, 0, 0), parent=self)
        self._stale_timer = QTimer(self, singleShot=True, interval=MAX_SCENE_AGE_MS)
        self._stale_timer.timeout.connect(lambda: self.view.show_scene(GuideScene()))

    def open_on_free_screen(self, other: QWidget) -> None:
        """Fill a screen without the main window; on the same screen open as a window."""
        own: QScreen = other.screen()
        free = [screen for screen in QGuiApplication.screens() if screen is not own]
        if free:
            self.setScreen(free[0])
            self.setGeometry(free[0].geometry())
            self.setWindowState(Qt.WindowState.WindowFullScreen)  # showFullScreen would take the keyboard
        else:
            self.resize(self.view.sizeHint().boundedTo(own.availableSize() * 0.7))
            self.setWindowState(Qt.WindowState.WindowNoState)
        self.show()

    def show_live_scene(self, scene: GuideScene) -> None:
        """Show a scene that disappears without the next one."""
        self.view.show_scene(scene)
        self._stale_timer.start()

    def show_lasting_scene(self, scene: GuideScene) -> None:
        """Show a scene until another one comes."""
        self._stale_timer.stop()
        self.view.show_scene(scene)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape:
            self.close()

    def closeEvent(self, event: QCloseEvent) -> None:
        self._stale_timer.stop()
        self.closed.emit()
        event.accept()
