"""The first step of the set-up, and sets of exercises: kept, damaged, run part by part with rest, each stored apart."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import pytest
from PySide6.QtCore import Qt
from pytestqt.qtbot import QtBot
from sqlalchemy import select, update

from carpus.core.model.errors import ConcurrentChange
from carpus.core.model.hand.exercises import get_exercise
from carpus.core.records import patients
from carpus.core.records.changes import delete_row
from carpus.core.records.clinic_records import read_sets, save_sets
from carpus.core.records.data_folder import DataFolder
from carpus.core.records.patients import read_last_setup, save_setup
from carpus.core.records.schema import EXERCISE_SET, GOAL, PATIENT
from carpus.core.records.session_setup import DEFAULT_SETS, ExerciseSet, SetPart, next_part, start_set
from carpus.core.records.store import Store
from carpus.core.records.values import Patient
from carpus.ui.kit.background import Background
from carpus.ui.kit.theme import Theme
from carpus.ui.picture.movement_guide import ExerciseSnapshot, GuideScene
from carpus.ui.screens.live.flow import STOP_DELAY_S, CourseRunner
from carpus.ui.screens.live.screen import LiveScreen
from carpus.ui.screens.patient.view_controller import PatientViewController
from carpus.ui.screens.setup.exercise import ExerciseScreen
from tests.ui.conftest import Show
from tests.ui.contexts import RecordingMessages, make_context
from tests.ui.fakes import FakeFeed, FakeMeasuring, set_up

PARTS = (SetPart(get_exercise("WRIST_FE"), 2, 0, 20), SetPart(get_exercise("FREE"), 0, 8, 0))
OWN = ExerciseSet("own", "Short", "wrist6", PARTS)


@pytest.fixture
def library(tmp_path: Path) -> Iterator[DataFolder]:
    made = DataFolder(tmp_path)
    yield made
    made.close()


def test_sets_are_read_as_they_were_kept_and_a_second_person_s_change_is_told(tmp_path: Path) -> None:
    with Store(tmp_path) as store:
        assert read_sets(store) == DEFAULT_SETS
        save_sets(store, (*DEFAULT_SETS, OWN), DEFAULT_SETS)
        assert read_sets(store) == (*DEFAULT_SETS, OWN)
        longer = replace(OWN, name="Longer")
        save_sets(store, (*DEFAULT_SETS, longer), (*DEFAULT_SETS, OWN))
        with pytest.raises(ConcurrentChange):
            save_sets(store, (*DEFAULT_SETS, replace(OWN, name="Mine")), (*DEFAULT_SETS, OWN))
        other = replace(OWN, set_id="other")
        save_sets(store, (*DEFAULT_SETS, longer, other), (*DEFAULT_SETS, longer))
        save_sets(store, (longer,), (*DEFAULT_SETS, longer))
        assert set(read_sets(store)) == {longer, other}, "what somebody else added stays"
        store.execute_local(update(EXERCISE_SET).where(EXERCISE_SET.c.id == "other").values(discs="wrist7"))
        assert read_sets(store) == (longer,)


def test_goals_are_kept_for_each_exercise_and_hand_and_go_into_sets(library: DataFolder) -> None:
    patient = library.patients.add(Patient("Heron 3", "left"))
    one = replace(set_up(target_deg=50.0), patient_id=patient, pseudonym="Heron 3")
    save_setup(library.store, one)
    save_setup(library.store, replace(one, exercise=get_exercise("FREE"), side="left"))
    save_setup(library.store, replace(one, exercise=get_exercise("WRIST_RU"), target_negative_deg=-20.0))
    goals = patients.read_goals(library.store, patient)
    assert {key: value[0] for key, value in goals.items()} == {("WRIST_FE", "right"): 50.0, ("WRIST_RU", "right"): 50.0}
    assert goals["WRIST_RU", "right"][1] == -20.0
    assert start_set(OWN, one, goals).target_positive_deg == 50.0
    assert math.isnan(start_set(OWN, replace(one, side="left"), goals).target_positive_deg)
    library.store.apply([delete_row(PATIENT, patient)])
    assert patients.read_goals(library.store, patient) == {}


def test_goal_of_supination_is_read_from_thumb_up_and_one_of_older_version_is_converted(library: DataFolder) -> None:
    patient = library.patients.add(Patient("Heron 3", "left"))
    one = replace(set_up("FOREARM_PS", -30.0), patient_id=patient, pseudonym="Heron 3")
    save_setup(library.store, one)
    (stored,) = library.store.rows(select(GOAL))
    assert stored.positive_deg == 60.0, "as 0.2.0 stored it: 60 degrees up from palm down"
    assert patients.read_goals(library.store, patient)["FOREARM_PS", "right"][0] == -30.0
    again = read_last_setup(library.store, patient)
    assert again is not None
    assert again.target_positive_deg == -30.0


def test_set_runs_part_after_part_with_its_rest(qtbot: QtBot, theme: Theme) -> None:
    live = LiveScreen(theme, Background())
    qtbot.addWidget(live)
    patient = PatientViewController(
        make_context(theme, live, RecordingMessages(), Background(), patient_sound=False), live.set_patient_view
    )
    live.snapshot_taken.connect(patient.update)
    measuring = FakeMeasuring(FakeFeed(seconds=2.0))
    now = SimpleNamespace(set_up=start_set(OWN, set_up(), {}), source=SimpleNamespace(measuring=measuring))
    opened: list[bool] = []
    run = CourseRunner(live, live, patient, now, lambda: opened.append(True))  # type: ignore[arg-type]
    stops: list[float] = []
    live.recording.stop = lambda: stops.append(1.0)  # type: ignore[method-assign]
    run.start_part(now.set_up)
    assert "1 of 2" in live.course_label.text()

    def found(count: int, at_s: float) -> list[float]:
        live.snapshot_taken.emit(ExerciseSnapshot(at_s, 10.0, True, found_count=count, state="recording", asked=2))
        return stops

    assert not found(2, 0.0)
    for count, at_s in ((1, 1.0), (2, 1.1), (2, STOP_DELAY_S + 0.1)):
        assert not found(count, at_s), "what looked like a repetition was none"
    assert found(2, STOP_DELAY_S + 1.2)
    assert run.advance()
    assert opened
    assert measuring.chosen.exercise.id == "FREE"
    patient.toggle()
    qtbot.addWidget(patient.window)
    run._on_second()
    assert patient.window.view.scene.phase == "rest"
    assert "Rest 00:19" in live.course_label.text()
    live.snapshot_taken.emit(ExerciseSnapshot(9.0, math.nan, True, True, (0.0, 5.0, 0.0)))
    assert patient.window.view.scene.phase == "rest", "the hand is not looked at in its rest"
    live.snapshot_taken.emit(ExerciseSnapshot(9.1, math.nan, True, True, (0.0, 5.0, 0.0), state="recording"))
    assert not run.is_resting
    assert "Rest" not in live.course_label.text()
    assert not run.advance(), "nothing comes after the last part"
    now.set_up = None
    patient.start_exercise(set_up())
    messages = ExerciseSnapshot(9.2, 10.0, True, True, (0.0, 5.0, 0.0), state="recording")
    live.snapshot_taken.emit(messages)
    assert patient.window.view.scene.phase != GuideScene().phase
    patient.hide_content()
    live.snapshot_taken.emit(messages)
    assert patient.window.view.scene.phase == GuideScene().phase, "the program is locked"
    patient.show_content()
    live.snapshot_taken.emit(messages)
    assert patient.window.view.scene.phase != GuideScene().phase
    patient.close()


def test_next_session_begins_with_set_of_last_one(library: DataFolder) -> None:
    patient = library.patients.add(Patient("Heron 3", "left"))
    save_sets(library.store, (OWN,), DEFAULT_SETS)
    first = start_set(OWN, replace(set_up(), patient_id=patient, pseudonym="Heron 3", side="left", for_child=True), {})
    second = next_part(first)
    assert second is not None
    assert next_part(second) is None
    save_setup(library.store, second)
    again = read_last_setup(library.store, patient)
    assert (again.exercise.id, again.repetitions, again.for_child) == ("WRIST_FE", 2, True)
    assert again.set_run.run_id != first.set_run.run_id
    save_sets(library.store, DEFAULT_SETS, (OWN,))
    assert read_last_setup(library.store, patient).set_run is None  # type: ignore[union-attr]


LINDEN = Patient("Linden 42", "right", patient_id="linden")


@pytest.fixture
def screen(show: Show[ExerciseScreen]) -> ExerciseScreen:
    screen = ExerciseScreen(Theme())
    screen.show_patient(LINDEN, None, "right", False)
    return show(screen)


def test_target_invalid_is_marked_and_prevents_continuing(qtbot: QtBot, screen: ExerciseScreen) -> None:
    sent: list[object] = []
    screen.set_up_chosen.connect(sent.append)
    for typed in ("-200", "200", "0", "abc", "4o", "1e3", "nan"):
        screen.target_fields[1].clear()
        qtbot.keyClicks(screen.target_fields[1], typed)
        assert screen.target_fields[1].text() == typed
        assert screen.problem_label.isVisible()
        assert "90°" in screen.problem_label.text()
        assert not screen.primary_button.isEnabled()
        qtbot.keyClick(screen.exercises.current(), Qt.Key.Key_Return)
        assert not sent
    screen.target_fields[1].clear()
    qtbot.keyClicks(screen.target_fields[1], "35")
    assert not screen.problem_label.isVisible()
    qtbot.keyClick(screen.exercises.current(), Qt.Key.Key_Return)
    assert sent


def test_targets_are_recalled_for_the_same_patient_only(screen: ExerciseScreen) -> None:
    last = replace(set_up(), target_positive_deg=37.5, target_negative_deg=-20.0)
    screen.show_patient(LINDEN, last, "right", False)
    assert [field.value() for field in screen.target_fields] == [37.5, -20.0]
    screen.show_patient(Patient("Fir 12", "left", patient_id="fir"), None, "left", False)
    assert all(math.isnan(field.value()) for field in screen.target_fields)


def test_target_is_taken_as_it_is_written(qtbot: QtBot, screen: ExerciseScreen) -> None:
    for typed, degrees in (("37,5", 37.5), ("37.5", 37.5), ("40", 40.0), ("40°", 40.0), (" ", math.nan)):
        screen.target_fields[0].clear()
        qtbot.keyClicks(screen.target_fields[0], typed)
        assert screen.primary_button.isEnabled()
        assert screen.set_up().target_positive_deg == pytest.approx(degrees, nan_ok=True)
