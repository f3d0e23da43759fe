"""Exchange with a practice system: its patients are opened, and reports go back, as GDT files in two folders."""

from __future__ import annotations

import time
from collections.abc import Callable, Collection
from contextlib import suppress
from dataclasses import replace
from datetime import datetime
from pathlib import Path
from tempfile import TemporaryFile
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, QTimer

from carpus.app.desktop.main_controller import MainController
from carpus.app.desktop.preferences import PreferencesController
from carpus.app.settings import PracticeSystemSettings
from carpus.core.formats import gdt
from carpus.core.formats.gdt import GdtRequest
from carpus.core.model.errors import CarpusFault, GdtUnreadable, NameUnsuited
from carpus.core.platform.durable import write_fault
from carpus.core.records.patients import Patients
from carpus.core.records.values import Patient
from carpus.core.results.measure import Measure
from carpus.ui.kit.background import Background
from carpus.ui.kit.dialog import has_open_dialog
from carpus.ui.kit.translate import to_mid_sentence, tr
from carpus.ui.words import terms
from carpus.ui.words.progress import range_name
from carpus.ui.words.ranges import neutral_zero_words

if TYPE_CHECKING:  # a report loads pyqtgraph, for which the window does not wait
    from carpus.ui.report.session_page import SessionReport
from PySide6.QtCore import Signal
from PySide6.QtWidgets import QCheckBox, QFileDialog

from carpus.ui.kit.button import Button
from carpus.ui.kit.card import Card
from carpus.ui.kit.layouts import STRETCH, fill, row_layout
from carpus.ui.kit.text import SEMIBOLD, Text
from carpus.ui.kit.theme import Theme

UNREADABLE_SUFFIX = ".unreadable"


def save_requested_patient(patients: Patients, request: GdtRequest) -> Patient:
    """Return the patient of a request, with the identity that the practice system knows.

    A patient is recognised by the record number. A new one gets a random pseudonym; of a known one name, birth date and
    sex follow the request where it states them. Raises what :meth:`Patients.save` does.
    """
    name = " ".join(filter(None, (request.first_name, request.last_name)))
    known = patients.id_of_record_number(request.number)
    patient = patients.get(known) if known else Patient(patients.suggest_pseudonym(), "both")
    stated = replace(
        patient,
        record_number=request.number,
        name=name or patient.name,
        birth_day=request.birth_date or patient.birth_day,
        sex=request.sex or patient.sex,
    )
    return patients.get(patients.save(stated)) if stated != patient else patient


POLL_MS = 2000
"""A folder in the network gives no notice of new files, so it is looked at."""
SETTLED_S = 10.0
"""An unreadable file younger than this may still be written."""


class PracticeSystemController(QObject):
    """Opens the patients of GDT requests, and sends reports back with the values."""

    def __init__(self, controller: MainController, preferences: PreferencesController, *, is_demo: bool) -> None:
        super().__init__(controller)
        self._controller, self._preferences = controller, preferences
        self._requests: dict[str, gdt.GdtRequest] = {}
        """The last request of each record number: its addresses stand in the result."""
        self._left_files: set[tuple[Path, int]] = set()
        """Files that could be neither deleted nor renamed, with the time of their change; not to be read again."""
        self._waiting_file: Path | None = None
        """File that was named while no patient could be opened."""
        self._background = Background()
        self.can_open: Callable[[], bool] = lambda: True
        """Returns whether a patient may be opened now; set where the lock is known."""
        self._timer = QTimer(self)
        self._timer.timeout.connect(self._check_folder)
        if not is_demo:
            self._timer.start(POLL_MS)
        controller.navigator.run_when_created("settings", self._connect_settings)
        controller.navigator.run_when_created("report", self._connect_report)

    @property
    def _folders(self) -> PracticeSystemSettings:
        return self._preferences.settings.practice_system

    def stop(self) -> None:
        """End the watch, and wait for what is being read."""
        self._timer.stop()
        self._background.join()

    # --- requests ---------------------------------------------------------------------------------------------
    def _check_folder(self) -> None:
        """Read the folder in the background unless a patient cannot be opened now."""
        if not self._is_free():
            return
        if self._waiting_file is not None:
            waiting, self._waiting_file = self._waiting_file, None
            self.open_file(waiting)
        elif (folder := self._folders.requests) and not self._background.is_busy:
            left = frozenset(self._left_files)
            self._background.run(lambda: _read_oldest(Path(folder), left), self._open_found, lambda _: None, self)

    def _is_free(self) -> bool:
        controller = self._controller
        return (
            self.can_open()
            and not controller.messages.is_busy
            and not has_open_dialog(controller.patients.screen.window())  # of a form that is filled in
            and not controller.navigator.is_recording()
            and controller.current.source is None
        )

    def _open_found(self, found: tuple[Path, gdt.GdtRequest | GdtUnreadable] | None) -> None:
        if found is None or not self._is_free():
            return
        path, request = found
        try:
            if isinstance(request, GdtUnreadable):
                raise request
            self._open_patient(path, request)
        except CarpusFault as fault:
            self._controller.messages.show_fault(fault)
            if isinstance(fault, GdtUnreadable | NameUnsuited):
                self._remove_file(path, lambda file: file.replace(file.with_name(file.name + UNREADABLE_SUFFIX)))

    def open_file(self, path: Path) -> None:
        """Open the patient of a GDT file that a practice system names when it starts Carpus."""
        if not self._is_free():
            self._waiting_file = path
            return
        try:
            self._open_patient(path, gdt.read_request(path))
        except CarpusFault as fault:
            self._controller.messages.show_fault(fault)

    def _open_patient(self, path: Path, request: gdt.GdtRequest) -> None:
        """Show the patient; the request is deleted once the patient is stored, as the specification asks."""
        controller = self._controller
        patient = save_requested_patient(controller.context.library.patients, request)
        self._requests[request.number] = request
        self._remove_file(path, Path.unlink)
        controller.patients.open(patient.patient_id)
        controller.patients.screen.show_patient(patient)

    def _remove_file(self, path: Path, remove: Callable[[Path], object]) -> None:
        """Delete or rename a file that was read; one that stays is not read again."""
        try:
            remove(path)
        except FileNotFoundError:
            pass  # the practice system was quicker
        except OSError as cause:
            with suppress(OSError):
                self._left_files.add((path, path.stat().st_mtime_ns))
            self._controller.messages.show_fault(write_fault(path, cause))

    # --- results ----------------------------------------------------------------------------------------------
    def _connect_report(self) -> None:
        screen = self._controller.report.screen
        screen.can_send = lambda: bool(self._folders.results) and bool(self._record_number())
        screen.send_requested.connect(self._send)

    def _record_number(self) -> str:
        patient = self._controller.current.patient
        return patient.record_number if patient is not None else ""

    def _send(self, report: SessionReport) -> None:
        """Write the report and its values into the folder of results."""
        from carpus.core.formats import fhir
        from carpus.core.formats.export_item import ExportItem
        from carpus.core.formats.output_files import write_new_json
        from carpus.ui.report.page import report_pdf, save_pdf
        from carpus.ui.screens.report.screen import default_file_name

        screen, patient = self._controller.report.screen, self._controller.current.patient
        assert patient is not None
        folder, number = Path(self._folders.results), patient.record_number
        request = self._requests.get(number, gdt.GdtRequest(number, birth_date=patient.birth_day))
        request = replace(request, sex=patient.sex if patient.sex in ("male", "female") else "")
        content, name = report_pdf(screen.preview.pages), default_file_name(report)
        tests = gdt.build_tests(report.results.measures, _name_test)
        # exercise and hand, and the ranges of the wrist by the neutral-zero method
        results = report.results
        ranges = [words for angle in range(3) if (words := neutral_zero_words(results, angle))]
        heading = f"{terms.exercise_name(results.exercise.id)}, {to_mid_sentence(terms.hand_name(results.side))}"
        findings = [heading, *ranges]

        library, writes_fhir = self._controller.context.library, self._folders.fhir

        def work() -> str:
            target = folder / name
            if target.exists():  # sent before, and this report may say something else
                target = target.with_stem(f"{target.stem}_{datetime.now():%H%M%S}")
            if writes_fhir:
                item = ExportItem(library.session(results.session_id), results, target.stem, {})
                bundle = fhir.build_bundle(item, content, number)
                _share_file(write_new_json(target.with_suffix(".fhir.json"), bundle))
            _share_file(save_pdf(target, content))
            # last: the practice system takes it as soon as it is there, and sent twice it would be taken twice
            record = gdt.format_result(request, report.results.when, tests, findings=findings, report=target)
            _share_file(gdt.write_result(folder, request, record))
            return str(target)

        def show_failure(fault: Exception) -> None:
            screen.show_sent(report, "")
            self._controller.messages.show_fault(fault)

        self._background.run(work, lambda path: screen.show_sent(report, path), show_failure, screen)

    # --- settings ---------------------------------------------------------------------------------------------
    def _connect_settings(self) -> None:
        chosen = self._folders
        context = self._controller.context
        card = PracticeSystemCard(context.theme, chosen.requests, chosen.results, chosen.fhir, is_demo=context.is_demo)
        card.changed.connect(lambda *now: self._preferences.save(practice_system=PracticeSystemSettings(*now)))
        card.test_requested.connect(lambda: self._test(card))
        self._preferences.screen.add_cards("report", card)

    def _test(self, card: PracticeSystemCard) -> None:
        """Show whether the folders can be used, and who waits in the first."""
        chosen = self._folders

        def work() -> str:
            found = []
            if chosen.requests:
                waiting = gdt.find_requests(Path(chosen.requests))
                found.append(tr("Waiting patients: {count}.").format(count=len(waiting)))
            if chosen.results:
                with TemporaryFile(dir=chosen.results):
                    found.append(tr("Results can be written."))
            return " ".join(found)

        def show_failure(fault: Exception) -> None:
            card.show_test(
                tr("A folder cannot be used: {reason}").format(reason=getattr(fault, "strerror", "") or fault)
            )

        self._background.run(work, card.show_test, show_failure, card)


def _read_oldest(
    folder: Path, left: Collection[tuple[Path, int]]
) -> tuple[Path, gdt.GdtRequest | GdtUnreadable] | None:
    """Return the oldest request of a folder, or why it cannot be read; None if there is none or it is being written."""
    for path in gdt.find_requests(folder):
        if left and (path, path.stat().st_mtime_ns) in left:
            continue
        try:
            return path, gdt.read_request(path)
        except GdtUnreadable as fault:
            if time.time() - path.stat().st_mtime > SETTLED_S:
                return path, fault
    return None


def _share_file(path: Path) -> None:
    """Let the practice system read a file, which may run under another account of the group.

    A share may know no such rights, and the practice system may have taken the file already: it is written in any case.
    """
    with suppress(OSError):
        path.chmod(0o660)


def _name_test(row: Measure) -> str:
    """Return the name of a range, of a joint with the end that it is."""
    end = "" if row.wrist_angle >= 0 else {"flexion": " max.", "extension": " min."}.get(row.quantity, "")
    return f"{range_name(row, names_arc=True)}{end}"


class PracticeSystemCard(Card):
    """Folders for GDT files of patients and of results.

    Signals: ``changed`` with both folders and whether results are written as FHIR too; ``test_requested``.
    """

    changed = Signal(str, str, bool)
    test_requested = Signal()

    def __init__(self, theme: Theme, requests: str, results: str, fhir: bool, *, is_demo: bool = False) -> None:
        super().__init__(theme, 24)
        words = self.tr(
            "The clinic software writes a patient as a GDT 2.1 file into the first folder, and Carpus opens the "
            "patient. “Send to clinic software” next to a report writes its values and the PDF into the second "
            "folder. These files contain real names."
        )
        self._folders = [requests, results]
        self._texts = [Text(theme, "", 14, wrap=True) for _ in self._folders]
        self.folder_buttons = [Button(theme, self.tr("Change…"), height_px=40) for _ in self._folders]
        self.clear_buttons = [Button(theme, self.tr("Turn off"), "quiet", height_px=40) for _ in self._folders]
        self.test_button = Button(theme, self.tr("Test the folders"), height_px=40)
        self.test_text = Text(theme, "", 14, SEMIBOLD, wrap=True)
        self.add_heading(self.tr("Clinic software (GDT)"), words)
        if is_demo:
            note = self.tr("The demo does not read patients from the clinic software.")
            self.body.addWidget(Text(theme, note, 14, SEMIBOLD, "warn", wrap=True))
        titles = (self.tr("Patients from the clinic software"), self.tr("Results for the clinic software"))
        for number, title in enumerate(titles):
            row = row_layout(self.folder_buttons[number], self.clear_buttons[number], STRETCH, gap=8)
            fill(self.body, 8, Text(theme, title, 14, SEMIBOLD, wrap=True), self._texts[number], row)
            self.folder_buttons[number].setAccessibleName(f"{title}: {self.tr('Change…')}")
            self.clear_buttons[number].setAccessibleName(f"{title}: {self.tr('Turn off')}")
            self.folder_buttons[number].clicked.connect(lambda _=False, number=number: self._choose(number))
            self.clear_buttons[number].clicked.connect(lambda _=False, number=number: self._set(number, ""))
        self.fhir_check = QCheckBox(self.tr("Write results as FHIR R4 (JSON) too"))
        self.fhir_check.setChecked(fhir)
        self.fhir_check.toggled.connect(self._emit_changed)
        fill(self.body, self.fhir_check, 8, row_layout(self.test_button, (self.test_text, 1), gap=16))
        self.test_button.clicked.connect(self.test_requested)
        self._show()

    def show_test(self, words: str) -> None:
        """Show what a test of the folders found."""
        self.test_text.setText(words)

    def _choose(self, number: int) -> None:
        path = QFileDialog.getExistingDirectory(self, self.tr("Choose a folder"), self._folders[number])
        if path:
            self._set(number, path)

    def _set(self, number: int, folder: str) -> None:
        self._folders[number] = folder
        self._show()
        self._emit_changed()

    def _emit_changed(self) -> None:
        self.changed.emit(*self._folders, self.fhir_check.isChecked())

    def _show(self) -> None:
        for folder, text, clear in zip(self._folders, self._texts, self.clear_buttons, strict=True):
            text.setText(folder or self.tr("No folder chosen"))
            clear.setVisible(bool(folder))
        self.fhir_check.setEnabled(bool(self._folders[1]))
        self.test_button.setEnabled(any(self._folders))
        self.test_text.setText("")
