"""The patient's own window: over the whole of a second screen, or one that is put where there is room."""

from __future__ import annotations

from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtGui import QCloseEvent, QGuiApplication, QScreen
from PySide6.QtWidgets import QVBoxLayout, QWidget

from carpus.ui.patient.guide import GuideScene
from carpus.ui.patient.view import PatientView
from carpus.ui.theme import Theme

STALE_MS = 900
"""Where nothing was told for so long nothing old is left standing."""
LEAST_PX = (480, 360)


class PatientWindow(QWidget):
    """Never takes the keyboard: space bar and pedal go on stopping the recording. ``closed`` when it goes."""

    closed = Signal()

    def __init__(self, theme: Theme) -> None:
        super().__init__(None, Qt.WindowType.Window | Qt.WindowType.WindowDoesNotAcceptFocus)
        self.setAttribute(Qt.WidgetAttribute.WA_ShowWithoutActivating)
        self.setAttribute(Qt.WidgetAttribute.WA_QuitOnClose, False)
        self.setProperty("stays_when_locked", True)
        self.setWindowTitle("Carpus")
        self.setMinimumSize(*LEAST_PX)
        self.view = PatientView(theme)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(self.view)
        self._watch = QTimer(self)
        self._watch.setSingleShot(True)
        self._watch.setInterval(STALE_MS)
        self._watch.timeout.connect(lambda: self.view.show_scene(GuideScene()))

    def open_beside(self, other: QWidget) -> None:
        """Show on a screen that the other window is not on; on the same one as a window."""
        own: QScreen | None = other.screen()
        free = [screen for screen in QGuiApplication.screens() if screen is not own]
        if free:
            self.setScreen(free[0])
            self.setGeometry(free[0].geometry())
            self.setWindowState(Qt.WindowState.WindowFullScreen)  # showFullScreen would take the keyboard
        else:
            self.resize(self.view.sizeHint())
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

    def closeEvent(self, event: QCloseEvent) -> None:
        self._watch.stop()
        self.closed.emit()
        event.accept()
