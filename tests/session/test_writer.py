"""The writer: nothing overwritten, nothing half-written taken for whole, a full disk loses nothing that was stored."""

from __future__ import annotations

import errno
import os
import subprocess
import sys
from pathlib import Path

import pytest

from carpus.core.model.errors import CarpusFault, DiskFull, OutputExists, OutputNotWritable, TimesUnordered
from carpus.core.platform import durable
from carpus.core.session import writer
from carpus.core.session.reader import read_session
from carpus.core.session.values import stack_states
from tests.session.samples import begin_session, make_frame

ROOT = Path(__file__).parents[2]


@pytest.mark.parametrize("links", [True, False])
def test_session_writer_publishes_only_complete_file(
    tmp_path: Path, links: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    def no_links(*_: object) -> None:
        raise OSError(errno.EPERM, "no hard links on this disk")

    if not links:
        monkeypatch.setattr(os, "link", no_links)
    target = tmp_path / "s.h5"
    session = begin_session(target, rows=1)
    session.flush()
    assert [path.suffix for path in tmp_path.iterdir()] == [".tmp"]
    session.close()
    session.close()
    assert [path.name for path in tmp_path.iterdir()] == ["s.h5"]
    assert read_session(target)
    target.unlink()
    session = begin_session(target, rows=1)
    target.write_text("mine")
    for end in (lambda: begin_session(target), session.close):
        with pytest.raises(OutputExists):
            end()
    assert [path.name for path in tmp_path.iterdir()] == ["s.h5"]
    assert target.read_text() == "mine"
    held = [os.path.realpath(descriptor) for descriptor in Path("/proc/self/fd").iterdir()]
    assert not [path for path in held if path.startswith(str(tmp_path))], "no file is left open"


def test_session_writer_fault_leaves_nothing(tmp_path: Path) -> None:
    with pytest.raises(KeyboardInterrupt), begin_session(tmp_path / "s.h5", rows=1):
        raise KeyboardInterrupt
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("place", "number", "kind"),
    [
        ("nowhere/s.h5", 0, OutputNotWritable), ("file/s.h5", 0, OutputNotWritable),
        ("s.h5", errno.ENOSPC, DiskFull),
    ],
)  # fmt: skip
def test_session_writer_failed_start_leaves_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, place: str, number: int, kind: type[CarpusFault]
) -> None:
    def refuse(*_: object, **__: object) -> None:
        raise OSError(number, "denied")

    (tmp_path / "file").write_text("")
    if number:
        monkeypatch.setattr(writer, "open", refuse, raising=False)
    with pytest.raises(kind) as caught:
        begin_session(tmp_path / place)
    assert kind is DiskFull or caught.value.subject == str((tmp_path / place).parent)
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


def test_session_writer_unordered_times_or_wrong_rows_raise(tmp_path: Path) -> None:
    session = begin_session(tmp_path / "s.h5")
    session.append(make_frame(1))
    with pytest.raises(TimesUnordered):
        session.append(make_frame(0))
    with pytest.raises(ValueError, match="/smoothed"):
        session.write_motion(stack_states([make_frame(0), make_frame(1)]))
    session.abandon()
    assert list(tmp_path.iterdir()) == []


BOUNDED = """
import resource, sys
from pathlib import Path
from carpus.core.model.errors import DiskFull
from carpus.core.model.hand.protocols import HAND21
from tests.session.samples import begin_session, make_frame, make_header
resource.setrlimit(resource.RLIMIT_FSIZE, (int(sys.argv[2]), int(sys.argv[2])))
try:
    with begin_session(Path(sys.argv[1]), make_header(HAND21)) as session:
        for row in range(3000):
            session.append(make_frame(row, HAND21))
except DiskFull:
    print("full")
"""


@pytest.mark.parametrize("bytes_free", [10_000, 6_000_000])
def test_session_writer_full_disk_leaves_nothing(tmp_path: Path, bytes_free: int) -> None:
    command = [sys.executable, "-c", BOUNDED, str(tmp_path / "s.h5"), str(bytes_free)]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["full"]
    assert list(tmp_path.iterdir()) == []


def test_session_writer_without_fallocate_checks_free_space(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def unknown(*_: int) -> None:
        raise OSError(errno.EOPNOTSUPP, "not here")

    monkeypatch.setattr(os, "posix_fallocate", unknown)
    session = begin_session(tmp_path / "s.h5", rows=1)
    session.flush()
    usage = durable.shutil.disk_usage(tmp_path)._replace(free=1000)
    monkeypatch.setattr(durable.shutil, "disk_usage", lambda _: usage)
    session.append(make_frame(1))
    with pytest.raises(DiskFull):
        session.close()
    assert list(tmp_path.iterdir()) == []
