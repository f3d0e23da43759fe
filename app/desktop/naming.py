"""Which camera it is, asked before it is calibrated or checked where it does not tell its number itself."""

from __future__ import annotations

import threading
from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QObject

from carpus.core.capture.calibrated import SERIAL
from carpus.core.capture.given_name import is_nameless, keep_name, tidy_name
from carpus.core.capture.source import SourceInfo
from carpus.ui.background import Background
from carpus.ui.camera_calibration.name_sheet import CameraNameSheet


class Naming(QObject):
    """Asks over a screen whose camera is open; nobody looks at its pictures before it is known which one.
    ``begin_again`` opens the camera anew, which then has its name and what is kept under it; ``leave`` lets it go."""

    def __init__(
        self,
        parent: QObject,
        sheet: CameraNameSheet,
        background: Background,
        begin_again: Callable[[], None],
        leave: Callable[[], None],
        failed: Callable[[Exception], None],
    ) -> None:
        super().__init__(parent)
        self._sheet, self._background, self._begin_again, self._failed = sheet, background, begin_again, failed
        self._kind, self._folder = "", Path()
        self._now, self._said = "", ""
        self._known = threading.Event()
        sheet.named.connect(self._named)
        sheet.refused.connect(leave)

    def begin(self) -> threading.Event:
        """A camera is being opened; what is returned is set once it is known which one it is."""
        self._sheet.dismiss()
        self._known = threading.Event()
        return self._known

    def opened(self, info: SourceInfo, folder: Path) -> None:
        """A camera is open: go on, or ask first."""
        self._kind, self._folder = info.name, folder
        self._now = info.settings.get(SERIAL, "")
        if not is_nameless(info.settings) or (self._now and self._now == self._said):
            self._said = ""
            self._known.set()
        else:
            self._sheet.begin(self._now)

    def end(self) -> None:
        """The camera was let go; a name that is still being kept opens it no more."""
        self._sheet.dismiss()
        self._known = threading.Event()

    def _named(self, typed: str) -> None:
        name, kind, folder, known = tidy_name(typed), self._kind, self._folder, self._known
        if name == self._now:
            self._known.set()
            return

        def kept(as_kept: str) -> None:
            if known is self._known:  # nobody has left meanwhile
                self._said = as_kept if as_kept == name else ""  # another than was typed is shown before it is used
                self._begin_again()

        self._background.run(lambda: keep_name(folder, kind, name), kept, self._failed, self)
