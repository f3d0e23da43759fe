"""Export of a session in the background."""

from __future__ import annotations

import threading
from collections.abc import Sequence

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtWidgets import QFileDialog

from carpus.core.formats.output_files import TableDialect
from carpus.ui.screens.export.dialog import ExportDialog
from carpus.ui.shell.flow import ScreenContext
from carpus.ui.shell.messages import show_files_written


class ExportController(QObject):
    """Dialog of formats, and the export itself."""

    _progress_changed = Signal(int, int)

    def __init__(self, context: ScreenContext) -> None:
        super().__init__(context.window)
        self._context = context
        self._stop_event = threading.Event()
        self._session_id = ""
        self.dialog = ExportDialog(context.window, context.theme)
        self.dialog.export_requested.connect(self._export)
        self.dialog.stop_requested.connect(self._stop_event.set)
        self.dialog.more_formats_requested.connect(lambda: context.navigator.open_screen("settings", "research"))
        self._progress_changed.connect(self.dialog.show_progress, Qt.ConnectionType.QueuedConnection)

    def choose_formats(self, session_id: str) -> None:
        self._session_id = session_id
        self.dialog.request_formats()

    def _export(self, formats: Sequence[str], deidentified: bool, form: TableDialect) -> None:
        """Ask for a folder and export into it; the dialog shows the progress."""
        context, session_id = self._context, self._session_id
        start = context.recent_locations.folder("exports")
        folder = QFileDialog.getExistingDirectory(context.window, self.tr("Export to folder"), start)
        if not folder:
            return
        context.recent_locations.save("exports", folder)
        self._stop_event.clear()
        self.dialog.show_running()

        def write() -> Sequence[str]:
            return context.library.export(
                session_id, folder, formats, self._progress_changed.emit, self._stop_event.is_set, deidentified, form
            )

        def on_written(names: Sequence[str]) -> None:
            self.dialog.close_dialog()
            if names:
                show_files_written(context.messages, folder, names)

        def on_failed(fault: Exception) -> None:
            self.dialog.close_dialog()
            context.messages.show_fault(fault)

        context.background.run(write, on_written, on_failed)
