"""The recording journal: what was synchronised is read back, wherever the file is cut, and never anything else."""

from __future__ import annotations

import errno
import os
import subprocess
import sys
from contextlib import closing
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from carpus.core.model.errors import CarpusFault, DiskFull, OutputExists, OutputNotWritable, TimesUnordered
from carpus.core.model.hand.protocols import HAND21, WRIST6
from carpus.core.session.file_layout import Blocks, build_frame_blocks
from carpus.core.session.journal import JournalReader, unpack_arrays
from carpus.core.session.schema import TableLayout
from tests.moments import with_moment
from tests.session.samples import make_frame, write_journal

ROOT = Path(__file__).parents[2]
BATCH, BATCHES = 5, 6


def store_rows(path: Path) -> list[Blocks]:
    with closing(JournalReader(path)) as journal:
        return [unpack_arrays(content) for kind, content in journal.read() if kind == b"ROWS"]


def rows_stored(path: Path) -> int:
    return sum(len(blocks["/frames/timestamp"]) for blocks in store_rows(path))


def split_batches(path: Path) -> list[int]:
    """A journal of batches; the length of the file after each."""
    journal, ends = write_journal(path), []
    for row in range(BATCH * BATCHES):
        journal.append(make_frame(row))
        if row % BATCH == BATCH - 1:
            journal.flush()
            ends.append(path.stat().st_size)
    journal.close()
    return ends


@cache
def build_batch(number: int) -> Blocks:
    frames = [make_frame(number * BATCH + row) for row in range(BATCH)]
    return build_frame_blocks(TableLayout(WRIST6, ()), frames)


def check_prefix(path: Path, batches: int) -> None:
    found = store_rows(path)
    assert len(found) == batches
    for number, blocks in enumerate(found):
        expected = build_batch(number)
        assert blocks.keys() == expected.keys()
        for name, data in blocks.items():
            np.testing.assert_array_equal(data, expected[name], name)


@pytest.mark.parametrize("end", ["cut", "zeros", "old bytes"])
def test_journal_truncated_keeps_rows_before(tmp_path: Path, end: str) -> None:
    ends = split_batches(tmp_path / "s.journal")
    data, path = (tmp_path / "s.journal").read_bytes(), tmp_path / "lost.journal"
    for length in range(512, len(data), 1700):
        rest = {"cut": b"", "zeros": bytes(len(data) - length), "old bytes": data[: len(data) - length]}[end]
        path.write_bytes(data[:length] + rest)
        check_prefix(path, sum(one <= length for one in ends))


def test_journal_rows_are_synchronised_twice_a_second(tmp_path: Path) -> None:
    now_s = 100.0
    journal = write_journal(tmp_path / "s.journal", clock=lambda: now_s)
    for row in range(60):
        now_s += 1 / 30
        journal.append(make_frame(row))
        assert rows_stored(journal.path) >= row + 1 - 16
    journal.discard()
    assert list(tmp_path.iterdir()) == []


def test_journal_failed_start_leaves_nothing(tmp_path: Path) -> None:
    (tmp_path / "s.journal").write_text("mine")
    with pytest.raises(OutputExists):
        write_journal(tmp_path / "s.journal")
    with pytest.raises(OutputNotWritable):
        write_journal(tmp_path / "nowhere" / "s.journal")
    assert (tmp_path / "s.journal").read_text() == "mine"


def test_journal_unordered_times_or_wrong_shapes_raise(tmp_path: Path) -> None:
    journal = write_journal(tmp_path / "s.journal")
    journal.append(make_frame(1))
    with pytest.raises(TimesUnordered):
        journal.append(make_frame(0))
    journal.flush()
    journal.append(with_moment(make_frame(2), position_m=np.array(0.0)))
    with pytest.raises(ValueError, match="/wrist/position"):
        journal.flush()
    journal.discard()


@pytest.mark.parametrize(("number", "kind"), [(errno.EDQUOT, DiskFull), (errno.EIO, OutputNotWritable)])
def test_journal_failed_write_raises_fault(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, number: int, kind: type[CarpusFault]
) -> None:
    def broken(_: int) -> None:
        raise OSError(number, "broken")

    journal = write_journal(tmp_path / "s.journal", 1)
    journal.append(make_frame(1))
    monkeypatch.setattr(os, "fsync", broken)
    with pytest.raises(kind):
        journal.flush()
    with pytest.raises(kind):
        journal.flush()
    journal.abandon()
    assert rows_stored(journal.path) >= 1


BOUNDED = """
import resource, sys
from pathlib import Path
from carpus.core.model.errors import DiskFull
from carpus.core.model.hand.protocols import HAND21, WRIST6
from tests.session.samples import write_journal, make_frame
resource.setrlimit(resource.RLIMIT_FSIZE, (3_000_000, 3_000_000))
journal = write_journal(Path(sys.argv[1]), protocol=HAND21)
row = synced = 0
try:
    while row < 5000:
        journal.append(make_frame(row, HAND21))
        row += 1
        if row % 25 == 0:
            journal.flush()
            synced = row
except DiskFull:
    journal.abandon()
    print(synced)
"""


def test_journal_full_disk_keeps_stored_rows(tmp_path: Path) -> None:
    command = [sys.executable, "-c", BOUNDED, str(tmp_path / "s.journal")]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    assert rows_stored(tmp_path / "s.journal") == int(done.stdout) > 0
    last = store_rows(tmp_path / "s.journal")[-1]
    expected = make_frame(int(done.stdout) - 1, HAND21).kinematics.joint_position_m
    np.testing.assert_array_equal(last["/joints/position"][-1], expected)
