"""Two sessions read in the background, then the figures of both."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol, TypeVar

from PySide6.QtCore import QObject, Signal

from carpus.core.results.figures import SessionFigures
from carpus.core.session.values import Session
from carpus.core.types import ByteImage
from carpus.ui.background import Background
from carpus.ui.beside.shown import Watched

TASKS = 4
"""Both are read, and of both the figures are worked out."""
Found = TypeVar("Found")


class PairStore(Protocol):
    """What two sessions side by side need of the store; each is called in the background."""

    def session(self, session_id: str) -> Session: ...

    def figures_of(self, session_id: str) -> SessionFigures:
        """Its figures, with what a person left out or moved."""
        ...

    def picture(self, session_id: str, row: int) -> ByteImage | None: ...


class PairReader(QObject):
    """``went_on`` carries how many of :data:`TASKS` are done, ``read`` both sessions, ``ready`` both watched,
    ``failed`` the fault that ended it."""

    went_on = Signal(int)
    read = Signal(object)
    ready = Signal(object)
    failed = Signal(object)

    def __init__(self, owner: QObject, background: Background, store: PairStore) -> None:
        super().__init__(owner)
        self._background, self._store = background, store
        self._round = 0
        self._sessions: list[Session] = []
        self._watched: list[Watched] = []

    def begin(self, session_ids: tuple[str, str]) -> None:
        """Read these; what still comes of others is for nobody."""
        self._round += 1
        self._sessions, self._watched = [], []
        for session_id in session_ids:
            self._run(lambda one=session_id: self._store.session(one), self._take_session)  # type: ignore[misc]

    def _run(self, work: Callable[[], Found], done: Callable[[Found], None]) -> None:
        number = self._round

        def came(found: Found) -> None:
            if number == self._round:
                done(found)

        def failed(fault: Exception) -> None:
            if number == self._round:
                self._round += 1  # what else is under way is for nobody any more
                self.failed.emit(fault)

        self._background.run(work, came, failed, self)

    def _take_session(self, session: Session) -> None:
        self._sessions.append(session)
        self.went_on.emit(len(self._sessions))
        if len(self._sessions) == 2:
            self.read.emit(tuple(self._sessions))
            for one in self._sessions:
                self._run(lambda one=one: self._watch(one), self._take_watched)  # type: ignore[misc]

    def _watch(self, session: Session) -> Watched:
        return Watched.of(session, self._store.figures_of(session.header.session_id))

    def _take_watched(self, one: Watched) -> None:
        self._watched.append(one)
        self.went_on.emit(len(self._sessions) + len(self._watched))
        if len(self._watched) == 2:
            self.ready.emit(tuple(self._watched))
