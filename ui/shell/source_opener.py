"""Opening and closing of sources in the background; a source no longer wanted is closed again."""

from __future__ import annotations

import threading
from collections.abc import Callable

from PySide6.QtCore import QObject, Signal

from carpus.core.records.session_setup import SessionSetup
from carpus.ui.kit.background import Background
from carpus.ui.shell.current_selection import CurrentSelection, OpenSource, SourceChoice

Progress = Callable[[int, int], None]
"""Called with the number of frames done and in all."""
OpenSourceFunction = Callable[[SourceChoice, SessionSetup, Progress], OpenSource]
"""Opens a source. It waits for camera, disk or renderer, so it runs in the background."""


class OpeningCancelledError(Exception):
    """Raised inside a long opening or rendering to cancel it."""


class SourceOpener(QObject):
    """Opens one source at a time.

    Signals: ``opening`` with the :class:`SourceChoice`, ``progress_changed`` with frames done and in all, then
    ``opened`` or ``failed`` with a fault; ``closing`` when the running source is closed.
    """

    opening = Signal(object)
    opened = Signal()
    failed = Signal(object)
    progress_changed = Signal(int, int)
    closing = Signal()

    def __init__(
        self,
        open_source: OpenSourceFunction,
        current: CurrentSelection,
        background: Background,
        on_close_error: Callable[[Exception], None],
        parent: QObject,
    ) -> None:
        super().__init__(parent)
        self._open_source, self._current = open_source, current
        self._shared_background, self._on_close_error = background, on_close_error
        self._background = Background()  # whatever else is to be done waits for no camera
        self._stop_event = threading.Event()
        self._opened_sources: list[OpenSource] = []
        self._request_number = 0
        self._last_percent = -1

    def open(self, choice: SourceChoice) -> None:
        """Open a source for the chosen set-up; ``opened`` or ``failed`` follows unless it is cancelled."""
        set_up = self._current.set_up
        assert set_up is not None
        self._current.source_choice = choice
        self._request_number += 1
        number = self._request_number
        self._last_percent = -1
        self.opening.emit(choice)
        self._background.run(
            lambda: self._opened_sources.append(self._open_source(choice, set_up, self._report_progress)),
            lambda _: self._on_opened(number),
            lambda fault: self._on_failed(number, fault),
        )

    def close_source(self) -> None:
        """Close the source, also one that is still being opened."""
        self._request_number += 1
        source, self._current.source = self._current.source, None
        if source is not None:
            self.closing.emit()
            self._shared_background.run(source.measuring.close, lambda _: None, self._on_close_error)

    def shut_down(self) -> None:
        """Wait for a source that is being opened, and close it."""
        self._request_number += 1
        self._stop_event.set()
        self._background.join()
        while self._opened_sources:
            self._opened_sources.pop().measuring.close()

    def _report_progress(self, done: int, total: int) -> None:
        """Emit the progress at each percent; called from the background for every frame."""
        if self._stop_event.is_set():
            raise OpeningCancelledError
        percent = 100 * done // max(total, 1)
        if percent != self._last_percent:
            self._last_percent = percent
            self.progress_changed.emit(done, total)

    def _on_opened(self, number: int) -> None:
        source = self._opened_sources.pop(0)
        if number == self._request_number:
            self._current.source = source
            self.opened.emit()
        else:
            self._background.run(source.measuring.close, lambda _: None, lambda _: None)

    def _on_failed(self, number: int, fault: Exception) -> None:
        if number == self._request_number and not isinstance(fault, OpeningCancelledError):
            self.failed.emit(fault)
