"""A session in open formats: which of them and where to, how far it is, until all of it is written."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QT_TRANSLATE_NOOP, QCoreApplication, QLocale, Signal
from PySide6.QtWidgets import QWidget

from carpus.core.formats.formats import FORMATS
from carpus.core.formats.new_output import FOR_PROGRAMS
from carpus.ui.controls.button import Button, Tick
from carpus.ui.controls.field import Combo, Labelled
from carpus.ui.controls.layouts import STRETCH, fill, in_line
from carpus.ui.controls.progress_bar import ThinBar
from carpus.ui.controls.sheet import Sheet
from carpus.ui.controls.text import SEMIBOLD, Text
from carpus.ui.saved_table import OFFERED, form_of, own_region
from carpus.ui.theme import Theme

CONTEXT = "ExportSheet"
NAMES = {
    "csv": QT_TRANSLATE_NOOP("ExportSheet", "Tables (CSV): angles, joints, markers, events, measures"),
    "json": QT_TRANSLATE_NOOP("ExportSheet", "Measures with their origin (JSON)"),
    "c3d": QT_TRANSLATE_NOOP("ExportSheet", "Markers for motion capture programs (C3D)"),
    "trc": QT_TRANSLATE_NOOP("ExportSheet", "Markers for OpenSim (TRC)"),
    "mot": QT_TRANSLATE_NOOP("ExportSheet", "Angles for OpenSim (MOT)"),
    "bids": QT_TRANSLATE_NOOP("ExportSheet", "Data set for research (BIDS-Motion)"),
    "h5": QT_TRANSLATE_NOOP("ExportSheet", "The session itself, for another Carpus"),
}
"""A format without words here goes by its short name."""


class ExportSheet(Sheet):
    """``wanted`` carries the formats, whether nobody shall be found by it and the form of tables; ``stop`` ends an
    export on the way; ``more`` asks for the settings that offer all formats instead."""

    wanted = Signal(object, bool, object)
    stop = Signal()
    more = Signal()

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 600)
        body = self.card.body
        body.setSpacing(2)
        self.title = Text(theme, self.tr("Export this session"), 20, SEMIBOLD, wrap=True)
        self.words = Text(theme, self.tr("Files that are there are never overwritten."), 14, token="text2", wrap=True)
        fill(body, self.title, self.words, 8)
        self.boxes: dict[str, Tick] = {}
        for name in FORMATS:
            words = QCoreApplication.translate(CONTEXT, str(NAMES[name])) if name in NAMES else name.upper()
            self.boxes[name] = self._tick(words)
        words = self.tr("Tables of angles, repetitions and measures (CSV), for any spreadsheet.")
        self.plain = Text(theme, words, 14, wrap=True)
        self.plain.hide()
        fill(body, self.plain, 8)
        self.tables_for = self._region_choice()
        fill(body, Labelled(theme, self.tr("&Tables for"), self.tables_for), 8)
        self.nobody = self._tick(self.tr("Nobody can be found by it: random name, no dates (day 1, 2 …), no notes"))
        self.bar = ThinBar(theme, self.tr("How far the export is"))
        fill(body, 8, self.bar, 8)
        self.close_button = Button(theme, self.tr("Cancel"), "plain", hint=self.tr("Esc"), height_px=44)
        self.take = Button(theme, self.tr("Choose the folder…"), "primary", height_px=44)
        self.close_button.clicked.connect(self.leave)
        self.take.clicked.connect(self._take)
        self.set_default(self.take)
        self.more_button = Button(theme, self.tr("&Other formats: settings…"), "quiet", height_px=44)
        self.more_button.setToolTip(self.tr("JSON, C3D, TRC, MOT and BIDS are offered once “For research” is on."))
        self.more_button.clicked.connect(self._ask_for_more)
        body.addLayout(in_line(self.more_button, STRETCH, self.close_button, self.take, gap=10))
        self._runs, self._research = False, True
        for box in self.boxes.values():
            box.toggled.connect(self._check)
        self.boxes["csv"].setChecked(True)
        self._show_state()

    def show_research(self, *, on: bool) -> None:
        """All formats, or tables alone, which any program of tables opens."""
        for name, box in self.boxes.items():
            box.setVisible(on)
            if not on:
                box.setChecked(name == "csv")
        self.plain.setVisible(not on)
        self._research = on
        self._show_state()

    @property
    def formats(self) -> Sequence[str]:
        return [name for name, box in self.boxes.items() if box.isChecked()]

    def begin(self) -> None:
        """Ask; what was ticked last time is ticked still."""
        self._runs = False
        self._show_state()
        self.open(self.take)

    def running(self) -> None:
        self._runs = True
        self.bar.begin()
        self._show_state()

    def progress(self, done: int, total: int) -> None:
        self.bar.show_progress(done, total)

    def leave(self) -> None:
        """Close; while files are being written stop that first."""
        if self._runs:
            self.close_button.setEnabled(False)
            self.stop.emit()
        else:
            super().leave()

    def _tick(self, words: str) -> Tick:
        tick = Tick(self._theme, words)
        self.card.body.addLayout(in_line(tick, STRETCH))
        return tick

    def _region_choice(self) -> Combo:
        """Offers the person's own region first, and programs last."""
        own = own_region()
        regions = [own, *(region for region in OFFERED if region != own)]
        choices = [(form_of(region), self._region_words(region)) for region in regions]
        field = Combo()
        field.offer([*choices, (FOR_PROGRAMS, self.tr("programs: 1.5 and a comma, the same everywhere"))])
        return field

    def _region_words(self, region: str) -> str:
        locale = QLocale(region)
        name = f"{locale.nativeTerritoryName()} ({locale.nativeLanguageName()})"
        example = f"1{form_of(region).decimal}5"
        return self.tr("a spreadsheet in {region}: {example}").format(region=name, example=example)

    def _check(self) -> None:
        self.take.setEnabled(bool(self.formats))

    def _take(self) -> None:
        if self.formats and not self._runs:
            self.wanted.emit(self.formats, self.nobody.isChecked(), self.tables_for.currentData())

    def _ask_for_more(self) -> None:
        self.close_sheet()
        self.more.emit()

    def _show_state(self) -> None:
        runs = self._runs
        self.more_button.setVisible(not self._research and not runs)
        self.bar.setVisible(runs)
        self.take.setVisible(not runs)
        self.close_button.setEnabled(True)
        self.close_button.set_face(self.tr("Stop") if runs else self.tr("Cancel"))
        for box in (*self.boxes.values(), self.nobody, self.tables_for):
            box.setEnabled(not runs)
