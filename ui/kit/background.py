"""Background work of the window in a worker thread, with the result returned as a signal."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from typing import Any

import shiboken6
from PySide6.QtCore import QObject, QRunnable, Qt, QThreadPool, Signal

from carpus.ui.kit import language


class _TaskSignals(QObject):
    succeeded = Signal(object)
    failed = Signal(object)


class _Task(QRunnable):
    def __init__(self, work: Callable[[], Any], answer: _TaskSignals) -> None:
        super().__init__()
        self._work, self._signals, self._language = work, answer, language.thread_language()

    def run(self) -> None:
        fault: Exception | None = None
        result = None
        try:
            with language.use_language(self._language):
                result = self._work()
        except Exception as cause:  # the one catch at the top of this thread
            fault = cause
        with suppress(RuntimeError):  # the program has ended meanwhile, and the answer with its window
            if fault is None:
                self._signals.succeeded.emit(result)
            else:
                self._signals.failed.emit(fault)


class Background(QObject):
    """Runner of one task at a time, in order; callbacks run in the window's thread."""

    def __init__(self) -> None:
        super().__init__()
        self._pool = QThreadPool()
        self._pool.setMaxThreadCount(1)
        self._active_tasks: set[_TaskSignals] = set()

    def run(
        self,
        work: Callable[[], Any],
        on_done: Callable[[Any], None],
        on_failed: Callable[[Exception], None],
        owner: QObject | None = None,
    ) -> None:
        """Start ``work`` and call ``on_done`` or ``on_failed`` later, unless ``owner`` has been destroyed."""
        answer = _TaskSignals()
        self._active_tasks.add(answer)

        def finish(call: Callable[[Any], None], value: Any) -> None:
            self._active_tasks.discard(answer)
            answer.deleteLater()  # what it is connected to, which holds it in turn, would stay for good
            if owner is None or shiboken6.isValid(owner):
                call(value)

        queued = Qt.ConnectionType.QueuedConnection
        answer.succeeded.connect(lambda value: finish(on_done, value), queued)
        answer.failed.connect(lambda fault: finish(on_failed, fault), queued)
        self._pool.start(_Task(work, answer))

    @property
    def is_busy(self) -> bool:
        return bool(self._active_tasks)

    def join(self, timeout_ms: int = 60_000) -> bool:
        """Wait until all tasks are done, at most ``timeout_ms``; return whether they are.

        A slow computer stores a session for many seconds. What a dead disk leaves undone is finished at the next
        start.
        """
        return self._pool.waitForDone(timeout_ms)
