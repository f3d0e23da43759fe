"""Looks whether the clinic's server answers, beside the window: while it does not, the window says so and shows nothing
of it; when it is back, what was measured meanwhile is listed."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QObject, QTimer, Signal

from carpus.core.errors import CarpusFault, ServerGone
from carpus.core.records.library import Library
from carpus.core.records.new_sessions import Recovered, recover
from carpus.ui.background import Background

LOOK_MS = 4_000

Caught = tuple[Sequence[Recovered], Sequence[CarpusFault]]


class ServerWatch(QObject):
    """``gone`` when the server no longer answers; ``back`` with what :func:`recover` found, when it does again."""

    gone = Signal()
    back = Signal(object)

    def __init__(self, library: Library, parent: QObject) -> None:
        super().__init__(parent)
        self._library, self._background = library, Background()
        self._was_away = library.store.is_away
        self._clock = QTimer(self, interval=LOOK_MS)
        self._clock.timeout.connect(self._look)
        if library.store.server is not None:
            self._clock.start()

    def end(self) -> None:
        """The window closes."""
        self._clock.stop()
        self._background.wait()

    def _look(self) -> None:
        if not self._background.busy:
            self._background.run(lambda: _looked(self._library, self._was_away), self._take, self._fail, self)

    def _take(self, caught: Caught | None) -> None:
        if caught is not None:
            self._was_away = False
            self.back.emit(caught)

    def _fail(self, fault: Exception) -> None:
        if isinstance(fault, ServerGone) and not self._was_away:
            self._was_away = True
            self.gone.emit()


def _looked(library: Library, was_away: bool) -> Caught | None:
    """What was caught up with, None where there is nothing to. Raises :class:`ServerGone`."""
    assert library.store.server is not None
    library.store.server.look()
    if not was_away:
        return None
    caught = recover(library)
    if library.store.is_away:  # once more
        raise next(fault for fault in caught[1] if isinstance(fault, ServerGone))
    return caught
