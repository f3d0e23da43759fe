"""The form for values by hand: by keyboard in seconds, nobody led, nothing impossible kept; and where they are told."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from datetime import date, timedelta
from pathlib import Path
from types import SimpleNamespace
from typing import cast

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QWidget
from pytestqt.qtbot import QtBot

from carpus.core.measures.manual_measurements import ManualValue, Mode, current_values, find_manual_measure
from carpus.core.records.data_folder import DataFolder
from carpus.core.records.log import read_log
from carpus.core.records.values import Patient
from carpus.core.results.manual_proposals import propose_kapandji
from carpus.core.results.progress import compute_progress
from carpus.ui.charts.manual_values import manual_value_scale
from carpus.ui.kit.background import Background
from carpus.ui.kit.theme import Theme
from carpus.ui.report.progress_page import build_progress_report
from carpus.ui.report.session_page import build_session_report
from carpus.ui.screens.by_hand.flow import ManualMeasurementsFlow
from carpus.ui.screens.by_hand.screen import ManualMeasurementsScreen, ManualRecord
from carpus.ui.screens.progress.flow import write_tables
from carpus.ui.shell.main_window import MainWindow
from carpus.ui.words.manual_values import day_words, find_changes, full_name, list_other_values
from tests.ui.conftest import Show
from tests.ui.contexts import RecordingMessages, make_context
from tests.ui.fakes import NOW, FakeSessions, figures_once, hand_values
from tests.ui.hand_fakes import FakeHandSessions, hand_session
from tests.ui.printed import page_words

TODAY = NOW.date()


@pytest.fixture
def screen(theme: Theme, show: Show[ManualMeasurementsScreen]) -> ManualMeasurementsScreen:
    days = iter((TODAY - timedelta(days=1),))
    return show(ManualMeasurementsScreen(theme, lambda: next(days, TODAY)))  # made yesterday, it stood open over night


def typed(screen: ManualMeasurementsScreen, name: str, *texts: str) -> None:
    for (_, field), text in zip(screen.form.rows[name].fields, texts, strict=False):
        field.setFocus()
        QTest.keyClick(field, Qt.Key.Key_A, Qt.KeyboardModifier.ControlModifier)
        QTest.keyClicks(field, text) if text else QTest.keyClick(field, Qt.Key.Key_Delete)


def test_manual_form_edited_saves_only_changes_and_hides_carpus_value_before(
    screen: ManualMeasurementsScreen, qtbot: QtBot
) -> None:
    figures = sorted(FakeSessions().history("linden"), key=lambda one: one.when)
    screen.show_record(ManualRecord("Linden 42", "right", tuple(hand_values()), tuple(figures), "MK"))
    assert not screen.save_button.isEnabled()
    assert screen.current_day == TODAY
    flexion, extension = screen.form.rows["FLEXION"], screen.form.rows["EXTENSION"]
    assert flexion.last_text.text() == "13 Nov: 45° / 56°"
    assert "47°" in flexion.side_text.text()
    assert extension.side_text.text() == "–", "what Carpus measured is not shown before the hand's value is there"
    typed(screen, "EXTENSION", "44")
    assert "48°" in extension.side_text.text()
    typed(screen, "GRIP", "18", "19", "20,5")
    assert screen.form.rows["GRIP"].side_text.text() == "mean 19.2 kg"
    typed(screen, "GRIP", "18", "19", "260")
    assert screen.form.rows["GRIP"].side_text.text() == "mean 18.5 kg", "a try that is marked wrong counts nowhere"
    typed(screen, "GRIP", "18", "19", "20,5")
    typed(screen, "FLEXION", "47", "")
    with qtbot.waitSignal(screen.save_requested) as caught:
        QTest.keyClick(screen, Qt.Key.Key_Return, Qt.KeyboardModifier.ControlModifier)
    assert caught.args == [
        [
            ManualValue("FLEXION", "passive", "right", TODAY, ()),
            ManualValue("EXTENSION", "active", "right", TODAY, (44.0,)),
            ManualValue("GRIP", "", "right", TODAY, (18.0, 19.0, 20.5)),
        ],
        [],
    ]
    screen.hand_choice.choose("left")
    screen.hand_choice.chosen.emit("left")
    assert screen.form.rows["EXTENSION"].fields[0][1].is_empty
    typed(screen, "KEY_PINCH", "5,5")
    screen.hand_choice.choose("right")
    screen.hand_choice.chosen.emit("right")
    assert screen.form.rows["EXTENSION"].fields[0][1].value() == 44.0, "what is written stays, also beside another hand"
    with qtbot.waitSignal(screen.save_requested) as caught:
        screen.save_button.click()
    assert ManualValue("KEY_PINCH", "", "left", TODAY, (5.5,)) in caught.args[0]
    assert len(caught.args[0]) == 4
    typed(screen, "GRIP", "abc")
    screen.hand_choice.choose("left")
    screen.hand_choice.chosen.emit("left")
    assert screen.side == "right", "what cannot be kept is put right first"
    typed(screen, "GRIP", "18")
    screen.hand_choice.choose("left")
    screen.hand_choice.chosen.emit("left")
    assert flexion.fields[0][1].is_empty
    assert screen.form.rows["GRIP"].last_text.text() == "2 Oct: 34.0 kg"
    assert screen.form.rows["PRWE"].fields[0][1].value() == 46.5, "a score is of the person"


def test_manual_form_invalid_value_is_refused_and_unusual_one_confirmed(
    screen: ManualMeasurementsScreen, qtbot: QtBot
) -> None:
    screen.show_record(ManualRecord("Linden 42", "right", (), (), ""))
    active, passive = (field for _, field in screen.form.rows["FLEXION"].fields)
    active.setFocus()
    QTest.keyClick(active, Qt.Key.Key_Return)
    assert screen.focusWidget() is passive
    for text in ("abc", "181", "1e9", "nan", "--3"):
        typed(screen, "FLEXION", text)
        assert active.error, text
        assert not screen.save_button.isEnabled()
        assert "0" in screen.status_text.text() or text in screen.status_text.text()
    typed(screen, "FLEXION", "170")
    assert screen.save_button.isEnabled()
    with qtbot.waitSignal(screen.save_requested) as caught:
        screen.save_button.click()
    assert "170° is unusual" in caught.args[1][0]
    screen.measure_choice.setCurrentIndex(screen.measure_choice.findData("TIP_PINCH"))
    screen.measure_choice.activated.emit(screen.measure_choice.currentIndex())
    assert active.value() == 170.0, "what is written stays when a row is added"
    assert screen.focusWidget() is screen.form.rows["TIP_PINCH"].fields[0][1]


def press(screen: ManualMeasurementsScreen, key: Qt.Key) -> None:
    QTest.keyClick(cast("QWidget", screen.focusWidget()), key)


def test_finger_grid_typed_in_one_go_totals_follow_and_carpus_values_are_not_saved(
    screen: ManualMeasurementsScreen, qtbot: QtBot
) -> None:
    figures = sorted(FakeHandSessions().history("linden"), key=lambda one: one.when)
    screen.show_record(ManualRecord("Linden 42", "right", (), tuple(figures), "MK"))
    grid = screen.form.fingers
    cells = grid.cells
    measured = cells["PIP2_FLEXION", "active"]
    assert measured.is_measured
    assert measured.is_lower_bound
    assert measured.text().startswith("≥")
    assert not screen.has_unsaved, "what Carpus measured is no manual value"
    grid.setFocus()
    grid.setCurrentCell(1, 4)
    typed_texts = ("-10", "55", "2,5")  # DIP extension and flexion, then past the total to the distance from the palm
    for text in typed_texts:
        QTest.keyClicks(screen.focusWidget(), text[0])
        QTest.keyClicks(screen.focusWidget(), text[1:])
        press(screen, Qt.Key.Key_Return)
        QApplication.processEvents()  # the editor closes after its key
    assert (grid.currentRow(), grid.currentColumn()) == (2, 0)
    parts = [cells[f"{joint}2_FLEXION", "active"].number for joint in ("MCP", "PIP", "DIP")]
    lacking = [min(cells[f"{joint}2_EXTENSION", "active"].number, 0.0) for joint in ("MCP", "PIP", "DIP")]
    total = cells["TAM2", "active"]
    assert total.text() == f"≥{sum((*parts, *lacking)):.0f}", "a lower bound makes the total one"
    assert total.is_measured
    press(screen, Qt.Key.Key_Left)
    assert (grid.currentRow(), grid.currentColumn()) == (2, 0)
    press(screen, Qt.Key.Key_Down)
    QTest.keyClicks(grid, "x")
    assert "Ring finger" in screen.status_text.text()
    assert not screen.save_button.isEnabled()
    press(screen, Qt.Key.Key_Tab)
    grid.setCurrentCell(1, 5)
    QTest.keyClicks(grid, "9")
    assert cells["DIP2_FLEXION", "active"].typed_text == "9"
    press(screen, Qt.Key.Key_Escape)
    QApplication.processEvents()
    assert cells["DIP2_FLEXION", "active"].typed_text == "55", "Esc restores what was there"
    grid.setCurrentCell(3, 0)
    press(screen, Qt.Key.Key_Delete)
    with qtbot.waitSignal(screen.save_requested) as caught:
        QTest.keyClick(screen, Qt.Key.Key_Return, Qt.KeyboardModifier.ControlModifier)
    assert caught.args[0] == [
        ManualValue("DIP2_EXTENSION", "active", "right", TODAY, (-10.0,)),
        ManualValue("DIP2_FLEXION", "active", "right", TODAY, (55.0,)),
        ManualValue("TIP_TO_PALM2", "active", "right", TODAY, (2.5,)),
    ]
    grid.setCurrentCell(9, 5)
    press(screen, Qt.Key.Key_Tab)
    assert screen.focusWidget() is screen.form.rows["GRIP"].fields[0][1], "Tab leaves the grid after its last cell"
    screen.hand_choice.choose("left")
    screen.hand_choice.chosen.emit("left")
    assert not any(cell.is_measured for cell in cells.values()), "the session was of the right hand"


def test_finger_grid_chosen_from_other_measures_replaces_the_list_of_joints(screen: ManualMeasurementsScreen) -> None:
    screen.show_record(ManualRecord("Linden 42", "right", (), (), ""))
    choices = [screen.measure_choice.itemData(row) for row in range(screen.measure_choice.count())]
    assert not screen.form.has_fingers
    assert [name for name in choices if str(name)[-8:] in ("_FLEXION", "XTENSION")] == ["MCP2_FLEXION"]
    screen.measure_choice.setCurrentIndex(screen.measure_choice.findData("MCP2_FLEXION"))
    screen.measure_choice.activated.emit(screen.measure_choice.currentIndex())
    assert screen.form.has_fingers
    assert screen.focusWidget() is screen.form.fingers
    assert screen.measure_choice.findData("MCP2_FLEXION") < 0


def test_scores_are_proposed_or_worked_out_and_saved_only_when_chosen(
    screen: ManualMeasurementsScreen, qtbot: QtBot
) -> None:
    seen = figures_once(hand_session(exercise="THUMB_OPP", motion="opposition"))
    screen.show_record(ManualRecord("Linden 42", seen.side, (), (replace(seen, when=NOW, is_simulated=False),), ""))
    row = screen.form.rows["KAPANDJI"]
    (_, choice), answers = row.fields[0], screen.form.rows["PRWE"].answers_field
    assert choice.currentText() == "At least 6: proposed from the recording of 20 Nov"
    assert not screen.has_unsaved, "a proposal is no value"
    assert not any(cell.is_measured for cell in screen.form.fingers.cells.values()), "no joint was bent to its end"
    choice.setFocus()
    QTest.keyClicks(choice, "7")
    answers.setText("4 4 5 6 7 1 2 3 4 5 6 7 8 9")
    assert screen.form.rows["PRWE"].fields[0][1].is_empty
    assert screen.form.rows["PRWE"].side_text.text() == "14 of 15"
    assert screen.status_text.text() == "PRWE: unanswered questions 15"
    assert not screen.save_button.isEnabled(), "no answer that was typed is dropped unsaid"
    answers.setText(answers.text() + " 10")
    with qtbot.waitSignal(screen.save_requested) as caught:
        screen.save_button.click()
    assert caught.args[0] == [
        ManualValue("PRWE", "", "", TODAY, (53.5,)),
        ManualValue("KAPANDJI", "", seen.side, TODAY, (7.0,)),
    ]
    screen.show_record(ManualRecord("Linden 42", seen.side, (ManualValue("PRWE", "", "", TODAY, (40.0,)),), (), ""))
    for text, status in (("- " * 15, "unanswered questions 1–15"), ("4 - 4", "unanswered questions 2, 4–15"), ("", "")):
        answers.setText(text)
        assert screen.list_unsaved() == [], "answers that are not complete keep the saved score"
        assert status in screen.status_text.text()
        assert screen.has_unsaved == bool(text), "the window asks before they are lost"
    answers.setText("- " * 15)
    assert screen.form.rows["PRWE"].side_text.text() == "0 of 15"
    screen.show_record(screen.record, is_refresh=True)
    assert answers.text(), "typed while other values were saved"
    screen.show_record(screen.record)
    assert not answers.text(), "given up"
    seen = replace(seen, when=NOW + timedelta(days=1), is_simulated=False)
    assert propose_kapandji([seen], seen.side, TODAY) is None, "of a day to come"


def test_score_typed_stays_when_answers_are_begun_and_given_up(screen: ManualMeasurementsScreen) -> None:
    saved = ManualValue("PRWE", "", "", TODAY, (40.0,))
    screen.show_record(ManualRecord("Linden 42", "right", (saved,), (), ""))
    typed(screen, "PRWE", "41")
    answers = screen.form.rows["PRWE"].answers_field
    for text in ("4", ""):
        answers.setText(text)
        assert [one.trials for one in screen.list_unsaved()] == [(41.0,)]


def test_stored_values_of_more_digits_than_shown_are_no_change(screen: ManualMeasurementsScreen) -> None:
    stored = (
        ManualValue("FLEXION", "active", "right", TODAY, (12.34567,)),
        ManualValue("PIP2_FLEXION", "active", "right", TODAY, (100.0 / 3.0,)),
        ManualValue("KAPANDJI", "", "right", TODAY, (4.5,)),
    )
    screen.show_record(ManualRecord("Linden 42", "right", stored, (), ""))
    assert screen.list_unsaved() == []
    choice = screen.form.rows["KAPANDJI"].fields[0][1]
    assert choice.value() == 4.5, "a score that was typed before there was a choice"
    choice.set_value(7.0)
    assert [one.trials for one in screen.list_unsaved()] == [(7.0,)]


@pytest.fixture
def library(tmp_path: Path) -> Iterator[DataFolder]:
    opened = DataFolder(tmp_path / "data")
    yield opened
    opened.close()


def test_manual_form_saved_values_are_stored_and_logged(
    theme: Theme, host: QWidget, library: DataFolder, background: Background, qtbot: QtBot
) -> None:
    patient = library.patients.add(Patient("Linden 42", "left"))
    told = RecordingMessages("progress", answer=0)
    closed: list[str] = []
    shell = SimpleNamespace(close_without_prompt=lambda: closed.append("closed"))
    context = make_context(theme, host, told, background, library=library)
    now = context.current
    now.patient = Patient("Linden 42", "left", patient_id=patient)
    flow = ManualMeasurementsFlow(context)
    context.window = cast("MainWindow", shell)
    screen = flow.screen
    qtbot.addWidget(screen)
    screen.show()
    flow.open()
    qtbot.waitUntil(lambda: told.screen_name == "by_hand")
    assert screen.side == "left"
    typed(screen, "FLEXION", "170")
    screen.save_button.click()
    qtbot.waitUntil(lambda: screen.status_text.text() == "Saved.")
    (kept,) = library.manual_measurements(patient)
    assert (kept.value, kept.rater, kept.side, kept.day) == (170.0, "MK", "left", TODAY)
    typed(screen, "FLEXION", "71")
    screen.save_button.click()
    screen.save_button.click()
    typed(screen, "GRIP", "30")
    qtbot.waitUntil(lambda: not background.is_busy)
    assert len(library.manual_measurements(patient)) == 2, "saved once, pressed twice"
    assert [one.trials for one in screen.list_unsaved()] == [(30.0,)], "typed while the others were saved"
    typed(screen, "GRIP", "")
    assert screen.form.rows["FLEXION"].last_text.text() == "changed"
    assert "170° active · MK" in screen.form.rows["FLEXION"].last_text.toolTip()
    assert told.asked == ["Check the unusual values, or save them as entered"]
    flow.navigate_back()
    assert told.shown == [("progress", patient)]
    typed(screen, "FLEXION", "70")
    heron = library.patients.add(Patient("Heron 17", "right"))
    for person, name, written in ((heron, "Heron 17", ""), (patient, "Linden 42", "70")):
        now.patient = Patient(name, "left", patient_id=person)
        flow.open()
        qtbot.waitUntil(lambda person=person: screen.record.patient_id == person)
        assert screen.form.rows["FLEXION"].fields[0][1].text() == written, name
    assert flow.prompt_before_close(), "what is written would be lost with the window"
    assert told.asked[1:] == ["Leave without saving?"]
    assert closed == ["closed"], "let go of, the window closes"
    flow.navigate_back()
    assert told.asked[1:] == ["Leave without saving?"] * 2
    assert not flow.prompt_before_close(), "nothing is left to be lost"
    assert not told.faults
    assert [entry.action for entry in read_log(library.store) if entry.action != "added"] == ["entered_by_hand"] * 2


def test_total_of_a_finger_stands_for_its_joints_in_changes_and_words() -> None:
    def of_day(day: date, mode: Mode, flexion: float) -> list[ManualValue]:
        angles = {f"{joint}4_FLEXION": flexion for joint in ("MCP", "PIP", "DIP")}
        angles |= {f"{joint}4_EXTENSION": -10.0 for joint in ("MCP", "PIP", "DIP")}
        return [ManualValue(name, mode, "right", day, (angle,)) for name, angle in angles.items()]

    joint_alone = [ManualValue("PIP2_FLEXION", "active", "right", TODAY, (60.0,))]
    weeks = (TODAY - timedelta(days=14), TODAY)
    values = current_values([one for k, day in enumerate(weeks) for one in of_day(day, "passive", 60.0 + 10.0 * k)])
    changed = find_changes([*values, *joint_alone])
    assert [full_name(key) for key, _ in changed] == ["Ring finger, TPM"]
    assert list_other_values([*values, *joint_alone], (key for key, _ in changed)) == joint_alone
    assert day_words([one for one in values if one.day == TODAY]) == (
        "Ring finger, passive: MCP \N{MINUS SIGN}10/70, PIP \N{MINUS SIGN}10/70, DIP \N{MINUS SIGN}10/70, TPM 180°"
    )


@pytest.mark.parametrize("values", [[-5.0], [-40.0], [-40.0, 10.0], [0.0, 30.0]])
def test_manual_value_scale_of_deficits_has_few_ticks_each_its_own(values: list[float]) -> None:
    scale = manual_value_scale(find_manual_measure("PIP2_EXTENSION"), values)

    assert scale.low <= min(values) <= max(values) <= scale.high
    assert len({text for _, text in scale.labels}) == len(scale.ticks) <= 7


def test_manual_values_in_reports_and_tables_are_marked_as_manual(tmp_path: Path) -> None:
    store = FakeSessions()
    values = hand_values()
    report = build_session_report(store.session("session-7"), history=store.history("linden"), manual_values=values)
    said = page_words(report)
    assert "Measured manually, not by Carpus" in said
    assert "Wrist, flexion 47° active, 58° passive" in said
    assert "17.6" not in said, "of another day"
    mine = [one for one in current_values(values) if one.side in ("right", "")]
    course = build_progress_report(store.history("linden"), manual_values=mine)
    said = page_words(course)
    for words in ("Manual measurements", "25° → 47° since 2 Oct", "Grip", "17.6 cm over both styloids"):
        assert words in said, words
    path = tmp_path / "course.csv"
    write_tables(path, course.progress)
    lines = (tmp_path / "course-by-hand.csv").read_text(encoding="utf-8").splitlines()
    assert len(lines) == 1 + len(mine)
    assert any(line.startswith("2026-11-20,right,GRIP,,kg,18,18 19 17") for line in lines)
    assert "by_hand" not in path.read_text(encoding="utf-8")
    (tmp_path / "other-by-hand.csv").write_text("kept", encoding="utf-8")
    assert write_tables(tmp_path / "other.csv", course.progress)[1].name == "other-by-hand-2.csv"
    assert (tmp_path / "other-by-hand.csv").read_text(encoding="utf-8") == "kept", "nobody was asked for it"
    bare = compute_progress(store.history("linden"))
    write_tables(tmp_path / "bare.csv", bare)
    assert not (tmp_path / "bare-by-hand.csv").exists()
