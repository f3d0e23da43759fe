"""Dialog of an export: formats and region, then its progress."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QT_TRANSLATE_NOOP, QCoreApplication, QLocale, Signal
from PySide6.QtWidgets import QCheckBox, QWidget

from carpus.core.formats.export import FORMATS
from carpus.core.formats.output_files import MACHINE_DIALECT
from carpus.ui.kit.button import Button
from carpus.ui.kit.card import progress_bar
from carpus.ui.kit.dialog import Dialog
from carpus.ui.kit.field import Combo, LabelledField
from carpus.ui.kit.layouts import STRETCH, fill, row_layout
from carpus.ui.kit.table_file import OFFERED_REGIONS, regional_table_form, user_region
from carpus.ui.kit.text import SEMIBOLD, Text
from carpus.ui.kit.theme import Theme

TRANSLATION_CONTEXT = "ExportDialog"
FORMAT_NAMES = {
    "csv": QT_TRANSLATE_NOOP("ExportDialog", "Tables (CSV): angles, joints, markers, events, values"),
    "json": QT_TRANSLATE_NOOP("ExportDialog", "Values with their origin (JSON)"),
    "c3d": QT_TRANSLATE_NOOP("ExportDialog", "Markers for motion capture programs (C3D)"),
    "trc": QT_TRANSLATE_NOOP("ExportDialog", "Markers for OpenSim (TRC)"),
    "mot": QT_TRANSLATE_NOOP("ExportDialog", "Angles for OpenSim (MOT)"),
    "bids": QT_TRANSLATE_NOOP("ExportDialog", "Data set for research (BIDS-Motion)"),
    "fhir": QT_TRANSLATE_NOOP("ExportDialog", "Values for a hospital system (FHIR R4)"),
    "h5": QT_TRANSLATE_NOOP("ExportDialog", "Session file, for another Carpus installation"),
}
"""A format that is missing here is shown by its short name."""


class ExportDialog(Dialog):
    """Formats of an export.

    Signals: ``export_requested`` with formats, de-identification and table format; ``stop_requested``;
    ``more_formats_requested`` for the settings that offer all formats.
    """

    export_requested = Signal(object, bool, object)
    stop_requested = Signal()
    more_formats_requested = Signal()

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 600)
        body = self.card.body
        body.setSpacing(2)
        self.title = Text(theme, self.tr("Export this session"), 20, SEMIBOLD, wrap=True)
        self.words = Text(theme, self.tr("Existing files are never overwritten."), 14, token="text2", wrap=True)
        fill(body, self.title, self.words, 8)
        self.format_ticks: dict[str, QCheckBox] = {}
        for name in FORMATS:
            words = (
                QCoreApplication.translate(TRANSLATION_CONTEXT, str(FORMAT_NAMES[name]))
                if name in FORMAT_NAMES
                else name.upper()
            )
            self.format_ticks[name] = self._add_tick(words)
        words = self.tr("Tables of angles, repetitions and values (CSV), for any spreadsheet.")
        self.tables_only_text = Text(theme, words, 14, wrap=True)
        self.tables_only_text.hide()
        fill(body, self.tables_only_text, 8)
        self.region_choice = self._make_region_choice()
        fill(body, LabelledField(theme, self.tr("&Tables for"), self.region_choice), 8)
        self.deidentify_tick = self._add_tick(self.tr("De-identified: random name, relative days, no notes"))
        self.bar = progress_bar(self.tr("Progress of the export"))
        fill(body, 8, self.bar, 8)
        self.close_button = Button(theme, self.tr("Cancel"), "plain", hint=self.tr("Esc"), height_px=44)
        self.folder_button = Button(theme, self.tr("Choose folder…"), "primary", height_px=44)
        self.close_button.clicked.connect(self.dismiss)
        self.folder_button.clicked.connect(self._request_export)
        self.set_default(self.folder_button)
        self.more_button = Button(theme, self.tr("&Other formats…"), "quiet", height_px=44)
        self.more_button.setToolTip(
            self.tr("For JSON, C3D, TRC, MOT and BIDS, turn on “For research” in the settings.")
        )
        self.more_button.clicked.connect(self._request_more_formats)
        body.addLayout(row_layout(self.more_button, STRETCH, self.close_button, self.folder_button, gap=10))
        self._is_running, self._shows_research = False, True
        for box in self.format_ticks.values():
            box.toggled.connect(lambda _: self.folder_button.setEnabled(bool(self.formats)))
        self.format_ticks["csv"].setChecked(True)
        self._show_state()

    def show_research(self, *, on: bool) -> None:
        """Offer all formats, or tables only."""
        for name, box in self.format_ticks.items():
            box.setVisible(on)
            if not on:
                box.setChecked(name == "csv")
        self.tables_only_text.setVisible(not on)
        self._shows_research = on
        self._show_state()

    @property
    def formats(self) -> Sequence[str]:
        return [name for name, box in self.format_ticks.items() if box.isChecked()]

    def request_formats(self) -> None:
        """Open with the last choice."""
        self._is_running = False
        self._show_state()
        self.open(self.folder_button)

    def show_running(self) -> None:
        self._is_running = True
        self.bar.setRange(0, 0)
        self._show_state()

    def show_progress(self, done: int, total: int) -> None:
        self.bar.setRange(0, max(total, 1))
        self.bar.setValue(done)

    def dismiss(self) -> None:
        """Stop a running export, else close."""
        if self._is_running:
            self.close_button.setEnabled(False)
            self.stop_requested.emit()
        else:
            super().dismiss()

    def _add_tick(self, words: str) -> QCheckBox:
        tick = QCheckBox(words)
        self.card.body.addLayout(row_layout(tick, STRETCH))
        return tick

    def _make_region_choice(self) -> Combo:
        """Return the choice of regions: the user's first, other programs last."""
        own_region = user_region()
        regions = [own_region, *(region for region in OFFERED_REGIONS if region != own_region)]
        choices = [(regional_table_form(region), self._region_words(region)) for region in regions]
        field = Combo()
        field.set_choices([*choices, (MACHINE_DIALECT, self.tr("other programs: 1.5, separated by commas"))])
        return field

    def _region_words(self, region: str) -> str:
        locale = QLocale(region)
        name = f"{locale.nativeTerritoryName()} ({locale.nativeLanguageName()})"
        example = f"1{regional_table_form(region).decimal}5"
        return self.tr("a spreadsheet in {region}: {example}").format(region=name, example=example)

    def _request_export(self) -> None:
        if self.formats and not self._is_running:
            self.export_requested.emit(self.formats, self.deidentify_tick.isChecked(), self.region_choice.currentData())

    def _request_more_formats(self) -> None:
        self.close_dialog()
        self.more_formats_requested.emit()

    def _show_state(self) -> None:
        runs = self._is_running
        self.more_button.setVisible(not self._shows_research and not runs)
        self.bar.setVisible(runs)
        self.folder_button.setVisible(not runs)
        self.close_button.setEnabled(True)
        self.close_button.set_label(self.tr("Stop") if runs else self.tr("Cancel"))
        for box in (*self.format_ticks.values(), self.deidentify_tick, self.region_choice):
            box.setEnabled(not runs)
