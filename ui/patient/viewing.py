"""The patient's own view: when it opens, what it follows, and what stands there while nothing is measured."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Qt, QTimer, Signal
from PySide6.QtGui import QCloseEvent, QGuiApplication, QKeyEvent, QScreen
from PySide6.QtWidgets import QApplication, QWidget

from carpus.core.hand.forearm_rotation import stored_targets_deg
from carpus.core.records.set_up import SetUp
from carpus.ui.controls.layouts import in_column
from carpus.ui.patient.guide import Glance, Guide, GuideScene
from carpus.ui.patient.view import PatientView
from carpus.ui.theme import Theme

if TYPE_CHECKING:
    from carpus.ui.flow import ScreenContext


class PatientViewing(QObject):
    """One window at most, made when it is first wanted; it draws what the live screen's own beat tells it (``follow``).
    ``show_open`` hears whether it is open."""

    def __init__(self, context: ScreenContext, show_open: Callable[[bool], None]) -> None:
        super().__init__(context.shell)
        self._context, self._show_open = context, show_open
        self._set_up: SetUp | None = None
        self._guide: Guide | None = None
        self._sounded = 0
        self._rests = self._hidden = False
        self.window: PatientWindow | None = None
        application = QGuiApplication.instance()
        if isinstance(application, QGuiApplication):
            application.screenRemoved.connect(self._screen_gone)

    @property
    def is_open(self) -> bool:
        return self.window is not None and self.window.isVisible()

    def toggle(self) -> None:
        if self.is_open:
            self.close()
            return
        if self.window is None:
            self.window = PatientWindow(self._context.theme)
            self.window.closed.connect(lambda: self._show_open(False))
        self.window.view.sound_on = self._context.patient_sound
        self.window.view.begin(self._set_up)
        self.window.open_beside(self._context.shell)
        self._show_open(True)

    def close(self) -> None:
        """Let it go; may be called although it is not there."""
        if self.window is not None:
            self.window.close()

    def uncover(self) -> bool:
        """Let it go where it lies over the other window; whether it did."""
        window = self.window
        if (
            window is None
            or not self.is_open
            or window.isMinimized()
            or window.screen() is not self._context.shell.screen()
        ):
            return False
        window.close()
        return True

    def _screen_gone(self, _: object) -> None:
        """A screen was unplugged: what filled it must not cover the therapist's."""
        if self.window is not None and self.window.isFullScreen():
            self.close()

    def begin(self, set_up: SetUp) -> None:
        self._set_up, self._sounded = set_up, 0
        read = set_up.target_positive_deg, set_up.target_negative_deg
        self._guide = Guide(set_up.exercise, *stored_targets_deg(read, set_up.exercise))
        if self.window is not None:
            self.window.view.begin(set_up)

    def rest(self, left: tuple[int, int, int, int] | None) -> None:
        """Between two parts of a set: seconds left and in all, parts done and in all; None: no rest any more."""
        self._rests = left is not None
        if left is not None:
            left_s, rest_s, done, asked = left
            share = math.ceil(10 * left_s / max(rest_s, 1)) / 10
            self._stand(GuideScene("rest", done=done, asked=asked, rest_share=share, rest_s=left_s))

    def stored(self) -> None:
        self._stand(GuideScene("done", asked=self._asked, done=self._done))

    def leave(self) -> None:
        """Nobody measures any more: nothing of the hand is left standing."""
        if self.window is None or self.window.view.scene.phase != "done":
            self._stand(GuideScene())

    def hide_all(self) -> None:
        """The program is locked: nothing but a word, whatever still runs, until :meth:`show_again`."""
        self._stand(GuideScene())
        self._hidden = True

    def show_again(self) -> None:
        self._hidden = False

    @property
    def _asked(self) -> int:
        return self.window.view.scene.asked if self.window is not None else 0

    @property
    def _done(self) -> int:
        return self.window.view.scene.done if self.window is not None else 0

    def _stand(self, scene: GuideScene) -> None:
        if self.window is not None and not self._hidden:
            self.window.show_standing(scene)

    def follow(self, glance: Glance) -> None:
        """Draw what the hand does now."""
        if self.window is None or not self.is_open or self._guide is None or self._rests or self._hidden:
            return
        self.window.show_running(self._guide.take(glance))
        if self._guide.reached > self._sounded:
            self._sounded = self._guide.reached
            if self._context.patient_sound and math.isfinite(self.window.view.scene.goal_deg):
                QApplication.beep()


STALE_MS = 900
"""Where nothing was told for so long nothing old is left standing."""
LEAST_PX = (480, 360)


class PatientWindow(QWidget):
    """Never takes the keyboard: space bar and pedal go on stopping the recording. ``closed`` when it goes; Esc closes
    it, also where the system has given it the keyboard."""

    closed = Signal()

    def __init__(self, theme: Theme) -> None:
        super().__init__(None, Qt.WindowType.Window | Qt.WindowType.WindowDoesNotAcceptFocus)
        self.setAttribute(Qt.WidgetAttribute.WA_ShowWithoutActivating)
        self.setAttribute(Qt.WidgetAttribute.WA_QuitOnClose, False)
        self.setProperty("stays_when_locked", True)
        self.setWindowTitle(self.tr("Patient’s view (Esc closes it)"))
        self.setMinimumSize(*LEAST_PX)
        self.view = PatientView(theme)
        in_column(self.view, margins=(0, 0, 0, 0), within=self)
        self._watch = QTimer(self, singleShot=True, interval=STALE_MS)
        self._watch.timeout.connect(lambda: self.view.show_scene(GuideScene()))

    def open_beside(self, other: QWidget) -> None:
        """Show on a screen that the other window is not on; on the same one as a window."""
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

    def show_running(self, scene: GuideScene) -> None:
        """A scene that is true only now: without the next one it goes."""
        self.view.show_scene(scene)
        self._watch.start()

    def show_standing(self, scene: GuideScene) -> None:
        """A scene that holds until another one comes."""
        self._watch.stop()
        self.view.show_scene(scene)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape:
            self.close()

    def closeEvent(self, event: QCloseEvent) -> None:
        self._watch.stop()
        self.closed.emit()
        event.accept()
