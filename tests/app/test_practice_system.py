"""A practice system sends a patient by GDT, and gets values and PDF back."""

from __future__ import annotations

import base64
import json
import os
from collections.abc import Callable
from dataclasses import replace
from datetime import date
from pathlib import Path

import pytest
from pytestqt.qtbot import QtBot

from carpus.app.desktop import practice_system
from carpus.app.desktop.practice_system import PracticeSystemCard
from carpus.app.desktop.window import Desktop
from carpus.app.settings import PREFERENCES_FILE, PracticeSystemSettings, ScreenSettings, Settings, settings_folder
from carpus.core.formats.gdt import parse_fields
from carpus.core.records.values import Patient
from tests.app.test_library import set_up, store
from tests.formats.test_gdt import MUSTERMANN, encode

Open = Callable[..., Desktop]


@pytest.fixture
def folders(tmp_path: Path) -> PracticeSystemSettings:
    """Both folders of the exchange."""
    chosen = PracticeSystemSettings(str(tmp_path / "in"), str(tmp_path / "out"), fhir=True)
    for folder in (chosen.requests, chosen.results):
        Path(folder).mkdir()
    return chosen


@pytest.fixture
def opened(open_desktop: Open, folders: PracticeSystemSettings, monkeypatch: pytest.MonkeyPatch) -> Open:
    """Return the window with both folders chosen, which looks at them often."""
    monkeypatch.setattr(practice_system, "POLL_MS", 50)
    return lambda: open_desktop(Settings(screen=ScreenSettings("light"), practice_system=folders))


def selected(desktop: Desktop) -> str:
    """Return the id of the patient on the first screen."""
    screen = desktop.controller.patients.screen
    return str(screen.list.patient_model.row(screen.list.currentIndex().row()).patient_id)


def lay(folders: PracticeSystemSettings, content: bytes, name: str = "CARPPRAX.001") -> Path:
    path = Path(folders.requests) / name
    path.write_bytes(content)
    return path


def test_request_selects_the_patient_sent_and_nobody_else(
    qtbot: QtBot, opened: Open, folders: PracticeSystemSettings
) -> None:
    desktop, request = opened(), encode(MUSTERMANN, "iso8859-1")
    patients, screen = desktop.library.patients, desktop.controller.patients.screen
    path = lay(folders, request)
    qtbot.waitUntil(lambda: not path.exists(), timeout=20_000)
    shown = patients.get(selected(desktop))
    assert (shown.name, shown.record_number, shown.sex) == ("Jürg Mustermann", "12345", "male")
    assert shown.birth_day == date(1945, 10, 30)

    patients.add(Patient("Heron 17", "left"))
    desktop.controller.patients.open()
    screen.search.setText("Heron")
    desktop.on_second_instance(lay(folders, request))
    assert selected(desktop) == shown.patient_id, "while another one is searched"

    screen.new_patient()
    path = lay(folders, request, "from the menu.txt")
    desktop.on_second_instance(path)
    assert path.exists(), "it waits while a form is filled in"
    screen.form.close_dialog()
    qtbot.waitUntil(lambda: not path.exists(), timeout=20_000)

    patients.archive(shown.patient_id)
    desktop.on_second_instance(lay(folders, request))
    assert not screen.list.currentIndex().isValid(), "an archived one selects nobody else"
    assert not screen.archive_button.isHidden()


def test_request_that_cannot_be_deleted_is_read_once(
    qtbot: QtBot, opened: Open, folders: PracticeSystemSettings, monkeypatch: pytest.MonkeyPatch
) -> None:
    desktop = opened()
    path = lay(folders, encode(MUSTERMANN, "iso8859-1"))
    delete = Path.unlink

    def refuse(file: Path, missing_ok: bool = False) -> None:
        if file == path:
            raise PermissionError(13, "in use")
        delete(file, missing_ok=missing_ok)

    monkeypatch.setattr(Path, "unlink", refuse)
    messages, faults = desktop.controller.messages, []
    messages.fault_shown.connect(faults.append)
    qtbot.waitUntil(lambda: messages.is_busy, timeout=20_000)
    messages.dialog.close_dialog()
    with qtbot.waitSignal(messages.fault_shown, timeout=1_000, raising=False):
        pass

    assert len(faults) == 1
    assert len(desktop.library.patients.search("12345")) == 1


def test_request_unreadable_is_set_aside_and_said(qtbot: QtBot, opened: Open, folders: PracticeSystemSettings) -> None:
    desktop = opened()
    path = lay(folders, b"not a request")
    os.utime(path, (0, 0))

    qtbot.waitUntil(lambda: desktop.controller.messages.is_busy, timeout=20_000)
    assert not path.exists()
    assert path.with_name(path.name + ".unreadable").read_bytes() == b"not a request"


def test_report_sent_writes_pdf_and_values(
    qtbot: QtBot, opened: Open, folders: PracticeSystemSettings, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Also into a share that knows no rights of files: what was written has been sent."""
    desktop = opened()
    controller, library = desktop.controller, desktop.library
    desktop.on_second_instance(lay(folders, encode(MUSTERMANN, "iso8859-1")))
    patient = library.patients.search("12345")[0]
    stored = store(library, set_up(patient.patient_id, patient.pseudonym))
    controller.current.patient = patient
    controller.report.open(stored)
    screen = controller.report.screen
    qtbot.waitUntil(lambda: screen.report is not None, timeout=30_000)

    def refuse(*_: object) -> None:
        raise PermissionError

    monkeypatch.setattr(Path, "chmod", refuse)
    screen.send_button.click()

    out = Path(folders.results)
    qtbot.waitUntil(lambda: (out / "PRAXCARP.001").exists(), timeout=30_000)
    fields = dict(reversed(parse_fields((out / "PRAXCARP.001").read_bytes())[0]))
    assert (fields["8000"], fields["3000"], fields["8315"]) == ("6310", "12345", "PRAX_AIS")
    assert Path(fields["6305"]).read_bytes().startswith(b"%PDF")
    assert Path(fields["6305"]).parent == out
    qtbot.waitUntil(screen.send_button.isEnabled, timeout=30_000)
    bundle = json.loads(Path(fields["6305"]).with_suffix(".fhir.json").read_text("utf-8"))
    resources = {entry["resource"]["resourceType"]: entry["resource"] for entry in bundle["entry"]}
    assert resources["Patient"]["identifier"][0]["value"] == "12345"
    assert "Mustermann" not in json.dumps(bundle)
    (pdf,) = resources["DiagnosticReport"]["presentedForm"]
    assert base64.b64decode(pdf["data"]) == Path(fields["6305"]).read_bytes()
    assert not controller.messages.is_busy
    assert controller.context.recent_locations.folder("reports") != str(out), "what is saved next is not sent"


def test_fhir_chosen_in_settings_is_saved(opened: Open, folders: PracticeSystemSettings) -> None:
    desktop = opened()
    desktop.controller.navigator.open_screen("settings")
    (card,) = desktop.preferences.screen.findChildren(PracticeSystemCard)
    card.fhir_check.click()
    assert desktop.preferences.settings.practice_system == replace(folders, fhir=False)
    card.fhir_check.click()
    saved = (desktop.preferences._folder or settings_folder()) / PREFERENCES_FILE
    assert "fhir = true" in saved.read_text("utf-8")
