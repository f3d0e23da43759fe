"""Second step: the source of the frames."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QFileDialog, QWidget

from carpus.core.records.session_setup import SessionSetup
from carpus.ui.kit.button import ENTER_KEY, Button
from carpus.ui.kit.card import Card, progress_bar
from carpus.ui.kit.layouts import STRETCH, column_layout, fill, row_layout
from carpus.ui.kit.text import REGULAR, SEMIBOLD, Text, heading
from carpus.ui.kit.theme import MARGIN_PX, Theme
from carpus.ui.kit.translate import translate_phrase
from carpus.ui.screens.setup.option import Options
from carpus.ui.screens.tour.bubble import BubbleView
from carpus.ui.shell.current_selection import SourceChoice, SourceKind

PATTERNS = "*.oni *.db3 *.carpusraw"


class CameraScreen(QWidget):
    """Choice of the source; ``path_chosen`` carries the path of a chosen recording."""

    source_chosen = Signal(object)
    path_chosen = Signal(str)

    def __init__(self, theme: Theme, *, is_demo: bool = False) -> None:
        """Build the screen; a demo offers the simulated camera only."""
        super().__init__()
        self._theme, self._is_demo = theme, is_demo
        self._is_camera_ready = False
        self._camera_name = ""
        self._path = ""
        self._patient_id = ""
        self.start_folder = ""
        """Folder in which the dialogs for recordings open."""
        self.is_opening = False
        self.sources = Options(
            theme,
            [
                *([] if is_demo else [("camera", self.tr("Camera"), "")]),
                ("file", self.tr("Recording"), ""),
                (
                    "practice",
                    self.tr("Simulated camera"),
                    self.tr(
                        "A simulated hand does the exercise, so that you can try Carpus. The session is marked "
                        "as simulated."
                    ),
                ),
            ],
        )
        self.choose_file_button = Button(theme, self.tr("Choose a &file…"), icon="folder-open", height_px=40)
        self.choose_folder_button = Button(theme, self.tr("Choose a fol&der…"), icon="folder-open", height_px=40)
        self.position_label = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        self.progress_words = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        self.progress = progress_bar(self.tr("Progress"))
        self.bubble = BubbleView(theme)
        self.primary_button = Button(theme, "", "primary", hint=ENTER_KEY)
        self._build_layout()
        self.sources.chosen.connect(self._refresh)
        self.sources.accepted.connect(self._open)
        self.primary_button.clicked.connect(self._open)
        self.choose_file_button.clicked.connect(self._choose_file)
        self.choose_folder_button.clicked.connect(self._choose_folder)
        theme.changed.connect(self._fit)
        self._fit()

    def _build_layout(self) -> None:
        theme = self._theme
        left = column_layout(heading(theme, self.tr("Which image source?")), self.sources, gap=16)
        self._files = QWidget()
        row_layout(
            self.choose_file_button,
            self.choose_folder_button,
            STRETCH,
            gap=12,
            margins=(0, 0, 0, 0),
            parent=self._files,
        )
        fill(left, self._files, STRETCH)
        self._card = Card(theme, 24)
        body = self._card.body
        body.setSpacing(12)
        fill(body, Text(theme, self.tr("Before you continue"), 20, SEMIBOLD), self.position_label)
        light = self.tr("Camera above the hand, 60 cm or more away, looking straight down. No sun on the markers.")
        fill(body, Text(theme, light, 14, REGULAR, "text2", wrap=True), STRETCH, self.progress_words, self.progress)
        fill(body, self.bubble, self.primary_button)
        columns = row_layout(
            (left, 1), gap=MARGIN_PX, margins=(MARGIN_PX, MARGIN_PX - 4, MARGIN_PX, MARGIN_PX - 4), parent=self
        )
        columns.addWidget(self._card)

    def _fit(self) -> None:
        self._card.setFixedWidth(self._theme.px(376))

    def show_set_up(self, set_up: SessionSetup, kind: SourceKind) -> None:
        """Ask for the source; a recording chosen for another patient is dropped."""
        if set_up.patient_id != self._patient_id:
            self._patient_id, self._path = set_up.patient_id, ""
        self.position_label.setText(translate_phrase(set_up.exercise.position))
        self.show_opening(False)
        self.sources.choose(kind)
        self._refresh()

    def initial_focus(self) -> QWidget:
        return self.sources.current()

    def set_camera_ready(self, there: bool, name: str = "") -> None:
        """Show whether a camera is connected, and its name."""
        if (there, name) != (self._is_camera_ready, self._camera_name):
            self._is_camera_ready, self._camera_name = there, name
            self._refresh()

    def set_path(self, path: str) -> None:
        self._path = path
        self.sources.choose("file")
        self._refresh()

    def show_opening(self, opening: bool, words: str = "") -> None:
        """Disable the choice while a source is opened, and keep the keyboard focus here."""
        if opening and self.isVisible():
            self.setFocus(Qt.FocusReason.OtherFocusReason)
        self.is_opening = opening
        self.progress.setVisible(opening)
        self.progress.setRange(0, 0)
        self.progress_words.show_text(words)
        for widget in (self.sources, self._files):
            widget.setEnabled(not opening)
        self._refresh()

    def _refresh(self, *_: object) -> None:
        there = self._is_camera_ready
        if not self._is_demo:
            self.sources.option("camera").show_sentence(
                (self._camera_name or self.tr("The depth camera over the hand."))
                if there
                else self.tr("Plug it directly into the computer."),
                "good" if there else "bad",
                self.tr("Camera ready") if there else self.tr("No camera"),
            )
        recording = self.tr("A saved recording: a file of Carpus or of the camera (.oni, .db3), or an image folder.")
        self.sources.option("file").show_sentence(self._path or recording)
        kind = self.sources.value()
        self._files.setVisible(kind == "file")
        words = {
            "camera": self.tr("Open the camera"),
            "file": self.tr("Open the recording"),
            "practice": self.tr("Start the simulation"),
        }[str(kind)]
        missing = {"camera": not there, "file": not self._path}.get(str(kind), False)
        if missing:
            words = self.tr("No camera yet") if kind == "camera" else self.tr("Choose a recording first")
        if self.is_opening:
            words = self.tr("Opening…")
        self.primary_button.setEnabled(not missing and not self.is_opening)
        self.primary_button.set_label(words, hint=ENTER_KEY if self.primary_button.isEnabled() else "")

    def _open(self) -> None:
        if self.primary_button.isEnabled():
            kind = self.sources.value()
            self.source_chosen.emit(SourceChoice(kind, self._path if kind == "file" else ""))  # type: ignore[arg-type]

    def _choose_file(self) -> None:
        kinds = self.tr("Recordings ({patterns});;All files (*)").format(patterns=PATTERNS)
        path, _ = QFileDialog.getOpenFileName(self, self.tr("Choose a recording"), self._dialog_folder(), kinds)
        self._set_chosen_path(path)

    def _choose_folder(self) -> None:
        title = self.tr("Choose an image folder")
        self._set_chosen_path(QFileDialog.getExistingDirectory(self, title, self._dialog_folder()))

    def _dialog_folder(self) -> str:
        return str(Path(self._path).parent) if self._path else self.start_folder

    def _set_chosen_path(self, path: str) -> None:
        if path:
            self.path_chosen.emit(path)
            self.set_path(path)
            self.initial_focus().setFocus(Qt.FocusReason.OtherFocusReason)
