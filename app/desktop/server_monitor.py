"""Checks in the background whether the clinic's server answers.

Without the server the window shows no records; when it is back, sessions measured meanwhile are listed.
"""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QObject, QTimer, Signal

from carpus.core.model.errors import CarpusFault, ServerUnavailable
from carpus.core.records.data_folder import DataFolder
from carpus.core.records.new_sessions import RecoveredSession, recover_sessions
from carpus.ui.kit.background import Background

CHECK_EVERY_MS = 4_000

CatchUp = tuple[Sequence[RecoveredSession], Sequence[CarpusFault]]


class ServerMonitor(QObject):
    """Emits ``server_lost``, and ``server_restored`` with the result of :func:`recover`."""

    server_lost = Signal()
    server_restored = Signal(object)

    def __init__(self, library: DataFolder, parent: QObject) -> None:
        super().__init__(parent)
        self._library, self._background = library, Background()
        self._was_away = library.store.is_server_away
        self._clock = QTimer(self, interval=CHECK_EVERY_MS)
        self._clock.timeout.connect(self._check)
        if library.store.server is not None:
            self._clock.start()

    def stop(self) -> None:
        self._clock.stop()
        self._background.join()

    def _check(self) -> None:
        if not self._background.is_busy:
            self._background.run(
                lambda: _check_server(self._library, self._was_away), self._handle_catch_up, self._handle_fault, self
            )

    def _handle_catch_up(self, caught: CatchUp | None) -> None:
        if caught is not None:
            self._was_away = False
            self.server_restored.emit(caught)

    def _handle_fault(self, fault: Exception) -> None:
        if isinstance(fault, ServerUnavailable) and not self._was_away:
            self._was_away = True
            self.server_lost.emit()


def _check_server(library: DataFolder, was_away: bool) -> CatchUp | None:
    """Return what was recovered after an outage, None otherwise. Raises :class:`ServerUnavailable`."""
    assert library.store.server is not None
    library.store.server.ping()
    if not was_away:
        return None
    caught = recover_sessions(library)
    if library.store.is_server_away:  # once more
        raise next(fault for fault in caught[1] if isinstance(fault, ServerUnavailable))
    return caught
