"""A corrected session in the data folder: tried apart, taken into the list when wanted, the old one kept."""

from __future__ import annotations

import errno
import math
import os
import shutil
import threading
from collections.abc import Callable, Iterator
from contextlib import closing
from dataclasses import dataclass, fields, replace
from datetime import datetime, timedelta
from pathlib import Path
from uuid import uuid4

import numpy as np
import pytest
from PySide6.QtCore import Qt
from pytestqt.qtbot import QtBot
from sqlalchemy import delete

from carpus.core.model.errors import (
    ConcurrentChange,
    DiskFull,
    FolderMissing,
    OutputNotWritable,
    PatientListBusy,
    SessionUnreadable,
)
from carpus.core.pipeline.correction import CorrectionTask, correct, load_task
from carpus.core.platform.durable import publish
from carpus.core.records.backup import collect_sources
from carpus.core.records.corrections import Corrections, PendingResult, compare_results, match_exclusions
from carpus.core.records.data_folder import DataFolder
from carpus.core.records.new_sessions import recover_sessions
from carpus.core.records.retention import RecordRetention
from carpus.core.records.schema import SESSION
from carpus.core.records.session_setup import MARKERS_SUFFIX
from carpus.core.records.store import Store
from carpus.core.records.values import Patient
from carpus.core.results.repetition_rows import RepetitionChoices
from carpus.core.session.reader import read_session
from carpus.core.session.rewriting import rewrite_session
from carpus.core.session.values import RepetitionRow
from carpus.ui.kit.background import Background
from carpus.ui.kit.theme import Theme
from carpus.ui.screens.correct.flow import CorrectionFlow
from carpus.ui.screens.review.flow import ReviewFlow
from carpus.ui.screens.sessions.session_list import SessionStore
from carpus.ui.shell.current_selection import CurrentSelection
from carpus.ui.shell.flow import ScreenContext
from carpus.ui.shell.main_window import MainWindow
from tests.pipeline.test_correction import Stored, make_correction, wrongly_tracked
from tests.ui.contexts import RecordingMessages, make_context


@pytest.fixture(scope="module")
def stored(tmp_path_factory: pytest.TempPathFactory) -> Stored:
    return wrongly_tracked(tmp_path_factory.mktemp("correction"))


@pytest.fixture(scope="module")
def corrected(stored: Stored) -> Path:
    """The new result of it."""
    path = stored.path.with_name("corrected.h5")
    correct(load_task(stored.path, path, (make_correction(stored),)))
    return path


@dataclass(frozen=True)
class Kept:
    """A patient's session in a data folder."""

    library: DataFolder
    patient: str
    session_id: str
    corrected: Path

    @property
    def corrections(self) -> Corrections:
        return Corrections(self.library)

    @property
    def path(self) -> Path:
        return self.library.entry(self.session_id).path

    @property
    def counting(self) -> list[str]:
        return [entry.session_id for entry in self.library.sessions(self.patient)]

    @property
    def listed(self) -> list[str]:
        return [entry.session_id for entry in self.library.session_list.patient_sessions(self.patient)]

    def trial(self, **said: str) -> Path:
        """It was tracked again: one more result that nobody has decided about."""
        trial = self.corrections.new_pending_path(self.session_id)
        rewrite_session(self.corrected, trial, {"session_id": str(uuid4()), **said})
        return trial


def enter_session(library: DataFolder, stored: Stored, corrected: Path) -> Kept:
    patient = library.patients.add(Patient("Linden 42", "right"))
    when = datetime(2026, 11, 20, 11, 36).astimezone()
    path = library.session_list.new_path(patient, "Linden 42", "WRIST_FE", "right", when)
    shutil.copyfile(stored.path, path)
    return Kept(library, patient, library.session_list.add(path, patient).session_id, corrected)


@pytest.fixture
def kept(tmp_path: Path, stored: Stored, corrected: Path) -> Iterator[Kept]:
    with closing(DataFolder(tmp_path / "data")) as library:
        yield enter_session(library, stored, corrected)


Correcting = Callable[[RecordingMessages], tuple[CorrectionFlow, ScreenContext]]


@pytest.fixture
def correcting(qtbot: QtBot, kept: Kept) -> Iterator[Correcting]:
    """Puts the flow together with a window around it, and closes it."""
    made: list[CorrectionFlow] = []

    def put_together(messages: RecordingMessages) -> tuple[CorrectionFlow, ScreenContext]:
        theme = Theme("light")
        shell = MainWindow(theme)
        qtbot.addWidget(shell)
        shell.resize(1280, 744)
        shell.show()
        now = CurrentSelection(session_id=kept.session_id)
        context = make_context(theme, shell, messages, Background(), library=kept.library, current=now)
        made.append(CorrectionFlow(context))
        return made[-1], context

    yield put_together
    for flow in made:
        flow.close()


class Killed(BaseException):
    """Stands for a SIGKILL: nothing that comes behind it is done."""


def raise_killed(*_: object) -> None:
    raise Killed


def kill_once_listed(kept: Kept, monkeypatch: pytest.MonkeyPatch, trial: Path) -> None:
    """The program is killed while it takes a result: it is listed, and its file has not got its name yet."""
    with monkeypatch.context() as patched:
        patched.setattr("carpus.core.records.corrections.publish", raise_killed)
        with pytest.raises(Killed):
            kept.corrections.accept(kept.session_id, trial)


def on_another_disk(monkeypatch: pytest.MonkeyPatch) -> None:
    replace_real = Path.replace

    def refused(*_: object) -> None:
        raise OSError(errno.EXDEV, "Invalid cross-device link")

    def replaced(path: Path, target: Path) -> Path:
        if path.parent != target.parent:
            refused()
        return replace_real(path, target)

    monkeypatch.setattr("carpus.core.platform.durable.os.link", refused)
    monkeypatch.setattr(Path, "replace", replaced)


def test_pending_result_is_unlisted_until_accepted(kept: Kept) -> None:
    corrections, trial = kept.corrections, kept.trial()
    recover_sessions(kept.library)
    assert kept.listed == [kept.session_id]
    old, new = corrections.read_both(kept.session_id, trial)
    found = compare_results(old, new)
    assert found.compared_frames > 100
    assert math.degrees(found.max_difference_rad) < 10.0
    assert found.is_live, "the old result was not looked back at"
    assert compare_results(new, new).is_live is False
    behind = replace(new, motion=replace(new.motion, angles_rad=new.motion.angles_rad + 1.0))
    assert compare_results(old, behind).changed_frames == len(old), (
        "what the camera showed at the time, not what looking back made"
    )
    trial.with_suffix(".12345678.part").write_bytes(b"x")  # the program was killed in the midst of another one
    later = kept.corrections
    later.delete_unfinished()
    assert later.list_pending() == [PendingResult(kept.session_id, trial)]
    assert list(trial.parent.iterdir()) == [trial]
    corrections.discard(trial)
    assert later.list_pending() == []


@pytest.mark.parametrize(("kind", "is_damaged"), [("session", True), ("patient", False)])
def test_pending_results_are_deleted_with_their_session(kept: Kept, kind: str, is_damaged: bool) -> None:
    other = kept.path
    trials = [kept.trial() for _ in range(2)]
    trials.append(trials[0].with_name(f"{trials[0].name}.12345678.part"))
    trials[2].write_bytes(b"x")
    if is_damaged:
        for trial in trials[:2]:
            trial.write_bytes(b"no session")
    nobodys = trials[0].with_name(f"{other.stem}0.h5")
    nobodys.write_bytes(b"no session")
    copy = other.with_name(f".{other.stem}.12345678.h5.new")  # the program was killed while it took one
    copy.write_bytes(b"x")
    records = RecordRetention(kept.library)
    plan = records.plan_session(kept.session_id) if kind == "session" else records.plan_patient(kept.patient)
    assert {*trials, copy} <= {*plan.files}
    assert set(plan.unassigned_files) == ({nobodys} if kind == "patient" else set()), "nobody can tell whose it is"
    records.erase(plan)
    assert [trial for trial in trials if trial.exists()] == []
    assert not copy.exists()
    assert nobodys.exists()


def test_pending_result_is_decided_by_its_buttons_only(
    qtbot: QtBot, kept: Kept, stored: Stored, correcting: Correcting, monkeypatch: pytest.MonkeyPatch
) -> None:
    def beside(task: CorrectionTask, progress: Callable[[int, int], None], stopping: threading.Event) -> bool:
        progress(30, 120)
        if again and stopping.wait(30.0):
            return False
        again.append("next time it is stopped")
        correct(task)
        return True

    again: list[str] = []
    monkeypatch.setattr("carpus.ui.screens.correct.flow.correct_in_process", beside)
    messages = RecordingMessages("settings", behind="correct")  # what comes of it comes behind them
    flow, context = correcting(messages)
    sheet, said = flow.dialog, list[tuple[int, int]]()
    flow.progress_changed.connect(lambda percent, count: said.append((percent, count)))
    flow.start(kept.session_id, (make_correction(stored),))
    qtbot.waitUntil(lambda: said[-1:] == [(-1, 1)])
    assert (25, 0) in said
    assert not sheet.isVisible()
    for key in (Qt.Key.Key_Return, Qt.Key.Key_Space, Qt.Key.Key_Escape):
        flow.open_dialog()
        qtbot.waitUntil(lambda: sheet.use_button.isVisible())
        qtbot.keyClick(context.window.screen_stack.focusWidget(), key)
        assert not sheet.isVisible()
    assert [one.session_id for one in flow.pending] == kept.counting == [kept.session_id]
    flow.open_dialog()
    qtbot.waitUntil(lambda: sheet.use_button.isVisible())
    assert "Not held" not in sheet.words.text()
    sheet.use_button.click()
    qtbot.waitUntil(lambda: bool(messages.shown))
    (new,) = kept.counting
    assert messages.shown == [("review", new)]
    assert said[-1] == (-1, 0)
    line = SessionStore(kept.library).with_figures(SessionStore(kept.library).list_sessions(kept.patient)[0])
    assert line.correction.startswith("Corrected on ")
    assert line.correction.endswith(", from 00:02.0, by MK.")
    assert not messages.faults
    flow.start(new, (make_correction(stored),))
    flow.open_dialog()
    assert sheet.stop_button.isVisible()
    sheet.stop_button.click()
    qtbot.waitUntil(lambda: flow.running_session_id == "")
    assert not sheet.isVisible()
    assert flow.pending == []


def test_accepted_result_counts_and_the_old_one_stays(kept: Kept) -> None:
    library, session_id, old = kept.library, kept.session_id, kept.path
    old.with_suffix(MARKERS_SUFFIX).write_bytes(b"picture")
    library.save_choices(
        session_id, RepetitionChoices({0: "pain"}, is_session_excluded=True, session_exclusion_reason="markers lost")
    )
    library.session_list.set_exercise(session_id, "WRIST_RUD")
    new = kept.corrections.accept(session_id, kept.trial())
    assert kept.counting == [new]
    for one in (new, session_id):
        assert [entry.session_id for entry in library.result_versions(one)] == [session_id, new]
    assert old.exists()
    assert library.entry(new).exercise == "WRIST_RUD"
    assert library.entry(new).path.with_suffix(MARKERS_SUFFIX).read_bytes() == b"picture"
    assert library.choices(new) == RepetitionChoices(is_session_excluded=True, session_exclusion_reason="markers lost")


@pytest.mark.parametrize(
    ("step", "is_listed"), [("core.records.store.Store.apply", False), ("core.records.corrections.publish", True)]
)
def test_killed_accept_leaves_the_old_or_the_new_result(
    kept: Kept, monkeypatch: pytest.MonkeyPatch, step: str, is_listed: bool
) -> None:
    library, session_id = kept.library, kept.session_id
    choices = RepetitionChoices(is_session_excluded=True, session_exclusion_reason="pain")
    library.save_choices(session_id, choices)
    trial = kept.trial()
    with monkeypatch.context() as patched:
        patched.setattr(f"carpus.{step}", raise_killed)
        with pytest.raises(Killed):
            kept.corrections.accept(session_id, trial)
    recover_sessions(library)
    listed, later = kept.listed, kept.corrections
    if not is_listed:
        assert listed == [session_id]
        assert later.list_pending() == [PendingResult(session_id, trial)]
        later.accept(session_id, trial)
    assert later.list_pending() == []
    assert not trial.exists()
    (new,) = kept.counting
    assert new != session_id
    assert len(library.session(new)) == len(library.session(session_id))
    assert library.choices(new) == choices
    assert len(list(library.folder.rglob("*.h5"))) == 2


def test_restored_version_counts_with_its_choices(kept: Kept) -> None:
    library, old, corrections = kept.library, kept.session_id, kept.corrections
    new = corrections.accept(old, kept.trial())
    said = RepetitionChoices({0: "pain"}, {1: (1.0, 2.0)})
    library.save_choices(old, said)
    again = corrections.restore_version(old)
    assert kept.counting == [again]
    assert [entry.session_id for entry in library.result_versions(old)][-1] == again
    assert library.choices(again) == said
    assert np.array_equal(library.session(again).motion.angles_rad, library.session(old).motion.angles_rad)
    assert not np.array_equal(library.session(again).motion.angles_rad, library.session(new).motion.angles_rad)
    last = corrections.restore_version(new)
    assert kept.counting == [last]


def test_accepted_result_is_moved_to_another_disk(kept: Kept, monkeypatch: pytest.MonkeyPatch) -> None:
    library, trial = kept.library, kept.trial()
    on_another_disk(monkeypatch)
    new = kept.corrections.accept(kept.session_id, trial)
    place = library.entry(new).path
    assert read_session(place).header.session_id == new
    assert not trial.exists()
    assert {*place.parent.iterdir()} == {entry.path for entry in library.result_versions(new)}
    shutil.copyfile(place, trial)  # a program was killed before it could delete what it had copied
    assert kept.corrections.list_pending() == []
    assert not trial.exists()
    assert library.entry(new).path == place


@pytest.mark.parametrize("number", [errno.ENOSPC, errno.EACCES])
def test_failed_accept_leaves_the_result_pending(kept: Kept, monkeypatch: pytest.MonkeyPatch, number: int) -> None:
    library, session_id, corrections = kept.library, kept.session_id, kept.corrections
    library.save_choices(session_id, RepetitionChoices({0: "pain"}))
    kept.path.with_suffix(MARKERS_SUFFIX).write_bytes(b"picture")
    before = sorted(kept.path.parent.iterdir())
    trial = kept.trial()

    def copied(one: Path, other: Path) -> None:
        if one == trial:
            raise OSError(number, os.strerror(number))
        other.write_bytes(one.read_bytes())

    with monkeypatch.context() as patched:
        on_another_disk(patched)
        patched.setattr(shutil, "copyfile", copied)
        with pytest.raises(DiskFull if number == errno.ENOSPC else OutputNotWritable):
            corrections.accept(session_id, trial)
    assert kept.listed == [session_id]
    assert len(library.history(kept.patient)) == 1
    assert sorted(kept.path.parent.iterdir()) == before
    assert corrections.list_pending() == [PendingResult(session_id, trial)]
    new = corrections.accept(session_id, trial)
    assert library.choices(new).excluded
    assert len(library.session(new)) == len(library.session(session_id))


def test_listed_result_is_never_discarded(kept: Kept, monkeypatch: pytest.MonkeyPatch) -> None:
    corrections, trial, other = kept.corrections, kept.trial(), kept.trial()

    def full(*_: object) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    def slow(path: Path) -> None:
        raise SessionUnreadable(path, "damaged: Carpus could not finish reading it")

    kill_once_listed(kept, monkeypatch, trial)
    with pytest.raises(ConcurrentChange):
        corrections.discard(trial)
    with monkeypatch.context() as patched:
        patched.setattr("carpus.core.records.corrections.read_outline", slow)
        assert corrections.list_pending() == []
    assert trial.exists()
    assert other.exists()
    with monkeypatch.context() as patched:
        patched.setattr(os, "link", full)
        patched.setattr(os, "rename", full)
        assert corrections.list_pending() == [PendingResult(kept.session_id, other)]
    assert trial.exists()
    assert corrections.list_pending() == [PendingResult(kept.session_id, other)]
    assert not trial.exists()


def test_result_decided_during_search_is_not_pending(qtbot: QtBot, kept: Kept, correcting: Correcting) -> None:
    trials, messages = [kept.trial() for _ in range(2)], RecordingMessages("settings", behind="review")
    flow, context = correcting(messages)
    for trial, decided in zip(trials, (flow.dialog.keep_button, flow.dialog.use_button), strict=True):
        flow.pending = [PendingResult(kept.session_id, trial)]
        flow.open_dialog()
        flow.refresh_pending()
        decided.click()
        qtbot.waitUntil(lambda trial=trial: not trial.exists() and not flow._background.is_busy)  # type: ignore[misc]
        assert trial not in [one.path for one in flow.pending]
    assert flow.pending == []
    ((_, new),) = messages.shown
    context.current.session_id = str(new)
    ReviewFlow(context)._restore_version(str(new))
    qtbot.waitUntil(lambda: len(messages.shown) == 2)
    assert [one.session_id for one in kept.library.result_versions(str(new))][1:] == [new, messages.shown[1][1]]
    assert messages.asked == ["This result is used from now on."]


def test_restored_version_is_newest_by_any_clock(kept: Kept, monkeypatch: pytest.MonkeyPatch) -> None:
    library, session_id, corrections = kept.library, kept.session_id, kept.corrections
    ahead = kept.trial(created=(datetime.now().astimezone() + timedelta(hours=3)).isoformat())
    fast = corrections.accept(session_id, ahead)
    again = corrections.restore_version(session_id)
    assert kept.counting == [again]
    assert [one.session_id for one in library.history(kept.patient)] == [again]
    assert library.session(again).header.origin == library.session(session_id).header.origin == ""
    assert library.session(corrections.restore_version(fast)).header.origin == session_id
    before = [entry.session_id for entry in library.result_versions(session_id)]

    def busy(*_: object) -> None:
        raise PatientListBusy

    monkeypatch.setattr(Store, "apply", busy)
    with pytest.raises(PatientListBusy):
        corrections.restore_version(session_id)
    assert list(ahead.parent.iterdir()) == []
    assert [entry.session_id for entry in library.result_versions(session_id)] == before


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
def test_match_exclusions_finds_repetitions_of_the_same_moments(
    before: list[tuple[float, float]], after: list[tuple[float, float]], left_out: set[int]
) -> None:
    def rows(times_s: list[tuple[float, float]]) -> list[RepetitionRow]:
        unknown = dict.fromkeys(one.name for one in fields(RepetitionRow))
        return [RepetitionRow(**{**unknown, "start_s": a, "end_s": b}) for a, b in times_s]  # type: ignore[arg-type]

    assert set(match_exclusions(dict.fromkeys(range(len(before)), "pain"), rows(before), rows(after))) == left_out


def test_accepted_result_never_replaces_another_file(kept: Kept, monkeypatch: pytest.MonkeyPatch) -> None:
    library, trial = kept.library, kept.trial()
    real, taken = library.session_list.add, list[Path]()

    def enter(path: Path, *messages: object) -> object:
        path.write_bytes(b"another one's")
        taken.append(path)
        return real(path, *messages)  # type: ignore[arg-type]

    with monkeypatch.context() as patched:
        patched.setattr(library.session_list, "add", enter)
        new = kept.corrections.accept(kept.session_id, trial)
    assert taken[0].read_bytes() == b"another one's"
    assert library.entry(new).path != taken[0]
    assert len(library.session(new)) == len(library.session(kept.session_id))
    assert not trial.exists()
    assert len(list(taken[0].parent.iterdir())) == 3


def test_result_accepted_during_a_search_is_stored_once(kept: Kept, monkeypatch: pytest.MonkeyPatch) -> None:
    """A look for what waits meets one that is just being taken."""
    library, trial = kept.library, kept.trial()

    def with_a_look(part: Path, target: Path) -> None:
        monkeypatch.undo()
        kept.corrections.list_pending()
        publish(part, target)

    monkeypatch.setattr("carpus.core.records.corrections.publish", with_a_look)
    new = kept.corrections.accept(kept.session_id, trial)
    assert set(kept.path.parent.iterdir()) == {kept.path, library.entry(new).path}
    assert len(library.session(new)) == len(library.session(kept.session_id))
    assert not trial.exists()


def test_copy_of_killed_accept_is_removed_and_not_backed_up(kept: Kept, monkeypatch: pytest.MonkeyPatch) -> None:
    corrections, folder, trial = kept.corrections, kept.path.parent, kept.trial()
    copies: dict[Path, bytes] = {}

    def killed_after_copying(*_: object) -> None:
        copies.update({path: path.read_bytes() for path in folder.glob(".*")})
        raise Killed

    with monkeypatch.context() as patched:
        on_another_disk(patched)
        patched.setattr(os, "fsync", killed_after_copying)
        with pytest.raises(Killed):
            corrections.accept(kept.session_id, trial)
    ((copy, content),) = copies.items()
    copy.write_bytes(content)
    data = kept.library.folder
    names = {path for _, path, _ in collect_sources(data, data.with_name("place"), None).files}
    assert kept.path in names
    assert copy not in names
    assert corrections.list_pending() == [PendingResult(kept.session_id, trial)]
    assert not copy.exists()
    copy.write_bytes(content)
    corrections.accept(kept.session_id, trial)
    assert list(folder.glob(".*")) == []


def test_accept_with_share_away_changes_nothing(tmp_path: Path, stored: Stored, corrected: Path) -> None:
    share = tmp_path / "share"
    share.mkdir()
    with closing(DataFolder(tmp_path / "data", sessions_folder=share)) as library:
        kept = enter_session(library, stored, corrected)
        trial = kept.trial()
        share.rename(tmp_path / "away")
        with pytest.raises(FolderMissing):
            kept.corrections.accept(kept.session_id, trial)
        assert kept.corrections.list_pending() == [PendingResult(kept.session_id, trial)]
        assert kept.listed == [kept.session_id]
        library.store.execute_local(delete(SESSION))  # a list that does not know what lies on the share
        assert kept.corrections.list_pending() == []
        assert trial.exists()
