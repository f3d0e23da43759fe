"""Nothing synchronised is lost and nothing damaged is let in. ``CARPUS_TORTURE`` says how many times as often."""

from __future__ import annotations

import os
from collections import Counter
from pathlib import Path

import pytest

from carpus.core.platform.child_process import call_in_child
from tests.torture import kills, mutations, store_kills, write_kills
from tests.torture.readers import read_files

TIMES = int(os.environ.get("CARPUS_TORTURE", "1"))
MOST_BYTES = 1_000_000_000


@pytest.mark.parametrize("kind", kills.KINDS if TIMES > 1 else ("program with pictures", "capture"))
def test_kill_loses_second_at_most(tmp_path: Path, kind: str) -> None:
    """That of looking back is ``tests/app/test_measuring``'s."""
    lost = [kills.kill_once(kind, number, tmp_path / str(number)) for number in range(TIMES)]
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
        mine = [one for one in outcomes if one.kind == kind]
        said, longest_s = Counter(one.said for one in mine), max(one.took_s for one in mine)
        print(f"damaged, {kind}: {said}, longest {longest_s:.2f} s")
        assert kind == "journal" or set(said) != {"read"}
        assert longest_s < 60.0
    assert memory_bytes < MOST_BYTES
