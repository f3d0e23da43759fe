"""Cyclic garbage collection in the window's thread only: Qt objects must not be destroyed in another thread."""

from __future__ import annotations

import gc

from PySide6.QtCore import QObject, QTimer

COLLECT_INTERVAL_MS = 100


def collect_due_garbage() -> None:
    """Collect the oldest generation that is due, as Python's own collector would."""
    for generation in (2, 1, 0):
        if gc.get_count()[generation] > gc.get_threshold()[generation]:
            gc.collect(generation)
            return


class GarbageCollector(QObject):
    """Timer that replaces Python's collector, which runs in whichever thread has just allocated."""

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        gc.disable()
        self._timer = QTimer(self, interval=COLLECT_INTERVAL_MS)
        self._timer.timeout.connect(collect_due_garbage)
        self._timer.start()
