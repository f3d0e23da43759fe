"""A repetition as a film: asked where to, written beside the window, noted like everything that leaves Carpus."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QWidget

from carpus.core.formats.film import UNFINISHED, write_film, write_picture
from carpus.core.records.library import Library
from carpus.ui.background import Background
from carpus.ui.last_places import LastPlaces
from carpus.ui.messages.files_written import tell_written
from carpus.ui.messages.messages import Messages
from carpus.ui.review.film import FilmWanted, film_pictures
from carpus.ui.theme import Theme


class Filming(QObject):
    """``filmed`` carries the path and the sessions that are in it."""

    filmed = Signal(str, object)

    def __init__(
        self,
        window: QWidget,
        tell: Messages,
        library: Library,
        places: LastPlaces,
        background: Background,
        theme: Theme,
    ) -> None:
        super().__init__(window)
        self._window, self._tell, self._library = window, tell, library
        self._places, self._background, self._theme = places, background, theme
        with suppress(OSError):  # of a program that was killed
            (library.folder / UNFINISHED).unlink(missing_ok=True)

    def save(self, wanted: FilmWanted) -> None:
        """Ask for a name and write it."""
        session_id = wanted.session_id
        head = wanted.session.header
        what = f"{head.exercise.lower().replace('_', '-')}_{head.hand}"
        suffix = ".mp4" if wanted.rate_hz else ".png"
        name = f"carpus_{head.when:%Y-%m-%d_%H-%M}_{what}_{wanted.number}{suffix}"  # of whom it does not say
        title, kinds = self.tr("Save film"), "MP4 (*.mp4)"
        if not wanted.rate_hz:
            title, kinds = self.tr("Save picture"), "PNG (*.png)"
        path = self._places.ask_where_to_save(self._window, "exports", name, title, kinds)
        if path is None:
            return
        target = path if path.suffix.lower() == suffix else path.with_name(f"{path.name}{suffix}")

        def write() -> Path:
            pictures = film_pictures(self._theme, wanted, lambda row: self._library.picture(session_id, row))
            if not wanted.rate_hz:
                return write_picture(target, next(pictures))
            return write_film(target, pictures, wanted.rate_hz, self._library.folder)

        def written(done: Path) -> None:
            self.filmed.emit(str(done), [session_id])
            tell_written(self._tell, str(done.parent), [done.name])

        self._background.run(write, written, self._tell.fault, self)
