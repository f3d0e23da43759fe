"""The data folder as a whole: practice apart from patients, choices beside sessions, files copied in, export."""

from __future__ import annotations

import csv
import json
import math
import shutil
from collections.abc import Iterator
from dataclasses import replace
from datetime import UTC, datetime, timedelta
from pathlib import Path

import numpy as np
import pytest

from app.desktop.library import CHOICES_SUFFIX, Library
from app.desktop.patients import PatientShelf
from core.calibration.result import Finding
from core.errors import OutputExists, SessionUnreadable
from core.output.exercises import exercise_named
from core.output.report_content import RepetitionChoices
from core.session.values import new_header
from core.session.writer import SessionWriter
from tests.session.samples import CAMERA, make_calibration, make_frame
from ui.ports import PRACTICE_PATIENT, PatientEntry, SetUp


@pytest.fixture
def library(tmp_path: Path) -> Iterator[Library]:
    opened = Library(tmp_path / "data")
    yield opened
    opened.close()


def set_up(patient_id: str, pseudonym: str) -> SetUp:
    return SetUp(patient_id, pseudonym, "right", exercise_named("WRIST_RU"), 8, 25.0, float("nan"), True)


def store(
    library: Library,
    wanted: SetUp,
    frames: int = 40,
    hand_length_mm: float = 180.0,
    findings: tuple[Finding, ...] = (),
    parameters: str = "{}",
    after: timedelta = timedelta(0),
) -> str:
    path = library.new_path(wanted)
    calibration = make_calibration()
    verdict = replace(calibration.verdict, hand_length_mm=hand_length_mm, findings=findings)
    header = new_header(
        hand="right",
        protocol=make_calibration().clicks.protocol,
        software_version="0",
        subject_id=wanted.pseudonym,
        exercise=wanted.exercise.id,
        parameters=parameters,
        now=datetime.now(UTC) + after,
    )
    with SessionWriter.create(path, header, CAMERA, replace(calibration, verdict=verdict)) as writer:
        for row in range(frames):
            writer.append(make_frame(row))
    return library.entered(wanted, path)


def test_practice_is_never_among_the_patients(library: Library) -> None:
    shelf = PatientShelf(library)
    linden = shelf.add(PatientEntry("Linden 42", "right", "right"))
    practice, measured = (
        store(library, set_up(PRACTICE_PATIENT, "Practice patient")),
        store(library, set_up(linden, "Linden 42")),
    )
    assert [row.pseudonym for row in shelf.patients()] == ["Linden 42"]
    assert [row.session_id for row in shelf.sessions(linden)] == [measured]
    assert [row.session_id for row in shelf.sessions(PRACTICE_PATIENT)] == [practice]
    assert len(library.session(practice)) == 40


def test_the_length_of_the_hand_is_that_of_its_last_session_with_right_names(library: Library) -> None:
    linden = PatientShelf(library).add(PatientEntry("Linden 42", "right", "right"))
    wanted = set_up(linden, "Linden 42")
    assert math.isnan(library.last_hand_length_mm(wanted, simulated=False))
    steps = iter(range(1, 9))

    def stored(length_mm: float, *findings: Finding, parameters: str = "{}") -> None:
        store(library, wanted, 3, length_mm, findings, parameters, timedelta(minutes=next(steps)))

    stored(180.0)
    stored(150.0, Finding("shifted", ("WRIST", "MCP5", "MCP4")))
    stored(140.0, parameters=json.dumps({"source": {"simulated": "yes"}}))
    assert library.last_hand_length_mm(wanted, simulated=False) == pytest.approx(180.0)
    assert library.last_hand_length_mm(wanted, simulated=True) == pytest.approx(140.0)
    assert math.isnan(library.last_hand_length_mm(replace(wanted, side="left"), simulated=False))
    stored(210.0, Finding("other_length", (), 210.0, 180.0, "mm"))
    assert library.last_hand_length_mm(wanted, simulated=False) == pytest.approx(210.0), "accepted by a person"


def test_the_last_set_up_comes_back_with_its_targets(library: Library) -> None:
    linden = PatientShelf(library).add(PatientEntry("Linden 42", "right", "right"))
    assert library.last_set_up(linden) is None
    wanted = set_up(linden, "Linden 42")
    store(library, wanted)
    found = library.last_set_up(linden)
    assert found is not None
    assert np.isnan(found.target_negative_deg)
    assert (found.exercise, found.repetitions, found.target_positive_deg, found.keep_pictures) == (
        wanted.exercise, 8, 25.0, True,
    )  # fmt: skip


def test_choices_lie_beside_the_session_and_a_damaged_file_of_them_is_told(library: Library) -> None:
    session_id = store(library, set_up(PRACTICE_PATIENT, "Practice patient"))
    choices = RepetitionChoices({2: "pain", 0: ""}, {1: (3.5, 6.25)}, not_counted=True)
    library.keep_choices(session_id, choices)
    assert library.choices(session_id) == choices
    beside = library.entry(session_id).path.with_suffix(CHOICES_SUFFIX)
    assert json.loads(beside.read_text())["edges_s"] == {"1": [3.5, 6.25]}
    assert beside.stat().st_mode & 0o077 == 0
    beside.write_text("{")
    with pytest.raises(SessionUnreadable):
        library.choices(session_id)


def test_a_session_copied_into_the_folder_is_taken_in_at_the_next_start(library: Library, tmp_path: Path) -> None:
    linden = PatientShelf(library).add(PatientEntry("Linden 42", "right", "right"))
    path = library.entry(store(library, set_up(linden, "Linden 42"))).path
    other = Library(tmp_path / "other")
    assert other.recover() == ([], [])
    shutil.copy(path, other.clinic.sessions_folder / path.name)
    other.close()
    again = Library(tmp_path / "other")
    again.recover()
    (record,) = again.clinic.patients()
    assert (record.entry.pseudonym, record.session_count) == ("Linden 42", 1)
    again.close()


def test_the_exported_table_holds_the_angles_and_is_never_overwritten(library: Library, tmp_path: Path) -> None:
    session_id = store(library, set_up(PRACTICE_PATIENT, "Practice patient"))
    (name,) = library.export(session_id, str(tmp_path))
    session = library.session(session_id)
    with (tmp_path / name).open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == len(session)
    for row, angles, time_s in zip(rows, session.motion.angles_rad, session.timestamp_s, strict=True):
        assert float(row["timestamp_s"]) == pytest.approx(time_s, abs=1e-6)
        for column, angle in zip(("deviation_deg", "flexion_deg", "pronosupination_deg"), angles, strict=True):
            known = float(row[column]) if row[column] else np.nan
            np.testing.assert_allclose(known, np.degrees(angle), atol=6e-4)
    with pytest.raises(OutputExists):
        library.export(session_id, str(tmp_path))
