"""Sets of exercises: kept, damaged, run part after part with rest, and each part stored as its own exercise."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import pytest
from pytestqt.qtbot import QtBot
from sqlalchemy import select, update

from carpus.core.errors import ChangedMeanwhile
from carpus.core.hand.exercises import exercise_named
from carpus.core.records import patients
from carpus.core.records.changes import dropped
from carpus.core.records.kept_sets import keep_set_up, keep_sets, last_set_up, read_sets
from carpus.core.records.library import Library
from carpus.core.records.schema import EXERCISE_SET, GOAL, PATIENT
from carpus.core.records.set_up import USUAL_SETS, CoursePart, ExerciseSet, begun, next_part
from carpus.core.records.store import Store
from carpus.core.records.values import Patient
from carpus.core.results.figures import session_figures
from carpus.core.results.progress import progress
from carpus.ui.background import Background
from carpus.ui.live.course import LINGER_S, CourseRun
from carpus.ui.live.screen import LiveScreen
from carpus.ui.patient.guide import Glance, GuideScene
from carpus.ui.patient.viewing import PatientViewing
from carpus.ui.plot.course import goals_deg
from carpus.ui.setup.exercise import ExerciseScreen
from carpus.ui.setup.set_sheet import SetSheet
from carpus.ui.theme import Theme
from tests.ui.conftest import Show
from tests.ui.contexts import Told, a_context
from tests.ui.fakes import FakeFeed, FakeMeasuring, FakeStore, session, set_up

PARTS = (CoursePart(exercise_named("WRIST_FE"), 2, 0, 20), CoursePart(exercise_named("FREE"), 0, 8, 0))
OWN = ExerciseSet("own", "Short", "wrist6", PARTS)


def test_sets_are_read_as_they_were_kept_and_a_second_person_s_change_is_told(tmp_path: Path) -> None:
    with Store(tmp_path) as store:
        assert read_sets(store) == USUAL_SETS
        keep_sets(store, (*USUAL_SETS, OWN), USUAL_SETS)
        assert read_sets(store) == (*USUAL_SETS, OWN)
        longer = replace(OWN, name="Longer")
        keep_sets(store, (*USUAL_SETS, longer), (*USUAL_SETS, OWN))
        with pytest.raises(ChangedMeanwhile):
            keep_sets(store, (*USUAL_SETS, replace(OWN, name="Mine")), (*USUAL_SETS, OWN))
        other = replace(OWN, set_id="other")
        keep_sets(store, (*USUAL_SETS, longer, other), (*USUAL_SETS, longer))
        keep_sets(store, (longer,), (*USUAL_SETS, longer))
        assert set(read_sets(store)) == {longer, other}, "what somebody else added stays"
        store.own(update(EXERCISE_SET).where(EXERCISE_SET.c.id == "other").values(discs="wrist7"))
        assert read_sets(store) == (longer,)


def test_the_next_session_begins_with_the_set_of_the_last_one(tmp_path: Path) -> None:
    library = Library(tmp_path)
    patient = library.patients.add(Patient("Heron 3", "left"))
    keep_sets(library.store, (OWN,), USUAL_SETS)
    first = begun(OWN, replace(set_up(), patient_id=patient, pseudonym="Heron 3", side="left", for_child=True), {})
    second = next_part(first)
    assert second is not None
    assert next_part(second) is None
    keep_set_up(library.store, second)
    again = last_set_up(library.store, patient)
    assert (again.exercise.id, again.repetitions, again.for_child) == ("WRIST_FE", 2, True)
    assert again.course.run_id != first.course.run_id
    keep_sets(library.store, USUAL_SETS, (OWN,))
    assert last_set_up(library.store, patient).course is None  # type: ignore[union-attr]
    library.close()


def test_goals_are_kept_for_each_exercise_and_hand_and_go_into_sets(tmp_path: Path) -> None:
    library = Library(tmp_path)
    patient = library.patients.add(Patient("Heron 3", "left"))
    one = replace(set_up(target_deg=50.0), patient_id=patient, pseudonym="Heron 3")
    keep_set_up(library.store, one)
    keep_set_up(library.store, replace(one, exercise=exercise_named("FREE"), side="left"))
    keep_set_up(library.store, replace(one, exercise=exercise_named("WRIST_RU"), target_negative_deg=-20.0))
    goals = patients.goals(library.store, patient)
    assert {key: value[0] for key, value in goals.items()} == {("WRIST_FE", "right"): 50.0, ("WRIST_RU", "right"): 50.0}
    assert goals["WRIST_RU", "right"][1] == -20.0
    assert begun(OWN, one, goals).target_positive_deg == 50.0
    assert math.isnan(begun(OWN, replace(one, side="left"), goals).target_positive_deg)
    library.store.do([dropped(PATIENT, patient)])
    assert patients.goals(library.store, patient) == {}
    library.close()


def test_a_goal_of_supination_is_read_from_thumb_up_and_one_of_an_older_version_is_converted(tmp_path: Path) -> None:
    library = Library(tmp_path)
    patient = library.patients.add(Patient("Heron 3", "left"))
    one = replace(set_up("FOREARM_PS", -30.0), patient_id=patient, pseudonym="Heron 3")
    keep_set_up(library.store, one)
    (stored,) = library.store.rows(select(GOAL))
    assert stored.positive_deg == 60.0, "as 0.2.0 stored it: 60 degrees up from palm down"
    assert patients.goals(library.store, patient)["FOREARM_PS", "right"][0] == -30.0
    again = last_set_up(library.store, patient)
    assert again is not None
    assert again.target_positive_deg == -30.0
    library.close()


def test_a_proposed_goal_is_taken_over_or_changed_and_shown_over_the_weeks(
    theme: Theme, show: Show[ExerciseScreen]
) -> None:
    screen = show(ExerciseScreen(theme))
    row = FakeStore().rows[5]
    last = set_up(target_deg=math.nan)
    screen.begin(row, last, "right", False, goals={("WRIST_RU", "right"): (15.0, math.nan)})
    assert not screen.accept.isVisible()
    figures = session_figures(session(seconds=26.0))
    screen.show_history("somebody else", [figures])
    assert not screen.accept.isVisible()
    screen.show_history(row.patient_id, [replace(figures, simulated=True)])
    assert not screen.accept.isVisible(), "what a simulated hand did is no measure of this patient"
    screen.show_history(row.patient_id, [figures])
    mean_deg = figures.find("flexion", "flexion").mean  # type: ignore[union-attr]
    assert "from the last session" in screen.proposal.text()
    screen.accept.click()
    goal_deg = screen.set_up().target_positive_deg
    assert mean_deg + 3.0 < goal_deg <= mean_deg + 5.0
    screen.choose(exercise_named("WRIST_RU"))
    assert screen.set_up().target_positive_deg == 15.0
    screen.asked["side"].buttons()[1].click()
    assert math.isnan(screen.set_up().target_positive_deg)
    shown = progress([replace(figures, targets_deg=(goal_deg, math.nan))])
    assert goals_deg(shown, ("flexion", "flexion")) == [goal_deg]
    assert goals_deg(shown, ("flexion", "extension")) == []


def test_a_set_runs_part_after_part_with_its_rest(qtbot: QtBot, theme: Theme) -> None:
    live = LiveScreen(theme, Background())
    qtbot.addWidget(live)
    patient = PatientViewing(a_context(theme, live, Told(), Background(), patient_sound=False), live.set_patient_view)
    live.patient_wanted.connect(patient.toggle)
    live.glanced.connect(patient.follow)
    measuring = FakeMeasuring(FakeFeed(seconds=2.0))
    now = SimpleNamespace(set_up=begun(OWN, set_up(), {}), source=SimpleNamespace(measuring=measuring))
    run = CourseRun(live, live, patient, now)  # type: ignore[arg-type]
    stops: list[float] = []
    live.recording.stop = lambda: stops.append(1.0)  # type: ignore[method-assign]
    run.begun(now.set_up)
    assert "1 of 2" in live.course.text()

    def found(count: int, at_s: float) -> list[float]:
        live.glanced.emit(Glance(at_s, 10.0, True, found=count, state="recording", asked=2))
        return stops

    assert not found(2, 0.0)
    for count, at_s in ((1, 1.0), (2, 1.1), (2, LINGER_S + 0.1)):
        assert not found(count, at_s), "what looked like a repetition was none"
    assert found(2, LINGER_S + 1.2)
    with qtbot.waitSignal(run.wanted):
        assert run.goes_on()
    assert measuring.chosen.exercise.id == "FREE"
    patient.toggle()
    qtbot.addWidget(patient.window)
    run._second()
    assert patient.window.view.scene.phase == "rest"
    assert "Rest 00:19" in live.course.text()
    live.glanced.emit(Glance(9.0, math.nan, True, True, (0.0, 5.0, 0.0)))
    assert patient.window.view.scene.phase == "rest", "the hand is not looked at in its rest"
    live.glanced.emit(Glance(9.1, math.nan, True, True, (0.0, 5.0, 0.0), state="recording"))
    assert not run.resting
    assert "Rest" not in live.course.text()
    assert not run.goes_on(), "nothing comes after the last part"
    now.set_up = None
    patient.begin(set_up())
    told = Glance(9.2, 10.0, True, True, (0.0, 5.0, 0.0), state="recording")
    live.glanced.emit(told)
    assert patient.window.view.scene.phase != GuideScene().phase
    patient.hide_all()
    live.glanced.emit(told)
    assert patient.window.view.scene.phase == GuideScene().phase, "the program is locked"
    patient.show_again()
    live.glanced.emit(told)
    assert patient.window.view.scene.phase != GuideScene().phase
    patient.close()


def test_a_therapist_makes_names_and_chooses_a_set(qtbot: QtBot, theme: Theme) -> None:
    screen = ExerciseScreen(theme)
    qtbot.addWidget(screen)
    screen.show_sets(USUAL_SETS)
    screen.begin(FakeStore().rows[5], set_up(), "right", False)
    sheet = SetSheet(screen, theme)
    sheet.kept.connect(screen.show_sets)
    screen.show()
    sheet.begin(USUAL_SETS, "wrist6")
    sheet.which.setCurrentIndex(sheet.which.count() - 1)
    assert not sheet.keep.isEnabled(), "it has no name"
    sheet.name.setText("Wrist, all ways")
    sheet._judge()
    assert not sheet.keep.isEnabled(), "another one has this name"
    sheet.name.setText("Mine")
    sheet.add.click()
    free = sheet.rows[1].exercise
    free.setCurrentIndex(free.findData("FREE"))
    assert sheet.rows[1].part().seconds == 60, "what has no repetitions goes by time"
    sheet.rows[1].earlier.click()
    sheet._judge()
    sheet.keep.click()
    chosen = screen.set_up()
    assert [part.exercise.id for part in chosen.course.parts] == ["FREE", "WRIST_FE"]
    assert chosen.exercise.id == "FREE"
    assert chosen.course.name == "Mine"
    sheet.begin((*USUAL_SETS, OWN), "wrist6", "own")
    sheet.delete.click()
    assert "Press again" in sheet.delete.text()
    with qtbot.waitSignal(sheet.kept) as kept:
        sheet.delete.click()
    assert kept.args[0] == USUAL_SETS
