"""Nothing synchronised is lost and nothing damaged is let in. ``CARPUS_TORTURE`` says how many times as often."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections import Counter
from pathlib import Path

import pytest

from carpus.core.platform.child_process import call_in_child
from tests.torture import kills, mutations, store_kills, write_kills
from tests.torture.readers import read_files

TIMES = int(os.environ.get("CARPUS_TORTURE", "1"))
MOST_BYTES = 1_000_000_000
START = """
import sys
from pathlib import Path
from carpus.core.records.data_folder import DataFolder
from carpus.core.records.new_sessions import recover_sessions
from carpus.core.records.session_list import read_file_states
for start in range(2):
    library = DataFolder(Path(sys.argv[1]))
    faults = recover_sessions(library)[1]
    if start:
        print(len(faults), sum(bool(one.reason) for one in read_file_states(library.store).values()))
    library.close()
"""


@pytest.mark.parametrize("kind", kills.KINDS if TIMES > 1 else ("program with pictures", "capture"))
def test_kill_loses_second_at_most(tmp_path: Path, kind: str) -> None:
    """That of looking back is ``tests/app/test_measuring``'s."""
    lost = [kills.kill_once(kind, number, tmp_path / str(number)).lost_s for number in range(TIMES)]
    print(f"kills, {kind}: {TIMES}; lost {max(lost):.2f} s at most")
    assert max(lost) <= kills.MOST_LOST_S


def test_kill_at_any_write_of_a_recording_or_recovery_keeps_what_was_synchronised(tmp_path: Path) -> None:
    said = write_kills.lines(1 if TIMES > 1 else 251, 3 * TIMES, tmp_path)
    print("\n".join(said))
    assert len(said) == len(write_kills.KINDS) + 1


@pytest.mark.parametrize("kind", store_kills.KINDS if TIMES > 1 else ("erasure", "on a server"))
def test_killed_change_of_store_is_there_whole_or_not_at_all(tmp_path: Path, kind: str) -> None:
    print(store_kills.line(kind, TIMES, tmp_path / "kills"))


def test_damaged_files_are_reported(tmp_path: Path) -> None:
    """No traceback, no reader that dies or stays, no gigabyte. Recordings of one file are damaged hundreds of times in
    ``tests/capture``."""
    outcomes, memory_bytes = call_in_child(read_files, mutations.KINDS, 8 * TIMES, tmp_path, limit_s=240.0 * TIMES)
    for kind in mutations.KINDS:
        said, longest_s = Counter(), 0.0
        for one in (one for one in outcomes if one.kind == kind):
            said[one.said] += 1
            longest_s = max(longest_s, one.took_s)
        print(f"damaged, {kind}: {said}, longest {longest_s:.2f} s")
        assert kind == "journal" or set(said) != {"read"}
        assert longest_s < 60.0
    assert memory_bytes < MOST_BYTES


def test_program_starts_with_all_of_them_in_its_folder(tmp_path: Path) -> None:
    data = tmp_path / "data"
    for kind in ("session", "part"):
        (data / "sessions" / kind).mkdir(parents=True)
        original = mutations.sound(kind, tmp_path / f"sound {kind}")
        for number in range(2 * TIMES):
            mutations.mutate_file(kind, original, number, data / "sessions" / kind)
    register = mutations.sound("register", tmp_path / "register")
    shutil.copy(mutations.mutate_file("register", register, 0, tmp_path), data / "records.sqlite3")
    started = subprocess.run([sys.executable, "-c", START, str(data)], cwd=kills.ROOT, capture_output=True, text=True)
    assert started.returncode == 0, started.stderr
    told_again, set_apart = map(int, started.stdout.split())
    assert (told_again, set_apart > 0) == (0, True)
