"""Files that lie: what a session file claims or points at never reaches this program's memory, time or other files."""

from __future__ import annotations

import os
import subprocess
import sys
import time
import uuid
from collections.abc import Callable
from pathlib import Path

import h5py
import numpy as np
import pytest

from carpus.core.model.errors import SessionUnreadable
from carpus.core.session import reader
from carpus.core.session.reader import ReadingProcess, read_outline, read_session
from carpus.core.session.values import EncodedImages, Session
from tests.session.samples import add_pictures, begin_session, make_frame, make_header, write_once

ROWS = 40


@write_once
def store_session(path: Path, *, raw: bool = False) -> Path:
    """A sound session."""
    with begin_session(path, make_header(session_id=uuid.uuid4()), ROWS) as writer:
        writer.add_event(make_frame(1).timestamp_s, "note", "x")
    if raw:
        add_pictures(path, [EncodedImages(b"c" * 50, b"d" * 30)] * ROWS)
    return path


ANGLES = "/wrist/angles"


def replace_object(path: Path, make: Callable[[h5py.File, Path], object]) -> Path:
    """Something else in the place of the angles, with their attributes where it can have any."""
    with h5py.File(path, "r+") as file:
        attributes = dict(file[ANGLES].attrs)
        del file[ANGLES]
        make(file, path.parent)
        if isinstance(file.get(ANGLES, getlink=True), h5py.HardLink):
            file[ANGLES].attrs.update(attributes)
    return path


def outside(file: h5py.File, folder: Path, name: str) -> None:
    """The values lie in another file, or in a pipe, which is never waited for."""
    if name == "pipe":
        os.mkfifo(folder / name)
    else:
        (folder / name).write_bytes(b"private!" * 3 * ROWS)
    file.create_dataset(ANGLES, (ROWS, 3), "f8", external=[(str(folder / name), 0, 24 * ROWS)])


def virtual(file: h5py.File, folder: Path) -> None:
    layout = h5py.VirtualLayout((ROWS, 3), "f8")
    layout[:] = h5py.VirtualSource(str(store_session(folder / "other.h5")), ANGLES, (ROWS, 3))
    file.create_virtual_dataset(ANGLES, layout)


def of(make: Callable[[h5py.File, Path], object]) -> Callable[[h5py.File, Path], None]:
    return lambda file, folder: file.__setitem__(ANGLES, make(file, folder))


PAIRS = np.zeros((ROWS, 3), [("a", "f4"), ("b", "f4")])
ELSE: dict[str, Callable[[h5py.File, Path], object]] = {
    "a link into another file": of(
        lambda _, folder: h5py.ExternalLink(str(store_session(folder / "other.h5")), ANGLES)
    ),
    "a soft link": of(lambda *_: h5py.SoftLink("/wrist/position")),
    "the bytes of another file": lambda file, folder: outside(file, folder, "secret"),
    "a pipe": lambda file, folder: outside(file, folder, "pipe"),
    "a virtual dataset": virtual,
    "one dataset under two names": of(lambda file, _: file["/wrist/position"]),
    "one packed by what no session is packed by": lambda file, _: file.create_dataset(
        ANGLES, data=np.zeros((ROWS, 3)), compression="lzf"
    ),
    "one that claims more than gzip can pack": lambda file, _: file.create_dataset(
        ANGLES, (1 << 30, 3), "f8", chunks=(1024, 3), compression="gzip"
    ),
    "a group": lambda file, _: file.create_group(ANGLES),
    "one number": of(lambda *_: 1.0),
    "texts": of(lambda *_: ["x"] * ROWS),
    "nothing": of(lambda *_: h5py.Empty("f8")),
    "pairs": of(lambda *_: PAIRS),
}


@pytest.mark.parametrize("other", ELSE)
def test_hostile_file_wrong_object_raises(tmp_path: Path, other: str) -> None:
    path = replace_object(store_session(tmp_path / "s.h5"), ELSE[other])
    for read in (read_outline, read_session):
        with pytest.raises(SessionUnreadable, match="damaged: /wrist/"):
            read(path)
    os.mkfifo(tmp_path / "no session")
    with pytest.raises(SessionUnreadable, match="not a file"):
        read_session(tmp_path / "no session")


def sleepless(path: Path) -> None:
    while True:
        pass


def greedy(path: Path) -> int:
    return len(bytearray(3_000_000_000))


def dying(path: Path) -> None:
    os.kill(os.getpid(), 11)


@pytest.fixture
def another(monkeypatch: pytest.MonkeyPatch) -> ReadingProcess:
    """A reading process of this test's own."""
    monkeypatch.setattr(reader, "_can_fork", lambda: True)  # quicker
    return ReadingProcess()


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("sleepless", "the end cannot be read|could not finish"),
        ("dying", "the end cannot be read"),
        ("greedy", "more memory"),
    ],
)
def test_hostile_file_affects_reading_process_only(
    tmp_path: Path, another: ReadingProcess, name: str, said: str
) -> None:
    """A reader that loops for ever, dies, or asks for 3 GB: told as damaged, and the next file is read. On a busy
    computer the loop's time on the clock is over before its processor's."""
    path = store_session(tmp_path / "s.h5")
    start_s = time.monotonic()
    with pytest.raises(SessionUnreadable, match=said):
        another.request(f"{__name__}:{name}", path)
    assert time.monotonic() - start_s < 60.0  # 1.2 s of a processor's time, on a computer with other work
    read = another.request("carpus.core.session.session_file:read_session", path)
    assert isinstance(read, Session)
    assert len(read) == ROWS
    another.end()


def test_reading_process_works_without_main_guard(tmp_path: Path) -> None:
    """As researchers write them; a thread makes a copy of the process impossible, so a new one is started."""
    script = tmp_path / "script.py"
    script.write_text(
        "import sys, threading\nfrom pathlib import Path\nfrom carpus.core.session.reader import read_session\n"
        "print('run')\nhold = threading.Event()\nthreading.Thread(target=hold.wait, daemon=True).start()\n"
        "print(len(read_session(Path(sys.argv[1]))))\nhold.set()\n"
    )
    path = store_session(tmp_path / "s.h5")
    command = [sys.executable, str(script), str(path)]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=120)
    assert (done.returncode, done.stdout.split(), done.stderr) == (0, ["run", str(ROWS)], "")
