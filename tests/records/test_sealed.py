"""What leaves the computer as one sealed file: opened by Carpus and by the standard ``age``."""

from __future__ import annotations

import io
import os
import pty
import shutil
import subprocess
import sys
import tarfile
import time
from datetime import UTC, datetime, timedelta
from pathlib import Path

import pyrage
import pytest

from carpus.app.__main__ import main
from carpus.core.errors import BackupUnreadable, OutputExists, SealRefused, TooLargeToSeal
from carpus.core.records import sealed as module
from carpus.core.records.backup import restore
from carpus.core.records.sealed import is_sealed, open_sealed, seal_backup, seal_files
from tests.records.samples import LINDEN, T0, measure, opened

NOW = datetime(2026, 11, 20, 18, 0, tzinfo=UTC)
WORDS = "four words über all"


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("sealed") / "data"
    with opened(folder) as house:
        linden = house.patients.add(LINDEN)
        measure(house, linden, T0)
        measure(house, linden, T0 + timedelta(days=1))
    return folder


@pytest.fixture
def file(quick_age: None, data: Path, tmp_path: Path) -> Path:
    return sealed(data, tmp_path / "out.tar.age")


def sealed(data: Path, path: Path) -> Path:
    assert seal_backup(data, path, WORDS, software_version="1", now=NOW).sessions == 2
    return path


def by_age(path: Path, passphrase: str, into: Path) -> int:
    """What the standard tool makes of it; it reads a passphrase from a terminal only."""
    age = shutil.which("age")
    assert age is not None, "installer/setup.sh test installs it"
    child, terminal = pty.fork()
    if child == 0:
        os.execv(age, [age, "--decrypt", "--output", str(into), str(path)])
    said = b""
    end_s = time.monotonic() + 120.0
    while b":" not in said and time.monotonic() < end_s:
        said += os.read(terminal, 200)
    os.write(terminal, passphrase.encode() + b"\n")
    try:
        while os.read(terminal, 200):
            pass
    except OSError:
        pass  # it has ended
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])


def test_the_standard_tool_opens_it(data: Path, tmp_path: Path) -> None:
    file = sealed(data, tmp_path / "out.tar.age")
    assert by_age(file, WORDS, tmp_path / "out.tar") == 0
    (tmp_path / "out").mkdir()
    subprocess.run(["tar", "-xf", tmp_path / "out.tar", "-C", tmp_path / "out"], check=True)
    for path in data.rglob("*.h5"):
        assert (tmp_path / "out" / path.relative_to(data)).read_bytes() == path.read_bytes()


def test_it_is_restored_and_holds_nothing_that_can_be_read(file: Path, tmp_path: Path) -> None:
    assert is_sealed(file)
    assert file.stat().st_mode & 0o777 == 0o600
    raw = file.read_bytes()
    for word in (b"Mustermann", b"Linden", b"sessions", b"SQLite"):
        assert word not in raw
    backup, content = open_sealed(file, WORDS)
    restore(backup, content, tmp_path / "new").put_in_place(NOW)
    with opened(tmp_path / "new") as house:
        (patient,) = house.patients.listed()
        assert patient.entry == LINDEN
        assert len(house.index.of_patient(patient.patient_id)) == 2


@pytest.mark.parametrize("damage", ["passphrase", "bit", "cut"])
def test_another_passphrase_and_damage_are_refused(file: Path, tmp_path: Path, damage: str) -> None:
    path = tmp_path / "x.tar.age"
    raw = bytearray(file.read_bytes())
    if damage == "bit":
        raw[len(raw) // 2] ^= 1
    path.write_bytes(raw[: -4000 if damage == "cut" else None])
    with pytest.raises(SealRefused):
        open_sealed(path, WORDS + "x" if damage == "passphrase" else WORDS)


@pytest.mark.usefixtures("quick_age")
def test_what_is_no_back_up_what_is_too_large_and_what_is_there_are_refused(
    data: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "a.txt").write_text("a")
    seal_files([("a.txt", tmp_path / "a.txt")], tmp_path / "export.tar.age", WORDS)
    with pytest.raises(BackupUnreadable):
        open_sealed(tmp_path / "export.tar.age", WORDS)
    with pytest.raises(OutputExists):
        seal_files([("a.txt", tmp_path / "a.txt")], tmp_path / "export.tar.age", WORDS)
    monkeypatch.setattr(module, "MOST_BYTES", 1000)
    with pytest.raises(TooLargeToSeal):
        seal_backup(data, tmp_path / "large.tar.age", WORDS, software_version="1")
    assert not (tmp_path / "large.tar.age").exists()


@pytest.mark.usefixtures("quick_age")
def test_the_commands_ask_for_the_passphrase_and_bring_everything_back(
    data: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    path, new = str(tmp_path / "b.tar.age"), tmp_path / "new"

    def carpus(*words: str, typed: str) -> int:
        monkeypatch.setattr(sys, "stdin", io.StringIO(f"{typed}\n"))
        return main(words)

    assert carpus("backup", path, "--sealed", "--data-folder", str(data), typed="short") == 1
    assert not Path(path).exists()
    assert "10 signs or more" in capsys.readouterr().err
    assert carpus("backup", path, "--sealed", "--data-folder", str(data), typed=WORDS) == 0
    said = capsys.readouterr()
    assert WORDS not in said.out + said.err
    assert carpus("restore", path, "--into", str(new), typed="not this one") == 1
    assert not new.exists()
    assert carpus("restore", path, "--into", str(new), typed=WORDS) == 0
    assert len(list(new.rglob("*.h5"))) == 2
    session, out = next(iter(new.rglob("*.h5"))), tmp_path / "e.tar.age"
    assert carpus("export", str(session), "--sealed", "--output", str(out), typed=WORDS) == 0
    with tarfile.open(fileobj=io.BytesIO(pyrage.passphrase.decrypt(out.read_bytes(), WORDS))) as tar:
        assert any(name.endswith(".wrist.csv") for name in tar.getnames())
