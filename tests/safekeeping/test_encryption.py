"""Encrypted at rest: nothing readable without the PIN, everything as before with it, and nothing lost on the way."""

from __future__ import annotations

import multiprocessing
import os
import random
import shutil
import signal
import sqlite3
from collections.abc import Callable, Iterator
from datetime import UTC, datetime, timedelta
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest

from carpus.core.camera import Camera
from carpus.core.capture.raw import RawRecording, RawWriter
from carpus.core.capture.source import SourceInfo
from carpus.core.encryption import keys
from carpus.core.encryption.cipher import is_encrypted
from carpus.core.encryption.content import (
    BLOCK,
    EncryptedContent,
    decrypt_file,
    encrypt_file,
    open_kept,
    read_kept,
    remove_underway,
)
from carpus.core.errors import (
    ContentDamaged,
    DiskFull,
    FolderLocked,
    KeyRefused,
    RegisterUnreadable,
    SessionUnreadable,
)
from carpus.core.library.library import Library
from carpus.core.output.report_content import RepetitionChoices
from carpus.core.safekeeping import encryption
from carpus.core.safekeeping.audit import AuditLog
from carpus.core.safekeeping.backup import back_up, compare, restore
from carpus.core.safekeeping.encryption import encrypted_share, exchange_lists, sweep, switch_on
from carpus.core.safekeeping.erasure import erase, plan_patient
from carpus.core.session.reader import READING, read_session, verify
from carpus.core.session.register import REGISTER_FILE, PatientEntry, PatientRegister
from carpus.core.types import Frame
from tests.safekeeping.samples import HERON, LINDEN, T0, measure, traces
from tests.session.samples import time_of

PIN = "four words of mine"
KEY = bytes(range(32))
GOLDEN = Path(__file__).parent / "golden"
INFO = SourceInfo("camera", Camera(500, 500, 320, 240), True, None, 30.0, {})


@pytest.fixture(autouse=True)
def nothing_known(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """No key is known from before; and the PIN is made into one quickly, which one test does not want."""
    keys.use_only(None)
    monkeypatch.setattr(keys, "_ARGON2", (1, 8, 1))
    yield
    keys.use_only(None)
    keys.ask_with(lambda _: None)
    READING.end()


def fill(folder: Path) -> None:
    """Two patients with sessions, one with true pictures."""
    with PatientRegister(folder) as register:
        linden, heron = register.add(LINDEN), register.add(HERON)
        measure(register, linden, T0)
        measure(register, linden, T0 + timedelta(days=1))
        session = register.session(measure(register, heron, T0))
    raw = session.path.with_suffix(".carpusraw")
    raw.unlink()
    with RawWriter(raw, INFO) as writer:
        for number in range(3):
            color = np.full((480, 640, 3), 40 * number, np.uint8)
            writer.append_frame(Frame(number, time_of(number), color, None, 1e-3))
    photo = cv2.imencode(".jpg", np.full((20, 20, 3), 90, np.uint8))[1].tobytes()
    session.path.with_suffix(".markers.jpg").write_bytes(photo)


def contents(folder: Path) -> dict[str, bytes]:
    """What is in every file of sessions, whichever form it has."""
    out = {}
    for path in sorted((folder / "sessions").rglob("*")):
        if path.is_file() and not path.name.startswith("."):
            with open_kept(path) as file:
                out[path.relative_to(folder).as_posix()] = file.read()
    return out


@pytest.fixture
def data(tmp_path: Path) -> Path:
    folder = tmp_path / "data"
    fill(folder)
    return folder


def test_nothing_is_readable_without_the_pin_and_all_is_as_before_with_it(data: Path) -> None:
    before = contents(data)
    library = Library(data)
    names = [record.entry.name for record in library.clinic.patients()]
    done = library.encrypt(PIN)
    assert done.told == ()
    assert [record.entry.name for record in library.clinic.patients()] == names  # it goes on without a new start
    library.close()

    here, there = encrypted_share(data)
    assert here == there >= 14
    assert contents(data) == before
    words = ("Mustermann", "flexor tendon", "pictures of", "\x89HDF", "SQLite format", "recording_id")
    assert [name for name in traces(data, *words) if not name.endswith(".jsonl")] == []

    keys.use_only(None)
    READING.end()
    path = next(data.rglob("*.h5"))
    with pytest.raises(FolderLocked):
        read_session(path)
    with pytest.raises(FolderLocked):
        Library(data)
    with pytest.raises(KeyRefused):
        keys.unlock(data, "another one of mine")
    keys.unlock(data, PIN)
    library = Library(data)
    assert library.recover() == ([], [])
    assert [record.entry.name for record in library.clinic.patients()] == names
    for patient in library.clinic.patients():
        for entry in library.sessions(patient.patient_id):
            assert verify(entry.path).frames == 4
            assert library.session(entry.session_id).complete
    heron = next(one for one in library.clinic.patients() if one.entry == HERON)
    entry = library.sessions(heron.patient_id)[0]
    assert RawRecording(entry.path.with_suffix(".carpusraw")).complete
    assert library.picture(entry.session_id, 1) is not None
    assert library.marker_picture(heron.patient_id) is not None

    chosen = RepetitionChoices({1: "pain"}, {}, False, "")
    library.keep_choices(entry.session_id, chosen)
    assert is_encrypted(entry.path.with_suffix(".choices.json"))
    assert library.choices(entry.session_id) == chosen

    assert library.decrypt() == []
    assert not keys.has_key(data)
    assert library.choices(entry.session_id) == chosen
    library.close()
    after = contents(data)
    changed = entry.path.with_suffix(".choices.json").relative_to(data).as_posix()
    assert {name for name in before if before[name] != after[name]} == {changed}
    assert encrypted_share(data) == (0, there)
    keys.use_only(None)
    Library(data).close()


def test_what_is_recorded_since_is_encrypted_by_itself(data: Path) -> None:
    library = Library(data)
    library.encrypt(PIN)
    linden = next(one for one in library.clinic.patients() if one.entry == LINDEN)
    new = library.clinic.session(measure(library.clinic, linden.patient_id, T0 + timedelta(days=3)))
    running = new.path.with_name("Linden-42_x.h5")
    running.with_name("Linden-42_x.h5.0a1b2c3d.part").write_bytes(b"")
    running.with_suffix(".carpusraw").write_bytes(b"still being written")
    library.encrypting.wake()
    library.close()
    assert is_encrypted(new.path)
    assert not is_encrypted(running.with_suffix(".carpusraw"))
    assert read_session(new.path).complete


def test_the_pin_changes_and_the_recovery_code_opens_without_it(data: Path) -> None:
    code = switch_on(data, PIN)
    keys.change_pin(data, "another pin 77")
    keys.use_only(None)
    assert keys.opens(data, "another pin 77")
    assert not keys.opens(data, PIN)
    keys.unlock(data, code.lower().replace("-", " "))
    known = keys.known()[data]
    for name in keys.KEY_FILES:
        (data / name).write_bytes(b"\0" * 100)
    keys.use_only(None)
    keys.unlock(data, code)
    assert keys.known()[data] == known


def test_the_numbers_of_argon2_stay_what_they_are(data: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.undo()
    assert keys._secret_key("a PIN", b"sixteen bytes of").hex().startswith("3f51cdd05c66cea2b35bf801")
    switch_on(data, PIN)
    assert keys.opens(data, PIN)


def test_one_damaged_key_file_costs_nothing_and_is_mended(data: Path) -> None:
    switch_on(data, PIN)
    known = keys.known()[data]
    for name in keys.KEY_FILES:
        whole = (data / name).read_bytes()
        (data / name).write_bytes(whole[:2000] + bytes([whole[2000] ^ 1]) + whole[2001:])
        keys.use_only(None)
        keys.unlock(data, PIN)
        assert keys.known()[data] == known
        assert (data / name).stat().st_mode & 0o077 == 0
    with pytest.raises(ValueError, match="short"):
        keys.make_key(data / "sessions", "123456789")


def test_a_flipped_bit_is_a_damaged_session_and_harms_nothing_else(data: Path) -> None:
    switch_on(data, PIN)
    sweep(data)
    path = max(data.rglob("*.h5"))
    whole = bytearray(path.read_bytes())
    chance = random.Random(3)
    for _ in range(6):
        place = chance.randrange(len(whole))
        path.write_bytes(bytes([*whole[:place], whole[place] ^ 4, *whole[place + 1 :]]))
        with pytest.raises((SessionUnreadable, FolderLocked)):
            read_session(path)
    path.write_bytes(bytes(whole[:70000]))
    with pytest.raises(SessionUnreadable):
        read_session(path)
    path.write_bytes(bytes(whole))
    assert read_session(path).complete


@pytest.mark.parametrize("size", [0, 1, BLOCK - 1, BLOCK, 2 * BLOCK + 17])
def test_any_place_of_an_encrypted_file_is_read_as_it_was(tmp_path: Path, size: int) -> None:
    content = random.Random(size).randbytes(size)
    path = tmp_path / "x.h5"
    path.write_bytes(content)
    os.utime(path, ns=(10**18, 10**18))
    assert encrypt_file(path, KEY)
    assert path.stat().st_mtime_ns == 10**18
    assert path.stat().st_mode & 0o077 == 0
    with EncryptedContent(path, KEY) as file:
        for place in (0, size // 2, max(0, size - 1), size + 5, BLOCK - 1):
            file.seek(place)
            assert file.read(BLOCK + 3) == content[place : place + BLOCK + 3]
    with pytest.raises(ContentDamaged):
        EncryptedContent(path, KEY[::-1])
    assert decrypt_file(path, KEY)
    assert path.read_bytes() == content
    assert [one.name for one in tmp_path.iterdir()] == ["x.h5"]


def test_a_file_that_changes_meanwhile_keeps_its_change(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "x.choices.json"
    path.write_text("old")
    from carpus.core.encryption import content

    real = content._write_encrypted

    def and_then_it_changes(source: Path, fresh: Path, key: bytes) -> None:
        real(source, fresh, key)
        path.write_text("newer")

    monkeypatch.setattr(content, "_write_encrypted", and_then_it_changes)
    assert not encrypt_file(path, KEY)
    assert path.read_text() == "newer"
    monkeypatch.setattr(
        content, "_write_encrypted", lambda source, fresh, key: (real(source, fresh, key), path.unlink())
    )
    assert not encrypt_file(path, KEY)
    assert list(tmp_path.iterdir()) == []


def test_a_full_disk_leaves_the_plain_file(data: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    switch_on(data, PIN)
    before = contents(data)
    monkeypatch.setattr(os, "fsync", _full)
    swept = sweep(data)
    assert swept.done == 0
    assert {type(fault) for fault in swept.left} == {DiskFull}
    monkeypatch.undo()
    assert contents(data) == before
    assert not any(is_encrypted(path) for path in (data / "sessions").rglob("*"))


def _full(_: int) -> None:
    raise OSError(28, "No space left on device")


def _have_open(folder: str, link: Connection) -> None:
    with PatientRegister(Path(folder)) as register:
        link.send("open")
        link.recv()
        register.add(PatientEntry("Robin 3", "left"))
    link.send("written")


def test_a_list_that_another_program_has_open_is_left_alone(data: Path) -> None:
    context = multiprocessing.get_context("fork")
    ours, theirs = context.Pipe()
    other = context.Process(target=_have_open, args=(str(data), theirs))
    other.start()
    assert ours.recv() == "open"
    switch_on(data, PIN)
    (fault,) = exchange_lists(data)
    assert isinstance(fault, RegisterUnreadable)
    ours.send("write")
    assert ours.recv() == "written"
    other.join()
    assert not is_encrypted(data / REGISTER_FILE)
    assert exchange_lists(data) == []
    with PatientRegister(data) as register:
        assert len(register.patients()) == 3
        copy = sqlite3.connect(data / REGISTER_FILE)
        with pytest.raises(sqlite3.DatabaseError):
            copy.execute("SELECT * FROM patient")
        copy.close()


def test_a_back_up_is_encrypted_too_and_comes_back_with_the_pin(data: Path, tmp_path: Path) -> None:
    library = Library(data)
    library.encrypt(PIN)
    made = back_up(data, tmp_path / "disk", software_version="1", now=datetime(2026, 11, 20, tzinfo=UTC))
    compare(tmp_path / "disk", made)
    library.close()
    assert traces(tmp_path / "disk", "Mustermann", "flexor tendon", "SQLite format", "pictures of") == []
    restore(tmp_path / "disk", made, tmp_path / "new")
    keys.use_only(None)
    READING.end()
    keys.unlock(tmp_path / "new", PIN)
    with PatientRegister(tmp_path / "new") as register:
        patients = register.patients()
        assert {one.entry.name for one in patients} == {LINDEN.name, HERON.name}
        assert all(verify(entry.path) for one in patients for entry in register.sessions(one.patient_id))


def test_an_erased_patient_is_gone_from_the_encrypted_lists_too(data: Path) -> None:
    with sqlite3.connect(data / REGISTER_FILE) as old:
        old.execute("VACUUM INTO ?", (str(data / "patients.version4.sqlite3"),))
    old.close()
    library = Library(data)
    library.encrypt(PIN)
    assert is_encrypted(data / "patients.version4.sqlite3")
    linden = next(one for one in library.clinic.patients() if one.entry == LINDEN)
    erase(library.clinic, plan_patient(library.clinic, linden.patient_id), AuditLog(data, "window"))
    library.decrypt()
    library.close()
    assert traces(data, "Mustermann", "Linden") == []


def _switch(folder: str, on: bool, steps: int) -> None:
    """A process that ends itself hard before or after one of the steps that reach the disk."""
    left = [steps]

    def counted(step: Callable[..., Any]) -> Callable[..., Any]:
        def stepped(*arguments: Any, **named: Any) -> Any:
            left[0] -= 1
            if left[0] == 0:
                os.kill(os.getpid(), signal.SIGKILL)
            out = step(*arguments, **named)
            left[0] -= 1
            if left[0] == 0:
                os.kill(os.getpid(), signal.SIGKILL)
            return out

        return stepped

    os.fsync, Path.replace, Path.unlink = counted(os.fsync), counted(Path.replace), counted(Path.unlink)  # type: ignore[method-assign]
    data = Path(folder)
    if not on:
        keys.unlock(data, PIN)
    library = Library(data)
    if on:
        library.encrypt(PIN)
    else:
        library.decrypt()
    library.close()


KILLS = int(os.environ.get("CARPUS_ENCRYPTION_KILLS", "3"))


@pytest.mark.parametrize("on", [True, False])
def test_a_kill_while_it_is_switched_loses_nothing(data: Path, tmp_path: Path, on: bool) -> None:
    if not on:
        library = Library(data)
        library.encrypt(PIN)
        library.close()
    before = contents(data)
    chance = random.Random(5)
    killed, most = 0, 150  # of the steps of one switching; made fewer by one that ended before it was killed
    for number in range(KILLS):
        copy = tmp_path / str(number)
        shutil.copytree(data, copy)
        keys.use_only(None)
        steps = chance.randrange(1, most)
        process = multiprocessing.get_context("fork").Process(target=_switch, args=(str(copy), on, steps))
        process.start()
        process.join()
        if process.exitcode == 0:
            most = steps
        else:
            assert process.exitcode == -signal.SIGKILL
            killed += 1
        if keys.has_key(copy):
            keys.unlock(copy, PIN)
        assert contents(copy) == before
        library = Library(copy)
        assert library.recover()[1] == []
        assert {one.entry.name for one in library.clinic.patients()} == {LINDEN.name, HERON.name}
        wanted = keys.is_on(copy)
        library.close()  # it goes on from where it was
        here, there = encrypted_share(copy)
        assert here == (there if wanted else 0)
        assert not any(path.name.startswith(".") for path in copy.rglob("*") if path.is_file())
    assert killed > 0
    print(f"switched {'on' if on else 'off'}: {killed} killed of {KILLS}, among {most} steps")


def test_what_is_said_is_what_is_encrypted() -> None:
    assert encryption.ENDINGS == (".h5", ".carpusraw", ".markers.jpg", ".choices.json", ".comments.json")


def test_a_file_that_cannot_be_decrypted_keeps_the_key_until_it_is_gone(data: Path) -> None:
    library = Library(data)
    library.encrypt(PIN)
    path = max(data.rglob("*.markers.jpg"))
    whole = path.read_bytes()
    place = 65536 + 40000  # in the page of the content
    path.write_bytes(whole[:place] + bytes([whole[place] ^ 1]) + whole[place + 1 :])
    (fault,) = library.decrypt()
    library.close()
    assert isinstance(fault, ContentDamaged)
    assert encrypted_share(data)[0] == 1
    assert keys.has_key(data), "what is damaged may come back from a back-up"
    assert not keys.is_on(data)
    path.write_bytes(whole)
    library = Library(data)
    library.recover()
    library.close()
    assert not keys.has_key(data)
    assert path.read_bytes() == b"photo"


def test_what_this_version_encrypted_can_always_be_read(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.undo()
    for name in GOLDEN.iterdir():
        shutil.copy(name, tmp_path / name.name)
    keys.unlock(tmp_path, PIN)
    assert read_kept(tmp_path / "x.choices.json") == b"what was left out"


def test_two_programs_at_the_same_file_lose_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from carpus.core.encryption import content

    path = tmp_path / "x.h5"
    whole = random.Random(1).randbytes(100_000)
    path.write_bytes(whole)
    real = content._write_encrypted
    depth = []

    def and_another_comes(source: Path, fresh: Path, key: bytes) -> None:
        real(source, fresh, key)
        if not depth:
            depth.append(1)
            assert encrypt_file(path, KEY)
            remove_underway(tmp_path)  # as at the start of a third

    monkeypatch.setattr(content, "_write_encrypted", and_another_comes)
    assert not encrypt_file(path, KEY)
    assert decrypt_file(path, KEY)
    assert path.read_bytes() == whole


def test_a_renamed_file_keeps_the_key(data: Path) -> None:
    library = Library(data)
    library.encrypt(PIN)
    path = max(data.rglob("*.h5"))
    mine = path.rename(path.with_name("mine.backup"))
    library.decrypt()
    library.close()
    assert keys.has_key(data), "somebody may want to read it"
    mine.unlink()
    Library(data).close()
    library = Library(data)
    library.recover()
    library.close()
    assert not keys.has_key(data)
