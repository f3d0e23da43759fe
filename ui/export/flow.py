"""A session in open formats: asked which and where to, written beside the window, stopped by a press."""

from __future__ import annotations

import threading
from collections.abc import Sequence

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtWidgets import QFileDialog

from carpus.core.formats.new_output import TableForm
from carpus.ui.export.sheet import ExportSheet
from carpus.ui.flow import ScreenContext
from carpus.ui.messages.messages import tell_written


class Exporting(QObject):
    """The sheet of formats, and what is written of it."""

    _stepped = Signal(int, int)

    def __init__(self, context: ScreenContext) -> None:
        super().__init__(context.shell)
        self._context = context
        self._stop = threading.Event()
        self._session_id = ""
        self.formats = ExportSheet(context.shell, context.theme)
        self.formats.wanted.connect(self._export)
        self.formats.stop.connect(self._stop.set)
        self.formats.more.connect(lambda: context.way.show("settings", "research"))
        self._stepped.connect(self.formats.progress, Qt.ConnectionType.QueuedConnection)

    def ask(self, session_id: str) -> None:
        self._session_id = session_id
        self.formats.begin()

    def _export(self, formats: Sequence[str], deidentified: bool, form: TableForm) -> None:
        """Beside the window; the sheet shows how far it is and stops it."""
        context, session_id = self._context, self._session_id
        start = context.places.folder("exports")
        folder = QFileDialog.getExistingDirectory(context.shell, self.tr("Export into a folder"), start)
        if not folder:
            return
        context.places.keep("exports", folder)
        self._stop.clear()
        self.formats.running()

        def write() -> Sequence[str]:
            return context.library.export(
                session_id, folder, formats, self._stepped.emit, self._stop.is_set, deidentified, form
            )

        def written(names: Sequence[str]) -> None:
            self.formats.close_sheet()
            if names:
                tell_written(context.messages, folder, names)

        def refused(fault: Exception) -> None:
            self.formats.close_sheet()
            context.messages.fault(fault)

        context.background.run(write, written, refused)
