"""Where a person last opened and saved things; the folder for papers before the first time."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any, Literal

from PySide6.QtCore import QStandardPaths
from PySide6.QtWidgets import QFileDialog, QWidget

Kind = Literal["recordings", "reports", "exports"]
FILE = "last_places.json"


class LastPlaces:
    """A folder for each kind of thing, kept in the data folder; only a convenience, so nothing here is a fault."""

    def __init__(self, folder: Path) -> None:
        self._path = folder / FILE

    def folder(self, kind: Kind) -> str:
        """Where to begin looking: the last place if it is still there, else documents, else home."""
        for candidate in (self._stored().get(kind), documents()):
            if isinstance(candidate, str) and candidate and Path(candidate).is_dir():
                return candidate
        return str(Path.home())

    def keep(self, kind: Kind, folder: str) -> None:
        """Remember a folder."""
        self._keep(kind, folder)

    def ask_where_to_save(self, window: QWidget, kind: Kind, name: str, title: str, kinds: str) -> Path | None:
        """Ask for a file to write, beginning at the last place, and remember that; None when the person changed their
        mind. The system's own dialog asks whether an old file may go."""
        path, _ = QFileDialog.getSaveFileName(window, title, str(Path(self.folder(kind)) / name), kinds)
        if not path:
            return None
        self.keep(kind, str(Path(path).parent))
        return Path(path)

    def _keep(self, name: str, value: str) -> None:
        try:
            self._path.write_text(json.dumps(self._stored() | {name: value}), encoding="utf-8")
        except OSError:
            return  # a full or read-only disk tells elsewhere

    def window(self) -> str:
        """The window's place as it was kept, empty before the first time."""
        kept = self._stored().get("window")
        return kept if isinstance(kept, str) else ""

    def keep_window(self, place: str) -> None:
        """Remember the window's place."""
        self._keep("window", place)

    def _stored(self) -> dict[str, Any]:
        try:
            found = json.loads(self._path.read_text(encoding="utf-8"))
        except (OSError, ValueError, RecursionError):
            return {}
        return found if isinstance(found, dict) else {}


def documents() -> str:
    """Where a person keeps papers."""
    return QStandardPaths.writableLocation(QStandardPaths.StandardLocation.DocumentsLocation)
