"""The data folder as a whole: practice apart from patients, choices beside sessions, files copied in, export."""

from __future__ import annotations

import csv
import json
import math
from collections.abc import Iterator
from dataclasses import replace
from datetime import UTC, datetime, timedelta
from pathlib import Path

import cv2
import numpy as np
import pytest

from carpus.core.calibration.result import CalibrationFinding
from carpus.core.model.errors import SessionUnreadable
from carpus.core.model.hand.exercises import get_exercise
from carpus.core.records import session_records
from carpus.core.records.data_folder import DataFolder
from carpus.core.records.new_sessions import SessionIntake, recover_sessions
from carpus.core.records.retention import RecordRetention
from carpus.core.records.session_setup import MARKERS_SUFFIX, PRACTICE_PATIENT, SessionSetup
from carpus.core.records.values import Patient
from carpus.core.results.repetition_rows import RepetitionChoices
from carpus.core.results.session_results import compute_session_results
from carpus.core.session.reader import read_session
from carpus.core.session.values import new_header
from carpus.core.session.writer import SessionWriter
from carpus.ui.screens.patients.patient_store import PatientStore, _compare_results
from carpus.ui.screens.sessions.session_list import SessionStore, remark
from tests.session.samples import CAMERA, make_calibration, make_frame
from tests.ui.hand_fakes import FakeHandSessions


@pytest.fixture
def library(tmp_path: Path) -> Iterator[DataFolder]:
    opened = DataFolder(tmp_path / "data")
    yield opened
    opened.close()


def set_up(patient_id: str, pseudonym: str) -> SessionSetup:
    return SessionSetup(patient_id, pseudonym, "right", get_exercise("WRIST_RU"), 8, 25.0, float("nan"), True)


def store(
    library: DataFolder,
    wanted: SessionSetup,
    frames: int = 40,
    hand_length_mm: float = 180.0,
    findings: tuple[CalibrationFinding, ...] = (),
    parameters: str = "{}",
    after: timedelta = timedelta(0),
) -> str:
    path = SessionIntake(library).new_path(wanted)
    calibration = make_calibration()
    verdict = replace(calibration.verdict, hand_length_mm=hand_length_mm, findings=findings)
    header = new_header(
        hand="right",
        protocol=make_calibration().clicks.protocol,
        subject_id=wanted.pseudonym,
        exercise=wanted.exercise.id,
        parameters=parameters,
        now=datetime.now(UTC) + after,
    )
    with SessionWriter.create(path, header, CAMERA, replace(calibration, verdict=verdict)) as writer:
        for row in range(frames):
            writer.append(make_frame(row))
    return SessionIntake(library).register(wanted, path)


def test_hand_length_is_of_the_last_session_with_right_labels(library: DataFolder) -> None:
    linden = library.patients.add(Patient("Linden 42", "right", "right"))
    wanted = set_up(linden, "Linden 42")
    places = SessionIntake(library)
    assert math.isnan(places.last_hand_length_mm(wanted, simulated=False))
    steps = iter(range(1, 9))

    def stored(length_mm: float, *findings: CalibrationFinding, parameters: str = "{}") -> None:
        store(library, wanted, 3, length_mm, findings, parameters, timedelta(minutes=next(steps)))

    stored(180.0)
    stored(150.0, CalibrationFinding("shifted", ("WRIST", "MCP5", "MCP4")))
    stored(140.0, parameters=json.dumps({"source": {"simulated": "yes"}}))
    assert places.last_hand_length_mm(wanted, simulated=False) == pytest.approx(180.0)
    assert places.last_hand_length_mm(wanted, simulated=True) == pytest.approx(140.0)
    assert math.isnan(places.last_hand_length_mm(replace(wanted, side="left"), simulated=False))
    stored(210.0, CalibrationFinding("other_length", (), 210.0, 180.0, "mm"))
    assert places.last_hand_length_mm(wanted, simulated=False) == pytest.approx(210.0), "accepted by a person"


def test_simulated_session_is_excluded_and_hides_no_result(library: DataFolder) -> None:
    patients = PatientStore(library)
    linden = library.patients.add(Patient("Linden 42", "right", "right"))
    wanted, simulated = set_up(linden, "Linden 42"), json.dumps({"source": {"simulated": "yes"}})
    store(library, wanted, parameters=simulated)
    (row,) = patients.list_patients()
    assert (row.session_count, row.last_session) == (0, None)
    assert patients.card(linden).results == ()
    real = store(library, wanted)
    store(library, wanted, parameters=simulated, after=timedelta(days=1))
    (row,) = patients.list_patients()
    assert (row.session_count, row.last_session) == (1, library.entry(real).created)
    card = patients.card(linden)
    assert card.note_date == library.entry(real).created
    assert not any("imulated" in said for said in card.warnings)
    assert sorted(entry.simulated for entry in library.sessions(linden)) == [False, True, True]


def test_session_is_moved_renamed_excluded_and_deleted_with_its_files(library: DataFolder) -> None:
    stored = SessionStore(library)
    linden = library.patients.add(Patient("Linden 42", "right", "right"))
    heron = library.patients.add(Patient("Heron 17", "right", "right"))
    one = store(library, set_up(linden, "Linden 42"))
    two = store(library, set_up(linden, "Linden 42"), after=timedelta(hours=1))
    path = library.entry(one).path
    stored.exclude(one, "markers lost")
    assert {line.entry.session_id: line.exclusion_reason for line in stored.list_sessions(linden)} == {
        one: "markers lost",
        two: "",
    }
    assert library.results(library.entry(one)).is_excluded
    stored.exclude(one, "")
    assert not library.results(library.entry(one)).is_excluded
    stored.rename_exercise(one, "FOREARM_PS")
    assert library.results(library.entry(one)).exercise.id == "FOREARM_PS"
    assert library.session(one).header.exercise == "FOREARM_PS"
    assert read_session(path).header.exercise == "WRIST_RU", "the file is not changed"
    stored.move(one, heron)
    path = library.entry(one).path
    assert read_session(path).header.subject_id == "Heron 17"
    assert [line.entry.session_id for line in stored.list_sessions(linden)] == [two]
    assert [line.entry.session_id for line in stored.list_sessions(heron)] == [one]
    recover_sessions(library)
    assert [line.entry.session_id for line in stored.list_sessions(heron)] == [one], "the files do not undo it"
    records, cards = RecordRetention(library), PatientStore(library)
    records.archive_session(one)
    assert stored.list_sessions(heron) == []
    assert cards.card(heron).has_sessions, "its list of sessions is the way to the archive"
    records.unarchive(one)
    path.with_suffix(".markers.jpg").write_bytes(b"x")
    plan = records.plan_session(one)
    assert {file.name for file in plan.files} == {
        path.name, path.with_suffix(".markers.jpg").name,
    }  # fmt: skip
    records.erase(plan)
    assert stored.list_sessions(heron) == []
    assert list(path.parent.glob(f"{path.stem}.*")) == []
    assert len(library.session(two)) == 40
    library.entry(two).path.unlink()
    library.drop_cached_results(two)
    (line,) = [stored.with_figures(line) for line in stored.list_sessions(linden)]
    assert remark(line) == "file missing"
    with pytest.raises(SessionUnreadable):
        records.plan_session(one)


def test_angle_order_changes_display_but_not_files(library: DataFolder, tmp_path: Path) -> None:
    patient_id = library.patients.add(Patient("Linden 42", "right", "right"))
    session_id = store(library, set_up(patient_id, "Linden 42"))
    plain = library.session(session_id)
    assert [figures.angle_order for figures in library.history(patient_id)] == ["zyx"]
    library.get_angle_order = lambda: "isb"
    turned = library.session(session_id)
    assert turned.angle_order == "isb"
    assert not np.allclose(turned.motion.angles_rad, plain.motion.angles_rad, equal_nan=True)
    assert [figures.angle_order for figures in library.history(patient_id)] == ["isb"]
    library.export(session_id, str(tmp_path))
    with next(tmp_path.rglob("*.wrist.for-programs.csv")).open(encoding="utf-8") as file:
        first = next(row for row in csv.DictReader(file) if row["filter_flexion_deg"])
    row = int(np.flatnonzero(np.isfinite(plain.motion.angles_rad[:, 1]))[0])
    assert float(first["filter_flexion_deg"]) == pytest.approx(math.degrees(plain.motion.angles_rad[row, 1]), abs=1e-3)


def test_choices_and_comments_are_kept_in_the_store(library: DataFolder) -> None:
    session_id = store(library, set_up(PRACTICE_PATIENT, "Practice patient"))
    choices = RepetitionChoices({2: "pain", 0: ""}, {1: (3.5, 6.25)}, is_session_excluded=True)
    library.save_choices(session_id, choices)
    for text in ("First.", "Second,\nwith a line.", "Second,\nwith a line.\n", ""):
        library.save_comment(session_id, text)
    assert session_records.read_comments(library.store, session_id) == [
        "First.",
        "Second,\nwith a line.",
        "",
    ]
    assert library.comment(session_id) == ""
    assert library.choices(session_id) == choices
    assert not list(library.folder.rglob("*.json")), "nothing that is typed lies beside a session"


def test_patient_card_has_finger_totals_changes_and_lower_bounds() -> None:
    sessions = FakeHandSessions(pictures=False)
    first, last = (compute_session_results(sessions.session(key)) for key in ("hand-3", "hand-7"))
    lines = _compare_results(first, last)
    assert [line.subject for line, _ in lines] == [f"TAM{k}" for k in (2, 3, 4, 5)]
    assert all(line is last.find(line.subject, "arc") for line, _ in lines)
    assert any(line.is_lower_bound for line, _ in lines)
    assert any(change.verdict == "improved" for _, change in lines)


def test_last_marker_positions_are_of_the_same_hand_and_protocol(library: DataFolder) -> None:
    linden = library.patients.add(Patient("Linden 42", "right", "right"))
    wanted = set_up(linden, "Linden 42")
    path = library.entry(store(library, wanted)).path
    cv2.imwrite(str(path.with_suffix(MARKERS_SUFFIX)), np.full((40, 60, 3), 90, np.uint8))
    assert library.read_marker_photo(linden, wanted) is not None
    assert library.read_marker_photo(linden) is not None
    assert library.read_marker_photo(linden, replace(wanted, side="left")) is None
    whole_hand = replace(wanted, exercise=get_exercise("FIST_COMPOSITE"))
    assert library.read_marker_photo(linden, whole_hand) is None
    assert library.matching_sessions(linden, replace(wanted, exercise=get_exercise("WRIST_FE")))
