"""A corrected session in the data folder: tried apart, taken into the list when wanted, the old one kept."""

from __future__ import annotations

import errno
import math
import os
import shutil
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import fields, replace
from datetime import datetime, timedelta
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import Qt
from pytestqt.qtbot import QtBot

from carpus.core.errors import (
    ChangedMeanwhile,
    DiskFull,
    FolderMissing,
    OutputNotWritable,
    RegisterBusy,
    SessionUnreadable,
)
from carpus.core.pipeline.correction import CorrectionTask, correct, task_of
from carpus.core.records.backup import gather
from carpus.core.records.changes import dropped
from carpus.core.records.corrections import Corrections, Waiting, _found_again, difference
from carpus.core.records.keeping import Records
from carpus.core.records.library import Library
from carpus.core.records.new_sessions import recover
from carpus.core.records.schema import SESSION
from carpus.core.records.set_up import MARKERS_SUFFIX
from carpus.core.records.store import Store
from carpus.core.records.values import PatientEntry
from carpus.core.results.figures import session_figures
from carpus.core.results.repetition_rows import PASSIVE, RepetitionChoices
from carpus.core.session.disk import publish
from carpus.core.session.reader import read_session, write_anew
from carpus.core.session.values import RepetitionRow, Repetitions
from carpus.ui.background import Background
from carpus.ui.correct.flow import CorrectFlow
from carpus.ui.now_open import NowOpen
from carpus.ui.review.flow import ReviewFlow
from carpus.ui.sessions.flow import StoredSessions
from carpus.ui.shell import Shell
from carpus.ui.theme import Theme
from tests.pipeline.test_correction import WRONG_FROM, Stored, put_right, stored  # noqa: F401  (a fixture)
from tests.ui.contexts import Told, a_context


@pytest.fixture
def library(tmp_path: Path) -> Iterator[Library]:
    opened = Library(tmp_path / "data")
    yield opened
    opened.close()


def entered(library: Library, stored: Stored) -> tuple[str, str]:  # noqa: F811
    patient = library.patients.add(PatientEntry("Linden 42", "right"))
    when = datetime(2026, 11, 20, 11, 36).astimezone()
    path = library.index.new_path(patient, "Linden 42", "WRIST_FE", "right", when)
    shutil.copyfile(stored.path, path)
    return patient, library.index.enter(path, patient).session_id


def made(corrections: Corrections, session_id: str, stored: Stored) -> Path:  # noqa: F811
    trial = corrections.trial_path(session_id)
    correct(task_of(stored.path, trial, (put_right(stored),), "2.0"))
    return trial


def test_a_trial_is_in_no_list_and_waits_until_it_is_wanted(library: Library, stored: Stored) -> None:  # noqa: F811
    patient, session_id = entered(library, stored)
    corrections = Corrections(library)
    trial = made(corrections, session_id, stored)
    recover(library)
    assert [entry.session_id for entry in library.index.of_patient(patient)] == [session_id]
    found = difference(*corrections.both(session_id, trial))
    assert found.common > 100
    assert math.degrees(found.most_rad) < 10.0
    assert found.live, "the old result was not looked back at"
    old, new = corrections.both(session_id, trial)
    assert difference(new, new).live is False
    behind = replace(new, motion=replace(new.motion, angles_rad=new.motion.angles_rad + 1.0))
    assert difference(old, behind).changed == len(old), "what the camera showed at the time, not what looking back made"
    trial.with_suffix(".12345678.part").write_bytes(b"x")  # the program was killed in the midst of another one
    later = Corrections(library)
    later.clear_unfinished()
    assert later.waiting() == [Waiting(session_id, trial)]
    assert list(trial.parent.iterdir()) == [trial]
    corrections.drop(trial)
    assert later.waiting() == []


@pytest.mark.parametrize("kind", ["session", "patient"])
@pytest.mark.parametrize("is_damaged", [False, True])
def test_what_waits_is_erased_with_its_session_also_what_is_damaged_or_not_finished(
    library: Library,
    stored: Stored,  # noqa: F811
    kind: str,
    is_damaged: bool,
) -> None:
    patient, session_id = entered(library, stored)
    other, corrections = library.entry(session_id).path, Corrections(library)
    trials = [made(corrections, session_id, stored) for _ in range(2)]
    trials.append(trials[0].with_name(f"{trials[0].name}.12345678.part"))
    trials[2].write_bytes(b"x")
    if kind == "patient":
        trials.append(trials[0].with_name("another name.h5"))
        trials[3].write_bytes(other.read_bytes()[:9000])  # what is left of a session
    if is_damaged:
        for trial in trials[:2]:
            trial.write_bytes(b"no session")
    nobodys = trials[0].with_name(f"{other.stem}0.h5")
    nobodys.write_bytes(b"no session")
    copy = other.with_name(f".{other.stem}.12345678.h5.new")  # the program was killed while it took one
    copy.write_bytes(b"x")
    records = Records(library)
    plan = records.plan_session(session_id) if kind == "session" else records.plan_patient(patient)
    assert {*trials, copy} <= {*plan.files}
    records.erase(plan)
    assert [trial for trial in trials if trial.exists()] == []
    assert not copy.exists()
    assert nobodys.exists() == (kind == "session"), "of the patient also what has the name"


def test_nothing_comes_up_and_enter_space_and_escape_decide_nothing(
    qtbot: QtBot, library: Library, stored: Stored, monkeypatch: pytest.MonkeyPatch,  # noqa: F811
) -> None:  # fmt: skip
    patient, session_id = entered(library, stored)

    def beside(task: CorrectionTask, progress: Callable[[int, int], None], stopping: threading.Event) -> bool:
        progress(30, 120)
        if again and stopping.wait(30.0):
            return False
        again.append("next time it is stopped")
        correct(task)
        return True

    again: list[str] = []
    monkeypatch.setattr("carpus.ui.correct.flow.correct_in_process", beside)
    theme, told = Theme("light"), Told("settings", behind="correct")  # what comes of it comes behind them
    shell = Shell(theme)
    qtbot.addWidget(shell)
    shell.resize(1280, 744)
    shell.show()
    stage = shell.stage
    now = NowOpen(session_id=session_id)
    flow = CorrectFlow(a_context(theme, shell, told, Background(), library=library, now=now))
    sheet = flow.sheet
    said: list[tuple[int, int]] = []
    flow.changed.connect(lambda percent, count: said.append((percent, count)))
    time.sleep(1.1)  # files say the second in which they were made, and nobody corrects within one
    flow.start(session_id, (put_right(stored),))
    qtbot.waitUntil(lambda: said[-1:] == [(-1, 1)], timeout=30_000)
    assert (25, 0) in said
    assert not sheet.isVisible()
    for key in (Qt.Key.Key_Return, Qt.Key.Key_Space, Qt.Key.Key_Escape):
        flow.open_sheet()
        qtbot.waitUntil(lambda: sheet.both is not None, timeout=30_000)
        assert sheet.use.isVisible()
        qtbot.keyClick(stage.focusWidget(), key)
        assert not sheet.isVisible()
    assert [one.session_id for one in flow.waiting] == [session_id]
    assert [entry.session_id for entry in library.sessions(patient)] == [session_id]
    flow.open_sheet()
    qtbot.waitUntil(lambda: sheet.both is not None, timeout=30_000)
    assert "Not held" not in sheet.words.text()
    sheet.use.click()
    qtbot.waitUntil(lambda: bool(told.shown), timeout=30_000)
    (new,) = (entry.session_id for entry in library.sessions(patient))
    assert told.shown == [("review", new)]
    assert said[-1] == (-1, 0)
    line = StoredSessions(library).with_figures(StoredSessions(library).lines(patient)[0])
    assert line.corrected.startswith("Corrected on ")
    assert line.corrected.endswith(", from 00:02.0, by MK.")
    assert not told.faults
    flow.start(new, (put_right(stored),))
    flow.open_sheet()
    assert sheet.stop.isVisible()
    sheet.stop.click()
    qtbot.waitUntil(lambda: flow.running == "", timeout=30_000)
    assert not sheet.isVisible()
    assert flow.waiting == []
    flow.close()


def test_a_wanted_result_counts_and_the_old_one_stays(library: Library, stored: Stored) -> None:  # noqa: F811
    patient, session_id = entered(library, stored)
    corrections = Corrections(library)
    old = library.entry(session_id).path
    old.with_suffix(MARKERS_SUFFIX).write_bytes(b"picture")
    library.keep_choices(session_id, RepetitionChoices({0: "pain"}, not_counted=True, not_counted_reason="discs lost"))
    library.index.rename_exercise(session_id, "WRIST_RUD")
    time.sleep(1.1)  # files say the second in which they were made, and nobody corrects within one
    new = corrections.use(session_id, made(corrections, session_id, stored))
    assert [entry.session_id for entry in library.sessions(patient)] == [new]
    assert [entry.session_id for entry in library.results_of(new)] == [session_id, new]
    assert [entry.session_id for entry in library.results_of(session_id)] == [session_id, new]
    assert old.exists()
    assert library.entry(new).exercise == "WRIST_RUD"
    assert library.entry(new).path.with_suffix(MARKERS_SUFFIX).read_bytes() == b"picture"
    assert library.choices(new) == RepetitionChoices(not_counted=True, not_counted_reason="discs lost")


class Killed(BaseException):
    """Stands for a SIGKILL: nothing that comes behind it is done."""


@pytest.mark.parametrize(
    ("step", "is_listed"), [("core.records.store.Store.do", False), ("core.records.corrections.publish", True)]
)
def test_a_kill_leaves_the_older_result_or_the_new_one_with_what_was_left_out(
    library: Library, stored: Stored, monkeypatch: pytest.MonkeyPatch, step: str, is_listed: bool  # noqa: F811
) -> None:  # fmt: skip
    patient, session_id = entered(library, stored)
    library.keep_choices(session_id, RepetitionChoices(not_counted=True, not_counted_reason="pain"))
    time.sleep(1.1)  # files say the second in which they were made, and nobody corrects within one
    trial = made(Corrections(library), session_id, stored)

    def killed(*_: object) -> None:
        raise Killed

    with monkeypatch.context() as patched:
        patched.setattr(f"carpus.{step}", killed)
        with pytest.raises(Killed):
            Corrections(library).use(session_id, trial)
    recover(library)
    listed = [entry.session_id for entry in library.index.of_patient(patient)]
    later = Corrections(library)
    if not is_listed:
        assert listed == [session_id]
        assert later.waiting() == [Waiting(session_id, trial)]
        later.use(session_id, trial)
    assert later.waiting() == []
    assert not trial.exists()
    (new,) = (entry.session_id for entry in library.sessions(patient))
    assert new != session_id
    assert len(library.session(new)) == len(library.session(session_id))
    assert library.choices(new) == RepetitionChoices(not_counted=True, not_counted_reason="pain")
    assert len(list(library.folder.rglob("*.h5"))) == 2


def test_an_older_result_counts_again_with_its_choices_until_the_other_one_does(
    library: Library,
    stored: Stored,  # noqa: F811
) -> None:
    patient, old = entered(library, stored)
    corrections = Corrections(library)
    new = corrections.use(old, made(corrections, old, stored))
    said = RepetitionChoices({0: "pain"}, {1: (1.0, 2.0)})
    library.keep_choices(old, said)
    again = corrections.use_again(old)
    assert [entry.session_id for entry in library.sessions(patient)] == [again]
    assert [entry.session_id for entry in library.results_of(old)][-1] == again
    assert library.choices(again) == said
    assert np.array_equal(library.session(again).motion.angles_rad, library.session(old).motion.angles_rad)
    assert not np.array_equal(library.session(again).motion.angles_rad, library.session(new).motion.angles_rad)
    last = corrections.use_again(new)
    assert [entry.session_id for entry in library.sessions(patient)] == [last]


def test_a_new_result_goes_to_a_share_on_another_disk(
    library: Library, stored: Stored, monkeypatch: pytest.MonkeyPatch  # noqa: F811
) -> None:  # fmt: skip
    _, session_id = entered(library, stored)
    trial = made(Corrections(library), session_id, stored)

    on_another_disk(monkeypatch)
    new = Corrections(library).use(session_id, trial)
    place = library.entry(new).path
    assert read_session(place).header.session_id == new
    assert not trial.exists()
    assert sorted(path.name for path in place.parent.iterdir()) == sorted(
        entry.path.name for entry in library.results_of(new)
    )
    shutil.copyfile(place, trial)  # a program was killed before it could delete what it had copied
    assert Corrections(library).waiting() == []
    assert not trial.exists()
    assert library.entry(new).path == place


def test_what_a_killed_program_had_copied_goes_at_the_next_look_and_is_in_no_backup(
    library: Library, stored: Stored, monkeypatch: pytest.MonkeyPatch  # noqa: F811
) -> None:  # fmt: skip
    _, session_id = entered(library, stored)
    corrections, folder = Corrections(library), library.entry(session_id).path.parent
    trial = made(corrections, session_id, stored)
    copies: dict[Path, bytes] = {}

    def killed(*_: object) -> None:
        copies.update({path: path.read_bytes() for path in folder.glob(".*")})
        raise Killed

    with monkeypatch.context() as patched:
        on_another_disk(patched)
        patched.setattr(os, "fsync", killed)
        with pytest.raises(Killed):
            corrections.use(session_id, trial)
    ((copy, content),) = copies.items()
    copy.write_bytes(content)
    names = {path for _, path, _ in gather(library.folder, library.folder.with_name("place"), None).files}
    assert library.entry(session_id).path in names
    assert copy not in names
    assert corrections.waiting() == [Waiting(session_id, trial)]
    assert not copy.exists()
    copy.write_bytes(content)
    corrections.use(session_id, trial)
    assert list(folder.glob(".*")) == []


def on_another_disk(monkeypatch: pytest.MonkeyPatch) -> None:
    replace_real = Path.replace

    def refused(*_: object) -> None:
        raise OSError(errno.EXDEV, "Invalid cross-device link")

    def replaced(path: Path, target: Path) -> Path:
        if path.parent != target.parent:
            refused()
        return replace_real(path, target)

    monkeypatch.setattr("carpus.core.session.disk.os.link", refused)
    monkeypatch.setattr(Path, "replace", replaced)


@pytest.mark.parametrize("number", [errno.ENOSPC, errno.EACCES])
def test_a_result_that_did_not_get_its_name_is_in_no_list_and_waits(
    library: Library, stored: Stored, monkeypatch: pytest.MonkeyPatch, number: int  # noqa: F811
) -> None:  # fmt: skip
    patient, session_id = entered(library, stored)
    corrections = Corrections(library)
    library.keep_choices(session_id, RepetitionChoices({0: "pain"}))
    library.entry(session_id).path.with_suffix(MARKERS_SUFFIX).write_bytes(b"picture")
    before = sorted(library.entry(session_id).path.parent.iterdir())
    trial = made(corrections, session_id, stored)

    def refused(*_: object) -> None:
        raise OSError(number, os.strerror(number))

    with monkeypatch.context() as patched:
        on_another_disk(patched)
        patched.setattr(shutil, "copyfile", lambda one, other: refused() if one == trial else _copied(one, other))
        with pytest.raises(DiskFull if number == errno.ENOSPC else OutputNotWritable):
            corrections.use(session_id, trial)
    assert [entry.session_id for entry in library.index.of_patient(patient)] == [session_id]
    assert len(library.history(patient)) == 1
    assert sorted(library.entry(session_id).path.parent.iterdir()) == before
    assert corrections.waiting() == [Waiting(session_id, trial)]
    new = corrections.use(session_id, trial)
    assert library.choices(new).left_out
    assert len(library.session(new)) == len(library.session(session_id))


def _copied(one: Path, other: Path) -> None:
    other.write_bytes(one.read_bytes())


def test_a_file_that_took_the_name_meanwhile_is_kept_and_the_result_has_another_one(
    library: Library, stored: Stored, monkeypatch: pytest.MonkeyPatch  # noqa: F811
) -> None:  # fmt: skip
    _, session_id = entered(library, stored)
    trial = made(Corrections(library), session_id, stored)
    real, taken = library.index.enter, list[Path]()

    def enter(path: Path, *told: object) -> object:
        path.write_bytes(b"another one's")
        taken.append(path)
        return real(path, *told)  # type: ignore[arg-type]

    with monkeypatch.context() as patched:
        patched.setattr(library.index, "enter", enter)
        new = Corrections(library).use(session_id, trial)
    assert taken[0].read_bytes() == b"another one's"
    assert library.entry(new).path != taken[0]
    assert len(library.session(new)) == len(library.session(session_id))
    assert not trial.exists()
    assert len(list(taken[0].parent.iterdir())) == 3


def test_a_result_that_two_give_its_name_lies_there_once(
    library: Library, stored: Stored, monkeypatch: pytest.MonkeyPatch  # noqa: F811
) -> None:  # fmt: skip
    """A look for what waits meets one that is just being taken."""
    _, session_id = entered(library, stored)
    trial = made(Corrections(library), session_id, stored)

    def with_a_look(part: Path, target: Path) -> None:
        monkeypatch.undo()
        Corrections(library).waiting()
        publish(part, target)

    monkeypatch.setattr("carpus.core.records.corrections.publish", with_a_look)
    new = Corrections(library).use(session_id, trial)
    old = library.entry(session_id).path
    assert set(old.parent.iterdir()) == {old, library.entry(new).path}
    assert len(library.session(new)) == len(library.session(session_id))
    assert not trial.exists()


def test_what_is_listed_is_never_dropped_nor_deleted_and_hides_nothing_that_waits(
    library: Library, stored: Stored, monkeypatch: pytest.MonkeyPatch  # noqa: F811
) -> None:  # fmt: skip
    _, session_id = entered(library, stored)
    corrections = Corrections(library)
    trial, other = (made(corrections, session_id, stored) for _ in range(2))

    def killed(*_: object) -> None:
        raise Killed

    def full(*_: object) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    def slow(path: Path) -> None:
        raise SessionUnreadable(path, "damaged: reading it does not end")

    with monkeypatch.context() as patched:
        patched.setattr("carpus.core.records.corrections.publish", killed)
        with pytest.raises(Killed):
            corrections.use(session_id, trial)
    with pytest.raises(ChangedMeanwhile):
        corrections.drop(trial)
    with monkeypatch.context() as patched:
        patched.setattr("carpus.core.records.corrections.read_outline", slow)
        assert corrections.waiting() == []
    assert trial.exists()
    assert other.exists()
    with monkeypatch.context() as patched:
        patched.setattr(os, "link", full)
        patched.setattr(os, "open", full)
        assert corrections.waiting() == [Waiting(session_id, other)]
    assert trial.exists()
    assert corrections.waiting() == [Waiting(session_id, other)]
    assert not trial.exists()


def test_keeping_the_old_one_is_refused_where_the_new_one_is_listed_already(
    qtbot: QtBot, library: Library, stored: Stored, monkeypatch: pytest.MonkeyPatch,  # noqa: F811
) -> None:  # fmt: skip
    patient, session_id = entered(library, stored)
    time.sleep(1.1)  # files say the second in which they were made, and nobody corrects within one
    trial = made(Corrections(library), session_id, stored)

    def killed(*_: object) -> None:
        raise Killed

    with monkeypatch.context() as patched:
        patched.setattr("carpus.core.records.corrections.publish", killed)
        with pytest.raises(Killed):
            Corrections(library).use(session_id, trial)
    theme, told = Theme("light"), Told("correct")
    shell = Shell(theme)
    qtbot.addWidget(shell)
    flow = CorrectFlow(a_context(theme, shell, told, Background(), library=library, now=NowOpen(session_id=session_id)))
    flow.waiting = [Waiting(session_id, trial)]
    flow.open_sheet()
    flow.sheet.keep.click()
    qtbot.waitUntil(lambda: bool(told.faults) and not trial.exists(), timeout=30_000)
    (new,) = library.history(patient)
    assert new.session_id != session_id
    flow.close()


def test_what_is_decided_about_while_it_is_looked_for_waits_no_more(
    qtbot: QtBot, library: Library, stored: Stored,  # noqa: F811
) -> None:  # fmt: skip
    _, session_id = entered(library, stored)
    trials = [made(Corrections(library), session_id, stored) for _ in range(2)]
    theme, told, background = Theme("light"), Told("settings", behind="review"), Background()
    shell = Shell(theme)
    qtbot.addWidget(shell)
    now = NowOpen(session_id=session_id)
    flow = CorrectFlow(a_context(theme, shell, told, background, library=library, now=now))
    for trial, decided in zip(trials, (flow.sheet.keep, flow.sheet.use), strict=True):
        flow.waiting = [Waiting(session_id, trial)]
        flow.open_sheet()
        flow.look_for_waiting()
        decided.click()
        qtbot.waitUntil(lambda trial=trial: not trial.exists() and not flow._background.busy, timeout=30_000)
        assert trial not in [one.trial for one in flow.waiting]
    assert flow.waiting == []
    ((_, new),) = told.shown
    review = ReviewFlow(a_context(theme, shell, told, background, library=library, now=NowOpen(session_id=new)))
    review._use_again(new)
    qtbot.waitUntil(lambda: len(told.shown) == 2, timeout=30_000)
    assert [one.session_id for one in library.results_of(new)][1:] == [new, told.shown[1][1]]
    assert told.asked == ["This result counts from now on."]
    flow.close()


@pytest.mark.parametrize("is_answered", ["before the end", "after the end"])
def test_what_is_tracked_again_while_it_is_looked_for_waits_once(
    qtbot: QtBot, library: Library, stored: Stored, monkeypatch: pytest.MonkeyPatch, is_answered: str  # noqa: F811
) -> None:  # fmt: skip
    _, session_id = entered(library, stored)
    written, ends, answers = threading.Event(), threading.Event(), threading.Event()

    def beside(task: CorrectionTask, *_: object) -> bool:
        if is_answered == "after the end":
            ends.wait(30.0)
        correct(task)
        written.set()
        return ends.wait(30.0)

    monkeypatch.setattr("carpus.ui.correct.flow.correct_in_process", beside)
    theme, told = Theme("light"), Told("review")
    shell = Shell(theme)
    qtbot.addWidget(shell)
    now = NowOpen(session_id=session_id)
    flow = CorrectFlow(a_context(theme, shell, told, Background(), library=library, now=now))
    flow.start(session_id, (put_right(stored),))
    if is_answered == "before the end":
        qtbot.waitUntil(written.is_set, timeout=30_000)
        flow.look_for_waiting()
        qtbot.waitUntil(lambda: len(flow.waiting) == 1, timeout=30_000)
        ends.set()
    else:
        look = flow._stored.waiting

        def slow() -> Sequence[Waiting]:
            found = look()
            answers.wait(30.0)
            return found

        with monkeypatch.context() as patched:
            patched.setattr(flow._stored, "waiting", slow)
            flow.look_for_waiting()
        ends.set()
        qtbot.waitUntil(lambda: len(flow.waiting) == 1, timeout=30_000)
        answers.set()
    qtbot.waitUntil(lambda: not (flow.running or flow._tracking.busy or flow._background.busy), timeout=30_000)
    assert [one.session_id for one in flow.waiting] == [session_id]
    flow.close()


def test_one_of_a_session_that_may_come_yet_waits_and_one_of_none_goes(
    library: Library, stored: Stored, monkeypatch: pytest.MonkeyPatch  # noqa: F811
) -> None:  # fmt: skip
    _, session_id = entered(library, stored)
    corrections = Corrections(library)
    trial = made(corrections, session_id, stored)
    library.store.do([dropped(SESSION, session_id)])
    with monkeypatch.context() as patched:
        patched.setattr(library.store, "knows_all", lambda: False)
        assert corrections.waiting() == []
    assert trial.exists()
    assert corrections.waiting() == []
    assert not trial.exists()


def test_a_share_that_is_away_is_told_before_anything_is_done(tmp_path: Path, stored: Stored) -> None:  # noqa: F811
    share = tmp_path / "share"
    share.mkdir()
    library = Library(tmp_path / "data", sessions=share)
    try:
        patient, session_id = entered(library, stored)
        corrections = Corrections(library)
        trial = made(corrections, session_id, stored)
        share.rename(tmp_path / "away")
        with pytest.raises(FolderMissing):
            corrections.use(session_id, trial)
        assert corrections.waiting() == [Waiting(session_id, trial)]
        assert [entry.session_id for entry in library.index.of_patient(patient)] == [session_id]
    finally:
        library.close()


def test_a_copy_that_counts_again_is_the_newest_by_any_clock_and_says_no_other_origin(
    library: Library, stored: Stored, monkeypatch: pytest.MonkeyPatch  # noqa: F811
) -> None:  # fmt: skip
    patient, session_id = entered(library, stored)
    corrections = Corrections(library)
    trial = made(corrections, session_id, stored)
    ahead = trial.with_name("ahead.h5")
    write_anew(trial, ahead, created=(datetime.now().astimezone() + timedelta(hours=3)).isoformat())
    corrections.drop(trial)
    fast = corrections.use(session_id, ahead)
    again = corrections.use_again(session_id)
    assert [entry.session_id for entry in library.sessions(patient)] == [again]
    assert [one.session_id for one in library.history(patient)] == [again]
    assert library.session(again).header.origin == library.session(session_id).header.origin == ""
    assert library.session(corrections.use_again(fast)).header.origin == session_id
    before = [entry.session_id for entry in library.results_of(session_id)]

    def busy(*_: object) -> None:
        raise RegisterBusy

    monkeypatch.setattr(Store, "do", busy)
    with pytest.raises(RegisterBusy):
        corrections.use_again(session_id)
    assert list(trial.parent.iterdir()) == []
    assert [entry.session_id for entry in library.results_of(session_id)] == before


def test_what_was_left_out_of_the_old_result_does_not_count_in_the_new_one(
    library: Library,
    stored: Stored,  # noqa: F811
) -> None:
    _, session_id = entered(library, stored)
    figures = session_figures(library.session(session_id))
    number = next(number for number, one in enumerate(figures.repetitions) if one.counts)
    library.keep_choices(session_id, RepetitionChoices({number: "pain"}))
    corrections = Corrections(library)
    new = corrections.use(session_id, made(corrections, session_id, stored))
    again = session_figures(library.session(new), library.choices(new))
    left_out = [one for one in again.repetitions if not one.counts]
    assert [one.reason for one in left_out] == ["pain"]
    assert left_out[0].start_s == pytest.approx(figures.repetitions[number].start_s, abs=0.3)


@pytest.mark.parametrize(
    ("before", "after", "left_out"),
    [
        ([(0.9, 1.9), (3.07, 6.24)], [(0.87, 4.61), (4.61, 7.94)], {0, 1}),  # found as two where it was one and a piece
        ([(0.0, 8.0)], [(0.0, 3.9), (4.1, 8.0)], {0, 1}),
        ([(0.0, 3.9)], [(0.0, 8.0)], {0}),
        ([(0.0, 4.0)], [(0.1, 4.1), (3.0, 7.0)], {0}),
        ([(0.0, 4.0)], [(4.0, 8.0)], set()),
    ],
)
def test_what_was_left_out_is_found_by_its_moments(
    monkeypatch: pytest.MonkeyPatch, before: list[tuple[float, float]], after: list[tuple[float, float]],
    left_out: set[int],
) -> None:  # fmt: skip
    def found(times_s: list[tuple[float, float]]) -> Repetitions:
        unknown = dict.fromkeys(one.name for one in fields(RepetitionRow))
        return Repetitions("", tuple(RepetitionRow(**{**unknown, "start_s": a, "end_s": b}) for a, b in times_s))  # type: ignore[arg-type]

    monkeypatch.setattr("carpus.core.records.corrections.repetitions_of", found)
    assert set(_found_again(dict.fromkeys(range(len(before)), "pain"), before, after)) == left_out  # type: ignore[arg-type]


def test_who_moved_the_hand_is_still_known_of_the_new_result(library: Library, stored: Stored) -> None:  # noqa: F811
    _, session_id = entered(library, stored)
    corrections = Corrections(library)
    figures = session_figures(library.session(session_id))
    (number, *_) = [number for number, one in enumerate(figures.repetitions) if one.counts]
    library.keep_choices(session_id, RepetitionChoices({number: PASSIVE}))
    new = corrections.use(session_id, made(corrections, session_id, stored))
    again = session_figures(library.session(new), library.choices(new))
    (helped,) = [one for one in again.repetitions if one.helped]
    assert helped.start_s == pytest.approx(figures.repetitions[number].start_s, abs=0.3)
    assert again.passive is not None


def test_a_moment_is_the_spots_where_no_picture_was_kept(library: Library, stored: Stored) -> None:  # noqa: F811
    _, session_id = entered(library, stored)
    picture, spots = Corrections(library).moment(session_id, WRONG_FROM)
    assert picture is None
    assert len(spots) == 7
